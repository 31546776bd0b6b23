"""A record: commands and measurements of a machine's axes over time, in SI units."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from types import MappingProxyType
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded


class RecordError(InputError):
    """A record or trajectory that cannot be read, written or used."""


class Tap(StrEnum):
    """Where in the signal chain a channel is taken, in the order a signal passes.

    ``add`` is no tap of the chain: it is the test signal added to a controller's output.
    """

    CMD = "cmd"
    ADD = "add"
    U = "u"
    REF = "ref"
    MEAS = "meas"


REFERENCE_NOISE = "reference_noise"  # with the axis behind it: a key of the metadata
VOLTAGE_TAPS = frozenset({Tap.ADD, Tap.U})


class Channel(NamedTuple):
    """One column of a record: an axis and the tap at which it was taken."""

    axis: str
    tap: Tap

    def __str__(self) -> str:
        return f"{self.axis}.{self.tap}"


def _frozen(mapping: Mapping[str, str]) -> Mapping[str, str]:
    return MappingProxyType(dict(mapping))


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """Signals of one run, sampled together; also a trajectory, which has ``cmd`` channels alone.

    The record takes the array ``values`` over: it can no longer be written through.

    Attributes
    ----------
    time_s : (n,) float64
        Strictly increasing; a command holds from its row to the next.
    columns : tuple of Channel, length c
        What each column of ``values`` is.
    values : (n, c) float64
        SI units: m or rad for ``cmd``, ``ref`` and ``meas``; V for ``u`` and ``add``.
    units : mapping axis -> "m" or "rad"
        The quantity of each axis' position.
    metadata : mapping str -> str
        What ``# key: value`` lines said.

    Raises
    ------
    RecordError
        If shapes disagree, the record is empty, a column is named twice, time does not increase
        or a value is not finite.
    """

    time_s: FloatArray
    columns: tuple[Channel, ...]
    values: FloatArray
    units: Mapping[str, str]
    metadata: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        time_s = np.array(self.time_s, dtype=np.float64)
        values = np.asarray(self.values, dtype=np.float64)
        _check(time_s, self.columns, values, self.units)
        values.flags.writeable = False
        object.__setattr__(self, "time_s", read_only(time_s))
        object.__setattr__(self, "values", read_only(values))
        object.__setattr__(self, "units", _frozen(self.units))
        object.__setattr__(self, "metadata", _frozen(self.metadata))

    @classmethod
    def from_signals(
        cls,
        time_s: FloatArray,
        signals: Mapping[tuple[str, Tap], FloatArray],
        units: Mapping[str, str],
        metadata: Mapping[str, str] | None = None,
    ) -> Self:
        """Build a record from one (n,) array per (axis, tap), in SI units."""
        columns = tuple(Channel(axis, Tap(tap)) for axis, tap in signals)
        values = np.empty((len(time_s), len(columns)), order="F")
        for index, (channel, signal) in enumerate(signals.items()):
            if np.shape(signal) != (len(time_s),):
                raise RecordError(
                    message(
                        "engine", "record: {names} has shape {shape}, expected {value} from time"
                    ).fill(
                        names=".".join(channel),
                        shape=str(np.shape(signal)),
                        value=str((len(time_s),)),
                    )
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
        """What came before the first row: ``"rest"``, ``"unknown"`` or ``"periodic"``."""
        return self.metadata.get("history", "rest")

    def reference_noise(self, axis: str) -> float | None:
        """Return the rms doubt, m or rad, that the record gives for an axis' ``ref``, or None.

        Raises
        ------
        RecordError
            If it is no number above 0.
        """
        key = f"{REFERENCE_NOISE} {axis}"
        text = self.metadata.get(key)
        if text is None:
            return None
        try:
            noise = float(text)
        except ValueError:
            noise = math.nan
        if not 0.0 < noise < math.inf:
            raise RecordError(
                message(
                    "engine", "record: {key} = {text}: must be a number above 0, in m or rad (rms)"
                ).fill(key=key, text=repr(text))
            )
        return noise

    @property
    def period_samples(self) -> int | None:
        """Rows in one period of a periodic record, or None where the metadata gives none."""
        text = self.metadata.get("period_samples")
        if text is None:
            return None
        if not text.isdecimal() or int(text) < 1:
            raise RecordError(
                message(
                    "engine", "record: period_samples = {text}: must be a whole number above 0"
                ).fill(text=repr(text))
            )
        return int(text)

    @property
    def duration_s(self) -> float:
        """Time from the first row to the last, s."""
        return float(self.time_s[-1] - self.time_s[0])

    def part(self, rows: slice) -> Self:
        """Return some of the rows, at least one, as a record of their own."""
        return replace(self, time_s=self.time_s[rows], values=self.values[rows])

    def has(self, axis: str, tap: Tap) -> bool:
        """Whether the record holds this tap of this axis."""
        return (axis, tap) in self.columns

    def signal(self, axis: str, tap: Tap) -> FloatArray:
        """Return the (n,) signal of one tap, SI; KeyError if the record lacks it."""
        try:
            return self.values[:, self.columns.index(Channel(axis, tap))]
        except ValueError:
            raise KeyError(f"{axis}.{tap}") from None


def _check(
    time_s: FloatArray, columns: tuple[Channel, ...], values: FloatArray, units: Mapping[str, str]
) -> None:
    if values.shape != (len(time_s), len(columns)):
        raise RecordError(
            message(
                "engine",
                "record: values have shape {shape}, expected {value} from time and columns",
            ).fill(shape=str(values.shape), value=str((len(time_s), len(columns))))
        )
    if len(time_s) == 0 or not columns:
        raise RecordError(message("engine", "record: it holds no rows or no columns"))
    if len(set(columns)) != len(columns):
        raise RecordError(message("engine", "record: a column is named twice"))
    missing = {channel.axis for channel in columns} - set(units)
    if missing:
        raise RecordError(
            message("engine", "record: no unit given for axis {axis}").fill(
                axis=repr(sorted(missing)[0])
            )
        )
    if not np.isfinite(time_s).all() or not np.isfinite(values).all():
        raise RecordError(message("engine", "record: a time or value is not finite"))
    stuck = time_s[1:] <= time_s[:-1]  # no differences: those of huge times overflow
    if stuck.any():
        row = int(np.argmax(stuck)) + 1
        raise RecordError(
            message("engine", "record: time does not increase at row {row} (t = {time_s} s)").fill(
                row=row, time_s=rounded(time_s[row], 9)
            )
        )
