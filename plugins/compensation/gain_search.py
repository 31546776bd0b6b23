"""Gains of a loop: search, simulated responses, saving and loading."""

from pathlib import Path
from threading import Event as Flag

from PySide6.QtCore import QObject, Signal

from rotemina.app.workbench import BackgroundJob, ReportProgress, Workbench
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.background_search import make_problem, search_gains
from rotemina.plugins.compensation.controls import CompensationControls
from rotemina.plugins.compensation.plot_views import ParetoFrontView
from rotemina.plugins.compensation.words import describe_point
from rotemina.sim.compensate import InverseModel
from rotemina.sim.robot import Robot
from rotemina.sim.tuning import (
    ScenarioEvaluation,
    SearchGeneration,
    SearchSettings,
    TuningProblem,
    TuningResult,
    load_tuning,
    save_tuning,
)

# Name of gains that are not saved to a file yet.
_UNSAVED_NAME = "search"


class GainSearch(QObject):
    """Runner of gain searches, one at a time. It holds the latest tuning result.

    Signals
    -------
    failed(str) : a search or a simulation has failed, with this message.
    """

    failed = Signal(str)

    def __init__(
        self, workbench: Workbench, controls: CompensationControls, front: ParetoFrontView
    ) -> None:
        super().__init__(front)
        self._workbench, self._controls, self._front = workbench, controls, front
        self.tuning: TuningResult | None = None
        self.name = _UNSAVED_NAME
        # The problem that ``tuning`` solves. None if the tuning was loaded from a file.
        self._problem: TuningProblem | None = None
        self._stop_requested = Flag()
        self._job, self._response_job = BackgroundJob(self), BackgroundJob(self)
        self._job.progressed.connect(self._on_progress)
        self._job.finished.connect(self._on_finished)
        self._job.failed.connect(self._on_failed)
        self._response_job.finished.connect(self._show_responses)
        self._response_job.failed.connect(self.failed)
        front.picked.connect(self._on_picked)

    @property
    def running(self) -> bool:
        """Whether a search runs."""
        return self._job.running

    def tune(self, robot: Robot, axis: str, model: InverseModel | None, source: str) -> None:
        """Start a search, with feed-forward through ``model`` if it is given. Show its front.

        The previous tuning stays in use until the search succeeds.
        """
        settings = SearchSettings(generations=self._controls.generations.value())
        self._stop_requested = stop_requested = Flag()

        def work(report_progress: ReportProgress) -> tuple[TuningProblem, TuningResult]:
            report_progress(mark("Preparing the simulated loop"), 0.0, None)
            problem = make_problem(robot, axis, model)

            def report_generation(generation: SearchGeneration) -> bool:
                report_progress("", generation.completed_share, generation)
                return not stop_requested.is_set()

            return problem, search_gains(
                problem, settings, report_generation, source if model is not None else ""
            )

        self._job.start(work)

    def pick(self, index: int) -> None:
        """Choose a point of the front, and simulate its response to a step and a triangle."""
        tuning, problem = self.tuning, self._problem
        if tuning is None:
            return
        self.tuning = tuning.with_choice(index)
        point = self.tuning.chosen_point
        self._front.highlight_point(index)
        self._controls.point.setText(describe_point(point, index))
        self._controls.typed.show_gains(tuning.axis, point.gains)
        if problem is not None:
            self._response_job.start(lambda _: problem.try_out(point.gains)[0])

    def save(self, path: Path) -> None:
        """Write the gains with the chosen point to a file."""
        tuning = self.tuning

        def on_saved() -> None:
            self.name = path.name

        if tuning is not None:
            self._workbench.write_file(
                "keep tuning", path, lambda: save_tuning(tuning, path), on_saved
            )

    def open(self, path: Path) -> None:
        """Load gains from a file."""

        def on_loaded(tuning: TuningResult) -> None:
            self._use_tuning(tuning, None, path.name)

        self._workbench.read_file("open tuning", path.name, lambda: load_tuning(path), on_loaded)

    def stop(self) -> None:
        """Stop the search. The front found so far is kept."""
        self._stop_requested.set()

    def close(self) -> None:
        """Stop, and wait until the threads have ended."""
        self._stop_requested.set()
        self._job.close()
        self._response_job.close()

    def _on_progress(self, message: str, share: float, report: object) -> None:
        text = tr(message) if message else ""
        if isinstance(report, SearchGeneration):
            template = tr("{done} of {total} generations, {points} points")
            text = template.format(done=report.done, total=report.total, points=len(report.front))
            self._front.show_generation(report, SearchSettings().against)
        self._controls.show_progress(text, share)

    def _on_finished(self, answer: tuple[TuningProblem, TuningResult]) -> None:
        problem, tuning = answer
        self._controls.show_progress("", None)
        self._use_tuning(tuning, problem, _UNSAVED_NAME)

    def _on_picked(self, index: int) -> None:
        # While a search runs, the front on the screen is not that of the tuning.
        if not self.running:
            self.pick(index)

    def _on_failed(self, message: str) -> None:
        """Show the front of the tuning that stays in use, in place of the failed search's."""
        if self.tuning is None:
            self._front.clear_front()
        else:
            self._front.show_tuning(self.tuning)
            self._front.highlight_point(self.tuning.chosen)
        self.failed.emit(message)

    def _use_tuning(self, tuning: TuningResult, problem: TuningProblem | None, name: str) -> None:
        self.tuning, self._problem, self.name = tuning, problem, name
        self._controls.axis.setCurrentIndex(self._controls.axis.findData(tuning.axis))
        self._front.show_tuning(tuning)
        self.pick(tuning.chosen)

    def _show_responses(self, evaluations: tuple[ScenarioEvaluation, ScenarioEvaluation]) -> None:
        assert self.tuning is not None, "a point is chosen"
        self._front.show_responses(
            *evaluations, self._workbench.robot.unit(self.tuning.axis) or "m"
        )
