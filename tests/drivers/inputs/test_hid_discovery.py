"""Joysticks are found and opened, have stable keys, and report problems to the operator."""

import importlib
import logging
from math import isnan

import pytest

from rotemina.drivers.contract import DescriptorError, DriverError, InputLostError
from rotemina.drivers.inputs import HidSource, hid_library as hidapi_module
from rotemina.drivers.inputs.hid_discovery import find_port

STICK_PATH = b"/dev/hidraw0"


def find_keys(source):
    return {identity.key for identity in source.devices()}


def test_only_devices_that_can_steer_are_listed(hid, hidapi, descriptors):
    hidapi.plug(STICK_PATH, descriptors["joystick"])
    hidapi.plug(b"/dev/hidraw1", descriptors["gamepad"], usage=0x05, serial_number="b")
    hidapi.plug(b"/dev/hidraw2", descriptors["six axes"], usage=0x08, serial_number="c")
    hidapi.plug(b"/dev/hidraw3", b"", usage=0x02, serial_number="mouse")
    hidapi.plug(b"/dev/hidraw4", b"", usage_page=0x0C, usage=0x05, serial_number="keys")
    assert find_keys(hid) == {"hid:046d:c215:0001", "hid:046d:c215:b", "hid:046d:c215:c"}


@pytest.mark.parametrize(
    ("maker", "product", "name"),
    [
        ("Logitech", "Extreme 3D", "Logitech Extreme 3D"),
        ("Logitech", "Logitech Extreme 3D", "Logitech Extreme 3D"),
        ("", "", "HID device 046d:c215"),
        (None, "Stick ", "Stick"),
    ],
)
def test_a_name_consists_of_maker_and_product(hid, hidapi, maker, product, name):
    hidapi.plug(STICK_PATH, b"", manufacturer_string=maker, product_string=product)
    assert hid.devices()[0].name == name


def test_devices_without_a_serial_number_are_distinguished_by_their_port(hid, hidapi, ports):
    ports.update({b"/dev/hidraw0": "usb-1/input0", b"/dev/hidraw5": "usb-2/input0"})
    hidapi.plug(b"/dev/hidraw0", b"", serial_number="")
    hidapi.plug(b"/dev/hidraw5", b"", serial_number=None)
    left_key, right_key = "hid:046d:c215:@usb-1/input0", "hid:046d:c215:@usb-2/input0"
    assert find_keys(hid) == {left_key, right_key}
    del hidapi.bus[b"/dev/hidraw0"]
    assert find_keys(hid) == {right_key}
    # The first device is back in its port, with another path.
    ports[b"/dev/hidraw7"] = "usb-1/input0"
    hidapi.plug(b"/dev/hidraw7", b"", serial_number="")
    assert find_keys(hid) == {left_key, right_key}


def test_the_first_of_two_devices_with_one_serial_number_keeps_its_key(hid, hidapi, ports):
    ports.update({b"/dev/hidraw0": "usb-9", b"/dev/hidraw1": "usb-1"})
    hidapi.plug(b"/dev/hidraw0", b"")
    assert find_keys(hid) == {"hid:046d:c215:0001"}
    hidapi.plug(b"/dev/hidraw1", b"")
    by_key = {identity.key: identity for identity in hid.devices()}
    assert set(by_key) == {"hid:046d:c215:0001", "hid:046d:c215:@usb-1"}
    del hidapi.bus[b"/dev/hidraw0"]
    # The remaining device must not take the key of the one that was unplugged.
    assert find_keys(hid) == {"hid:046d:c215:@usb-1"}


def test_collections_with_different_paths_are_different_devices(hid, hidapi, ports):
    ports.update({b"a": "usb-1", b"b": "usb-1", b"c": "usb-1"})
    for path in ports:
        hidapi.plug(path, b"")
    assert len(find_keys(hid)) == 3


def test_a_key_has_only_characters_that_any_file_can_contain(hid, hidapi):
    hidapi.plug(STICK_PATH, b"", serial_number="ü\n1")
    assert find_keys(hid) == {"hid:046d:c215:__1"}


def test_the_port_has_the_name_that_the_kernel_gives_it(tmp_path):
    (tmp_path / "hidraw3" / "device").mkdir(parents=True)
    uevent = tmp_path / "hidraw3" / "device" / "uevent"
    uevent.write_text("DRIVER=hid-generic\nHID_PHYS=usb-0000:00:14.0-2/input0\nHID_UNIQ=\n")
    assert find_port(b"/dev/hidraw3", tmp_path) == "usb-0000:00:14.0-2/input0"
    assert find_port(b"/dev/hidraw4", tmp_path) == "/dev/hidraw4"
    assert find_port(b"", tmp_path) == ""


def test_all_waiting_reports_are_read_up_to_a_limit(hid, hidapi, descriptors):
    stick = hidapi.plug(STICK_PATH, descriptors["joystick"])
    device = hid.open(hid.devices()[0])
    stick.waiting.extend(bytes([number, 0, 0, 0, 0, 0, 0]) for number in range(60))
    assert len(device.read()) == 60
    stick.waiting.extend(bytes(7) for _ in range(1000))
    assert 60 < len(device.read()) < 1000


