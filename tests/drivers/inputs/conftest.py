"""Fixtures for tests of input devices: real report descriptors, and a fake hidapi."""

from collections import deque

import pytest

from rotemina.drivers.inputs import HidSource


def parse_hex(text):
    """Return the bytes of a hex text; ``#`` starts a comment."""
    return bytes.fromhex("".join(line.partition("#")[0] for line in text.splitlines()))


DESCRIPTORS = {
    # Two 10-bit axes, a hat, a twist, a throttle, and twelve buttons, without a report number.
    "joystick": parse_hex("""
        05 01 09 04 A1 01 A1 02
        75 0A 95 02 15 00 26 FF 03 35 00 46 FF 03 09 30 09 31 81 02
        75 04 95 01 25 07 46 3B 01 66 14 00 09 39 81 42  # hat with a null state, in degrees
        66 00 00 75 08 95 01 26 FF 00 46 FF 00 09 35 81 02
        05 09 19 01 29 08 95 08 75 01 25 01 45 01 81 02
        05 01 75 08 95 01 26 FF 00 46 FF 00 09 36 81 02
        05 09 19 09 29 0C 95 04 75 01 25 01 45 01 81 02 75 04 95 01 81 01
        C0 A1 02 06 00 FF 09 01 15 00 26 FF 00 75 08 95 07 B1 02 C0 C0
    """),
    # Numbered reports, 14 buttons, vendor-defined bits in the middle and 54 such bytes at the end.
    "gamepad": parse_hex("""
        05 01 09 05 A1 01 85 01
        09 30 09 31 09 32 09 35 15 00 26 FF 00 75 08 95 04 81 02
        09 39 15 00 25 07 35 00 46 3B 01 65 14 75 04 95 01 81 42 65 00
        05 09 19 01 29 0E 15 00 25 01 75 01 95 0E 81 02
        06 00 FF 09 20 75 06 95 01 15 00 25 7F 81 02
        05 01 09 33 09 34 15 00 26 FF 00 75 08 95 02 81 02
        06 00 FF 09 21 95 36 81 02
        85 05 09 22 95 1F 91 02 85 04 09 23 95 24 B1 02 C0
    """),
    # 16-bit sticks, 10-bit triggers on the simulation page, hat from 1 to 8, force feedback.
    "triggers": parse_hex("""
        05 01 09 05 A1 01 85 01
        09 01 A1 00 09 30 09 31 15 00 27 FF FF 00 00 95 02 75 10 81 02 C0
        09 01 A1 00 09 32 09 35 15 00 27 FF FF 00 00 95 02 75 10 81 02 C0
        05 02 09 C5 15 00 26 FF 03 95 01 75 0A 81 02 15 00 25 00 75 06 95 01 81 03
        05 02 09 C4 15 00 26 FF 03 95 01 75 0A 81 02 15 00 25 00 75 06 95 01 81 03
        05 01 09 39 15 01 25 08 35 00 46 3B 01 66 14 00 75 04 95 01 81 42
        75 04 95 01 15 00 25 00 35 00 45 00 65 00 81 03
        05 09 19 01 29 0F 15 00 25 01 75 01 95 0F 81 02 15 00 25 00 75 01 95 01 81 03
        05 0C 0A 24 02 15 00 25 01 95 01 75 01 81 02 15 00 25 00 75 07 95 01 81 03
        05 0F 09 21 85 03 A1 02 09 97 15 00 25 01 75 04 95 01 91 02 15 00 25 00 91 03
        09 70 15 00 25 64 75 08 95 04 91 02 C0 C0
    """),
    # Six axes from -350 to 350 that are declared relative, in two reports. Buttons in a third.
    "six axes": parse_hex("""
        05 01 09 08 A1 01
        A1 00 85 01 16 A2 FE 26 5E 01 36 88 FA 46 78 05 55 0C 65 11
        09 30 09 31 09 32 75 10 95 03 81 06 C0
        A1 00 85 02 09 33 09 34 09 35 75 10 95 03 81 06 C0
        A1 02 85 03 05 01 05 09 19 01 29 02 15 00 25 01 35 00 45 01 75 01 95 02 81 02
        95 0E 81 03 C0
        A1 02 85 04 05 08 09 4B 15 00 25 01 95 01 75 01 91 02 95 01 75 07 91 03 C0 C0
    """),
    # A list of up to three of ten buttons before the axes, Push and Pop, a maximum of 255 in one
    # byte, a minimum of 0 without a byte, and a keyboard in the same interface.
    "list": parse_hex("""
        05 01 09 06 A1 01 85 02 05 07 19 E0 29 E7 14 25 01 75 01 95 08 81 02 C0
        05 01 09 04 A1 01 85 01
        05 09 19 01 29 0A 15 01 25 0A 75 04 95 03 81 00 95 01 81 01
        05 01 A4 09 30 09 31 15 81 25 7F 75 08 95 02 81 02 B4 09 36 14 25 FF 75 08 95 01 81 02 C0
    """),
}


