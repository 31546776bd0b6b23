"""Inverses for a device without its own: between the session and its driver.

The session's commands are desired positions. The driver gets the commands that cause them: targets,
speeds and profiles here, trajectories by :mod:`rotemina.app.motion.compensation`. The commands of
its samples are converted back to desired positions; the commands sent are in their ``inputs``.
"""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import replace
from itertools import groupby
from types import MappingProxyType

import numpy as np

from rotemina.drivers.errors import StateError
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState, DeviceStatus, Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.held_setpoint_inverse import HeldInverse
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.messages import AxisName, message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import PiezoAxis, Robot

_NONE: Mapping[str, Exceedance] = MappingProxyType({})


class HeldInverses:
    """Owned by the session's worker, as are all calls.

    Attributes
    ----------
    beyond : mapping axis -> Exceedance
        The axes that have an inverse here, and in what each has gone beyond it; replaced as a
        whole, so any thread may look.
    """

    def __init__(self, robot: Robot) -> None:
        self.beyond = _NONE
        self._robot = robot
        self._axes = tuple(robot.axes)
        self._held: dict[str, HeldInverse] = {}
        self._sent: FloatArray | None = None  # (axes,) of the latest sample
        self._played: _Played | None = None

    def change(self, axis: str, model: InverseModel | None) -> None:
        """Apply an inverse to an axis at rest, which stays in place, or remove it.

        Raises
        ------
        CompensationError
            If it does not reach where the axis stands; then nothing changes.
        StateError
            If the device has not told yet where that is.
        """
        if model is None:
            self._held.pop(axis, None)
        elif self._sent is None:
            raise StateError(
                message("engine", "the device has sent nothing yet; wait, or reconnect")
            )
        else:
            self._held[axis] = HeldInverse(model, float(self._sent[self._axes.index(axis)]))
        self._note()

    def forget(self) -> tuple[str, ...]:
        """Remove all inverses; return their axes."""
        off = tuple(self._held)
        self._held.clear()
        self._played = None
        self._note()
        return off

    def restart(self) -> None:
        """Forget the device too: another connection begins."""
        self.forget()
        self._sent = None

    def commands_for(
        self, targets: Mapping[str, float], speeds: Mapping[str, float]
    ) -> tuple[Mapping[str, float], Mapping[str, float]]:
        """Return the commands that bring axes to targets, no faster than requested."""
        if not self._held.keys() & targets.keys():
            return targets, speeds
        targets, speeds = dict(targets), dict(speeds)
        for axis, held in self._held.items():
            if axis not in targets:
                continue
            most = self._robot.axes[axis].max_speed
            wanted = speeds.get(axis, most)
            if wanted is not None:
                speeds[axis] = _bounded(wanted * held.rate(targets[axis]), most)
            targets[axis] = held.aim(targets[axis])
        self._note()
        return targets, speeds

    def velocities(
        self, velocities: Mapping[str, float], ways: Mapping[str, float]
    ) -> Mapping[str, float]:
        """Return the speeds for the device; ``ways`` is how far each may move its axis."""
        told = dict(velocities)
        for axis in self._held.keys() & velocities.keys():
            held, most = self._held[axis], self._robot.axes[axis].max_speed
            speed = velocities[axis] * held.rate(held.wanted + ways.get(axis, 0.0))
            told[axis] = speed if most is None else float(np.clip(speed, -most, most))
        return told

    def profile(self, profile: Profile) -> Profile:
        """Return the profile for the device: each section in one direction is scaled.

        Its ends are the desired ones; in between, the curvature of the loop remains.
        """
        held = self._held.get(profile.axis)
        if held is None:
            return profile
        walk = deepcopy(held)
        at, segments = walk.wanted, []
        before = walk.aim(at)
        for _, stretch in groupby(profile.segments, lambda one: np.sign(one.length)):
            parts = tuple(stretch)
            length = sum(one.length for one in parts)
            at += length
            after = walk.aim(at)
            walk.follow(np.array([after]))
            scale = (after - before) / length if length else 1.0
            segments += [_scaled(one, scale) for one in parts]
            before = after
        return replace(profile, segments=tuple(segments))

    def refuse_voltage(self, axis: str) -> None:
        """Refuse a voltage for an axis whose set-points are the inverse's.

        Raises
        ------
        StateError
            With what to do.
        """
        if axis in self._held:
            raise StateError(
                message(
                    "engine",
                    "the inverse of axis {axis} sets its voltage; remove the inverse",
                ).fill(axis=AxisName(axis))
            )

    def play(self, wanted: Record) -> None:
        """Note that a trajectory begins whose rows were sent through the inverses."""
        paths = {axis: wanted.signal(axis, Tap.CMD) for axis in self._held if axis in wanted.axes}
        self._played = _Played(paths)

    def wanted(self, samples: Samples, status: Callable[[], DeviceStatus]) -> Samples:
        """Return samples with commands as desired positions, in the order of arrival.

        ``status`` tells whether the device is still playing.
        """
        if self._played is not None and status().state is not DeviceState.PLAYING:
            self._end_playback()
        if not len(samples):
            return samples
        self._sent = samples.command[-1]
        if not self._held:
            return samples
        command, inputs = samples.command.copy(), samples.inputs.copy()
        for axis, held in self._held.items():
            column = self._axes.index(axis)
            sent, described = samples.command[:, column], self._robot.axes[axis]
            if isinstance(described, PiezoAxis) and np.isnan(inputs[:, column]).all():
                inputs[:, column] = sent / described.gain
            played = self._played is not None and axis in self._played.paths
            if self._played is not None and played:
                command[:, column] = self._played.wanted(axis, held, sent, samples)
            else:
                command[:, column] = held.follow(sent)
        if self._played is not None:
            self._played.note(samples, self._axes)
        return replace(samples, command=command, inputs=inputs)

    def _end_playback(self) -> None:
        """Continue from the last row that acted."""
        played, self._played = self._played, None
        if played is None or self._sent is None:
            return
        for axis, sent in played.sent.items():
            if axis in self._held:
                held = self._held[axis].walked(played.paths[axis][: played.row + 1], sent)
                held.follow(self._sent[[self._axes.index(axis)]])

    def _note(self) -> None:
        self.beyond = MappingProxyType({axis: one.beyond for axis, one in self._held.items()})


