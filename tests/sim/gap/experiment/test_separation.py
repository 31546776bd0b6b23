"""Separation of rivals by a trial."""

import numpy as np
import pytest

from rotemina.sim.gap.experiment.separation import (
    AdaptableRival,
    RivalSimulator,
    compute_fitted_separation,
    compute_linear_separation,
    find_close_rivals,
)
from rotemina.sim.gap.fit import Fit
from rotemina.sim.gap.fit.output_error import Free
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(("farthest_m", "inside"), [(65.5e-6, True), (66.0e-6, False)])
def test_a_trial_that_leaves_the_range_in_a_prediction_is_not_safe(farthest_m, inside):
    simulator = RivalSimulator(ROBOT, "zn", lambda: None)
    assert simulator.stays_in_range({Tap.REF: np.array([30e-6, farthest_m])}) is inside


def make_rival(prediction, information=0.0):
    """Return a rival on two rows, with one parameter that changes the first row."""
    slopes = np.array([[1.0], [0.0]])
    base = np.array(prediction)
    free = Free(0, "error", -100.0, 100.0, 1.0, 0.0)
    effects = (AxisEffect(axis="zn", id="gain_error"),)
    fitted = Fit(effects, (free,), np.zeros(1), np.zeros(2), np.zeros((2, 1)))
    return AdaptableRival(
        fitted, base, slopes, np.array([[information]]), lambda x: base + slopes @ x
    )


def test_only_differences_that_no_parameter_can_adapt_separate_rivals():
    loose, stiff, other = (
        make_rival([0.0, 0.0], 1e-9),
        make_rival([0.0, 0.0], 1e12),
        make_rival([3.0, 4.0], 1e-9),
    )
    assert loose.compute_linear_distance(other) == pytest.approx(16.0)
    assert loose.compute_fitted_distance(other) == pytest.approx(16.0)
    assert stiff.compute_linear_distance(other) == pytest.approx(25.0)
    assert stiff.compute_fitted_distance(other) == pytest.approx(25.0)
    assert compute_linear_separation([loose, other], 1) == pytest.approx(4.0)
    assert compute_fitted_separation([loose, other], 1) == pytest.approx(4.0)
    assert find_close_rivals([loose, other, make_rival([3.0, 4.1], 1e-9)], 1, 0.5) == [1, 2]


def test_a_more_general_rival_is_separated_by_its_additional_outputs():
    simple, richer = make_rival([0.0, 0.0], 1e12), make_rival([3.0, 0.0], 1e-9)
    assert richer.compute_linear_distance(simple) == pytest.approx(0.0, abs=1e-6)
    assert (
        compute_linear_separation([simple, richer], 1)
        == compute_fitted_separation([simple, richer], 1)
        == pytest.approx(3.0)
    )
