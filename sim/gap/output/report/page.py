"""The report of a diagnosis, in the frame of all reports."""

from collections.abc import Sequence
from importlib.metadata import version
from os import PathLike

import numpy as np
from jinja2 import Environment

from rotemina.sim.gap.diagnosis import Diagnosis, Verdict
from rotemina.sim.gap.output.document import ordered_causes, shares
from rotemina.sim.gap.output.report.charts import forecast
from rotemina.sim.gap.output.report.facts import record_facts
from rotemina.sim.gap.output.report.frame import environment
from rotemina.sim.gap.output.report.quantities import unit_of
from rotemina.sim.gap.output.report.views import axis_views
from rotemina.sim.gap.output.report.words import (
    AXIS_VERDICTS,
    VERDICTS,
    effect_title,
    named,
    parameter_unit,
    said,
    shown,
    worded,
)
from rotemina.sim.gap.output.wording import summary
from rotemina.sim.messages import Wording, listed
from rotemina.sim.quantities import Number, rounded
from rotemina.sim.records.record import Record
from rotemina.sim.whole_files import replaced


def report_text(
    diagnosis: Diagnosis,
    records: Sequence[Record],
    names: Sequence[str] = (),
    wording: Wording | None = None,
) -> str:
    """Return the page.

    Parameters
    ----------
    diagnosis : Diagnosis
    records : sequence of Record
        Those that were diagnosed, in the same order.
    names : sequence of str
        What the records are called, where that is known.
    wording : Wording, optional
        The language of the page; English unless given.

    Raises
    ------
    PlantError, EffectError
        If a record does not fit the robot, or the corrected model cannot be simulated.
    """
    with worded(wording or Wording()):
        return _page(diagnosis, records, names)


def _page(diagnosis: Diagnosis, records: Sequence[Record], names: Sequence[str]) -> str:
    places = diagnosis.places
    return (
        _environment()
        .get_template("page.html")
        .render(
            diagnosis=diagnosis,
            verdict=said(VERDICTS[diagnosis.verdict]),
            summary=list(map(shown, summary(diagnosis, records))),
            places=list(zip(places, shares(places), strict=True)),
            causes=ordered_causes(diagnosis),
            axes=axis_views(diagnosis, records),
            forecasts=[
                forecast(one, unit_of(one.axis, one.tap, records)) if one.predictions else None
                for one in diagnosis.experiments
            ],
            records=record_facts(records, names),
            version=version("rotemina"),
            unit=lambda axis, tap: unit_of(axis, tap, records),
            parameter_unit=lambda one, cause: parameter_unit(one, cause, records),
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
    made = environment(said)
    made.filters.update(
        named=named,
        title=effect_title,
        one_of=lambda names: listed(list(names), said("or")),
        axis_verdict=lambda verdict: said(AXIS_VERDICTS[Verdict(verdict)]),
        hertz=lambda edges: " … ".join(shown(rounded(edge, 3)) for edge in edges) + " Hz",
        few=_few,
        warmth=_warmth,
    )
    return made


def _few(value: float) -> str:
    """Return a number above 0 in two digits."""
    return shown(Number("< 0.01") if 0.0 < value < 0.01 else rounded(value, 2))


def _warmth(floors: float) -> str:
    """Return how warm a cell of the heat map looks, 0 to 1: by decades above a third of a floor."""
    return f"{float(np.clip(np.log10(max(floors, 1e-9) / 0.3) / 3.0, 0.0, 1.0)):.2f}"
