"""What is drawn of each axis, and how finely."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from rotemina.sim.gap.diagnosis import AxisDiagnosis, Diagnosis, Shrinkage
from rotemina.sim.gap.output.report.charts import ranking, waterfall
from rotemina.sim.gap.output.report.heat import Heat, heat
from rotemina.sim.gap.output.report.overlays import POINTS, frequency_response, signals
from rotemina.sim.gap.output.report.traces import Trace, traces
from rotemina.sim.gap.output.report.words import said
from rotemina.sim.identification.errors import IdentificationError
from rotemina.sim.messages import marked
from rotemina.sim.records.record import Record, Tap

_MOST_DRAWN = 4  # records of an axis; those with the largest gap
_MOST_POINTS = 150_000  # of all signals together: the page stays within a few megabytes
_BUCKETS = (60, 500)  # in which a curve is drawn, at least and at most


@dataclass(frozen=True, slots=True)
class TapView:
    """Drawings of one axis at one tap; ``not_drawn`` gives the reason for a missing one."""

    tap: Tap
    shrinkage: Shrinkage | None
    waterfall: Markup | None
    heat: Heat | None
    signals: Markup | None = None
    response: Markup | None = None
    not_drawn: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class AxisView:
    """One axis: its result, and its drawings."""

    diagnosis: AxisDiagnosis
    ranking: Markup | None
    taps: tuple[TapView, ...]


def axis_views(diagnosis: Diagnosis, records: Sequence[Record]) -> list[AxisView]:
    """Return the drawings of every axis.

    Each axis has its taps with a reported shrinkage, and signals at the tap with the largest gap,
    in floors.

    Raises
    ------
    PlantError, EffectError
        If a record does not fit the robot, or the corrected model cannot be simulated.
    """
    seen = {axis: traces(diagnosis, axis, records) for axis in diagnosis.axes}
    drawn = sum(min(len(found), _MOST_DRAWN) for found in seen.values())
    buckets = int(np.clip(_MOST_POINTS // max(POINTS * drawn, 1), *_BUCKETS))
    return [
        AxisView(one, ranking(one.ranking), tuple(_tap_views(one, seen[axis], buckets)))
        for axis, one in diagnosis.axes.items()
    ]


def _tap_views(one: AxisDiagnosis, found: Sequence[Trace], buckets: int) -> list[TapView]:
    by_tap: dict[Tap, list[Trace]] = {}
    for trace in found:
        by_tap.setdefault(trace.tap, []).append(trace)
    if not by_tap:
        return []
    chief = max(by_tap, key=lambda tap: max(map(_floors, by_tap[tap])))
    told: Mapping[Tap, Shrinkage] = {each.tap: each for each in one.shrinkage}
    return [
        _with_signals(tap, told.get(tap), own, buckets)
        if tap is chief
        else _without_signals(tap, told[tap], own)
        for tap, own in by_tap.items()
        if tap in told or tap is chief
    ]


def _without_signals(tap: Tap, shrinkage: Shrinkage, found: Sequence[Trace]) -> TapView:
    return TapView(tap, shrinkage, waterfall(shrinkage, found[0].unit), heat(found))


def _with_signals(
    tap: Tap, shrinkage: Shrinkage | None, found: Sequence[Trace], buckets: int
) -> TapView:
    missing: list[str] = []
    largest = sorted(found, key=_floors, reverse=True)[:_MOST_DRAWN]
    if len(found) > len(largest):
        missing.append(
            said(
                marked("gap", "Of {all} records, the {drawn} with the largest gap are drawn."),
                all=len(found),
                drawn=len(largest),
            )
        )
    response = None
    try:
        response = frequency_response(found)
    except IdentificationError as error:
        missing.append(
            said(marked("gap", "No frequency response is drawn: {reason}."), reason=str(error))
        )
    warm = heat(found)
    if warm is None:
        missing.append(
            said(
                marked("gap", "No heat map is drawn: no record is sampled evenly and long enough.")
            )
        )
    return TapView(
        tap,
        shrinkage,
        waterfall(shrinkage, found[0].unit) if shrinkage is not None else None,
        warm,
        signals(sorted(largest, key=lambda trace: trace.number), buckets),
        response,
        tuple(missing),
    )


def _floors(trace: Trace) -> float:
    """Return the rms of a gap, in floors."""
    return float(np.sqrt(np.mean(trace.before**2))) / trace.floor
