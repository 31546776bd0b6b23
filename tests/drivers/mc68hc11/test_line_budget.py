"""The link budget: what the documentation promises fits on the line."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.drivers.mc68hc11.board_messages import Rates
from rotemina.drivers.mc68hc11.framing import MAX_FRAME, STOP_BYTES
from rotemina.drivers.mc68hc11.line_budget import BAUDS, Line, rates
from rotemina.drivers.mc68hc11.protocol_codes import AXES, QUEUE, SEGMENTS

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


def test_a_slower_chip_announces_half_of_it():
    assert rates(Line(125_000), 1000) == Rates(100, 25, 1000, 250, 50, 1000)
    assert rates(Line(9_600), 1000) == replace(rates(Line(9_600)), tick=1000)


@pytest.mark.parametrize("line", LINES[1::2], ids=str)
def test_segments_and_their_answers_fit_on_a_bus_beside_slower_telemetry(line):
    """A segment has 32 bytes, Done 9, the slots behind them 6; both boards have their own."""
    own = rates(line)
    assert line.load(own.telemetry / 2) + line.seconds(2 * own.segments * (32 + 9 + 6)) <= 0.95


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
                own.segments,
                round(1e3 * line.stop_s(), 1),
            ]
        )


def test_what_a_board_keeps_fits_into_its_memory():
    table = PAGE.partition("## What a board needs")[2].partition("##")[0]
    outside, *inside = (int(n) for n in re.findall(r"\| (\d+) \|$", table, re.MULTILINE))
    assert outside == QUEUE * (2 + AXES * 8)  # ticks, and two differences of an axis
    assert outside >= SEGMENTS * (2 + 8)  # ticks, and two differences
    assert inside[0] == MAX_FRAME - 2
    assert inside[1] == 2 * MAX_FRAME
    assert sum(inside) <= 512
