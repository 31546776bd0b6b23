"""Moves from rest to rest: exact lengths and durations, limits met with equality, bad tables."""

import numpy as np
import pytest

from rotemina.sim.shaping.errors import ShapingError
from rotemina.sim.shaping.moves import (
    MotionLimits,
    minimum_jerk,
    s_curve_in,
    shortest_minimum_jerk,
    tabled,
)

STROKE = 50e-6


def rests_at_both_ends(shape):
    speed = shape.polynomial.derivative()
    return np.allclose(speed([0.0, shape.duration_s]), 0.0, atol=1e-12 * shape.greatest(1))


def test_an_s_curve_of_a_given_time_cruises_between_its_ramps():
    shape = s_curve_in(STROKE, 0.09, ramp=0.3, rounding=0.5)
    assert shape.duration_s == pytest.approx(0.09, rel=1e-12)
    assert shape.greatest(1) == pytest.approx(STROKE / (0.7 * 0.09), rel=1e-12)
    assert shape.extremes() == (pytest.approx(0.0, abs=1e-18), pytest.approx(STROKE))
    assert np.diff(shape.breaks_s)[3] == pytest.approx(0.4 * 0.09)


def test_minimum_jerk_is_the_quintic():
    shape = minimum_jerk(STROKE, 0.09)
    share = np.linspace(0.0, 1.0, 11)
    expected = STROKE * share**3 * (10 - 15 * share + 6 * share**2)
    np.testing.assert_allclose(shape.position(0.09 * share), expected, atol=1e-18)
    assert shape.greatest(1) == pytest.approx(15 / 8 * shape.average_speed)
    assert shape.greatest(2) == pytest.approx(10 / np.sqrt(3) * STROKE / 0.09**2)
    assert shape.position(np.array([-1.0, 5.0])).tolist() == [0.0, shape.length]


@pytest.mark.parametrize(
    "limits",
    [MotionLimits(speed=1e-3), MotionLimits(acceleration=0.05), MotionLimits(jerk=4.0)],
)
def test_the_shortest_minimum_jerk_meets_its_limit(limits):
    shape = shortest_minimum_jerk(STROKE, limits)
    met = [
        shape.greatest(order) / most
        for order, most in enumerate((limits.speed, limits.acceleration, limits.jerk), 1)
    ]
    assert max(met) == pytest.approx(1.0, rel=1e-9)


def test_fifty_micrometres_take_less_than_100_ms_within_the_limits_of_a_piezo():
    limits = MotionLimits(speed=1e-3, acceleration=0.1, jerk=20.0)
    assert shortest_minimum_jerk(STROKE, limits).duration_s < 0.1


def test_a_table_is_met_row_by_row_and_turns_nowhere_between():
    times, places = [0.0, 0.03, 0.05, 0.09], [0.0, 1e-5, 1e-5, 5e-5]
    shape = tabled(times, places)
    np.testing.assert_allclose(shape.position(np.array(times)), places, atol=1e-20)
    assert shape.extremes(1)[0] >= -1e-18
    assert shape.position(np.array([0.04])) == pytest.approx(1e-5)
    assert rests_at_both_ends(shape)
    assert tabled([0.0, 1.0], [0.0, 1.0]).position(np.array([0.5])) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("times", "places", "message"),
    [
        ([0.0, 1.0, 1.0], [0.0, 0.5, 1.0], "row 3: 1 s"),
        ([0.0, float("nan"), 1.0], [0.0, 0.5, 1.0], "row 2"),
        ([0.0, 0.5, 1.0], [0.0, float("inf"), 1.0], "row 2"),
        ([0.1, 1.0], [0.0, 1.0], "row 1"),
        ([0.0, 1.0], [0.5, 1.0], "row 1"),
        ([0.0, 0.5, 1.0], [0.0, 1.0, 0.0], "row 3: it ends where it began"),
        ([0.0], [0.0], "2 to 1000"),
        ([0.0, 1.0], [0.0], "equally many"),
    ],
)
def test_a_bad_table_is_refused_with_its_row(times, places, message):
    with pytest.raises(ShapingError, match=message):
        tabled(times, places)


@pytest.mark.parametrize(
    "make",
    [
        lambda: s_curve_in(0.0, 1.0),
        lambda: s_curve_in(float("nan"), 1.0),
        lambda: MotionLimits(speed=0.0),
        lambda: MotionLimits(jerk=float("nan")),
        lambda: s_curve_in(1.0, 0.0),
        lambda: s_curve_in(1.0, 1.0, ramp=0.6),
        lambda: s_curve_in(1.0, 1.0, rounding=0.0),
        lambda: minimum_jerk(1.0, float("inf")),
        lambda: shortest_minimum_jerk(1.0, MotionLimits()),
    ],
)
def test_what_is_no_move_is_refused(make):
    with pytest.raises(ShapingError):
        make()
