"""The naive contestants answer in the form of a diagnosis."""

import numpy as np
import pytest

from rotemina.app.blind import classifier as learning
from rotemina.app.blind import naive_methods
from rotemina.app.blind.cases import SealedCase
from rotemina.app.blind.classifier import Classifier, classifier_for
from rotemina.app.blind.features import features, gap_in_floors
from rotemina.app.blind.naive_methods import CONTESTANTS, contest, naive_answers
from rotemina.sim.blind.sealing import Seal
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


def measured(effects=(), seed=0):
    time_s = np.arange(600) * 2e-3
    command = 30e-6 - 12e-6 * np.cos(2.0 * np.pi * 2.0 * time_s) * (1.0 - 0.5 * time_s)
    asked = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})
    return simulate(ROBOT, effects, asked, np.random.default_rng(seed))


GAIN = AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.05})


@pytest.fixture(scope="module")
def classifier():
    known = [
        features(ROBOT, [measured(effects, seed)], "zn")
        for effects in ((), (GAIN,))
        for seed in (1, 2, 3)
    ]
    return Classifier.of(np.array(known), ["none"] * 3 + ["gain_error"] * 3)


def test_features_are_finite_and_tell_a_gap(classifier):
    assert gap_in_floors(ROBOT, [measured()], "zn") == pytest.approx(1.0, abs=0.1)
    assert gap_in_floors(ROBOT, [measured((GAIN,))], "zn") > 10.0
    assert np.isfinite(classifier.known).all()


def test_the_nearest_known_residual_is_named(classifier):
    name, probability = classifier.classify(features(ROBOT, [measured((GAIN,), 9)], "zn"))
    assert name == "gain_error"
    assert 0.5 < probability <= 1.0


def test_contestants_accuse_nobody_without_a_gap_and_somebody_with_one(classifier):
    none = naive_answers(ROBOT, [measured()], classifier)
    assert set(none) == set(CONTESTANTS)
    assert all(answer == {"verdict": "none", "causes": []} for answer in none.values())
    told = naive_answers(ROBOT, [measured((GAIN,), 5)], classifier)
    for answer in told.values():
        assert answer["verdict"] == "explained"
        assert answer["causes"][0]["axis"] == "zn"
        assert 0.0 < answer["causes"][0]["probability"] <= 1.0
    assert told["features"]["causes"][0]["effect"] == "gain_error"


def test_bic_may_say_that_nothing_is_there_and_the_best_rmse_never_does(classifier, monkeypatch):
    monkeypatch.setattr(naive_methods, "_LEAST_GAP", 0.0)
    told = naive_answers(ROBOT, [measured()], classifier)
    assert told["bic"]["verdict"] == "none"
    assert told["best_rmse"]["verdict"] == "explained"


def test_records_that_cannot_be_used_are_an_answer_that_failed(tmp_path, classifier):
    broken = tmp_path / "r.csv"
    broken.write_text("nothing")
    case = SealedCase("c", "rotemina", (broken,), None, None, Seal("0"))
    answers = contest(case, classifier)
    assert {answer["verdict"] for answer in answers.values()} == {"failed"}


def test_what_was_learned_is_kept(tmp_path, monkeypatch):
    calls = []

    def learned(robot, number):
        calls.append(number)
        return np.array([[0.0, 1.0], [1.0, 0.0]]), ["creep", "delay"]

    monkeypatch.setattr(learning, "learned", learned)
    first = classifier_for(ROBOT, tmp_path / "classifier.npz", 3)
    second = classifier_for(ROBOT, tmp_path / "classifier.npz", 3)
    assert calls == [3]
    assert first.names == second.names == ("creep", "delay")
    assert np.array_equal(first.known, second.known)
