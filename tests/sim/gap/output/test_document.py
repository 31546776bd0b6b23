"""A diagnosis as JSON: the keys and values of the format."""

import json
from dataclasses import replace

import pytest

from rotemina.app.settings import format_json
from rotemina.sim.gap.output import (
    ExperimentFiles,
    as_json,
    compute_shares,
    read_document,
)
from rotemina.sim.gap.result import (
    FittedParameter,
    GapRemainder,
    GapVerdict,
    ModelOffset,
    SuspectedEffect,
)
from rotemina.sim.records import Tap

NAMES = ExperimentFiles("out_experiment_1.csv", {"creep": "c.csv", "hysteresis": "h.csv"})


@pytest.fixture(autouse=True)
def run_in_temporary_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_every_key_of_the_format_is_written(made_diagnosis):
    document = json.loads(format_json(as_json(made_diagnosis, [NAMES])))
    assert document["format"] == "rotemina-diagnosis 1"
    assert document["verdict"] == "unknown"
    assert document["axes"] == {"y": "unknown", "thx": "explained", "zn": "none"}
    first = document["where"][0]
    assert (first["axis"], first["tap"], first["stage"]) == ("thx", "ref", "actuator")
    assert first["gap_rms"] == pytest.approx(1.0e-7 * 201.0**0.5)
    assert first["noise_floor"] == 1.0e-7
    assert first["worst_band_hz"] == [0.5, 4.0]
    assert first["worst_regime"] == "reversal"
    assert [(location["axis"], location["tap"]) for location in document["where"]] == [
        ("thx", "ref"),
        ("thx", "meas"),
        ("y", "meas"),
    ]
    cause = document["causes"][0]
    expected = {
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
    assert {key: cause[key] for key in expected} == expected
    assert cause["parameter_intervals"] == {"width": [1.1e-4, 1.3e-4], "shape": None}
    assert cause["at_bound"] == {"width": "high"}
    assert document["shrinkage"][0] == {
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
    assert document["next_experiments"] == [
        {
            "axis": "thx",
            "splits": ["hysteresis", "creep"],
            "why": "A step and a long rest: creep goes on, hysteresis does not.",
            "commands": "out_experiment_1.csv",
            "predictions": {"creep": "c.csv", "hysteresis": "h.csv"},
            "tap": "meas",
        }
    ]


def test_candidates_are_in_si_at_the_last_tap_and_infinite_values_are_null(made_diagnosis):
    thx = made_diagnosis.axes["thx"]
    unbounded = replace(thx.ranking[1], held_out_interval=(25.0, float("inf")))
    changed_thx = replace(thx, ranking=(thx.ranking[0], unbounded))
    document = as_json(replace(made_diagnosis, axes={**made_diagnosis.axes, "thx": changed_thx}))
    first, second = document["candidates"]["thx"]
    assert first["held_out_rms"] == pytest.approx(1.2 * 4.0e-7)
    assert second["held_out_interval"] == [pytest.approx(25.0 * 4.0e-7), None]
    assert document["candidates"]["zn"] == []
    unknown_cause = document["causes"][1]
    assert (unknown_cause["effect"], unknown_cause["gap_after"], unknown_cause["stage"]) == (
        "unknown",
        None,
        None,
    )
    assert document["next_experiments"][0]["commands"] is None
    json.dumps(document, allow_nan=False)


def test_shares_sum_to_one_and_lie_in_their_intervals(made_diagnosis):
    shares = compute_shares(made_diagnosis.places)
    assert sum(share for share, _ in shares) == pytest.approx(1.0)
    for share, (low, high) in shares:
        assert 0.0 <= low < share < high <= 1.0
    single_axis = {"thx": replace(made_diagnosis.axes["thx"], places=made_diagnosis.places[:1])}
    [(share, interval)] = compute_shares(replace(made_diagnosis, axes=single_axis).places)
    assert (share, interval) == (1.0, (1.0, 1.0))


def test_units_of_a_coupling_name_both_axes(made_diagnosis):
    thx = made_diagnosis.axes["thx"]
    gain = FittedParameter("k", 12.0, "rad/…")
    frequency = FittedParameter("frequency", 80.0, "Hz")
    coupled = replace(
        thx.causes[0], effect="cross_coupling", from_axis="zn", parameters=(gain, frequency)
    )
    axes = {"thx": replace(thx, causes=(coupled,))}
    [cause] = as_json(replace(made_diagnosis, axes=axes))["causes"]
    assert cause["units"] == {"k": "rad/m", "frequency": "Hz"}


def test_causes_are_sorted_by_the_gap_that_they_close_and_noise_is_not_listed(made_diagnosis):
    thx = made_diagnosis.axes["thx"]
    small_cause = replace(thx.causes[0], effect="creep", gap_before=7e-7)
    axes = {"thx": replace(thx, causes=(small_cause, *thx.causes))}
    causes = as_json(replace(made_diagnosis, axes=axes))["causes"]
    assert [cause["effect"] for cause in causes] == ["hysteresis", "creep"]
    healthy_thx = replace(thx, verdict=GapVerdict.NONE, causes=())
    document = as_json(replace(made_diagnosis, axes={"thx": healthy_thx}))
    assert (document["verdict"], document["where"], document["causes"]) == ("none", [], [])


def test_partial_results_are_written_and_offsets_are_read_back(made_diagnosis, tmp_path):
    diagnosis = made_diagnosis
    name = next(iter(diagnosis.axes))
    partly_explained = replace(
        diagnosis.axes[name],
        verdict=GapVerdict.PARTLY,
        remainder=GapRemainder(1e-7, 0.2, (("speed", 0.4),)),
        suspected=(SuspectedEffect("creep", None, 0.4, in_model=False),),
        offsets={Tap.REF: None, Tap.MEAS: ModelOffset(1e-6, 2e-8)},
    )
    document = as_json(replace(diagnosis, axes={**diagnosis.axes, name: partly_explained}))
    assert document["axes"][name] == "partly"
    assert document["remainder"][name] == {
        "rms": 1e-7,
        "share": 0.2,
        "depends_on": [{"what": "speed", "share": 0.4}],
    }
    assert document["suspected"][0]["effect"] == "creep"
    assert document["offset"][name] == {"ref": None, "meas": {"value": 1e-6, "deviation": 2e-8}}
    assert all(cause["in_model"] is True and cause["derived"] == {} for cause in document["causes"])
    path = tmp_path / "graded.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    assert read_document(path).offsets == {name: {Tap.MEAS: ModelOffset(1e-6, 2e-8)}}
