"""Which effect causes the gap of an axis: the candidates, and what is said of the causes."""

from collections.abc import Iterator

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QPlainTextEdit, QSplitter

from rotemina.app.display_units import label
from rotemina.app.shell.engine_words import WindowWording
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.table import Table
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.verdict_advice import advice
from rotemina.plugins.gap.words import (
    AXIS_VERDICTS,
    any_of,
    effect_title,
    effect_word,
    formulation_name,
)
from rotemina.sim.gap.diagnosis import AxisDiagnosis, Cause, FittedParameter, Ranked
from rotemina.sim.gap.output.report.words import parameter_unit
from rotemina.sim.quantities import amount, amounts, percent, percents

HEAD = (mark("candidate"), mark("probability"), mark("remainder (noise floors)"), "95 %")
_TIPS = (
    mark("Alternatives to the leading cause, most likely first; possible causes are highlighted"),
    mark("Probability of being the cause, among the candidates and an unknown cause"),
    mark("Rms of the remaining gap on validation data, in noise floors; noise alone is 1"),
    mark("95 % interval of the remainder, in noise floors"),
)


class CausesView(QSplitter):
    """The ranking on the left, sentences on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self._shown: tuple[Answer, str] | None = None
        self.ranking = Table(
            tr("Candidates, most likely first"), [tr(text) for text in HEAD], choose=False
        )
        for column, text in enumerate(_TIPS):
            self.ranking.horizontalHeaderItem(column).setToolTip(plain_tip(tr(text)))
        self.text = QPlainTextEdit()
        self.text.setReadOnly(True)
        self.text.setAccessibleName(tr("Result for the axis"))
        self.text.setToolTip(tr("Result of the diagnosis for the axis"))
        self.addWidget(self.ranking)
        self.addWidget(self.text)
        self.setSizes([480, 460])

    def show_axis(self, answer: Answer, axis: str) -> None:
        """Show what was found on an axis; candidates that may be the cause stand out."""
        self._shown = answer, axis
        one = answer.diagnosis.axes[axis]
        named = {cause.effect for cause in one.causes}
        named |= {effect for cause in one.causes for effect in cause.ambiguous_with}
        quiet = QColor(self._theme.quiet)
        self.ranking.show_rows(
            [_row(ranked) for ranked in one.ranking],
            [None if ranked.effect in named else quiet for ranked in one.ranking],
        )
        self.text.setPlainText("\n".join(_lines(one, answer)))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        if self._shown is not None:
            self.show_axis(*self._shown)


def _row(ranked: Ranked) -> tuple[str, ...]:
    name = effect_title(ranked.effect)
    if ranked.from_axis is not None:
        name = tr("{effect} from {axis}").format(effect=name, axis=label(ranked.from_axis))
    if ranked.formulation is not None:
        name += f" ({formulation_name(ranked.formulation)})"
    return (
        name,
        percent(ranked.probability),
        amount(ranked.held_out_rms, ""),
        amounts(ranked.held_out_interval, ""),
    )


def _lines(one: AxisDiagnosis, answer: Answer) -> Iterator[str]:
    verdict = tr(AXIS_VERDICTS[one.verdict])
    yield f"{verdict}."
    experiments = [own for own in answer.diagnosis.experiments if own.axis == one.axis]
    yield from advice(one, has_experiment=bool(experiments))
    for cause in one.causes:
        yield from _cause(cause, answer)
    yield from map(WindowWording().of, one.remarks)
    for experiment in experiments:
        yield tr("Next experiment: {why}").format(why=WindowWording().of(experiment.why))


def _cause(cause: Cause, answer: Answer) -> Iterator[str]:
    unit = answer.unit(cause.axis, cause.tap)
    name = effect_title(cause.effect)
    if cause.from_axis is not None:
        name = tr("{effect} from {axis}").format(effect=name, axis=label(cause.from_axis))
    text = tr(
        "{effect}: {share} likely; {before} rms without it, {after} with it at {tap}, on unseen "
        "data; closes {closed} ({interval})."
    )
    yield text.format(
        effect=name,
        share=percent(cause.probability),
        before=amount(cause.gap_before, unit),
        after=amount(cause.gap_after, unit),
        tap=cause.tap,
        closed=percent(cause.closed),
        interval=percents(cause.closed_interval),
    )
    if cause.ambiguous_with:
        rivals = any_of([effect_word(effect) for effect in cause.ambiguous_with])
        text = tr("    These records cannot distinguish it from {effects}.")
        yield text.format(effects=rivals)
    for one in cause.parameters:
        yield f"    {_parameter(one, parameter_unit(one, cause, answer.records))}"


def _parameter(one: FittedParameter, unit: str) -> str:
    text = f"{one.name.replace('_', ' ')}: {amount(one.value, unit)}"
    if one.interval is not None:
        text += f" ({amounts(one.interval, unit)})"
    if one.at_bound is None:
        return text
    low = tr("{parameter}, at its low bound")
    high = tr("{parameter}, at its high bound")
    return (low if one.at_bound == "low" else high).format(parameter=text)
