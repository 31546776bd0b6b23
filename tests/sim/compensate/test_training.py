"""Training, judging and recommending."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate import anfis, training
from rotemina.sim.compensate.errors import CompensationError, ConvergenceError
from rotemina.sim.compensate.inverse_parameters import KINDS
from rotemina.sim.compensate.judgement import Residual, reason, recommended, residual
from rotemina.sim.compensate.samples import Samples
from rotemina.sim.compensate.training import train


def part(run, rows):
    return replace(run, command=run.command[rows], position=run.position[rows])


def test_all_kinds_are_judged_and_those_that_know_the_bend_leave_less(trained):
    assert tuple(trained.models) == KINDS
    share = {kind: one.share for kind, one in trained.residuals.items()}
    assert share["anfis"] < 2e-3
    assert share["modified_prandtl_ishlinskii"] < 2e-3
    assert share["prandtl_ishlinskii"] > 3.0 * share["anfis"]
    assert share["linear"] > 1.5 * share["prandtl_ishlinskii"]
    assert trained.chosen in ("anfis", "modified_prandtl_ishlinskii")
    assert "on rows that no inverse was trained on" in trained.why


def test_no_row_that_judges_is_learned_from(robot, bent_run):
    """Rows at the end that are nonsense spoil the judgement and no inverse."""
    last = int(0.9 * len(bent_run.command))
    position = bent_run.position.copy()
    position[last:] = position[last]
    settings = anfis.Settings(epochs=1)
    clean = train(robot, [bent_run], settings=settings)
    spoilt = train(robot, [replace(bent_run, position=position)], settings=settings)
    for kind, model in clean.models.items():
        assert spoilt.models[kind].consequents.tolist() == model.consequents.tolist()
        assert spoilt.residuals[kind].rms > 1.5 * clean.residuals[kind].rms


def test_the_listener_hears_the_share_grow(robot, bent_run):
    heard = []
    train(
        robot,
        [bent_run],
        settings=anfis.Settings(epochs=2),
        listener=lambda what, share: heard.append((what, share)),
    )
    shares = [share for _, share in heard]
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert any(what.startswith("ANFIS, epoch 2") for what, _ in heard)


def test_an_anfis_that_does_not_converge_leaves_the_others(robot, bent_run, monkeypatch):
    def fail(*_given):
        raise ConvergenceError("ANFIS: the training did not converge")

    monkeypatch.setattr(training.anfis, "train", fail)
    found = train(robot, [bent_run])
    assert "anfis" not in found.models
    assert found.chosen == "modified_prandtl_ishlinskii"
    assert found.remarks == ("ANFIS: the training did not converge",)


def test_too_few_known_rows_are_refused(robot, bent_run):
    with pytest.raises(CompensationError, match="fewer than 500 rows are left to train on"):
        train(robot, [replace(bent_run, first=3800)])


def test_a_record_wholly_beyond_what_was_seen_is_refused(trained, bent_run):
    far = replace(bent_run, position=bent_run.position + 1.0)
    with pytest.raises(CompensationError, match="no row lies within"):
        residual(trained.models["anfis"], [(far, 0)])


def test_rows_beyond_are_left_aside_and_counted(trained, bent_run):
    model = replace(trained.models["linear"], desired_range=(20e-6, 30e-6))
    found = residual(model, [(bent_run, 0)])
    inside = (bent_run.position > 20e-6) & (bent_run.position < 30e-6)
    assert found.beyond == pytest.approx(1.0 - inside.mean(), abs=1e-3)


def left(rms):
    return Residual(rms, rms, rms, rms, rms**2, 0.0, 0.0)


def test_the_better_is_recommended_and_among_equals_the_simpler():
    figures = dict(zip(KINDS, map(left, (1.0, 2.0, 3.0, 9.0)), strict=True))
    assert recommended(figures, one_size=False) == "anfis"
    figures["modified_prandtl_ishlinskii"] = left(1.01)
    kind = recommended(figures, one_size=False)
    assert kind == "modified_prandtl_ishlinskii"
    assert "simplest of those within 2 % of the least" in reason(figures, kind)
    figures["modified_prandtl_ishlinskii"] = left(0.5)
    assert recommended(figures, one_size=False) == "modified_prandtl_ishlinskii"


def test_of_swings_of_one_size_no_rich_kind_is_recommended():
    figures = dict(zip(KINDS, map(left, (1.0, 2.0, 3.0, 9.0)), strict=True))
    kind = recommended(figures, one_size=True)
    assert kind == "prandtl_ishlinskii"
    assert "All swings have one size" in reason(figures, kind)


def test_a_lag_and_creep_are_found(robot, bent_run):
    rows = np.arange(len(bent_run.command), dtype=float)
    late = np.interp(rows - 3.0, rows, bent_run.position)
    crept, weight, relaxed = np.empty_like(late), 0.05, late[0]
    for k, value in enumerate(late):
        crept[k] = value + weight * (relaxed - late[0])
        relaxed += 1e-3 * (value - relaxed)
    run = Samples("made", "zn", "m", 1e-3, bent_run.command, crept)
    found = train(robot, [run], settings=anfis.Settings(epochs=2))
    model = found.models[found.chosen]
    assert model.lag_s == pytest.approx(3.52e-3, abs=3e-4)
    assert 0.01 < model.creep_weights.sum() < weight  # of a record of 4 s alone
    assert found.residuals[found.chosen].share < 3e-3
