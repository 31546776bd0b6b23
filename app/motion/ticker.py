"""A thread that calls a function at a steady rate."""

import logging
import threading
import time
from collections.abc import Callable

_LOG = logging.getLogger(__name__)


class Ticker:
    """Calls ``step`` every ``period_s`` on its own thread, from :meth:`start` to `close`.

    What is late once is not late for ever, and nothing is made up for. A step that raises is
    logged and told to ``failed``; the next one is called all the same.
    """

    def __init__(
        self,
        name: str,
        period_s: float,
        step: Callable[[], None],
        failed: Callable[[Exception], None] = lambda _: None,
    ) -> None:
        self._name = name
        self._period_s = period_s
        self._step = step
        self._failed = failed
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Begin; nothing happens if it has begun."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
            self._thread.start()

    def close(self, timeout_s: float = 2.0) -> None:
        """End after the present step; safe to call twice, and from the step itself."""
        self._closing.set()
        thread = self._thread
        if thread is not None and thread is not threading.current_thread():
            thread.join(timeout_s)

    def _run(self) -> None:
        next_s = time.monotonic()
        while not self._closing.is_set():
            try:
                self._step()
            except Exception as error:  # one bad step must not end all that follow
                _LOG.exception("%s: a step failed", self._name)
                self._failed(error)
            next_s = max(next_s + self._period_s, time.monotonic())
            self._closing.wait(next_s - time.monotonic())
