"""A serial port as the drivers see it: bytes in, bytes out, never waiting.

What the system does not take at once waits in a short queue of the port, ahead of everything that
is written later. Only `UrgentBytes`, a stop, go before what waits, and in its place.
"""

import errno
import logging
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Lock
from typing import Protocol

import serial

from rotemina.drivers.byte_channels import ByteChannel, open_channel
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import ConnectionLostError, DriverError
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

#: A port that has taken nothing for so long is lost: nothing that waits is sent any more.
MAX_BLOCKED_S = 2.0
_MAX_WAITING = 1024  # bytes
_LOG = logging.getLogger(__name__)
_REMOTE = ("socket://", "rfc2217://")
_ABSENT = (errno.ENOENT, errno.ENODEV, errno.ENXIO)
_FORBIDDEN = (errno.EACCES, errno.EPERM)
_TAKEN = (errno.EBUSY, errno.EAGAIN)


class UrgentBytes(bytes):
    """Bytes that stop or cancel motion.

    They go before everything that waits in a port. A frame of which a part is out is finished
    first, so that it is not torn; all other frames that wait are discarded, except urgent ones.
    """

    __slots__ = ()


class Port(Protocol):
    """What a link needs of a port.

    ``write`` may be called by two threads at once: the frames of neither are torn.
    """

    def read(self) -> bytes:
        """Return what has arrived since the last call, at once.

        Raises
        ------
        ConnectionLostError
            If the port is gone, or has taken no byte for `MAX_BLOCKED_S`.
        """

    def write(self, data: bytes) -> None:
        """Send a frame, or queue it where the port takes no more for now; returns at once.

        Raises
        ------
        ConnectionLostError
            If the port is gone, or takes no more.
        """

    def waiting(self) -> int:
        """Return how many bytes have yet to be sent; those of the system only if it tells."""

    def close(self) -> None:
        """Close the port; safe to call twice."""


OpenPort = Callable[[str, int], Port]


def open_port(url: str, baud: int) -> Port:
    """Return an open port: a device, or a URL that pyserial knows, at so many baud.

    Raises
    ------
    DriverError
        If it cannot be opened, with what to do about it.
    """
    if not url:
        raise DriverError(
            message(
                "engine", "no serial port is set; set port to a device, for example /dev/ttyUSB0"
            )
        )
    if url.startswith(_REMOTE):
        _LOG.warning(
            "%s: anyone who reaches this address can move the machine: nothing is authenticated or "
            "encrypted; use it inside a trusted network only",
            url,
        )
    try:
        return SerialPort(url, open_channel(url, baud))
    except (serial.SerialException, OSError, ValueError) as error:
        raise DriverError(_why(url, error)) from error


