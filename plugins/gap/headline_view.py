"""The head of the gap page: the answer in a sentence, its remainder, and what to do about it."""

from collections.abc import Sequence

from PySide6.QtWidgets import QFrame, QWidget

from rotemina.app.display_units import label
from rotemina.app.shell.engine_words import WindowWording
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer_quality import TONES, Tone, change, why_worse
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.unseen_motion_reduction import Proof
from rotemina.plugins.gap.words import VERDICTS
from rotemina.sim.gap.output.wording import details, findings

HEIGHT, LITTLE = 120, 76  # px, at least, on a large page and on a small one


class Headline(QFrame):
    """The sentence first, the remainder below it; red where a motion shows the model to be worse.

    On the right stands what is done about it: ``first``, and ``more`` below.
    """

    def __init__(self, first: Sequence[QWidget], more: Sequence[QWidget]) -> None:
        super().__init__()
        self.setObjectName("headline")
        self.sentence, self.remainder = (plain_text(quiet=False, wrap=True) for _ in range(2))
        self.sentence.setProperty("sentence", True)
        self.remainder.setProperty("remainder", True)
        words = in_column(self.sentence, self.remainder, 1, spacing=0)
        buttons = in_column(in_row(1, *first), in_row(1, *more))
        in_row((words, 1), buttons, on=self, margins=(12, 6, 8, 6), spacing=12)

    def show_answer(self, answer: Answer, proof: Proof | None) -> None:
        """Show a diagnosis, and what a motion that it has not seen says of it."""
        diagnosis, wording = answer.diagnosis, WindowWording()
        verdict = f"{tr(VERDICTS[diagnosis.verdict])}."
        found = [wording.of(message) for message in findings(diagnosis)]
        text = "   ".join(found) or verdict
        more = "  ".join(wording.of(message) for message in details(diagnosis, answer.records))
        worse = [one for one in proof.shrunk if one.worse] if proof is not None else []
        tone = Tone.WORSE if worse else TONES[diagnosis.verdict]
        if proof is not None and worse:
            listed = ", ".join(f"{label(one.trace.axis)} {change(one.times)}" for one in worse)
            text = tr("Worse on {motion}: {axes}.   ").format(motion=proof.name, axes=listed) + text
            more = why_worse(worse[0], answer)
        elif proof is not None and proof.shrunk:
            better = ", ".join(
                f"{label(one.trace.axis)} {change(one.times)}" for one in proof.shrunk
            )
            more = f"{proof.name}: {better}.  {more}"
        self.sentence.setText(text)
        self.remainder.setText(more)
        for label_ in (self.sentence, self.remainder):
            label_.setToolTip(plain_tip(*found, more, verdict))
        self.setProperty("tone", str(tone))
        for widget in (self, self.sentence):  # whose colour is that of the frame's tone
            widget.style().unpolish(widget)
            widget.style().polish(widget)
