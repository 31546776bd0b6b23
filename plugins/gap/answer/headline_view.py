"""Headline of the page on the model gap: the answer in one sentence, its details, and buttons."""

from collections.abc import Sequence

from PySide6.QtWidgets import QFrame, QWidget

from rotemina.app.language import WindowWording, get_axis_label
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer.answer_quality import (
    VERDICT_TONES,
    AnswerTone,
    describe_change,
    explain_gap_increase,
)
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.unseen_motion_reduction import UnseenMotionResult
from rotemina.plugins.gap.answer.words import ROBOT_VERDICTS
from rotemina.sim.gap.output import write_details, write_findings

# Minimum heights of the headline on a large and on a small page.
LARGE_HEIGHT_PX, SMALL_HEIGHT_PX = 120, 76


class HeadlineView(QFrame):
    """Frame with the answer in one sentence and its details below it.

    The frame is red if a motion has shown that the corrected model is worse. The upper buttons are
    on the right, and the lower buttons are below them.
    """

    def __init__(self, upper_buttons: Sequence[QWidget], lower_buttons: Sequence[QWidget]) -> None:
        super().__init__()
        self.setObjectName("headline")
        self.sentence, self.details = (make_plain_label(quiet=False, wrap=True) for _ in range(2))
        self.sentence.setProperty("sentence", True)
        self.details.setProperty("details", True)
        texts = make_column(self.sentence, self.details, 1, spacing=0)
        buttons = make_column(make_row(1, *upper_buttons), make_row(1, *lower_buttons))
        make_row((texts, 1), buttons, on=self, margins=(12, 6, 8, 6), spacing=12)

    def show_answer(
        self, answer: DiagnosisAnswer, unseen_motion: UnseenMotionResult | None
    ) -> None:
        """Show a diagnosis, and the result of a motion that was not used for it, if any."""
        diagnosis, wording = answer.diagnosis, WindowWording()
        verdict = f"{tr(ROBOT_VERDICTS[diagnosis.verdict])}."
        sentences = [wording.format_message(message) for message in write_findings(diagnosis)]
        text = "   ".join(sentences) or verdict
        details_text = "  ".join(
            wording.format_message(message) for message in write_details(diagnosis, answer.records)
        )
        gap_increases = (
            [reduction for reduction in unseen_motion.reductions if reduction.is_worse]
            if unseen_motion is not None
            else []
        )
        tone = AnswerTone.WORSE if gap_increases else VERDICT_TONES[diagnosis.verdict]
        if unseen_motion is not None and gap_increases:
            axis_changes = ", ".join(
                f"{get_axis_label(reduction.trace.axis)} {describe_change(reduction.factor)}"
                for reduction in gap_increases
            )
            text = (
                tr("Worse on {motion}: {axes}.   ").format(
                    motion=unseen_motion.name, axes=axis_changes
                )
                + text
            )
            details_text = explain_gap_increase(gap_increases[0], answer)
        elif unseen_motion is not None and unseen_motion.reductions:
            axis_changes = ", ".join(
                f"{get_axis_label(reduction.trace.axis)} {describe_change(reduction.factor)}"
                for reduction in unseen_motion.reductions
            )
            details_text = f"{unseen_motion.name}: {axis_changes}.  {details_text}"
        self.sentence.setText(text)
        self.details.setText(details_text)
        for text_label in (self.sentence, self.details):
            text_label.setToolTip(make_tooltip(*sentences, details_text, verdict))
        self.setProperty("tone", str(tone))
        # Apply the style sheet again: the colour of the sentence depends on the tone of the frame.
        for widget in (self, self.sentence):
            widget.style().unpolish(widget)
            widget.style().polish(widget)
