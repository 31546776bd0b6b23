"""The gains in use: searched, tried on the simulated loop, saved and loaded."""

from pathlib import Path
from threading import Event as Flag

from PySide6.QtCore import QObject, Signal

from rotemina.app.shell.background_job import Job, Tell
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.background_search import problem_of, search
from rotemina.plugins.compensation.controls import Controls
from rotemina.plugins.compensation.plot_views import FrontView
from rotemina.plugins.compensation.words import point_text
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.robot.model import Robot
from rotemina.sim.tuning.search import Generation, SearchSettings
from rotemina.sim.tuning.search_problem import Evaluation, TuningProblem
from rotemina.sim.tuning.tuning_result import Tuning, load_tuning, save_tuning

_SEARCHED = "search"  # what gains are called that no file holds yet


class GainSearch(QObject):
    """One search at a time, and the front that it found.

    Signals
    -------
    failed(str)
    """

    failed = Signal(str)

    def __init__(self, workbench: Workbench, controls: Controls, front: FrontView) -> None:
        super().__init__(front)
        self._workbench, self._controls, self._front = workbench, controls, front
        self.tuning: Tuning | None = None
        self.name = _SEARCHED
        self._problem: TuningProblem | None = None  # of the tuning in hand
        self._enough = Flag()
        self._job, self._trying = Job(self), Job(self)
        self._job.told.connect(self._told)
        self._job.finished.connect(self._finished)
        self._job.failed.connect(self.failed)
        self._trying.finished.connect(self._show_tries)
        self._trying.failed.connect(self.failed)
        front.picked.connect(self.pick)

    @property
    def running(self) -> bool:
        """Whether a search continues."""
        return self._job.running

    def tune(self, robot: Robot, axis: str, model: InverseModel | None, source: str) -> None:
        """Search gains, fed forward through an inverse or not; the front is drawn as it evolves."""
        settings = SearchSettings(generations=self._controls.generations.value())
        self._enough = enough = Flag()
        self.tuning = self._problem = None

        def work(tell: Tell) -> tuple[TuningProblem, Tuning]:
            tell(mark("Preparing the simulated loop"), 0.0, None)
            problem = problem_of(robot, axis, model)

            def told(found: Generation) -> bool:
                tell("", found.share, found)
                return not enough.is_set()

            return problem, search(problem, settings, told, source if model is not None else "")

        self._job.start(work)

    def pick(self, number: int) -> None:
        """Take a point of the front, and try it on a step and a triangle."""
        tuning, problem = self.tuning, self._problem
        if tuning is None:
            return
        self.tuning = tuning.choosing(number)
        point = self.tuning.best
        self._front.mark(number)
        self._controls.point.setText(point_text(point, number))
        self._controls.typed.show_gains(tuning.axis, point.gains)
        if problem is not None:
            self._trying.start(lambda _: problem.try_out(point.gains)[0])

    def keep(self, path: Path) -> None:
        """Write the gains with the point that was taken."""
        tuning = self.tuning

        def done() -> None:
            self.name = path.name

        if tuning is not None:
            self._workbench.write_file("keep tuning", path, lambda: save_tuning(tuning, path), done)

    def open(self, path: Path) -> None:
        """Take the gains of a file in hand."""

        def done(tuning: Tuning) -> None:
            self._take(tuning, None, path.name)

        self._workbench.read_file("open tuning", path.name, lambda: load_tuning(path), done)

    def stop(self) -> None:
        """End the search; it keeps what it found."""
        self._enough.set()

    def close(self) -> None:
        """Stop, and wait until the threads are free."""
        self._enough.set()
        self._job.close()
        self._trying.close()

    def _told(self, what: str, share: float, news: object) -> None:
        told = tr(what) if what else ""
        if isinstance(news, Generation):
            text = tr("{done} of {total} generations, {points} points")
            told = text.format(done=news.done, total=news.total, points=len(news.front))
            self._front.show_generation(news, SearchSettings().against)
        self._controls.tell(told, share)

    def _finished(self, answer: tuple[TuningProblem, Tuning]) -> None:
        self._controls.tell("", None)
        self._take(answer[1], answer[0], _SEARCHED)

    def _take(self, tuning: Tuning, problem: TuningProblem | None, name: str) -> None:
        self.tuning, self._problem, self.name = tuning, problem, name
        self._controls.axis.setCurrentIndex(self._controls.axis.findData(tuning.axis))
        self._front.show_tuning(tuning)
        self.pick(tuning.chosen)

    def _show_tries(self, tries: tuple[Evaluation, Evaluation]) -> None:
        assert self.tuning is not None, "a point was taken"
        self._front.show_tries(*tries, self._workbench.robot.unit(self.tuning.axis) or "m")
