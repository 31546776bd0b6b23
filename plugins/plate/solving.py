"""A plate solved away from the window's thread."""

from threading import Event

from PySide6.QtCore import QObject, Signal

from rotemina.app.shell.background import Background
from rotemina.plugins.plate.drawing import View, drawn
from rotemina.plugins.plate.picture import static_picture
from rotemina.plugins.plate.quantities import QUANTITIES
from rotemina.plugins.plate.solved import Solved, solved
from rotemina.sim.robot.model import Robot


class StoppedError(Exception):
    """The operator wants no answer any more."""


class Solving(QObject):
    """Solves one plate at a time; an end is asked for between its stages.

    Signals
    -------
    progressed(str) : the stage that runs now.
    finished(Solved)
    failed(str)
    """

    progressed = Signal(str)
    finished = Signal(object)
    failed = Signal(str)
    _heard = Signal(object, str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._background = Background(self)
        self._stopped = Event()
        self._stopped.set()
        self._heard.connect(self._hear)

    @property
    def running(self) -> bool:
        """Whether an answer is awaited."""
        return not self._stopped.is_set()

    def start(self, robot: Robot, divisions: int) -> None:
        """Solve a robot's plate; what ran before is stopped."""
        self.stop()
        stopped = self._stopped = Event()

        def stage(name: str) -> None:
            if stopped.is_set():
                raise StoppedError
            self._heard.emit(stopped, name)

        def work() -> Solved | None:
            try:
                answer = solved(robot, divisions, stage)
                stage("drawing")
                # The first time this loads or compiles the loop over pixels: not on the window's
                # thread.
                picture = static_picture(answer, answer.ranges[:, 1], QUANTITIES[0], 1.0)
                drawn(picture.surface, View(), (8, 8), (0, 0, 0), (0, 0, 0), None)
                return answer
            except StoppedError:
                return None

        self._background.run(
            "plate",
            work,
            lambda answer: self._end(stopped, answer),
            lambda message: self._fail(stopped, message),
        )

    def stop(self) -> None:
        """Want no answer any more; nobody waits for the thread."""
        self._stopped.set()

    def close(self) -> None:
        """Stop, and wait until the thread is free."""
        self.stop()
        self._background.wait(60.0)

    def _hear(self, stopped: Event, name: str) -> None:
        if not stopped.is_set():
            self.progressed.emit(name)

    def _end(self, stopped: Event, answer: Solved | None) -> None:
        if not stopped.is_set():
            stopped.set()
            self.finished.emit(answer)

    def _fail(self, stopped: Event, message: str) -> None:
        if not stopped.is_set():
            stopped.set()
            self.failed.emit(message)
