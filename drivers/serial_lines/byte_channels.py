"""Channels that read and write bytes through pyserial and never block.

On most kinds of ports pyserial's ``write`` ignores its time-out: it never returns if the device
accepts no bytes. The channels of such ports bypass that method.
"""

import os
import select
import socket
from abc import ABC, abstractmethod
from collections import deque
from typing import Any

import serial

# No line delivers more bytes than this between two calls.
_MAX_READ_BYTES = 4096
# The operating system may hold at most this many bytes that it has not sent yet.
_MAX_UNSENT_BYTES = 256
# More writes than can be pending with `_MAX_UNSENT_BYTES` unsent bytes.
_MAX_PENDING_WRITES = 64
# "Interpret as command". A byte with this value in the data is sent twice (RFC 854).
_TELNET_IAC = b"\xff"


class ByteChannel(ABC):
    """An open port of pyserial whose reads and writes return at once.

    Parameters
    ----------
    port : serial.SerialBase
        A port with a time-out of 0.
    """

    # The type is Any, because most attributes used here are private or missing in the base class.
    def __init__(self, port: Any) -> None:
        self._serial = port

    @abstractmethod
    def write(self, data: bytes) -> int:
        """Write encoded bytes; return how many of them were accepted at once.

        Raises
        ------
        OSError
            If the port is gone.
        """

    def encode(self, data: bytes) -> bytes:
        """Return the bytes that the channel sends for ``data``."""
        return data

    def read(self) -> bytes:
        """Return the bytes that have arrived.

        Raises
        ------
        OSError, TypeError
            If the port is gone, or another thread has closed it.
        """
        return bytes(self._serial.read(_MAX_READ_BYTES))

    def waiting(self) -> int:
        """Return how many bytes the system has not sent yet; 0 if it does not report the number."""
        return 0

    def discard(self) -> None:  # noqa: B027 - most channels have nothing to discard
        """Discard bytes that the system has not sent yet; ``close`` would wait for them."""

    def close(self) -> None:
        """Close the port."""
        self._serial.close()


class DescriptorChannel(ByteChannel):
    """A non-blocking device file.

    pyserial's ``write`` would retry forever while the device accepts nothing.
    """

    _reports_unsent_bytes = True

    def write(self, data: bytes) -> int:
        """Write to the device; see :class:`ByteChannel`."""
        try:
            return os.write(self._serial.fileno(), data)
        except BlockingIOError:
            return 0

    def waiting(self) -> int:
        """Return how many bytes are not sent yet; see :class:`ByteChannel`."""
        if not self._reports_unsent_bytes:
            return 0
        try:
            return int(self._serial.out_waiting)
        except (TypeError, OSError):
            # This kind of device does not support the query, so the query is not repeated.
            self._reports_unsent_bytes = False
            return 0

    def discard(self) -> None:
        """Discard output; otherwise the kernel waits half a minute for it when closing."""
        self._serial.reset_output_buffer()


class WindowsChannel(ByteChannel):
    """A COM port of Windows, which accepts any number of writes and completes them later.

    The channel therefore accepts no bytes while the system has too many left to send.
    """

    def __init__(self, port: Any) -> None:
        super().__init__(port)
        # The system reads the bytes of a pending write from this memory, so keep them alive.
        self._pending_writes: deque[bytes] = deque(maxlen=_MAX_PENDING_WRITES)

    def write(self, data: bytes) -> int:
        """Start a write; see :class:`ByteChannel`."""
        unsent_count = self.waiting()
        if unsent_count == 0:
            self._pending_writes.clear()
        elif unsent_count + len(data) > _MAX_UNSENT_BYTES:
            return 0
        self._pending_writes.append(data)
        return int(self._serial.write(data))

    def waiting(self) -> int:
        """Return how many bytes are not sent yet; see :class:`ByteChannel`."""
        return int(self._serial.out_waiting)

    def discard(self) -> None:
        """Abort the pending writes."""
        self._serial.reset_output_buffer()


