"""Inputs and outputs of one experiment, sampled together at a stated rate."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.identification.errors import (
    ExcitationError,
    IdentificationError,
    TimeGridError,
    TooShortError,
)
from rotemina.sim.records.record import VOLTAGE_TAPS, Channel, Record, Tap

_JITTER = 1e-2  # of a step, by which a row may be off the uniform grid
_CONSTANT = 1e-12  # peak-to-peak over the largest value, below which a signal does not move


@dataclass(frozen=True, slots=True, eq=False)
class Signals:
    """One experiment.

    Attributes
    ----------
    rate_hz : samples a second.
    inputs : (n, m) SI; held from their sample to the next where they are commands.
    outputs : (n, p) SI
    input_names, output_names : names of the columns.
    input_units, output_units : "m", "rad" or "V" for each column.
    period_samples : samples in one period of a periodic experiment in its steady state.

    Raises
    ------
    IdentificationError
        If shapes or names disagree, or a number is not finite.
    """

    rate_hz: float
    inputs: FloatArray
    outputs: FloatArray
    input_names: tuple[str, ...]
    output_names: tuple[str, ...]
    input_units: tuple[str, ...]
    output_units: tuple[str, ...]
    period_samples: int | None = None

    def __post_init__(self) -> None:
        for side in ("inputs", "outputs"):
            values = np.asarray(getattr(self, side), dtype=np.float64)
            names = getattr(self, side[:-1] + "_names")
            if values.ndim != 2 or values.shape[1] != len(names) or not len(names):
                raise IdentificationError(
                    f"{side}: shape {values.shape} for the columns {list(names)}; "
                    "give an (n, columns) array"
                )
            if not np.isfinite(values).all():
                raise IdentificationError(f"{side}: a value is not finite")
            object.__setattr__(self, side, read_only(values))
        if len(self.inputs) != len(self.outputs):
            raise IdentificationError(
                f"signals: {len(self.inputs)} samples of input, {len(self.outputs)} of output; "
                "they must be as many"
            )
        if not (np.isfinite(self.rate_hz) and self.rate_hz > 0):
            raise TimeGridError(f"signals: rate {self.rate_hz!r} Hz; use a positive number")

    @property
    def count(self) -> int:
        """Number of samples n."""
        return len(self.inputs)

    def single(self) -> tuple[FloatArray, FloatArray]:
        """Return the only input and the only output, each (n,).

        Raises
        ------
        IdentificationError
            If there are several.
        """
        if self.inputs.shape[1] != 1 or self.outputs.shape[1] != 1:
            raise IdentificationError(
                f"signals: {len(self.input_names)} inputs and {len(self.output_names)} outputs; "
                "this method takes one of each, choose a pair"
            )
        return self.inputs[:, 0], self.outputs[:, 0]


def siso(
    input_signal: FloatArray,
    output_signal: FloatArray,
    rate_hz: float,
    period_samples: int | None = None,
) -> Signals:
    """Return the experiment of one input (n,) and one output (n,), named ``u`` and ``y``."""
    driven, answer = (np.asarray(signal)[:, None] for signal in (input_signal, output_signal))
    return Signals(rate_hz, driven, answer, ("u",), ("y",), ("",), ("",), period_samples)


def signals_of(
    record: Record,
    inputs: Sequence[tuple[str, Tap]],
    outputs: Sequence[tuple[str, Tap]],
) -> Signals:
    """Take an experiment out of a record.

    Parameters
    ----------
    record : sampled uniformly to 1 % of a step.
    inputs, outputs : (axis, tap) of each column, such as ``("thx", Tap.CMD)``.

    Raises
    ------
    TimeGridError
        If rows are not equally spaced.
    IdentificationError
        If the record lacks a channel.
    """
    driven, answer = (_channels(record, *side) for side in (("input", inputs), ("output", outputs)))
    period = record.period_samples if record.history == "periodic" else None
    return Signals(
        uniform_rate(record.time_s),
        np.column_stack([record.signal(*channel) for channel in driven]),
        np.column_stack([record.signal(*channel) for channel in answer]),
        tuple(map(str, driven)),
        tuple(map(str, answer)),
        tuple(_unit(record, channel) for channel in driven),
        tuple(_unit(record, channel) for channel in answer),
        period,
    )


def _channels(record: Record, side: str, pairs: Sequence[tuple[str, Tap]]) -> list[Channel]:
    if not pairs:
        raise IdentificationError(f"{side}: no channel chosen; name one at least")
    channels = [Channel(axis, Tap(tap)) for axis, tap in pairs]
    for channel in channels:
        if channel not in record.columns:
            raise IdentificationError(
                f"{side}: the record has no {channel}; it has {', '.join(map(str, record.columns))}"
            )
    return channels


def uniform_rate(time_s: FloatArray) -> float:
    """Return the rate in Hz of times (n,) that are equally spaced to 1 % of a step.

    Raises
    ------
    TooShortError, TimeGridError
        If there are fewer than two rows, or one is off the grid.
    """
    if len(time_s) < 2:
        raise TooShortError(f"time: {len(time_s)} row; a rate needs at least 2")
    step_s = float(time_s[-1] - time_s[0]) / (len(time_s) - 1)
    off = np.abs(time_s - time_s[0] - step_s * np.arange(len(time_s)))
    worst = int(np.argmax(off))
    if off[worst] > _JITTER * step_s:
        raise TimeGridError(
            f"time: row {worst} (t = {time_s[worst]:.9g} s) lies {off[worst]:.3g} s off the grid "
            f"of {step_s:.6g} s, more than {100 * _JITTER:g} % of a step; resample the record to "
            "a uniform rate first"
        )
    return 1.0 / step_s


def check_moving(signal: FloatArray, name: str) -> None:
    """Refuse a signal (n,) that is constant.

    Raises
    ------
    ExcitationError
    """
    if np.ptp(signal) <= _CONSTANT * np.max(np.abs(signal)):
        raise ExcitationError(
            f"{name}: constant at {signal[0]:.9g} over {len(signal)} samples; nothing can be "
            "identified, record a run in which it moves"
        )


def _unit(record: Record, channel: Channel) -> str:
    return "V" if channel.tap in VOLTAGE_TAPS else record.units[channel.axis]