class _Played:
    """A running trajectory: desired positions of its axes at each row, and its progress."""

    def __init__(self, paths: Mapping[str, FloatArray]) -> None:
        self.paths = paths
        self.row = -1
        self.sent: dict[str, float] = {}  # with the latest row

    def wanted(
        self, axis: str, held: HeldInverse, sent: FloatArray, samples: Samples
    ) -> FloatArray:
        """Return desired positions (n,), rows held; before the first, the command sent."""
        rows = np.maximum.accumulate(np.maximum(samples.playback_row, self.row))
        first = int(np.searchsorted(rows, 0))
        return np.concatenate([held.follow(sent[:first]), self.paths[axis][rows[first:]]])

    def note(self, samples: Samples, axes: tuple[str, ...]) -> None:
        """Take how far samples have come."""
        began = np.flatnonzero(samples.playback_row >= 0)
        if len(began):
            self.row = int(samples.playback_row[began[-1]])
            row = samples.command[began[-1]]
            self.sent = {axis: float(row[axes.index(axis)]) for axis in self.paths}


def _bounded(speed: float, most: float | None) -> float:
    return speed if most is None else min(speed, most)


def _scaled(segment: ProfileSegment, scale: float) -> ProfileSegment:
    c1, c2, c3 = (scale * each for each in (segment.c1, segment.c2, segment.c3))
    return replace(segment, c1=c1, c2=c2, c3=c3)
