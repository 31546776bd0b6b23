"""Finding and opening joysticks: what they are known by, and what an operator is told."""

import importlib
import logging
from math import isnan

import pytest

from rotemina.drivers.errors import DriverError
from rotemina.drivers.inputs.device import InputLostError
from rotemina.drivers.inputs.hid import hidapi as border
from rotemina.drivers.inputs.hid.hid_discovery import HidSource, port_of
from rotemina.drivers.inputs.hid.items import DescriptorError

STICK = b"/dev/hidraw0"


def keys(source):
    return {identity.key for identity in source.devices()}


def test_only_what_can_steer_is_listed(hid, hidapi, descriptors):
    hidapi.plug(STICK, descriptors["joystick"])
    hidapi.plug(b"/dev/hidraw1", descriptors["gamepad"], usage=0x05, serial_number="b")
    hidapi.plug(b"/dev/hidraw2", descriptors["six axes"], usage=0x08, serial_number="c")
    hidapi.plug(b"/dev/hidraw3", b"", usage=0x02, serial_number="mouse")
    hidapi.plug(b"/dev/hidraw4", b"", usage_page=0x0C, usage=0x05, serial_number="keys")
    assert keys(hid) == {"hid:046d:c215:0001", "hid:046d:c215:b", "hid:046d:c215:c"}


@pytest.mark.parametrize(
    ("maker", "product", "name"),
    [
        ("Logitech", "Extreme 3D", "Logitech Extreme 3D"),
        ("Logitech", "Logitech Extreme 3D", "Logitech Extreme 3D"),
        ("", "", "HID device 046d:c215"),
        (None, "Stick ", "Stick"),
    ],
)
def test_names_are_what_the_maker_says(hid, hidapi, maker, product, name):
    hidapi.plug(STICK, b"", manufacturer_string=maker, product_string=product)
    assert hid.devices()[0].name == name


def test_without_a_serial_number_the_port_tells_two_apart(hid, hidapi, ports):
    ports.update({b"/dev/hidraw0": "usb-1/input0", b"/dev/hidraw5": "usb-2/input0"})
    hidapi.plug(b"/dev/hidraw0", b"", serial_number="")
    hidapi.plug(b"/dev/hidraw5", b"", serial_number=None)
    left, right = "hid:046d:c215:@usb-1/input0", "hid:046d:c215:@usb-2/input0"
    assert keys(hid) == {left, right}
    del hidapi.bus[b"/dev/hidraw0"]
    assert keys(hid) == {right}
    ports[b"/dev/hidraw7"] = "usb-1/input0"  # back in its port, by another name
    hidapi.plug(b"/dev/hidraw7", b"", serial_number="")
    assert keys(hid) == {left, right}


def test_of_two_with_one_serial_number_the_first_keeps_its_key(hid, hidapi, ports):
    ports.update({b"/dev/hidraw0": "usb-9", b"/dev/hidraw1": "usb-1"})
    hidapi.plug(b"/dev/hidraw0", b"")
    assert keys(hid) == {"hid:046d:c215:0001"}
    hidapi.plug(b"/dev/hidraw1", b"")
    by_key = {identity.key: identity for identity in hid.devices()}
    assert set(by_key) == {"hid:046d:c215:0001", "hid:046d:c215:@usb-1"}
    del hidapi.bus[b"/dev/hidraw0"]
    # The one that is left must not become the one that has gone.
    assert keys(hid) == {"hid:046d:c215:@usb-1"}


def test_two_collections_of_one_device_are_two_where_they_have_two_paths(hid, hidapi, ports):
    ports.update({b"a": "usb-1", b"b": "usb-1", b"c": "usb-1"})
    for path in ports:
        hidapi.plug(path, b"")
    assert len(keys(hid)) == 3


def test_a_key_has_only_signs_that_any_file_can_keep(hid, hidapi):
    hidapi.plug(STICK, b"", serial_number="ü\n1")
    assert keys(hid) == {"hid:046d:c215:__1"}


def test_the_port_is_what_the_kernel_calls_it(tmp_path):
    (tmp_path / "hidraw3" / "device").mkdir(parents=True)
    uevent = tmp_path / "hidraw3" / "device" / "uevent"
    uevent.write_text("DRIVER=hid-generic\nHID_PHYS=usb-0000:00:14.0-2/input0\nHID_UNIQ=\n")
    assert port_of(b"/dev/hidraw3", tmp_path) == "usb-0000:00:14.0-2/input0"
    assert port_of(b"/dev/hidraw4", tmp_path) == "/dev/hidraw4"
    assert port_of(b"", tmp_path) == ""


def test_all_waiting_reports_are_read_but_a_flood_does_not_hold_up(hid, hidapi, descriptors):
    stick = hidapi.plug(STICK, descriptors["joystick"])
    device = hid.open(hid.devices()[0])
    stick.waiting.extend(bytes([number, 0, 0, 0, 0, 0, 0]) for number in range(60))
    assert len(device.read()) == 60
    stick.waiting.extend(bytes(7) for _ in range(1000))
    assert 60 < len(device.read()) < 1000


