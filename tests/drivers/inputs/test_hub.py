"""The hub reports added and removed devices, and a bad source does not affect the others."""

import logging
from importlib.metadata import EntryPoint

import pytest

from rotemina.drivers.contract import DriverError, InputLostError, registry
from rotemina.drivers.inputs import (
    HidSource,
    InputChanges,
    InputHub,
    InputIdentity,
    InputPad,
    InputSource,
    hub as hub_module,
)


@pytest.fixture
def pad(clock):
    return InputPad("pad", clock=clock)


@pytest.fixture
def hub(hid, pad):
    return InputHub({"hid": hid, "keys": pad})


class BrokenSource(InputSource):
    def devices(self):
        raise ZeroDivisionError("driver of the year 1999")

    def open(self, identity):
        raise AssertionError("it has nothing to open")


class WrongDevicesSource(InputSource):
    def __init__(self, listed_devices):
        super().__init__()
        self.listed_devices = listed_devices

    def devices(self):
        return self.listed_devices

    def open(self, identity):
        raise KeyError("handle")


def test_added_and_removed_devices_are_reported(hub, hidapi, pad, descriptors):
    assert hub.devices == ()
    assert hub.poll() == InputChanges(added=(pad.identity,))
    hidapi.plug(b"/dev/hidraw0", descriptors["joystick"])
    (stick,) = hub.poll().added
    assert stick.key == "hid:046d:c215:0001"
    assert hub.poll() == InputChanges()
    assert set(hub.devices) == {stick, pad.identity}
    pad.unplug()
    hidapi.bus.clear()
    assert set(hub.poll().removed) == {stick, pad.identity}
    assert hub.devices == ()


def test_a_device_is_opened_by_its_key(hub, pad):
    hub.poll()
    assert hub.open("keys:pad").identity == pad.identity
    with pytest.raises(InputLostError, match="'hid:1' is not plugged in; available: keys:pad"):
        hub.open("hid:1")


def test_a_device_unplugged_between_two_polls_is_reported_again(hub, pad):
    hub.poll()
    device = hub.open("keys:pad")
    pad.unplug()
    pad.plug_in()
    with pytest.raises(InputLostError):
        device.read()
    hub.note_loss("keys:pad")
    assert hub.poll() == InputChanges(added=(pad.identity,))
    assert hub.poll() == InputChanges()
    hub.open("keys:pad")
    hub.note_loss("keys:pad")
    pad.unplug()
    assert hub.poll() == InputChanges(removed=(pad.identity,))


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        (BrokenSource(), "ZeroDivisionError: driver of the year 1999"),
        (WrongDevicesSource(["stick"]), "'stick' is no InputIdentity"),
        (WrongDevicesSource(None), "TypeError"),
        (
            WrongDevicesSource([InputIdentity("keys:pad", "thief", "liar")]),
            "another source already has",
        ),
    ],
)
def test_a_bad_source_is_reported_and_skipped(pad, source, reason, caplog):
    hub = InputHub({"keys": pad, "liar": source})
    with caplog.at_level(logging.WARNING):
        for _ in range(3):
            hub.poll()
    assert hub.devices == (pad.identity,)
    assert reason in hub.problems["liar"]
    # The problem is logged once, not at each poll.
    assert len(caplog.records) == 1


def test_the_problem_of_a_source_ends_when_it_recovers(hub, hidapi, monkeypatch):
    hidapi.failure = RuntimeError("no udev")
    hub.poll()
    assert "no udev" in hub.problems["hid"]
    hidapi.failure = None
    hub.poll()
    assert hub.problems == {}


def test_a_device_that_does_not_open_is_a_problem_until_it_opens(hub, hidapi, descriptors):
    stick = hidapi.plug(b"/dev/hidraw0", descriptors["joystick"])
    stick.refusal = "Permission denied"
    hub.poll()
    (key,) = (identity.key for identity in hub.devices if identity.source == "hid")
    with pytest.raises(DriverError, match="udev"):
        hub.open(key)
    assert "udev" in hub.problems[key]
    stick.refusal = None
    hub.open(key)
    assert hub.problems == {}
    stick.refusal = "Permission denied"
    with pytest.raises(DriverError):
        hub.open(key)
    hidapi.bus.clear()
    hub.poll()
    assert hub.problems == {}


def test_a_device_that_does_not_open_is_reported_four_times(hub, hidapi, descriptors):
    stick = hidapi.plug(b"/dev/hidraw0", descriptors["joystick"])
    stick.refusal = "Permission denied"
    report_count = 0
    for _ in range(10):
        for identity in hub.poll().added:
            if identity.source == "hid":
                report_count += 1
                with pytest.raises(DriverError):
                    hub.open(identity.key)
    assert report_count == 4
    hidapi.bus.clear()
    hub.poll()
    hidapi.plug(b"/dev/hidraw0", descriptors["joystick"]).refusal = "Permission denied"
    (identity,) = hub.poll().added
    with pytest.raises(DriverError):
        hub.open(identity.key)
    hidapi.bus[b"/dev/hidraw0"].refusal = None  # the system now permits it
    assert hub.poll().added == (identity,)
    hub.open(identity.key)
    assert hub.poll() == InputChanges()


def test_exceptions_of_a_plugin_become_driver_errors(pad):
    hub = InputHub({"liar": WrongDevicesSource([InputIdentity("liar:1", "thing", "liar")])})
    hub.poll()
    with pytest.raises(DriverError, match=r"thing \(liar:1\) cannot be opened: KeyError"):
        hub.open("liar:1")
    assert "KeyError" in hub.problems["liar:1"]


class SourceWithoutLicence(InputSource):
    def __init__(self, *, clock):
        raise OSError("licence")

    def devices(self):
        return ()

    def open(self, identity):
        raise AssertionError("it was never made")


HID_ENTRY_POINT = "rotemina.drivers.inputs.hid_discovery:HidSource"


def test_installed_sources_get_the_clock(install_plugins, pad, clock):
    install_plugins(hid=HID_ENTRY_POINT, gone="no.such.module:Source", keys=HID_ENTRY_POINT)
    hub = InputHub.from_plugins({"keys": pad}, clock=clock)
    assert "ModuleNotFoundError" in hub.problems["gone"]
    assert "the program has a source of this name" in hub.problems["keys"]
    assert hub._sources["hid"].clock is clock
    assert isinstance(hub._sources["hid"], HidSource)


def test_a_source_that_cannot_be_created_is_reported(install_plugins, monkeypatch):
    install_plugins(bad=HID_ENTRY_POINT)
    monkeypatch.setattr(EntryPoint, "load", lambda self: SourceWithoutLicence)
    assert "it cannot be created: OSError: licence" in InputHub.from_plugins().problems["bad"]


def test_the_built_in_source_is_installed_like_a_plugin():
    plugins = registry.discover_plugins(hub_module.INPUT_GROUP, InputSource).plugins
    assert plugins["hid"] is HidSource
