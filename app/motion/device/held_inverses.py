"""Inverses that the host applies for a device that cannot apply them itself.

The session's commands are desired positions. The driver receives the commands that produce them.
Targets, speeds and profiles are converted here, trajectories in
:mod:`rotemina.app.motion.session`. In the device's samples, ``command`` is converted back to
desired positions, and ``inputs`` holds the commands that were sent.
"""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import replace
from itertools import groupby
from types import MappingProxyType

import numpy as np

from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.drivers.contract import (
    DeviceSamples,
    DeviceState,
    DeviceStatus,
    StateError,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate import InverseExceedance, InverseModel, SetpointInverse
from rotemina.sim.messages import AxisName
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import PiezoAxis, Robot

_NO_EXCEEDANCES: Mapping[str, InverseExceedance] = MappingProxyType({})


class HostInverses:
    """Inverses that the host applies to the commands of axes; used only by the session's worker.

    Attributes
    ----------
    exceedances : mapping axis -> InverseExceedance
        How each axis that has an inverse has left its training range. Replaced as a whole, so any
        thread may read it.
    """

    def __init__(self, robot: Robot) -> None:
        self.exceedances = _NO_EXCEEDANCES
        self._robot = robot
        self._axes = tuple(robot.axes)
        self._inverses: dict[str, SetpointInverse] = {}
        # Command (axes,) of the latest sample.
        self._latest_command: FloatArray | None = None
        self._trajectory: _RunningTrajectory | None = None

    def set_inverse(self, axis: str, model: InverseModel | None) -> None:
        """Apply an inverse to an axis at rest without moving the axis; None removes the inverse.

        Raises
        ------
        CompensationError
            If the inverse cannot produce the current position of the axis; then nothing changes.
        StateError
            If the device has not sent that position yet.
        """
        if model is None:
            self._inverses.pop(axis, None)
        elif self._latest_command is None:
            raise StateError("the device has sent nothing yet; wait, or reconnect")
        else:
            self._inverses[axis] = SetpointInverse(
                model, float(self._latest_command[self._axes.index(axis)])
            )
        self._update_exceedances()

    def forget(self) -> tuple[str, ...]:
        """Remove all inverses, and return their axes."""
        axes = tuple(self._inverses)
        self._inverses.clear()
        self._trajectory = None
        self._update_exceedances()
        return axes

    def restart(self) -> None:
        """Forget all inverses and samples when another connection begins."""
        self.forget()
        self._latest_command = None

    def convert_targets(
        self, targets: Mapping[str, float], speeds: Mapping[str, float]
    ) -> tuple[Mapping[str, float], Mapping[str, float]]:
        """Return the commands and speeds that move axes to targets, no faster than requested."""
        if not self._inverses.keys() & targets.keys():
            return targets, speeds
        targets, speeds = dict(targets), dict(speeds)
        for axis, inverse in self._inverses.items():
            if axis not in targets:
                continue
            max_speed = self._robot.axes[axis].max_speed
            speed = speeds.get(axis, max_speed)
            if speed is not None:
                speeds[axis] = _bound_speed(
                    speed * inverse.compute_speed_factor(targets[axis]), max_speed
                )
            targets[axis] = inverse.add_setpoint(targets[axis])
        self._update_exceedances()
        return targets, speeds

    def convert_velocities(
        self, velocities: Mapping[str, float], travels: Mapping[str, float]
    ) -> Mapping[str, float]:
        """Return the velocities for the device.

        ``travels`` is the distance that each axis may cover at its velocity.
        """
        converted = dict(velocities)
        for axis in self._inverses.keys() & velocities.keys():
            inverse, max_speed = self._inverses[axis], self._robot.axes[axis].max_speed
            velocity = velocities[axis] * inverse.compute_speed_factor(
                inverse.desired + travels.get(axis, 0.0)
            )
            converted[axis] = (
                velocity if max_speed is None else float(np.clip(velocity, -max_speed, max_speed))
            )
        return converted

    def convert_profile(self, profile: MotionProfile) -> MotionProfile:
        """Return the profile for the device.

        Each section in one direction is scaled so that it ends at the desired position. Within a
        section the curvature of the hysteresis loop is not corrected.
        """
        if profile.axis not in self._inverses:
            return profile
        # Work on a copy, because the real inverse advances only when the profile runs.
        inverse = deepcopy(self._inverses[profile.axis])
        position, segments = inverse.desired, []
        command = inverse.add_setpoint(position)
        for _, group in groupby(profile.segments, lambda segment: np.sign(segment.displacement)):
            section = tuple(group)
            displacement = sum(segment.displacement for segment in section)
            position += displacement
            next_command = inverse.add_setpoint(position)
            inverse.advance(np.array([next_command]))
            scale = (next_command - command) / displacement if displacement else 1.0
            segments += [_scale_segment(segment, scale) for segment in section]
            command = next_command
        return replace(profile, segments=tuple(segments))

    def refuse_voltage(self, axis: str) -> None:
        """Refuse to set a voltage on an axis whose voltage the inverse sets.

        Raises
        ------
        StateError
            If the axis has an inverse. The message says how to remove it.
        """
        if axis in self._inverses:
            raise StateError(
                "the inverse of axis {axis} sets its voltage; remove the inverse",
                axis=AxisName(axis),
            )

    def begin_playback(self, desired: Record) -> None:
        """Remember the desired positions of a trajectory whose converted rows are being played."""
        desired_positions = {
            axis: desired.signal(axis, Tap.CMD) for axis in self._inverses if axis in desired.axes
        }
        self._trajectory = _RunningTrajectory(desired_positions)

    def convert_samples(
        self, samples: DeviceSamples, read_status: Callable[[], DeviceStatus]
    ) -> DeviceSamples:
        """Return the samples with desired positions as commands; call it in the order of arrival.

        ``read_status`` returns the device's status, which shows whether it is still playing.
        """
        if self._trajectory is not None and read_status().state is not DeviceState.PLAYING:
            self._end_playback()
        if not len(samples):
            return samples
        self._latest_command = samples.command[-1]
        if not self._inverses:
            return samples
        command, inputs = samples.command.copy(), samples.inputs.copy()
        for axis, inverse in self._inverses.items():
            column = self._axes.index(axis)
            sent, axis_model = samples.command[:, column], self._robot.axes[axis]
            # If the device reports no inputs, derive the voltages from the commands that were sent.
            if isinstance(axis_model, PiezoAxis) and np.isnan(inputs[:, column]).all():
                inputs[:, column] = sent / axis_model.gain
            is_playing = self._trajectory is not None and axis in self._trajectory.desired_positions
            if self._trajectory is not None and is_playing:
                command[:, column] = self._trajectory.find_desired_positions(
                    axis, inverse, sent, samples
                )
            else:
                command[:, column] = inverse.advance(sent)
        if self._trajectory is not None:
            self._trajectory.note_progress(samples, self._axes)
        return replace(samples, command=command, inputs=inputs)

    def _end_playback(self) -> None:
        """Continue the inverses from the last row that the device has applied."""
        trajectory, self._trajectory = self._trajectory, None
        if trajectory is None or self._latest_command is None:
            return
        for axis, sent in trajectory.latest_commands.items():
            if axis in self._inverses:
                inverse = self._inverses[axis]
                inverse.resume_after(trajectory.desired_positions[axis][: trajectory.row + 1], sent)
                inverse.advance(self._latest_command[[self._axes.index(axis)]])

    def _update_exceedances(self) -> None:
        self.exceedances = MappingProxyType(
            {axis: inverse.exceedance for axis, inverse in self._inverses.items()}
        )


class _RunningTrajectory:
    def __init__(self, desired_positions: Mapping[str, FloatArray]) -> None:
        self.desired_positions = desired_positions
        self.row = -1
        # Commands that were sent with the latest row.
        self.latest_commands: dict[str, float] = {}

    def find_desired_positions(
        self, axis: str, inverse: SetpointInverse, sent: FloatArray, samples: DeviceSamples
    ) -> FloatArray:
        """Return desired positions (n,).

        Each row holds until the next one. Before the first row the positions follow from the
        commands that were sent.
        """
        rows = np.maximum.accumulate(np.maximum(samples.playback_row, self.row))
        first_played = int(np.searchsorted(rows, 0))
        return np.concatenate(
            [
                inverse.advance(sent[:first_played]),
                self.desired_positions[axis][rows[first_played:]],
            ]
        )

    def note_progress(self, samples: DeviceSamples, axes: tuple[str, ...]) -> None:
        """Update the latest row and its commands from samples."""
        played_samples = np.flatnonzero(samples.playback_row >= 0)
        if len(played_samples):
            self.row = int(samples.playback_row[played_samples[-1]])
            command = samples.command[played_samples[-1]]
            self.latest_commands = {
                axis: float(command[axes.index(axis)]) for axis in self.desired_positions
            }


def _bound_speed(speed: float, max_speed: float | None) -> float:
    return speed if max_speed is None else min(speed, max_speed)


def _scale_segment(segment: ProfileSegment, scale: float) -> ProfileSegment:
    c1, c2, c3 = (scale * coefficient for coefficient in (segment.c1, segment.c2, segment.c3))
    return replace(segment, c1=c1, c2=c2, c3=c3)
