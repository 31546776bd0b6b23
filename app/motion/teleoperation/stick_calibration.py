"""A calibration run: the stick is released, then moved to all its ends.

Nothing is sent meanwhile (the arbiter has its mapping open); readings are all it needs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import isfinite

from rotemina.app.motion.teleoperation.axis_calibration import AxisCalibration, CalibrationError
from rotemina.drivers.inputs.device import InputReading
from rotemina.sim.messages import AxisName, marked, message
from rotemina.sim.quantities import fixed, rounded

# Shares of the shorter side (of the only one, if the axis is one-sided).
SMALLEST_DEAD_ZONE = 0.04  # a stick never comes back to quite the same place
WIDEST_DEAD_ZONE = 0.25

SMALLEST_RANGE = 0.2  # raw, of 2: the potentiometer of a stick turns by part of its range only
LEAST_SHARE = 0.25  # of the longer side that the shorter one must have
ENDS_MARGIN = 0.02  # of each side: the ends must be reached surely, not only just


class Phase(StrEnum):
    """What the operator is to do."""

    REST = "rest"  # let go
    SWEEP = "sweep"  # move every axis to all its ends


@dataclass(slots=True)
class _Seen:
    """Least and greatest reading of one axis, at rest and altogether."""

    rest: tuple[float, float] | None = None
    all: tuple[float, float] | None = None

    def add(self, raw: float, phase: Phase) -> None:
        self.all = _widened(self.all, raw)
        if phase is Phase.REST:
            self.rest = _widened(self.rest, raw)


class CalibrationRun:
    """Collects what the axes of one device say, and turns it into their calibration.

    Parameters
    ----------
    axes : sequence of str
        What the device's axes are called, in the order of its readings.
    wanted : sequence of str, optional
        Which of them are calibrated; the others may stand as they like. All by default.
    one_sided : collection of str
        Which of them rest at an end: triggers, pedals.
    last : InputReading, optional
        What the device said last: one that speaks only of changes says nothing at rest.

    Raises
    ------
    CalibrationError
        If the device has no such axis.
    """

    def __init__(
        self,
        axes: Sequence[str],
        wanted: Sequence[str] | None = None,
        one_sided: Sequence[str] = (),
        last: InputReading | None = None,
    ) -> None:
        self._axes = tuple(axes)
        self._one_sided = frozenset(one_sided)
        self._seen = {axis: _Seen() for axis in (self._axes if wanted is None else wanted)}
        for axis in (*self._seen, *one_sided):
            if axis not in self._axes:
                raise CalibrationError(
                    message(
                        "engine", "axis {axis}: the device has no axis of that name; it has {value}"
                    ).fill(axis=repr(axis), value=", ".join(self._axes) or marked("engine", "none"))
                )
        self.phase = Phase.REST
        if last is not None:
            self.feed(last)

    def feed(self, reading: InputReading) -> None:
        """Process a reading; numbers that are none are passed over."""
        for axis, raw in zip(self._axes, reading.axes, strict=False):
            if axis in self._seen and isfinite(raw):
                self._seen[axis].add(raw, self.phase)

    def sweep(self) -> None:
        """Rest is over: from now on the axes are moved."""
        self.phase = Phase.SWEEP

    @property
    def ranges(self) -> Mapping[str, tuple[float, float]]:
        """Least and greatest reading of each axis so far, for live bars."""
        return {axis: seen.all for axis, seen in self._seen.items() if seen.all is not None}

    @property
    def problems(self) -> Mapping[str, str]:
        """What is still wrong, by axis, in words; empty when the run can be ended."""
        found = {axis: self._problem(axis, seen) for axis, seen in self._seen.items()}
        return {axis: problem for axis, problem in found.items() if problem is not None}

    def sound(
        self, before: Mapping[str, AxisCalibration] | None = None
    ) -> Mapping[str, AxisCalibration]:
        """Return the calibration of each wanted axis without a problem.

        Curve, sense and travel stay as before.
        """
        kept, problems = before or {}, self.problems
        return {
            axis: self._calibrated(axis, seen, kept.get(axis, AxisCalibration()))
            for axis, seen in self._seen.items()
            if axis not in problems
        }

    def _problem(self, axis: str, seen: _Seen) -> str | None:
        if seen.rest is None or seen.all is None:
            return message(
                "engine",
                "axis {axis} reported nothing at rest; move it once, release it, and start again",
            ).fill(axis=AxisName(axis))
        low, high = seen.all
        if high - low < SMALLEST_RANGE:
            return message(
                "engine",
                "axis {axis} hardly moved: {low} to {high} of −1 to 1, at least {least} is "
                "needed; move it to both ends",
            ).fill(
                axis=AxisName(axis),
                low=fixed(low, 2),
                high=fixed(high, 2),
                least=rounded(SMALLEST_RANGE, 6),
            )
        centre, side, dead_zone = self._rest(axis)
        shorter, longer = sorted((centre - low, high - centre))
        where = message("engine", "rest {centre}, ends {low} and {high}").fill(
            centre=fixed(centre, 2), low=fixed(low, 2), high=fixed(high, 2)
        )
        if axis in self._one_sided:
            if shorter > dead_zone:
                return message(
                    "engine",
                    "axis {axis} does not rest at an end: {where}; calibrate it as a stick",
                ).fill(axis=AxisName(axis), where=where)
        elif shorter < LEAST_SHARE * longer:
            return message(
                "engine",
                "axis {axis} rests at an end: {where}; move it both ways, or declare "
                "it one-sided (a trigger)",
            ).fill(axis=AxisName(axis), where=where)
        widest = WIDEST_DEAD_ZONE * side
        if dead_zone > widest:
            return message(
                "engine",
                "axis {axis} jitters at rest, or was moved: {low} to {high} needs a dead "
                "zone of {zone}, but at most {most} is permitted; release it and measure "
                "again, or have it repaired",
            ).fill(
                axis=AxisName(axis),
                low=fixed(seen.rest[0], 2),
                high=fixed(seen.rest[1], 2),
                zone=fixed(dead_zone, 2),
                most=fixed(widest, 2),
            )
        return None

    def _rest(self, axis: str) -> tuple[float, float, float]:
        """Return centre, the side that counts, and the dead zone: noise half as wide again."""
        seen = self._seen[axis]
        assert seen.rest is not None
        assert seen.all is not None
        centre = 0.5 * (seen.rest[0] + seen.rest[1])
        sides = (centre - seen.all[0], seen.all[1] - centre)
        side = max(sides) if axis in self._one_sided else min(sides)
        noise = 0.5 * (seen.rest[1] - seen.rest[0])
        return centre, side, max(1.5 * noise, SMALLEST_DEAD_ZONE * side)

    def _calibrated(self, axis: str, seen: _Seen, before: AxisCalibration) -> AxisCalibration:
        assert seen.all is not None
        centre, _, dead_zone = self._rest(axis)
        low, high = seen.all
        if axis in self._one_sided and centre - low < high - centre:
            low = centre
        elif axis in self._one_sided:
            high = centre
        return AxisCalibration(
            low=_within(low + ENDS_MARGIN * (centre - low)),
            centre=_within(centre),
            high=_within(high - ENDS_MARGIN * (high - centre)),
            dead_zone=dead_zone,
            expo=before.expo,
            inverted=before.inverted,
            travel_m=before.travel_m,
        )


def _widened(bounds: tuple[float, float] | None, raw: float) -> tuple[float, float]:
    return (raw, raw) if bounds is None else (min(bounds[0], raw), max(bounds[1], raw))


def _within(raw: float) -> float:
    return min(max(raw, -1.0), 1.0)
