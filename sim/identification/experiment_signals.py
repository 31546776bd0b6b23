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
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
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
                    message(
                        "engine",
                        "{side}: shape {shape} for the columns {names}; give an (n, columns) array",
                    ).fill(side=side, shape=str(values.shape), names=", ".join(names))
                )
            if not np.isfinite(values).all():
                raise IdentificationError(
                    message("engine", "{side}: a value is not finite").fill(side=side)
                )
            object.__setattr__(self, side, read_only(values))
        if len(self.inputs) != len(self.outputs):
            raise IdentificationError(
                message(
                    "engine",
                    "signals: {inputs} samples of input, {outputs} of output; their numbers "
                    "must be equal",
                ).fill(inputs=len(self.inputs), outputs=len(self.outputs))
            )
        if not (np.isfinite(self.rate_hz) and self.rate_hz > 0):
            raise TimeGridError(
                message("engine", "signals: rate {rate_hz} Hz; use a positive number").fill(
                    rate_hz=repr(self.rate_hz)
                )
            )

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
                message(
                    "engine",
                    "signals: {inputs} inputs and {outputs} outputs; this method takes one of "
                    "each, "
                    "choose a pair",
                ).fill(inputs=len(self.input_names), outputs=len(self.output_names))
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
        raise IdentificationError(
            message("engine", "{side}: no channel chosen; name at least one").fill(side=side)
        )
    channels = [Channel(axis, Tap(tap)) for axis, tap in pairs]
    for channel in channels:
        if channel not in record.columns:
            raise IdentificationError(
                message("engine", "{side}: the record has no {channel}; it has {names}").fill(
                    side=side, channel=str(channel), names=", ".join(map(str, record.columns))
                )
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
        raise TooShortError(
            message("engine", "time: {count} row; a rate needs at least 2").fill(count=len(time_s))
        )
    step_s = float(time_s[-1] - time_s[0]) / (len(time_s) - 1)
    off = np.abs(time_s - time_s[0] - step_s * np.arange(len(time_s)))
    worst = int(np.argmax(off))
    if off[worst] > _JITTER * step_s:
        raise TimeGridError(
            message(
                "engine",
                "time: row {worst} (t = {time_s} s) lies {off} s off the grid of {step_s} s, more "
                "than {jitter} % of a step; resample the record to a uniform rate first",
            ).fill(
                worst=worst,
                time_s=rounded(time_s[worst], 9),
                off=rounded(off[worst], 3),
                step_s=rounded(step_s, 6),
                jitter=100 * _JITTER,
            )
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
            message(
                "engine",
                "{name}: constant at {signal} over {count} samples; nothing can be identified, "
                "record a run in which it moves",
            ).fill(name=name, signal=rounded(signal[0], 9), count=len(signal))
        )


def _unit(record: Record, channel: Channel) -> str:
    return "V" if channel.tap in VOLTAGE_TAPS else record.units[channel.axis]
