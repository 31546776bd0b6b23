"""Sayings of the engine that panels translate: they are what the engine says, word for word."""

import ast
import re
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

from rotemina.app.shell import engine_words

ROOT = Path(__file__).parents[2]
PANELS = ("calibration", "inputs", "microscope", "penetration", "teleoperation")
ENGINE = ("app/motion", "app/microscope", "app/cameras", "drivers", "sim/calibration", "sim/vision")


def said_in(folder):
    """Texts in a folder's modules, with ``{}`` for each value in them."""
    for path in (ROOT / folder).rglob("*.py"):
        if path.name == "engine_words.py":
            continue
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.value
            elif isinstance(node, ast.JoinedStr):
                parts = (getattr(part, "value", "") for part in node.values)
                yield "".join(part if isinstance(part, str) else "{}" for part in parts)


@cache
def engine():
    return frozenset(text for folder in ENGINE for text in said_in(folder))


@pytest.mark.parametrize("panel", PANELS)
def test_every_saying_is_one_of_the_engine(panel):
    sayings = import_module(f"rotemina.plugins.{panel}.engine_words").SAYINGS
    known = engine() | set(said_in(f"plugins/{panel}"))
    assert [one for one in sayings if re.sub(r"\{\w+\}", "{}", one) not in known] == []


def test_values_in_a_saying_are_said_too_and_what_is_unknown_stays(monkeypatch):
    german = {"{what} is lost: {why}": "{what} verloren: {why}", "tip": "Spitze", "dark": "dunkel"}
    monkeypatch.setattr(engine_words, "translate", lambda context, text: german[text])
    say = engine_words.speaker("x", ("tip", "{what} is lost: {why}"), lambda text: f"<{text}>")
    assert say("tip is lost: dark {x}") == "Spitze verloren: <dark {x}>"
    assert say("something else") == "<something else>"