class SocketChannel(ByteChannel):
    """A raw TCP connection. Here, too, pyserial's ``write`` would retry forever."""

    def __init__(self, port: Any) -> None:
        super().__init__(port)
        # Without this option, a stop of one byte would wait until earlier bytes are acknowledged.
        port._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def close(self) -> None:
        """Close the connection, even if the other end is gone."""
        _close_connection(self._serial)

    def write(self, data: bytes) -> int:
        """Send the bytes that the connection accepts; see :class:`ByteChannel`."""
        try:
            return int(self._serial._socket.send(data))
        except BlockingIOError:
            return 0
        except AttributeError:
            raise serial.PortNotOpenError from None


class TelnetChannel(ByteChannel):
    """A port of another computer (RFC 2217). pyserial would wait until all bytes are accepted."""

    def close(self) -> None:
        """Close the connection, even if the other end is gone."""
        _close_connection(self._serial)

    def encode(self, data: bytes) -> bytes:
        """Escape the bytes for Telnet."""
        return data.replace(_TELNET_IAC, 2 * _TELNET_IAC)

    def write(self, data: bytes) -> int:
        """Send the bytes that the connection accepts; see :class:`ByteChannel`."""
        connection, lock = self._serial._socket, self._serial._write_lock
        if connection is None:
            raise serial.PortNotOpenError
        # pyserial's thread holds the lock while it answers the server, which may take long.
        if not lock.acquire(blocking=False):
            return 0
        try:
            # The socket has a time-out, so a send without room would block. The lock keeps other
            # threads from taking the room.
            if not select.select([], [connection], [], 0.0)[1]:
                return 0
            return int(connection.send(data))
        finally:
            lock.release()

    def read(self) -> bytes:
        """Return the bytes that have arrived; pyserial's port returns only one byte per call."""
        first_byte = bytes(self._serial.read(1))
        remaining_count = min(self._serial.in_waiting, _MAX_READ_BYTES) if first_byte else 0
        return first_byte + b"".join(bytes(self._serial.read(1)) for _ in range(remaining_count))


class LoopChannel(ByteChannel):
    """pyserial's loopback port."""

    def write(self, data: bytes) -> int:
        """Write as many bytes as there is room for; see :class:`ByteChannel`."""
        room = int(self._serial.buffer_size - self._serial.in_waiting)
        return int(self._serial.write(data[:room])) if room else 0


def _close_connection(port: Any) -> None:
    """Close a port of pyserial and its socket, which pyserial leaves open if a shutdown fails."""
    connection = port._socket
    port.close()
    if connection is not None:
        connection.close()


_CHANNEL_BY_SCHEME: dict[str, type[ByteChannel]] = {
    "socket": SocketChannel,
    "rfc2217": TelnetChannel,
    "loop": LoopChannel,
}


def open_channel(url: str, baud: int) -> ByteChannel:
    """Open a channel to a device or a URL that pyserial supports.

    Raises
    ------
    OSError, ValueError
        If it cannot be opened, or a write to it could block.
    """
    scheme = url.partition("://")[0].lower() if "://" in url else None
    channel_class = _CHANNEL_BY_SCHEME.get(scheme) if scheme is not None else None
    port = serial.serial_for_url(
        url,
        baudrate=baud,
        timeout=0,
        # Two channels do not support a write time-out. They never write more than the port accepts.
        write_timeout=None if channel_class in (TelnetChannel, LoopChannel) else 0,
        # A second program on the same device would disturb the communication.
        exclusive=None if scheme is not None else True,
    )
    if channel_class is None and isinstance(port, serial.Serial):
        channel_class = WindowsChannel if os.name == "nt" else DescriptorChannel
    if channel_class is None:
        port.close()
        raise ValueError(f"a write to {scheme}:// may wait, and a stop with it")
    return channel_class(port)
