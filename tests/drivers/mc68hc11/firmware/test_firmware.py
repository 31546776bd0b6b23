"""The cycles of the firmware's hot paths are counted and stay within their limits."""

import re
from pathlib import Path

import pytest

from rotemina.drivers.contract import BudgetError
from rotemina.drivers.mc68hc11.firmware import chip_load, cycles

PAGE = (Path(__file__).parents[4] / "docs" / "protocol.md").read_text("utf-8")


@pytest.fixture(scope="module")
def routines(assembler):
    return chip_load.assemble_hot_paths()


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("3d", 10),  # MUL
        ("02", 41),  # IDIV
        ("dc 10", 4),  # LDD direct
        ("ec 00", 5),  # LDD indexed
        ("c3 03 e8", 4),  # ADDD immediate
        ("d3 10", 5),  # ADDD direct
        ("1a 93 40", 6),  # CPD direct
        ("18 ee 02", 6),  # LDY indexed by Y
        ("18 3a", 4),  # ABY
        ("7a 00 0a", 6),  # DEC extended
        ("1e 10 20 fc", 7),  # BRSET indexed
        ("27 10", 3),  # BEQ
        ("bd 00 00", 6),  # JSR extended
        ("3b", 12),  # RTI
    ],
)
def test_cycles_match_the_manual(code, expected):
    assert cycles.find_cycles(bytes.fromhex(code)) == expected


@pytest.mark.parametrize("code", ["41", "18 00", "1a 84", "87 00"])
def test_an_invalid_instruction_is_refused(code):
    with pytest.raises(BudgetError, match="no instruction of the MC68HC11"):
        cycles.find_cycles(bytes.fromhex(code))


def test_a_jump_that_a_branch_skips_is_not_counted():
    branch, jump, return_instruction = (0x26, 0x03), (0x7E, 0, 0), (0x39,)
    assert cycles.count_cycles([branch, jump, return_instruction]) == 3 + 5
    assert cycles.count_cycles([jump, return_instruction]) == 3 + 5
    assert cycles.count_cycles([(0x26, 0x05), jump, return_instruction]) == 3 + 3 + 5


def test_interrupts_are_masked_until_the_mask_is_cleared():
    assert cycles.count_masked_cycles([(0x01,), (0x0E,), (0x3D,), (0x3B,)]) == 14 + 2 + 2
    assert cycles.count_masked_cycles([(0x01,), (0x3B,)]) == 14 + 2 + 12
    with pytest.raises(BudgetError, match="neither CLI nor RTI"):
        cycles.count_masked_cycles([(0x01,)])


def test_no_load_case_exceeds_the_chip(routines):
    for case in chip_load.LOAD_CASES:
        for clock_hz in chip_load.CLOCKS_HZ:
            assert 0.4 < chip_load.compute_load(case, routines, clock_hz) <= 0.92, case.name


def test_no_interrupt_is_masked_for_more_than_90_cycles(routines):
    masked_cycles = {
        name: path.count_masked_cycles(routines) for name, path in chip_load.PATHS.items()
    }
    assert max(masked_cycles.values()) <= chip_load.MAX_MASKED_CYCLES
    assert sum(count > 0 for count in masked_cycles.values()) == 8


def test_the_line_carries_every_load_case(routines):
    for case in chip_load.LOAD_CASES:
        for clock_factor in (1, 2):
            assert max(case.compute_line_bytes_per_s(clock_factor)) * 10 < 0.7 * chip_load.BAUD, (
                case.name
            )


def test_the_page_shows_the_printed_table(routines, capsys):
    assert chip_load.main() == 0
    printed = capsys.readouterr().out
    shown_table = re.search(r"```text\n(path .*?)```", PAGE, re.DOTALL)
    assert shown_table is not None
    assert shown_table[1] == printed


def test_a_missing_assembler_is_reported(monkeypatch, capsys):
    monkeypatch.setattr(cycles, "ASSEMBLER", "m68hc11-as-of-nobody")
    assert chip_load.main() == 2
    assert "install the package binutils-m68hc1x" in capsys.readouterr().err
    assert chip_load.main(["now"]) == 2


def test_a_missing_label_is_reported(routines):
    with pytest.raises(BudgetError, match="no label 'isr_tick'"):
        chip_load.PATHS["tick, interpolated, micro"].count_cycles({})
