"""Commands of the cases: rich, within the machine's limits, and as long as real records."""

import numpy as np
import pytest

from rotemina.sim.blind.excitation import draw_held_out, draw_poor_training, draw_training
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
STAGES = [("x", "y", "z"), ("thx", "thy", "zn")]


@pytest.mark.parametrize("names", STAGES)
@pytest.mark.parametrize("seed", [0, 4])
def test_training_is_long_rich_and_within_limits(names, seed):
    records = draw_training(ROBOT, names, np.random.default_rng(seed))
    assert len(records) == 3
    for commands in records:
        assert 500.0 <= 1.0 / commands.step_s <= 2000.0
        assert 6.0 <= len(commands.values) * commands.step_s <= 30.0
        for i, name in enumerate(names):
            axis, values = ROBOT.axes[name], commands.values[:, i]
            assert axis.range[0] <= values.min() < values.max() <= axis.range[1]
            if axis.kind == "stepper":
                assert np.abs(np.diff(values)).max() / commands.step_s < axis.max_speed
    # Axes that move alike in one record do not in another, so the source of a coupling shows.
    correlations = [
        np.abs(np.corrcoef(commands.values.T))[np.triu_indices(3, 1)] for commands in records
    ]
    assert np.all(np.min(correlations, axis=0) < 0.8)


@pytest.mark.parametrize("names", STAGES)
def test_poor_training_is_one_small_motion(names):
    for step in (False, True):
        (record,) = draw_poor_training(ROBOT, names, np.random.default_rng(1), step=step)
        for i, name in enumerate(names):
            assert np.ptp(record.values[:, i]) < 0.15 * ROBOT.axes[name].span
        assert (len(np.unique(record.values[:, 0])) == 2) == step


@pytest.mark.parametrize("names", STAGES)
def test_the_held_out_record_stays_within_the_training_range_and_exercises_the_axes_first(names):
    rng = np.random.default_rng(3)
    limits = {n: np.array([0.4, 0.5]) * ROBOT.axes[n].span + ROBOT.axes[n].range[0] for n in names}
    commands = draw_held_out(ROBOT, names, limits, rng)
    first_second = commands.values[: round(1.0 / commands.step_s)]
    for i, name in enumerate(names):
        low, high = limits[name]
        slack = 0.05 * (high - low)
        assert low - slack <= commands.values[:, i].min()
        assert commands.values[:, i].max() <= high + slack
        assert np.ptp(first_second[:, i]) > 0.25 * (high - low)
