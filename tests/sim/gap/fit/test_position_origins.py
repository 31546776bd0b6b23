"""Records with different origins of position: the screw still has one period."""

import numpy as np
import pytest

from rotemina.sim.gap.compare.screening import screen
from rotemina.sim.gap.fit import Evidence, fit, origin_remarks, with_origins
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
PERIOD_M = 250.1e-6
SCREW = AxisEffect(
    axis="x", id="leadscrew_error", parameters={"period": PERIOD_M, "sine": 4e-6, "cosine": -3e-6}
)
PLAY = AxisEffect(axis="x", id="backlash", formulation="screw", parameters={"width": 4e-6})


def simulate_evidence(effects, *origins):
    """Return evidence of moves back and forth, each with its origin of position, m."""
    records = []
    for number, origin in enumerate(origins):
        time_s = np.arange(1500) / 100.0
        travel = 0.010 * (0.5 - 0.5 * np.cos(2.0 * np.pi * time_s / (11.0 + number)))
        commands = Record.from_signals(time_s, {("x", Tap.CMD): 0.015 + travel}, {"x": "m"})
        record = simulate(ROBOT, effects, commands, np.random.default_rng(number))
        taps = (Tap.CMD, Tap.REF, Tap.MEAS)
        signals = {("x", tap): record.signal("x", tap) - origin for tap in taps}
        records.append(Record.from_signals(time_s, signals, {"x": "m"}))
    return Evidence.of(ROBOT, "x", records)


def fit_screw(evidence):
    candidate = AxisEffect(axis="x", id="leadscrew_error")
    start = screen(evidence, fit(evidence, []), candidate, briefly=False)
    return fit(evidence, [start.effect])


def test_a_record_with_another_origin_leaves_no_gap_and_no_alias():
    origin = 3.07e-3
    evidence = with_origins(simulate_evidence([SCREW], 0.0, origin, 0.0))
    origins = [observation.origin for observation in evidence.observations]
    assert origins[0] == origins[2] == 0.0
    turns = (origins[1] - origin) / PERIOD_M
    assert turns - np.rint(turns) == pytest.approx(0.0, abs=1e-3)
    assert str(origin_remarks(evidence)[0]).startswith(
        "1 of 3 records use another origin of position"
    )
    result = fit_screw(evidence)
    assert result.effects[0].parameters["period"] == pytest.approx(PERIOD_M, rel=1e-4)
    assert result.cost < 1.5
    # Without origins all records have the same phase.
    assert fit_screw(simulate_evidence([SCREW], 0.0, origin, 0.0)).cost > 20.0


def test_records_with_the_same_origin_are_not_changed():
    evidence = simulate_evidence([SCREW], 0.0, 0.0, 0.0)
    assert with_origins(evidence) is evidence
    assert origin_remarks(evidence) == ()


def test_an_effect_that_is_not_periodic_in_position_gives_no_origin():
    evidence = simulate_evidence([PLAY], 0.0, 3.07e-3, 0.0)
    assert with_origins(evidence) is evidence
