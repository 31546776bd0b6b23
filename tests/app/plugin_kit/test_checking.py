"""One check for every kind: the import first, then the kind's own kit."""

import pytest

from rotemina.app.plugin_kit.checking import check_plugin
from rotemina.app.plugin_kit.plugin_kinds import Kind, named_points
from rotemina.sim import plugin_import
from rotemina.sim.robot.file import load_robot

SOURCES = """
from rotemina.drivers.cameras.sequence import ImageSequences
from rotemina.drivers.inputs.scripted import Scripted
from rotemina.drivers.inputs.script import Moment, Script
from rotemina.sim.effects.delay import DELAY
from rotemina.sim.effects.formulation import Drive
from dataclasses import replace


class Stick(Scripted):
    def __init__(self, *, clock):
        super().__init__(Script(("X",), (), (Moment(0.0, (0.5,)),)), clock=clock)


class Files(ImageSequences):
    pass


WRONG = replace(DELAY, id="wrong", summary="")
"""


def checked(name, kind):
    (found,) = [(one, point) for one, point in named_points(name) if one is kind]
    results = check_plugin(*found, load_robot("rotemina"))
    return {result.name: (str(result.verdict), result.note) for result in results}


@pytest.fixture(autouse=True)
def no_tries(monkeypatch):
    """The tries of imports have tests of their own."""
    monkeypatch.setattr(plugin_import, "_tried", lambda *_: "")
    monkeypatch.setattr(plugin_import, "_keep", lambda *_: None)


def test_each_kind_has_its_kit(install):
    install(
        "others_sources",
        SOURCES,
        camera={"others": "others_sources:Files"},
        input={"others": "others_sources:Stick"},
        effect={"wrong": "others_sources:WRONG"},
    )
    stick = checked("others", Kind.INPUT)
    assert stick["loading"] == stick["read"] == ("passed", "")
    files = checked("others", Kind.CAMERA)
    assert files["pictures"] == ("skipped", "there is no camera")
    wrong = checked("wrong", Kind.EFFECT)
    assert any(verdict == "failed" and note for verdict, note in wrong.values())


def test_one_that_cannot_be_loaded_is_not_checked_further(install):
    install("bad_plugins", "raise RuntimeError('no licence')", input={"others": "bad_plugins:X"})
    found = checked("others", Kind.INPUT)
    assert list(found) == ["loading"]
    assert "no licence" in found["loading"][1]
