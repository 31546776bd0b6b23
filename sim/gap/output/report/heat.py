"""Where in frequency, and while the axis did what, a gap lies: both at once."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.location.bands import band_edges, bands, is_even
from rotemina.sim.gap.location.located_gap import others_move
from rotemina.sim.gap.location.regimes import Regime, Ways, regimes
from rotemina.sim.gap.output.report.traces import Trace


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
    """Return the heat map of the original model for records of one axis at one tap.

    Unevenly sampled records are left out; return None if none remains.
    """
    even = [trace for trace in traces if is_even(trace.record)]
    if not even:
        return None
    edges_hz = band_edges([trace.record for trace in even])
    ways = Ways.of([trace.command for trace in even], even[0].described)
    squares = np.zeros((len(Regime), len(edges_hz) - 1))
    rows = np.zeros(len(Regime))
    whole = 0
    for trace in even:
        parts = bands(trace.record.time_s, trace.before / trace.floor, edges_hz) ** 2
        others = others_move(trace.record, trace.axis)
        own = regimes(trace.record.time_s, trace.command, others, ways)
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
