"""Records that count their place from different origins: a screw has one period all the same."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.screening import screen
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.gap.fit.position_origins import origin_remarks, with_origins
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
PERIOD_M = 250.1e-6
SCREW = AxisEffect(
    axis="x", id="leadscrew_error", parameters={"period": PERIOD_M, "sine": 4e-6, "cosine": -3e-6}
)
PLAY = AxisEffect(axis="x", id="backlash", formulation="screw", parameters={"width": 4e-6})


def recorded(effects, *origins):
    """Return records of ways to and fro, each with its place counted from an origin, m."""
    records = []
    for number, origin in enumerate(origins):
        time_s = np.arange(1500) / 100.0
        way = 0.010 * (0.5 - 0.5 * np.cos(2.0 * np.pi * time_s / (11.0 + number)))
        commands = Record.from_signals(time_s, {("x", Tap.CMD): 0.015 + way}, {"x": "m"})
        seen = simulate(ROBOT, effects, commands, np.random.default_rng(number))
        taps = (Tap.CMD, Tap.REF, Tap.MEAS)
        signals = {("x", tap): seen.signal("x", tap) - origin for tap in taps}
        records.append(Record.from_signals(time_s, signals, {"x": "m"}))
    return Evidence.of(ROBOT, "x", records)


def found(evidence):
    bare = AxisEffect(axis="x", id="leadscrew_error")
    begun = screen(evidence, fit(evidence, []), bare, briefly=False)
    return fit(evidence, [begun.effect])


def test_one_record_with_another_origin_leaves_no_gap_and_no_alias():
    origin = 3.07e-3
    seen = with_origins(recorded([SCREW], 0.0, origin, 0.0))
    own = [one.origin for one in seen.observations]
    assert own[0] == own[2] == 0.0
    turns = (own[1] - origin) / PERIOD_M
    assert turns - np.rint(turns) == pytest.approx(0.0, abs=1e-3)
    assert str(origin_remarks(seen)[0]).startswith("1 of 3 records use another origin of position")
    told = found(seen)
    assert told.effects[0].parameters["period"] == pytest.approx(PERIOD_M, rel=1e-4)
    assert told.cost < 1.5
    assert found(recorded([SCREW], 0.0, origin, 0.0)).cost > 20.0  # one phase forced on all


def test_records_that_count_alike_stay_as_they_are():
    evidence = recorded([SCREW], 0.0, 0.0, 0.0)
    assert with_origins(evidence) is evidence
    assert origin_remarks(evidence) == ()


def test_what_is_not_locked_to_the_position_gives_no_origin():
    evidence = recorded([PLAY], 0.0, 3.07e-3, 0.0)
    assert with_origins(evidence) is evidence
