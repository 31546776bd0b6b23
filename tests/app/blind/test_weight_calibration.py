"""The calibration that blind cases give: it finds the coefficients that made them."""

import json

import numpy as np
import pytest

from rotemina.app.blind.cases import BlindError, GeneratedCases
from rotemina.app.blind.weight_calibration import calibrated
from rotemina.app.cli.main import main
from rotemina.sim.blind.scoring import Outcome
from rotemina.sim.gap.compare.calibration import Calibration, calibration_in, shipped

TRUE = Calibration(intercept=2.5, per_other_cause=-1.5, exponent=0.8, suspected=0.25)


def named(effect, weight=None, axis="x"):
    told = {"axis": axis, "effect": effect, "from_axis": None}
    return told if weight is None else {**told, "weight": weight, "probability": weight}


def outcome(causes, there, suspected=()):
    label = {"verdict": "explained" if there else "none", "effects": [named(one) for one in there]}
    answer = {"verdict": "explained", "causes": causes, "suspected": list(suspected)}
    return Outcome("case", label, answer, 1.0)


def outcomes(number, seed=0):
    rng = np.random.default_rng(seed)
    for _ in range(number):
        weights = rng.uniform(0.3, 0.999, rng.integers(1, 4))
        causes = [named(f"effect_{n}", weight) for n, weight in enumerate(weights)]
        odds = [TRUE.probability(weight, len(weights) - 1) for weight in weights]
        there = [f"effect_{n}" for n, odd in enumerate(odds) if rng.random() < odd]
        present = rng.random() < TRUE.suspected
        yield outcome(causes, [*there, *(["faint"] if present else [])], [named("faint")])


def test_the_calibration_finds_how_often_causes_are_there():
    found = calibrated(list(outcomes(3000)))
    for weight in (0.4, 0.8, 0.99):
        for others in (0, 1, 2):
            expected = TRUE.probability(weight, others)
            assert found.probability(weight, others) == pytest.approx(expected, abs=0.03)
    assert found.suspected == pytest.approx(TRUE.suspected, abs=0.03)


def test_few_causes_calibrate_nothing():
    with pytest.raises(BlindError, match="19 causes were named, 20 are needed"):
        calibrated([outcome([named("creep", 0.9)], ["creep"])] * 19)


def test_a_cause_is_more_probable_with_its_weight_and_less_beside_others():
    calibration = shipped()
    alone = [calibration.probability(weight, 0) for weight in (0.0, 0.3, 0.6, 0.9, 1.0)]
    assert alone == sorted(alone)
    assert 0.0 <= alone[0] < 0.5 < 0.9 < alone[-1] < 1.0
    assert calibration.probability(1.0, 1) < alone[-1]
    assert 0.0 < calibration.suspected < 0.5


def results(folder, key):
    """Write a finished run by hand."""
    (folder / "results").mkdir(parents=True)
    (folder / "cases.json").write_text(json.dumps(key))
    for n, one in enumerate(outcomes(20)):
        result = {"format": "rotemina-blind-result 1", "case": f"case_{n:04d}", "seconds": 1.0}
        result |= {
            "label": dict(one.label),
            "answer": dict(one.answer),
            "held_out": {},
            "others": {},
        }
        (folder / "results" / f"case_{n:04d}.json").write_text(json.dumps(result))


def own_key():
    return dict(GeneratedCases("rotemina", 20, 5).key)


@pytest.fixture
def scored(tmp_path):
    """Score a finished run of seed 5 and calibrate on it, with further words; the status."""
    results(tmp_path / "run", own_key())

    def run(*words):
        asked = ["gap", "blind", "--cases", "20", "--seed", "5", "--score"]
        asked += ["--folder", str(tmp_path / "run"), "--calibrate", str(tmp_path / "out.json")]
        return main([*asked, *words])

    return run


def test_the_command_counts_the_results_of_several_folders(tmp_path, scored):
    results(tmp_path / "more", {"seed": 6})
    assert scored("--beside", str(tmp_path / "more")) == 0
    document = json.loads((tmp_path / "out.json").read_text())
    assert document["done"] == 40
    assert [one["seed"] for one in document["cases"]] == [5, 6]
    assert calibration_in(document).probability(1.0, 0) > calibration_in(document).suspected


@pytest.mark.parametrize(
    ("folder", "key", "said"),
    [
        ("more", {"seed": 1000}, "its seed is 1000; seeds from 1000 on are for reports"),
        ("more", {"seed": "x"}, "its seed is x"),
        ("none", {}, "it holds no results of a blind test"),
        ("run", {}, "it is the folder of this run"),
    ],
)
def test_a_folder_beside_must_be_another_one_of_development(
    tmp_path, capsys, scored, folder, key, said
):
    results(tmp_path / "more", key)
    assert scored("--beside", str(tmp_path / folder)) == 2
    error = capsys.readouterr().err
    assert said in error
    assert str(tmp_path / folder) in error
    assert not (tmp_path / "out.json").exists()


def test_a_folder_beside_counts_in_a_calibration_alone(tmp_path, capsys):
    results(tmp_path / "more", {"seed": 6})
    words = ["--cases", "1", "--folder", str(tmp_path / "run"), "--beside", str(tmp_path / "more")]
    assert main(["gap", "blind", *words]) == 2
    assert "--beside goes with --calibrate" in capsys.readouterr().err
    assert not (tmp_path / "run").exists()
