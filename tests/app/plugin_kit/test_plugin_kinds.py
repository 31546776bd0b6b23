"""Of every kind: a plugin that raises, hangs or is made for another version is named, left out."""

from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.app.plugin_kit.plugin_kinds import Kind, installed_plugins, named_points
from rotemina.sim import plugin_points
from rotemina.sim.plugin_points import API_VERSIONS

OLD = """
from dataclasses import replace
from pathlib import Path

from rotemina.app.panel import Panel
from rotemina.drivers.cameras.sequence import ImageSequences
from rotemina.drivers.inputs.hid.hid_discovery import HidSource
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.effects.delay import DELAY


class OldDriver(Simulator):
    api_version = 0


class OldPanel(Panel):
    api_version = 0


class OldCamera(ImageSequences):
    api_version = 0


class OldInput(HidSource):
    api_version = 0


OLD_EFFECT = replace(DELAY, id="others", api_version=0)
"""
NAMES = {
    "driver": "OldDriver",
    "panel": "OldPanel",
    "camera": "OldCamera",
    "input": "OldInput",
    "effect": "OLD_EFFECT",
}


def others(kind):
    (plugin,) = [one for one in installed_plugins(kind) if one.name == "others"]
    return plugin


def test_every_kind_has_its_group():
    assert {kind.group for kind in Kind} == set(API_VERSIONS)


# That our panels are all there is a test of the window, which has to import them anyway.
@pytest.mark.parametrize("kind", [kind for kind in Kind if kind is not Kind.PANEL])
def test_ours_are_all_loaded(kind):
    ours = [one for one in installed_plugins(kind) if one.package == "rotemina"]
    assert ours
    assert [one.refused for one in ours] == [""] * len(ours)
    assert {one.api_version for one in ours} == {kind.api_version}


def test_one_made_for_another_version_is_named(install, monkeypatch):
    monkeypatch.setattr(plugin_points, "import_fault", lambda _: None)  # it takes its time
    values = {kind: {"others": f"old_plugins:{name}"} for kind, name in NAMES.items()}
    install("old_plugins", OLD, version="0.9", **values)
    for kind in Kind:
        plugin = others(kind)
        assert (plugin.package, plugin.version, plugin.loaded) == ("old_plugins", "0.9", None)
        said = (
            f"made for version 0 of the interface, but this program has version {kind.api_version}"
        )
        assert said in plugin.refused


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("raise RuntimeError('no licence')", "cannot be imported: RuntimeError: no licence"),
        ("raise SystemExit(3)", "cannot be imported: SystemExit: 3"),
        ("import threading; threading.Event().wait()", "did not end within 1 s"),
        ("import os; os.abort()", "ends the whole process"),
    ],
)
def test_one_whose_import_fails_is_named(install, text, said):
    install("bad_plugins", text, **{kind: {"others": "bad_plugins:Any"} for kind in Kind})
    for kind in Kind:
        assert said in others(kind).refused
        assert "bad_plugins" in others(kind).refused
        assert any(one.loaded for one in installed_plugins(kind))  # the others are there


def test_one_whose_name_is_taken_is_named_beside_the_first(install):
    install("twin_plugins", "THING = 1", effect={"delay": "twin_plugins:THING"})
    twins = {one.package: one for one in installed_plugins(Kind.EFFECT) if one.name == "delay"}
    assert "already has this id" in twins["twin_plugins"].refused
    assert twins["rotemina"].loaded is not None


def test_points_of_a_name_are_found_without_an_import(install):
    install("bad_plugins", "raise RuntimeError", panel={"others": "bad_plugins:Any"})
    ((kind, point),) = named_points("others")
    assert (kind, point.value) == (Kind.PANEL, "bad_plugins:Any")


def test_an_effect_says_for_which_version_it_is_made():
    effect = next(installed_plugins(Kind.EFFECT)).loaded
    assert effect.api_version == Kind.EFFECT.api_version
    assert replace(effect, api_version=7).api_version == 7


def test_the_page_tells_the_versions_of_the_interfaces():
    page = (Path(__file__).parents[3] / "docs" / "plugins.md").read_text("utf-8")
    rows = [[cell.strip() for cell in row.split("|")] for row in page.splitlines() if "|" in row]
    told = {row[1]: (row[2], row[4]) for row in rows if row[2].startswith("`rotemina.")}
    assert told == {str(kind): (f"`{kind.group}`", str(kind.api_version)) for kind in Kind}
