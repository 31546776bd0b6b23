"""Discovery of joysticks and gamepads among the HID devices, and their identities."""

import logging
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError
from rotemina.drivers.inputs.device import InputIdentity, InputLostError, InputSource
from rotemina.drivers.inputs.hid.hidapi import (
    Hidapi,
    load_hidapi,
    open_handle,
    read_descriptor,
)
from rotemina.drivers.inputs.hid.items import DescriptorError
from rotemina.sim.messages import marked, message

if TYPE_CHECKING:
    from rotemina.drivers.inputs.hid.device import HidDevice

_LOG = logging.getLogger(__name__)
_KERNEL = Path("/sys/class/hidraw")


def port_of(path: bytes, kernel: Path = _KERNEL) -> str:
    """Return what stays the same of where a device is plugged in.

    On Linux the kernel's name of the bus, port and interface: a path like ``/dev/hidraw3`` is given
    to whatever comes next. Elsewhere the path itself.
    """
    name = Path(path.decode(errors="replace")).name
    try:
        lines = (kernel / name / "device" / "uevent").read_text("utf-8", "replace").splitlines()
    except (OSError, ValueError):
        lines = []
    said = dict(line.partition("=")[::2] for line in lines)
    return said.get("HID_PHYS") or path.decode(errors="replace")


@dataclass(frozen=True, slots=True)
class _Plugged:
    """A device that is there: its path, what it is called, and what it could be known by."""

    path: bytes
    name: str
    model: str
    serial: str
    port: str

    @classmethod
    def of(cls, entry: Mapping[str, Any], port: Callable[[bytes], str]) -> "_Plugged":
        """Return the needed entries of hidapi's description."""
        path = bytes(entry["path"])
        model = f"{int(entry['vendor_id']):04x}:{int(entry['product_id']):04x}"
        maker = str(entry.get("manufacturer_string") or "").strip()
        product = str(entry.get("product_string") or "").strip()
        name = product if product.startswith(maker) else f"{maker} {product}".strip()
        serial = str(entry.get("serial_number") or "").strip()
        return cls(
            path,
            name or f"HID device {model}",
            model,
            serial,
            port(path),
        )

    @property
    def keys(self) -> tuple[str, ...]:
        """What it could be known by, the best first."""
        by_port = f"hid:{self.model}:@{self.port}"
        keys = (f"hid:{self.model}:{self.serial}", by_port) if self.serial else (by_port,)
        # Two collections of one device are two paths on some systems.
        return tuple(map(_plain, (*keys, f"{by_port}@{self.path.decode(errors='replace')}")))


class HidSource(InputSource):
    """Joysticks, gamepads and multi-axis controllers.

    A device is known by its serial number; without one, or with one that another device has too,
    by the port that it is plugged into.

    Parameters
    ----------
    clock : callable
        The host's time, s.
    load : callable
        Returns the library's module, or raises :class:`DriverError`.
    port : callable
        Where a path is plugged in; see :func:`port_of`.
    """

    name = marked("engine", "USB and Bluetooth joysticks")

    def __init__(
        self,
        *,
        clock: Clock = time.monotonic,
        load: Callable[[], Hidapi] = load_hidapi,
        port: Callable[[bytes], str] = port_of,
    ) -> None:
        super().__init__(clock=clock)
        self._load = load
        self._port = port
        self._problem: str | None = None
        self._plugged: dict[str, _Plugged] = {}

    @property
    def problem(self) -> str | None:
        """Why no joystick can be found, as of the latest :meth:`devices`."""
        return self._problem

    def devices(self) -> Sequence[InputIdentity]:
        """Return the joysticks that are plugged in; see :class:`InputSource`."""
        problem = None
        entries: Sequence[Mapping[str, Any]] = ()
        try:
            entries = self._load().enumerate()
        except (DriverError, OSError, RuntimeError) as error:
            problem = str(error) or type(error).__name__
        if entries and not any(entry.get("usage_page") for entry in entries):
            problem = message(
                "engine",
                "hidapi finds {count} HID devices but does not tell which are joysticks: it was "
                "built on libusb; install one that uses hidraw (`pip install hidapi`)",
            ).fill(count=len(entries))
        if problem != self._problem and problem is not None:
            _LOG.warning("no USB joysticks: %s", problem)
        self._problem = problem
        self._plugged = self._known(entries)
        return tuple(InputIdentity(key, one.name, "hid") for key, one in self._plugged.items())

    def open(self, identity: InputIdentity) -> "HidDevice":
        """Open a joystick; see :class:`InputSource`."""
        from rotemina.drivers.inputs.hid.decoder import Decoder
        from rotemina.drivers.inputs.hid.device import HidDevice

        plugged = self._plugged.get(identity.key)
        if plugged is None:
            raise InputLostError(
                message("engine", "{name} ({key}) is not plugged in").fill(
                    name=identity.name, key=identity.key
                )
            )
        handle = open_handle(self._load(), plugged.path, identity.name)
        try:
            decoder = Decoder(read_descriptor(handle, identity.name))
        except DescriptorError as error:
            handle.close()
            raise DescriptorError(
                message("engine", "{name}: {error}; it cannot be used").fill(
                    name=identity.name, error=str(error)
                )
            ) from error
        except DriverError:
            handle.close()
            raise
        return HidDevice(identity, handle, decoder, self.clock)

    def _known(self, entries: Sequence[Mapping[str, Any]]) -> dict[str, _Plugged]:
        """Return the joysticks among what is plugged in, by key."""
        if not entries:
            return {}
        # Only here, and in open(): hid-parser takes a fifth of a second, and most have no joystick.
        from rotemina.drivers.inputs.hid.usages import APPLICATIONS

        found = {}
        for entry in entries:
            usage = int(entry.get("usage_page") or 0) << 16 | int(entry.get("usage") or 0)
            if usage in APPLICATIONS:
                one = _Plugged.of(entry, self._port)
                found[one.path] = one
        # One that was there keeps its key when another of the same number comes.
        known = {key: one for key, one in self._plugged.items() if found.get(one.path) == one}
        for one in sorted(found.values(), key=lambda one: (one.port, one.path)):
            if one not in known.values():
                key = next((key for key in one.keys if key not in known), None)
                if key is not None:
                    known[key] = one
        return known


def _plain(key: str) -> str:
    """Return a key of signs that may stand in any file."""
    return "".join(sign if sign.isascii() and sign.isprintable() else "_" for sign in key)
