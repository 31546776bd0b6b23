"""Prediction of a trajectory by the nominal model: tracking errors, and motion outside the range.

The model runs through the instants of the device's schedule in chunks, so that a long trajectory
needs no more memory than a short one.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.errors import PlantError
from rotemina.sim.messages import message
from rotemina.sim.plant import Plant
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory.schedule import PlaybackSchedule
from rotemina.sim.trajectory.trajectory_excesses import LimitedQuantity, LimitViolation
from rotemina.sim.units import format_exact

#: Permitted predicted overshoot beyond the range, relative to the length of the range.
MAX_OVERSHOOT_RATIO = 0.01
# Axes without a controller may ring fast, so they are sampled several times per set-point period.
_SAMPLES_PER_PERIOD = 4
# The halt after the last row is simulated for this time.
_HALT_DURATION_S = 0.5
_CHUNK_INSTANTS = 1 << 16


class TrackingError(NamedTuple):
    """Predicted position minus command at the rows of a trajectory, m or rad."""

    rms: float
    peak: float


@dataclass(frozen=True, slots=True)
class MotionPrediction:
    """A prediction: tracking errors by axis, and axes that leave their range.

    ``fault`` is the reason why the model cannot be simulated to the end; ``errors`` is then empty.
    """

    errors: Mapping[str, TrackingError]
    violations: tuple[LimitViolation, ...]
    fault: str | None = None


def predict_motion(robot: Robot, trajectory: Record, setpoint_period_s: float) -> MotionPrediction:
    """Run the nominal model through a trajectory, from rest at its first row.

    Controllers act at the device's set-point period. An axis leaves its range when it is outside by
    more than ``MAX_OVERSHOOT_RATIO`` of the range.
    """
    watches = {name: _AxisWatch(robot, name) for name in trajectory.axes}
    try:
        for motion in _simulate_chunks(robot, trajectory, setpoint_period_s):
            for name, watch in watches.items():
                watch.add(motion, motion.axes.index(name))
    except PlantError as error:
        return MotionPrediction({}, _collect_violations(watches), str(error))
    errors = {name: watch.error.make_tracking_error() for name, watch in watches.items()}
    return MotionPrediction(errors, _collect_violations(watches))


def _collect_violations(watches: Mapping[str, "_AxisWatch"]) -> tuple[LimitViolation, ...]:
    violations = [watch.make_violation() for watch in watches.values()]
    return tuple(violation for violation in violations if violation is not None)


class _MotionChunk(NamedTuple):
    """Instants (n,), commands and positions (n, axes), and whether an instant is a row (n,)."""

    axes: tuple[str, ...]
    time_s: FloatArray
    command: FloatArray
    position: FloatArray
    on_row: BoolArray


def _simulate_chunks(robot: Robot, trajectory: Record, period_s: float) -> Iterator[_MotionChunk]:
    plant = Plant.of(robot, closed_loop=True, only=trajectory.axes)
    has_loop = any(plant.loops)
    tick_s = period_s if has_loop else period_s / _SAMPLES_PER_PERIOD
    schedule = PlaybackSchedule(trajectory, plant.axes, tick_s, on_ticks=has_loop)
    home_position = np.array(
        [axis.range[0] for axis in plant.robot.axes.values()], dtype=np.float64
    )
    state = plant.find_rest_state(
        0.0, schedule.commands(np.zeros(1, dtype=np.int64), home_position)[0]
    )
    first_instant, chunk_size, chunk_start_s = 0, _CHUNK_INSTANTS, 0.0
    command = np.empty((0, len(plant.axes)))
    while first_instant < schedule.count:
        instants = schedule.instants(first_instant, first_instant + chunk_size)
        command = schedule.commands(instants.row, home_position)
        elapsed_s = schedule.compute_elapsed(chunk_start_s, instants.time_s)
        try:
            motion, end_state = plant.advance(state, elapsed_s, command)
        except PlantError:
            if chunk_size == 1:
                raise
            # With smaller chunks, the motion before the overflow is still predicted.
            chunk_size = max(chunk_size // 8, 1)
            continue
        state = replace(end_state, time_s=end_state.time_s - end_state.time_s[-1])
        first_instant, chunk_start_s = first_instant + chunk_size, float(instants.time_s[-1])
        time_s = trajectory.time_s[0] + instants.time_s
        yield _MotionChunk(plant.axes, time_s, command, motion.position, instants.on_row)
    halt_s = (np.arange(1, round(_HALT_DURATION_S / tick_s) + 1) * tick_s).astype(np.float64)
    command = np.repeat(command[-1:], len(halt_s), axis=0)
    motion, _ = plant.advance(state, halt_s, command)
    no_rows = np.zeros(len(halt_s), dtype=np.bool_)
    yield _MotionChunk(
        plant.axes, trajectory.time_s[-1] + halt_s, command, motion.position, no_rows
    )


class _AxisWatch:
    def __init__(self, robot: Robot, name: str) -> None:
        self.error = _ErrorSum()
        self._name = name
        self._axis = robot.axes[name]
        self._unit = robot.unit(name) or ""
        self._worst_overshoot = MAX_OVERSHOOT_RATIO * self._axis.span
        self._worst_instant: tuple[float, float] | None = None

    def add(self, motion: _MotionChunk, column: int) -> None:
        position = motion.position[:, column]
        self.error.add((position - motion.command[:, column])[motion.on_row])
        low, high = self._axis.range
        overshoot = np.maximum(low - position, position - high)
        row = int(np.argmax(overshoot))
        if overshoot[row] > self._worst_overshoot:
            self._worst_overshoot = float(overshoot[row])
            self._worst_instant = float(motion.time_s[row]), float(position[row])

    def make_violation(self) -> LimitViolation | None:
        if self._worst_instant is None:
            return None
        time_s, position = self._worst_instant
        low, high = self._axis.range
        margin = format_exact(MAX_OVERSHOOT_RATIO * self._axis.span, self._unit)
        return LimitViolation(
            self._name,
            LimitedQuantity.MOTION,
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
    def __init__(self) -> None:
        self._peak = 0.0
        # The errors are divided by the peak, because the squares of an unstable loop may overflow.
        self._scaled_square_sum = 0.0
        self._count = 0

    def add(self, error: FloatArray) -> None:
        peak = max(self._peak, float(np.abs(error).max(initial=0.0)))
        if peak > 0.0:
            self._scaled_square_sum *= (self._peak / peak) ** 2
            self._scaled_square_sum += float(np.sum((error / peak) ** 2))
        self._peak = peak
        self._count += len(error)

    def make_tracking_error(self) -> TrackingError:
        scaled_mean_square = self._scaled_square_sum / max(self._count, 1)
        return TrackingError(self._peak * float(np.sqrt(scaled_mean_square)), self._peak)
