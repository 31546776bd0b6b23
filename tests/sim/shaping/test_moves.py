"""Moves from rest to rest: exact lengths and durations, limits, and refused tables."""

import numpy as np
import pytest

from rotemina.sim.errors import ShapingError
from rotemina.sim.shaping import (
    MotionLimits,
    interpolate_table,
    make_minimum_jerk,
    make_s_curve,
    make_shortest_minimum_jerk,
)

STROKE = 50e-6


def is_at_rest_at_both_ends(shape):
    speed = shape.polynomial.derivative()
    return np.allclose(speed([0.0, shape.duration_s]), 0.0, atol=1e-12 * shape.max_magnitude(1))


def test_an_s_curve_cruises_between_its_ramps():
    shape = make_s_curve(STROKE, 0.09, ramp=0.3, rounding=0.5)
    assert shape.duration_s == pytest.approx(0.09, rel=1e-12)
    assert shape.max_magnitude(1) == pytest.approx(STROKE / (0.7 * 0.09), rel=1e-12)
    assert shape.extremes() == (pytest.approx(0.0, abs=1e-18), pytest.approx(STROKE))
    assert np.diff(shape.breaks_s)[3] == pytest.approx(0.4 * 0.09)


def test_a_minimum_jerk_move_is_the_quintic():
    shape = make_minimum_jerk(STROKE, 0.09)
    share = np.linspace(0.0, 1.0, 11)
    expected = STROKE * share**3 * (10 - 15 * share + 6 * share**2)
    np.testing.assert_allclose(shape.position(0.09 * share), expected, atol=1e-18)
    assert shape.max_magnitude(1) == pytest.approx(15 / 8 * shape.average_speed)
    assert shape.max_magnitude(2) == pytest.approx(10 / np.sqrt(3) * STROKE / 0.09**2)
    assert shape.position(np.array([-1.0, 5.0])).tolist() == [0.0, shape.length]


@pytest.mark.parametrize(
    "limits",
    [MotionLimits(speed=1e-3), MotionLimits(acceleration=0.05), MotionLimits(jerk=4.0)],
)
def test_the_shortest_minimum_jerk_move_reaches_its_limit(limits):
    shape = make_shortest_minimum_jerk(STROKE, limits)
    ratios = [
        shape.max_magnitude(order) / limit
        for order, limit in enumerate((limits.speed, limits.acceleration, limits.jerk), 1)
    ]
    assert max(ratios) == pytest.approx(1.0, rel=1e-9)


def test_fifty_micrometres_take_less_than_100_ms_within_the_limits_of_a_piezo():
    limits = MotionLimits(speed=1e-3, acceleration=0.1, jerk=20.0)
    assert make_shortest_minimum_jerk(STROKE, limits).duration_s < 0.1


def test_an_interpolated_table_passes_all_rows_without_overshoot():
    times, positions = [0.0, 0.03, 0.05, 0.09], [0.0, 1e-5, 1e-5, 5e-5]
    shape = interpolate_table(times, positions)
    np.testing.assert_allclose(shape.position(np.array(times)), positions, atol=1e-20)
    assert shape.extremes(1)[0] >= -1e-18
    assert shape.position(np.array([0.04])) == pytest.approx(1e-5)
    assert is_at_rest_at_both_ends(shape)
    assert interpolate_table([0.0, 1.0], [0.0, 1.0]).position(np.array([0.5])) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("times", "positions", "message"),
    [
        ([0.0, 1.0, 1.0], [0.0, 0.5, 1.0], "row 3: 1 s"),
        ([0.0, float("nan"), 1.0], [0.0, 0.5, 1.0], "row 2"),
        ([0.0, 0.5, 1.0], [0.0, float("inf"), 1.0], "row 2"),
        ([0.1, 1.0], [0.0, 1.0], "row 1"),
        ([0.0, 1.0], [0.5, 1.0], "row 1"),
        ([0.0, 0.5, 1.0], [0.0, 1.0, 0.0], "row 3: it ends where it began"),
        ([0.0], [0.0], "2 to 1000"),
        ([0.0, 1.0], [0.0], "both numbers must be equal"),
    ],
)
def test_a_bad_table_is_refused_with_its_row(times, positions, message):
    with pytest.raises(ShapingError, match=message):
        interpolate_table(times, positions)


@pytest.mark.parametrize(
    "make",
    [
        lambda: make_s_curve(0.0, 1.0),
        lambda: make_s_curve(float("nan"), 1.0),
        lambda: MotionLimits(speed=0.0),
        lambda: MotionLimits(jerk=float("nan")),
        lambda: make_s_curve(1.0, 0.0),
        lambda: make_s_curve(1.0, 1.0, ramp=0.6),
        lambda: make_s_curve(1.0, 1.0, rounding=0.0),
        lambda: make_minimum_jerk(1.0, float("inf")),
        lambda: make_shortest_minimum_jerk(1.0, MotionLimits()),
    ],
)
def test_invalid_moves_are_refused(make):
    with pytest.raises(ShapingError):
        make()
