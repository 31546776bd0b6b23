"""A thread that calls a function at a steady rate."""

import logging
import threading
import time
from collections.abc import Callable

_LOG = logging.getLogger(__name__)


class Ticker:
    """Calls ``step`` every ``period_s`` on its own thread, from :meth:`start` to :meth:`close`.

    A late call does not delay later ones, and missed calls are not repeated. An exception in a step
    is logged and passed to ``on_failure``, and the calls continue.
    """

    def __init__(
        self,
        name: str,
        period_s: float,
        step: Callable[[], None],
        on_failure: Callable[[Exception], None] = lambda _: None,
    ) -> None:
        self._name = name
        self._period_s = period_s
        self._step = step
        self._on_failure = on_failure
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Start calling ``step``; does nothing if this has been started."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
            self._thread.start()

    def close(self, timeout_s: float = 2.0) -> None:
        """End after the current step. It is safe to call this twice, or from the step itself."""
        self._closing.set()
        thread = self._thread
        if thread is not None and thread is not threading.current_thread():
            thread.join(timeout_s)

    def _run(self) -> None:
        next_s = time.monotonic()
        while not self._closing.is_set():
            try:
                self._step()
            except Exception as error:
                # A failing step must not prevent later ones.
                _LOG.exception("%s: a step failed", self._name)
                self._on_failure(error)
            next_s = max(next_s + self._period_s, time.monotonic())
            self._closing.wait(next_s - time.monotonic())
