"""Trajectories that start anywhere and repeat: rows, times and refusals."""

import numpy as np
import pytest

from rotemina.sim.errors import TrajectoryError
from rotemina.sim.records import Record, Tap
from rotemina.sim.trajectory import cut_and_repeat

TIME_S = np.array([2.0, 2.1, 2.3, 2.6])  # uneven, and not from 0
LOOP = Record.from_signals(TIME_S, {("x", Tap.CMD): [0.0, 1e-3, 2e-3, 0.0]}, {"x": "m"})
RAMP = Record.from_signals(TIME_S, {("x", Tap.CMD): [0.0, 1e-3, 2e-3, 3e-3]}, {"x": "m"})


def test_one_full_pass_is_the_trajectory():
    result = cut_and_repeat(LOOP)
    np.testing.assert_array_equal(result.time_s, TIME_S)
    np.testing.assert_array_equal(result.values, LOOP.values)


def test_the_first_pass_starts_anywhere_and_each_pass_follows_the_previous():
    result = cut_and_repeat(LOOP, begin_s=0.2, times=3)
    np.testing.assert_array_equal(
        result.values[:, 0], [2e-3, 0.0, 1e-3, 2e-3, 0.0, 1e-3, 2e-3, 0.0]
    )
    np.testing.assert_allclose(np.diff(result.time_s), [0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3])
    assert result.time_s[0] == 2.0


@pytest.mark.parametrize(
    ("trajectory", "options", "message"),
    [
        (LOOP, {"begin_s": 0.4}, "cannot begin at 0.4 s; choose a time from 0 to 0.3 s"),
        (LOOP, {"begin_s": -0.1}, "choose a time from 0 to"),
        (LOOP, {"begin_s": float("nan")}, "choose a time from 0 to"),
        (LOOP, {"times": 0}, "must be 1 to 1000"),
        (RAMP, {"times": 2}, "axis x ends 3 mm from where it begins"),
    ],
)
def test_impossible_sections_are_refused_with_their_bound(trajectory, options, message):
    with pytest.raises(TrajectoryError, match=message):
        cut_and_repeat(trajectory, **options)
