"""The ways of pyserial to move bytes, each without ever waiting.

pyserial's own ``write`` waits on most kinds of ports, whatever its time-out: a device that takes no
bytes holds it for good. So bytes are written past it where it would.
"""

import os
import select
import socket
from abc import ABC, abstractmethod
from collections import deque
from typing import Any

import serial

_MAX_READ = 4096  # bytes: more than any line brings between two calls
_MAX_HELD = 256  # bytes with the system, which tells how many it still has to send
_MAX_PENDING = 64  # writes: more than `_MAX_HELD` bytes ever are
_IAC = b"\xff"  # doubled where it is data, RFC 854


class ByteChannel(ABC):
    """An open port of pyserial that is read and written at once.

    Parameters
    ----------
    opened : serial.SerialBase
        With a time-out of 0.
    """

    # Most of what is needed is private to pyserial, or not part of its base class.
    def __init__(self, opened: Any) -> None:
        self._serial = opened

    @abstractmethod
    def write(self, data: bytes) -> int:
        """Return how many of the encoded bytes were taken at once; 0 if none.

        Raises
        ------
        OSError
            If the port is gone.
        """

    def encoded(self, data: bytes) -> bytes:
        """Return bytes in the form in which they go through the channel."""
        return data

    def read(self) -> bytes:
        """Return what has arrived.

        Raises
        ------
        OSError, TypeError
            If the port is gone, or another thread has closed it.
        """
        return bytes(self._serial.read(_MAX_READ))

    def waiting(self) -> int:
        """Return how many bytes the system still has to send; 0 where it does not tell."""
        return 0

    def discard(self) -> None:  # noqa: B027 - most channels have nothing to discard
        """Discard what the system still has to send, for which closing would wait."""

    def close(self) -> None:
        """Close the port."""
        self._serial.close()


class DescriptorChannel(ByteChannel):
    """A device file, opened without waiting.

    pyserial's ``write`` tries again for ever when the device takes nothing.
    """

    _tells_waiting = True

    def write(self, data: bytes) -> int:
        """Write to the device; see :class:`ByteChannel`."""
        try:
            return os.write(self._serial.fileno(), data)
        except BlockingIOError:
            return 0

    def waiting(self) -> int:
        """Return how many bytes the device still has to send; see :class:`ByteChannel`."""
        if not self._tells_waiting:
            return 0
        try:
            return int(self._serial.out_waiting)
        except (TypeError, OSError):
            self._tells_waiting = False  # a device that does not say
            return 0

    def discard(self) -> None:
        """Discard output: the kernel waits half a minute for it when a device is closed."""
        self._serial.reset_output_buffer()


class WindowsChannel(ByteChannel):
    """A COM port of Windows, which takes any number of writes and completes them later.

    So no more is handed over while the system has much to send.
    """

    def __init__(self, opened: Any) -> None:
        super().__init__(opened)
        # The system reads the bytes of a write that is not completed from where they are.
        self._pending: deque[bytes] = deque(maxlen=_MAX_PENDING)

    def write(self, data: bytes) -> int:
        """Begin a write; see :class:`ByteChannel`."""
        held = self.waiting()
        if held == 0:
            self._pending.clear()
        elif held + len(data) > _MAX_HELD:
            return 0
        self._pending.append(data)
        return int(self._serial.write(data))

    def waiting(self) -> int:
        """Return how many bytes wait to be sent; see :class:`ByteChannel`."""
        return int(self._serial.out_waiting)

    def discard(self) -> None:
        """Abort the writes that are not completed."""
        self._serial.reset_output_buffer()


class SocketChannel(ByteChannel):
    """A raw connection over a network; pyserial's ``write`` tries again for ever here too."""

    def __init__(self, opened: Any) -> None:
        super().__init__(opened)
        # A stop of one byte would wait here until what was sent before it is confirmed.
        opened._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def close(self) -> None:
        """Close the connection, also where the other end is gone."""
        _close_connection(self._serial)

    def write(self, data: bytes) -> int:
        """Send what the connection takes; see :class:`ByteChannel`."""
        try:
            return int(self._serial._socket.send(data))
        except BlockingIOError:
            return 0
        except AttributeError:
            raise serial.PortNotOpenError from None


class TelnetChannel(ByteChannel):
    """A port of another computer by RFC 2217, where pyserial waits until all bytes are taken."""

    def close(self) -> None:
        """Close the connection, also where the other end is gone."""
        _close_connection(self._serial)

    def encoded(self, data: bytes) -> bytes:
        """Return bytes as telnet wants them."""
        return data.replace(_IAC, 2 * _IAC)

    def write(self, data: bytes) -> int:
        """Send what the connection takes; see :class:`ByteChannel`."""
        connection, lock = self._serial._socket, self._serial._write_lock
        if connection is None:
            raise serial.PortNotOpenError
        # pyserial's own thread holds the lock while it answers the server, and may wait then.
        if not lock.acquire(blocking=False):
            return 0
        try:
            # The connection has a time-out of its own; nobody else can fill it up now.
            if not select.select([], [connection], [], 0.0)[1]:
                return 0
            return int(connection.send(data))
        finally:
            lock.release()

    def read(self) -> bytes:
        """Return what has arrived: pyserial returns one byte a call here."""
        first = bytes(self._serial.read(1))
        more = min(self._serial.in_waiting, _MAX_READ) if first else 0
        return first + b"".join(bytes(self._serial.read(1)) for _ in range(more))


class LoopChannel(ByteChannel):
    """pyserial's connection from a port to itself."""

    def write(self, data: bytes) -> int:
        """Write what there is room for; see :class:`ByteChannel`."""
        room = int(self._serial.buffer_size - self._serial.in_waiting)
        return int(self._serial.write(data[:room])) if room else 0


def _close_connection(opened: Any) -> None:
    """Close a port of pyserial, which leaves its socket open if it cannot be shut down."""
    connection = opened._socket
    opened.close()
    if connection is not None:
        connection.close()


_BY_SCHEME: dict[str, type[ByteChannel]] = {
    "socket": SocketChannel,
    "rfc2217": TelnetChannel,
    "loop": LoopChannel,
}


def open_channel(url: str, baud: int) -> ByteChannel:
    """Return an open channel to a device, or to a URL that pyserial knows.

    Raises
    ------
    OSError, ValueError
        If it cannot be opened, or a write to it could wait.
    """
    scheme = url.partition("://")[0].lower() if "://" in url else None
    kind = _BY_SCHEME.get(scheme) if scheme is not None else None
    opened = serial.serial_for_url(
        url,
        baudrate=baud,
        timeout=0,
        # Two kinds know no time-out of writes; none of them is asked to write more than it takes.
        write_timeout=None if kind in (TelnetChannel, LoopChannel) else 0,
        # A second program on the same device would break into every conversation.
        exclusive=None if scheme is not None else True,
    )
    if kind is None and isinstance(opened, serial.Serial):
        kind = WindowsChannel if os.name == "nt" else DescriptorChannel
    if kind is None:
        opened.close()
        raise ValueError(f"a write to {scheme}:// may wait, and a stop with it")
    return kind(opened)
