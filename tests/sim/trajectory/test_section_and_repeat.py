"""Trajectories begun anywhere and repeated: rows, times and refusals."""

import numpy as np
import pytest

from rotemina.sim.records.record import Record, Tap
from rotemina.sim.trajectory.section_and_repeat import part
from rotemina.sim.trajectory.trajectory_excesses import TrajectoryError

TIME_S = np.array([2.0, 2.1, 2.3, 2.6])  # rows are not even, and do not begin at 0
LOOP = Record.from_signals(TIME_S, {("x", Tap.CMD): [0.0, 1e-3, 2e-3, 0.0]}, {"x": "m"})
RAMP = Record.from_signals(TIME_S, {("x", Tap.CMD): [0.0, 1e-3, 2e-3, 3e-3]}, {"x": "m"})


def test_all_of_it_once_is_the_trajectory():
    same = part(LOOP)
    np.testing.assert_array_equal(same.time_s, TIME_S)
    np.testing.assert_array_equal(same.values, LOOP.values)


def test_the_first_pass_begins_anywhere_and_each_pass_joins_the_next():
    made = part(LOOP, begin_s=0.2, times=3)
    np.testing.assert_array_equal(made.values[:, 0], [2e-3, 0.0, 1e-3, 2e-3, 0.0, 1e-3, 2e-3, 0.0])
    np.testing.assert_allclose(np.diff(made.time_s), [0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3])
    assert made.time_s[0] == 2.0


@pytest.mark.parametrize(
    ("trajectory", "asked", "said"),
    [
        (LOOP, {"begin_s": 0.4}, "cannot begin at 0.4 s: must be 0 to 0.3 s"),
        (LOOP, {"begin_s": -0.1}, "must be 0 to"),
        (LOOP, {"begin_s": float("nan")}, "must be 0 to"),
        (LOOP, {"times": 0}, "must be 1 to 1000"),
        (RAMP, {"times": 2}, "axis x ends 3 mm from where it begins"),
    ],
)
def test_what_cannot_be_is_refused_with_its_bound(trajectory, asked, said):
    with pytest.raises(TrajectoryError, match=said):
        part(trajectory, **asked)
