"""A bent characteristic: exact at both ends, with a bow and a cubic part between them."""

import numpy as np
import pytest

from rotemina.sim.effects import AxisProperties
from rotemina.sim.effects.sensor_nonlinearity import SENSOR_NONLINEARITY, add_bow_and_cubic
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
FORMULATION = SENSOR_NONLINEARITY.formulations[0]


def compute_error(axis, bow, cubic, positions):
    """Return the error at shares of the range, as a share of it."""
    properties = AxisProperties.of(axis)
    p = FORMULATION.compute_numbers(
        {"bow": bow * properties.span, "cubic": cubic * properties.span}, properties
    )
    positions_si = properties.low + properties.span * np.asarray(positions)
    reading = np.array([add_bow_and_cubic(x, x, 0.0, 1e-3, 0.0, 0.0, p, []) for x in positions_si])
    return (reading - positions_si) / properties.span


@pytest.mark.parametrize("name", ["x", "thx"])
@pytest.mark.parametrize(("bow", "cubic"), [(0.01, 0.0), (0.0, 0.01), (-0.05, 0.1)])
def test_the_error_is_zero_at_both_ends(name, bow, cubic):
    np.testing.assert_allclose(
        compute_error(ROBOT.axes[name], bow, cubic, [0.0, 1.0]), 0.0, atol=1e-15
    )


def test_the_bow_is_even_and_largest_in_mid_range():
    shares = np.linspace(0, 1, 201)
    error = compute_error(ROBOT.axes["thx"], 0.01, 0.0, shares)
    assert error.max() == pytest.approx(0.01, rel=1e-12)
    assert np.argmax(error) == 100
    np.testing.assert_allclose(error, error[::-1], atol=1e-15)


def test_the_cubic_part_is_odd_and_has_its_size():
    shares = np.linspace(0, 1, 20001)
    error = compute_error(ROBOT.axes["thx"], 0.0, 0.01, shares)
    assert error.max() == pytest.approx(0.01, rel=1e-7)
    np.testing.assert_allclose(error, -error[::-1], atol=1e-15)
    assert 2 * shares[np.argmax(error)] - 1 == pytest.approx(1 / np.sqrt(3), abs=1e-3)
