"""A serial port as the link sees it: bytes in, bytes out, never waiting."""

import errno
import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock
from typing import Protocol

import serial

from rotemina.drivers.errors import ConnectionLostError, DriverError
from rotemina.sim.messages import message

_LOG = logging.getLogger(__name__)
_AT_ONCE = 4096  # bytes: more than any line brings between two calls
_REMOTE = ("socket://", "rfc2217://")
_ABSENT = (errno.ENOENT, errno.ENODEV, errno.ENXIO)
_FORBIDDEN = (errno.EACCES, errno.EPERM)
_TAKEN = (errno.EBUSY, errno.EAGAIN)


class Port(Protocol):
    """What a link needs of a port.

    ``write`` may be called by two threads at once: the frames of neither are torn.
    """

    def read(self) -> bytes:
        """Return what has arrived since the last call, at once.

        Raises
        ------
        ConnectionLostError
            If the port is gone.
        """

    def write(self, data: bytes) -> None:
        """Hand bytes to the operating system, at once.

        Raises
        ------
        ConnectionLostError
            If the port is gone, or takes no more.
        """

    def waiting(self) -> int:
        """Return how many bytes the operating system still holds back; 0 if it does not tell."""

    def close(self) -> None:
        """Let go of the port; safe to call twice."""


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
            "%s: whoever reaches this address can move the machine: nothing is authenticated or "
            "encrypted; use it inside a trusted network only",
            url,
        )
    remote = "://" in url
    try:
        # A second program on the same device would break into every conversation.
        exclusive = None if remote else True
        opened = serial.serial_for_url(
            url, baudrate=baud, timeout=0, write_timeout=0, exclusive=exclusive
        )
    except (serial.SerialException, OSError, ValueError) as error:
        raise DriverError(_why(url, error)) from error
    return SerialPort(url, opened)


class SerialPort:
    """A port of pyserial.

    Parameters
    ----------
    url : str
        How messages call it.
    opened : serial.SerialBase
        With time-outs of 0.
    """

    def __init__(self, url: str, opened: serial.SerialBase) -> None:
        self._url = url
        self._serial = opened
        self._frame = Lock()  # held for one write of at most a frame, which does not wait
        self._tells_waiting = True

    def read(self) -> bytes:
        """Return what has arrived; see :class:`Port`."""
        with self._translated():
            return bytes(self._serial.read(_AT_ONCE))

    def write(self, data: bytes) -> None:
        """Hand bytes over; see :class:`Port`."""
        with self._frame, self._translated():
            taken = self._serial.write(data)
        if taken is not None and taken < len(data):
            raise ConnectionLostError(
                message(
                    "engine",
                    "{url}: the port accepts no more bytes; check whether the line is blocked",
                ).fill(url=self._url)
            )

    def waiting(self) -> int:
        """Return how many bytes wait; see :class:`Port`."""
        if not self._tells_waiting:
            return 0
        try:
            return int(self._serial.out_waiting)  # type: ignore[attr-defined]
        except (AttributeError, NotImplementedError, OSError):
            self._tells_waiting = False  # a socket, or a device that does not say
            return 0

    def close(self) -> None:
        """Let go; see :class:`Port`."""
        try:
            self._serial.close()
        except OSError as error:  # a device that was pulled out cannot be closed either
            _LOG.info("%s: closing it: %s", self._url, error)

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
                ).fill(url=self._url, error=str(error))
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
        ).fill(url=url, said=said)
    return message("engine", "{url} cannot be opened: {said}").fill(url=url, said=said)
