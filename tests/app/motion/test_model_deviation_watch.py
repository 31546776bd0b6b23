"""The watch on the gap between model and machine."""

import numpy as np
import pytest

from rotemina.app.motion.model_deviation_watch import DeviationWatch
from rotemina.drivers.samples import Samples
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)


def samples(deviation, begin_s=0.0, axis="x"):
    """One sample a millisecond, with these deviations of one axis."""
    count = len(deviation)
    table = np.zeros((count, len(AXES)))
    measured = table.copy()
    measured[:, AXES.index(axis)] = deviation
    times = begin_s + 1e-3 * np.arange(1, count + 1)
    return Samples(
        times, table, measured, np.full(table.shape, np.nan), np.zeros(count, int)
    ), table


def test_it_tells_root_mean_square_and_peak_over_all_portions():
    watch = DeviationWatch(ROBOT)
    rng = np.random.default_rng(1)
    values = rng.normal(size=300) * 1e-6
    for number, part in enumerate(np.split(values, 3)):
        assert watch.add(*samples(part, 0.1 * number)) is None
    assert watch.gaps["x"].rms == pytest.approx(np.sqrt(np.mean(values**2)))
    assert watch.gaps["x"].peak == pytest.approx(np.abs(values).max())
    assert watch.gaps["zn"].peak == 0.0


def test_nothing_is_told_before_the_first_sample():
    assert DeviationWatch(ROBOT).gaps == {}


def test_a_deviation_that_lasts_is_told_with_axis_value_and_bound():
    watch = DeviationWatch(ROBOT, {"x": 5e-6})
    excess = watch.add(*samples([0.0] * 10 + [7e-6] * 30))
    assert excess is not None
    assert "axis x deviates from the model by 7 µm" in excess
    assert "the bound is 5 µm" in excess


def test_it_counts_over_portions_and_starts_anew_within_the_bound():
    watch = DeviationWatch(ROBOT, {"x": 5e-6})
    assert watch.add(*samples([7e-6] * 15)) is None
    assert watch.add(*samples([0.0] + [7e-6] * 18, 0.015)) is None  # the first spell has ended
    assert watch.add(*samples([7e-6] * 5, 0.034)) is not None


def test_outliers_and_axes_without_a_bound_stop_nothing():
    watch = DeviationWatch(ROBOT, {"x": 5e-6})
    assert watch.add(*samples([0.0, 1.0, 0.0] * 50)) is None
    assert watch.add(*samples([1.0] * 100, 1.0, axis="y")) is None


@pytest.mark.parametrize(
    ("bounds", "words"),
    [
        ({"w": 1e-6}, "no axis 'w'"),
        ({"x": 0.0}, "above 0"),
        ({"x": float("nan")}, "above 0"),
    ],
)
def test_bounds_that_are_none_are_refused(bounds, words):
    with pytest.raises(InputError, match=words):
        DeviationWatch(ROBOT, bounds)
