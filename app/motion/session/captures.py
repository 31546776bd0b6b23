"""Captures: samples that the device takes at a high rate and sends afterwards."""

import threading
from collections import deque
from collections.abc import Sequence

from rotemina.app.motion.device import DeviceLink
from rotemina.drivers.abilities import CapturedSamples, FastCapturer
from rotemina.drivers.contract import Driver, GateEpoch, Permit
from rotemina.sim.messages import message


class CaptureRequests:
    """Starts captures, one at a time, and collects their samples."""

    def __init__(self, link: DeviceLink) -> None:
        self._link = link
        self._captured: deque[CapturedSamples] = deque()
        self._read_pending = threading.Event()
        self._read_epoch: GateEpoch | None = None

    def begin(self, axes: Sequence[str], rate_hz: float, count: int) -> None:
        """Start to sample axes at a high rate; :meth:`collect` returns the samples.

        Raises
        ------
        RequestRefusedError
            If the device cannot capture, or is not connected.
        """
        captured_axes = tuple(axes)

        def start_capture(driver: FastCapturer, _: Permit) -> None:
            driver.capture(captured_axes, rate_hz, count)
            self._captured.clear()

        self._link.queue_ability_call(
            FastCapturer, message("engine", "driver {name} cannot capture"), start_capture
        )

    def collect(self) -> tuple[CapturedSamples, ...]:
        """Return the samples of the latest capture that have arrived, and request more.

        Never waits: the next call returns the samples that the device holds now.
        """
        parts = []
        while self._captured:
            parts.append(self._captured.popleft())
        epoch = self._link.gate.epoch
        if self._read_pending.is_set() and self._read_epoch == epoch:
            return tuple(parts)
        # A stop drops queued requests, so the request must be repeated after a stop.
        self._read_epoch = epoch

        def read_capture(driver: Driver, _: Permit) -> None:
            self._read_pending.clear()
            if isinstance(driver, FastCapturer) and (captured := driver.read_capture()) is not None:
                self._captured.append(captured)

        self._read_pending.set()
        self._link.queue_driver_call(read_capture)
        return tuple(parts)
