"""The line can carry the rates that the documentation promises."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.drivers.mc68hc11 import (
    BAUD_RATES,
    LineCapacity,
    compute_rates,
)
from rotemina.drivers.mc68hc11.protocol import (
    AXES_PER_BOARD,
    MAX_FRAME_BYTES,
    MAX_PROFILE_SEGMENTS,
    QUEUE_SEGMENTS,
    BoardRates,
)

PAGE = (Path(__file__).parents[3] / "docs" / "protocol.md").read_text("utf-8")
LINES = [LineCapacity(baud, half) for baud in BAUD_RATES for half in (False, True)]


def test_promised_telemetry_and_capture_fit_together():
    line = LineCapacity(125_000)
    assert line.compute_load(50, 2000, 1) < 0.95
    assert line.compute_load(50, 1000, 3) < 0.95
    assert not line.compute_load(200, 1000, 3) < 1.0


@pytest.mark.parametrize("line", LINES, ids=str)
def test_the_announced_rates_fit_on_the_line(line):
    rates = compute_rates(line)
    assert line.compute_load(rates.telemetry) <= 0.95
    assert line.compute_load(rates.telemetry_while_capturing, rates.capture_one, 1) <= 0.95
    assert line.compute_load(rates.telemetry_while_capturing, rates.capture_three, 3) <= 0.95
    # A stop follows the frame in flight.
    latency_s = line.compute_stop_latency_s()
    assert latency_s - line.compute_duration_s(32) <= 2e-3
    assert latency_s <= 5e-3 or line.baud < 125_000
    if line in LINES[1::2]:
        # On a shared bus, a segment takes 32 bytes for each board, its Done 9, and the slots 6.
        segments_load = line.compute_duration_s(2 * rates.segments * (32 + 9 + 6))
        assert line.compute_load(rates.telemetry / 2) + segments_load <= 0.95


def test_a_chip_with_half_the_clock_announces_half_the_rates():
    assert compute_rates(LineCapacity(125_000), 1000) == BoardRates(100, 25, 1000, 250, 50, 1000)
    assert compute_rates(LineCapacity(9_600), 1000) == replace(
        compute_rates(LineCapacity(9_600)), tick=1000
    )


def test_the_documented_table_matches_the_announced_rates():
    rows = re.findall(r"^\| ([\d ]+) \| (two lines|shared bus) \|(.*)\|$", PAGE, re.MULTILINE)
    assert len(rows) == len(LINES)
    for baud, kind, figures in rows:
        line = LineCapacity(int(baud.replace(" ", "")), kind == "shared bus")
        rates = compute_rates(line)
        documented = [float(figure) for figure in figures.split("|")]
        assert documented == pytest.approx(
            [
                rates.telemetry,
                rates.telemetry_while_capturing,
                rates.capture_one,
                rates.capture_three,
                rates.segments,
                round(1e3 * line.compute_stop_latency_s(), 1),
            ]
        )


def test_the_data_of_a_board_fits_into_its_memory():
    table = PAGE.partition("## What a board needs")[2].partition("##")[0]
    external_bytes, *internal_bytes = (
        int(n) for n in re.findall(r"\| (\d+) \|$", table, re.MULTILINE)
    )
    # A segment contains its ticks and two differences per axis.
    assert external_bytes == QUEUE_SEGMENTS * (2 + AXES_PER_BOARD * 8)
    # A segment of a profile contains its ticks and two differences.
    assert external_bytes >= MAX_PROFILE_SEGMENTS * (2 + 8)
    assert internal_bytes[0] == MAX_FRAME_BYTES - 2
    assert internal_bytes[1] == 2 * MAX_FRAME_BYTES
    assert sum(internal_bytes) <= 512
