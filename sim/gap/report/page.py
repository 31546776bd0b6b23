"""The report: one page that holds everything, and asks no network and no script for anything.

Every text that comes from a file or a third party is escaped where it is put in (by the template,
and by the drawings for their own texts); the page's policy forbids scripts and outside resources.
"""

from collections.abc import Sequence
from importlib import resources
from importlib.metadata import version
from os import PathLike

import numpy as np
from jinja2 import Environment, StrictUndefined
from markupsafe import Markup

from rotemina.sim.gap.diagnosis import Diagnosis, Verdict
from rotemina.sim.gap.document import ordered_causes, shares
from rotemina.sim.gap.report.charts import forecast
from rotemina.sim.gap.report.facts import record_facts
from rotemina.sim.gap.report.quantities import amount, amounts, percent, percents, unit_of
from rotemina.sim.gap.report.views import axis_views
from rotemina.sim.gap.report.words import (
    AXIS_VERDICTS,
    VERDICTS,
    effect_title,
    listed,
    parameter_unit,
    summary,
)
from rotemina.sim.records.record import Record
from rotemina.sim.whole_files import replaced


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
        axis_verdict=lambda verdict: AXIS_VERDICTS[Verdict(verdict)],
        hertz=lambda edges: " … ".join(f"{edge:.3g}" for edge in edges) + " Hz",
        few=_few,
        warmth=_warmth,
    )
    return environment


def _resource(name: str) -> str:
    return resources.files("rotemina.sim.gap.report").joinpath(name).read_text("utf-8")


def _few(value: float) -> str:
    """Return a number above 0 in two digits."""
    return "< 0.01" if 0.0 < value < 0.01 else f"{float(f'{value:.2g}'):g}"


def _warmth(floors: float) -> str:
    """Return how warm a cell of the heat map looks, 0 to 1: by decades above a third of a floor."""
    return f"{float(np.clip(np.log10(max(floors, 1e-9) / 0.3) / 3.0, 0.0, 1.0)):.2f}"
