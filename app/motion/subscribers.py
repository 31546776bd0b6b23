"""Subscribers to a session's events and samples."""

import logging
import threading
from collections.abc import Callable

from rotemina.app.motion.live_models import ModelOutputs
from rotemina.app.motion.state import Callback, Event
from rotemina.app.motion.worker import Tap
from rotemina.drivers.samples import Samples

_LOG = logging.getLogger(__name__)


class Subscribers:
    """Callbacks, which come and go on any thread; a failing one stops neither others nor motion."""

    def __init__(self) -> None:
        self._lock = threading.Lock()  # never held while a callback is called
        self._callbacks: list[Callback] = []
        self._taps: dict[Tap, bool] = {}  # whether it has failed

    def subscribe(self, callback: Callback) -> Callable[[], None]:
        """Call ``callback`` for each event, on the worker's thread; return how to end that."""
        with self._lock:
            self._callbacks.append(callback)

        def unsubscribe() -> None:
            with self._lock:
                if callback in self._callbacks:
                    self._callbacks.remove(callback)

        return unsubscribe

    def tap(self, callback: Tap) -> Callable[[], None]:
        """Call ``callback`` for each portion of samples, with the models' answers.

        It is called on the worker's thread, which waits for it: at most every 16 ms, after the
        state is published and before events tell of it. Returns how to end that.
        """
        with self._lock:
            self._taps[callback] = False

        def end() -> None:
            with self._lock:
                self._taps.pop(callback, None)

        return end

    def emit(self, event: Event) -> None:
        """Report an event to all subscribers."""
        with self._lock:
            callbacks = tuple(self._callbacks)
        for callback in callbacks:
            try:
                callback(event)
            except Exception:  # a subscriber's mistake must not stop the machine's worker
                _LOG.exception("a subscriber failed on %s", type(event).__name__)

    def pass_on(self, samples: Samples, answers: ModelOutputs) -> None:
        """Give a portion of samples to the taps."""
        with self._lock:
            taps = tuple(self._taps.items())
        for callback, failed in taps:
            try:
                callback(samples, answers)
            except Exception:  # as of a subscriber; said once, not sixty times a second
                if not failed:
                    _LOG.exception("a tap failed")
                    with self._lock:
                        if callback in self._taps:  # it may have ended itself
                            self._taps[callback] = True
