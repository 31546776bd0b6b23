"""Findings of one analysis: pictures, figures, numbers for a file, and notices."""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Self

from rotemina.app.language import translate_message
from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.record_query import AnalysisQuestion
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import Message
from rotemina.sim.units import DisplayScale, choose_scale

logger = logging.getLogger(__name__)
NO_VALUE = "–"


class FilledTemplate(str):
    """English text of a filled template, which :func:`translate_text` can translate."""

    __slots__ = ("template", "values")
    template: str
    values: dict[str, object]

    def __new__(cls, template: str, **values: object) -> Self:
        """Fill the named fields of a template that is marked for translation."""
        text = super().__new__(cls, template.format(**values))
        text.template, text.values = template, values
        return text


def translate_text(text: str) -> str:
    """Return a text in the UI language.

    The text may be a filled template, a message of the engine, or a marked text. Any other text is
    returned unchanged.
    """
    if isinstance(text, FilledTemplate):
        translated_values = {
            name: translate_text(value) if isinstance(value, str) else value
            for name, value in text.values.items()
        }
        return tr(text.template).format(**translated_values)
    if isinstance(text, Message):
        return translate_message(text)
    return tr(text) if text else text


class AnalysisCurve(NamedTuple):
    """Curve of a picture: name, colour role in the theme, points (n,), and width in pixels."""

    name: str
    role: str
    x: FloatArray
    y: FloatArray
    width: int = 1


class AnalysisPicture(NamedTuple):
    """Picture of curves with common axes. The titles are quantities with units.

    ``in_time`` says that x increases monotonically, so that the curves can be thinned for drawing.
    ``y_range`` is the range of the vertical axis. If it is None, the range fits the curves.
    """

    title: str
    bottom: str
    curves: tuple[AnalysisCurve, ...]
    log_x: bool = False
    log_y: bool = False
    in_time: bool = True
    y_range: tuple[float, float] | None = None


class ExportColumn(NamedTuple):
    """Column of the exported file: a heading with its unit, and a number or None for each row."""

    heading: str
    values: tuple[float | None, ...]


@dataclass(frozen=True, slots=True, eq=False)
class AnalysisFindings:
    """Result of an analysis. Its texts are in English, and are translated on the screen.

    Attributes
    ----------
    question : the question that these findings answer. It identifies outdated findings.
    pictures : at most three pictures.
    head, rows : headings and rows of the table of figures, as texts with units.
    columns : numbers for the exported file.
    notices : sentences on the limits of the record.
    """

    question: AnalysisQuestion
    pictures: tuple[AnalysisPicture, ...] = ()
    head: tuple[str, ...] = ()
    rows: tuple[tuple[str, ...], ...] = ()
    columns: tuple[ExportColumn, ...] = ()
    notices: tuple[str, ...] = ()


def make_ratio_scale(question: AnalysisQuestion, largest: float) -> DisplayScale:
    """Return the unit of output divided by input, which is empty if both have the same unit.

    ``largest`` is the largest ratio, SI, which the unit should suit.
    """
    output_unit, input_unit = question.unit(question.output_tap), question.unit(question.input_tap)
    if output_unit == input_unit:
        return DisplayScale("", 1.0)
    if input_unit == "V":
        output_scale = choose_scale(output_unit, largest)
        return DisplayScale(f"{output_scale.symbol}/V", output_scale.per_si)
    # The input is always shown in µm or µrad, because V/m means little for these axes.
    input_scale = choose_scale(input_unit, 1e-6)
    return DisplayScale(f"V/{input_scale.symbol}", 1.0 / input_scale.per_si)


def answer_question(
    analyse: Callable[[AnalysisQuestion], AnalysisFindings], question: AnalysisQuestion
) -> AnalysisFindings:
    """Analyse a record. An error becomes a notice in the findings."""
    try:
        return analyse(question)
    except InputError as error:
        return AnalysisFindings(question, notices=(str(error),))
    # Every error is caught, so that the operator also sees programming errors.
    except Exception as error:
        logger.exception("identification failed")
        reason = FilledTemplate(
            mark("program error: {kind}: {error}"), kind=type(error).__name__, error=error
        )
        return AnalysisFindings(question, notices=(reason,))
