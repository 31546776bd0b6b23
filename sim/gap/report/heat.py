"""Where in frequency, and while the axis did what, a gap lies: both at once."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.fft import dct, idct

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.regimes import Regime, regimes
from rotemina.sim.gap.report.traces import Trace
from rotemina.sim.gap.where import others_move
from rotemina.sim.records.record import Record

_HALF_DECADES = (1.0, 3.0)  # bands begin at these parts of each decade
_EVEN = 1e-3  # relative spread of sample intervals up to which a record counts as evenly sampled
_LEAST_ROWS = 64


@dataclass(frozen=True, slots=True, eq=False)
class Heat:
    """The gap of one axis at one tap, by band and regime, over all records.

    Attributes
    ----------
    edges_hz : (b + 1,)
    regimes : tuple of Regime
        Those that occur, r of them. They overlap: an axis that goes forward is also fast or slow.
    floors : (r, b)
        Rms of the band's part of the gap while in the regime, over the whole floor.
    share : (r, b)
        Of the mean square over the whole path. A row adds up to what the regime holds.
    """

    edges_hz: FloatArray
    regimes: tuple[Regime, ...]
    floors: FloatArray
    share: FloatArray


def heat(traces: Sequence[Trace]) -> Heat | None:
    """Return the heat map of the model as it was, for records of one axis at one tap.

    A record that is sampled unevenly is left out; None where none is left.
    """
    even = [trace for trace in traces if _is_even(trace.record)]
    if not even:
        return None
    edges_hz = _edges(even)
    squares = np.zeros((len(Regime), len(edges_hz) - 1))
    rows = np.zeros(len(Regime))
    whole = 0
    for trace in even:
        parts = bands(trace.record.time_s, trace.before / trace.floor, edges_hz) ** 2
        own = regimes(trace.record.time_s, trace.command, others_move(trace.record, trace.axis))
        for place, regime in enumerate(Regime):
            squares[place] += parts[:, own[regime]].sum(axis=1)
            rows[place] += own[regime].sum()
        whole += len(trace.real)
    there = rows > 0
    total = max(float(sum(np.sum((t.before / t.floor) ** 2) for t in even)), whole * 1e-300)
    return Heat(
        edges_hz,
        tuple(regime for regime, occurs in zip(Regime, there, strict=True) if occurs),
        np.sqrt(squares[there] / rows[there, None]),
        squares[there] / total,
    )


def bands(time_s: FloatArray, signal: FloatArray, edges_hz: FloatArray) -> FloatArray:
    """Split a signal (n,) into bands (b, n) that add up to it, by its cosine transform.

    The transform mirrors the signal at its ends, so that a drift does not leak into every band.
    What lies below the first edge or above the last counts to the band beside it.
    """
    count = len(signal)
    rate_hz = (count - 1) / float(time_s[-1] - time_s[0])
    frequency_hz = np.arange(count) * rate_hz / (2.0 * count)
    place = np.searchsorted(edges_hz[1:-1], frequency_hz, side="right")
    lines = dct(signal, norm="ortho")
    split = np.where(place == np.arange(len(edges_hz) - 1)[:, None], lines, 0.0)
    return np.asarray(idct(split, norm="ortho", axis=1))


def _edges(traces: Sequence[Trace]) -> FloatArray:
    """Return edges at 1, 3, 10, … Hz that hold every record's lowest and highest frequency."""
    lowest = min(1.0 / trace.record.duration_s for trace in traces)
    highest = max(0.5 * (len(t.time_s) - 1) / t.record.duration_s for t in traces)
    decades = range(int(np.floor(np.log10(lowest))), int(np.ceil(np.log10(highest))) + 1)
    steps = np.array([part * 10.0**decade for decade in decades for part in _HALF_DECADES])
    first = max(int(np.searchsorted(steps, lowest, side="right")) - 1, 0)
    last = int(np.searchsorted(steps, highest, side="left"))
    return steps[first : last + 1]


def _is_even(record: Record) -> bool:
    intervals = np.diff(record.time_s)
    if len(intervals) < _LEAST_ROWS:
        return False
    return float(np.ptp(intervals)) <= _EVEN * float(intervals.mean())
