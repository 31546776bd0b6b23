"""The interface to the hidapi library, which is loaded on demand, and messages for its errors."""

import importlib
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, cast

from rotemina.drivers.contract import DriverError, InputLostError
from rotemina.sim.errors import describe_exception
from rotemina.sim.messages import SystemText, marked, message

if TYPE_CHECKING:
    from rotemina.drivers.inputs.hid_descriptor import ReportDescriptor

_MAX_DESCRIPTOR_BYTES = 4096
_PERMISSION_HINT = marked(
    "engine",
    "no permission to open it. On Linux, put the rule of docs/inputs.md into "
    "/etc/udev/rules.d/70-rotemina-inputs.rules, run `sudo udevadm control --reload`, and plug "
    "the device in again; elsewhere, allow this program to read input devices",
)


class HidHandle(Protocol):
    """The methods of ``hid.device`` that are used."""

    def open_path(self, path: bytes) -> None: ...  # noqa: D102
    def set_nonblocking(self, on: int) -> int: ...  # noqa: D102
    def get_report_descriptor(self, max_length: int = ...) -> Sequence[int]: ...  # noqa: D102
    def read(self, max_length: int) -> Sequence[int]: ...  # noqa: D102
    def error(self) -> str: ...  # noqa: D102
    def close(self) -> None: ...  # noqa: D102


class HidLibrary(Protocol):
    """The functions of the library's module that are used."""

    def enumerate(self) -> Sequence[Mapping[str, Any]]: ...  # noqa: D102
    def device(self) -> HidHandle: ...  # noqa: D102


def load_hidapi() -> HidLibrary:
    """Load the library's module.

    On Linux this is the variant that uses the kernel's ``hidraw``. The libusb variant detaches a
    device from the kernel, and cannot distinguish a joystick from a keyboard without opening it.

    Raises
    ------
    DriverError
        If hidapi is not installed, or a system library is missing.
    """
    failure: ImportError | None = None
    for name in ("hidraw", "hid") if sys.platform == "linux" else ("hid",):
        try:
            return cast(HidLibrary, importlib.import_module(name))
        except ImportError as error:
            failure = error
    raise DriverError(
        "USB joysticks cannot be used: the library hidapi does not load ({failure}); install "
        "it with `pip install hidapi`, and install the system's libudev",
        failure=SystemText(failure),
    ) from failure


def open_handle(library: HidLibrary, path: bytes, device_name: str) -> HidHandle:
    """Open a device for non-blocking reads.

    Raises
    ------
    InputLostError
        If it is no longer plugged in.
    DriverError
        If it cannot be opened. The message says what to do.
    """
    handle = library.device()
    try:
        handle.open_path(path)
        handle.set_nonblocking(1)
    except (OSError, ValueError) as error:
        failure = _explain_open_failure(
            device_name,
            path,
            message("engine", "{error}: {said}").fill(
                error=describe_exception(error), said=_read_reason(handle)
            ),
        )
        handle.close()
        raise failure from error
    return handle


def read_descriptor(handle: HidHandle, device_name: str) -> "ReportDescriptor":
    """Read the report descriptor of an open device.

    Raises
    ------
    DriverError
        If it cannot be read, or is invalid.
    """
    # Imported here because the import is slow.
    from rotemina.drivers.inputs.hid_descriptor import ReportDescriptor

    try:
        raw = bytes(handle.get_report_descriptor(_MAX_DESCRIPTOR_BYTES))
    except (OSError, ValueError) as error:
        raise DriverError(
            "{who}: its report descriptor cannot be read ({error}); unplug it and plug it in again",
            who=device_name,
            error=describe_exception(error),
        ) from error
    return ReportDescriptor.parse(raw)


def _read_reason(handle: HidHandle) -> str:
    """Return the reason for a failure, which the library's exceptions do not contain."""
    try:
        return str(handle.error())
    except (OSError, ValueError):
        return marked("engine", "no reason given")


def _explain_open_failure(device_name: str, path: bytes, reason: str) -> DriverError:
    where = f"{device_name} ({path.decode(errors='replace')})"
    lower_reason = reason.lower()
    if "no such" in lower_reason or "not found" in lower_reason or "cannot find" in lower_reason:
        return InputLostError("{where}: no longer connected; plug it in again", where=where)
    if "denied" in lower_reason or "not permitted" in lower_reason:
        return DriverError(
            "{where}: {permission} ({said})", where=where, permission=_PERMISSION_HINT, said=reason
        )
    if "busy" in lower_reason or "exclusive" in lower_reason or "being used" in lower_reason:
        return DriverError(
            "{where}: another program uses it; close that program ({said})",
            where=where,
            said=reason,
        )
    return DriverError(
        "{where} cannot be opened ({said}); unplug it and plug it in again; see docs/inputs.md",
        where=where,
        said=reason,
    )
