"""Work away from the window's thread, with its answer brought back to it."""

import logging
import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple, TypeVar

from PySide6.QtCore import QObject, Signal

from rotemina.app.shell.help_topics import explained
from rotemina.app.shell.language import translate
from rotemina.sim.errors import ToldError

logger = logging.getLogger(__name__)
Answer = TypeVar("Answer")


class _Request(NamedTuple):
    kind: str
    done: Callable[..., None]
    failed: Callable[[str], None]
    replaced: Callable[[], None]


def _outcome(work: Callable[[], object]) -> tuple[object, str]:
    """Return the answer of work, and what it failed with or nothing."""
    try:
        return work(), ""
    except ToldError as error:
        return None, explained(error)
    except Exception as error:  # a fault of the program must reach the operator, not vanish
        logger.exception("work in the background failed")
        text = translate("shell", "program error: {name}: {error}")
        return None, text.format(name=type(error).__name__, error=error)


class Background(QObject):
    """Runs functions one by one on a thread; their answers arrive on the window's thread.

    An answer that was overtaken by a later request of the same kind is dropped, and ``replaced`` is
    called in its place. The thread is there only while there is something to do. (It is none of
    Qt's pool: that keeps much of what it has run, and with it the records that this was about.)
    """

    _finished = Signal(int, object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._waiting: deque[tuple[int, Callable[[], object]]] = deque()
        self._thread: threading.Thread | None = None
        self._guard = threading.Lock()  # of both
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
        replaced: Callable[[], None] = lambda: None,
    ) -> None:
        """Start ``work``; call one of the others on the window's thread when it has ended.

        That is ``done(answer)``, ``failed(message)``, or ``replaced()`` if a later request of the
        same kind has taken its place.
        The message of an error of this program knows its page of the help.
        """
        self._count += 1
        number = self._latest[kind] = self._count
        self._requests[number] = _Request(kind, done, failed, replaced)
        with self._guard:
            self._waiting.append((number, work))
            if self._thread is None:
                self._thread = threading.Thread(target=self._work_off, name="background")
                self._thread.start()

    @property
    def busy(self) -> bool:
        """Whether an answer is still to come."""
        return bool(self._requests)

    def wait(self, timeout_s: float = 10.0) -> bool:
        """Wait until nothing runs any more; say whether that came."""
        with self._guard:
            thread = self._thread
        if thread is not None:
            thread.join(timeout_s)
        return thread is None or not thread.is_alive()

    def drop_answers(self) -> None:
        """Let no answer arrive to what was asked until now: what would show it is going."""
        self._requests.clear()

    def end(self, timeout_s: float = 10.0) -> bool:
        """Wait as :meth:`wait` does, and let no answer arrive afterwards: the window closes."""
        self.drop_answers()
        return self.wait(timeout_s)

    def _work_off(self) -> None:
        while True:
            with self._guard:
                if not self._waiting:
                    self._thread = None
                    return
                number, work = self._waiting.popleft()
            answer, failure = _outcome(work)
            with suppress(RuntimeError):  # the window may be gone by now
                self._finished.emit(number, answer, failure)
            del work, answer  # which are not kept while nobody asks for anything

    def _deliver(self, number: int, answer: object, failure: str) -> None:
        request = self._requests.pop(number, None)
        if request is None:
            return
        if self._latest.get(request.kind) != number:
            request.replaced()
            return
        del self._latest[request.kind]
        if failure:
            request.failed(failure)
        else:
            request.done(answer)
