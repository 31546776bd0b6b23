"""The report of a diagnosis, built on the frame that all reports share."""

from collections.abc import Sequence
from importlib.metadata import version
from os import PathLike

import numpy as np
from jinja2 import Environment

from rotemina.sim.files import replace_file
from rotemina.sim.gap.output.charts import draw_forecast
from rotemina.sim.gap.output.document import compute_shares, sort_causes
from rotemina.sim.gap.output.html_frame import make_environment
from rotemina.sim.gap.output.report_facts import collect_record_facts
from rotemina.sim.gap.output.report_views import draw_axes
from rotemina.sim.gap.output.report_words import (
    AXIS_VERDICTS,
    ROBOT_VERDICTS,
    find_parameter_unit,
    localize,
    localize_effect_title,
    localize_name,
    localize_text,
    unit_of,
    use_wording,
)
from rotemina.sim.gap.output.wording import write_summary
from rotemina.sim.gap.result import Diagnosis, GapVerdict
from rotemina.sim.messages import MessageWording, NumberText, format_rounded, join_names
from rotemina.sim.records import Record


def make_report_text(
    diagnosis: Diagnosis,
    records: Sequence[Record],
    names: Sequence[str] = (),
    wording: MessageWording | None = None,
) -> str:
    """Return the report as the text of a web page.

    Parameters
    ----------
    diagnosis : Diagnosis
    records : sequence of Record
        The diagnosed records, in the same order.
    names : sequence of str
        Names of the records; records without a name come last.
    wording : MessageWording, optional
        The language of the page; English by default.

    Raises
    ------
    PlantError, EffectError
        If a record does not fit the robot, or the corrected model cannot be simulated.
    """
    with use_wording(wording or MessageWording()):
        return _render_page(diagnosis, records, names)


def _render_page(diagnosis: Diagnosis, records: Sequence[Record], names: Sequence[str]) -> str:
    places = diagnosis.places
    return (
        _make_page_environment()
        .get_template("page.html")
        .render(
            diagnosis=diagnosis,
            verdict=localize_text(ROBOT_VERDICTS[diagnosis.verdict]),
            summary=list(map(localize, write_summary(diagnosis, records))),
            places=list(zip(places, compute_shares(places), strict=True)),
            causes=sort_causes(diagnosis),
            axes=draw_axes(diagnosis, records),
            forecasts=[
                draw_forecast(experiment, unit_of(experiment.axis, experiment.tap, records))
                if experiment.predictions
                else None
                for experiment in diagnosis.experiments
            ],
            records=collect_record_facts(records, names),
            version=version("rotemina"),
            unit=lambda axis, tap: unit_of(axis, tap, records),
            parameter_unit=lambda parameter, cause: find_parameter_unit(parameter, cause, records),
        )
    )


def write_report(
    diagnosis: Diagnosis,
    records: Sequence[Record],
    path: str | PathLike[str],
    names: Sequence[str] = (),
) -> None:
    """Write the report to a file atomically.

    Raises
    ------
    FileWriteError
        If the file cannot be written.
    PlantError, EffectError
        As in :func:`make_report_text`.
    """
    page = make_report_text(diagnosis, records, names).encode("utf-8", "replace")
    with replace_file(path) as file:
        file.write(page)


def _make_page_environment() -> Environment:
    environment = make_environment(localize_text)
    environment.filters.update(
        named=localize_name,
        title=localize_effect_title,
        one_of=lambda names: join_names(list(names), localize_text("or")),
        axis_verdict=lambda verdict: localize_text(AXIS_VERDICTS[GapVerdict(verdict)]),
        hertz=lambda edges: " … ".join(localize(format_rounded(edge, 3)) for edge in edges) + " Hz",
        few=_format_two_digits,
        warmth=_format_warmth,
    )
    return environment


def _format_two_digits(value: float) -> str:
    """Return a number with two significant digits, or "< 0.01"."""
    return localize(NumberText("< 0.01") if 0.0 < value < 0.01 else format_rounded(value, 2))


def _format_warmth(floors: float) -> str:
    """Return the colour intensity of a cell of the heat map, from 0 to 1, as text.

    The intensity grows with the logarithm of the gap, from 0 at 0.3 floors to 1 at 300 floors.
    """
    return f"{float(np.clip(np.log10(max(floors, 1e-9) / 0.3) / 3.0, 0.0, 1.0)):.2f}"
