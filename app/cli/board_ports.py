"""Ports that a host can open: pseudo-terminals, and sockets of this machine."""

import ipaddress
import os
import socket
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from rotemina.sim.errors import InputError
from rotemina.sim.messages import message

_PIECE = 4096
_MOST_WAITING = 1 << 16  # bytes that a host does not read


class HostPort(Protocol):
    """The end of a line that a host opens."""

    @property
    def name(self) -> str:
        """How a host calls it."""
        ...

    def handles(self) -> tuple[int, ...]:
        """Return what to wait for until there is something to receive."""
        ...

    def receive(self) -> bytes:
        """Return what the host has written since; never waits."""
        ...

    def send(self, data: bytes) -> None:
        """Hand bytes to the host as soon as it takes them; never waits."""
        ...

    def close(self) -> None:
        """Release it."""
        ...


class PseudoTerminal:
    """A pseudo-terminal, optionally under a name of its own.

    Raises
    ------
    InputError
        If there is something of that name already, or this system has no such devices.
    """

    def __init__(self, link: Path | None = None) -> None:
        try:
            import tty

            self._own, self._host = os.openpty()
        except (ImportError, AttributeError, OSError) as error:
            raise InputError(
                message(
                    "cli", "this system has no pseudo-terminals ({error}); use --tcp 127.0.0.1:0"
                ).fill(error=str(error))
            ) from error
        tty.setraw(self._host)  # held open: the device stays raw when a host leaves
        os.set_blocking(self._own, False)
        self._device = os.ttyname(self._host)
        self._link = link
        self._waiting = b""
        if link is not None:
            try:
                _make_link(link, self._device)
            except BaseException:
                self._link = None
                self.close()
                raise

    @property
    def name(self) -> str:
        """How a host calls it."""
        return self._device if self._link is None else f"{self._link} ({self._device})"

    def handles(self) -> tuple[int, ...]:
        """Return what to wait for until there is something to receive."""
        return (self._own,)

    def receive(self) -> bytes:
        """Return what the host has written since; never waits."""
        try:
            return os.read(self._own, _PIECE)
        except BlockingIOError:
            return b""

    def send(self, data: bytes) -> None:
        """Hand bytes to the host as soon as it takes them; never waits."""
        self._waiting += data
        if not self._waiting:
            return
        try:
            self._waiting = self._waiting[os.write(self._own, self._waiting) :]
        except BlockingIOError:
            self._waiting = self._waiting[-_MOST_WAITING:]  # nobody reads

    def close(self) -> None:
        """Release it, and take its name away."""
        if self._link is not None and _leads_to(self._link) == self._device:
            self._link.unlink()
        os.close(self._own)
        os.close(self._host)


class Socket:
    """A socket of this machine that one host at a time connects to.

    Raises
    ------
    InputError
        If the address is not one of this machine's own loop, or is taken.
    """

    def __init__(self, address: str, tell: Callable[[str], None]) -> None:
        host, port = _loopback(address)
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        self._listener = socket.socket(family)
        try:
            if os.name == "posix":
                self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            self._listener.bind((host, port))
            self._listener.listen(1)
        except OSError as error:
            self._listener.close()
            raise InputError(
                message("cli", "--tcp {address}: cannot listen there: {error}").fill(
                    address=address, error=str(error)
                )
            ) from error
        self._listener.setblocking(False)
        self._tell = tell
        self._client: socket.socket | None = None
        self._waiting = b""

    @property
    def name(self) -> str:
        """How a host calls it."""
        host, port = self._listener.getsockname()[:2]
        return f"socket://[{host}]:{port}" if ":" in host else f"socket://{host}:{port}"

    def handles(self) -> tuple[int, ...]:
        """Return what to wait for until there is something to receive."""
        own = (self._listener.fileno(),)
        return own if self._client is None else (*own, self._client.fileno())

    def receive(self) -> bytes:
        """Return what the host has written since; never waits."""
        self._accept()
        client = self._client
        if client is None:
            return b""
        try:
            data = client.recv(_PIECE)
        except BlockingIOError:
            return b""
        except OSError:
            data = b""
        if not data:
            self._hang_up()
        return data

    def send(self, data: bytes) -> None:
        """Hand bytes to the host as soon as it takes them; never waits."""
        client = self._client  # which another thread may hang up on
        if client is None:
            return
        self._waiting += data
        if not self._waiting:
            return
        try:
            self._waiting = self._waiting[client.send(self._waiting) :]
        except BlockingIOError:
            self._waiting = self._waiting[-_MOST_WAITING:]
        except OSError:
            self._hang_up()

    def close(self) -> None:
        """Release it."""
        if self._client is not None:
            self._client.close()
        self._listener.close()

    def _accept(self) -> None:
        try:
            client, _ = self._listener.accept()
        except OSError:  # nobody asks, or no longer
            return
        if self._client is not None:
            client.close()
            self._tell(f"{self.name}: a second host was turned away")
            return
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._client, self._waiting = client, b""
        self._tell(f"{self.name}: host connected")

    def _hang_up(self) -> None:
        if self._client is not None:
            self._client.close()
            self._client = None
            self._tell(f"{self.name}: host gone")


def _loopback(address: str) -> tuple[str, int]:
    host, colon, port = address.rpartition(":")
    host = host.strip("[]")
    host = "127.0.0.1" if host == "localhost" else host
    try:
        own = ipaddress.ip_address(host).is_loopback
    except ValueError:
        own = False
    if not own:
        raise InputError(
            message(
                "cli",
                "--tcp {address}: {value} is not a loopback address; anyone who reaches a "
                "board can move it: use 127.0.0.1:PORT",
            ).fill(address=address, value=repr(host or "no host"))
        )
    if not (colon and port.isascii() and port.isdigit() and int(port) <= 65535):
        raise InputError(
            message("cli", "--tcp {address}: the port must be a number from 0 (any) to 65535").fill(
                address=address
            )
        )
    return host, int(port)


def _make_link(link: Path, device: str) -> None:
    """Give a device a name, over nothing but a dead link of a board that was."""
    leads_to = _leads_to(link)
    if leads_to is not None and leads_to.startswith("/dev/") and not Path(leads_to).exists():
        link.unlink()
    try:
        link.symlink_to(device)
    except FileExistsError as error:
        raise InputError(
            message(
                "cli",
                "--port {link} already exists; remove it, or choose another name",
            ).fill(link=link)
        ) from error
    except OSError as error:
        raise InputError(
            message("cli", "--port {link}: cannot create a link there: {error}").fill(
                link=link, error=str(error)
            )
        ) from error


def _leads_to(link: Path) -> str | None:
    return str(link.readlink()) if link.is_symlink() else None
