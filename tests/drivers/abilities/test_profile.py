"""A profile that a device runs by itself is checked completely before any motion."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.sim.errors import InputError
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
ZN = ROBOT.axes["zn"]


def make_thrust(length, duration_s=0.05):
    """Return a cubic segment from rest to rest."""
    return ProfileSegment(duration_s, 0.0, 3.0 * length, -2.0 * length)


def test_a_thrust_and_its_return_are_allowed():
    profile = MotionProfile(
        "zn", (make_thrust(50e-6), ProfileSegment(0.1, 0.0, 0.0, 0.0), make_thrust(-50e-6))
    )
    profile.check(ROBOT, 5e-6)
    assert profile.duration_s == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("profile", "start", "message"),
    [
        (MotionProfile("zn", (make_thrust(50e-6),)), 30e-6, r"segment 1: .*zn"),
        (MotionProfile("zn", (make_thrust(50e-6), make_thrust(20e-6))), 0.0, "segment 2: .*zn"),
        (
            MotionProfile("zn", (make_thrust(50e-6, 0.01),)),
            5e-6,
            r"segment 1: 7\.5 mm/s: must be at most 5 mm/s",
        ),
        (
            MotionProfile("x", (make_thrust(1e-4, 0.05),)),
            0.02,
            r"segment 1: 240 mm/s²: must be at most 200 mm/s²",
        ),
        (MotionProfile("zn", ()), 5e-6, "0 segments: must be 1 to 16"),
        (MotionProfile("zn", (make_thrust(1e-9),) * 17), 5e-6, "17 segments: must be 1 to 16"),
        (MotionProfile("zn", (make_thrust(float("nan")),)), 5e-6, "must be finite"),
        (MotionProfile("zn", (make_thrust(1e-6, 0.0),)), 5e-6, "the duration positive"),
        (MotionProfile("elbow", (make_thrust(1e-6),)), 0.0, "elbow"),
    ],
)
def test_a_profile_that_an_axis_cannot_follow_is_refused(profile, start, message):
    with pytest.raises(InputError, match=message):
        profile.check(ROBOT, start)


@given(*[st.floats(-1e-5, 1e-5)] * 3)
def test_extremes_and_speeds_bound_the_whole_segment(c1, c2, c3):
    segment = ProfileSegment(0.1, c1, c2, c3)
    tau = np.linspace(0.0, 1.0, 2001)
    position = ((c3 * tau + c2) * tau + c1) * tau
    ends = [0.0, *segment.find_extremes()]
    assert min(ends) - 1e-12 <= position.min()
    assert position.max() <= max(ends) + 1e-12
    speed = np.abs(c1 + 2 * c2 * tau + 3 * c3 * tau**2).max() / 0.1
    assert speed <= segment.compute_max_speed() * (1 + 1e-9) + 1e-15
    acceleration = np.abs(2 * c2 + 6 * c3 * tau).max() / 0.01
    assert acceleration == pytest.approx(segment.compute_max_acceleration(), rel=1e-9, abs=1e-15)