class SerialPort:
    """A port of pyserial.

    Parameters
    ----------
    url : str
        How messages call it.
    channel : ByteChannel
    clock : callable
        Host time, s.
    """

    def __init__(self, url: str, channel: ByteChannel, clock: Clock = time.monotonic) -> None:
        self._url = url
        self._channel = channel
        self._clock = clock
        # Held only for what does not wait, so that a stop never waits for it either.
        self._lock = Lock()
        self._queue: deque[bytes] = deque()
        self._begun = False  # a part of the first frame in the queue is out
        self._progress_s = 0.0  # host time when the port last took a byte, or had none to take
        self._lost: str | None = None
        self._closed = False

    def read(self) -> bytes:
        """Send what waits and return what has arrived; see :class:`Port`."""
        with self._lock:
            self._require_sound()
            self._send_queue()
        with self._translated():
            return self._channel.read()

    def write(self, data: bytes) -> None:
        """Send a frame or queue it; see :class:`Port`."""
        with self._lock:
            try:
                self._require_sound()
            except ConnectionLostError:
                if isinstance(data, UrgentBytes):
                    # It may get through, though nobody can rely on it any more.
                    with suppress(ConnectionLostError), self._translated():
                        self._channel.write(self._channel.encoded(data))
                raise
            self._enqueue(data)
            self._send_queue()

    def waiting(self) -> int:
        """Return how many bytes wait; see :class:`Port`."""
        with self._lock:
            if self._closed:
                return 0
            with suppress(ConnectionLostError), self._translated():
                return sum(map(len, self._queue)) + self._channel.waiting()
        return 0

    def close(self) -> None:
        """Close the port; see :class:`Port`."""
        with self._lock:
            if self._closed:
                return
            self._closed = True
            is_blocked = bool(self._queue) or self._lost is not None
            self._queue.clear()
        # Outside the lock: it may wait for the device. Nothing is written any more.
        for action in (*((self._channel.discard,) if is_blocked else ()), self._channel.close):
            try:
                action()
            # A device that was pulled out cannot be closed either.
            except (OSError, TypeError) as error:
                _LOG.info("%s: closing it: %s", self._url, error)

    def _require_sound(self) -> None:
        """Raise if the port is lost; the caller holds the lock, here and below.

        Checked before anything is sent: what has waited for so long is not to be done now.
        """
        if self._closed:
            with self._translated():
                raise serial.PortNotOpenError
        if self._lost is not None:
            raise ConnectionLostError(self._lost)
        if self._queue and self._clock() - self._progress_s > MAX_BLOCKED_S:
            self._give_up()

    def _enqueue(self, data: bytes) -> None:
        frame = self._channel.encoded(data)
        if not self._queue:
            self._progress_s = self._clock()
        if isinstance(data, UrgentBytes):
            begun = [self._queue.popleft()] if self._begun else []
            kept = [each for each in self._queue if isinstance(each, UrgentBytes)]
            # One that is repeated while it waits is sent once.
            added = [] if frame in kept[-1:] else [UrgentBytes(frame)]
            self._queue = deque([*begun, *kept, *added])
        elif self._queue and sum(map(len, self._queue)) + len(frame) > _MAX_WAITING:
            self._give_up()
        else:
            self._queue.append(frame)

    def _send_queue(self) -> None:
        while self._queue:
            with self._translated():
                taken = self._channel.write(self._queue[0])
            if taken == 0:
                return
            self._progress_s = self._clock()
            frame = self._queue.popleft()
            self._begun = taken < len(frame)
            if self._begun:
                self._queue.appendleft(frame[taken:])

    def _give_up(self) -> None:
        """Raise that the port takes no more, now and from now on."""
        waiting = sum(map(len, self._queue))
        self._queue.clear()
        self._begun = False
        self._lost = message(
            "engine",
            "{url}: the port takes no more bytes: {waiting} bytes have been waiting for {seconds} "
            "s. The device or its adapter may hang: if the machine moves, use its emergency stop "
            "switch; check cable, adapter and device, then reconnect",
        ).fill(
            url=self._url,
            waiting=waiting,
            seconds=rounded(self._clock() - self._progress_s, 2),
        )
        raise ConnectionLostError(self._lost)

    @contextmanager
    def _translated(self) -> Iterator[None]:
        try:
            yield
        except (OSError, TypeError) as error:
            # pyserial reads from None (TypeError) when another thread has closed the port.
            raise ConnectionLostError(
                message(
                    "engine",
                    "{url}: the port has disappeared ({error}). Plug it in and reconnect, then "
                    "check the position of the machine",
                ).fill(url=self._url, error=reason_of(error))
            ) from error


def _why(url: str, error: Exception) -> str:
    """Return what is wrong with a port that does not open, and what to do."""
    number = getattr(error, "errno", None)
    said = str(error)
    if number in _FORBIDDEN or "Permission denied" in said or "PermissionError" in said:
        return message(
            "engine",
            "{url}: no permission to open it; add the user to the group that owns the device "
            "(dialout on most systems) and log in again",
        ).fill(url=url)
    if number in _TAKEN or "exclusively lock" in said or "Access is denied" in said:
        return message("engine", "{url}: another program uses it; close that program").fill(url=url)
    if number in _ABSENT or "could not open port" in said or "FileNotFoundError" in said:
        return message(
            "engine",
            "{url}: there is no such port ({said}); check the name, and whether the "
            "adapter is plugged in",
        ).fill(url=url, said=reason_of(error))
    return message("engine", "{url} cannot be opened: {said}").fill(url=url, said=reason_of(error))
