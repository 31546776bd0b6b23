"""Moves as a few cubics: exact where they can be, and the error that is stated is the error."""

import numpy as np
import pytest

from rotemina.sim.shaping.cubic_segments import as_cubics
from rotemina.sim.shaping.errors import ShapingError
from rotemina.sim.shaping.impulses import shaped, zero_vibration
from rotemina.sim.shaping.move_shape import Shape
from rotemina.sim.shaping.moves import minimum_jerk, s_curve_in, tabled

STROKE = 50e-6


def seen_error(fit, shape):
    time_s = np.linspace(0.0, shape.duration_s, 20_001)
    return np.abs(fit.shape.position(time_s) - shape.position(time_s)).max()


def test_a_move_of_few_cubics_is_itself():
    shape = shaped(s_curve_in(STROKE, 0.09), zero_vibration(420.0, 0.025))
    fit = as_cubics(shape, 16, 1e-12)
    assert fit.shape is shape
    assert fit.error == 0.0


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("make", [minimum_jerk, s_curve_in])
def test_a_shaped_move_in_sixteen_cubics_is_within_a_nanometre(make, order):
    shape = shaped(make(STROKE, 0.09), zero_vibration(420.0, 0.025, order))
    fit = as_cubics(shape, 16, 1e-9)
    assert fit.shape.coefficients.shape[1] <= 16
    assert fit.shape.coefficients.shape[0] == 4
    assert seen_error(fit, shape) <= fit.error * (1 + 1e-6) + 1e-19
    assert fit.shape.jump(0) < 1e-18
    assert fit.shape.jump(1) < 1e-12
    assert fit.shape.length == pytest.approx(shape.length, rel=1e-12)


def test_the_error_of_one_cubic_for_a_quintic_is_known():
    # Hermite's error on one piece: max |x⁗| h⁴/384 is a bound; the exact one is found.
    fit = as_cubics(minimum_jerk(1.0, 1.0), 1, 1.0)
    share = np.linspace(0.0, 1.0, 100_001)
    expected = share**3 * (10 - 15 * share + 6 * share**2) - share**2 * (3 - 2 * share)
    assert fit.error == pytest.approx(np.abs(expected).max(), rel=1e-6)


def test_more_pieces_are_fourth_order_better():
    errors = [as_cubics(minimum_jerk(1.0, 1.0), pieces, 1.0).error for pieces in (4, 8, 16)]
    assert errors[0] / errors[1] > 10
    assert errors[1] / errors[2] > 10


def test_what_cannot_be_met_is_refused_with_the_error_left():
    rng = np.random.default_rng(3)
    rows = np.sort(rng.uniform(0.0, 1.0, 200))
    rough = tabled(np.arange(202.0), np.concatenate([[0.0], rows, [1.0]]))
    with pytest.raises(ShapingError, match="16 cubics leave an error"):
        as_cubics(rough, 16, 1e-6)


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
def test_what_is_no_shape_is_refused(breaks, coefficients):
    with pytest.raises(ShapingError):
        Shape(np.array(breaks), coefficients)
