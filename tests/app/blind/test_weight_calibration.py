"""A calibration from blind cases recovers the coefficients they were generated with."""

import json

import numpy as np
import pytest

from rotemina.app.blind.cases import GeneratedCaseSource
from rotemina.app.blind.weight_calibration import fit_calibration
from rotemina.app.cli.main import main
from rotemina.app.errors import BlindError
from rotemina.sim.blind import CaseOutcome
from rotemina.sim.gap.compare import Calibration
from rotemina.sim.gap.compare.calibration import calibration_in, shipped

TRUE_CALIBRATION = Calibration(intercept=2.5, per_other_cause=-1.5, exponent=0.8, suspected=0.25)


def make_cause(effect, weight=None, axis="x"):
    cause = {"axis": axis, "effect": effect, "from_axis": None}
    return cause if weight is None else {**cause, "weight": weight, "probability": weight}


def make_outcome(causes, present_effects, suspected=()):
    label = {
        "verdict": "explained" if present_effects else "none",
        "effects": [make_cause(effect) for effect in present_effects],
    }
    answer = {"verdict": "explained", "causes": causes, "suspected": list(suspected)}
    return CaseOutcome("case", label, answer, 1.0)


def draw_outcomes(number, seed=0):
    rng = np.random.default_rng(seed)
    for _ in range(number):
        weights = rng.uniform(0.3, 0.999, rng.integers(1, 4))
        causes = [make_cause(f"effect_{n}", weight) for n, weight in enumerate(weights)]
        probabilities = [
            TRUE_CALIBRATION.probability(weight, len(weights) - 1) for weight in weights
        ]
        present_effects = [
            f"effect_{n}"
            for n, probability in enumerate(probabilities)
            if rng.random() < probability
        ]
        has_faint_effect = rng.random() < TRUE_CALIBRATION.suspected
        yield make_outcome(
            causes,
            [*present_effects, *(["faint"] if has_faint_effect else [])],
            [make_cause("faint")],
        )


def test_calibration_recovers_how_often_causes_are_present():
    calibration = fit_calibration(list(draw_outcomes(3000)))
    for weight in (0.4, 0.8, 0.99):
        for others in (0, 1, 2):
            expected = TRUE_CALIBRATION.probability(weight, others)
            assert calibration.probability(weight, others) == pytest.approx(expected, abs=0.03)
    assert calibration.suspected == pytest.approx(TRUE_CALIBRATION.suspected, abs=0.03)


def test_too_few_causes_are_refused():
    with pytest.raises(BlindError, match="19 causes were named, but a calibration needs 20"):
        fit_calibration([make_outcome([make_cause("creep", 0.9)], ["creep"])] * 19)


def test_probability_grows_with_weight_and_drops_with_other_causes():
    calibration = shipped()
    alone = [calibration.probability(weight, 0) for weight in (0.0, 0.3, 0.6, 0.9, 1.0)]
    assert alone == sorted(alone)
    assert 0.0 <= alone[0] < 0.5 < 0.9 < alone[-1] < 1.0
    assert calibration.probability(1.0, 1) < alone[-1]
    assert 0.0 < calibration.suspected < 0.5


def write_results(folder, key):
    """Write the files of a finished run."""
    (folder / "results").mkdir(parents=True)
    (folder / "cases.json").write_text(json.dumps(key))
    for n, outcome in enumerate(draw_outcomes(20)):
        result = {"format": "rotemina-blind-result 1", "case": f"case_{n:04d}", "seconds": 1.0}
        result |= {
            "label": dict(outcome.label),
            "answer": dict(outcome.answer),
            "held_out": {},
            "others": {},
        }
        (folder / "results" / f"case_{n:04d}.json").write_text(json.dumps(result))


def make_run_key():
    return dict(GeneratedCaseSource("rotemina", 20, 5).key)


@pytest.fixture
def score(tmp_path):
    """Function that scores a finished run of seed 5, calibrates on it and returns the status."""
    write_results(tmp_path / "run", make_run_key())

    def run(*more_arguments):
        arguments = ["gap", "blind", "--cases", "20", "--seed", "5", "--score"]
        arguments += ["--folder", str(tmp_path / "run"), "--calibrate", str(tmp_path / "out.json")]
        return main([*arguments, *more_arguments])

    return run


def test_command_counts_the_results_of_several_folders(tmp_path, score):
    write_results(tmp_path / "more", {"seed": 6})
    assert score("--beside", str(tmp_path / "more")) == 0
    document = json.loads((tmp_path / "out.json").read_text())
    assert document["done"] == 40
    assert [cases["seed"] for cases in document["cases"]] == [5, 6]
    assert calibration_in(document).probability(1.0, 0) > calibration_in(document).suspected


@pytest.mark.parametrize(
    ("folder", "key", "message"),
    [
        ("more", {"seed": 1000}, "its seed is 1000; seeds from 1000 on are for reports"),
        ("more", {"seed": "x"}, "its seed is x"),
        ("none", {}, "holds no results of a blind test"),
        ("run", {}, "this is the folder of the run itself"),
    ],
)
def test_additional_folder_must_be_another_development_run(
    tmp_path, capsys, score, folder, key, message
):
    write_results(tmp_path / "more", key)
    assert score("--beside", str(tmp_path / folder)) == 2
    error = capsys.readouterr().err
    assert message in error
    assert str(tmp_path / folder) in error
    assert not (tmp_path / "out.json").exists()


def test_additional_folder_needs_calibrate(tmp_path, capsys):
    write_results(tmp_path / "more", {"seed": 6})
    arguments = ["--cases", "1", "--folder", str(tmp_path / "run")]
    arguments += ["--beside", str(tmp_path / "more")]
    assert main(["gap", "blind", *arguments]) == 2
    assert "--beside goes with --calibrate" in capsys.readouterr().err
    assert not (tmp_path / "run").exists()
