"""The hub tells what came and went, and no bad source or device keeps it from the others."""

import logging
from importlib.metadata import EntryPoint

import pytest

from rotemina.drivers import registry
from rotemina.drivers.errors import DriverError
from rotemina.drivers.inputs import hub as hub_module
from rotemina.drivers.inputs.device import InputIdentity, InputLostError, InputSource
from rotemina.drivers.inputs.hid.hid_discovery import HidSource
from rotemina.drivers.inputs.hub import Changes, InputHub
from rotemina.drivers.inputs.pad import Pad


@pytest.fixture
def pad(clock):
    return Pad("pad", clock=clock)


@pytest.fixture
def hub(hid, pad):
    return InputHub({"hid": hid, "keys": pad})


class Bad(InputSource):
    def devices(self):
        raise ZeroDivisionError("driver of the year 1999")

    def open(self, identity):
        raise AssertionError("it has nothing to open")


class Liar(InputSource):
    def __init__(self, found):
        super().__init__()
        self.found = found

    def devices(self):
        return self.found

    def open(self, identity):
        raise KeyError("handle")


def test_it_tells_what_came_and_what_went(hub, hidapi, pad, descriptors):
    assert hub.devices == ()
    assert hub.poll() == Changes(arrived=(pad.identity,))
    hidapi.plug(b"/dev/hidraw0", descriptors["joystick"])
    (stick,) = hub.poll().arrived
    assert stick.key == "hid:046d:c215:0001"
    assert hub.poll() == Changes()
    assert set(hub.devices) == {stick, pad.identity}
    pad.withdraw()
    hidapi.bus.clear()
    assert set(hub.poll().left) == {stick, pad.identity}
    assert hub.devices == ()


def test_a_device_is_opened_by_its_key(hub, pad):
    hub.poll()
    assert hub.open("keys:pad").identity == pad.identity
    with pytest.raises(InputLostError, match="'hid:1' is not plugged in; available: keys:pad"):
        hub.open("hid:1")


def test_one_that_was_open_returns(hub, pad):
    hub.poll()
    hub.open("keys:pad")
    pad.withdraw()
    assert hub.poll() == Changes(left=(pad.identity,))
    pad.offer()
    assert hub.poll() == Changes(arrived=(pad.identity,))
    assert hub.poll() == Changes()


def test_one_that_was_away_between_two_polls_returns(hub, pad):
    hub.poll()
    device = hub.open("keys:pad")
    pad.withdraw()
    pad.offer()
    with pytest.raises(InputLostError):
        device.read()
    hub.lost("keys:pad")
    assert hub.poll() == Changes(arrived=(pad.identity,))
    assert hub.poll() == Changes()
    hub.open("keys:pad")
    hub.lost("keys:pad")
    pad.withdraw()
    assert hub.poll() == Changes(left=(pad.identity,))


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        (Bad(), "ZeroDivisionError: driver of the year 1999"),
        (Liar(["stick"]), "'stick' is no InputIdentity"),
        (Liar(None), "TypeError"),
        (Liar([InputIdentity("keys:pad", "thief", "liar")]), "another source already has"),
    ],
)
def test_a_bad_source_is_named_and_left_out(pad, source, reason, caplog):
    hub = InputHub({"keys": pad, "liar": source})
    with caplog.at_level(logging.WARNING):
        for _ in range(3):
            hub.poll()
    assert hub.devices == (pad.identity,)
    assert reason in hub.problems["liar"]
    assert len(caplog.records) == 1  # told once, not every second


def test_a_source_that_recovers_is_no_problem_any_more(hub, hidapi, monkeypatch):
    hidapi.failure = RuntimeError("no udev")
    hub.poll()
    assert "no udev" in hub.problems["hid"]
    hidapi.failure = None
    hub.poll()
    assert hub.problems == {}


def test_a_device_that_does_not_open_is_named_until_it_does(hub, hidapi, descriptors):
    stick = hidapi.plug(b"/dev/hidraw0", descriptors["joystick"])
    stick.refusal = "Permission denied"
    hub.poll()
    (key,) = (one.key for one in hub.devices if one.source == "hid")
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


def test_one_that_could_not_be_opened_is_told_again_but_not_for_ever(hub, hidapi, descriptors):
    stick = hidapi.plug(b"/dev/hidraw0", descriptors["joystick"])
    stick.refusal = "Permission denied"
    told = 0
    for _ in range(10):
        for identity in hub.poll().arrived:
            if identity.source == "hid":
                told += 1
                with pytest.raises(DriverError):
                    hub.open(identity.key)
    assert told == 4
    hidapi.bus.clear()
    hub.poll()
    hidapi.plug(b"/dev/hidraw0", descriptors["joystick"]).refusal = "Permission denied"
    (identity,) = hub.poll().arrived
    with pytest.raises(DriverError):
        hub.open(identity.key)
    hidapi.bus[b"/dev/hidraw0"].refusal = None  # the system is done with it
    assert hub.poll().arrived == (identity,)
    hub.open(identity.key)
    assert hub.poll() == Changes()


def test_what_a_plugin_raises_is_translated(pad):
    hub = InputHub({"liar": Liar([InputIdentity("liar:1", "thing", "liar")])})
    hub.poll()
    with pytest.raises(DriverError, match=r"thing \(liar:1\) cannot be opened: KeyError"):
        hub.open("liar:1")
    assert "KeyError" in hub.problems["liar:1"]


class Explodes(InputSource):
    def __init__(self, *, clock):
        raise OSError("licence")

    def devices(self):
        return ()

    def open(self, identity):
        raise AssertionError("it was never made")


@pytest.fixture
def installed(monkeypatch):
    def install(**values):
        points = [EntryPoint(name, value, hub_module.INPUTS) for name, value in values.items()]
        monkeypatch.setattr(registry, "entry_points", lambda group: points)

    return install


HID = "rotemina.drivers.inputs.hid.hid_discovery:HidSource"


def test_installed_sources_are_made_with_the_clock(installed, pad, clock):
    installed(hid=HID, gone="no.such.module:Source", keys=HID)
    hub = InputHub.installed({"keys": pad}, clock=clock)
    assert "ModuleNotFoundError" in hub.problems["gone"]
    assert "the program has a source of this name" in hub.problems["keys"]
    assert hub._sources["hid"].clock is clock
    assert isinstance(hub._sources["hid"], HidSource)


def test_a_source_that_cannot_be_made_is_named(installed, monkeypatch):
    installed(bad=HID)
    monkeypatch.setattr(EntryPoint, "load", lambda self: Explodes)
    assert "it cannot be made: OSError: licence" in InputHub.installed().problems["bad"]


def test_the_built_in_source_is_installed_as_any_other():
    found = registry.discover(hub_module.INPUTS, InputSource).found
    assert found["hid"] is HidSource
