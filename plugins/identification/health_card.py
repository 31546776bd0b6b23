"""The health card of the axis, beside the last stored card."""

from datetime import datetime

from rotemina.app.calibration.health import Compared, card_of, compared_cards
from rotemina.app.calibration.health_book import HealthBook
from rotemina.app.calibration.words import figure_text
from rotemina.plugins.identification import mark
from rotemina.plugins.identification.filled_template import FilledTemplate
from rotemina.plugins.identification.findings import NONE, Column, Findings
from rotemina.plugins.identification.record_query import Question
from rotemina.sim.calibration.sensor_calibration import Figure
from rotemina.sim.quantities import uncertain

HEAD = (mark("figure"), mark("now"), "± 95 %", mark("last time"), "± 95 %", "")

# Figures of a card as it names them.
FIGURES = (
    mark("gain"),
    mark("resonance"),
    mark("damping"),
    mark("hysteresis width"),
    mark("settling"),
    mark("noise rms"),
    mark("repeatability"),
)


def health_findings(question: Question) -> Findings:
    """Compare the record's card with the last one; of ``cmd`` to ``meas``, whatever pair is shown.

    Without a folder of cards there is no last time.
    """
    figures = card_of(question.record, question.axis)
    cards = ()
    if question.folder is not None:
        cards = HealthBook(question.folder, question.robot.name).cards(question.axis)
    last = cards[-1] if cards else None
    rows = compared_cards(figures, last.figures if last is not None else ())
    return Findings(
        question,
        (),
        HEAD,
        tuple(map(_row, rows)),
        tuple(
            Column(f"{each.name} [{each.unit}]", (each.value, each.half_width)) for each in figures
        ),
        tuple(_notices(rows, last.date if last is not None else None, len(cards))),
    )


def keep_card(question: Question) -> None:
    """Write the record's card behind the earlier ones.

    Raises
    ------
    InputError
        If the record has none, or it cannot be written.
    """
    if question.folder is None:
        return
    figures = card_of(question.record, question.axis)
    book = HealthBook(question.folder, question.robot.name)
    book.add(question.axis, figures, question.name, datetime.now().astimezone())


def _row(row: Compared) -> tuple[str, ...]:
    before = _words(row.before) if row.before is not None else (NONE, NONE)
    return (row.now.name, *_words(row.now), *before, mark("changed") if row.changed else "")


def _words(figure: Figure) -> tuple[str, str]:
    if figure.unit == "Hz":
        value, half_width = uncertain(figure.value, figure.half_width)
        return f"{value} Hz", f"{half_width} Hz"
    size = max(abs(figure.value), figure.half_width)
    return (
        figure_text(figure.value, figure.unit, size=size),
        figure_text(figure.half_width, figure.unit, size=size, digits=2),
    )


def _notices(rows: tuple[Compared, ...], date: str | None, kept: int) -> list[str]:
    if date is None:
        return [mark("There is no card of this axis yet. Store this one to compare with it later.")]
    changed = [row.now.name for row in rows if row.changed]
    text = mark("Last card: {date}, the latest of {n}. Changed beyond both intervals: {figures}.")
    if not changed:
        text = mark(
            "Last card: {date}, the latest of {n}. No figure has changed beyond both intervals."
        )
    return [FilledTemplate(text, date=date, n=kept, figures=", ".join(changed))]
