"""Slow work on a thread of its own, with its results delivered on the window's thread."""

import logging
import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple, TypeVar

from PySide6.QtCore import QObject, Signal

from rotemina.app.language import translate
from rotemina.app.workbench.help_topics import explain_error
from rotemina.sim.errors import MessageError

logger = logging.getLogger(__name__)
Result = TypeVar("Result")
ReportProgress = Callable[[str, float, object], None]


class _Request(NamedTuple):
    kind: str
    done: Callable[..., None]
    failed: Callable[[str], None]
    replaced: Callable[[], None]


def _run_catching_errors(work: Callable[[], object]) -> tuple[object, str]:
    """Run ``work``; return its result and "", or None and the message of its failure."""
    try:
        return work(), ""
    except MessageError as error:
        return None, explain_error(error)
    # A program error must be shown to the operator instead of being lost with the thread.
    except Exception as error:
        logger.exception("work in the background failed")
        text = translate("shell", "program error: {name}: {error}")
        return None, text.format(name=type(error).__name__, error=error)


class BackgroundWorker(QObject):
    """Thread that runs functions one at a time and delivers their results on the window's thread.

    If a later request of the same kind has been made meanwhile, the result of the earlier one is
    dropped and ``replaced`` is called instead. The thread exists only while there is work to do. It
    does not belong to Qt's thread pool: the pool would keep references to the
    functions that it has run, and thus to the records that they used.
    """

    _finished = Signal(int, object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._queue: deque[tuple[int, Callable[[], object]]] = deque()
        self._thread: threading.Thread | None = None
        # Protects the queue and the thread.
        self._lock = threading.Lock()
        self._requests: dict[int, _Request] = {}
        self._latest_numbers: dict[str, int] = {}
        self._last_number = 0
        self._finished.connect(self._deliver)

    def run(
        self,
        kind: str,
        work: Callable[[], Result],
        done: Callable[[Result], None],
        failed: Callable[[str], None],
        replaced: Callable[[], None] = lambda: None,
    ) -> None:
        """Start ``work``, and call one of the other functions on the window's thread when it ends.

        It calls ``done(result)`` after success, ``failed(message)`` after a failure, and
        ``replaced()`` if a later request of the same kind was made meanwhile. The message of a
        :class:`MessageError` carries its help page.
        """
        self._last_number += 1
        number = self._latest_numbers[kind] = self._last_number
        self._requests[number] = _Request(kind, done, failed, replaced)
        with self._lock:
            self._queue.append((number, work))
            if self._thread is None:
                self._thread = threading.Thread(target=self._run_queue, name="background")
                self._thread.start()

    @property
    def busy(self) -> bool:
        """Whether a result is still pending."""
        return bool(self._requests)

    def wait(self, timeout_s: float = 10.0) -> bool:
        """Wait until no work is running; return whether that happened within the time-out."""
        with self._lock:
            thread = self._thread
        if thread is not None:
            thread.join(timeout_s)
        return thread is None or not thread.is_alive()

    def discard_results(self) -> None:
        """Discard the results of all pending requests, because their receivers are closing."""
        self._requests.clear()
        self._latest_numbers.clear()

    def end(self, timeout_s: float = 10.0) -> bool:
        """Discard all pending results and wait as :meth:`wait` does, because the window closes."""
        self.discard_results()
        return self.wait(timeout_s)

    def _run_queue(self) -> None:
        while True:
            with self._lock:
                if not self._queue:
                    self._thread = None
                    return
                number, work = self._queue.popleft()
            result, failure = _run_catching_errors(work)
            # The window may be gone by now.
            with suppress(RuntimeError):
                self._finished.emit(number, result, failure)
            # An idle worker must not keep the last result in memory.
            del work, result

    def _deliver(self, number: int, result: object, failure: str) -> None:
        request = self._requests.pop(number, None)
        if request is None:
            return
        if self._latest_numbers.get(request.kind) != number:
            request.replaced()
            return
        del self._latest_numbers[request.kind]
        if failure:
            request.failed(failure)
        else:
            request.done(result)


class JobStoppedError(Exception):
    """The job was stopped by the operator."""


class BackgroundJob(QObject):
    """Runner of one long piece of work at a time.

    Signals
    -------
    progressed(str, float, object) : the current step, the finished fraction (0 to 1), and a
        partial result or None.
    finished(object) : the result.
    failed(str) : the message of the failure.
    """

    progressed = Signal(str, float, object)
    finished = Signal(object)
    failed = Signal(str)
    _reported = Signal(object, str, float, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._background = BackgroundWorker(self)
        self._ended = threading.Event()
        self._ended.set()
        self._reported.connect(self._on_reported)

    @property
    def running(self) -> bool:
        """Whether a result is pending."""
        return not self._ended.is_set()

    def start(self, work: Callable[[ReportProgress], object]) -> None:
        """Stop the previous job and start ``work``.

        The stopped job ends at its next progress report, which raises :class:`JobStoppedError`.
        """
        self.stop()
        ended = self._ended = threading.Event()

        def report(step: str, fraction: float, partial_result: object = None) -> None:
            if ended.is_set():
                raise JobStoppedError
            self._reported.emit(ended, step, fraction, partial_result)

        def work_until_stopped() -> object:
            try:
                return work(report)
            except JobStoppedError:
                return None

        self._background.run(
            "job",
            work_until_stopped,
            lambda answer: self._on_finished(ended, answer),
            lambda message: self._on_failed(ended, message),
        )

    def stop(self) -> None:
        """Discard the pending result; this does not wait for the thread."""
        self._ended.set()

    def close(self) -> None:
        """Stop the job and wait until its thread has ended."""
        self.stop()
        self._background.end(60.0)

    def _on_reported(
        self, ended: threading.Event, step: str, fraction: float, partial_result: object
    ) -> None:
        if not ended.is_set():
            self.progressed.emit(step, fraction, partial_result)

    def _on_finished(self, ended: threading.Event, answer: object) -> None:
        if not ended.is_set():
            ended.set()
            self.finished.emit(answer)

    def _on_failed(self, ended: threading.Event, message: str) -> None:
        if not ended.is_set():
            ended.set()
            self.failed.emit(message)
