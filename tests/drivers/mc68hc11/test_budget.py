"""The link budget: what the documentation promises fits on the line."""

import re
from pathlib import Path

import pytest

from rotemina.drivers.mc68hc11.budget import BAUDS, Line, rates
from rotemina.drivers.mc68hc11.codes import SEGMENTS, SETPOINTS
from rotemina.drivers.mc68hc11.framing import MAX_FRAME, STOP_BYTES
from rotemina.drivers.mc68hc11.requests import Segment, SetPoint

PAGE = (Path(__file__).parents[3] / "docs" / "protocol.md").read_text("utf-8")
LINES = [Line(baud, half) for baud in BAUDS for half in (False, True)]


def test_telemetry_and_capture_as_promised_fit_together():
    line = Line(125_000)
    assert line.load(50, 2000, 1) < 0.95
    assert line.load(50, 1000, 3) < 0.95
    assert not line.load(200, 1000, 3) < 1.0


@pytest.mark.parametrize("line", LINES, ids=str)
def test_what_a_board_announces_fits(line):
    own = rates(line)
    assert line.load(own.telemetry) <= 0.95
    assert line.load(own.telemetry_while_capturing, own.capture_one, 1) <= 0.95
    assert line.load(own.telemetry_while_capturing, own.capture_three, 3) <= 0.95


@pytest.mark.parametrize("line", LINES, ids=str)
def test_a_stop_takes_the_frame_in_flight_and_two_milliseconds_at_most(line):
    in_flight = line.seconds(32)
    assert line.stop_s() - in_flight <= 2e-3
    assert line.stop_s() <= 5e-3 or line.baud < 125_000
    assert len(STOP_BYTES) == 2


def test_the_table_of_the_documentation_is_what_is_announced():
    rows = re.findall(r"^\| ([\d ]+) \| (two lines|shared bus) \|(.*)\|$", PAGE, re.MULTILINE)
    assert len(rows) == len(LINES)
    for baud, kind, figures in rows:
        line = Line(int(baud.replace(" ", "")), kind == "shared bus")
        own = rates(line)
        told = [float(one) for one in figures.split("|")]
        assert told == pytest.approx(
            [
                own.telemetry,
                own.telemetry_while_capturing,
                own.capture_one,
                own.capture_three,
                round(1e3 * line.stop_s(), 1),
            ]
        )


def test_what_a_board_keeps_fits_into_its_memory():
    table = PAGE.partition("## What a board needs")[2].partition("##")[0]
    sizes = [int(size) for size in re.findall(r"\| (\d+) \|$", table, re.MULTILINE)]
    assert sizes[0] == SETPOINTS * (SetPoint.LAYOUT.size - 2)  # without index and left
    assert sizes[0] == SEGMENTS * (Segment.LAYOUT.size - 1)  # without index
    assert sizes[1] == MAX_FRAME - 2
    assert sizes[2] == 2 * MAX_FRAME
    assert sum(sizes) <= 512
