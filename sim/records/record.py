"""A record: commands and measurements of a machine's axes over time, in SI units."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.errors import RecordError
from rotemina.sim.messages import format_rounded


class Tap(StrEnum):
    """A tap: the place in the signal chain where a channel is measured, in the signal's order.

    ``add`` is not a place in the chain but the test signal that is added to a controller's output.
    """

    CMD = "cmd"
    ADD = "add"
    U = "u"
    REF = "ref"
    MEAS = "meas"


# The metadata key is this text, a blank and the name of the axis.
REFERENCE_NOISE_KEY = "reference_noise"
VOLTAGE_TAPS = frozenset({Tap.ADD, Tap.U})


class RecordChannel(NamedTuple):
    """One column of a record: an axis and the tap at which it was measured."""

    axis: str
    tap: Tap

    def __str__(self) -> str:
        return f"{self.axis}.{self.tap}"


def _freeze(mapping: Mapping[str, str]) -> Mapping[str, str]:
    return MappingProxyType(dict(mapping))


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """Signals of one run on a common time base, or a trajectory, which has only ``cmd`` channels.

    The record takes over the array ``values`` and makes it read-only.

    Attributes
    ----------
    time_s : (n,) float64
        Strictly increasing; a command holds from its row to the next.
    columns : tuple of RecordChannel, length c
        The channels in the columns of ``values``.
    values : (n, c) float64
        SI units: m or rad for ``cmd``, ``ref`` and ``meas``; V for ``u`` and ``add``.
    units : mapping axis -> "m" or "rad"
        The quantity of each axis' position.
    metadata : mapping str -> str
        The entries of the ``# key: value`` lines.

    Raises
    ------
    RecordError
        If shapes disagree, the record is empty, a column is named twice, time does not increase,
        or a value is not finite.
    """

    time_s: FloatArray
    columns: tuple[RecordChannel, ...]
    values: FloatArray
    units: Mapping[str, str]
    metadata: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        time_s = np.array(self.time_s, dtype=np.float64)
        values = np.asarray(self.values, dtype=np.float64)
        _check_arrays(time_s, self.columns, values, self.units)
        values.flags.writeable = False
        object.__setattr__(self, "time_s", make_read_only(time_s))
        object.__setattr__(self, "values", make_read_only(values))
        object.__setattr__(self, "units", _freeze(self.units))
        object.__setattr__(self, "metadata", _freeze(self.metadata))

    @classmethod
    def from_signals(
        cls,
        time_s: FloatArray,
        signals: Mapping[tuple[str, Tap], FloatArray],
        units: Mapping[str, str],
        metadata: Mapping[str, str] | None = None,
    ) -> Self:
        """Build a record from one (n,) array per (axis, tap), in SI units."""
        columns = tuple(RecordChannel(axis, Tap(tap)) for axis, tap in signals)
        values = np.empty((len(time_s), len(columns)), order="F")
        for index, (channel, signal) in enumerate(signals.items()):
            if np.shape(signal) != (len(time_s),):
                raise RecordError(
                    "record: {names} has shape {shape}, expected {value} from time",
                    names=".".join(channel),
                    shape=str(np.shape(signal)),
                    value=str((len(time_s),)),
                )
            values[:, index] = signal
        return cls(time_s, columns, values, units, metadata or {})

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the axes, in the order of their first column."""
        return tuple(dict.fromkeys(channel.axis for channel in self.columns))

    @property
    def closed_loop(self) -> bool:
        """Whether the machine ran under its controllers (``# mode: closed_loop``)."""
        return self.metadata.get("mode") == "closed_loop"

    @property
    def history(self) -> str:
        """The state before the first row: ``"rest"``, ``"unknown"`` or ``"periodic"``."""
        return self.metadata.get("history", "rest")

    def reference_noise(self, axis: str) -> float | None:
        """Return the rms noise of an axis' ``ref``, m or rad, if the record states it, or None.

        Raises
        ------
        RecordError
            If it is not a number above 0.
        """
        key = f"{REFERENCE_NOISE_KEY} {axis}"
        text = self.metadata.get(key)
        if text is None:
            return None
        try:
            noise = float(text)
        except ValueError:
            noise = math.nan
        if not 0.0 < noise < math.inf:
            raise RecordError(
                "record: {key} = {text}: must be a number above 0, in m or rad (rms)",
                key=key,
                text=repr(text),
            )
        return noise

    @property
    def period_samples(self) -> int | None:
        """Number of rows in one period of a periodic record, or None if it is not stated."""
        text = self.metadata.get("period_samples")
        if text is None:
            return None
        if not text.isdecimal() or int(text) < 1:
            raise RecordError(
                "record: period_samples = {text}: must be a whole number above 0", text=repr(text)
            )
        return int(text)

    @property
    def duration_s(self) -> float:
        """Time from the first row to the last, s."""
        return float(self.time_s[-1] - self.time_s[0])

    def select_rows(self, rows: slice) -> Self:
        """Return a record of some of the rows, at least one."""
        return replace(self, time_s=self.time_s[rows], values=self.values[rows])

    def has(self, axis: str, tap: Tap) -> bool:
        """Return whether the record contains this tap of this axis."""
        return (axis, tap) in self.columns

    def signal(self, axis: str, tap: Tap) -> FloatArray:
        """Return the signal (n,) of one tap, SI; KeyError if the record lacks it."""
        try:
            return self.values[:, self.columns.index(RecordChannel(axis, tap))]
        except ValueError:
            raise KeyError(f"{axis}.{tap}") from None

    # Former names, which work for one more release.
    part = FormerMember("select_rows")


def _check_arrays(
    time_s: FloatArray,
    columns: tuple[RecordChannel, ...],
    values: FloatArray,
    units: Mapping[str, str],
) -> None:
    if values.shape != (len(time_s), len(columns)):
        raise RecordError(
            "record: values have shape {shape}, expected {value} from time and columns",
            shape=str(values.shape),
            value=str((len(time_s), len(columns))),
        )
    if len(time_s) == 0 or not columns:
        raise RecordError("record: it holds no rows or no columns")
    if len(set(columns)) != len(columns):
        raise RecordError("record: a column is named twice")
    missing = {channel.axis for channel in columns} - set(units)
    if missing:
        raise RecordError("record: no unit given for axis {axis}", axis=repr(sorted(missing)[0]))
    if not np.isfinite(time_s).all() or not np.isfinite(values).all():
        raise RecordError("record: a time or value is not finite")
    # Times are compared, because the differences of huge times would overflow.
    not_increasing = time_s[1:] <= time_s[:-1]
    if not_increasing.any():
        row = int(np.argmax(not_increasing)) + 1
        raise RecordError(
            "record: time does not increase at row {row} (t = {time_s} s)",
            row=row,
            time_s=format_rounded(time_s[row], 9),
        )


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Channel="RecordChannel",
        REFERENCE_NOISE="REFERENCE_NOISE_KEY",
    )
