"""How well effects fit randomly drawn remainders."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.compare import Selection, cause_contest, explain, untouched
from rotemina.sim.gap.compare.random_remainders import RandomRemainders
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.limits import MAX_P_VALUE
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
CURVE = AxisEffect(axis="zn", id="static_nonlinearity", parameters={"bow": 0.02, "s_shape": 0.01})
DELAY = AxisEffect(axis="zn", id="delay", parameters={"delay": 1e-3})
GAIN = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.02})


def make_evidence(*effects, wave=0.0):
    """Return evidence of two random motions over most of the range.

    The axis deviates by waves over position and speed, with an amplitude of ``wave`` of its range.
    """
    axis = ROBOT.axes["zn"]
    rng = np.random.default_rng(0)
    time_s = 1e-3 * np.arange(1500)
    records = []
    for _ in range(2):
        steps = rng.normal(size=8) @ np.sin(np.outer(np.arange(1, 9), 2.0 * np.pi * time_s / 1.5))
        swing = 0.4 * axis.span * steps / np.abs(steps).max()
        commands = Record.from_signals(
            time_s, {("zn", Tap.CMD): sum(axis.range) / 2 + swing}, {"zn": axis.unit}
        )
        record = simulate(ROBOT, effects, commands, rng)
        position = record.signal("zn", Tap.REF) / axis.span
        # In units of the range per 0.3 s.
        speed = 0.3 * np.gradient(position, 1e-3)
        deviation = (
            wave * axis.span * (np.cos(6.0 * position) + 0.7 * np.cos(2.0 * position + speed))
        )
        is_moved = [column.tap in (Tap.REF, Tap.MEAS) for column in record.columns]
        records.append(replace(record, values=record.values + np.outer(deviation, is_moved)))
    return Evidence.of(ROBOT, "zn", records)


@pytest.fixture(scope="module")
def nonlinear_and_late():
    evidence = make_evidence(CURVE, DELAY)
    return evidence, explain(evidence, [CURVE, DELAY])


def test_a_curve_fits_many_unknown_remainders_and_a_delay_does_not(nonlinear_and_late):
    evidence, best = nonlinear_and_late
    remainders = RandomRemainders(evidence)
    assert remainders.p_value(best, (CURVE.id, None), 0.6) > MAX_P_VALUE
    assert remainders.p_value(best, (DELAY.id, None), 0.6) == 0.0
    # An effect without fitted parameters fits no remainder.
    assert remainders.p_value(best, ("creep", None), 0.0) == 0.0


def test_a_larger_closed_share_is_less_likely_by_chance(nonlinear_and_late):
    evidence, best = nonlinear_and_late
    levels, levels_again = (
        [
            RandomRemainders(evidence).p_value(best, (CURVE.id, None), share)
            for share in (0.0, 0.5, 1.0)
        ]
        for _ in range(2)
    )
    assert levels == levels_again == sorted(levels, reverse=True)
    assert (levels[0], levels[-1]) == (1.0, 0.0)


def test_if_only_the_effort_was_recorded_it_contains_the_remainder(nonlinear_and_late):
    evidence, _ = nonlinear_and_late
    efforts = [
        replace(
            observation,
            real={Tap.U: observation.real[Tap.REF]},
            floor={Tap.U: observation.floor[Tap.REF]},
        )
        for observation in evidence.observations
    ]
    effort_evidence = evidence.with_observations(efforts)
    assert (
        np.ptp(RandomRemainders(effort_evidence)._seen(RandomRemainders(effort_evidence)._drawn[0]))
        > 0.0
    )


@pytest.mark.parametrize("step_s", [10.0, 1e-5])
def test_slow_and_fast_records_have_remainders_too(nonlinear_and_late, step_s):
    evidence, best = nonlinear_and_late
    records = [
        replace(
            observation,
            record=replace(observation.record, time_s=step_s / 1e-3 * observation.record.time_s),
        )
        for observation in evidence.observations
    ]
    remainders = RandomRemainders(evidence.with_observations(records))
    assert 0.0 <= remainders.p_value(best, (CURVE.id, None), 0.6) <= 1.0
    assert all(
        np.isfinite(motion).all() for remainder in remainders._drawn for _, motion in remainder
    )


@pytest.mark.parametrize(
    ("effects", "wave", "named"),
    [
        ([DELAY], 1e-3, {DELAY.id}),  # The curve has fitted the wave.
        ([CURVE, DELAY], 0.0, {CURVE.id, DELAY.id}),  # There is no other remainder.
        ([replace(CURVE, parameters={"bow": 0.1})], 1e-3, {CURVE.id}),  # Far more than a remainder.
        ([GAIN], 1e-3, {GAIN.id}),  # A gain and a remainder are not a curve.
    ],
)
def test_a_curve_is_named_next_to_a_remainder_if_it_explains_more(
    monkeypatch, effects, wave, named
):
    evidence = make_evidence(*effects, wave=wave)
    without_causes = explain(evidence, [])
    best = explain(evidence, [CURVE, DELAY] if DELAY in effects else [CURVE])
    monkeypatch.setattr(cause_contest, "rivals_of", lambda *_: {})
    explanation, _ = cause_contest._significant(
        evidence,
        Selection(untouched(evidence), without_causes, best, ()),
        best,
        {},
        {},
        {},
        alone=True,
    )
    assert {name for name, _ in explanation.ids} == named


def test_an_axis_that_was_only_held_has_remainders_too():
    axis = ROBOT.axes["zn"]
    time_s = 1e-3 * np.arange(500)
    signals = {("zn", Tap.CMD): np.full(500, sum(axis.range) / 2)}
    commands = Record.from_signals(time_s, signals, {"zn": axis.unit})
    evidence = Evidence.of(ROBOT, "zn", [simulate(ROBOT, [], commands, np.random.default_rng(0))])
    drawn_remainders = RandomRemainders(evidence)._drawn
    assert all(
        np.isfinite(motion).all() for remainder in drawn_remainders for _, motion in remainder
    )
