"""Cutting the record of a playback out of the samples that a device delivers."""

from collections.abc import Mapping

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot, StepperAxis
from rotemina.sim.trajectory.dry_run import as_played


class PlaybackRecorder:
    """Collects the samples that belong to rows of one trajectory.

    The record has the trajectory's axes with ``cmd``, ``u`` (not of steppers, and only where the
    device tells it) and ``meas``, at the trajectory's own times from 0. Its metadata say mode,
    robot, device, and the trajectory's name where that has one (``# trajectory:`` or ``# name:``).
    """

    def __init__(self, robot: Robot, trajectory: Record, device: str) -> None:
        played = as_played(robot, trajectory)
        self._robot = robot
        self._units = played.units
        self._time_s = trajectory.time_s - trajectory.time_s[0]
        self._axes = played.axes
        self._parts: list[Samples] = []
        self._rows = 0
        self._metadata = {
            "mode": played.metadata["mode"],
            "robot": robot.name,
            "device": device,
            **_name_of(trajectory.metadata),
        }

    @property
    def complete(self) -> bool:
        """Whether every row of the trajectory was sampled."""
        return self._rows == len(self._time_s)

    def add(self, samples: Samples) -> None:
        """Take what belongs to the trajectory."""
        own = samples.playback_row >= 0
        if own.any():
            self._parts.append(
                Samples(
                    samples.device_time_s[own],
                    samples.command[own],
                    samples.measured[own],
                    samples.inputs[own],
                    samples.playback_row[own],
                )
            )
            self._rows += int(own.sum())

    def finish(self) -> Record | None:
        """Return the record of what was played; None if that never began.

        Raises
        ------
        RecordError
            If the device named rows that do not follow one another.
        """
        if not self._parts:
            return None
        order = tuple(self._robot.axes)
        samples = Samples.joined(self._parts, len(order))
        signals = {}
        for name in self._axes:
            column = order.index(name)
            signals[name, Tap.CMD] = samples.command[:, column]
            voltage = samples.inputs[:, column]
            stepper = isinstance(self._robot.axes[name], StepperAxis)
            if not stepper and np.isfinite(voltage).all():
                signals[name, Tap.U] = voltage
            signals[name, Tap.MEAS] = samples.measured[:, column]
        time_s = self._time_s[samples.playback_row]
        return Record.from_signals(time_s, signals, self._units, self._metadata)


def _name_of(metadata: Mapping[str, str]) -> dict[str, str]:
    name = metadata.get("trajectory") or metadata.get("name")
    return {"trajectory": name} if name else {}
