"""A profile in the words of the protocol: its cubics become what a board adds up, tick by tick."""

from binascii import crc_hqx
from collections.abc import Sequence

import numpy as np

from rotemina.drivers.errors import LimitError
from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.mc68hc11.host_messages import ArmProfile, BeginProfile, Quadratic, Segments
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import SEGMENTS
from rotemina.drivers.profile import Profile
from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.messages import message

FRACTION = 1 << 16  # of a step, in which differences are told
_START = 0xFFFF  # of the check, as of the parameters'
_BY_FRAME = 0
_IN_A_FRAME = 2  # segments
_MOST_TICKS = 0xFFFF  # of a segment
_NEAR = 1.0  # steps: what a segment may be off the profile if they are few enough
_ON_TIME = 1e-6  # of a tick


def profile_messages(profile: Profile, axis: BoardAxis, tick_hz: int) -> tuple[Message, ...]:
    """Return what is to be said so that a board has a profile, and waits for its trigger.

    Raises
    ------
    LimitError
        If it lasts longer than a board can count.
    """
    segments = segments_of(_path(profile, tick_hz) / axis.step)
    return profile_of(axis.number, segments, _BY_FRAME)


def profile_of(axis: int, segments: Sequence[Quadratic], trigger: int) -> tuple[Message, ...]:
    """Return what is to be said so that a board has segments of an axis, armed."""
    told = [
        Segments.of(index, segments[index : index + _IN_A_FRAME])
        for index in range(0, len(segments), _IN_A_FRAME)
    ]
    check = crc_hqx(b"".join(one.packed() for one in told), _START)
    return (BeginProfile(axis, len(segments)), *told, ArmProfile(trigger, check))


def segments_of(path: FloatArray) -> tuple[Quadratic, ...]:
    """Return the fewest segments that lead through a path (ticks + 1,), steps from its beginning.

    Each is a quadratic, off the path by a step at most; twice as far as often as it takes
    until a board has room for all. They end on the path, so that nothing adds up.

    Raises
    ------
    LimitError
        If it lasts longer than a board can count.
    """
    most = SEGMENTS * _MOST_TICKS
    if len(path) - 1 > most:
        raise LimitError(
            message(
                "engine", "profile of {count} ticks: a board counts {most} at most; make it shorter"
            ).fill(count=len(path) - 1, most=most)
        )
    near = _NEAR
    while (found := _within(path, near)) is None:
        near *= 2.0
    return found


def ticks_of(segments: Sequence[Quadratic]) -> IntArray:
    """Return the places (ticks,) behind each tick, in steps · 2^-16 from the beginning."""
    parts, place = [np.zeros(0, dtype=np.int64)], 0
    for one in segments:
        parts.append(_places(place, one))
        place = int(parts[-1][-1])
    return np.concatenate(parts)


def _within(path: FloatArray, near: float) -> tuple[Quadratic, ...] | None:
    """Return segments that are off by ``near`` steps at most; None if they are too many."""
    found: list[Quadratic] = []
    begin = place = 0
    while begin < len(path) - 1:
        if len(found) == SEGMENTS:
            return None
        fits, ticks = 1, 2
        most = min(len(path) - 1 - begin, _MOST_TICKS)
        while ticks <= most and _off(path, begin, place, ticks) <= near:
            fits, ticks = ticks, 2 * ticks
        beyond = min(ticks, most + 1)
        while beyond - fits > 1:
            middle = (fits + beyond) // 2
            if _off(path, begin, place, middle) <= near:
                fits = middle
            else:
                beyond = middle
        found.append(_segment(path, begin, place, fits))
        place = int(_places(place, found[-1])[-1])
        begin += fits
    return tuple(found)


def _segment(path: FloatArray, begin: int, place: int, ticks: int) -> Quadratic:
    """Return the quadratic from a place through the path's middle to its end after some ticks."""
    middle = 0.5 * (path[begin + ticks // 2] + path[begin + (ticks + 1) // 2])
    end = FRACTION * float(path[begin + ticks])
    bend = 4.0 * (place - 2.0 * FRACTION * float(middle) + end) / ticks**2
    second = round(bend) if ticks > 1 else 0
    first = round((end - place - ticks * (ticks + 1) // 2 * second) / ticks)
    return Quadratic(ticks, first, second)


def _places(place: int, segment: Quadratic) -> IntArray:
    count = np.arange(1, segment.ticks + 1, dtype=np.int64)
    return np.asarray(place + count * segment.first + count * (count + 1) // 2 * segment.second)


def _off(path: FloatArray, begin: int, place: int, ticks: int) -> float:
    """Return how far the best segment is off the path, steps."""
    places = _places(place, _segment(path, begin, place, ticks)) / FRACTION
    return float(np.abs(places - path[begin + 1 : begin + 1 + ticks]).max())


def _path(profile: Profile, tick_hz: int) -> FloatArray:
    """Return where a profile is at each tick (ticks + 1,), m or rad from where it began."""
    ticks = max(int(np.ceil(profile.duration_s * tick_hz - _ON_TIME)), 1)
    time_s = np.arange(ticks + 1) / tick_hz
    path, begin_s = np.zeros(ticks + 1), 0.0
    for one in profile.segments:
        share = np.clip((time_s - begin_s) / one.duration_s, 0.0, 1.0)
        path += share * (one.c1 + share * (one.c2 + share * one.c3))
        begin_s += one.duration_s
    return path
