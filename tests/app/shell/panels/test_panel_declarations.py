"""A panel's module is loaded when the panel is made; its declaration is cached until then."""

import json
from importlib.metadata import EntryPoint
from types import SimpleNamespace

import pytest

from rotemina.app.panel import PanelArea
from rotemina.app.shell.panels import PanelCollection, find_panels, panel_declarations
from rotemina.app.shell.panels.panel_declarations import DeclaredPanel, PanelDeclarations
from rotemina.app.shell.panels.panel_host import ENTRY_POINT_GROUP
from rotemina.plugins.plate.panel import PlatePanel

PLATE = EntryPoint("plate", "rotemina.plugins.plate.panel:PlatePanel", ENTRY_POINT_GROUP)


@pytest.fixture
def panels_of_second_start(settings):
    """The panels of a second start."""
    bench = SimpleNamespace(settings=settings)
    first, _ = find_panels(bench)
    assert not any(isinstance(declared, DeclaredPanel) for declared in first.panel_types.values())
    second, broken = find_panels(bench)
    assert broken == {}
    assert list(second) == list(first)
    for name, declared in second.panel_types.items():
        for attribute in ("title", "area", "order", "help_page", "at_once"):
            assert getattr(declared, attribute) == getattr(first.panel_types[name], attribute)
    return second


def test_a_second_start_loads_a_panel_only_when_it_is_made(panels_of_second_start, monkeypatch):
    assert all(
        isinstance(kind, DeclaredPanel) for kind in panels_of_second_start.panel_types.values()
    )
    assert PLATE.module in panels_of_second_start.modules_to_load
    assert panels_of_second_start.panel_types["plate"].load() is PlatePanel
    panel = SimpleNamespace(update_now=lambda: None)
    monkeypatch.setattr(DeclaredPanel, "load", lambda _: lambda bench: panel)
    assert panels_of_second_start["plate"] is panel
    assert PLATE.module not in panels_of_second_start.modules_to_load
    assert panels_of_second_start.panel_types["plate"] is not panel


def test_a_module_that_was_changed_is_loaded_again(settings, panels_of_second_start, monkeypatch):
    monkeypatch.setattr(panel_declarations, "_compute_stamp", lambda module: "another")
    changed, _ = find_panels(SimpleNamespace(settings=settings))
    assert not any(isinstance(kind, DeclaredPanel) for kind in changed.panel_types.values())


@pytest.mark.parametrize(
    "content",
    [
        "no JSON",
        "[1]",
        json.dumps({PLATE.value: 7}),
        json.dumps({PLATE.value: ["stamp", "Plate", "elsewhere", 1, "", False]}),
    ],
)
def test_an_invalid_cache_is_ignored(settings, monkeypatch, content):
    monkeypatch.setattr(panel_declarations, "_compute_stamp", lambda module: "stamp")
    settings.set("window.panels", content)
    assert PanelDeclarations(settings).find_declaration(PLATE) is None


def test_panels_of_other_packages_are_loaded_at_the_start(settings):
    other = type("Lamp", (PlatePanel,), {"__module__": "lamp"})
    PanelDeclarations(settings).save({"lamp": other})
    assert (
        PanelDeclarations(settings).find_declaration(
            EntryPoint("lamp", "lamp:Lamp", ENTRY_POINT_GROUP)
        )
        is None
    )


def test_a_panel_that_cannot_be_loaded_is_left_out_and_named():
    missing = EntryPoint("plate", "rotemina.plugins.no_such_panel:Panel", ENTRY_POINT_GROUP)
    panels = PanelCollection(
        None, {"plate": DeclaredPanel(missing, "Plate", PanelArea.BOTTOM, 1, "", False)}
    )
    failed = {}
    panels.on_failed = failed.__setitem__
    assert panels.make("plate") is None
    assert "no_such_panel" in failed["plate"]
    assert list(panels) == []
