"""When what a cause closes counts: shares of the gap, of what is left, of what was set aside."""

from types import SimpleNamespace

import pytest

from rotemina.sim.gap.repeats import has_overtone, is_own_mode
from rotemina.sim.gap.selection import (
    SEEN,
    _enters,
    _is_bent_to,
    _is_enough,
    _twins,
)
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

LAG, LOOP, CURVE = (
    SimpleNamespace(id=name) for name in ("amplifier_lag", "hysteresis", "sensor_nonlinearity")
)


def left(meas, *causes):
    return SimpleNamespace(by_tap={Tap.MEAS: meas}, causes=causes)


@pytest.mark.parametrize(
    ("before", "after", "counts"),
    [
        (left(2000.0), left(60.0, LAG), True),
        (left(70.0, LAG), left(6.0, LAG, LAG), True),  # 3 % of the gap
        (left(50.0, LAG), left(1.0, LAG, LAG), True),  # all that is left, seven floors of it
        (left(50.0, LAG), left(35.0, LAG, LAG), False),  # less than what then remains
        (left(8.0, LAG), left(1.0, LAG, LAG), False),  # less than three floors
        (left(50.0, CURVE), left(1.0, LOOP, CURVE), False),  # which the loop brings along
        (left(50.0), left(30.0, LAG), False),
        (left(15.0), left(1.0, LAG), True),  # what no re-tuning does
        (left(1.5), left(1.0, LAG), False),
    ],
)
def test_beside_others_a_cause_closes_a_share_of_the_gap(before, after, counts):
    assert _enters(left(2000.0), {}, False, SEEN, before, after) is counts


def test_one_record_vouches_for_no_small_cause_beside_another():
    before, after = left(50.0, LAG), left(1.0, LAG, LAG)
    assert _enters(left(2000.0), {}, False, SEEN, before, after)
    assert not _enters(left(2000.0), {}, False, float("inf"), before, after)


def test_what_was_set_aside_may_leave_something_of_itself():
    before, after = left(60.0), left(20.0, LAG)
    assert _enters(left(60.0), {Tap.MEAS: 1000.0}, False, SEEN, before, after)
    assert not _enters(left(60.0), {Tap.MEAS: 10_000.0}, False, SEEN, before, after)


@pytest.mark.parametrize(
    ("ref", "meas", "enough"),
    [
        (9.0, 9.0, True),
        (90.0, 9.0, False),  # nine floors, whatever share of the gap
        (400.0, 9.0, False),  # of the reference's gap, that another cause may close
        (150.0, 25.0, False),  # a few hundredths in all, that others may correct
        (90.0, 31.0, False),  # of the sensor's, which is the smaller one
    ],
)
def test_no_more_is_looked_for_where_no_cause_can_close_its_share(ref, meas, enough):
    def both(ref, meas):
        taps = {Tap.REF: ref, Tap.MEAS: meas}
        return SimpleNamespace(by_tap=taps, score=(ref + meas) / 2.0)

    assert _is_enough(both(10_000.0, 1000.0), both(ref, meas), SEEN) is enough


def alone(name, score, formulation=None):
    cause = AxisEffect(axis="thx", id=name, formulation=formulation)
    return SimpleNamespace(ids=((name, None),), causes=(cause,), score=score)


def test_what_alone_did_as_well_takes_a_causes_place_beside_others():
    lag, late, drift = alone("amplifier_lag", 300.0), alone("delay", 320.0), alone("creep", 500.0)
    bare = SimpleNamespace(score=1000.0)
    pair = SimpleNamespace(ids=(("amplifier_lag", None), ("cross_coupling", "thy")))
    found = _twins(lag.causes[0], bare, pair, [lag, late, drift])
    assert [one.id for one in found] == ["delay"]
    weak = SimpleNamespace(score=310.0)  # of which neither closes much
    assert _twins(lag.causes[0], weak, pair, [lag, late, drift]) == []


@pytest.mark.parametrize(("frequency_hz", "own"), [(302.0, True), (340.0, False)])
def test_a_mode_at_the_axis_own_resonance_is_no_further_one(frequency_hz, own):
    mode = AxisEffect(axis="thx", id="flexible_mode", parameters={"frequency": frequency_hz})
    tuned = AxisEffect(axis="thx", id="resonance_mismatch", parameters={"frequency_error": 0.0})
    evidence = SimpleNamespace(robot=load_robot("rotemina"), axis="thx")
    one = SimpleNamespace(causes=(mode,), fit=SimpleNamespace(effects=(mode, tuned)))
    assert is_own_mode(evidence, one, one) is own


@pytest.mark.parametrize(
    ("second", "period", "with_ref", "overtone"),
    [
        ("encoder_interpolation", 1.0005e-3 / 3, False, True),
        ("encoder_interpolation", 1.0005e-3 / 3, True, False),
        ("microstep_error", 1e-3 / 5, True, True),
        ("encoder_interpolation", 1.03e-3 / 3, False, False),
        ("encoder_interpolation", 1e-3 / 50, False, False),
    ],
)
def test_what_repeats_a_few_times_a_period_is_a_harmonic(second, period, with_ref, overtone):
    evidence = SimpleNamespace(has=lambda tap: with_ref)
    causes = [
        AxisEffect(axis="x", id="leadscrew_error", parameters={"period": 1e-3}),
        AxisEffect(axis="x", id=second, parameters={"period": period}),
    ]
    assert has_overtone(evidence, SimpleNamespace(causes=causes)) is overtone


@pytest.mark.parametrize(
    ("curve", "other", "left", "bent"),
    [
        ("static_nonlinearity", "contact", 30.0, True),
        ("sensor_nonlinearity", "contact", 30.0, True),
        ("saturation", "contact", 30.0, True),
        ("static_nonlinearity", "contact", 90.0, False),  # a bow that no stop makes
        ("static_nonlinearity", "hysteresis", 30.0, False),
        ("hysteresis", "contact", 30.0, False),
    ],
)
def test_a_curve_that_explains_a_gap_may_but_follow_a_soft_contact(curve, other, left, bent):
    def alone(name, cost):
        effect = AxisEffect(axis="y", id=name)
        return SimpleNamespace(
            causes=(effect,), ids=((name, None),), fit=SimpleNamespace(cost=cost)
        )

    best, begun = alone(curve, 1.2), SimpleNamespace(fit=SimpleNamespace(cost=220.0))
    slow = AxisEffect(axis="y", id=other, formulation="progressive")
    assert _is_bent_to(best, slow, begun, [best, alone(other, left)]) is bent
