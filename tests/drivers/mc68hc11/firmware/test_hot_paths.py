"""The firmware's hot paths, simulated by instruction, give the same results as Python."""

import sys
from binascii import crc_hqx
from copy import deepcopy
from importlib.resources import as_file, files
from pathlib import Path

import numpy as np
import pytest

from rotemina.drivers.mc68hc11.firmware.chip_load import SOURCES

# The module of the chip is not a test module.
sys.path.insert(0, str(Path(__file__).parent))

from chip import build_chip

CODE, BYTE, CRC, IN, MARK, NEXT = 0x02, 0x03, 0x04, 0x06, 0x0B, 0x0D
HEAD, TAIL, LEFT, OLDEST, SILENCE = 0x00, 0x01, 0x16, 0x18, 0x14
AXES, SIZE = 0x30, 24
POS, FIRST, SECOND, TOLD, MOST, SPAN, GAIN, BASE = 0, 4, 8, 12, 14, 16, 18, 20
TURN, REST, EDGES, PACE = 19, 20, 21, 22
RING, FRAME, FRAME_OUT, QUEUE = 0x80, 0xA0, 0xBE, 0x4000
OUTPUTS = 0x2020
UNTIL, HOLD, LASTS = 0x78, 0x7A, 0x7C


@pytest.fixture(scope="module")
def firmware(assembler, tmp_path_factory):
    with as_file(files("rotemina.drivers.mc68hc11") / "firmware") as folder:
        return build_chip(folder, SOURCES, tmp_path_factory.mktemp("firmware"))


@pytest.fixture
def chip(firmware):
    chip = deepcopy(firmware)
    for byte in range(256):
        chip.poke(chip.symbols["table"] + 2 * byte, crc_hqx(bytes((byte,)), 0))
    for steps in range(151):
        chip.memory[chip.symbols["shares"] + steps] = steps // 50
        chip.memory[chip.symbols["shares"] + 160 + steps] = steps % 50
    chip.poke(SILENCE, 500)
    chip.poke(LEFT, 1000)
    return chip


def stuff_bytes(body):
    """Encode by COBS, like `framing`."""
    blocks = body.split(b"\0")
    return b"".join(bytes((len(block) + 1,)) + block for block in blocks)


@pytest.fixture(params=range(2))
def body(request):
    content = np.random.default_rng(request.param).integers(0, 4, 26).astype(np.uint8).tobytes()
    return content + (crc_hqx(content, 0xFFFF) ^ 0xFFFF).to_bytes(2, "big")


def test_a_body_is_unstuffed_and_its_check_agrees(chip, body):
    wire = stuff_bytes(body)
    chip.poke(CRC, 0xFFFF)
    chip.poke(IN, FRAME)
    # The hot path does not handle the start of a frame.
    chip.memory[CODE] = wire[0]
    for byte in wire[1:]:
        chip.memory[RING + chip.memory[HEAD]] = byte
        chip.memory[HEAD] = chip.memory[HEAD] + 1 & 31
        chip.call("take_byte")
    assert chip.memory[TAIL] == chip.memory[HEAD]
    assert bytes(chip.memory[FRAME : FRAME + len(body)]) == body
    assert chip.word(CRC) == crc_hqx(body, 0xFFFF) == 0x1D0F


def test_a_body_is_stuffed_and_checked(chip, body):
    chip.poke(CRC, 0xFFFF)
    chip.poke(MARK, FRAME_OUT)
    chip.poke(IN, FRAME_OUT + 1)
    chip.memory[CODE] = 1
    for byte in body:
        chip.a = byte
        chip.call("put_byte")
    chip.memory[chip.word(MARK)] = chip.memory[CODE]
    assert bytes(chip.memory[FRAME_OUT : chip.word(IN)]) == stuff_bytes(body)
    assert chip.word(CRC) == 0x1D0F


def test_a_segment_is_queued_and_loaded_with_its_signs(chip):
    first, second = (-70_000, 123_456_789, 5), (-3, 8_388_607, -8_388_608)
    chip.memory[NEXT] = 7
    chip.memory[FRAME : FRAME + 6] = bytes((1, 9, 0x12, 7, 0, 20))
    for axis in range(3):
        chip.poke(FRAME + 6 + 7 * axis, first[axis], 4)
        chip.poke(FRAME + 10 + 7 * axis, second[axis], 3)
    chip.call("take_segment")
    assert chip.memory[NEXT] == 8
    chip.poke(OLDEST, QUEUE)
    chip.call("load_axes")
    assert chip.word(LEFT) == 20
    for axis in range(3):
        address = AXES + SIZE * axis
        assert read_signed(chip, address + FIRST, 4) == first[axis]
        assert read_signed(chip, address + SECOND, 4) == second[axis]
    assert chip.word(OLDEST) == QUEUE + 26


def read_signed(chip, address, size):
    return int.from_bytes(chip.memory[address : address + size], "big", signed=True)


def add_lists(first, second):
    return [left + right for left, right in zip(first, second, strict=True)]


def prepare_axes(chip, first, second, max_steps=100):
    for axis in range(3):
        address = AXES + SIZE * axis
        chip.poke(address + FIRST, first[axis], 4)
        chip.poke(address + SECOND, second[axis], 4)
        chip.poke(address + MOST, max_steps)
        chip.poke(address + SPAN, 2 * max_steps)