def test_what_is_not_as_described_is_counted(hid, hidapi, descriptors, caplog):
    stick = hidapi.plug(STICK, descriptors["six axes"])
    device = hid.open(hid.devices()[0])
    stick.waiting.extend([bytes([9, 1, 2]), bytes([1, 0, 0]), bytes([1, *[0] * 6, 7])])
    readings = device.read()
    assert [reading.axes[0] for reading in readings][1:] == [0.0, 0.0]
    assert isnan(readings[0].axes[0])
    assert "type 9" in readings[0].fault
    with caplog.at_level(logging.INFO):
        device.close()
    assert "Ignored(unknown=0, undeclared=1, short=1, long=1, beyond=0)" in caplog.text


@pytest.mark.parametrize(
    ("reason", "error", "advice"),
    [
        ("Permission denied", DriverError, r"/etc/udev/rules\.d"),
        ("Device or resource busy", DriverError, "another program uses it"),
        ("No such file or directory", InputLostError, "plug it in again"),
        ("Input/output error", DriverError, "Input/output error"),
    ],
)
def test_a_device_that_does_not_open_says_what_to_do(hid, hidapi, reason, error, advice):
    hidapi.plug(STICK, b"").refusal = reason
    with pytest.raises(error, match=advice) as caught:
        hid.open(hid.devices()[0])
    assert "Maker Stick (/dev/hidraw0)" in str(caught.value)
    assert type(caught.value) is error


@pytest.mark.parametrize(
    ("descriptor", "reason"),
    [(None, "cannot be read"), (b"\x05", "truncated"), (b"", "no axis and no button")],
)
def test_a_device_with_a_bad_descriptor_is_refused_and_closed(hid, hidapi, descriptor, reason):
    hidapi.plug(STICK, descriptor)
    with pytest.raises(DriverError, match=f"Maker Stick: .*{reason}") as caught:
        hid.open(hid.devices()[0])
    assert isinstance(caught.value, DescriptorError) is (descriptor is not None)
    assert hidapi.opened == []


def test_a_device_that_would_make_reading_wait_is_closed(hid, hidapi, descriptors, monkeypatch):
    def refuse(handle, on):
        raise ValueError("not open")

    hidapi.plug(STICK, descriptors["joystick"])
    monkeypatch.setattr(type(hidapi.device()), "set_nonblocking", refuse)
    with pytest.raises(DriverError, match="cannot be opened"):
        hid.open(hid.devices()[0])
    assert hidapi.opened == []


def test_one_that_was_pulled_out_is_closed_without_a_word(hid, hidapi, descriptors):
    hidapi.plug(STICK, descriptors["joystick"])
    device = hid.open(hid.devices()[0])
    hidapi.bus.clear()
    with pytest.raises(InputLostError, match="Maker Stick was unplugged"):
        device.read()
    device.close()
    assert hidapi.opened == []


def test_without_the_library_nothing_is_found_and_it_says_why(monkeypatch, caplog):
    def missing(name):
        raise ImportError(f"libudev.so.1, wanted by {name}")

    monkeypatch.setattr(border, "importlib", type("without", (), {"import_module": missing}))
    source = HidSource()
    for _ in range(3):
        assert source.devices() == ()
    assert "libudev.so.1" in source.problem
    assert "pip install hidapi" in source.problem
    assert len(caplog.records) == 1  # told once, not every second


def test_on_linux_the_kernels_own_interface_is_preferred(monkeypatch):
    asked = []

    def only_hid(name):
        asked.append(name)
        if name == "hidraw":
            raise ImportError(name)
        return importlib

    monkeypatch.setattr(border, "importlib", type("some", (), {"import_module": only_hid}))
    monkeypatch.setattr(border.sys, "platform", "linux")
    assert border.load_hidapi() is importlib
    monkeypatch.setattr(border.sys, "platform", "win32")
    assert border.load_hidapi() is importlib
    assert asked == ["hidraw", "hid", "hid"]


def test_the_installed_library_can_do_what_is_asked_of_it():
    library = border.load_hidapi()
    assert HidSource(load=lambda: library).problem is None
    handle = library.device()
    for name in ("open_path", "set_nonblocking", "get_report_descriptor", "read", "close"):
        assert callable(getattr(handle, name))
    with pytest.raises(InputLostError, match="no longer connected"):
        border.open_handle(library, b"/dev/none-of-this-name", "stick")


def test_a_library_that_fails_finds_nothing_and_recovers(hid, hidapi):
    hidapi.plug(STICK, b"")
    hidapi.failure = OSError("udev is not there")
    assert hid.devices() == ()
    assert "udev is not there" in hid.problem
    hidapi.failure = None
    assert len(hid.devices()) == 1
    assert hid.problem is None


def test_a_library_that_does_not_tell_usages_is_named(hid, hidapi, monkeypatch):
    monkeypatch.setattr(hidapi, "enumerate", lambda: [{"path": STICK, "usage_page": 0}])
    assert hid.devices() == ()
    assert "libusb" in hid.problem
