"""A profile as a board adds it up: near its cubics, and never too many segments."""

import numpy as np
import pytest

from rotemina.drivers.errors import LimitError
from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.mc68hc11.host_messages import BeginProfile, Segments
from rotemina.drivers.mc68hc11.profile_upload import (
    FRACTION,
    profile_messages,
    segments_of,
    ticks_of,
)
from rotemina.drivers.mc68hc11.protocol_codes import SEGMENTS
from rotemina.drivers.profile import Profile, ProfileSegment


def smooth(steps, ticks):
    share = np.arange(ticks + 1) / ticks
    return steps * share**2 * (3.0 - 2.0 * share)


def off(path):
    segments = segments_of(path)
    assert len(segments) <= SEGMENTS
    told = ticks_of(segments) / FRACTION
    assert len(told) == len(path) - 1
    assert told[-1] == pytest.approx(path[-1], abs=0.01)
    return len(segments), float(np.abs(told - path[1:]).max())


@pytest.mark.parametrize(
    ("steps", "ticks", "most"), [(50_000, 100, 1.0), (-500, 400, 1.0), (65_000, 20_000, 1.0)]
)
def test_a_smooth_way_is_met_to_a_step(steps, ticks, most):
    assert off(smooth(steps, ticks))[1] <= most


def test_a_way_that_needs_more_segments_than_a_board_has_is_met_less_closely():
    out = smooth(50_000, 100)
    path = np.concatenate([out, out[-2::-1], out[1:]])
    count, error = off(path)
    assert count > SEGMENTS // 2
    assert 1.0 < error <= 8.0


def test_cubics_become_frames_of_two_segments_at_whole_ticks():
    axis = BoardAxis("zn", 2, 1, -9)
    profile = Profile(
        "zn", (ProfileSegment(0.0101, 0.0, 3e-5, -2e-5), ProfileSegment(0.01, 0.0, 0.0, 0.0))
    )
    begin, *told, _ = profile_messages(profile, axis, 2000)
    assert isinstance(begin, BeginProfile)
    assert all(isinstance(one, Segments) for one in told)
    segments = [segment for one in told for segment in one.segments()]
    assert len(segments) == begin.segments
    assert sum(one.ticks for one in segments) == 41  # 20.1 ms
    assert ticks_of(segments)[-1] == pytest.approx(10_000 * FRACTION, abs=50)


def test_a_profile_that_lasts_longer_than_a_board_counts_is_refused():
    with pytest.raises(LimitError, match="make it shorter"):
        segments_of(np.zeros(SEGMENTS * 0xFFFF + 2))


@pytest.mark.parametrize("most", [50, 2500])
def test_a_way_at_the_greatest_speed_is_told_no_faster_than_a_step_a_tick(most):
    """1.5 times the mean at its middle."""
    path = smooth(100 * most / 1.5, 100)
    speeds = np.abs(np.diff(ticks_of(segments_of(path)), prepend=0)) / FRACTION
    assert speeds.max() <= most + 1.0
