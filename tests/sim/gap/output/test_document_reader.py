"""A diagnosis is read back from its file, and other files are refused."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.gap.output import as_json, document_reader, read_document
from rotemina.sim.gap.result import Diagnosis, GapVerdict
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot


@pytest.fixture(autouse=True)
def run_in_temporary_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def write_document(diagnosis, **changes):
    """Write a diagnosis with changed keys of its model, and return the path of the document."""
    content = as_json(diagnosis)
    content["model"] |= changes
    Path("out.json").write_text(json.dumps(content), "utf-8")
    return "out.json"


def test_the_model_is_read_back_exactly(made_diagnosis):
    document = read_document(write_document(made_diagnosis))
    assert document.verdict is GapVerdict.UNKNOWN
    assert document.axes["thx"] is GapVerdict.EXPLAINED
    assert document.robot == made_diagnosis.robot
    assert document.effects == made_diagnosis.fitted
    assert document.corrected.effects == made_diagnosis.fitted


def test_a_robot_that_has_effects_keeps_them():
    worn_robot = replace(
        load_robot("rotemina"),
        effects=(AxisEffect(axis="x", id="backlash", parameters={"width": 2e-6}),),
    )
    document = read_document(write_document(Diagnosis(worn_robot, {})))
    assert document.corrected == worn_robot
    assert document.verdict is GapVerdict.NONE


def test_unknown_keys_are_ignored(made_diagnosis):
    content = as_json(made_diagnosis) | {"of_tomorrow": [1]}
    content["model"] |= {"colour": "blue"}
    content["model"]["effects"][0] |= {"colour": "blue"}
    Path("out.json").write_text(json.dumps(content), "utf-8")
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
        ('{"format": NaN}', "NaN is not a JSON number"),
        ('{"format": "rotemina-diagnosis 1"}', "model = None: must be an object"),
    ],
)
def test_a_file_without_a_diagnosis_is_refused(text, message):
    Path("out.json").write_text(text, "utf-8")
    with pytest.raises(InputError) as error_info:
        read_document("out.json")
    assert message in str(error_info.value)
    assert str(error_info.value).startswith("out.json:")


def test_files_that_cannot_be_read_are_refused(monkeypatch):
    with pytest.raises(InputError, match=r"^none\.json cannot be read"):
        read_document("none.json")
    Path("out.json").write_bytes(b"\xff{}")
    with pytest.raises(InputError, match="not UTF-8"):
        read_document("out.json")
    monkeypatch.setattr(document_reader, "MAX_BYTES", 1)
    with pytest.raises(InputError, match="larger than 1 bytes"):
        read_document("out.json")


HYSTERESIS = {"axis": "thx", "effect": "hysteresis"}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"robot": 3}, "model.robot = 3: must be the text of a robot file"),
        ({"robot": "\ud800"}, "must be the text of a robot file"),
        ({"robot": "[robot"}, "model.robot: not valid TOML"),
        ({"robot": "[robot]\nname = 'a'\n"}, "model.robot: "),
        ({"effects": {}}, "model.effects = {}: must be a list"),
        ({"effects": [1]}, "model.effects[0] = 1: must be an object"),
        ({"effects": [{**HYSTERESIS, "axis": "w"}]}, "model.effects[0].axis = 'w': must be one of"),
        ({"effects": [{**HYSTERESIS, "axis": []}]}, "model.effects[0].axis = []: must be one of"),
        ({"effects": [{**HYSTERESIS, "effect": "os"}]}, "there is no effect 'os'"),
        ({"effects": [{**HYSTERESIS, "effect": None}]}, "must be the id of an effect"),
        ({"effects": [{**HYSTERESIS, "formulation": 7}]}, "formulation = 7: must be a text"),
        ({"effects": [{**HYSTERESIS, "from_axis": "zn"}]}, "no other axis causes this"),
        ({"effects": [{**HYSTERESIS, "parameters": 1}]}, "parameters = 1: must be an object"),
        ({"effects": [{**HYSTERESIS, "parameters": {"width": "wide"}}]}, "must be a number"),
        ({"effects": [{**HYSTERESIS, "parameters": {"width": None}}]}, "must be a number"),
        (
            {"effects": [{**HYSTERESIS, "parameters": {"width": 1.0}}]},
            "width = 1: must be between 0",
        ),
        ({"effects": [{**HYSTERESIS, "parameters": {"width": 10**400}}]}, "width = inf: must be"),
        (
            {"effects": [{**HYSTERESIS, "parameters": {"enabled": False}}]},
            "no parameter has this name",
        ),
        ({"effects": [{**HYSTERESIS, "parameters": {"depth": 1.0}}]}, "has no such parameter"),
    ],
)
def test_an_invalid_model_is_refused_with_its_key(made_diagnosis, changes, message):
    with pytest.raises(InputError) as error_info:
        read_document(write_document(made_diagnosis, **changes))
    assert message in str(error_info.value)
    assert str(error_info.value).startswith("out.json: ")
    assert "\n" not in str(error_info.value)


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("verdict", "fine", "verdict = 'fine': must be one of none, explained"),
        ("verdict", ["none"], "verdict = ['none']: must be one of"),
        ("axes", [], "axes = []: must be an object"),
        ("axes", {"x": 1}, "axes.x = 1: must be one of"),
        ("offset", {"q": {}}, "offset.'q': must be one of"),
        ("offset", {"thx": {"side": None}}, "offset.thx.'side': must be one of"),
        (
            "offset",
            {"thx": {"meas": {"value": "1", "deviation": 0.0}}},
            "offset.thx.'meas'.value = '1'",
        ),
    ],
)
def test_invalid_verdicts_and_offsets_are_refused(made_diagnosis, key, value, message):
    Path("out.json").write_text(json.dumps(as_json(made_diagnosis) | {key: value}), "utf-8")
    with pytest.raises(InputError) as error_info:
        read_document("out.json")
    assert message in str(error_info.value)
