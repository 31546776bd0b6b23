"""The drawings of each axis, and their resolution."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from rotemina.sim.errors import IdentificationError
from rotemina.sim.gap.output.charts import draw_ranking, draw_waterfall
from rotemina.sim.gap.output.gap_by_band_and_regime import GapHeatmap, make_heatmap
from rotemina.sim.gap.output.overlays import (
    POINTS_PER_BUCKET,
    draw_frequency_response,
    draw_signals,
)
from rotemina.sim.gap.output.report_words import localize_text
from rotemina.sim.gap.output.traces import GapTrace, compute_traces
from rotemina.sim.gap.result import (
    AxisDiagnosis,
    Diagnosis,
    GapShrinkage,
)
from rotemina.sim.messages import marked
from rotemina.sim.records import Record, Tap

# Of each axis, only this many records are drawn: those with the largest gap.
_MAX_DRAWN_RECORDS = 4
# Maximum number of points of all signals together, which keeps the page within a few megabytes.
_MAX_POINTS = 150_000
# Minimum and maximum number of buckets of a curve.
_BUCKET_LIMITS = (60, 500)


@dataclass(frozen=True, slots=True)
class TapDrawings:
    """Drawings of one axis at one tap. ``not_drawn`` says which drawings are missing, and why."""

    tap: Tap
    shrinkage: GapShrinkage | None
    waterfall: Markup | None
    heat: GapHeatmap | None
    signals: Markup | None = None
    response: Markup | None = None
    not_drawn: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class AxisDrawings:
    """The diagnosis of one axis, and its drawings."""

    diagnosis: AxisDiagnosis
    ranking: Markup | None
    taps: tuple[TapDrawings, ...]


def draw_axes(diagnosis: Diagnosis, records: Sequence[Record]) -> list[AxisDrawings]:
    """Return the drawings of every axis.

    Each tap with a reported shrinkage has drawings. Signals are drawn only for the tap with the
    largest gap in noise floors.

    Raises
    ------
    PlantError, EffectError
        If a record does not fit the robot, or the corrected model cannot be simulated.
    """
    traces_by_axis = {name: compute_traces(diagnosis, name, records) for name in diagnosis.axes}
    drawn_count = sum(
        min(len(axis_traces), _MAX_DRAWN_RECORDS) for axis_traces in traces_by_axis.values()
    )
    bucket_count = int(
        np.clip(_MAX_POINTS // max(POINTS_PER_BUCKET * drawn_count, 1), *_BUCKET_LIMITS)
    )
    return [
        AxisDrawings(
            axis_diagnosis,
            draw_ranking(axis_diagnosis.ranking),
            tuple(_draw_taps(axis_diagnosis, traces_by_axis[name], bucket_count)),
        )
        for name, axis_diagnosis in diagnosis.axes.items()
    ]


def _draw_taps(
    diagnosis: AxisDiagnosis, all_traces: Sequence[GapTrace], buckets: int
) -> list[TapDrawings]:
    traces_by_tap: dict[Tap, list[GapTrace]] = {}
    for trace in all_traces:
        traces_by_tap.setdefault(trace.tap, []).append(trace)
    if not traces_by_tap:
        return []
    main_tap = max(traces_by_tap, key=lambda tap: max(map(_find_gap_in_floors, traces_by_tap[tap])))
    shrinkages: Mapping[Tap, GapShrinkage] = {
        shrinkage.tap: shrinkage for shrinkage in diagnosis.shrinkage
    }
    return [
        _draw_tap_details(tap, shrinkages.get(tap), tap_traces, buckets)
        if tap is main_tap
        else _draw_tap_summary(tap, shrinkages[tap], tap_traces)
        for tap, tap_traces in traces_by_tap.items()
        if tap in shrinkages or tap is main_tap
    ]


def _draw_tap_summary(
    tap: Tap, shrinkage: GapShrinkage, traces_of_tap: Sequence[GapTrace]
) -> TapDrawings:
    return TapDrawings(
        tap,
        shrinkage,
        draw_waterfall(shrinkage, traces_of_tap[0].unit),
        make_heatmap(traces_of_tap),
    )


def _draw_tap_details(
    tap: Tap, shrinkage: GapShrinkage | None, traces_of_tap: Sequence[GapTrace], buckets: int
) -> TapDrawings:
    not_drawn: list[str] = []
    drawn_traces = sorted(traces_of_tap, key=_find_gap_in_floors, reverse=True)[:_MAX_DRAWN_RECORDS]
    if len(traces_of_tap) > len(drawn_traces):
        not_drawn.append(
            localize_text(
                marked("gap", "Of {all} records, the {drawn} with the largest gap are drawn."),
                all=len(traces_of_tap),
                drawn=len(drawn_traces),
            )
        )
    response = None
    try:
        response = draw_frequency_response(traces_of_tap)
    except IdentificationError as error:
        not_drawn.append(
            localize_text(
                marked("gap", "No frequency response is drawn: {reason}."), reason=str(error)
            )
        )
    heatmap = make_heatmap(traces_of_tap)
    if heatmap is None:
        not_drawn.append(
            localize_text(
                marked("gap", "No heat map is drawn: no record is sampled evenly and long enough.")
            )
        )
    return TapDrawings(
        tap,
        shrinkage,
        draw_waterfall(shrinkage, traces_of_tap[0].unit) if shrinkage is not None else None,
        heatmap,
        draw_signals(sorted(drawn_traces, key=lambda trace: trace.number), buckets),
        response,
        tuple(not_drawn),
    )


def _find_gap_in_floors(trace: GapTrace) -> float:
    """Return the rms gap of the original model in noise floors."""
    return float(np.sqrt(np.mean(trace.gap_before**2))) / trace.floor
