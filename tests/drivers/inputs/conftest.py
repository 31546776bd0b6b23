"""What tests of input devices share: descriptors as devices send them, and a fake hidapi."""

from collections import deque

import pytest

from rotemina.drivers.inputs.hid.hid_discovery import HidSource


def described(text):
    """Bytes in hex; what follows a ``#`` in a line is a comment."""
    return bytes.fromhex("".join(line.partition("#")[0] for line in text.splitlines()))


DESCRIPTORS = {
    # Two 10-bit axes, a hat, a twist, a throttle, twelve buttons; no report number.
    "joystick": described("""
        05 01 09 04 A1 01 A1 02
        75 0A 95 02 15 00 26 FF 03 35 00 46 FF 03 09 30 09 31 81 02
        75 04 95 01 25 07 46 3B 01 66 14 00 09 39 81 42  # hat with a null state, in degrees
        66 00 00 75 08 95 01 26 FF 00 46 FF 00 09 35 81 02
        05 09 19 01 29 08 95 08 75 01 25 01 45 01 81 02
        05 01 75 08 95 01 26 FF 00 46 FF 00 09 36 81 02
        05 09 19 09 29 0C 95 04 75 01 25 01 45 01 81 02 75 04 95 01 81 01
        C0 A1 02 06 00 FF 09 01 15 00 26 FF 00 75 08 95 07 B1 02 C0 C0
    """),
    # Numbered, 14 buttons, vendor's bits in the middle and 54 bytes of them at the end.
    "gamepad": described("""
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
    "triggers": described("""
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
    # Six axes of -350 to 350 that call themselves relative, in two reports; buttons in a third.
    "six axes": described("""
        05 01 09 08 A1 01
        A1 00 85 01 16 A2 FE 26 5E 01 36 88 FA 46 78 05 55 0C 65 11
        09 30 09 31 09 32 75 10 95 03 81 06 C0
        A1 00 85 02 09 33 09 34 09 35 75 10 95 03 81 06 C0
        A1 02 85 03 05 01 05 09 19 01 29 02 15 00 25 01 35 00 45 01 75 01 95 02 81 02
        95 0E 81 03 C0
        A1 02 85 04 05 08 09 4B 15 00 25 01 95 01 75 01 91 02 95 01 75 07 91 03 C0 C0
    """),
    # A list of up to three buttons of ten, before the axes; Push and Pop; a maximum of 255 in one
    # byte; a minimum of 0 in no byte at all; a keyboard in the same interface.
    "list": described("""
        05 01 09 06 A1 01 85 02 05 07 19 E0 29 E7 14 25 01 75 01 95 08 81 02 C0
        05 01 09 04 A1 01 85 01
        05 09 19 01 29 0A 15 01 25 0A 75 04 95 03 81 00 95 01 81 01
        05 01 A4 09 30 09 31 15 81 25 7F 75 08 95 02 81 02 B4 09 36 14 25 FF 75 08 95 01 81 02 C0
    """),
}


class Plugged:
    """A device at the bus: what it sends waits until a handle reads it."""

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
    """The library's module, of bytes alone; errors are worded as the real one's."""

    def __init__(self):
        self.bus = {}
        self.opened = []
        self.failure = None

    def plug(self, path, descriptor, **entry):
        self.bus[path] = Plugged(path, descriptor, **entry)
        return self.bus[path]

    def enumerate(self):
        if self.failure is not None:
            raise self.failure
        keyboard = {"path": b"/dev/hidraw9", "usage_page": 1, "usage": 6}
        return [keyboard, *(one.entry for one in self.bus.values())]

    def device(self):
        return FakeHandle(self)


class FakeHandle:
    def __init__(self, library):
        self.library, self.device, self.said, self.waits = library, None, "Success", True

    def open_path(self, path):
        device = self.library.bus.get(path)
        reason = "No such file or directory" if device is None else device.refusal
        if reason is not None:
            self.said = f"Failed to open a device with path '{path.decode()}': {reason}"
            raise OSError("open failed")
        self.device = device
        self.library.opened.append(self)

    def set_nonblocking(self, on):
        self.waits = not on
        return 0

    def get_report_descriptor(self, max_length=4096):
        descriptor = self._there().descriptor
        if descriptor is None:
            raise OSError("read error")
        return list(descriptor[:max_length])

    def read(self, max_length):
        waiting = self._there().waiting
        assert not self.waits, "a read would wait for ever"
        return list(waiting.popleft()[:max_length]) if waiting else []

    def error(self):
        return self.said

    def close(self):
        if self.device is not None:
            self.library.opened.remove(self)
        self.device = None

    def _there(self):
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
    """Where paths are plugged in; a path that is not among them is its own port."""
    return {}


@pytest.fixture
def hid(hidapi, clock, ports):
    return HidSource(
        clock=clock, load=lambda: hidapi, port=lambda path: ports.get(path, path.decode())
    )
