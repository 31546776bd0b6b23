"""The neuro-fuzzy system: its gradient, what it can learn, and what it says when it cannot."""

import numpy as np
import pytest

from rotemina.sim.compensate import anfis
from rotemina.sim.compensate.anfis import Settings, train
from rotemina.sim.compensate.errors import ConvergenceError
from rotemina.sim.compensate.inverse import Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel

RADII = np.array([0.1, 0.3])


def rows(count=600, seed=0):
    rng = np.random.default_rng(seed)
    z = rng.uniform(0.0, 1.0, count)
    stops = rng.uniform(-1.0, 1.0, (count, 2)) * RADII
    return np.column_stack([np.ones(count), z, stops])


def validation(count=600):
    return np.arange(count) % 5 == 2


def test_the_gradient_is_that_of_the_error():
    columns = rows()
    inputs = np.column_stack([columns[:, 1], columns[:, 3] / RADII[1]])
    goals = np.sin(3.0 * columns[:, 1]) + columns[:, 3] * columns[:, 1]
    table = anfis._Rows(columns, inputs, goals)
    grid = anfis._spread(inputs, 3)
    consequents = np.random.default_rng(1).normal(size=(9, 4))
    found = anfis._gradient(table, grid, consequents)
    for place in [(0, 0, 1), (0, 1, 2), (1, 0, 0), (1, 1, 1)]:
        apart = np.zeros_like(grid)
        apart[place] = 1e-6
        up, down = (anfis._rms(table, grid + s * apart, consequents) ** 2 for s in (1.0, -1.0))
        assert found[place] == pytest.approx((up - down) / 2e-6, rel=1e-5, abs=1e-9)


def test_it_learns_a_slope_that_changes_along_the_range():
    columns = rows(3000)
    goals = columns[:, 1] ** 3 - (0.2 + columns[:, 1] ** 2) * columns[:, 3]
    found = train(columns, RADII, goals, validation(3000), Settings(5, (), 20))
    unseen = rows(500, seed=7)
    true = unseen[:, 1] ** 3 - (0.2 + unseen[:, 1] ** 2) * unseen[:, 3]
    table = anfis._Rows(unseen, unseen[:, 1:2], true)
    grid = np.stack([found.premises.centres, found.premises.widths])
    assert anfis._rms(table, grid, found.consequents) < 1e-3
    # Moving the memberships helps the rows that none was fitted to.
    assert found.history[:, 1].min() < found.history[0, 1]


def test_kernel_and_training_infer_the_same():
    columns = rows(400)
    goals = columns[:, 1] ** 2 + 0.3 * columns[:, 2]
    found = train(columns, RADII, goals, validation(400), Settings(3, (0.5,), 3))
    z = np.linspace(0.0, 1.0, 50)  # a rise: plays at z − r, or still at rest
    model = InverseModel(
        axis="p",
        unit="m",
        kind="anfis",
        sample_s=1.0,
        origin=0.0,
        command_origin=0.0,
        span=1.0,
        desired_range=(0.0, 1.0),
        command_range=(-9.0, 9.0),
        speed=9.0,
        consequents=found.consequents,
        radii=RADII,
        initial=np.zeros(2),
        premises=found.premises,
    )
    stops = np.minimum(z[:, None], RADII)
    given = np.column_stack([np.ones(50), z, stops])
    inputs = np.column_stack([z, stops[:, 1] / RADII[1]])
    grid = np.stack([found.premises.centres, found.premises.widths])
    right = anfis._answers(anfis._Rows(given, inputs, z), grid, found.consequents)
    assert Inverse(model, 1.0).run(z) == pytest.approx(right, abs=1e-12)


def test_a_training_that_does_not_converge_says_so():
    columns = rows()
    columns[:, 1:] = 0.0  # positions that say nothing of the command
    goals = np.random.default_rng(3).normal(size=600)
    with pytest.raises(ConvergenceError, match=r"did not converge.*nothing was replaced"):
        train(columns, RADII, goals, validation(), Settings(3, (), 5))
