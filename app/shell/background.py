"""Work away from the window's thread, with its answer brought back to it."""

import logging
from collections.abc import Callable
from typing import NamedTuple, TypeVar

from PySide6.QtCore import QObject, QRunnable, QThreadPool, Signal

from rotemina.app.shell.help_topics import explained
from rotemina.app.shell.language import translate
from rotemina.sim.errors import InputError

logger = logging.getLogger(__name__)
Answer = TypeVar("Answer")


class _Request(NamedTuple):
    kind: str
    done: Callable[..., None]
    failed: Callable[[str], None]


class _Job(QRunnable):
    def __init__(self, work: Callable[[], object], finished: Callable[[object, str], None]) -> None:
        super().__init__()
        self._work = work
        self._finished = finished

    def run(self) -> None:
        answer: object = None
        failure = ""
        try:
            answer = self._work()
        except InputError as error:
            failure = explained(error)
        except Exception as error:  # a fault of the program must reach the operator, not vanish
            logger.exception("work in the background failed")
            failure = translate("shell", "a fault of the program: {name}: {error}").format(
                name=type(error).__name__, error=error
            )
        self._finished(answer, failure)


class Background(QObject):
    """Runs functions one by one on a thread; their answers arrive on the window's thread.

    An answer that was overtaken by a later request of the same kind is dropped.
    """

    _finished = Signal(int, object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._pool = QThreadPool(self)
        self._pool.setMaxThreadCount(1)
        self._requests: dict[int, _Request] = {}
        self._latest: dict[str, int] = {}
        self._count = 0
        self._finished.connect(self._deliver)

    def run(
        self,
        kind: str,
        work: Callable[[], Answer],
        done: Callable[[Answer], None],
        failed: Callable[[str], None],
    ) -> None:
        """Start ``work``; call ``done(answer)`` or ``failed(message)`` on the window's thread.

        The message of an :class:`InputError` knows its page of the help.
        """
        self._count += 1
        number = self._latest[kind] = self._count
        self._requests[number] = _Request(kind, done, failed)
        self._pool.start(
            _Job(work, lambda answer, failure: self._finished.emit(number, answer, failure))
        )

    @property
    def busy(self) -> bool:
        """Whether an answer is still to come."""
        return bool(self._requests)

    def wait(self, timeout_s: float = 10.0) -> bool:
        """Wait until nothing runs any more, for closing the window; say whether that came."""
        return self._pool.waitForDone(round(1000 * timeout_s))

    def _deliver(self, number: int, answer: object, failure: str) -> None:
        request = self._requests.pop(number)
        if self._latest[request.kind] != number:
            return
        if failure:
            request.failed(failure)
        else:
            request.done(answer)
