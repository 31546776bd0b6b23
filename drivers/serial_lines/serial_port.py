"""A serial port for the drivers, which reads and writes bytes and never blocks.

Bytes that the system does not accept at once wait in a short queue and are sent in order. Only
`UrgentBytes`, such as a stop, overtake the queue; they replace the frames in it.
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

from rotemina.drivers.contract import Clock, ConnectionLostError, DriverError
from rotemina.drivers.serial_lines.byte_channels import ByteChannel, open_channel
from rotemina.sim.errors import describe_exception
from rotemina.sim.messages import format_rounded, message

#: A port that accepts no bytes for longer than this is lost, and its queue is discarded.
MAX_BLOCKED_S = 2.0
_MAX_QUEUED_BYTES = 1024
_LOG = logging.getLogger(__name__)
_NETWORK_SCHEMES = ("socket://", "rfc2217://")
_ABSENT_ERRNOS = (errno.ENOENT, errno.ENODEV, errno.ENXIO)
_PERMISSION_ERRNOS = (errno.EACCES, errno.EPERM)
_BUSY_ERRNOS = (errno.EBUSY, errno.EAGAIN)


class UrgentBytes(bytes):
    """Bytes that stop or cancel motion.

    They overtake all frames that wait in a port. A frame that is partly sent is completed first, so
    that it stays intact. All other waiting frames are discarded, except urgent ones.
    """

    __slots__ = ()


class BytePort(Protocol):
    """The interface of a port that a link uses.

    Two threads may call ``write`` at the same time; the frames of both stay intact.
    """

    def read(self) -> bytes:
        """Return the bytes that have arrived since the last call; never waits.

        Raises
        ------
        ConnectionLostError
            If the port is gone, or has not accepted a byte for `MAX_BLOCKED_S`.
        """

    def write(self, data: bytes) -> None:
        """Send a frame, or queue it if the port accepts no more bytes now; returns at once.

        Raises
        ------
        ConnectionLostError
            If the port is gone or blocked.
        """

    def waiting(self) -> int:
        """Return how many bytes are not sent yet.

        The bytes that the operating system holds are included if it reports their number.
        """

    def close(self) -> None:
        """Close the port; safe to call twice."""


OpenPort = Callable[[str, int], BytePort]


def open_port(url: str, baud: int) -> BytePort:
    """Open a device, or a URL that pyserial supports, at a baud rate.

    Raises
    ------
    DriverError
        If it cannot be opened. The message says what to do.
    """
    if not url:
        raise DriverError("no serial port is set; set port to a device, for example /dev/ttyUSB0")
    if url.startswith(_NETWORK_SCHEMES):
        _LOG.warning(
            "%s: anyone who reaches this address can move the machine: nothing is authenticated or "
            "encrypted; use it inside a trusted network only",
            url,
        )
    try:
        return SerialPort(url, open_channel(url, baud))
    except (serial.SerialException, OSError, ValueError) as error:
        raise DriverError(_explain_open_failure(url, error)) from error


class SerialPort:
    """A port of pyserial.

    Parameters
    ----------
    url : str
        Name of the port in messages.
    channel : ByteChannel
    clock : callable
        Returns the host's time, s.
    """

    def __init__(self, url: str, channel: ByteChannel, clock: Clock = time.monotonic) -> None:
        self._url = url
        self._channel = channel
        self._clock = clock
        # Held only for operations that do not wait, so that a stop never waits for the lock.
        self._lock = Lock()
        self._queue: deque[bytes] = deque()
        # Whether the first frame in the queue has been sent in part.
        self._is_frame_started = False
        # Host time at which the port last accepted a byte, or had nothing to send.
        self._last_progress_s = 0.0
        self._loss_reason: str | None = None
        self._is_closed = False

    def read(self) -> bytes:
        """Send waiting bytes, and return the bytes that have arrived; see :class:`BytePort`."""
        with self._lock:
            self._require_usable()
            self._send_queue()
        with self._translate_errors():
            return self._channel.read()

    def write(self, data: bytes) -> None:
        """Send a frame or queue it; see :class:`BytePort`."""
        with self._lock:
            try:
                self._require_usable()
            except ConnectionLostError:
                if isinstance(data, UrgentBytes):
                    # A stop is sent even to a lost port, because it may still arrive.
                    with suppress(ConnectionLostError), self._translate_errors():
                        self._channel.write(self._channel.encode(data))
                raise
            self._enqueue(data)
            self._send_queue()

    def waiting(self) -> int:
        """Return how many bytes are not sent yet; see :class:`BytePort`."""
        with self._lock:
            if self._is_closed:
                return 0
            with suppress(ConnectionLostError), self._translate_errors():
                return sum(map(len, self._queue)) + self._channel.waiting()
        return 0

    def close(self) -> None:
        """Close the port; see :class:`BytePort`."""
        with self._lock:
            if self._is_closed:
                return
            self._is_closed = True
            is_blocked = bool(self._queue) or self._loss_reason is not None
            self._queue.clear()
        # The lock is not held here, because closing may wait for the device. Nothing is written
        # any more.
        for action in (*((self._channel.discard,) if is_blocked else ()), self._channel.close):
            try:
                action()
            # Closing an unplugged device fails, which does no harm.
            except (OSError, TypeError) as error:
                _LOG.info("%s: closing it: %s", self._url, error)

    def _require_usable(self) -> None:
        """Raise if the port is lost. The caller of this and the following methods holds the lock.

        This is checked before anything is sent, because a command that has waited too long must not
        be executed.
        """
        if self._is_closed:
            with self._translate_errors():
                raise serial.PortNotOpenError
        if self._loss_reason is not None:
            raise ConnectionLostError(self._loss_reason)
        if self._queue and self._clock() - self._last_progress_s > MAX_BLOCKED_S:
            self._declare_lost()

    def _enqueue(self, data: bytes) -> None:
        frame = self._channel.encode(data)
        if not self._queue:
            self._last_progress_s = self._clock()
        if isinstance(data, UrgentBytes):
            started_frames = [self._queue.popleft()] if self._is_frame_started else []
            urgent_frames = [queued for queued in self._queue if isinstance(queued, UrgentBytes)]
            # A stop that is repeated while it waits is sent only once.
            new_frames = [] if frame in urgent_frames[-1:] else [UrgentBytes(frame)]
            self._queue = deque([*started_frames, *urgent_frames, *new_frames])
        elif self._queue and sum(map(len, self._queue)) + len(frame) > _MAX_QUEUED_BYTES:
            self._declare_lost()
        else:
            self._queue.append(frame)

    def _send_queue(self) -> None:
        while self._queue:
            with self._translate_errors():
                sent_count = self._channel.write(self._queue[0])
            if sent_count == 0:
                return
            self._last_progress_s = self._clock()
            frame = self._queue.popleft()
            self._is_frame_started = sent_count < len(frame)
            if self._is_frame_started:
                self._queue.appendleft(frame[sent_count:])

    def _declare_lost(self) -> None:
        """Raise now and on every later use, because the port is lost."""
        waiting_count = sum(map(len, self._queue))
        self._queue.clear()
        self._is_frame_started = False
        self._loss_reason = message(
            "engine",
            "{url}: the port takes no more bytes: {waiting} bytes have been waiting for {seconds} "
            "s. The device or its adapter may have hung. If the machine moves, use its emergency "
            "stop switch. Check cable, adapter and device, then reconnect",
        ).fill(
            url=self._url,
            waiting=waiting_count,
            seconds=format_rounded(self._clock() - self._last_progress_s, 2),
        )
        raise ConnectionLostError(self._loss_reason)

    @contextmanager
    def _translate_errors(self) -> Iterator[None]:
        try:
            yield
        except (OSError, TypeError) as error:
            # pyserial raises TypeError if another thread has closed the port.
            raise ConnectionLostError(
                "{url}: the port has disappeared ({error}). Plug it in and reconnect, then "
                "check the position of the machine",
                url=self._url,
                error=describe_exception(error),
            ) from error


def _explain_open_failure(url: str, error: Exception) -> str:
    error_number = getattr(error, "errno", None)
    reason = str(error)
    if (
        error_number in _PERMISSION_ERRNOS
        or "Permission denied" in reason
        or "PermissionError" in reason
    ):
        return message(
            "engine",
            "{url}: no permission to open it; add the user to the group that owns the device "
            "(dialout on most systems) and log in again",
        ).fill(url=url)
    if error_number in _BUSY_ERRNOS or "exclusively lock" in reason or "Access is denied" in reason:
        return message("engine", "{url}: another program uses it; close that program").fill(url=url)
    if (
        error_number in _ABSENT_ERRNOS
        or "could not open port" in reason
        or "FileNotFoundError" in reason
    ):
        return message(
            "engine",
            "{url}: there is no such port ({said}); check the name, and whether the "
            "adapter is plugged in",
        ).fill(url=url, said=describe_exception(error))
    return message("engine", "{url} cannot be opened: {said}").fill(
        url=url, said=describe_exception(error)
    )
