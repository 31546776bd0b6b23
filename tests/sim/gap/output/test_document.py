"""A diagnosis as JSON: what the contract asks for, and what is read back or refused."""

import json
from dataclasses import replace

import pytest

from rotemina.app.files import json_text
from rotemina.sim.gap.diagnosis import (
    FittedParameter,
    Offset,
    Remainder,
    Suspected,
    Verdict,
)
from rotemina.sim.gap.output.document import ExperimentFiles, as_json, shares
from rotemina.sim.gap.output.document_reader import read_document
from rotemina.sim.records.record import Tap

NAMES = ExperimentFiles("out_experiment_1.csv", {"creep": "c.csv", "hysteresis": "h.csv"})


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


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
