"""A panel's module is loaded when it is made; what the window needs before is kept."""

import json
from importlib.metadata import EntryPoint
from types import SimpleNamespace

import pytest

from rotemina.app.panel import Area
from rotemina.app.shell import panel_declarations
from rotemina.app.shell.panel_declarations import Declarations, DeclaredPanel
from rotemina.app.shell.panel_host import GROUP, Panels, find_panels
from rotemina.plugins.plate.panel import PlatePanel

PLATE = EntryPoint("plate", "rotemina.plugins.plate.panel:PlatePanel", GROUP)


@pytest.fixture
def found_again(settings):
    """The panels of a second start."""
    bench = SimpleNamespace(settings=settings)
    first, _ = find_panels(bench)
    assert not any(isinstance(kind, DeclaredPanel) for kind in first.kinds.values())
    again, broken = find_panels(bench)
    assert broken == {}
    assert list(again) == list(first)
    for name, kind in again.kinds.items():
        for said in ("title", "area", "order", "help_page", "at_once"):
            assert getattr(kind, said) == getattr(first.kinds[name], said)
    return again


def test_a_second_start_loads_none_until_it_is_made(found_again, monkeypatch):
    assert all(isinstance(kind, DeclaredPanel) for kind in found_again.kinds.values())
    assert PLATE.module in found_again.modules_to_load
    made = SimpleNamespace(look_now=lambda: None)
    monkeypatch.setattr(DeclaredPanel, "load", lambda _: lambda bench: made)
    assert found_again["plate"] is made
    assert PLATE.module not in found_again.modules_to_load
    assert found_again.kinds["plate"] is not made


def test_the_class_is_what_the_module_has(found_again):
    assert found_again.kinds["plate"].load() is PlatePanel


def test_a_module_that_was_changed_is_loaded_again(settings, found_again, monkeypatch):
    monkeypatch.setattr(panel_declarations, "_stamp", lambda module: "another")
    changed, _ = find_panels(SimpleNamespace(settings=settings))
    assert not any(isinstance(kind, DeclaredPanel) for kind in changed.kinds.values())


@pytest.mark.parametrize(
    "spoilt",
    [
        "no JSON",
        "[1]",
        json.dumps({PLATE.value: 7}),
        json.dumps({PLATE.value: ["stamp", "Plate", "elsewhere", 1, "", False]}),
    ],
)
def test_what_is_spoilt_is_not_known(settings, monkeypatch, spoilt):
    monkeypatch.setattr(panel_declarations, "_stamp", lambda module: "stamp")
    settings.set("window.panels", spoilt)
    assert Declarations(settings).known(PLATE) is None


def test_panels_of_other_packages_are_loaded_at_the_start(settings):
    other = type("Lamp", (PlatePanel,), {"__module__": "lamp"})
    Declarations(settings).keep({"lamp": other})
    assert Declarations(settings).known(EntryPoint("lamp", "lamp:Lamp", GROUP)) is None


def test_one_that_cannot_be_loaded_is_left_out_and_named():
    missing = EntryPoint("plate", "rotemina.plugins.no_such_panel:Panel", GROUP)
    panels = Panels(None, {"plate": DeclaredPanel(missing, "Plate", Area.BOTTOM, 1, "", False)})
    failed = {}
    panels.failed = failed.__setitem__
    assert panels.make("plate") is None
    assert "no_such_panel" in failed["plate"]
    assert list(panels) == []
