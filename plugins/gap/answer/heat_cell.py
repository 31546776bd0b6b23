"""Traces behind a cell of the heat map: the part of a gap in one band during one regime."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.location import (
    AxisTravel,
    OperatingRegime,
    find_other_motion,
    find_regimes,
    is_evenly_sampled,
    split_into_bands,
)
from rotemina.sim.gap.output import GapHeatmap, GapTrace


@dataclass(frozen=True, slots=True, eq=False)
class HeatCellContribution:
    """Part of a record's gap that belongs to a cell.

    ``gap_in_cell`` is the gap, (n,), SI, filtered to the band and set to 0 outside the regime.
    ``rms`` is its rms over the rows in the regime, and ``duration_s`` is their total duration.
    """

    trace: GapTrace
    gap_in_cell: FloatArray
    rms: float
    duration_s: float


def find_contributions(
    traces: Sequence[GapTrace], heat: GapHeatmap, row: int, band: int
) -> tuple[HeatCellContribution, ...]:
    """Return the contributions of the evenly sampled records to a cell, largest first.

    Parameters
    ----------
    traces : traces of one axis at one tap, from which ``heat`` was computed.
    heat : heat map of the tap.
    row, band : indices of the regime and of the band in ``heat``.
    """
    even_traces = [trace for trace in traces if is_evenly_sampled(trace.record)]
    travel = AxisTravel.of([trace.command for trace in even_traces], even_traces[0].axis_model)
    contributions = [
        _compute_contribution(trace, heat.edges_hz, band, heat.regimes[row], travel)
        for trace in even_traces
    ]
    nonempty = [part for part in contributions if part.duration_s > 0.0]
    return tuple(sorted(nonempty, key=lambda part: -part.rms / part.trace.floor))


def _compute_contribution(
    trace: GapTrace, edges_hz: FloatArray, band: int, regime: OperatingRegime, travel: AxisTravel
) -> HeatCellContribution:
    band_gap = split_into_bands(trace.record.time_s, trace.gap_before, edges_hz)[band]
    is_other_axis_moving = find_other_motion(trace.record, trace.axis)
    is_in_regime = find_regimes(trace.record.time_s, trace.command, is_other_axis_moving, travel)[
        regime
    ]
    count = int(is_in_regime.sum())
    rms = float(np.sqrt(np.mean(band_gap[is_in_regime] ** 2))) if count else 0.0
    interval_s = trace.record.duration_s / (len(is_in_regime) - 1)
    return HeatCellContribution(
        trace, np.where(is_in_regime, band_gap, 0.0), rms, count * interval_s
    )