def test_ticks_add_differences_exactly(chip):
    chip.memory[chip.symbols["micro_out"]] = 0x3B  # RTI, so that no output is made
    first, second = [3 << 16, 40_000, 1_000_000], [-1500, 77, -9]
    position = [0, 0, 0]
    prepare_axes(chip, first, second)
    for _ in range(200):
        chip.call("isr_tick")
        first = add_lists(first, second)
        position = add_lists(position, first)
        for axis in range(3):
            address = AXES + SIZE * axis
            assert read_signed(chip, address + POS, 4) == (position[axis] + (1 << 31)) % (
                1 << 32
            ) - (1 << 31)
            assert chip.word(address + TOLD) == position[axis] >> 16 & 0xFFFF
    assert chip.word(LEFT) == 800
    assert int.from_bytes(chip.memory[0x10:0x14], "big") == 200_000


@pytest.mark.parametrize(("first", "is_made"), [(99, True), (101, False), (-102, False)])
def test_steps_beyond_the_speed_limit_are_not_made(chip, first, is_made):
    chip.memory[chip.symbols["micro_out"]] = 0x3B
    prepare_axes(chip, [first << 16] * 3, [0] * 3)
    chip.call("isr_tick")
    assert (chip.word(AXES + TOLD) == first & 0xFFFF) is is_made


def test_one_edge_is_made_per_50_steps_and_none_is_lost(chip):
    prepare_axes(chip, [(73 << 16) + 21_000, 10 << 16, 100 << 16], [0] * 3)
    edges = [0, 0, 0]
    for _ in range(300):
        chip.call("isr_tick")
        for axis in range(3):
            edges[axis] += chip.memory[AXES + SIZE * axis + EDGES]
    for axis in range(3):
        address = AXES + SIZE * axis
        steps = ((73 << 16) + 21_000, 10 << 16, 100 << 16)[axis] * 300 >> 16
        assert edges[axis] * 50 + chip.memory[address + REST] == steps


def prepare_held_rows(chip, first, second, ticks=10, max_steps=500):
    prepare_axes(chip, [0] * 3, [0] * 3, max_steps)
    for axis in range(3):
        chip.poke(AXES + SIZE * axis + FIRST, first[axis])
        chip.poke(AXES + SIZE * axis + SECOND, second[axis])
    chip.poke(UNTIL, 1)
    chip.poke(HOLD, ticks)
    chip.poke(LASTS, 2000 * ticks)


def test_a_segment_of_held_rows_is_loaded_in_whole_steps(chip):
    chip.memory[FRAME : FRAME + 6] = bytes((1, 9, 0x12, 0, 0, 20))
    first, second = (-500, 500, 32_767), (-3, 1000, -20)
    for axis in range(3):
        chip.poke(FRAME + 6 + 7 * axis, first[axis], 4)
        chip.poke(FRAME + 10 + 7 * axis, second[axis], 3)
    chip.call("take_segment")
    chip.poke(OLDEST, QUEUE)
    chip.call("load_rows")
    assert chip.word(LEFT) == 20
    for axis in range(3):
        assert read_signed(chip, AXES + SIZE * axis + FIRST, 2) == first[axis]
        assert read_signed(chip, AXES + SIZE * axis + SECOND, 2) == second[axis]


def test_held_rows_change_the_command_after_their_ticks(chip):
    chip.memory[chip.symbols["micro_row"]] = 0x3B
    first, second, position = [-80, 0, 433], [7, -1, 0], [0, 0, 0]
    prepare_held_rows(chip, first, second)
    for tick in range(200):
        chip.call("isr_held")
        if tick % 10 == 0:
            first = add_lists(first, second)
            position = add_lists(position, first)
        for axis in range(3):
            assert chip.word(AXES + SIZE * axis + TOLD) == position[axis] & 0xFFFF


@pytest.mark.parametrize(("distance", "is_made"), [(500, True), (501, False), (-501, False)])
def test_a_row_beyond_the_distance_limit_is_not_made(chip, distance, is_made):
    chip.memory[chip.symbols["micro_row"]] = 0x3B
    prepare_held_rows(chip, [distance] * 3, [0] * 3)
    chip.call("isr_held")
    assert (chip.word(AXES + TOLD) == distance & 0xFFFF) is is_made


def test_the_edges_of_a_row_are_spread_over_its_time(chip):
    distances = (500, 73, 10)
    prepare_held_rows(chip, distances, [0] * 3)
    edges = [0, 0, 0]
    for tick in range(300):
        chip.call("isr_held")
        for axis in range(3) if tick % 10 == 0 else ():
            edge_count = chip.memory[AXES + SIZE * axis + EDGES]
            assert chip.word(AXES + SIZE * axis + PACE) == (
                20_000 // edge_count if edge_count else 0xFFFF
            )
            edges[axis] += edge_count
    for axis in range(3):
        assert edges[axis] * 50 + chip.memory[AXES + SIZE * axis + REST] == 30 * distances[axis]


def test_edges_of_a_row_count_backwards_too(chip):
    prepare_held_rows(chip, [-500, -73, -10], [0] * 3)
    for axis in range(3):
        chip.memory[AXES + SIZE * axis + TURN] = 0x80
    chip.call("isr_held")
    assert [chip.memory[AXES + SIZE * axis + EDGES] for axis in range(3)] == [10, 1, 0]


@pytest.mark.parametrize(
    ("steps", "gain", "base"),
    [(0, 32_768, 5), (65_000, 33_000, 100), (12_345, 65_535, 0), (40_000, 257, 60_000)],
)
def test_a_piezo_code_is_the_exact_product(chip, steps, gain, base):
    for axis in range(3):
        address = AXES + SIZE * axis
        chip.poke(address + POS, steps << 16, 4)
        chip.poke(address + GAIN, gain)
        chip.poke(address + BASE, base)
    chip.call("nano_out")
    for axis in range(3):
        assert chip.word(OUTPUTS + 2 * axis) == (steps * gain >> 15) + base & 0xFFFF
