"""One check for every kind of plugin: the import first, then the checks of the kind."""

import pytest

from rotemina.app.plugin_kit import PluginKind, check_plugin, find_entry_points
from rotemina.sim.plugin_points import trial_import as plugin_import
from rotemina.sim.robot_files import load_robot

PLUGIN_SOURCE = """
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.inputs.scripted import ScriptedSource
from rotemina.drivers.inputs.script import ScriptMoment, InputScript
from rotemina.sim.effects.delay import DELAY
from rotemina.sim.effects import InputFunction
from dataclasses import replace


class Stick(ScriptedSource):
    def __init__(self, *, clock):
        super().__init__(InputScript(("X",), (), (ScriptMoment(0.0, (0.5,)),)), clock=clock)


class Files(ImageSequenceSource):
    pass


WRONG = replace(DELAY, id="wrong", summary="")
"""


def check_by_name(name, kind):
    (point,) = [point for found_kind, point in find_entry_points(name) if found_kind is kind]
    results = check_plugin(kind, point, load_robot("rotemina"))
    return {result.name: (str(result.verdict), result.note) for result in results}


@pytest.fixture(autouse=True)
def skip_trial_imports(monkeypatch):
    """Skip the trial imports, which have separate tests."""
    monkeypatch.setattr(plugin_import, "_try_import", lambda *_: "")
    monkeypatch.setattr(plugin_import, "_write_results", lambda *_: None)


def test_each_kind_has_its_own_checks(install):
    install(
        "others_sources",
        PLUGIN_SOURCE,
        camera={"others": "others_sources:Files"},
        input={"others": "others_sources:Stick"},
        effect={"wrong": "others_sources:WRONG"},
    )
    stick_results = check_by_name("others", PluginKind.INPUT)
    assert stick_results["loading"] == stick_results["read"] == ("passed", "")
    camera_results = check_by_name("others", PluginKind.CAMERA)
    assert camera_results["pictures"] == ("skipped", "there is no camera")
    effect_results = check_by_name("wrong", PluginKind.EFFECT)
    assert any(verdict == "failed" and note for verdict, note in effect_results.values())


def test_plugin_that_cannot_be_loaded_is_not_checked_further(install):
    install("bad_plugins", "raise RuntimeError('no licence')", input={"others": "bad_plugins:X"})
    results = check_by_name("others", PluginKind.INPUT)
    assert list(results) == ["loading"]
    assert "no licence" in results["loading"][1]
