"""Motions that a diagnosis has not seen: the next experiment, and how far the gap shrinks there."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.shell.workbench import Run, Workbench
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.requested_motion import Playing
from rotemina.plugins.gap.unseen_motion_reduction import Proof, new_motion, prove
from rotemina.plugins.gap.verdict_advice import check_title
from rotemina.sim.gap.experiment.experiment_files import suggestion


class UnseenMotion(QObject):
    """Asks for motions that an answer calls for, and proves it on whatever is played or opened.

    Signals
    -------
    check_begun() : the operator wants a motion played that no record holds.
    experiment_played(Run) : of the answer; its record is to be diagnosed with the others.
    proved(Proof, bool) : what a new motion says of the answer, and whether it was requested here.
    """

    check_begun = Signal()
    experiment_played = Signal(object)
    proved = Signal(object, bool)

    def __init__(self, workbench: Workbench, parent: QObject) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._answer: Answer | None = None
        self._model: ModelInUse | None = None  # what the answer leads to
        self._experiment: str | None = None  # that is asked for, or under way
        self._check: str | None = None
        self._playing = Playing(workbench, self)
        self._playing.played.connect(self._use_played)
        self._playing.begun.connect(lambda name: name == self._check and self.check_begun.emit())

    def use_answer(self, answer: Answer, model: ModelInUse | None) -> None:
        """Speak of another answer, and of the model that it leads to."""
        self._answer, self._model = answer, model

    def ask_experiment(self, answer: Answer, axis: str | None, window: QWidget) -> None:
        """Ask whether to play the experiment that is suggested for an axis, or else the first."""
        experiments = answer.diagnosis.experiments
        number = next((n for n, one in enumerate(experiments) if one.axis == axis), 0)
        made = suggestion(experiments[number], number + 1, "gap", answer.units)
        self._experiment = made.names.commands
        trajectory = made.records[self._experiment]
        self._playing.ask(window, tr("Next experiment"), self._experiment, trajectory)

    def ask_check(self, answer: Answer, window: QWidget) -> None:
        """Ask whether to play a motion of the diagnosed axes that no record holds."""
        axes = tuple(answer.diagnosis.axes)
        name = self._check = check_title(axes)
        self._workbench.work(
            "gap motion",
            tr("Computing a motion …"),
            lambda: new_motion(answer.diagnosis, answer.records, axes),
            lambda motion: self._playing.ask(window, tr("New motion"), name, motion),
        )

    def prove(self, run: Run) -> None:
        """Work out how far the gap has shrunk on what was played or opened since the answer."""
        answer, model = self._answer, self._model
        if answer is None or model is None or run.name == self._experiment:
            return
        self._workbench.work(
            "gap proof",
            tr("Comparing with the twin …"),
            lambda: prove(answer.diagnosis, model, run, self._workbench.session.memory),
            lambda proof: self._take_proof(answer, proof),
        )

    def _use_played(self, run: Run) -> None:
        if run.name == self._experiment and self._answer is not None:
            self._experiment = None
            self.experiment_played.emit(run)

    def _take_proof(self, answer: Answer, proof: Proof) -> None:
        if answer is not self._answer or not proof.shrunk:
            return
        asked = proof.name == self._check
        if asked:
            self._check = None
        self.proved.emit(proof, asked)
