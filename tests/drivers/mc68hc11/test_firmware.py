"""The firmware's hot paths: assembled, counted, and what they must not exceed."""

import os
import re
import shutil
from pathlib import Path

import pytest

from rotemina.drivers.mc68hc11.firmware import chip_load, cycles
from rotemina.drivers.mc68hc11.firmware.cycles import BudgetError

PAGE = (Path(__file__).parents[3] / "docs" / "protocol.md").read_text("utf-8")


@pytest.fixture(scope="module")
def routines():
    if shutil.which(cycles.ASSEMBLER) is None:
        absent = f"no {cycles.ASSEMBLER}: `make test` installs {cycles.PACKAGE}"
        if os.environ.get("CI") == "true":
            pytest.fail(absent)
        pytest.skip(absent)
    return chip_load.hot_paths()


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
def test_cycles_are_those_of_the_manual(code, expected):
    assert cycles.cycles_of(bytes.fromhex(code)) == expected


@pytest.mark.parametrize("code", ["41", "18 00", "1a 84", "87 00"])
def test_what_is_no_instruction_is_refused(code):
    with pytest.raises(BudgetError, match="no instruction of the MC68HC11"):
        cycles.cycles_of(bytes.fromhex(code))


def test_a_jump_that_a_branch_leads_around_is_not_on_the_way():
    branch, jump, back = (0x26, 0x03), (0x7E, 0, 0), (0x39,)
    assert cycles.counted([branch, jump, back]) == 3 + 5
    assert cycles.counted([jump, back]) == 3 + 5
    assert cycles.counted([(0x26, 0x05), jump, back]) == 3 + 3 + 5


def test_interrupts_are_kept_out_until_the_mask_is_cleared():
    assert cycles.masked([(0x01,), (0x0E,), (0x3D,), (0x3B,)]) == 14 + 2 + 2
    assert cycles.masked([(0x01,), (0x3B,)]) == 14 + 2 + 12
    with pytest.raises(BudgetError, match="neither CLI nor RTI"):
        cycles.masked([(0x01,)])


def test_no_case_exceeds_the_chip(routines):
    for case in chip_load.CASES:
        for clock_hz in chip_load.CLOCKS_HZ:
            assert 0.4 < chip_load.load(case, routines, clock_hz) <= 0.92, case.name


def test_no_interrupt_is_kept_out_for_longer_than_90_cycles(routines):
    kept_out = {name: path.masked(routines) for name, path in chip_load.PATHS.items()}
    assert max(kept_out.values()) <= chip_load.MOST_MASKED
    assert sum(count > 0 for count in kept_out.values()) == 8


def test_the_line_carries_every_case(routines):
    for case in chip_load.CASES:
        for faster in (1, 2):
            assert max(case.line(faster)) * 10 < 0.7 * chip_load.BAUD, case.name


def test_the_page_shows_what_is_printed(routines, capsys):
    assert chip_load.main() == 0
    printed = capsys.readouterr().out
    shown = re.search(r"```text\n(path .*?)```", PAGE, re.DOTALL)
    assert shown is not None
    assert shown[1] == printed


def test_a_missing_assembler_is_told(monkeypatch, capsys):
    monkeypatch.setattr(cycles, "ASSEMBLER", "m68hc11-as-of-nobody")
    assert chip_load.main() == 2
    assert "install the package binutils-m68hc1x" in capsys.readouterr().err
    assert chip_load.main(["now"]) == 2


def test_a_label_that_is_gone_is_told(routines):
    with pytest.raises(BudgetError, match="no label 'isr_tick'"):
        chip_load.PATHS["tick, led, micro"].cycles({})
