"""Solution of a plate in the background."""

from PySide6.QtCore import QObject, Signal

from rotemina.app.shell.background_job import Job, Tell
from rotemina.plugins.plate import mark
from rotemina.plugins.plate.coloured_quantities import QUANTITIES
from rotemina.plugins.plate.solution import Solved, solved
from rotemina.plugins.plate.surface_drawing import View, drawn
from rotemina.plugins.plate.surface_picture import static_picture
from rotemina.sim.robot.model import Robot


class Solving(QObject):
    """Solves one plate at a time; an end is requested between its stages.

    Signals
    -------
    progressed(str) : the stage that runs now.
    finished(Solved)
    failed(str)
    """

    progressed = Signal(str)
    finished = Signal(object)
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._job = Job(self)
        self._job.told.connect(self._tell)
        self._job.finished.connect(self.finished)
        self._job.failed.connect(self.failed)

    @property
    def running(self) -> bool:
        """Whether an answer is awaited."""
        return self._job.running

    def start(self, robot: Robot, divisions: int) -> None:
        """Solve a robot's plate; what ran before is stopped."""

        def work(tell: Tell) -> Solved:
            def stage(name: str) -> None:
                tell(name, 0.0, None)

            answer = solved(robot, divisions, stage)
            stage(mark("drawing"))
            # The first time this loads or compiles the loop over pixels: not on the window's
            # thread.
            picture = static_picture(answer, answer.ranges[:, 1], QUANTITIES[0], 1.0)
            drawn(picture.surface, View(), (8, 8), (0, 0, 0), (0, 0, 0), None)
            return answer

        self._job.start(work)

    def stop(self) -> None:
        """Discard the answer without waiting for the thread."""
        self._job.stop()

    def close(self) -> None:
        """Stop, and wait until the thread is free."""
        self._job.close()

    def _tell(self, stage: str, _share: float, _news: object) -> None:
        self.progressed.emit(stage)