class PluggedDevice:
    """A device on the bus, whose reports wait until a handle reads them."""

    def __init__(self, path, descriptor, **entry):
        self.path, self.descriptor = path, descriptor
        self.entry = {
            "path": path,
            "vendor_id": 0x046D,
            "product_id": 0xC215,
            "serial_number": "0001",
            "manufacturer_string": "Maker",
            "product_string": "Stick",
            "usage_page": 0x01,
            "usage": 0x04,
            "interface_number": 0,
            **entry,
        }
        self.waiting = deque()
        self.refusal = None


class FakeHidapi:
    """A fake of the hidapi module, with the error texts of the real one."""

    def __init__(self):
        self.bus = {}
        self.open_handles = []
        self.failure = None

    def plug(self, path, descriptor, **entry):
        self.bus[path] = PluggedDevice(path, descriptor, **entry)
        return self.bus[path]

    def enumerate(self):
        if self.failure is not None:
            raise self.failure
        keyboard = {"path": b"/dev/hidraw9", "usage_page": 1, "usage": 6}
        return [keyboard, *(device.entry for device in self.bus.values())]

    def device(self):
        return FakeHandle(self)


class FakeHandle:
    def __init__(self, library):
        self.library, self.device, self.error_text, self.is_blocking = (
            library,
            None,
            "Success",
            True,
        )

    def open_path(self, path):
        device = self.library.bus.get(path)
        reason = "No such file or directory" if device is None else device.refusal
        if reason is not None:
            self.error_text = f"Failed to open a device with path '{path.decode()}': {reason}"
            raise OSError("open failed")
        self.device = device
        self.library.open_handles.append(self)

    def set_nonblocking(self, is_nonblocking):
        self.is_blocking = not is_nonblocking
        return 0

    def get_report_descriptor(self, max_length=4096):
        descriptor = self._connected_device().descriptor
        if descriptor is None:
            raise OSError("read error")
        return list(descriptor[:max_length])

    def read(self, max_length):
        waiting = self._connected_device().waiting
        assert not self.is_blocking, "a read would wait for ever"
        return list(waiting.popleft()[:max_length]) if waiting else []

    def error(self):
        return self.error_text

    def close(self):
        if self.device is not None:
            self.library.open_handles.remove(self)
        self.device = None

    def _connected_device(self):
        if self.device is None:
            raise ValueError("not open")
        if self.library.bus.get(self.device.path) is not self.device:
            raise OSError("read error")
        return self.device


@pytest.fixture
def descriptors():
    return DESCRIPTORS


@pytest.fixture
def hidapi():
    return FakeHidapi()


@pytest.fixture
def ports():
    """Return the USB port of each path. A path that is not listed is its own port."""
    return {}


@pytest.fixture
def hid(hidapi, clock, ports):
    return HidSource(
        clock=clock, load=lambda: hidapi, port=lambda path: ports.get(path, path.decode())
    )
