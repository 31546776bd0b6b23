"""The report: one page that holds everything, and asks no network and no script for anything.

Every text that comes from a file or a third party is escaped where it is put in (by the template,
and by the drawings for their own texts); the page's policy forbids scripts and outside resources.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from importlib.metadata import version
from os import PathLike

import numpy as np
from jinja2 import Environment, StrictUndefined
from markupsafe import Markup

from rotemina.sim.gap.diagnosis import AxisDiagnosis, Diagnosis, Shrinkage, Verdict
from rotemina.sim.gap.document import ordered_causes, shares
from rotemina.sim.gap.report.charts import forecast, ranking, waterfall
from rotemina.sim.gap.report.facts import record_facts
from rotemina.sim.gap.report.heat import Heat, heat
from rotemina.sim.gap.report.overlays import POINTS, frequency_response, signals
from rotemina.sim.gap.report.quantities import amount, amounts, percent, percents, unit_of
from rotemina.sim.gap.report.traces import Trace, traces
from rotemina.sim.gap.report.words import VERDICTS, effect_title, listed, summary
from rotemina.sim.identification.errors import IdentificationError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.whole_files import replaced

_MOST_DRAWN = 4  # records of an axis at a tap; those with the largest gap
_MOST_POINTS = 150_000  # of all signals together: the page stays within a few megabytes
_BUCKETS = (60, 500)  # in which a curve is drawn, at least and at most
_MOST_RANKED = 14


@dataclass(frozen=True, slots=True)
class TapView:
    """What is drawn of one axis at one tap; ``not_drawn`` says why something is missing."""

    tap: Tap
    shrinkage: Shrinkage | None
    waterfall: Markup | None
    signals: Markup | None
    response: Markup | None
    heat: Heat | None
    not_drawn: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class AxisView:
    """One axis: what is said of it, and its drawings."""

    diagnosis: AxisDiagnosis
    ranking: Markup | None
    taps: tuple[TapView, ...]


def report_text(diagnosis: Diagnosis, records: Sequence[Record], names: Sequence[str] = ()) -> str:
    """Return the page.

    Parameters
    ----------
    diagnosis : Diagnosis
    records : sequence of Record
        Those that were diagnosed, in the same order.
    names : sequence of str
        What the records are called, where that is known.

    Raises
    ------
    PlantError, EffectError
        If a record does not fit the robot, or the corrected model cannot be simulated.
    """
    places = diagnosis.places
    return (
        _environment()
        .from_string(_resource("page.html"))
        .render(
            style=Markup(_resource("page.css")),  # noqa: S704 (the program's own)
            diagnosis=diagnosis,
            verdict=VERDICTS[diagnosis.verdict],
            summary=summary(diagnosis, records),
            places=list(zip(places, shares(places), strict=True)),
            causes=ordered_causes(diagnosis),
            axes=_views(diagnosis, records),
            forecasts=[
                forecast(one, unit_of(one.axis, Tap.MEAS, records)) if one.predictions else None
                for one in diagnosis.experiments
            ],
            records=record_facts(records, names),
            version=version("rotemina"),
            unit=lambda axis, tap: unit_of(axis, tap, records),
        )
    )


def write_report(
    diagnosis: Diagnosis,
    records: Sequence[Record],
    path: str | PathLike[str],
    names: Sequence[str] = (),
) -> None:
    """Write the page to a file, whole or not at all.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    PlantError, EffectError
        As :func:`report_text`.
    """
    page = report_text(diagnosis, records, names).encode("utf-8", "replace")
    with replaced(path) as file:
        file.write(page)


def _environment() -> Environment:
    environment = Environment(
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters.update(
        amount=amount,
        amounts=amounts,
        percent=percent,
        percents=percents,
        title=effect_title,
        listed=listed,
        verdict=lambda verdict: VERDICTS[Verdict(verdict)],
        hertz=lambda edges: " … ".join(f"{edge:.3g}" for edge in edges) + " Hz",
        few=lambda value: f"{float(f'{value:.2g}'):g}",
        warmth=_warmth,
    )
    return environment


def _resource(name: str) -> str:
    return resources.files("rotemina.sim.gap.report").joinpath(name).read_text("utf-8")


def _warmth(floors: float) -> str:
    """Return how warm a cell of the heat map looks, 0 to 1: by decades above a third of a floor."""
    return f"{float(np.clip(np.log10(max(floors, 1e-9) / 0.3) / 3.0, 0.0, 1.0)):.2f}"


def _views(diagnosis: Diagnosis, records: Sequence[Record]) -> list[AxisView]:
    seen = {axis: traces(diagnosis, axis, records) for axis in diagnosis.axes}
    drawn = sum(min(len(found), _MOST_DRAWN) for found in seen.values())
    buckets = int(np.clip(_MOST_POINTS // max(POINTS * drawn, 1), *_BUCKETS))
    return [
        AxisView(
            one,
            ranking(one.ranking[:_MOST_RANKED]) if one.ranking else None,
            tuple(_tap_views(one, seen[axis], buckets)),
        )
        for axis, one in diagnosis.axes.items()
    ]


def _tap_views(one: AxisDiagnosis, found: Sequence[Trace], buckets: int) -> list[TapView]:
    """Return the taps whose shrinkage is told; without any, the one with the largest gap."""
    by_tap: dict[Tap, list[Trace]] = {}
    for trace in found:
        by_tap.setdefault(trace.tap, []).append(trace)
    told: Mapping[Tap, Shrinkage | None] = {each.tap: each for each in one.shrinkage}
    if not told and by_tap:
        told = {max(by_tap, key=lambda tap: max(map(_floors, by_tap[tap]))): None}
    return [
        _tap_view(tap, shrinkage, by_tap.get(tap, []), buckets) for tap, shrinkage in told.items()
    ]


def _tap_view(
    tap: Tap, shrinkage: Shrinkage | None, found: Sequence[Trace], buckets: int
) -> TapView:
    missing: list[str] = []
    largest = sorted(found, key=_floors, reverse=True)[:_MOST_DRAWN]
    if len(found) > len(largest):
        missing.append(
            f"Of {len(found)} records, the {len(largest)} with the largest gap are drawn."
        )
    response = None
    try:
        response = frequency_response(found) if found else None
    except IdentificationError as error:
        missing.append(f"No frequency response is drawn: {error}.")
    warm = heat(found)
    if found and warm is None:
        missing.append("No heat map is drawn: no record is sampled evenly and long enough.")
    return TapView(
        tap,
        shrinkage,
        waterfall(shrinkage, found[0].unit) if shrinkage is not None and found else None,
        signals(sorted(largest, key=lambda trace: trace.number), buckets) if found else None,
        response,
        warm,
        tuple(missing),
    )


def _floors(trace: Trace) -> float:
    """Return the rms of a gap, in floors."""
    return float(np.sqrt(np.mean(trace.before**2))) / trace.floor
