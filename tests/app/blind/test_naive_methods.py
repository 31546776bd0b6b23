"""The naive methods answer in the same form as the diagnosis."""

import numpy as np
import pytest

from rotemina.app.blind import classifier as classifier_module, naive_methods
from rotemina.app.blind.cases import SealedCase
from rotemina.app.blind.classifier import ResidualClassifier, load_or_train_classifier
from rotemina.app.blind.features import compute_features, compute_gap_in_floors
from rotemina.app.blind.naive_methods import CONTESTANTS, answer_by_each_method, answer_case
from rotemina.sim.blind import LabelSeal
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")


def make_record(effects=(), seed=0):
    time_s = np.arange(600) * 2e-3
    command = 30e-6 - 12e-6 * np.cos(2.0 * np.pi * 2.0 * time_s) * (1.0 - 0.5 * time_s)
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})
    return simulate(ROBOT, effects, commands, np.random.default_rng(seed))


GAIN = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.05})


@pytest.fixture(scope="module")
def classifier():
    features = [
        compute_features(ROBOT, [make_record(effects, seed)], "zn")
        for effects in ((), (GAIN,))
        for seed in (1, 2, 3)
    ]
    return ResidualClassifier.from_features(np.array(features), ["none"] * 3 + ["gain_error"] * 3)


def test_features_are_finite_and_show_a_gap(classifier):
    assert compute_gap_in_floors(ROBOT, [make_record()], "zn") == pytest.approx(1.0, abs=0.1)
    assert compute_gap_in_floors(ROBOT, [make_record((GAIN,))], "zn") > 10.0
    assert np.isfinite(classifier.known_features).all()


def test_nearest_known_residual_is_named(classifier):
    name, probability = classifier.classify(
        compute_features(ROBOT, [make_record((GAIN,), 9)], "zn")
    )
    assert name == "gain_error"
    assert 0.5 < probability <= 1.0


def test_methods_name_a_cause_only_if_there_is_a_gap(classifier):
    healthy_answers = answer_by_each_method(ROBOT, [make_record()], classifier)
    assert set(healthy_answers) == set(CONTESTANTS)
    assert all(answer == {"verdict": "none", "causes": []} for answer in healthy_answers.values())
    faulty_answers = answer_by_each_method(ROBOT, [make_record((GAIN,), 5)], classifier)
    for answer in faulty_answers.values():
        assert answer["verdict"] == "explained"
        assert answer["causes"][0]["axis"] == "zn"
        assert 0.0 < answer["causes"][0]["probability"] <= 1.0
    assert faulty_answers["features"]["causes"][0]["effect"] == "gain_error"


def test_bic_can_answer_none_but_best_rmse_cannot(classifier, monkeypatch):
    monkeypatch.setattr(naive_methods, "_MIN_GAP_IN_FLOORS", 0.0)
    answers = answer_by_each_method(ROBOT, [make_record()], classifier)
    assert answers["bic"]["verdict"] == "none"
    assert answers["best_rmse"]["verdict"] == "explained"


def test_unusable_records_give_a_failed_answer(tmp_path, classifier):
    broken = tmp_path / "r.csv"
    broken.write_text("nothing")
    case = SealedCase("c", "rotemina", (broken,), None, None, LabelSeal("0"))
    answers = answer_case(case, classifier)
    assert {answer["verdict"] for answer in answers.values()} == {"failed"}


def test_trained_classifier_is_cached(tmp_path, monkeypatch):
    calls = []

    def make_small_training_set(robot, number):
        calls.append(number)
        return np.array([[0.0, 1.0], [1.0, 0.0]]), ["creep", "delay"]

    monkeypatch.setattr(classifier_module, "make_training_set", make_small_training_set)
    first = load_or_train_classifier(ROBOT, tmp_path / "classifier.npz", 3)
    second = load_or_train_classifier(ROBOT, tmp_path / "classifier.npz", 3)
    assert calls == [3]
    assert first.names == second.names == ("creep", "delay")
    assert np.array_equal(first.known_features, second.known_features)
