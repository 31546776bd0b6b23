"""One bad plugin is named and left out; the others load."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.drivers import registry
from rotemina.drivers.driver import Driver
from rotemina.drivers.simulator.driver import Simulator

GOOD = "rotemina.drivers.simulator.driver:Simulator"


class OldSimulator(Simulator):
    api_version = 0


@pytest.fixture
def installed(monkeypatch):
    def install(**values):
        points = [EntryPoint(name, value, registry.DRIVERS) for name, value in values.items()]
        monkeypatch.setattr(registry, "entry_points", lambda group: points)

    return install


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("no.such.module:Thing", "cannot be imported: ModuleNotFoundError"),
        ("rotemina.drivers.simulator.driver:Missing", "cannot be imported: AttributeError"),
        ("math:pi", "is no Driver"),
        ("pathlib:Path", "is no Driver"),
        ("rotemina.drivers.abilities:TrajectoryPlayer", "does not define _clear_fault, _close"),
    ],
)
def test_a_bad_plugin_is_named_and_left_out(installed, value, reason):
    installed(bad=value, good=GOOD)
    discovery = registry.discover_drivers()
    assert discovery.found == {"good": Simulator}
    assert reason in discovery.broken["bad"]
    assert value in discovery.broken["bad"]


def test_a_plugin_for_another_version_is_left_out(installed, monkeypatch):
    installed(old=GOOD)
    monkeypatch.setattr(EntryPoint, "load", lambda self: OldSimulator)
    assert "version 0" in registry.discover_drivers().broken["old"]


def test_a_plugin_that_raises_anything_is_left_out(installed, monkeypatch):
    def explode(self):
        raise RuntimeError("licence expired")

    installed(bad=GOOD)
    monkeypatch.setattr(EntryPoint, "load", explode)
    assert "licence expired" in registry.discover_drivers().broken["bad"]


def test_a_name_is_taken_once(monkeypatch):
    points = [EntryPoint("twin", GOOD, registry.DRIVERS), EntryPoint("twin", "x:Y", "g")]
    monkeypatch.setattr(registry, "entry_points", lambda group: points)
    discovery = registry.discover("g", Driver)
    assert discovery.found == {"twin": Simulator}
    assert "already" in discovery.broken["twin (x:Y)"]
