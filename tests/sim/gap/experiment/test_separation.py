"""How far rivals part on a trial."""

import numpy as np
import pytest

from rotemina.sim.gap.experiment.separation import Player, Yielding, alike, apart, apart_by_fit
from rotemina.sim.gap.fit.output_error import Fit, Free
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(("farthest_m", "inside"), [(65.5e-6, True), (66.0e-6, False)])
def test_a_test_that_a_rival_says_leaves_the_range_is_not_safe(farthest_m, inside):
    player = Player(ROBOT, "zn", lambda: None)
    assert player.stays_inside({Tap.REF: np.array([30e-6, farthest_m])}) is inside


def rival(answer, know=0.0):
    """A rival of one parameter, on two rows, which moves the first of them."""
    slopes = np.array([[1.0], [0.0]])
    own = np.array(answer)
    free = Free(0, "error", -100.0, 100.0, 1.0, 0.0)
    effects = (AxisEffect(axis="zn", id="gain_error"),)
    fitted = Fit(effects, (free,), np.zeros(1), np.zeros(2), np.zeros((2, 1)))
    return Yielding(fitted, own, slopes, np.array([[know]]), lambda x: own + slopes @ x)


def test_rivals_part_only_by_what_neither_can_take_up():
    loose, stiff, other = rival([0.0, 0.0], 1e-9), rival([0.0, 0.0], 1e12), rival([3.0, 4.0], 1e-9)
    assert loose.left_of(other) == pytest.approx(16.0)
    assert loose.left_by_fit_of(other) == pytest.approx(16.0)
    assert stiff.left_of(other) == pytest.approx(25.0)
    assert stiff.left_by_fit_of(other) == pytest.approx(25.0)
    assert apart([loose, other], 1) == pytest.approx(4.0)
    assert apart_by_fit([loose, other], 1) == pytest.approx(4.0)
    assert alike([loose, other, rival([3.0, 4.1], 1e-9)], 1, 0.5) == [1, 2]


def test_a_rival_that_can_be_what_another_is_is_told_by_what_it_alone_can_be():
    simple, richer = rival([0.0, 0.0], 1e12), rival([3.0, 0.0], 1e-9)
    assert richer.left_of(simple) == pytest.approx(0.0, abs=1e-6)
    assert apart([simple, richer], 1) == apart_by_fit([simple, richer], 1) == pytest.approx(3.0)
