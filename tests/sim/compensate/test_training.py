"""Training of inverses, their judgement and the recommendation."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate import (
    InverseResidual,
    TrainingSamples,
    anfis,
    compute_residual,
    train,
    training,
)
from rotemina.sim.compensate.inverse_parameters import INVERSE_KINDS
from rotemina.sim.compensate.judgement import explain_recommendation, recommend_kind
from rotemina.sim.errors import CompensationError, ConvergenceError


@pytest.fixture(scope="module")
def short_run(bent_run):
    """The first half of the run, which is enough where the quality of the inverses is no matter."""
    half = slice(0, len(bent_run.command) // 2)
    return replace(bent_run, command=bent_run.command[half], position=bent_run.position[half])


def test_kinds_with_a_bend_have_the_smallest_residuals(trained):
    assert tuple(trained.models) == INVERSE_KINDS
    share = {kind: residual.share for kind, residual in trained.residuals.items()}
    assert share["anfis"] < 2e-3
    assert share["modified_prandtl_ishlinskii"] < 2e-3
    assert share["prandtl_ishlinskii"] > 3.0 * share["anfis"]
    assert share["linear"] > 1.5 * share["prandtl_ishlinskii"]
    assert trained.recommended_kind in ("anfis", "modified_prandtl_ishlinskii")
    assert "on rows that no inverse was trained on" in trained.recommendation_reason


def test_no_inverse_is_trained_on_rows_that_judge_it(robot, short_run):
    """Nonsense in the last rows worsens the judgement but changes no inverse."""
    last = int(0.9 * len(short_run.command))
    position = short_run.position.copy()
    position[last:] = position[last]
    settings = anfis.AnfisSettings(epochs=1)
    clean = train(robot, [short_run], settings=settings)
    disturbed = train(robot, [replace(short_run, position=position)], settings=settings)
    for kind, model in clean.models.items():
        assert disturbed.models[kind].consequents.tolist() == model.consequents.tolist()
        assert disturbed.residuals[kind].rms > 1.5 * clean.residuals[kind].rms


def test_the_listener_gets_a_growing_share_of_progress(robot, short_run):
    reports = []
    train(
        robot,
        [short_run],
        settings=anfis.AnfisSettings(epochs=2),
        listener=lambda stage, share: reports.append((stage, share)),
    )
    shares = [share for _, share in reports]
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert any(stage.startswith("ANFIS, epoch 2") for stage, _ in reports)


def test_the_other_kinds_are_trained_if_anfis_does_not_converge(robot, short_run, monkeypatch):
    def fail(*_arguments):
        raise ConvergenceError("ANFIS: the training did not converge")

    monkeypatch.setattr(training.anfis, "train", fail)
    trained_kinds = train(robot, [short_run])
    assert "anfis" not in trained_kinds.models
    assert trained_kinds.recommended_kind == "modified_prandtl_ishlinskii"
    assert trained_kinds.remarks == ("ANFIS: the training did not converge",)


def test_too_few_known_rows_are_refused(robot, bent_run):
    with pytest.raises(CompensationError, match="fewer than 500 rows are left to train on"):
        train(robot, [replace(bent_run, first=3800)])


def test_a_record_outside_the_trained_range_is_refused(trained, bent_run):
    far = replace(bent_run, position=bent_run.position + 1.0)
    with pytest.raises(CompensationError, match="no row lies within"):
        compute_residual(trained.models["anfis"], [(far, 0)])


def test_rows_outside_the_trained_range_are_ignored_and_counted(trained, bent_run):
    model = replace(trained.models["linear"], desired_range=(20e-6, 30e-6))
    residual = compute_residual(model, [(bent_run, 0)])
    inside = (bent_run.position > 20e-6) & (bent_run.position < 30e-6)
    assert residual.beyond == pytest.approx(1.0 - inside.mean(), abs=1e-3)


def make_residual(rms):
    return InverseResidual(rms, rms, rms, rms, rms**2, 0.0, 0.0)


def test_the_best_kind_is_recommended_and_the_simpler_among_equals():
    residuals = dict(zip(INVERSE_KINDS, map(make_residual, (1.0, 2.0, 3.0, 9.0)), strict=True))
    assert recommend_kind(residuals, one_size=False) == "anfis"
    residuals["modified_prandtl_ishlinskii"] = make_residual(1.01)
    kind = recommend_kind(residuals, one_size=False)
    assert kind == "modified_prandtl_ishlinskii"
    assert "simplest kind whose residual is within 2 % of the smallest" in explain_recommendation(
        residuals, kind
    )
    residuals["modified_prandtl_ishlinskii"] = make_residual(0.5)
    assert recommend_kind(residuals, one_size=False) == "modified_prandtl_ishlinskii"


def test_swings_of_one_size_recommend_no_kind_with_a_bend():
    residuals = dict(zip(INVERSE_KINDS, map(make_residual, (1.0, 2.0, 3.0, 9.0)), strict=True))
    kind = recommend_kind(residuals, one_size=True)
    assert kind == "prandtl_ishlinskii"
    assert "All swings have one size" in explain_recommendation(residuals, kind)


def test_a_lag_and_creep_are_found(robot, bent_run):
    rows = np.arange(len(bent_run.command), dtype=float)
    delayed = np.interp(rows - 3.0, rows, bent_run.position)
    position, weight, relaxed = np.empty_like(delayed), 0.05, delayed[0]
    for k, target in enumerate(delayed):
        position[k] = target + weight * (relaxed - delayed[0])
        relaxed += 1e-3 * (target - relaxed)
    run = TrainingSamples("made", "zn", "m", 1e-3, bent_run.command, position)
    trained_kinds = train(robot, [run], settings=anfis.AnfisSettings(epochs=2))
    model = trained_kinds.models[trained_kinds.recommended_kind]
    assert model.lag_s == pytest.approx(3.52e-3, abs=3e-4)
    assert 0.01 < model.creep_weights.sum() < weight  # the record lasts only 4 s
    assert trained_kinds.residuals[trained_kinds.recommended_kind].share < 3e-3