def test_reports_that_contradict_the_descriptor_are_counted(hid, hidapi, descriptors, caplog):
    stick = hidapi.plug(STICK_PATH, descriptors["six axes"])
    device = hid.open(hid.devices()[0])
    stick.waiting.extend([bytes([9, 1, 2]), bytes([1, 0, 0]), bytes([1, *[0] * 6, 7])])
    readings = device.read()
    assert [reading.axes[0] for reading in readings][1:] == [0.0, 0.0]
    assert isnan(readings[0].axes[0])
    assert "type 9" in readings[0].fault
    with caplog.at_level(logging.INFO):
        device.close()
    assert "IgnoredCounts(unknown=0, undeclared=1, short=1, long=1, beyond=0)" in caplog.text


@pytest.mark.parametrize(
    ("reason", "error", "advice"),
    [
        ("Permission denied", DriverError, r"/etc/udev/rules\.d"),
        ("Device or resource busy", DriverError, "another program uses it"),
        ("No such file or directory", InputLostError, "plug it in again"),
        ("Input/output error", DriverError, "Input/output error"),
    ],
)
def test_a_device_that_does_not_open_gives_advice(hid, hidapi, reason, error, advice):
    hidapi.plug(STICK_PATH, b"").refusal = reason
    with pytest.raises(error, match=advice) as raised:
        hid.open(hid.devices()[0])
    assert "Maker Stick (/dev/hidraw0)" in str(raised.value)
    assert type(raised.value) is error


@pytest.mark.parametrize(
    ("descriptor", "reason"),
    [(None, "cannot be read"), (b"\x05", "truncated"), (b"", "no axis and no button")],
)
def test_a_device_with_a_bad_descriptor_is_refused_and_closed(hid, hidapi, descriptor, reason):
    hidapi.plug(STICK_PATH, descriptor)
    with pytest.raises(DriverError, match=f"Maker Stick: .*{reason}") as raised:
        hid.open(hid.devices()[0])
    assert isinstance(raised.value, DescriptorError) is (descriptor is not None)
    assert hidapi.open_handles == []


def test_a_device_that_cannot_be_read_without_blocking_is_closed(
    hid, hidapi, descriptors, monkeypatch
):
    def raise_not_open(handle, is_nonblocking):
        raise ValueError("not open")

    hidapi.plug(STICK_PATH, descriptors["joystick"])
    monkeypatch.setattr(type(hidapi.device()), "set_nonblocking", raise_not_open)
    with pytest.raises(DriverError, match="cannot be opened"):
        hid.open(hid.devices()[0])
    assert hidapi.open_handles == []


def test_an_unplugged_device_is_closed_without_an_error(hid, hidapi, descriptors):
    hidapi.plug(STICK_PATH, descriptors["joystick"])
    device = hid.open(hid.devices()[0])
    hidapi.bus.clear()
    with pytest.raises(InputLostError, match="Maker Stick was unplugged"):
        device.read()
    device.close()
    assert hidapi.open_handles == []


def test_without_the_library_no_device_is_found_and_the_problem_is_named(monkeypatch, caplog):
    def raise_import_error(name):
        raise ImportError(f"libudev.so.1, wanted by {name}")

    monkeypatch.setattr(
        hidapi_module, "importlib", type("without", (), {"import_module": raise_import_error})
    )
    source = HidSource()
    for _ in range(3):
        assert source.devices() == ()
    assert "libudev.so.1" in source.problem
    assert "pip install hidapi" in source.problem
    # The problem is logged once, not at each search.
    assert len(caplog.records) == 1


def test_linux_prefers_the_hidraw_interface(monkeypatch):
    imported_names = []

    def import_only_hid(name):
        imported_names.append(name)
        if name == "hidraw":
            raise ImportError(name)
        return importlib

    monkeypatch.setattr(
        hidapi_module, "importlib", type("some", (), {"import_module": import_only_hid})
    )
    monkeypatch.setattr(hidapi_module.sys, "platform", "linux")
    assert hidapi_module.load_hidapi() is importlib
    monkeypatch.setattr(hidapi_module.sys, "platform", "win32")
    assert hidapi_module.load_hidapi() is importlib
    assert imported_names == ["hidraw", "hid", "hid"]


def test_the_installed_library_has_the_functions_that_are_used():
    library = hidapi_module.load_hidapi()
    assert HidSource(load=lambda: library).problem is None
    handle = library.device()
    for name in ("open_path", "set_nonblocking", "get_report_descriptor", "read", "close"):
        assert callable(getattr(handle, name))
    with pytest.raises(InputLostError, match="no longer connected"):
        hidapi_module.open_handle(library, b"/dev/none-of-this-name", "stick")


def test_a_failing_library_finds_nothing_until_it_recovers(hid, hidapi):
    hidapi.plug(STICK_PATH, b"")
    hidapi.failure = OSError("udev is not there")
    assert hid.devices() == ()
    assert "udev is not there" in hid.problem
    hidapi.failure = None
    assert len(hid.devices()) == 1
    assert hid.problem is None


def test_a_library_without_usages_is_reported(hid, hidapi, monkeypatch):
    monkeypatch.setattr(hidapi, "enumerate", lambda: [{"path": STICK_PATH, "usage_page": 0}])
    assert hid.devices() == ()
    assert "libusb" in hid.problem
