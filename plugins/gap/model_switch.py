"""Whether a corrected model is to be used: what speaks for it, what against it, and the switch."""

from collections.abc import Iterator, Sequence

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.display_units import label
from rotemina.app.motion.model_in_use import CONTACT_LIKE, NOTED, ModelInUse
from rotemina.app.shell.requests_at_rest import WaitingRequest
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.gap import mark, tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.unseen_motion_reduction import Proof
from rotemina.plugins.gap.words import all_of, effect_word
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Tap

NOT_USED = mark("The model stays: {why}. Press Use corrected model again.")


class ModelSwitch(QObject):
    """Puts the model of an answer to use, after a question where something speaks against it."""

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._parent = parent

    def ask(self, answer: Answer, against: str | None) -> None:
        """Use the corrected model; first ask, where something was noted or it is not better."""
        reasons = [text for text in (against, *noted_in(answer)) if text]
        if reasons:
            self._ask(answer, reasons)
        else:
            self.use(answer)

    def use(self, answer: Answer) -> None:
        """Make predictions with the corrected model from now on."""
        session, diagnosis = self._workbench.session, answer.diagnosis
        self._workbench.use_model(
            lambda: ModelInUse.corrected_by(diagnosis, session.driver, session.model)
        )

    def _ask(self, answer: Answer, reasons: Sequence[str]) -> None:
        question = QMessageBox(self._parent.window())
        question.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        question.setWindowTitle(tr("Use corrected model"))
        question.setTextFormat(Qt.TextFormat.PlainText)
        question.setText(tr("Use this model for predictions anyway?"))
        safe = tr("Predictions only: commands to the machine do not change, and no bound widens.")
        question.setInformativeText("\n\n".join([*reasons, safe]))
        yes, no = QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No
        question.setStandardButtons(yes | no)
        question.setDefaultButton(no)
        question.button(yes).setText(tr("Use anyway"))
        question.button(no).setText(tr("Not now"))
        request = WaitingRequest(self._workbench, tr(NOT_USED))

        def answered(reply: int) -> None:
            if request.waits and reply == yes:  # no stop has withdrawn it, and reported that
                self.use(answer)
            request.give_up()

        question.finished.connect(answered)
        self._workbench.stopped.connect(question.reject)
        question.setModal(False)
        question.show()


def candidate(answer: Answer) -> ModelInUse | None:
    """Return the model that an answer leads to; None where it adds nothing of use."""
    try:
        return ModelInUse.found_by(answer.diagnosis)
    except InputError:
        return None


def against(answer: Answer, proof: Proof | None) -> str | None:
    """Return why a corrected model is not offered by itself; None: it is better wherever it moves.

    A motion that the diagnosis has not seen counts most; without one, the data that its fits did
    not see.
    """
    if proof is not None:
        worse = [label(one.trace.axis) for one in proof.shrunk if one.worse]
        name = proof.name
    else:
        worse = [
            label(one.axis)
            for each in answer.diagnosis.axes.values()
            for one in each.shrinkage
            if one.tap is Tap.MEAS and each.fitted and not one.corrected < one.raw
        ]
        name = tr("validation data")
    if not worse:
        return None
    text = tr("The corrected model is worse than the nominal one on {motion}: {axes}.")
    return text.format(motion=name, axes=", ".join(dict.fromkeys(worse)))


def noted_in(answer: Answer) -> Iterator[str]:
    """Yield what was noted while the model was learned: faults, contacts, and causes like one."""
    for name, record in zip(answer.names, answer.records, strict=True):
        if NOTED in record.metadata:
            text = tr("During {record}: {noted}.")
            yield text.format(record=name, noted=record.metadata[NOTED])
    found = [one for one in answer.diagnosis.fitted if one.enabled and one.id in CONTACT_LIKE]
    if found:
        text = tr(
            "The model includes {causes}: the axis may have touched something. A "
            "penetration ignores this and also detects the contact with the nominal "
            "model."
        )
        yield text.format(causes=all_of([effect_word(one.id) for one in found]))
