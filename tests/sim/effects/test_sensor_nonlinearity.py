"""A bent characteristic: right at both ends, with the asked bow and cubic part between."""

import numpy as np
import pytest

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.sensor_nonlinearity import SENSOR_NONLINEARITY, bowed
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
FORMULATION = SENSOR_NONLINEARITY.formulations[0]


def error(axis, bow, cubic, positions):
    """The error at shares of the range."""
    facts = Facts.of(axis)
    p = FORMULATION.numbers({"bow": bow * facts.span, "cubic": cubic * facts.span}, facts)
    at = facts.low + facts.span * np.asarray(positions)
    read = np.array([bowed(x, x, 0.0, 1e-3, 0.0, 0.0, p, []) for x in at])
    return (read - at) / facts.span


@pytest.mark.parametrize("name", ["x", "thx"])
@pytest.mark.parametrize(("bow", "cubic"), [(0.01, 0.0), (0.0, 0.01), (-0.05, 0.1)])
def test_both_ends_of_the_range_are_right(name, bow, cubic):
    np.testing.assert_allclose(error(ROBOT.axes[name], bow, cubic, [0.0, 1.0]), 0.0, atol=1e-15)


def test_the_bow_is_greatest_in_mid_range_and_even():
    shares = np.linspace(0, 1, 201)
    bent = error(ROBOT.axes["thx"], 0.01, 0.0, shares)
    assert bent.max() == pytest.approx(0.01, rel=1e-12)
    assert np.argmax(bent) == 100
    np.testing.assert_allclose(bent, bent[::-1], atol=1e-15)


def test_the_cubic_part_is_odd_and_as_great_as_asked():
    shares = np.linspace(0, 1, 20001)
    bent = error(ROBOT.axes["thx"], 0.0, 0.01, shares)
    assert bent.max() == pytest.approx(0.01, rel=1e-7)
    np.testing.assert_allclose(bent, -bent[::-1], atol=1e-15)
    assert 2 * shares[np.argmax(bent)] - 1 == pytest.approx(1 / np.sqrt(3), abs=1e-3)
