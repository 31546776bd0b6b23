"""Work that takes long, away from the window's thread: its progress, its end, and its stop."""

from collections.abc import Callable
from threading import Event

from PySide6.QtCore import QObject, Signal

from rotemina.app.shell.background import Background

Tell = Callable[[str, float, object], None]


class StoppedError(Exception):
    """The operator wants no more of it."""


class Job(QObject):
    """Runs one piece of work at a time.

    Signals
    -------
    told(str, float, object) : what is done now, the share that is done, and news, if any.
    finished(object) : the answer.
    failed(str)
    """

    told = Signal(str, float, object)
    finished = Signal(object)
    failed = Signal(str)
    _heard = Signal(object, str, float, object)

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

    def start(self, work: Callable[[Tell], object]) -> None:
        """Begin; what ran before is stopped. ``work`` ends where what it tells to raises."""
        self.stop()
        stopped = self._stopped = Event()

        def tell(what: str, share: float, news: object = None) -> None:
            if stopped.is_set():
                raise StoppedError
            self._heard.emit(stopped, what, share, news)

        def guarded() -> object:
            try:
                return work(tell)
            except StoppedError:
                return None

        self._background.run(
            "job",
            guarded,
            lambda answer: self._end(stopped, answer),
            lambda message: self._fail(stopped, message),
        )

    def stop(self) -> None:
        """Want no answer any more; nobody waits for the thread."""
        self._stopped.set()

    def close(self) -> None:
        """Stop, and wait until the thread is free."""
        self.stop()
        self._background.end(60.0)

    def _hear(self, stopped: Event, what: str, share: float, news: object) -> None:
        if not stopped.is_set():
            self.told.emit(what, share, news)

    def _end(self, stopped: Event, answer: object) -> None:
        if not stopped.is_set():
            stopped.set()
            self.finished.emit(answer)

    def _fail(self, stopped: Event, message: str) -> None:
        if not stopped.is_set():
            stopped.set()
            self.failed.emit(message)
