"""The data that a device reports: its samples since the last read, and its state."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from typing import TYPE_CHECKING, Self

import numpy as np

from rotemina.drivers.contract.errors import ProtocolError
from rotemina.sim.arrays import (
    FloatArray,
    IntArray,
    make_read_only,
)
from rotemina.sim.compatibility import FormerMember, serve_former_names


class DeviceState(StrEnum):
    """The state of a device."""

    CLOSED = "closed"
    IDLE = "idle"
    MOVING = "moving"
    PLAYING = "playing"
    HOMING = "homing"
    FAULT = "fault"


@dataclass(frozen=True, slots=True)
class DeviceStatus:
    """The latest state of a device that its driver knows.

    Attributes
    ----------
    state : DeviceState
    progress : float
        Fraction of the trajectory that was played, 0 to 1; 1 after a complete trajectory.
    fault : str or None
        Reason for the state ``FAULT``.
    position_known : bool
        False while the position may be wrong, for example before homing.
    unhomed : tuple of str
        The axes whose position is unknown, if the device reports them.
    silent_s : float
        How long an expected message of the device has been overdue; 0 if none is. Until
        :meth:`Driver.read` raises, the loss counts as temporary. No motion can start meanwhile.
    """

    state: DeviceState
    progress: float = 0.0
    fault: str | None = None
    position_known: bool = True
    unhomed: tuple[str, ...] = ()
    silent_s: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class DeviceSamples:
    """Samples of a device, oldest first. All arrays are read-only.

    Attributes
    ----------
    device_time_s : (n,) float64
        Time on the device's clock, which is zero at ``open``. Strictly increasing, also from one
        read to the next.
    command : (n, axes) float64
        Set-points that took effect at each sample and were held until the next, m or rad.
    measured : (n, axes) float64
        Readings of the axes' sensors, taken just before the command of the same sample, m or rad.
    inputs : (n, axes) float64
        Amplifier outputs, V; NaN for axes without an amplifier (steppers), and if the device does
        not report them.
    playback_row : (n,) int64
        Row of the played trajectory that took effect at this sample. All other samples, including
        those between two rows, have -1. If several rows fall into one tick of the device, only
        the last row takes effect, and the others do not appear.
    reference : (n, axes) float64, optional
        Simultaneous readings of an independent instrument, such as a laser, m or rad; None if there
        is no instrument.

    Raises
    ------
    ProtocolError
        If the shapes do not match, time does not increase, or a time, command or reading is not
        finite.
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
            object.__setattr__(self, name, make_read_only(array))
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
                "samples: arrays of shapes {shapes} for {count} times",
                shapes=str(sorted(shapes)),
                count=count,
            )
        if self.playback_row.shape != (count,):
            raise ProtocolError(
                "samples: {rows} rows for {times} times", rows=len(self.playback_row), times=count
            )
        if not np.isfinite(self.device_time_s).all() or (np.diff(self.device_time_s) <= 0).any():
            raise ProtocolError("samples: the device's time does not increase")
        if not (np.isfinite(self.command).all() and np.isfinite(self.measured).all()):
            raise ProtocolError("samples: a command or reading is not a finite number")

    @classmethod
    # Cached because an idle driver returns this every millisecond.
    @cache
    def empty(cls, axes: int) -> Self:
        """Return an object without samples, for a machine with ``axes`` axes."""
        no_values = np.empty((0, axes))
        return cls(np.empty(0), no_values, no_values, no_values, np.empty(0, dtype=np.int64))

    @classmethod
    def join(cls, parts: Sequence[Self], axes: int) -> Self:
        """Join consecutive samples into one object."""
        if not parts:
            return cls.empty(axes)
        if len(parts) == 1:
            return parts[0]
        return cls(
            np.concatenate([part.device_time_s for part in parts]),
            np.concatenate([part.command for part in parts]),
            np.concatenate([part.measured for part in parts]),
            np.concatenate([part.inputs for part in parts]),
            np.concatenate([part.playback_row for part in parts]),
            _join_references([part.reference for part in parts]),
        )

    def __len__(self) -> int:
        return len(self.device_time_s)

    # Former names, which work for one more release.
    joined = FormerMember("join")
    none = FormerMember("empty")


def _join_references(parts: Sequence[FloatArray | None]) -> FloatArray | None:
    """Join the readings of an instrument; return None if they are missing in any part."""
    available = [part for part in parts if part is not None]
    return np.concatenate(available) if len(available) == len(parts) else None


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Samples="DeviceSamples",
    )
