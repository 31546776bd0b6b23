"""Plugins of every kind that raise, hang or have another version are left out with a reason."""

from pathlib import Path

import pytest

from rotemina.app.plugin_kit import (
    PluginKind,
    find_entry_points,
    load_installed_plugins,
)
from rotemina.sim.plugin_points import API_VERSIONS, loading as plugin_points

OLD_PLUGIN_SOURCE = """
from dataclasses import replace
from pathlib import Path

from rotemina.app.panel import Panel
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.inputs import HidSource
from rotemina.drivers.simulator import Simulator
from rotemina.sim.effects.delay import DELAY


class OldDriver(Simulator):
    api_version = 0


class OldPanel(Panel):
    api_version = 0


class OldCamera(ImageSequenceSource):
    api_version = 0


class OldInput(HidSource):
    api_version = 0


OLD_EFFECT = replace(DELAY, id="others", api_version=0)
"""
OLD_PLUGIN_NAMES = {
    "driver": "OldDriver",
    "panel": "OldPanel",
    "camera": "OldCamera",
    "input": "OldInput",
    "effect": "OLD_EFFECT",
}


def load_others_plugin(kind):
    (plugin,) = [plugin for plugin in load_installed_plugins(kind) if plugin.name == "others"]
    return plugin


# The tests of the window check our panels, since they import all of them anyway.
@pytest.mark.parametrize("kind", [kind for kind in PluginKind if kind is not PluginKind.PANEL])
def test_own_plugins_are_all_loaded(kind):
    own_plugins = [
        plugin for plugin in load_installed_plugins(kind) if plugin.package == "rotemina"
    ]
    assert own_plugins
    assert [plugin.refusal for plugin in own_plugins] == [""] * len(own_plugins)
    assert {plugin.api_version for plugin in own_plugins} == {kind.api_version}


def test_plugin_for_another_version_is_refused(install, monkeypatch):
    # Skip the slow trial import.
    monkeypatch.setattr(plugin_points, "find_import_fault", lambda _: None)
    values = {kind: {"others": f"old_plugins:{name}"} for kind, name in OLD_PLUGIN_NAMES.items()}
    install("old_plugins", OLD_PLUGIN_SOURCE, version="0.9", **values)
    for kind in PluginKind:
        plugin = load_others_plugin(kind)
        assert (plugin.package, plugin.version, plugin.loaded) == ("old_plugins", "0.9", None)
        message = (
            f"made for version 0 of the interface, but this program has version {kind.api_version}"
        )
        assert message in plugin.refusal


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("raise RuntimeError('no licence')", "cannot be imported: RuntimeError: no licence"),
        ("raise SystemExit(3)", "cannot be imported: SystemExit: 3"),
        ("import threading; threading.Event().wait()", "did not end within 1 s"),
        ("import os; os.abort()", "ends the whole process"),
    ],
)
def test_plugin_whose_import_fails_is_refused(install, text, message):
    install("bad_plugins", text, **{kind: {"others": "bad_plugins:Any"} for kind in PluginKind})
    for kind in PluginKind:
        assert message in load_others_plugin(kind).refusal
        assert "bad_plugins" in load_others_plugin(kind).refusal
        # Other plugins are loaded.
        assert any(plugin.loaded for plugin in load_installed_plugins(kind))


def test_plugin_whose_name_is_taken_is_listed_with_the_first(install):
    install("twin_plugins", "THING = 1", effect={"delay": "twin_plugins:THING"})
    plugins = {
        plugin.package: plugin
        for plugin in load_installed_plugins(PluginKind.EFFECT)
        if plugin.name == "delay"
    }
    assert "already has this id" in plugins["twin_plugins"].refusal
    assert plugins["rotemina"].loaded is not None


def test_entry_points_are_found_by_name_without_an_import(install):
    install("bad_plugins", "raise RuntimeError", panel={"others": "bad_plugins:Any"})
    ((kind, point),) = find_entry_points("others")
    assert (kind, point.value) == (PluginKind.PANEL, "bad_plugins:Any")


def test_plugins_page_lists_the_interface_versions():
    page = (Path(__file__).parents[3] / "docs" / "plugins.md").read_text("utf-8")
    rows = [[cell.strip() for cell in row.split("|")] for row in page.splitlines() if "|" in row]
    documented = {row[1]: (row[2], row[4]) for row in rows if row[2].startswith("`rotemina.")}
    assert documented == {
        str(kind): (f"`{kind.group}`", str(kind.api_version)) for kind in PluginKind
    }
    assert {kind.group for kind in PluginKind} == set(API_VERSIONS)
