"""How far effects follow remainders that were drawn by chance."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.gap.compare import cause_contest
from rotemina.sim.gap.compare.explanations import explain, untouched
from rotemina.sim.gap.compare.forward_selection import Selection
from rotemina.sim.gap.compare.random_remainders import RandomRemainders
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.thresholds import SIGNIFICANCE
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
CURVE = AxisEffect(axis="zn", id="static_nonlinearity", parameters={"bow": 0.02, "s_shape": 0.01})
LATE = AxisEffect(axis="zn", id="delay", parameters={"delay": 1e-3})


def machine(*effects, wave=0.0):
    """Return evidence of two wandering motions over most of the range.

    The axis strays by waves of place and speed, ``wave`` of its range in size.
    """
    own = ROBOT.axes["zn"]
    rng = np.random.default_rng(0)
    time_s = 1e-3 * np.arange(1500)
    records = []
    for _ in range(2):
        steps = rng.normal(size=8) @ np.sin(np.outer(np.arange(1, 9), 2.0 * np.pi * time_s / 1.5))
        swing = 0.4 * own.span * steps / np.abs(steps).max()
        commands = Record.from_signals(
            time_s, {("zn", Tap.CMD): sum(own.range) / 2 + swing}, {"zn": own.unit}
        )
        record = simulate(ROBOT, effects, commands, rng)
        place = record.signal("zn", Tap.REF) / own.span
        pace = 0.3 * np.gradient(place, 1e-3)  # of the range in 0.3 s
        strayed = wave * own.span * (np.cos(6.0 * place) + 0.7 * np.cos(2.0 * place + pace))
        moved = [one.tap in (Tap.REF, Tap.MEAS) for one in record.columns]
        records.append(replace(record, values=record.values + np.outer(strayed, moved)))
    return Evidence.of(ROBOT, "zn", records)


@pytest.fixture(scope="module")
def bent():
    seen = machine(CURVE, LATE)
    return seen, explain(seen, [CURVE, LATE])


def test_a_curve_bends_to_much_of_what_no_catalogue_holds_and_a_delay_does_not(bent):
    seen, best = bent
    remainders = RandomRemainders(seen)
    assert remainders.p_value(best, (CURVE.id, None), 0.6) > SIGNIFICANCE
    assert remainders.p_value(best, (LATE.id, None), 0.6) == 0.0


def test_the_more_is_closed_the_less_likely_it_is_by_chance(bent):
    seen, best = bent
    levels = [
        RandomRemainders(seen).p_value(best, (CURVE.id, None), share) for share in (0.0, 0.5, 0.9)
    ]
    assert levels == sorted(levels, reverse=True)
    assert levels[0] == 1.0
    assert RandomRemainders(seen).p_value(best, (CURVE.id, None), 1.0) == 0.0
    assert [
        RandomRemainders(seen).p_value(best, (CURVE.id, None), x) for x in (0.0, 0.5, 0.9)
    ] == levels


def test_where_the_effort_alone_was_recorded_a_remainder_is_part_of_it(bent):
    seen, _ = bent
    efforts = [
        replace(own, real={Tap.U: own.real[Tap.REF]}, floor={Tap.U: own.floor[Tap.REF]})
        for own in seen.observations
    ]
    only = seen.with_observations(efforts)
    assert np.ptp(RandomRemainders(only)._seen(RandomRemainders(only)._drawn[0])) > 0.0


def test_what_has_no_number_of_its_own_follows_nothing(bent):
    seen, best = bent
    assert RandomRemainders(seen).p_value(best, ("creep", None), 0.0) == 0.0


@pytest.mark.parametrize("step_s", [10.0, 1e-5])
def test_slow_and_fast_records_have_remainders_too(bent, step_s):
    seen, best = bent
    records = [
        replace(own, record=replace(own.record, time_s=step_s / 1e-3 * own.record.time_s))
        for own in seen.observations
    ]
    remainders = RandomRemainders(seen.with_observations(records))
    assert 0.0 <= remainders.p_value(best, (CURVE.id, None), 0.6) <= 1.0
    assert all(np.isfinite(moved).all() for one in remainders._drawn for _, moved in one)


@pytest.mark.parametrize(
    ("effects", "wave", "named"),
    [
        ([LATE], 1e-3, {LATE.id}),  # the curve has bent to the wave
        ([CURVE, LATE], 0.0, {CURVE.id, LATE.id}),  # nothing else is left that it may follow
        ([replace(CURVE, parameters={"bow": 0.1})], 1e-3, {CURVE.id}),  # far more than a remainder
    ],
)
def test_a_curve_beside_a_remainder_is_named_if_it_does_more(monkeypatch, effects, wave, named):
    seen = machine(*effects, wave=wave)
    alone = explain(seen, [])
    best = explain(seen, [CURVE, LATE] if LATE in effects else [CURVE])
    monkeypatch.setattr(cause_contest, "rivals_of", lambda *_: {})
    found, _ = cause_contest._significant(
        seen, Selection(untouched(seen), alone, best, ()), best, {}, {}, {}, alone=True
    )
    assert {name for name, _ in found.ids} == named


def test_an_axis_that_was_only_held_has_remainders_too():
    own = ROBOT.axes["zn"]
    time_s = 1e-3 * np.arange(500)
    held = {("zn", Tap.CMD): np.full(500, sum(own.range) / 2)}
    commands = Record.from_signals(time_s, held, {"zn": own.unit})
    seen = Evidence.of(ROBOT, "zn", [simulate(ROBOT, [], commands, np.random.default_rng(0))])
    drawn = RandomRemainders(seen)._drawn
    assert all(np.isfinite(moved).all() for one in drawn for _, moved in one)


def test_a_gain_and_a_remainder_are_no_curve(monkeypatch):
    gain = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.02})
    seen = machine(gain, wave=1e-3)
    bare, alone, best = untouched(seen), explain(seen, []), explain(seen, [CURVE])
    monkeypatch.setattr(cause_contest, "rivals_of", lambda *_: {})
    found, _ = cause_contest._significant(
        seen, Selection(bare, alone, best, ()), best, {}, {}, {}, alone=True
    )
    assert found.ids == (("gain_error", None),)
