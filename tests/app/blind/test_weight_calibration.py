"""The calibration that blind cases give: it finds the coefficients that made them."""

import json

import numpy as np
import pytest

from rotemina.app.blind.cases import BlindError
from rotemina.app.blind.weight_calibration import calibrated
from rotemina.app.cli.main import main
from rotemina.sim.blind.scoring import Outcome
from rotemina.sim.gap.compare.calibration import Calibration, calibration_in, shipped

TRUE = Calibration(constant=2.5, another=-1.5, exponent=0.8, suspected=0.25)


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


def results(folder, seed, number=20):
    """Write a finished run by hand."""
    (folder / "results").mkdir(parents=True)
    key = {"made by": "`rotemina gap blind`", "seed": seed}
    (folder / "cases.json").write_text(json.dumps(key))
    for n, one in enumerate(outcomes(number, seed)):
        result = {"format": "rotemina-blind-result 1", "case": f"case_{n:04d}", "seconds": 1.0}
        result |= {
            "label": dict(one.label),
            "answer": dict(one.answer),
            "held_out": {},
            "others": {},
        }
        (folder / "results" / f"case_{n:04d}.json").write_text(json.dumps(result))


def run(tmp_path, *words):
    folder = tmp_path / "run"
    return main(["gap", "blind", "--cases", "20", "--seed", "5", "--score", "--folder", str(folder),
                 "--calibrate", str(tmp_path / "out.json"), *words])  # fmt: skip


def test_the_command_counts_the_results_of_several_folders(tmp_path, capsys):
    results(tmp_path / "run", 5)
    results(tmp_path / "more", 6)
    key = main_key(tmp_path)
    (tmp_path / "run" / "cases.json").write_text(json.dumps(key))
    assert run(tmp_path, "--beside", str(tmp_path / "more")) == 0
    document = json.loads((tmp_path / "out.json").read_text())
    assert document["done"] == 40
    assert [one["seed"] for one in document["cases"]] == [5, 6]
    assert calibration_in(document).exponent >= 0.0
    capsys.readouterr()


def main_key(tmp_path):
    from rotemina.app.blind.cases import GeneratedCases

    return dict(GeneratedCases("rotemina", 20, 5).key)


@pytest.mark.parametrize(
    ("seed", "said"),
    [(1000, "seeds from 1000 on are for reports"), (None, "cannot be read")],
)
def test_a_folder_beside_must_be_one_of_development(tmp_path, capsys, seed, said):
    results(tmp_path / "run", 5)
    (tmp_path / "run" / "cases.json").write_text(json.dumps(main_key(tmp_path)))
    if seed is not None:
        results(tmp_path / "more", seed)
    assert run(tmp_path, "--beside", str(tmp_path / "more")) == 2
    error = capsys.readouterr().err
    assert said in error
    assert str(tmp_path / "more") in error
    assert not (tmp_path / "out.json").exists()
