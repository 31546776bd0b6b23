"""Compares the health card of an axis with the latest stored card."""

from datetime import datetime

from rotemina.app.calibration import (
    FigureComparison,
    HealthBook,
    compare_cards,
    compute_health_figures,
    format_figure,
)
from rotemina.plugins.identification import mark
from rotemina.plugins.identification.findings import (
    NO_VALUE,
    AnalysisFindings,
    ExportColumn,
    FilledTemplate,
)
from rotemina.plugins.identification.record_query import AnalysisQuestion
from rotemina.sim.calibration import SensorFigureEstimate
from rotemina.sim.messages import format_uncertain

CARD_HEADINGS = (mark("figure"), mark("now"), "± 95 %", mark("last time"), "± 95 %", "")

# Names of the figures of a card, marked for translation.
FIGURE_NAMES = (
    mark("gain"),
    mark("resonance"),
    mark("damping"),
    mark("hysteresis width"),
    mark("settling"),
    mark("noise rms"),
    mark("repeatability"),
)


def compare_health_card(question: AnalysisQuestion) -> AnalysisFindings:
    """Compare the card of the record with the latest stored one.

    A card always describes the pair ``cmd`` and ``meas``, whichever pair is chosen. Without a
    folder of cards, there is nothing to compare with.
    """
    figures = compute_health_figures(question.record, question.axis)
    cards = ()
    if question.folder is not None:
        cards = HealthBook(question.folder, question.robot.name).read_cards(question.axis)
    last_card = cards[-1] if cards else None
    comparisons = compare_cards(figures, last_card.figures if last_card is not None else ())
    return AnalysisFindings(
        question,
        (),
        CARD_HEADINGS,
        tuple(map(_make_row, comparisons)),
        tuple(
            ExportColumn(f"{figure.name} [{figure.unit}]", (figure.value, figure.half_width))
            for figure in figures
        ),
        tuple(
            _make_notices(
                comparisons, last_card.date if last_card is not None else None, len(cards)
            )
        ),
    )


def store_card(question: AnalysisQuestion) -> None:
    """Store the card of the record together with the earlier cards of the axis.

    Raises
    ------
    InputError
        If no card can be computed from the record, or the card cannot be written.
    """
    if question.folder is None:
        return
    figures = compute_health_figures(question.record, question.axis)
    book = HealthBook(question.folder, question.robot.name)
    book.add(question.axis, figures, question.name, datetime.now().astimezone())


def _make_row(comparison: FigureComparison) -> tuple[str, ...]:
    last_texts = (
        _format_figure(comparison.before) if comparison.before is not None else (NO_VALUE, NO_VALUE)
    )
    changed_text = mark("changed") if comparison.changed else ""
    return (
        comparison.now.name,
        *_format_figure(comparison.now),
        *last_texts,
        changed_text,
    )


def _format_figure(figure: SensorFigureEstimate) -> tuple[str, str]:
    """Return the value and the half-width of its 95 % interval as texts."""
    if figure.unit == "Hz":
        value, half_width = format_uncertain(figure.value, figure.half_width)
        return f"{value} Hz", f"{half_width} Hz"
    size = max(abs(figure.value), figure.half_width)
    return (
        format_figure(figure.value, figure.unit, size=size),
        format_figure(figure.half_width, figure.unit, size=size, digits=2),
    )


def _make_notices(
    comparisons: tuple[FigureComparison, ...], date: str | None, card_count: int
) -> list[str]:
    if date is None:
        return [mark("There is no card of this axis yet. Store this one to compare with it later.")]
    changed_names = [comparison.now.name for comparison in comparisons if comparison.changed]
    text = mark("Last card: {date}, the latest of {n}. Changed beyond both intervals: {figures}.")
    if not changed_names:
        text = mark(
            "Last card: {date}, the latest of {n}. No figure has changed beyond both intervals."
        )
    return [FilledTemplate(text, date=date, n=card_count, figures=", ".join(changed_names))]
