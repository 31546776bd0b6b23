"""Heat map of a gap, by frequency band and operating regime."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.location import (
    AxisTravel,
    OperatingRegime,
    find_band_edges,
    find_other_motion,
    find_regimes,
    is_evenly_sampled,
    split_into_bands,
)
from rotemina.sim.gap.output.traces import GapTrace


@dataclass(frozen=True, slots=True, eq=False)
class GapHeatmap:
    """The gap of one axis at one tap, by band and regime, over all records.

    Attributes
    ----------
    edges_hz : (b + 1,)
        Edges of the frequency bands.
    regimes : tuple of OperatingRegime
        The r regimes that occur. They overlap: an axis moving forward is also either fast or slow.
    floors : (r, b)
        Rms of the gap in each band during each regime, in noise floors.
    share : (r, b)
        Fraction of the sum of squares of the gap. The sum of a row is the share of the regime.
    """

    edges_hz: FloatArray
    regimes: tuple[OperatingRegime, ...]
    floors: FloatArray
    share: FloatArray


def make_heatmap(traces: Sequence[GapTrace]) -> GapHeatmap | None:
    """Return the heat map of the gap of the original model, for records of one axis at one tap.

    Unevenly sampled records are omitted. Returns None if no record remains.
    """
    even_traces = [trace for trace in traces if is_evenly_sampled(trace.record)]
    if not even_traces:
        return None
    edges_hz = find_band_edges([trace.record for trace in even_traces])
    travel = AxisTravel.of([trace.command for trace in even_traces], even_traces[0].axis_model)
    squares = np.zeros((len(OperatingRegime), len(edges_hz) - 1))
    rows_by_regime = np.zeros(len(OperatingRegime))
    total_rows = 0
    for trace in even_traces:
        band_squares = (
            split_into_bands(trace.record.time_s, trace.gap_before / trace.floor, edges_hz) ** 2
        )
        is_other_moving = find_other_motion(trace.record, trace.axis)
        regimes = find_regimes(trace.record.time_s, trace.command, is_other_moving, travel)
        for index, regime in enumerate(OperatingRegime):
            squares[index] += band_squares[:, regimes[regime]].sum(axis=1)
            rows_by_regime[index] += regimes[regime].sum()
        total_rows += len(trace.real)
    occurring_regimes = rows_by_regime > 0
    total = max(
        float(sum(np.sum((trace.gap_before / trace.floor) ** 2) for trace in even_traces)),
        total_rows * 1e-300,
    )
    return GapHeatmap(
        edges_hz,
        tuple(
            regime
            for regime, is_present in zip(OperatingRegime, occurring_regimes, strict=True)
            if is_present
        ),
        np.sqrt(squares[occurring_regimes] / rows_by_regime[occurring_regimes, None]),
        squares[occurring_regimes] / total,
    )
