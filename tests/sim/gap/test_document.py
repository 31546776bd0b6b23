"""A diagnosis as JSON: what the contract asks for, and what is read back or refused."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.app.files import json_text
from rotemina.sim.errors import InputError
from rotemina.sim.gap import reading
from rotemina.sim.gap.diagnosis import (
    Diagnosis,
    FittedParameter,
    Offset,
    Remainder,
    Suspected,
    Verdict,
)
from rotemina.sim.gap.document import ExperimentFiles, as_json, shares
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.reading import read_document
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

NAMES = ExperimentFiles("out_experiment_1.csv", {"creep": "c.csv", "hysteresis": "h.csv"})


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def written(diagnosis, **changes):
    """The path of the document of a diagnosis with some keys of its model changed."""
    form = as_json(diagnosis)
    form["model"] |= changes
    Path("out.json").write_text(json.dumps(form), "utf-8")
    return "out.json"


def test_every_key_of_the_contract_is_there(made_diagnosis):
    form = json.loads(json_text(as_json(made_diagnosis, [NAMES])))
    assert form["format"] == "rotemina-diagnosis 1"
    assert form["verdict"] == "unknown"
    assert form["axes"] == {"y": "unknown", "thx": "explained", "zn": "none"}
    first = form["where"][0]
    assert (first["axis"], first["tap"], first["stage"]) == ("thx", "ref", "actuator")
    assert first["gap_rms"] == pytest.approx(1.0e-7 * 201.0**0.5)
    assert first["noise_floor"] == 1.0e-7
    assert first["worst_band_hz"] == [0.5, 4.0]
    assert first["worst_regime"] == "reversal"
    assert [(one["axis"], one["tap"]) for one in form["where"]] == [
        ("thx", "ref"),
        ("thx", "meas"),
        ("y", "meas"),
    ]
    loop = form["causes"][0]
    contract = {
        "axis": "thx",
        "effect": "hysteresis",
        "stage": "actuator",
        "tap": "meas",
        "from_axis": None,
        "probability": 0.91,
        "ambiguous_with": ["creep"],
        "gap_before": 3.2e-05,
        "gap_after": 7.6e-07,
        "closed": 0.98,
        "closed_interval": [0.97, 0.99],
        "parameters": {"width": 1.2e-4, "shape": 4.0},
        "units": {"width": "rad", "shape": ""},
    }
    assert {key: loop[key] for key in contract} == contract
    assert loop["parameter_intervals"] == {"width": [1.1e-4, 1.3e-4], "shape": None}
    assert loop["at_bound"] == {"width": "high"}
    assert form["shrinkage"][0] == {
        "axis": "thx",
        "tap": "meas",
        "raw": 3.3e-05,
        "retuned": 3.2e-05,
        "corrected": 7.7e-07,
        "floor": 4.0e-07,
        "ceiling": None,
        "closed": 0.97,
        "closed_interval": [0.96, 0.98],
        "steps": [{"effect": "hysteresis", "rms": 7.8e-07, "shapley": 0.96, "axis": "thx"}],
    }
    assert form["next_experiments"] == [
        {
            "axis": "thx",
            "splits": ["hysteresis", "creep"],
            "why": "A step and a long rest: creep goes on, hysteresis does not.",
            "commands": "out_experiment_1.csv",
            "predictions": {"creep": "c.csv", "hysteresis": "h.csv"},
            "tap": "meas",
        }
    ]


def test_candidates_are_in_si_at_the_last_tap_and_what_is_not_finite_is_null(made_diagnosis):
    thx = made_diagnosis.axes["thx"]
    lost = replace(thx.ranking[1], held_out_interval=(25.0, float("inf")))
    wide = replace(thx, ranking=(thx.ranking[0], lost))
    form = as_json(replace(made_diagnosis, axes={**made_diagnosis.axes, "thx": wide}))
    first, second = form["candidates"]["thx"]
    assert first["held_out_rms"] == pytest.approx(1.2 * 4.0e-7)
    assert second["held_out_interval"] == [pytest.approx(25.0 * 4.0e-7), None]
    assert form["candidates"]["zn"] == []
    strange = form["causes"][1]
    assert (strange["effect"], strange["gap_after"], strange["stage"]) == ("unknown", None, None)
    assert form["next_experiments"][0]["commands"] is None
    json.dumps(form, allow_nan=False)


def test_shares_sum_to_one_and_lie_in_their_intervals(made_diagnosis):
    found = shares(made_diagnosis.places)
    assert sum(share for share, _ in found) == pytest.approx(1.0)
    for share, (low, high) in found:
        assert 0.0 <= low < share < high <= 1.0
    only = {"thx": replace(made_diagnosis.axes["thx"], places=made_diagnosis.places[:1])}
    [(share, interval)] = shares(replace(made_diagnosis, axes=only).places)
    assert (share, interval) == (1.0, (1.0, 1.0))


def test_units_of_a_coupling_name_both_axes(made_diagnosis):
    thx = made_diagnosis.axes["thx"]
    leak = FittedParameter("k", 12.0, "rad/…")
    pace = FittedParameter("frequency", 80.0, "Hz")
    coupled = replace(
        thx.causes[0], effect="cross_coupling", from_axis="zn", parameters=(leak, pace)
    )
    axes = {"thx": replace(thx, causes=(coupled,))}
    [cause] = as_json(replace(made_diagnosis, axes=axes))["causes"]
    assert cause["units"] == {"k": "rad/m", "frequency": "Hz"}


def test_a_gap_that_is_no_matter_has_no_place(made_diagnosis):
    small = replace(made_diagnosis.axes["thx"], verdict=Verdict.NONE, causes=())
    form = as_json(replace(made_diagnosis, axes={"thx": small}))
    assert (form["verdict"], form["where"], form["causes"]) == ("none", [], [])


def test_causes_come_in_the_order_of_what_they_close(made_diagnosis):
    thx = made_diagnosis.axes["thx"]
    small = replace(thx.causes[0], effect="creep", gap_before=7e-7)
    axes = {"thx": replace(thx, causes=(small, *thx.causes))}
    causes = as_json(replace(made_diagnosis, axes=axes))["causes"]
    assert [cause["effect"] for cause in causes] == ["hysteresis", "creep"]


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
        ("[" * 100_000, "nested too deeply"),
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
    with pytest.raises(InputError, match=r"^none\.json: it cannot be read"):
        read_document("none.json")
    Path("out.json").write_bytes(b"\xff{}")
    with pytest.raises(InputError, match="not UTF-8"):
        read_document("out.json")
    monkeypatch.setattr(reading, "MAX_BYTES", 1)
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


def test_the_graded_answer_is_written_and_offsets_read_back(made_diagnosis, tmp_path):
    diagnosis = made_diagnosis
    name = next(iter(diagnosis.axes))
    graded = replace(
        diagnosis.axes[name],
        verdict=Verdict.PARTLY,
        remainder=Remainder(1e-7, 0.2, (("speed", 0.4),)),
        suspected=(Suspected("creep", None, 0.4, in_model=False),),
        offsets={Tap.REF: None, Tap.MEAS: Offset(1e-6, 2e-8)},
    )
    whole = as_json(replace(diagnosis, axes={**diagnosis.axes, name: graded}))
    assert whole["axes"][name] == "partly"
    assert whole["remainder"][name] == {
        "rms": 1e-7,
        "share": 0.2,
        "depends_on": [{"what": "speed", "share": 0.4}],
    }
    assert whole["suspected"][0]["effect"] == "creep"
    assert whole["offset"][name] == {"ref": None, "meas": {"value": 1e-6, "deviation": 2e-8}}
    assert all(cause["in_model"] is True and cause["derived"] == {} for cause in whole["causes"])
    path = tmp_path / "graded.json"
    path.write_text(json.dumps(whole), encoding="utf-8")
    assert read_document(path).offsets == {name: {Tap.MEAS: Offset(1e-6, 2e-8)}}


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
