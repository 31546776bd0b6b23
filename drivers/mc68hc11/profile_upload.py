"""Conversion of a profile: cubic segments become quadratic ones, which a board can evaluate."""

from binascii import crc_hqx
from collections.abc import Sequence

import numpy as np

from rotemina.drivers.abilities import MotionProfile
from rotemina.drivers.contract import LimitError
from rotemina.drivers.mc68hc11.protocol import (
    MAX_PROFILE_SEGMENTS,
    ArmProfile,
    BeginProfile,
    BoardAxis,
    LoadSegments,
    QuadraticSegment,
    WireMessage,
)
from rotemina.sim.arrays import FloatArray, IntArray

# Differences are in units of this fraction of a step.
UNITS_PER_STEP = 1 << 16
_CRC_INITIAL = 0xFFFF
_TRIGGER_BY_FRAME = 0
_SEGMENTS_PER_FRAME = 2
_MAX_SEGMENT_TICKS = 0xFFFF
# Maximum deviation of a segment from the profile, if the board has room for all segments.
_MIN_TOLERANCE_STEPS = 1.0
# Rounding error of the duration, as a fraction of a tick.
_TICK_TOLERANCE = 1e-6


def make_profile_messages(
    profile: MotionProfile, axis: BoardAxis, tick_hz: int
) -> tuple[WireMessage, ...]:
    """Return the messages that load a profile into a board and arm it.

    Raises
    ------
    LimitError
        If the profile lasts longer than a board can count.
    """
    segments = fit_segments(_sample_profile(profile, tick_hz) / axis.step_size)
    return make_segment_messages(axis.number, segments, _TRIGGER_BY_FRAME)


def make_segment_messages(
    axis: int, segments: Sequence[QuadraticSegment], trigger: int
) -> tuple[WireMessage, ...]:
    """Return the messages that load segments of an axis into a board and arm them."""
    loads = [
        LoadSegments.from_segments(index, segments[index : index + _SEGMENTS_PER_FRAME])
        for index in range(0, len(segments), _SEGMENTS_PER_FRAME)
    ]
    check = crc_hqx(b"".join(load.pack() for load in loads), _CRC_INITIAL)
    return (BeginProfile(axis, len(segments)), *loads, ArmProfile(trigger, check))


def fit_segments(path: FloatArray) -> tuple[QuadraticSegment, ...]:
    """Fit segments to a path (ticks + 1,), in steps from its start, with as few as possible.

    Each segment is a quadratic that deviates from the path by at most a step. If a board has no
    room for all segments, this tolerance is doubled until they fit. All segments end on the path,
    so deviations do not accumulate.

    Raises
    ------
    LimitError
        If the path has more ticks than a board can count.
    """
    max_ticks = MAX_PROFILE_SEGMENTS * _MAX_SEGMENT_TICKS
    if len(path) - 1 > max_ticks:
        raise LimitError(
            "profile of {count} ticks: a board can run {most} ticks at most; shorten the profile",
            count=len(path) - 1,
            most=max_ticks,
        )
    tolerance = _MIN_TOLERANCE_STEPS
    while (segments := _fit_within_tolerance(path, tolerance)) is None:
        tolerance *= 2.0
    return segments


def evaluate_segments(segments: Sequence[QuadraticSegment]) -> IntArray:
    """Return the positions (ticks,) after each tick, in steps · 2^-16 from the start."""
    parts, position = [np.zeros(0, dtype=np.int64)], 0
    for segment in segments:
        parts.append(_evaluate_segment(position, segment))
        position = int(parts[-1][-1])
    return np.concatenate(parts)


def _fit_within_tolerance(
    path: FloatArray, tolerance: float
) -> tuple[QuadraticSegment, ...] | None:
    """Return segments within a tolerance, steps, or None if the board has no room for them."""
    segments: list[QuadraticSegment] = []
    begin = position = 0
    while begin < len(path) - 1:
        if len(segments) == MAX_PROFILE_SEGMENTS:
            return None
        # Double the duration until the segment exceeds the tolerance, then bisect.
        fitting_ticks, ticks = 1, 2
        max_ticks = min(len(path) - 1 - begin, _MAX_SEGMENT_TICKS)
        while ticks <= max_ticks and _find_deviation(path, begin, position, ticks) <= tolerance:
            fitting_ticks, ticks = ticks, 2 * ticks
        excessive_ticks = min(ticks, max_ticks + 1)
        while excessive_ticks - fitting_ticks > 1:
            middle_ticks = (fitting_ticks + excessive_ticks) // 2
            if _find_deviation(path, begin, position, middle_ticks) <= tolerance:
                fitting_ticks = middle_ticks
            else:
                excessive_ticks = middle_ticks
        segments.append(_fit_segment(path, begin, position, fitting_ticks))
        position = int(_evaluate_segment(position, segments[-1])[-1])
        begin += fitting_ticks
    return tuple(segments)


def _fit_segment(path: FloatArray, begin: int, position: int, ticks: int) -> QuadraticSegment:
    """Return the quadratic from a position through the path's middle to the path's end.

    The path begins at the index ``begin`` and has ``ticks`` ticks. Positions are in steps · 2^-16.
    """
    middle = 0.5 * (path[begin + ticks // 2] + path[begin + (ticks + 1) // 2])
    end = UNITS_PER_STEP * float(path[begin + ticks])
    curvature = 4.0 * (position - 2.0 * UNITS_PER_STEP * float(middle) + end) / ticks**2
    second = round(curvature) if ticks > 1 else 0
    first = round((end - position - ticks * (ticks + 1) // 2 * second) / ticks)
    return QuadraticSegment(ticks, first, second)


def _evaluate_segment(start: int, segment: QuadraticSegment) -> IntArray:
    count = np.arange(1, segment.ticks + 1, dtype=np.int64)
    return np.asarray(start + count * segment.first + count * (count + 1) // 2 * segment.second)


def _find_deviation(path: FloatArray, begin: int, position: int, ticks: int) -> float:
    """Return the maximum deviation of the fitted quadratic from the path, steps."""
    positions = (
        _evaluate_segment(position, _fit_segment(path, begin, position, ticks)) / UNITS_PER_STEP
    )
    return float(np.abs(positions - path[begin + 1 : begin + 1 + ticks]).max())


def _sample_profile(profile: MotionProfile, tick_hz: int) -> FloatArray:
    """Return the position of a profile at each tick (ticks + 1,), m or rad from its start."""
    ticks = max(int(np.ceil(profile.duration_s * tick_hz - _TICK_TOLERANCE)), 1)
    time_s = np.arange(ticks + 1) / tick_hz
    path, begin_s = np.zeros(ticks + 1), 0.0
    for segment in profile.segments:
        tau = np.clip((time_s - begin_s) / segment.duration_s, 0.0, 1.0)
        path += tau * (segment.c1 + tau * (segment.c2 + tau * segment.c3))
        begin_s += segment.duration_s
    return path
