"""Sentences of the diagnosis: known by the templates that the diagnosis makes them from."""

import ast
import re
from pathlib import Path

import pytest
from PySide6.QtCore import QTranslator

from rotemina.plugins.gap import sentences
from rotemina.plugins.gap.sentences import reason_of, remark_of
from rotemina.sim.gap import method

FIELD = re.compile(r"\{\w+\}")
TABLES = ("REMARKS", "REASONS", "MORE", "STANDS", "FAULTS", "CLOSEST", "FLOORS", "RANGES")
TABLES += ("MOTIONS", "NAMES", "SIZES", "GROUPS")


class Loud(QTranslator):
    def translate(self, _context, text, _comment=None, _number=-1):
        parts = re.split(r"(\{\w+\})", text)
        return "".join(part if FIELD.fullmatch(part) else part.upper() for part in parts)


@pytest.fixture
def loud(qapp):
    translator = Loud()
    qapp.installTranslator(translator)
    yield
    qapp.removeTranslator(translator)


def test_the_diagnosis_has_all_templates():
    there = set()
    for path in Path(method.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.JoinedStr):
                parts = (getattr(one, "value", "") for one in node.values)
                there.add("".join(part if isinstance(part, str) else "{}" for part in parts))
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                there.add(node.value)
    wanted = {FIELD.sub("{}", text) for name in TABLES for text in getattr(sentences, name)}
    assert wanted - there == set()


REASON = (
    "To tell hysteresis, creep and cross coupling from thy apart, play this: fast large triangle "
    "of thy while thx is held, ±5 µm about 12 µm, 6 s; it sets them, the closest two of them, 1.5 "
    "noise floors (rms) apart, even once each is fitted to it, which may be too little; no test "
    "here tells backlash or friction from one of them."
)
REMARKS = (
    "What is left depends on past commands (62%), axis y (12%), as far as simple features predict "
    "it.",
    "The reading stands at exactly 1.2 µm for 3 % of the rows, while the axis is commanded to "
    "move: either the axis does not follow, or the sensor is stuck or not connected, and the "
    "records cannot tell which.",
)


def test_a_sentence_stays_as_it_is_without_a_translation():
    assert reason_of(REASON) == REASON
    assert [remark_of(text) for text in REMARKS] == list(REMARKS)
    assert remark_of("Something of a plugin.") == "Something of a plugin."


def test_all_of_a_sentence_is_translated(loud):
    kept = re.compile(r"\b(thy|thx|y|s|µm)\b")
    for said in (reason_of(REASON), *map(remark_of, REMARKS)):
        assert re.findall("[a-zµ]+", kept.sub("", said)) == []
    assert "CROSS COUPLING FROM thy" in reason_of(REASON)
    assert remark_of("Something of a plugin.") == "Something of a plugin."
