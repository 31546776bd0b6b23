"""What the nominal model expects of a trajectory on a device: tracking errors, and the range.

The model runs through the instants of the device's own schedule, piece by piece, so that a long
trajectory needs no more memory than a short one.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.quantities import exact
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.schedule import Schedule
from rotemina.sim.trajectory.trajectory_excesses import Quantity, Violation

#: How far beyond its range, in shares of it, an axis may be predicted to swing.
OVERSHOOT_SHARE = 0.01
_LOOKS = 4  # at the motion of an axis without a loop, per set-point period: it may ring as fast
_AFTER_S = 0.5  # for how long the halt after the last row is watched
_CHUNK = 1 << 16


class TrackingError(NamedTuple):
    """Predicted position minus command at the rows of a trajectory, m or rad."""

    rms: float
    peak: float


@dataclass(frozen=True, slots=True)
class Prediction:
    """Tracking errors by axis, where an axis leaves its range, and why there is no prediction.

    With a ``fault`` there are no ``errors``.
    """

    errors: Mapping[str, TrackingError]
    violations: tuple[Violation, ...]
    fault: str | None = None


def predict(robot: Robot, trajectory: Record, setpoint_period_s: float) -> Prediction:
    """Run the nominal model through a trajectory, from rest at its first row.

    Axes with a controller are under it, at the device's set-point period. An axis leaves its range
    when it is more than ``OVERSHOOT_SHARE`` of it outside.
    """
    watched = {name: _Watch(robot, name) for name in trajectory.axes}
    try:
        for motion in _motions(robot, trajectory, setpoint_period_s):
            for name, watch in watched.items():
                watch.see(motion, motion.axes.index(name))
    except PlantError as error:
        return Prediction({}, _violations(watched), str(error))
    errors = {name: watch.error.tracking() for name, watch in watched.items()}
    return Prediction(errors, _violations(watched))


def _violations(watched: Mapping[str, "_Watch"]) -> tuple[Violation, ...]:
    found = [watch.violation() for watch in watched.values()]
    return tuple(violation for violation in found if violation is not None)


class _Motion(NamedTuple):
    """Instants (n,), commands and positions (n, axes), and which instants count as rows (n,)."""

    axes: tuple[str, ...]
    time_s: FloatArray
    command: FloatArray
    position: FloatArray
    on_row: BoolArray


def _motions(robot: Robot, trajectory: Record, period_s: float) -> Iterator[_Motion]:
    plant = Plant.of(robot, closed_loop=True, only=trajectory.axes)
    looped = any(plant.loops)
    tick_s = period_s if looped else period_s / _LOOKS
    schedule = Schedule(trajectory, plant.axes, tick_s, on_ticks=looped)
    held = np.array([axis.range[0] for axis in plant.robot.axes.values()], dtype=np.float64)
    state = plant.at_rest(0.0, schedule.commands(np.zeros(1, dtype=np.int64), held)[0])
    begin, size, since_s = 0, _CHUNK, 0.0
    command = np.empty((0, len(plant.axes)))
    while begin < schedule.count:
        instants = schedule.instants(begin, begin + size)
        command = schedule.commands(instants.row, held)
        elapsed_s = schedule.elapsed(since_s, instants.time_s)
        try:
            motion, after = plant.advance(state, elapsed_s, command)
        except PlantError:
            if size == 1:
                raise
            size = max(size // 8, 1)  # to see what came before the number overflowed
            continue
        state = replace(after, time_s=after.time_s - after.time_s[-1])
        begin, since_s = begin + size, float(instants.time_s[-1])
        time_s = trajectory.time_s[0] + instants.time_s
        yield _Motion(plant.axes, time_s, command, motion.position, instants.on_row)
    after_s = (np.arange(1, round(_AFTER_S / tick_s) + 1) * tick_s).astype(np.float64)
    command = np.repeat(command[-1:], len(after_s), axis=0)
    motion, _ = plant.advance(state, after_s, command)
    none = np.zeros(len(after_s), dtype=np.bool_)
    yield _Motion(plant.axes, trajectory.time_s[-1] + after_s, command, motion.position, none)


class _Watch:
    """What of one axis is remembered while its motion passes by."""

    def __init__(self, robot: Robot, name: str) -> None:
        self.error = _ErrorSum()
        self._name = name
        self._axis = robot.axes[name]
        self._unit = robot.unit(name) or ""
        self._worst = OVERSHOOT_SHARE * self._axis.span
        self._at: tuple[float, float] | None = None

    def see(self, motion: _Motion, column: int) -> None:
        position = motion.position[:, column]
        self.error.add((position - motion.command[:, column])[motion.on_row])
        low, high = self._axis.range
        outside = np.maximum(low - position, position - high)
        row = int(np.argmax(outside))
        if outside[row] > self._worst:
            self._worst = float(outside[row])
            self._at = float(motion.time_s[row]), float(position[row])

    def violation(self) -> Violation | None:
        if self._at is None:
            return None
        time_s, position = self._at
        low, high = self._axis.range
        margin = exact(OVERSHOOT_SHARE * self._axis.span, self._unit)
        return Violation(
            self._name,
            Quantity.MOTION,
            time_s,
            position,
            low if position < low else high,
            self._unit,
            message(
                "engine",
                "the model predicts an overshoot beyond the range of more than {margin} (1 "
                "% of the range): smooth or stretch the trajectory, or keep it away from "
                "the end of the range",
            ).fill(margin=margin),
        )


class _ErrorSum:
    """Peak and rms of errors that come piece by piece, however large."""

    def __init__(self) -> None:
        self._peak = 0.0
        self._squares = 0.0  # of errors over the peak: those of an unstable loop have no square
        self._count = 0

    def add(self, error: FloatArray) -> None:
        peak = max(self._peak, float(np.abs(error).max(initial=0.0)))
        if peak > 0.0:
            self._squares *= (self._peak / peak) ** 2
            self._squares += float(np.sum((error / peak) ** 2))
        self._peak = peak
        self._count += len(error)

    def tracking(self) -> TrackingError:
        mean = self._squares / max(self._count, 1)
        return TrackingError(self._peak * float(np.sqrt(mean)), self._peak)
