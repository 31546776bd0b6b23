"""A diagnosis comes back from its file, and what is none is refused."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.gap.diagnosis import (
    Diagnosis,
    Verdict,
)
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.output import document_reader
from rotemina.sim.gap.output.document import as_json
from rotemina.sim.gap.output.document_reader import read_document
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def written(diagnosis, **changes):
    """The path of the document of a diagnosis with some keys of its model changed."""
    form = as_json(diagnosis)
    form["model"] |= changes
    Path("out.json").write_text(json.dumps(form), "utf-8")
    return "out.json"


def test_the_model_comes_back_to_the_last_bit(made_diagnosis):
    document = read_document(written(made_diagnosis))
    assert document.verdict is Verdict.UNKNOWN
    assert document.axes["thx"] is Verdict.EXPLAINED
    assert document.robot == made_diagnosis.robot
    assert document.effects == made_diagnosis.fitted
    assert document.corrected.effects == made_diagnosis.fitted


def test_a_robot_that_has_effects_keeps_them():
    worn = replace(
        load_robot("rotemina"),
        effects=(AxisEffect(axis="x", id="backlash", parameters={"width": 2e-6}),),
    )
    document = read_document(written(Diagnosis(worn, {})))
    assert document.corrected == worn
    assert document.verdict is Verdict.NONE


def test_unknown_keys_are_left_aside(made_diagnosis):
    form = as_json(made_diagnosis) | {"of_tomorrow": [1]}
    form["model"] |= {"colour": "blue"}
    form["model"]["effects"][0] |= {"colour": "blue"}
    Path("out.json").write_text(json.dumps(form), "utf-8")
    assert read_document("out.json").effects == made_diagnosis.fitted


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "out.json:1: not valid JSON"),
        ('{"a": \n!}', "out.json:2: not valid JSON"),
        ("[" * 100_000, "nested more than"),
        ("[]", "the document = []: must be an object"),
        ("{}", "format = None: must be 'rotemina-diagnosis 1'"),
        ('{"format": "rotemina-comparison 1"}', "format = 'rotemina-comparison 1'"),
        ('{"format": NaN}', "NaN is no number of JSON"),
        ('{"format": "rotemina-diagnosis 1"}', "model = None: must be an object"),
    ],
)
def test_what_is_no_diagnosis_is_refused(text, message):
    Path("out.json").write_text(text, "utf-8")
    with pytest.raises(InputError) as caught:
        read_document("out.json")
    assert message in str(caught.value)
    assert str(caught.value).startswith("out.json:")


def test_files_that_cannot_be_read_are_refused(monkeypatch):
    with pytest.raises(InputError, match=r"^none\.json cannot be read"):
        read_document("none.json")
    Path("out.json").write_bytes(b"\xff{}")
    with pytest.raises(InputError, match="not UTF-8"):
        read_document("out.json")
    monkeypatch.setattr(document_reader, "MAX_BYTES", 1)
    with pytest.raises(InputError, match="larger than 1 bytes"):
        read_document("out.json")


LOOP = {"axis": "thx", "effect": "hysteresis"}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"robot": 3}, "model.robot = 3: must be the text of a robot file"),
        ({"robot": "\ud800"}, "must be the text of a robot file"),
        ({"robot": "[robot"}, "model.robot: not valid TOML"),
        ({"robot": "[robot]\nname = 'a'\n"}, "model.robot: "),
        ({"effects": {}}, "model.effects = {}: must be a list"),
        ({"effects": [1]}, "model.effects[0] = 1: must be an object"),
        ({"effects": [{**LOOP, "axis": "w"}]}, "model.effects[0].axis = 'w': must be one of"),
        ({"effects": [{**LOOP, "axis": []}]}, "model.effects[0].axis = []: must be one of"),
        ({"effects": [{**LOOP, "effect": "os"}]}, "there is no effect 'os'"),
        ({"effects": [{**LOOP, "effect": None}]}, "must be the id of an effect"),
        ({"effects": [{**LOOP, "formulation": 7}]}, "formulation = 7: must be a text"),
        ({"effects": [{**LOOP, "from_axis": "zn"}]}, "comes from no other axis"),
        ({"effects": [{**LOOP, "parameters": 1}]}, "parameters = 1: must be an object"),
        ({"effects": [{**LOOP, "parameters": {"width": "wide"}}]}, "must be a number"),
        ({"effects": [{**LOOP, "parameters": {"width": None}}]}, "must be a number"),
        ({"effects": [{**LOOP, "parameters": {"width": 1.0}}]}, "width = 1: must be between 0"),
        ({"effects": [{**LOOP, "parameters": {"width": 10**400}}]}, "width = inf: must be"),
        ({"effects": [{**LOOP, "parameters": {"enabled": False}}]}, "no parameter has this name"),
        ({"effects": [{**LOOP, "parameters": {"depth": 1.0}}]}, "has no such parameter"),
    ],
)
def test_a_model_that_is_none_is_refused_with_its_key(made_diagnosis, changes, message):
    with pytest.raises(InputError) as caught:
        read_document(written(made_diagnosis, **changes))
    assert message in str(caught.value)
    assert str(caught.value).startswith("out.json: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("verdict", "fine", "verdict = 'fine': must be one of none, explained"),
        ("verdict", ["none"], "verdict = ['none']: must be one of"),
        ("axes", [], "axes = []: must be an object"),
        ("axes", {"x": 1}, "axes.x = 1: must be one of"),
    ],
)
def test_verdicts_are_checked(made_diagnosis, key, value, message):
    Path("out.json").write_text(json.dumps(as_json(made_diagnosis) | {key: value}), "utf-8")
    with pytest.raises(InputError) as caught:
        read_document("out.json")
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("offset", "message"),
    [
        ({"q": {}}, "offset.'q': must be one of"),
        ({"thx": {"side": None}}, "offset.thx.'side': must be one of"),
        ({"thx": {"meas": {"value": "1", "deviation": 0.0}}}, "offset.thx.'meas'.value = '1'"),
    ],
)
def test_an_offset_that_is_none_is_refused(made_diagnosis, tmp_path, offset, message):
    path = tmp_path / "edited.json"
    path.write_text(json.dumps({**as_json(made_diagnosis), "offset": offset}), encoding="utf-8")
    with pytest.raises(GapError, match=re.escape(message)):
        read_document(path)
