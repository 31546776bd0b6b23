"""The head of the gap page: the answer in a sentence, its remainder, and what to do about it."""

from collections.abc import Sequence

from PySide6.QtWidgets import QFrame, QHBoxLayout, QVBoxLayout, QWidget

from rotemina.app.display import label
from rotemina.app.shell.controls import ElidedLabel
from rotemina.app.shell.language import translate
from rotemina.plugins.gap.answer import Answer
from rotemina.plugins.gap.headline import TONES, Tone, change, headline, why_worse
from rotemina.plugins.gap.proof import Proof
from rotemina.plugins.gap.tips import tip
from rotemina.plugins.gap.words import VERDICTS, summary


class Headline(QFrame):
    """The sentence first, the remainder below it; red where a motion shows the model to be worse.

    ``buttons`` stand on the right, for what is done about it.
    """

    def __init__(self, buttons: Sequence[QWidget]) -> None:
        super().__init__()
        self.setObjectName("headline")
        self.sentence, self.remainder = ElidedLabel(), ElidedLabel()
        self.sentence.setProperty("sentence", True)
        self.remainder.setProperty("remainder", True)
        words = QVBoxLayout()
        words.setSpacing(0)
        words.addWidget(self.sentence)
        words.addWidget(self.remainder)
        row = QHBoxLayout(self)
        row.setContentsMargins(10, 2, 4, 2)
        row.addLayout(words, 1)
        for button in buttons:
            row.addWidget(button)

    def show_answer(self, answer: Answer, proof: Proof | None) -> None:
        """Show a diagnosis, and what a motion that it has not seen says of it."""
        said = summary(answer.diagnosis, answer.records)
        verdict = translate("gap", VERDICTS[answer.diagnosis.verdict])
        worse = [one for one in proof.shrunk if one.worse] if proof is not None else []
        tone = Tone.WORSE if worse else TONES[answer.diagnosis.verdict]
        text, more = headline(answer), "  ".join(said) or f"{verdict}."
        if proof is not None and worse:
            listed = ", ".join(f"{label(one.trace.axis)} {change(one.times)}" for one in worse)
            worse_on = translate("gap", "Worse on {motion}: {axes}.   ")
            text = worse_on.format(motion=proof.name, axes=listed) + text
            more = why_worse(worse[0], answer)
        elif proof is not None and proof.shrunk:
            better = ", ".join(
                f"{label(one.trace.axis)} {change(one.times)}" for one in proof.shrunk
            )
            more = f"{proof.name}: {better}.  {more}"
        self.sentence.show_text(text)
        self.remainder.show_text(more)
        for label_ in (self.sentence, self.remainder):
            label_.setToolTip(tip(text, more, f"{verdict}.", *said))
        self.setProperty("tone", str(tone))
        self.style().unpolish(self)
        self.style().polish(self)
