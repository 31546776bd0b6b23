"""Motions that a diagnosis has not seen: the next experiment, and a check of the answer."""

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from rotemina.app.motion.model import ModelInUse
from rotemina.app.workbench import ComparedRun, Workbench
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer.diagnosis_answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.requested_motion import RequestedMotion
from rotemina.plugins.gap.answer.unseen_motion_reduction import (
    UnseenMotionResult,
    make_new_motion,
    measure_reductions,
)
from rotemina.plugins.gap.answer.verdict_advice import make_new_motion_title
from rotemina.sim.gap.experiment import make_experiment_records


class UnseenMotion(QObject):
    """Plays the motions that an answer asks for, and checks the answer on every new run.

    Signals
    -------
    check_started() : the operator has confirmed a motion that no record contains.
    experiment_played(ComparedRun) : the experiment was played. Its record should be diagnosed
        together with the others.
    reduction_measured(UnseenMotionResult, bool) : the result of a new run, and whether that run
        was requested here.
    """

    check_started = Signal()
    experiment_played = Signal(object)
    reduction_measured = Signal(object, bool)

    def __init__(self, workbench: Workbench, parent: QObject) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._answer: DiagnosisAnswer | None = None
        # The corrected model of the answer.
        self._model: ModelInUse | None = None
        # Names of the motions that were offered or are being played.
        self._experiment_name: str | None = None
        self._check_name: str | None = None
        self._motion = RequestedMotion(workbench, self)
        self._motion.played.connect(self._on_played)
        self._motion.begun.connect(
            lambda name: name == self._check_name and self.check_started.emit()
        )

    def use_answer(self, answer: DiagnosisAnswer, model: ModelInUse | None) -> None:
        """Use another answer, and its corrected model."""
        self._answer, self._model = answer, model

    def ask_experiment(self, answer: DiagnosisAnswer, axis: str | None, window: QWidget) -> None:
        """Ask whether to play the suggested experiment of an axis, or else the first one."""
        experiments = answer.diagnosis.experiments
        index = next((i for i, experiment in enumerate(experiments) if experiment.axis == axis), 0)
        files = make_experiment_records(experiments[index], index + 1, "gap", answer.units)
        self._experiment_name = files.names.commands
        trajectory = files.records[self._experiment_name]
        self._motion.ask(window, tr("Next experiment"), self._experiment_name, trajectory)

    def ask_check(self, answer: DiagnosisAnswer, window: QWidget) -> None:
        """Ask whether to play a motion of the diagnosed axes that no record contains."""
        axes = tuple(answer.diagnosis.axes)
        name = self._check_name = make_new_motion_title(axes)
        self._workbench.work(
            "gap motion",
            tr("Computing a motion …"),
            lambda: make_new_motion(answer.diagnosis, answer.records, axes),
            lambda motion: self._motion.ask(window, tr("New motion"), name, motion),
        )

    def measure_reduction(self, run: ComparedRun) -> None:
        """Compute how far the gap shrinks on a run that was played or opened after the answer."""
        answer, model = self._answer, self._model
        if answer is None or model is None or run.name == self._experiment_name:
            return
        # A run that was played with the corrected model already contains its gap. A second
        # computation would start from slightly different states, and show another figure.
        model_in_use = self._workbench.session.model
        compared_model = model_in_use if model_in_use.predicts_like(model) else model
        self._workbench.work(
            "gap proof",
            tr("Comparing with the twin …"),
            lambda: measure_reductions(
                answer.diagnosis, compared_model, run, self._workbench.session.memory
            ),
            lambda proof: self._take_result(answer, proof),
        )

    def _on_played(self, run: ComparedRun) -> None:
        if run.name == self._experiment_name and self._answer is not None:
            self._experiment_name = None
            self.experiment_played.emit(run)

    def _take_result(self, answer: DiagnosisAnswer, proof: UnseenMotionResult) -> None:
        if answer is not self._answer or not proof.reductions:
            return
        is_requested = proof.name == self._check_name
        if is_requested:
            self._check_name = None
        self.reduction_measured.emit(proof, is_requested)
