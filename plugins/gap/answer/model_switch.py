"""Switch to a corrected model, and the objections to it."""

from collections.abc import Iterator, Sequence

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.motion.model import (
    CONTACT_LIKE_EFFECTS,
    NOTED_KEY,
    ModelInUse,
)
from rotemina.app.workbench import WaitingRequest, Workbench
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.unseen_motion_reduction import UnseenMotionResult
from rotemina.plugins.gap.answer.words import effect_word, join_with_and
from rotemina.sim.errors import InputError
from rotemina.sim.records import Tap

NOT_USED = mark("The model stays: {why}. Press Use corrected model again.")


class ModelSwitch(QObject):
    """Switches to the corrected model of an answer. If there are objections, it asks first."""

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._parent = parent

    def ask(self, answer: DiagnosisAnswer, objection: str | None) -> None:
        """Use the corrected model, but ask first if there is an objection or a note on a record."""
        warnings = [text for text in (objection, *find_notes(answer)) if text]
        if warnings:
            self._ask(answer, warnings)
        else:
            self.use(answer)

    def use(self, answer: DiagnosisAnswer) -> None:
        """Make predictions with the corrected model from now on."""
        session, diagnosis = self._workbench.session, answer.diagnosis
        self._workbench.use_model(
            lambda: ModelInUse.make_corrected(diagnosis, session.driver, session.model)
        )

    def _ask(self, answer: DiagnosisAnswer, warnings: Sequence[str]) -> None:
        question = QMessageBox(self._parent.window())
        question.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        question.setWindowTitle(tr("Use corrected model"))
        question.setTextFormat(Qt.TextFormat.PlainText)
        question.setText(tr("Use this model for predictions anyway?"))
        safety_note = tr(
            "Predictions only: commands to the machine do not change, and no bound widens."
        )
        question.setInformativeText("\n\n".join([*warnings, safety_note]))
        yes, no = QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No
        question.setStandardButtons(yes | no)
        question.setDefaultButton(no)
        question.button(yes).setText(tr("Use anyway"))
        question.button(no).setText(tr("Not now"))
        request = WaitingRequest(self._workbench, tr(NOT_USED))

        def on_answer(reply: int) -> None:
            # A stop cancels the request and reports the cancellation.
            if request.is_waiting and reply == yes:
                self.use(answer)
            request.end_silently()

        question.finished.connect(on_answer)
        self._workbench.stopped.connect(question.reject)
        question.setModal(False)
        question.show()


def find_candidate_model(answer: DiagnosisAnswer) -> ModelInUse | None:
    """Return the corrected model of an answer, or None if the answer has no usable one."""
    try:
        return ModelInUse.from_diagnosis(answer.diagnosis)
    except InputError:
        return None


def describe_worse_axes(answer: DiagnosisAnswer, proof: UnseenMotionResult | None) -> str | None:
    """Return on which axes the corrected model is worse than the nominal one, as a sentence.

    Return None if there is no such axis. A motion that the diagnosis has not seen decides this. If
    there is none, the validation data decide.
    """
    if proof is not None:
        worse_axes = [
            get_axis_label(reduction.trace.axis)
            for reduction in proof.reductions
            if reduction.is_worse
        ]
        motion_name = proof.name
    else:
        worse_axes = [
            get_axis_label(shrinkage.axis)
            for diagnosis in answer.diagnosis.axes.values()
            for shrinkage in diagnosis.shrinkage
            if shrinkage.tap is Tap.MEAS
            and diagnosis.fitted
            and not shrinkage.corrected < shrinkage.raw
        ]
        motion_name = tr("validation data")
    if not worse_axes:
        return None
    text = tr("The corrected model is worse than the nominal one on {motion}: {axes}.")
    return text.format(motion=motion_name, axes=", ".join(dict.fromkeys(worse_axes)))


def find_notes(answer: DiagnosisAnswer) -> Iterator[str]:
    """Yield warnings: faults or contacts in the records of an answer, and contact-like causes."""
    for name, record in zip(answer.names, answer.records, strict=True):
        if NOTED_KEY in record.metadata:
            text = tr("During {record}: {noted}.")
            yield text.format(record=name, noted=record.metadata[NOTED_KEY])
    contact_like_effects = [
        effect
        for effect in answer.diagnosis.fitted
        if effect.enabled and effect.id in CONTACT_LIKE_EFFECTS
    ]
    if contact_like_effects:
        text = tr(
            "The model includes {causes}: the axis may have touched something. A "
            "penetration ignores this and also detects the contact with the nominal "
            "model."
        )
        yield text.format(
            causes=join_with_and([effect_word(effect.id) for effect in contact_like_effects])
        )
