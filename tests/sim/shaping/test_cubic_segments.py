"""Moves as a few cubics: exact if possible, and with the correct stated error."""

import numpy as np
import pytest

from rotemina.sim.errors import ShapingError
from rotemina.sim.shaping import (
    MoveShape,
    apply_shaper,
    fit_cubics,
    interpolate_table,
    make_minimum_jerk,
    make_s_curve,
    make_zero_vibration_shaper,
)

STROKE = 50e-6


def measure_error(fit, shape):
    time_s = np.linspace(0.0, shape.duration_s, 20_001)
    return np.abs(fit.shape.position(time_s) - shape.position(time_s)).max()


def test_a_move_of_few_cubics_is_not_changed():
    shape = apply_shaper(make_s_curve(STROKE, 0.09), make_zero_vibration_shaper(420.0, 0.025))
    fit = fit_cubics(shape, 16, 1e-12)
    assert fit.shape is shape
    assert fit.error == 0.0


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("make_move", [make_minimum_jerk, make_s_curve])
def test_a_shaped_move_in_sixteen_cubics_is_within_a_nanometre(make_move, order):
    shape = apply_shaper(make_move(STROKE, 0.09), make_zero_vibration_shaper(420.0, 0.025, order))
    fit = fit_cubics(shape, 16, 1e-9)
    assert fit.shape.coefficients.shape[1] <= 16
    assert fit.shape.coefficients.shape[0] == 4
    assert measure_error(fit, shape) <= fit.error * (1 + 1e-6) + 1e-19
    assert fit.shape.max_jump(0) < 1e-18
    assert fit.shape.max_jump(1) < 1e-12
    assert fit.shape.length == pytest.approx(shape.length, rel=1e-12)


def test_the_error_of_one_cubic_for_a_quintic_is_exact():
    # Hermite's bound on one piece is max |x⁗| h⁴/384, but the fit gives the exact error.
    fit = fit_cubics(make_minimum_jerk(1.0, 1.0), 1, 1.0)
    share = np.linspace(0.0, 1.0, 100_001)
    expected = share**3 * (10 - 15 * share + 6 * share**2) - share**2 * (3 - 2 * share)
    assert fit.error == pytest.approx(np.abs(expected).max(), rel=1e-6)


def test_the_error_falls_with_the_fourth_order_of_the_pieces():
    errors = [fit_cubics(make_minimum_jerk(1.0, 1.0), pieces, 1.0).error for pieces in (4, 8, 16)]
    assert errors[0] / errors[1] > 10
    assert errors[1] / errors[2] > 10


def test_a_tolerance_that_cannot_be_met_is_refused_with_the_error():
    rng = np.random.default_rng(3)
    rows = np.sort(rng.uniform(0.0, 1.0, 200))
    rough = interpolate_table(np.arange(202.0), np.concatenate([[0.0], rows, [1.0]]))
    with pytest.raises(ShapingError, match="16 cubics leave an error"):
        fit_cubics(rough, 16, 1e-6)


@pytest.mark.parametrize(
    ("breaks", "coefficients"),
    [
        ([0.0, 1.0], np.zeros((4, 2))),
        ([0.0, 0.0], np.zeros((4, 1))),
        ([0.1, 1.0], np.zeros((4, 1))),
        ([0.0, 1.0], np.full((4, 1), np.nan)),
        ([0.0], np.zeros((4, 0))),
    ],
)
def test_invalid_shapes_are_refused(breaks, coefficients):
    with pytest.raises(ShapingError):
        MoveShape(np.array(breaks), coefficients)
