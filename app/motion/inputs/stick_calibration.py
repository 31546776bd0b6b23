"""Calibration of a stick, which the operator first releases and then moves to all its ends.

Meanwhile the mapping is open, so the input arbiter passes on only stops. The run itself uses only
readings.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from typing import NamedTuple

from rotemina.app.errors import InputCalibrationError
from rotemina.app.motion.inputs.axis_calibration import InputAxisCalibration
from rotemina.drivers.inputs import InputReading
from rotemina.sim.messages import (
    AxisName,
    format_fixed,
    format_rounded,
    marked,
    message,
)

# Bounds of the dead zone, as fractions of the shorter side, or of the only side of an axis that
# rests at an end. The lower bound is needed because a stick never returns to exactly the same
# position.
MIN_DEAD_ZONE_RATIO = 0.04
MAX_DEAD_ZONE_RATIO = 0.25

# Smallest raw range of an axis, of 2 at most. It is small because the potentiometer of a stick may
# turn by only a small part of its range.
MIN_RAW_RANGE = 0.2
# Smallest length of the shorter side, as a fraction of the longer one.
MIN_SIDE_RATIO = 0.25
# The ends are moved inwards by this fraction of each side, so that the stick surely reaches them.
END_MARGIN_RATIO = 0.02


class StickCalibrationPhase(StrEnum):
    """Phase of a calibration, named after what the operator must do."""

    # Release the stick.
    REST = "rest"
    # Move every axis to all its ends.
    SWEEP = "sweep"


@dataclass(slots=True)
class _ReadingRanges:
    rest: tuple[float, float] | None = None
    overall: tuple[float, float] | None = None

    def add(self, raw: float, phase: StickCalibrationPhase) -> None:
        self.overall = _widen(self.overall, raw)
        if phase is StickCalibrationPhase.REST:
            self.rest = _widen(self.rest, raw)


class _RestMeasurement(NamedTuple):
    """Rest position and dead zone of an axis in raw values.

    ``side`` is the length of its only side if the axis is one-sided, or else of its shorter side.
    """

    centre: float
    side: float
    dead_zone: float


class StickCalibrationRun:
    """Collects readings of a device, and makes the calibrations of its axes.

    Parameters
    ----------
    axes : sequence of str
        Names of the device's axes, in the order of its readings.
    selected_axes : sequence of str, optional
        Axes to calibrate, by default all. The other axes may have any position.
    one_sided : collection of str
        Axes that rest at an end, such as triggers and pedals.
    last_reading : InputReading, optional
        Latest reading of the device, because some devices do not report at rest.

    Raises
    ------
    InputCalibrationError
        If the device does not have one of the axes.
    """

    def __init__(
        self,
        axes: Sequence[str],
        selected_axes: Sequence[str] | None = None,
        one_sided: Sequence[str] = (),
        last_reading: InputReading | None = None,
    ) -> None:
        self._axes = tuple(axes)
        self._one_sided = frozenset(one_sided)
        self._reading_ranges = {
            axis: _ReadingRanges()
            for axis in (self._axes if selected_axes is None else selected_axes)
        }
        for axis in (*self._reading_ranges, *one_sided):
            if axis not in self._axes:
                raise InputCalibrationError(
                    "axis {axis}: the device has no axis of that name; it has {value}",
                    axis=repr(axis),
                    value=", ".join(self._axes) or marked("engine", "none"),
                )
        self.phase = StickCalibrationPhase.REST
        if last_reading is not None:
            self.feed(last_reading)

    def feed(self, reading: InputReading) -> None:
        """Process a reading; values that are not finite are ignored."""
        for axis, raw in zip(self._axes, reading.axes, strict=False):
            if axis in self._reading_ranges and isfinite(raw):
                self._reading_ranges[axis].add(raw, self.phase)

    def begin_sweep(self) -> None:
        """Begin the phase in which the axes are moved to their ends."""
        self.phase = StickCalibrationPhase.SWEEP

    @property
    def ranges(self) -> Mapping[str, tuple[float, float]]:
        """Lowest and highest reading of each axis so far, for live bars."""
        return {
            axis: readings.overall
            for axis, readings in self._reading_ranges.items()
            if readings.overall is not None
        }

    @property
    def problems(self) -> Mapping[str, str]:
        """Messages on problems that remain, by axis; empty if the run can be ended."""
        problems = {
            axis: self._find_problem(axis, readings)
            for axis, readings in self._reading_ranges.items()
        }
        return {axis: problem for axis, problem in problems.items() if problem is not None}

    def make_calibrations(
        self, previous: Mapping[str, InputAxisCalibration] | None = None
    ) -> Mapping[str, InputAxisCalibration]:
        """Return the calibration of each selected axis without a problem.

        Response curve, inversion and travel are taken from the ``previous`` calibrations.
        """
        previous_calibrations, problems = previous or {}, self.problems
        return {
            axis: self._make_calibration(
                axis, readings, previous_calibrations.get(axis, InputAxisCalibration())
            )
            for axis, readings in self._reading_ranges.items()
            if axis not in problems
        }

    def _find_problem(self, axis: str, readings: _ReadingRanges) -> str | None:
        if readings.rest is None or readings.overall is None:
            return message(
                "engine",
                "axis {axis} reported nothing at rest; move it once, release it, and start again",
            ).fill(axis=AxisName(axis))
        low, high = readings.overall
        if high - low < MIN_RAW_RANGE:
            return message(
                "engine",
                "axis {axis} hardly moved: {low} to {high} of −1 to 1, at least {least} is "
                "needed; move it to both ends",
            ).fill(
                axis=AxisName(axis),
                low=format_fixed(low, 2),
                high=format_fixed(high, 2),
                least=format_rounded(MIN_RAW_RANGE, 6),
            )
        centre, side, dead_zone = self._measure_rest(axis)
        shorter, longer = sorted((centre - low, high - centre))
        where = message("engine", "rest {centre}, ends {low} and {high}").fill(
            centre=format_fixed(centre, 2), low=format_fixed(low, 2), high=format_fixed(high, 2)
        )
        if axis in self._one_sided:
            if shorter > dead_zone:
                return message(
                    "engine",
                    "axis {axis} does not rest at an end: {where}; calibrate it as a stick",
                ).fill(axis=AxisName(axis), where=where)
        elif shorter < MIN_SIDE_RATIO * longer:
            return message(
                "engine",
                "axis {axis} rests at an end: {where}; move it both ways, or declare "
                "it one-sided (a trigger)",
            ).fill(axis=AxisName(axis), where=where)
        max_dead_zone = MAX_DEAD_ZONE_RATIO * side
        if dead_zone > max_dead_zone:
            return message(
                "engine",
                "axis {axis} jitters at rest, or was moved: {low} to {high} needs a dead "
                "zone of {zone}, but at most {most} is permitted; release it and measure "
                "again, or have it repaired",
            ).fill(
                axis=AxisName(axis),
                low=format_fixed(readings.rest[0], 2),
                high=format_fixed(readings.rest[1], 2),
                zone=format_fixed(dead_zone, 2),
                most=format_fixed(max_dead_zone, 2),
            )
        return None

    def _measure_rest(self, axis: str) -> _RestMeasurement:
        """Measure the rest position of an axis.

        The dead zone is 1.5 times the noise at rest, or a fraction of the side if this is larger.
        """
        readings = self._reading_ranges[axis]
        assert readings.rest is not None
        assert readings.overall is not None
        centre = 0.5 * (readings.rest[0] + readings.rest[1])
        sides = (centre - readings.overall[0], readings.overall[1] - centre)
        side = max(sides) if axis in self._one_sided else min(sides)
        noise = 0.5 * (readings.rest[1] - readings.rest[0])
        return _RestMeasurement(centre, side, max(1.5 * noise, MIN_DEAD_ZONE_RATIO * side))

    def _make_calibration(
        self, axis: str, readings: _ReadingRanges, previous: InputAxisCalibration
    ) -> InputAxisCalibration:
        assert readings.overall is not None
        centre, _, dead_zone = self._measure_rest(axis)
        low, high = readings.overall
        if axis in self._one_sided and centre - low < high - centre:
            low = centre
        elif axis in self._one_sided:
            high = centre
        return InputAxisCalibration(
            low=_clip_raw(low + END_MARGIN_RATIO * (centre - low)),
            centre=_clip_raw(centre),
            high=_clip_raw(high - END_MARGIN_RATIO * (high - centre)),
            dead_zone=dead_zone,
            expo=previous.expo,
            inverted=previous.inverted,
            travel_m=previous.travel_m,
        )


def _widen(extremes: tuple[float, float] | None, raw: float) -> tuple[float, float]:
    return (raw, raw) if extremes is None else (min(extremes[0], raw), max(extremes[1], raw))


def _clip_raw(raw: float) -> float:
    return min(max(raw, -1.0), 1.0)
