"""Samples at a high rate, taken by the device and fetched afterwards."""

import threading
from collections import deque
from collections.abc import Sequence

from rotemina.app.motion.device_link import DeviceLink
from rotemina.drivers.abilities import Capturer
from rotemina.drivers.capture import Captured
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Epoch, Permit
from rotemina.sim.messages import message


class Captures:
    """One capture at a time."""

    def __init__(self, link: DeviceLink) -> None:
        self._link = link
        self._captured: deque[Captured] = deque()
        self._collecting = threading.Event()
        self._collected_at: Epoch | None = None

    def begin(self, axes: Sequence[str], rate_hz: float, count: int) -> None:
        """Begin to sample axes at a high rate; :meth:`collected` hands the samples out.

        Raises
        ------
        RefusedError
            If the device cannot, or is not connected.
        """
        wanted = tuple(axes)

        def begin(driver: Capturer, _: Permit) -> None:
            driver.capture(wanted, rate_hz, count)
            self._captured.clear()

        self._link.ask_able(Capturer, message("engine", "driver {name} cannot capture"), begin)

    def collected(self) -> tuple[Captured, ...]:
        """Return the new data of the latest capture, and request more.

        Never waits: data that the device has by now arrive with the next call.
        """
        found = []
        while self._captured:
            found.append(self._captured.popleft())
        epoch = self._link.gate.epoch
        if self._collecting.is_set() and self._collected_at == epoch:
            return tuple(found)
        self._collected_at = epoch  # a stop drops what was asked for before

        def collect(driver: Driver, _: Permit) -> None:
            self._collecting.clear()
            if isinstance(driver, Capturer) and (part := driver.captured()) is not None:
                self._captured.append(part)

        self._collecting.set()
        self._link.ask(collect)
        return tuple(found)
