"""Finds the joysticks and gamepads among the HID devices, and gives them identities."""

import logging
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rotemina.drivers.contract import Clock, DescriptorError, DriverError, InputLostError
from rotemina.drivers.inputs.device import InputIdentity, InputSource
from rotemina.drivers.inputs.hid_library import (
    HidLibrary,
    load_hidapi,
    open_handle,
    read_descriptor,
)
from rotemina.sim.messages import marked, message

if TYPE_CHECKING:
    from rotemina.drivers.inputs.hid_device import HidDevice

_LOG = logging.getLogger(__name__)
_HIDRAW_FOLDER = Path("/sys/class/hidraw")


def find_port(path: bytes, kernel: Path = _HIDRAW_FOLDER) -> str:
    """Return a permanent name of the port to which a device is connected.

    On Linux this is the kernel's name of bus, port and interface, because a path like
    ``/dev/hidraw3`` may belong to another device next time. On other systems it is the path.
    """
    name = Path(path.decode(errors="replace")).name
    try:
        lines = (kernel / name / "device" / "uevent").read_text("utf-8", "replace").splitlines()
    except (OSError, ValueError):
        lines = []
    properties = dict(line.partition("=")[::2] for line in lines)
    return properties.get("HID_PHYS") or path.decode(errors="replace")


@dataclass(frozen=True, slots=True)
class _PluggedDevice:
    path: bytes
    name: str
    model: str
    serial: str
    port: str

    @classmethod
    def of(cls, entry: Mapping[str, Any], find_port_of: Callable[[bytes], str]) -> "_PluggedDevice":
        """Create a device from an entry of hidapi's list."""
        path = bytes(entry["path"])
        model = f"{int(entry['vendor_id']):04x}:{int(entry['product_id']):04x}"
        manufacturer = str(entry.get("manufacturer_string") or "").strip()
        product = str(entry.get("product_string") or "").strip()
        name = product if product.startswith(manufacturer) else f"{manufacturer} {product}".strip()
        serial = str(entry.get("serial_number") or "").strip()
        return cls(
            path,
            name or f"HID device {model}",
            model,
            serial,
            find_port_of(path),
        )

    @property
    def possible_keys(self) -> tuple[str, ...]:
        """The possible keys of the device, best first."""
        port_key = f"hid:{self.model}:@{self.port}"
        keys = (f"hid:{self.model}:{self.serial}", port_key) if self.serial else (port_key,)
        # On some systems each collection of a device has its own path, so the path is needed too.
        return tuple(
            map(_to_printable_ascii, (*keys, f"{port_key}@{self.path.decode(errors='replace')}"))
        )


class HidSource(InputSource):
    """Finds and opens joysticks, gamepads and multi-axis controllers.

    The key of a device contains its serial number. If the device has no serial number, or shares it
    with another device, the key contains the port instead.

    Parameters
    ----------
    clock : callable
        Returns the host's time, s.
    load : callable
        Returns the module of the hidapi library, or raises :class:`DriverError`.
    port : callable
        Returns the port of a path; see :func:`find_port`.
    """

    name = marked("engine", "USB and Bluetooth joysticks")

    def __init__(
        self,
        *,
        clock: Clock = time.monotonic,
        load: Callable[[], HidLibrary] = load_hidapi,
        port: Callable[[bytes], str] = find_port,
    ) -> None:
        super().__init__(clock=clock)
        self._load_library = load
        self._find_port = port
        self._problem: str | None = None
        self._plugged_devices: dict[str, _PluggedDevice] = {}

    @property
    def problem(self) -> str | None:
        """Why no joystick can be found, as of the latest call of :meth:`devices`."""
        return self._problem

    def devices(self) -> Sequence[InputIdentity]:
        """Return the joysticks that are plugged in; see :class:`InputSource`."""
        problem = None
        entries: Sequence[Mapping[str, Any]] = ()
        try:
            entries = self._load_library().enumerate()
        except (DriverError, OSError, RuntimeError) as error:
            problem = str(error) or type(error).__name__
        if entries and not any(entry.get("usage_page") for entry in entries):
            problem = message(
                "engine",
                "hidapi finds {count} HID devices but does not report which are joysticks, because "
                "it was built with libusb. Install a version that uses hidraw (`pip install "
                "hidapi`)",
            ).fill(count=len(entries))
        if problem != self._problem and problem is not None:
            _LOG.warning("no USB joysticks: %s", problem)
        self._problem = problem
        self._plugged_devices = self._find_joysticks(entries)
        return tuple(
            InputIdentity(key, device.name, "hid") for key, device in self._plugged_devices.items()
        )

    def open(self, identity: InputIdentity) -> "HidDevice":
        """Open a joystick; see :class:`InputSource`."""
        from rotemina.drivers.inputs.hid_decoder import HidDecoder
        from rotemina.drivers.inputs.hid_device import HidDevice

        device = self._plugged_devices.get(identity.key)
        if device is None:
            raise InputLostError(
                "{name} ({key}) is not plugged in", name=identity.name, key=identity.key
            )
        handle = open_handle(self._load_library(), device.path, identity.name)
        try:
            decoder = HidDecoder(read_descriptor(handle, identity.name))
        except DescriptorError as error:
            handle.close()
            raise DescriptorError(
                "{name}: {error}; it cannot be used", name=identity.name, error=str(error)
            ) from error
        except DriverError:
            handle.close()
            raise
        return HidDevice(identity, handle, decoder, self.clock)

    def _find_joysticks(self, entries: Sequence[Mapping[str, Any]]) -> dict[str, _PluggedDevice]:
        if not entries:
            return {}
        # Imported here and in open, because hid-parser takes 0.2 s to load, and many users have no
        # joystick.
        from rotemina.drivers.inputs.hid_usages import JOYSTICK_APPLICATIONS

        joysticks_by_path = {}
        for entry in entries:
            usage = int(entry.get("usage_page") or 0) << 16 | int(entry.get("usage") or 0)
            if usage in JOYSTICK_APPLICATIONS:
                device = _PluggedDevice.of(entry, self._find_port)
                joysticks_by_path[device.path] = device
        # A device keeps its key when another one with the same serial number is plugged in.
        by_key = {
            key: device
            for key, device in self._plugged_devices.items()
            if joysticks_by_path.get(device.path) == device
        }
        for device in sorted(
            joysticks_by_path.values(), key=lambda device: (device.port, device.path)
        ):
            if device not in by_key.values():
                key = next((key for key in device.possible_keys if key not in by_key), None)
                if key is not None:
                    by_key[key] = device
        return by_key


def _to_printable_ascii(key: str) -> str:
    return "".join(char if char.isascii() and char.isprintable() else "_" for char in key)
