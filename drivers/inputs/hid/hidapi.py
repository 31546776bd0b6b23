"""The interface to the library hidapi: loaded late, with its errors in plain words."""

import importlib
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, cast

from rotemina.drivers.errors import DriverError
from rotemina.drivers.inputs.device import InputLostError
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import SystemText, marked, message

if TYPE_CHECKING:
    from rotemina.drivers.inputs.hid.descriptor import ReportDescriptor

_DESCRIPTOR_BYTES = 4096
_PERMISSION = marked(
    "engine",
    "no permission to open it. On Linux, put the rule of docs/inputs.md into "
    "/etc/udev/rules.d/70-rotemina-inputs.rules, run `sudo udevadm control --reload`, and plug "
    "the device in again; elsewhere, allow this program to read input devices",
)


class Handle(Protocol):
    """What is used of ``hid.device``."""

    def open_path(self, path: bytes) -> None: ...  # noqa: D102
    def set_nonblocking(self, on: int) -> int: ...  # noqa: D102
    def get_report_descriptor(self, max_length: int = ...) -> Sequence[int]: ...  # noqa: D102
    def read(self, max_length: int) -> Sequence[int]: ...  # noqa: D102
    def error(self) -> str: ...  # noqa: D102
    def close(self) -> None: ...  # noqa: D102


class Hidapi(Protocol):
    """What is used of the library's module."""

    def enumerate(self) -> Sequence[Mapping[str, Any]]: ...  # noqa: D102
    def device(self) -> Handle: ...  # noqa: D102


def load_hidapi() -> Hidapi:
    """Return the library's module.

    On Linux that is the one on the kernel's ``hidraw``: the one on libusb takes a device away from
    the kernel, and does not tell a joystick from a keyboard without opening it.

    Raises
    ------
    DriverError
        If it is not installed, or lacks a library of the system.
    """
    failure: ImportError | None = None
    for name in ("hidraw", "hid") if sys.platform == "linux" else ("hid",):
        try:
            return cast(Hidapi, importlib.import_module(name))
        except ImportError as error:
            failure = error
    raise DriverError(
        message(
            "engine",
            "USB joysticks cannot be used: the library hidapi does not load ({failure}); install "
            "it with `pip install hidapi`, and libudev of the system",
        ).fill(failure=SystemText(failure))
    ) from failure


def open_handle(library: Hidapi, path: bytes, who: str) -> Handle:
    """Open a device, such that reading it never waits.

    Raises
    ------
    InputLostError
        If it is there no more.
    DriverError
        If it cannot be opened, with what to do about it.
    """
    handle = library.device()
    try:
        handle.open_path(path)
        handle.set_nonblocking(1)
    except (OSError, ValueError) as error:
        why = _why_closed(
            who,
            path,
            message("engine", "{error}: {said}").fill(error=reason_of(error), said=_said(handle)),
        )
        handle.close()
        raise why from error
    return handle


def read_descriptor(handle: Handle, who: str) -> "ReportDescriptor":
    """Ask an open device what its reports mean.

    Raises
    ------
    DriverError
        If it does not tell, or tells nonsense.
    """
    from rotemina.drivers.inputs.hid.descriptor import ReportDescriptor  # it takes its time

    try:
        raw = bytes(handle.get_report_descriptor(_DESCRIPTOR_BYTES))
    except (OSError, ValueError) as error:
        raise DriverError(
            message(
                "engine",
                "{who}: its report descriptor cannot be read ({error}); unplug it and plug it in "
                "again",
            ).fill(who=who, error=reason_of(error))
        ) from error
    return ReportDescriptor.parse(raw)


def _said(handle: Handle) -> str:
    """Return the library's reason, which its exceptions lack."""
    try:
        return str(handle.error())
    except (OSError, ValueError):
        return marked("engine", "no reason given")


def _why_closed(who: str, path: bytes, said: str) -> DriverError:
    """Return the error for a device that does not open."""
    where = f"{who} ({path.decode(errors='replace')})"
    lower = said.lower()
    if "no such" in lower or "not found" in lower or "cannot find" in lower:
        return InputLostError(
            message("engine", "{where}: no longer connected; plug it in again").fill(where=where)
        )
    if "denied" in lower or "not permitted" in lower:
        return DriverError(
            message("engine", "{where}: {permission} ({said})").fill(
                where=where, permission=_PERMISSION, said=said
            )
        )
    if "busy" in lower or "exclusive" in lower or "being used" in lower:
        return DriverError(
            message("engine", "{where}: another program uses it; close that program ({said})").fill(
                where=where, said=said
            )
        )
    return DriverError(
        message(
            "engine",
            "{where} cannot be opened ({said}); unplug it and plug it in again; see docs/inputs.md",
        ).fill(where=where, said=said)
    )
