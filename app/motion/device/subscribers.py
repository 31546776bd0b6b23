"""Subscribers to a session's events and samples."""

import logging
import threading
from collections.abc import Callable

from rotemina.app.motion.device.worker import SampleCallback
from rotemina.app.motion.model import ModelOutputs
from rotemina.app.motion.state import EventCallback, SessionEvent
from rotemina.drivers.contract import DeviceSamples

_LOG = logging.getLogger(__name__)


class SessionSubscribers:
    """Callbacks for events and samples; any thread may add and remove them.

    A callback that fails does not stop other callbacks or motion.
    """

    def __init__(self) -> None:
        # The lock is not held while a callback runs, because it may subscribe or unsubscribe.
        self._lock = threading.Lock()
        self._event_callbacks: list[EventCallback] = []
        # Callbacks for samples, each with whether it has failed before.
        self._taps: dict[SampleCallback, bool] = {}

    def subscribe(self, callback: EventCallback) -> Callable[[], None]:
        """Call ``callback`` for each event, on the worker's thread.

        Return the function that ends the subscription.
        """
        with self._lock:
            self._event_callbacks.append(callback)

        def unsubscribe() -> None:
            with self._lock:
                if callback in self._event_callbacks:
                    self._event_callbacks.remove(callback)

        return unsubscribe

    def tap(self, callback: SampleCallback) -> Callable[[], None]:
        """Call ``callback`` for each batch of samples, with the outputs of the models.

        The worker calls it on its own thread and waits for it: at most every 16 ms, after the state
        is published and before the events. Return the function that ends the subscription.
        """
        with self._lock:
            self._taps[callback] = False

        def unsubscribe() -> None:
            with self._lock:
                self._taps.pop(callback, None)

        return unsubscribe

    def emit(self, event: SessionEvent) -> None:
        """Report an event to all subscribers."""
        with self._lock:
            callbacks = tuple(self._event_callbacks)
        for callback in callbacks:
            try:
                callback(event)
            except Exception:
                # An error in a subscriber must not stop the worker.
                _LOG.exception("a subscriber failed on %s", type(event).__name__)

    def send_samples(self, samples: DeviceSamples, model_outputs: ModelOutputs) -> None:
        """Pass a batch of samples to the callbacks of :meth:`tap`."""
        with self._lock:
            callbacks = tuple(self._taps.items())
        for callback, has_failed in callbacks:
            try:
                callback(samples, model_outputs)
            except Exception:
                # Log only the first failure, because it may repeat sixty times a second.
                if not has_failed:
                    _LOG.exception("a tap failed")
                    with self._lock:
                        # Meanwhile the callback may have unsubscribed.
                        if callback in self._taps:
                            self._taps[callback] = True
