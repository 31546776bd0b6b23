"""A bad plugin is reported and skipped, and the others are loaded."""

from importlib.metadata import EntryPoint

import pytest

from rotemina.drivers.contract import Driver, registry
from rotemina.drivers.simulator import Simulator

VALID_ENTRY_POINT = "rotemina.drivers.simulator.driver:Simulator"


class OldSimulator(Simulator):
    api_version = 0


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("no.such.module:Thing", "cannot be imported: ModuleNotFoundError"),
        ("rotemina.drivers.simulator.driver:Missing", "cannot be imported: AttributeError"),
        ("math:pi", "is no Driver"),
        ("pathlib:Path", "is no Driver"),
        (
            "rotemina.drivers.abilities.abilities:TrajectoryPlayer",
            "does not define _clear_fault, _close",
        ),
    ],
)
def test_a_bad_plugin_is_reported_and_skipped(install_plugins, value, reason):
    install_plugins(bad=value, good=VALID_ENTRY_POINT)
    discovery = registry.discover_drivers()
    assert discovery.plugins == {"good": Simulator}
    assert reason in discovery.problems["bad"]
    assert value in discovery.problems["bad"]


def test_a_plugin_for_another_version_is_skipped(install_plugins, monkeypatch):
    install_plugins(old=VALID_ENTRY_POINT)
    monkeypatch.setattr(EntryPoint, "load", lambda self: OldSimulator)
    assert "version 0" in registry.discover_drivers().problems["old"]


def test_a_plugin_that_raises_any_exception_is_skipped(install_plugins, monkeypatch):
    def raise_licence_error(self):
        raise RuntimeError("licence expired")

    install_plugins(bad=VALID_ENTRY_POINT)
    monkeypatch.setattr(EntryPoint, "load", raise_licence_error)
    assert "licence expired" in registry.discover_drivers().problems["bad"]


def test_a_second_plugin_of_the_same_name_is_reported(monkeypatch):
    points = [
        EntryPoint("twin", VALID_ENTRY_POINT, registry.DRIVER_GROUP),
        EntryPoint("twin", "x:Y", "g"),
    ]
    monkeypatch.setattr(registry, "entry_points", lambda group: points)
    discovery = registry.discover_plugins("g", Driver)
    assert discovery.plugins == {"twin": Simulator}
    assert "already" in discovery.problems["twin (x:Y)"]
