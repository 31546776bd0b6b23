"""Inputs and outputs of one experiment, sampled together at a stated rate."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.errors import (
    IdentificationError,
    InsufficientExcitationError,
    TimeGridError,
    TooShortError,
)
from rotemina.sim.messages import format_rounded
from rotemina.sim.records import (
    VOLTAGE_TAPS,
    Record,
    RecordChannel,
    Tap,
)

# Largest distance of a row from the uniform time grid, as a share of one time step.
_MAX_JITTER_RATIO = 1e-2
# A signal counts as constant if its peak-to-peak value is below this share of its largest value.
_MIN_PEAK_TO_PEAK_RATIO = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class ExperimentSignals:
    """Inputs and outputs of one experiment, in SI units.

    Attributes
    ----------
    rate_hz : float
        Sampling rate, Hz.
    inputs : (n, m)
        Inputs; a command is held from its sample until the next.
    outputs : (n, p)
        Outputs.
    input_names, output_names : tuple of str
        Names of the columns.
    input_units, output_units : tuple of str
        "m", "rad" or "V" for each column.
    period_samples : int or None
        Samples in one period of a periodic experiment in its steady state.

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
                    "{side}: shape {shape} for the columns {names}; give an (n, columns) array",
                    side=side,
                    shape=str(values.shape),
                    names=", ".join(names),
                )
            if not np.isfinite(values).all():
                raise IdentificationError("{side}: a value is not finite", side=side)
            object.__setattr__(self, side, make_read_only(values))
        if len(self.inputs) != len(self.outputs):
            raise IdentificationError(
                "signals: {inputs} samples of input, {outputs} of output; both numbers must"
                " be equal",
                inputs=len(self.inputs),
                outputs=len(self.outputs),
            )
        if not (np.isfinite(self.rate_hz) and self.rate_hz > 0):
            raise TimeGridError(
                "signals: rate {rate_hz} Hz; use a positive number", rate_hz=repr(self.rate_hz)
            )

    @property
    def count(self) -> int:
        """Number of samples n."""
        return len(self.inputs)

    def require_single_pair(self) -> tuple[FloatArray, FloatArray]:
        """Return the only input and the only output, each (n,).

        Raises
        ------
        IdentificationError
            If there are several inputs or outputs.
        """
        if self.inputs.shape[1] != 1 or self.outputs.shape[1] != 1:
            raise IdentificationError(
                "signals: {inputs} inputs and {outputs} outputs; this method takes one of "
                "each, choose a pair",
                inputs=len(self.input_names),
                outputs=len(self.output_names),
            )
        return self.inputs[:, 0], self.outputs[:, 0]


def make_siso_signals(
    input_signal: FloatArray,
    output_signal: FloatArray,
    rate_hz: float,
    period_samples: int | None = None,
) -> ExperimentSignals:
    """Return the experiment of one input (n,) and one output (n,), named ``u`` and ``y``."""
    inputs, outputs = (np.asarray(signal)[:, None] for signal in (input_signal, output_signal))
    return ExperimentSignals(rate_hz, inputs, outputs, ("u",), ("y",), ("",), ("",), period_samples)


def signals_from_record(
    record: Record,
    inputs: Sequence[tuple[str, Tap]],
    outputs: Sequence[tuple[str, Tap]],
) -> ExperimentSignals:
    """Make an experiment from channels of a record.

    Parameters
    ----------
    record : Record
        Must be sampled uniformly to 1 % of a time step.
    inputs, outputs : sequence of (axis, tap)
        One pair for each column, such as ``("thx", Tap.CMD)``.

    Raises
    ------
    TimeGridError
        If rows are not equally spaced.
    IdentificationError
        If the record lacks a channel.
    """
    input_channels, output_channels = (
        _find_channels(record, *side) for side in (("input", inputs), ("output", outputs))
    )
    period = record.period_samples if record.history == "periodic" else None
    return ExperimentSignals(
        find_uniform_rate(record.time_s),
        np.column_stack([record.signal(*channel) for channel in input_channels]),
        np.column_stack([record.signal(*channel) for channel in output_channels]),
        tuple(map(str, input_channels)),
        tuple(map(str, output_channels)),
        tuple(_unit_of(record, channel) for channel in input_channels),
        tuple(_unit_of(record, channel) for channel in output_channels),
        period,
    )


def _find_channels(
    record: Record, side: str, pairs: Sequence[tuple[str, Tap]]
) -> list[RecordChannel]:
    if not pairs:
        raise IdentificationError("{side}: no channel chosen; name at least one", side=side)
    channels = [RecordChannel(axis, Tap(tap)) for axis, tap in pairs]
    for channel in channels:
        if channel not in record.columns:
            raise IdentificationError(
                "{side}: the record has no {channel}; it has {names}",
                side=side,
                channel=str(channel),
                names=", ".join(map(str, record.columns)),
            )
    return channels


def find_uniform_rate(time_s: FloatArray) -> float:
    """Return the sampling rate, Hz, of times (n,) that are equally spaced to 1 % of a step.

    Raises
    ------
    TooShortError
        If there are fewer than two rows.
    TimeGridError
        If a row is off the grid.
    """
    if len(time_s) < 2:
        raise TooShortError("time: {count} row; a rate needs at least 2", count=len(time_s))
    step_s = float(time_s[-1] - time_s[0]) / (len(time_s) - 1)
    deviation = np.abs(time_s - time_s[0] - step_s * np.arange(len(time_s)))
    worst_row = int(np.argmax(deviation))
    if deviation[worst_row] > _MAX_JITTER_RATIO * step_s:
        raise TimeGridError(
            "time: row {worst} (t = {time_s} s) lies {off} s off the grid of {step_s} s, more "
            "than {jitter} % of a step; resample the record to a uniform rate first",
            worst=worst_row,
            time_s=format_rounded(time_s[worst_row], 9),
            off=format_rounded(deviation[worst_row], 3),
            step_s=format_rounded(step_s, 6),
            jitter=100 * _MAX_JITTER_RATIO,
        )
    return 1.0 / step_s


def check_moving(signal: FloatArray, name: str) -> None:
    """Check that a signal (n,) is not constant.

    Raises
    ------
    InsufficientExcitationError
        If it is constant.
    """
    if np.ptp(signal) <= _MIN_PEAK_TO_PEAK_RATIO * np.max(np.abs(signal)):
        raise InsufficientExcitationError(
            "{name}: constant at {signal} over {count} samples; nothing can be identified, "
            "record a run in which it moves",
            name=name,
            signal=format_rounded(signal[0], 9),
            count=len(signal),
        )


def _unit_of(record: Record, channel: RecordChannel) -> str:
    return "V" if channel.tap in VOLTAGE_TAPS else record.units[channel.axis]
