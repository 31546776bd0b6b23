"""What lies behind a cell of the heat map: the part of a gap in one band, while in one regime."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.location.bands import bands, is_even
from rotemina.sim.gap.location.located_gap import others_move
from rotemina.sim.gap.location.regimes import Regime, Ways, regimes
from rotemina.sim.gap.output.report.heat import Heat
from rotemina.sim.gap.output.report.traces import Trace


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """What one record holds of a cell; signals (n,), SI.

    ``within`` is the band's part of the gap while in the regime, 0 elsewhere; ``rms`` that of it
    over the rows of the regime, of which there are ``seconds``.
    """

    trace: Trace
    within: FloatArray
    rms: float
    seconds: float


def parts(traces: Sequence[Trace], heat: Heat, row: int, band: int) -> tuple[Part, ...]:
    """Return what each evenly sampled record holds of a cell, the one with most first.

    Parameters
    ----------
    traces : of one axis at one tap, of which ``heat`` was made.
    row, band : which of the regimes and of the bands of ``heat``.
    """
    even = [trace for trace in traces if is_even(trace.record)]
    ways = Ways.of([trace.command for trace in even], even[0].described)
    found = [_part(trace, heat.edges_hz, band, heat.regimes[row], ways) for trace in even]
    there = [part for part in found if part.seconds > 0.0]
    return tuple(sorted(there, key=lambda part: -part.rms / part.trace.floor))


def _part(trace: Trace, edges_hz: FloatArray, band: int, regime: Regime, ways: Ways) -> Part:
    own = bands(trace.record.time_s, trace.before, edges_hz)[band]
    others = others_move(trace.record, trace.axis)
    rows = regimes(trace.record.time_s, trace.command, others, ways)[regime]
    count = int(rows.sum())
    rms = float(np.sqrt(np.mean(own[rows] ** 2))) if count else 0.0
    interval_s = trace.record.duration_s / (len(rows) - 1)
    return Part(trace, np.where(rows, own, 0.0), rms, count * interval_s)
