"""A board's sums follow the cubics of a profile, with a limited number of segments."""

import numpy as np
import pytest

from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.drivers.contract import LimitError
from rotemina.drivers.mc68hc11 import UNITS_PER_STEP, evaluate_segments
from rotemina.drivers.mc68hc11.profile_upload import fit_segments, make_profile_messages
from rotemina.drivers.mc68hc11.protocol import (
    MAX_PROFILE_SEGMENTS,
    BeginProfile,
    BoardAxis,
    LoadSegments,
)


def make_smooth_path(steps, ticks):
    fraction = np.arange(ticks + 1) / ticks
    return steps * fraction**2 * (3.0 - 2.0 * fraction)


def measure_fit(path):
    """Return the number of segments and the largest error, in steps."""
    segments = fit_segments(path)
    assert len(segments) <= MAX_PROFILE_SEGMENTS
    evaluated_path = evaluate_segments(segments) / UNITS_PER_STEP
    assert len(evaluated_path) == len(path) - 1
    assert evaluated_path[-1] == pytest.approx(path[-1], abs=0.01)
    return len(segments), float(np.abs(evaluated_path - path[1:]).max())


@pytest.mark.parametrize(("steps", "ticks"), [(50_000, 100), (-500, 400), (65_000, 20_000)])
def test_a_smooth_path_is_followed_to_a_step(steps, ticks):
    assert measure_fit(make_smooth_path(steps, ticks))[1] <= 1.0


def test_a_path_that_needs_too_many_segments_is_followed_less_closely():
    smooth_path = make_smooth_path(50_000, 100)
    path = np.concatenate([smooth_path, smooth_path[-2::-1], smooth_path[1:]])
    count, error = measure_fit(path)
    assert count > MAX_PROFILE_SEGMENTS // 2
    assert 1.0 < error <= 8.0


def test_cubics_become_messages_with_segments_of_whole_ticks():
    axis = BoardAxis("zn", 2, 1, -9)
    profile = MotionProfile(
        "zn", (ProfileSegment(0.0101, 0.0, 3e-5, -2e-5), ProfileSegment(0.01, 0.0, 0.0, 0.0))
    )
    begin, *messages, _ = make_profile_messages(profile, axis, 2000)
    assert isinstance(begin, BeginProfile)
    assert all(isinstance(message, LoadSegments) for message in messages)
    segments = [segment for message in messages for segment in message.unpack_segments()]
    assert len(segments) == begin.segments
    # The profile lasts 20.1 ms.
    assert sum(segment.ticks for segment in segments) == 41
    assert evaluate_segments(segments)[-1] == pytest.approx(10_000 * UNITS_PER_STEP, abs=50)


def test_a_profile_that_is_too_long_for_a_board_is_refused():
    with pytest.raises(LimitError, match="shorten the profile"):
        fit_segments(np.zeros(MAX_PROFILE_SEGMENTS * 0xFFFF + 2))


@pytest.mark.parametrize("max_speed", [50, 2500])
def test_a_path_at_maximum_speed_exceeds_it_by_at_most_one_step_per_tick(max_speed):
    """The speed in the middle of the path is 1.5 times its mean."""
    path = make_smooth_path(100 * max_speed / 1.5, 100)
    speeds = np.abs(np.diff(evaluate_segments(fit_segments(path)), prepend=0)) / UNITS_PER_STEP
    assert speeds.max() <= max_speed + 1.0
