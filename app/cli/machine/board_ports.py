"""Ports that a host can open: pseudo-terminals, and sockets on the loopback address."""

import ipaddress
import os
import socket
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from rotemina.app.errors import CommandError

_READ_BYTES = 4096
# While a host does not read, only the latest bytes are kept.
_MAX_UNREAD_BYTES = 1 << 16


class HostPort(Protocol):
    """A port through which a host communicates with boards, such as a pseudo-terminal."""

    @property
    def name(self) -> str:
        """The name by which a host opens the port."""
        ...

    def get_handles(self) -> tuple[int, ...]:
        """Return the file handles that become readable when there is something to receive."""
        ...

    def receive(self) -> bytes:
        """Return the bytes that the host has written since the last call; never waits."""
        ...

    def send(self, data: bytes) -> None:
        """Send bytes as soon as the host can take them; never waits."""
        ...

    def close(self) -> None:
        """Close the port."""
        ...


class PseudoTerminal:
    """A pseudo-terminal, optionally with a symbolic link to it.

    Raises
    ------
    InputError
        If the path of the link exists already, or this system has no pseudo-terminals.
    """

    def __init__(self, link: Path | None = None) -> None:
        try:
            import tty

            self._board_end, self._host_end = os.openpty()
        except (ImportError, AttributeError, OSError) as error:
            raise CommandError(
                "this system has no pseudo-terminals ({error}); use --tcp 127.0.0.1:0",
                error=str(error),
            ) from error
        # The host's end is kept open here. So the device stays in raw mode when a host closes it.
        tty.setraw(self._host_end)
        os.set_blocking(self._board_end, False)
        self._device = os.ttyname(self._host_end)
        self._link = link
        self._unsent = b""
        if link is not None:
            try:
                _make_link(link, self._device)
            except BaseException:
                self._link = None
                self.close()
                raise

    @property
    def name(self) -> str:
        """The name by which a host opens the port."""
        return self._device if self._link is None else f"{self._link} ({self._device})"

    def get_handles(self) -> tuple[int, ...]:
        """Return the file handles that become readable when there is something to receive."""
        return (self._board_end,)

    def receive(self) -> bytes:
        """Return the bytes that the host has written since the last call; never waits."""
        try:
            return os.read(self._board_end, _READ_BYTES)
        except BlockingIOError:
            return b""

    def send(self, data: bytes) -> None:
        """Send bytes as soon as the host can take them; never waits."""
        self._unsent += data
        if not self._unsent:
            return
        try:
            self._unsent = self._unsent[os.write(self._board_end, self._unsent) :]
        except BlockingIOError:
            # The buffer of the device is full, because no host reads.
            self._unsent = self._unsent[-_MAX_UNREAD_BYTES:]

    def close(self) -> None:
        """Close the device and remove its link."""
        if self._link is not None and _read_link_target(self._link) == self._device:
            self._link.unlink()
        os.close(self._board_end)
        os.close(self._host_end)


class LoopbackSocket:
    """A socket on the loopback address, for one host at a time.

    Raises
    ------
    InputError
        If the address is not a loopback address, or is in use.
    """

    def __init__(self, address: str, report: Callable[[str], None]) -> None:
        host, port = _parse_loopback_address(address)
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        self._listener = socket.socket(family)
        try:
            if os.name == "posix":
                self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            self._listener.bind((host, port))
            self._listener.listen(1)
        except OSError as error:
            self._listener.close()
            raise CommandError(
                "--tcp {address}: cannot listen there: {error}", address=address, error=str(error)
            ) from error
        self._listener.setblocking(False)
        self._report = report
        self._client: socket.socket | None = None
        self._unsent = b""

    @property
    def name(self) -> str:
        """The name by which a host opens the port."""
        host, port = self._listener.getsockname()[:2]
        return f"socket://[{host}]:{port}" if ":" in host else f"socket://{host}:{port}"

    def get_handles(self) -> tuple[int, ...]:
        """Return the file handles that become readable when there is something to receive."""
        handles = (self._listener.fileno(),)
        return handles if self._client is None else (*handles, self._client.fileno())

    def receive(self) -> bytes:
        """Return the bytes that the host has written since the last call; never waits."""
        self._accept()
        client = self._client
        if client is None:
            return b""
        try:
            data = client.recv(_READ_BYTES)
        except BlockingIOError:
            return b""
        except OSError:
            data = b""
        if not data:
            self._drop_client()
        return data

    def send(self, data: bytes) -> None:
        """Send bytes as soon as the host can take them; never waits."""
        # Another thread may set the attribute to None at any time.
        client = self._client
        if client is None:
            return
        self._unsent += data
        if not self._unsent:
            return
        try:
            self._unsent = self._unsent[client.send(self._unsent) :]
        except BlockingIOError:
            self._unsent = self._unsent[-_MAX_UNREAD_BYTES:]
        except OSError:
            self._drop_client()

    def close(self) -> None:
        """Close the port."""
        if self._client is not None:
            self._client.close()
        self._listener.close()

    def _accept(self) -> None:
        try:
            client, _ = self._listener.accept()
        except OSError:
            # No host wants to connect, or it has given up.
            return
        if self._client is not None:
            client.close()
            self._report(f"{self.name}: a second host was turned away")
            return
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._client, self._unsent = client, b""
        self._report(f"{self.name}: host connected")

    def _drop_client(self) -> None:
        if self._client is not None:
            self._client.close()
            self._client = None
            self._report(f"{self.name}: host disconnected")


def _parse_loopback_address(address: str) -> tuple[str, int]:
    host, colon, port = address.rpartition(":")
    host = host.strip("[]")
    host = "127.0.0.1" if host == "localhost" else host
    try:
        is_loopback = ipaddress.ip_address(host).is_loopback
    except ValueError:
        is_loopback = False
    if not is_loopback:
        raise CommandError(
            "--tcp {address}: {value} is not a loopback address; anyone who reaches a "
            "board can move it: use 127.0.0.1:PORT",
            address=address,
            value=repr(host or "no host"),
        )
    if not (colon and port.isascii() and port.isdigit() and int(port) <= 65535):
        raise CommandError(
            "--tcp {address}: the port must be a number from 0 (any) to 65535", address=address
        )
    return host, int(port)


def _make_link(link: Path, device: str) -> None:
    """Make a symbolic link to a device; only a dead link to another device is replaced."""
    old_target = _read_link_target(link)
    if old_target is not None and old_target.startswith("/dev/") and not Path(old_target).exists():
        link.unlink()
    try:
        link.symlink_to(device)
    except FileExistsError as error:
        raise CommandError(
            "--port {link} already exists; remove it, or choose another name", link=link
        ) from error
    except OSError as error:
        raise CommandError(
            "--port {link}: cannot create a link there: {error}", link=link, error=str(error)
        ) from error


def _read_link_target(link: Path) -> str | None:
    return str(link.readlink()) if link.is_symlink() else None
