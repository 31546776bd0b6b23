"""View of the effects that may cause the gap of an axis: a table, and an explanation."""

from collections.abc import Iterator

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QPlainTextEdit, QSplitter

from rotemina.app.language import WindowWording, get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import TextTable
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.verdict_advice import explain_verdict
from rotemina.plugins.gap.answer.words import (
    AXIS_VERDICTS,
    effect_title,
    effect_word,
    formulation_name,
    join_with_or,
)
from rotemina.sim.gap.output import find_parameter_unit
from rotemina.sim.gap.result import (
    AxisDiagnosis,
    FittedParameter,
    GapCause,
    RankedCandidate,
)
from rotemina.sim.units import (
    format_interval,
    format_percent,
    format_percent_interval,
    format_quantity,
)

_COLUMN_TITLES = (mark("candidate"), mark("probability"), mark("remainder (noise floors)"), "95 %")
_COLUMN_TOOLTIPS = (
    mark("Alternatives to the leading cause, most likely first; possible causes are highlighted"),
    mark("Probability of being the cause, among the candidates and an unknown cause"),
    mark("Rms of the remaining gap on validation data, in noise floors; noise alone is 1"),
    mark("95 % interval of the remainder, in noise floors"),
)


class CausesView(QSplitter):
    """View with the ranked candidates on the left, and the explanation on the right."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._theme = theme
        self._shown: tuple[DiagnosisAnswer, str] | None = None
        self.ranking = TextTable(
            tr("Candidates, most likely first"),
            [tr(text) for text in _COLUMN_TITLES],
            selectable=False,
        )
        for column, text in enumerate(_COLUMN_TOOLTIPS):
            self.ranking.horizontalHeaderItem(column).setToolTip(make_tooltip(tr(text)))
        self.text = QPlainTextEdit()
        self.text.setReadOnly(True)
        self.text.setAccessibleName(tr("Result for the axis"))
        self.text.setToolTip(tr("Result of the diagnosis for the axis"))
        self.addWidget(self.ranking)
        self.addWidget(self.text)
        self.setSizes([480, 460])

    def show_axis(self, answer: DiagnosisAnswer, axis: str) -> None:
        """Show the result for an axis, with the possible causes highlighted."""
        self._shown = answer, axis
        diagnosis = answer.diagnosis.axes[axis]
        possible_causes = {cause.effect for cause in diagnosis.causes}
        possible_causes |= {effect for cause in diagnosis.causes for effect in cause.ambiguous_with}
        quiet = QColor(self._theme.quiet)
        self.ranking.show_rows(
            [_make_row(ranked) for ranked in diagnosis.ranking],
            [None if ranked.effect in possible_causes else quiet for ranked in diagnosis.ranking],
        )
        self.text.setPlainText("\n".join(_describe_axis(diagnosis, answer)))

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        self._theme = theme
        if self._shown is not None:
            self.show_axis(*self._shown)


def _make_row(ranked: RankedCandidate) -> tuple[str, ...]:
    name = effect_title(ranked.effect)
    if ranked.from_axis is not None:
        name = tr("{effect} from {axis}").format(effect=name, axis=get_axis_label(ranked.from_axis))
    if ranked.formulation is not None:
        name += f" ({formulation_name(ranked.formulation)})"
    return (
        name,
        format_percent(ranked.probability),
        format_quantity(ranked.held_out_rms, ""),
        format_interval(ranked.held_out_interval, ""),
    )


def _describe_axis(diagnosis: AxisDiagnosis, answer: DiagnosisAnswer) -> Iterator[str]:
    verdict = tr(AXIS_VERDICTS[diagnosis.verdict])
    yield f"{verdict}."
    experiments = [
        experiment
        for experiment in answer.diagnosis.experiments
        if experiment.axis == diagnosis.axis
    ]
    yield from explain_verdict(diagnosis, has_experiment=bool(experiments))
    for cause in diagnosis.causes:
        yield from _describe_cause(cause, answer)
    yield from map(WindowWording().format_message, diagnosis.remarks)
    for experiment in experiments:
        yield tr("Next experiment: {why}").format(
            why=WindowWording().format_message(experiment.why)
        )


def _describe_cause(cause: GapCause, answer: DiagnosisAnswer) -> Iterator[str]:
    unit = answer.unit(cause.axis, cause.tap)
    name = effect_title(cause.effect)
    if cause.from_axis is not None:
        name = tr("{effect} from {axis}").format(effect=name, axis=get_axis_label(cause.from_axis))
    text = tr(
        "{effect}: {share} likely; {before} rms without it, {after} with it at {tap}, on unseen "
        "data; closes {closed} ({interval})."
    )
    yield text.format(
        effect=name,
        share=format_percent(cause.probability),
        before=format_quantity(cause.gap_before, unit),
        after=format_quantity(cause.gap_after, unit),
        tap=cause.tap,
        closed=format_percent(cause.closed),
        interval=format_percent_interval(cause.closed_interval),
    )
    if cause.ambiguous_with:
        rivals = join_with_or([effect_word(effect) for effect in cause.ambiguous_with])
        text = tr("    These records cannot distinguish it from {effects}.")
        yield text.format(effects=rivals)
    for parameter in cause.parameters:
        unit = find_parameter_unit(parameter, cause, answer.records)
        yield f"    {_describe_parameter(parameter, unit)}"


def _describe_parameter(parameter: FittedParameter, unit: str) -> str:
    text = f"{parameter.name.replace('_', ' ')}: {format_quantity(parameter.value, unit)}"
    if parameter.interval is not None:
        text += f" ({format_interval(parameter.interval, unit)})"
    if parameter.at_bound is None:
        return text
    low_text = tr("{parameter}, at its low bound")
    high_text = tr("{parameter}, at its high bound")
    return (low_text if parameter.at_bound == "low" else high_text).format(parameter=text)
