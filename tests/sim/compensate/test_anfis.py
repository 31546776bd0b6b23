"""The neuro-fuzzy system: its gradient, functions it can learn, and its error if it cannot."""

import numpy as np
import pytest

from rotemina.sim.compensate import Inverse, anfis
from rotemina.sim.compensate.anfis import AnfisSettings, train
from rotemina.sim.errors import ConvergenceError

RADII = np.array([0.1, 0.3])


def make_rows(count=600, seed=0):
    rng = np.random.default_rng(seed)
    z = rng.uniform(0.0, 1.0, count)
    stops = rng.uniform(-1.0, 1.0, (count, 2)) * RADII
    return np.column_stack([np.ones(count), z, stops])


def mark_validation_rows(count=600):
    return np.arange(count) % 5 == 2


def test_the_gradient_matches_finite_differences_of_the_error():
    columns = make_rows()
    inputs = np.column_stack([columns[:, 1], columns[:, 3] / RADII[1]])
    goals = np.sin(3.0 * columns[:, 1]) + columns[:, 3] * columns[:, 1]
    table = anfis._TrainingRows(columns, inputs, goals)
    grid = anfis._spread_memberships(inputs, 3)
    consequents = np.random.default_rng(1).normal(size=(9, 4))
    gradient = anfis._compute_gradient(table, grid, consequents)
    for index in [(0, 0, 1), (0, 1, 2), (1, 0, 0), (1, 1, 1)]:
        offset = np.zeros_like(grid)
        offset[index] = 1e-6
        error_above, error_below = (
            anfis._rms(table, grid + sign * offset, consequents) ** 2 for sign in (1.0, -1.0)
        )
        assert gradient[index] == pytest.approx(
            (error_above - error_below) / 2e-6, rel=1e-5, abs=1e-9
        )


def test_anfis_learns_a_slope_that_changes_along_the_range():
    columns = make_rows(3000)
    goals = columns[:, 1] ** 3 - (0.2 + columns[:, 1] ** 2) * columns[:, 3]
    fit = train(columns, RADII, goals, mark_validation_rows(3000), AnfisSettings(5, (), 20))
    unseen = make_rows(500, seed=7)
    true_commands = unseen[:, 1] ** 3 - (0.2 + unseen[:, 1] ** 2) * unseen[:, 3]
    table = anfis._TrainingRows(unseen, unseen[:, 1:2], true_commands)
    grid = np.stack([fit.premises.centres, fit.premises.widths])
    assert anfis._rms(table, grid, fit.consequents) < 1e-3
    # Moving the memberships also reduces the error of the validation rows.
    assert fit.history[:, 1].min() < fit.history[0, 1]


def test_kernel_and_training_infer_the_same_commands(make_inverse_model):
    columns = make_rows(400)
    goals = columns[:, 1] ** 2 + 0.3 * columns[:, 2]
    fit = train(columns, RADII, goals, mark_validation_rows(400), AnfisSettings(3, (0.5,), 3))
    z = np.linspace(0.0, 1.0, 50)  # rising, so plays are at z − r or still at rest
    model = make_inverse_model(
        kind="anfis",
        sample_s=1.0,
        span=1.0,
        desired_range=(0.0, 1.0),
        command_range=(-9.0, 9.0),
        speed=9.0,
        consequents=fit.consequents,
        radii=RADII,
        premises=fit.premises,
    )
    stops = np.minimum(z[:, None], RADII)
    columns_of_rise = np.column_stack([np.ones(50), z, stops])
    inputs = np.column_stack([z, stops[:, 1] / RADII[1]])
    grid = np.stack([fit.premises.centres, fit.premises.widths])
    expected = anfis._infer_commands(
        anfis._TrainingRows(columns_of_rise, inputs, z), grid, fit.consequents
    )
    assert Inverse(model, 1.0).run(z) == pytest.approx(expected, abs=1e-12)


def test_a_training_that_does_not_converge_is_an_error():
    columns = make_rows()
    columns[:, 1:] = 0.0  # positions that contain no information about the command
    goals = np.random.default_rng(3).normal(size=600)
    with pytest.raises(ConvergenceError, match=r"did not converge.*nothing was replaced"):
        train(columns, RADII, goals, mark_validation_rows(), AnfisSettings(3, (), 5))
