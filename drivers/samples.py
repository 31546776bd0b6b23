"""A device's reports: samples since the last reading, and its state."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from typing import Self

import numpy as np

from rotemina.drivers.errors import ProtocolError
from rotemina.sim.arrays import FloatArray, IntArray, read_only
from rotemina.sim.messages import message


class DeviceState(StrEnum):
    """What a device is doing."""

    CLOSED = "closed"
    IDLE = "idle"
    MOVING = "moving"
    PLAYING = "playing"
    HOMING = "homing"
    FAULT = "fault"


@dataclass(frozen=True, slots=True)
class DeviceStatus:
    """The device's state as its driver last knew it.

    Attributes
    ----------
    state : DeviceState
    progress : float
        0 to 1: how much of the trajectory has been played; 1 after it ended by itself.
    fault : str or None
        Why the device is in ``FAULT``.
    position_known : bool
        False while the device cannot vouch for its position, for example before homing.
    unhomed : tuple of str
        The axes whose position is unknown, as far as the device tells.
    silent_s : float
        For how long the device has said nothing though it should have: a short loss, as long as
        :meth:`Driver.read` does not raise. Nothing begins to move meanwhile.
    """

    state: DeviceState
    progress: float = 0.0
    fault: str | None = None
    position_known: bool = True
    unhomed: tuple[str, ...] = ()
    silent_s: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """Samples that a device took, oldest first; all arrays read-only.

    Attributes
    ----------
    device_time_s : (n,) float64
        Strictly increasing, also from one read to the next; zero at ``open``.
    command : (n, axes) float64
        Set-points really applied at each sample and held until the next, m or rad.
    measured : (n, axes) float64
        What the axes' sensors said, before the command of the same sample acted, m or rad.
    inputs : (n, axes) float64
        Amplifier outputs, V; NaN where a device has none (steppers) or does not tell.
    playback_row : (n,) int64
        Which row of the playing trajectory began to act at this sample; -1 for any other sample,
        also for one between two rows. A device that acts at its own ticks leaves out rows that
        another one in the same tick replaced.
    reference : (n, axes) float64, optional
        What an independent instrument, such as a laser, said at the same time, m or rad; None
        where there is none.

    Raises
    ------
    ProtocolError
        If shapes disagree, time does not increase, or a time, command or reading is not finite.
    """

    device_time_s: FloatArray
    command: FloatArray
    measured: FloatArray
    inputs: FloatArray
    playback_row: IntArray
    reference: FloatArray | None = None

    def __post_init__(self) -> None:
        for name in ("device_time_s", "command", "measured", "inputs", "reference"):
            if getattr(self, name) is None:
                continue
            array = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, read_only(array))
        rows = np.ascontiguousarray(self.playback_row, dtype=np.int64).view()
        rows.flags.writeable = False
        object.__setattr__(self, "playback_row", rows)
        self._check()

    def _check(self) -> None:
        count = len(self)
        shapes = {self.command.shape, self.measured.shape, self.inputs.shape}
        if self.reference is not None:
            shapes.add(self.reference.shape)
        if len(shapes) != 1 or self.command.shape[:1] != (count,) or self.command.ndim != 2:
            raise ProtocolError(
                message("engine", "samples: arrays of shapes {shapes} for {count} times").fill(
                    shapes=str(sorted(shapes)), count=count
                )
            )
        if self.playback_row.shape != (count,):
            raise ProtocolError(
                message("engine", "samples: {rows} rows for {times} times").fill(
                    rows=len(self.playback_row), times=count
                )
            )
        if not np.isfinite(self.device_time_s).all() or (np.diff(self.device_time_s) <= 0).any():
            raise ProtocolError(message("engine", "samples: the device's time does not increase"))
        if not (np.isfinite(self.command).all() and np.isfinite(self.measured).all()):
            raise ProtocolError(
                message("engine", "samples: a command or reading is not a finite number")
            )

    @classmethod
    @cache  # asked for every millisecond
    def none(cls, axes: int) -> Self:
        """Return no samples of a machine with so many axes."""
        table = np.empty((0, axes))
        return cls(np.empty(0), table, table, table, np.empty(0, dtype=np.int64))

    @classmethod
    def joined(cls, parts: Sequence[Self], axes: int) -> Self:
        """Return consecutive samples as one."""
        if not parts:
            return cls.none(axes)
        if len(parts) == 1:
            return parts[0]
        return cls(
            np.concatenate([part.device_time_s for part in parts]),
            np.concatenate([part.command for part in parts]),
            np.concatenate([part.measured for part in parts]),
            np.concatenate([part.inputs for part in parts]),
            np.concatenate([part.playback_row for part in parts]),
            _joined([part.reference for part in parts]),
        )

    def __len__(self) -> int:
        return len(self.device_time_s)


def _joined(parts: Sequence[FloatArray | None]) -> FloatArray | None:
    """Return what an instrument said in all parts; nothing where it was missing in one."""
    known = [part for part in parts if part is not None]
    return np.concatenate(known) if len(known) == len(parts) else None
