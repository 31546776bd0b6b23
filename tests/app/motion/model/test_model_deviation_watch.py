"""Monitoring of the gap between model and machine."""

import numpy as np
import pytest

from rotemina.app.motion.model import DeviationWatch
from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.errors import InputError
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)


def make_samples(deviation, begin_s=0.0, axis="x"):
    """Return one sample per millisecond, with these deviations of one axis."""
    count = len(deviation)
    table = np.zeros((count, len(AXES)))
    measured = table.copy()
    measured[:, AXES.index(axis)] = deviation
    times = begin_s + 1e-3 * np.arange(1, count + 1)
    return DeviceSamples(
        times, table, measured, np.full(table.shape, np.nan), np.zeros(count, int)
    ), table


def test_it_reports_root_mean_square_and_peak_over_all_portions():
    watch = DeviationWatch(ROBOT)
    rng = np.random.default_rng(1)
    values = rng.normal(size=300) * 1e-6
    for number, portion in enumerate(np.split(values, 3)):
        assert watch.add(*make_samples(portion, 0.1 * number)) is None
    assert watch.gaps["x"].rms == pytest.approx(np.sqrt(np.mean(values**2)))
    assert watch.gaps["x"].peak == pytest.approx(np.abs(values).max())
    assert watch.gaps["zn"].peak == 0.0


def test_a_lasting_deviation_is_reported_and_counted_over_portions():
    watch = DeviationWatch(ROBOT, {"x": 5e-6})
    assert watch.add(*make_samples([7e-6] * 15)) is None
    # The first deviation has ended.
    assert watch.add(*make_samples([0.0] + [7e-6] * 18, 0.015)) is None
    excess = watch.add(*make_samples([7e-6] * 5, 0.034))
    assert "axis x deviates from the model by 7 µm" in excess
    assert "the bound is 5 µm" in excess


def test_outliers_and_axes_without_a_bound_stop_nothing():
    watch = DeviationWatch(ROBOT, {"x": 5e-6})
    assert watch.add(*make_samples([0.0, 1.0, 0.0] * 50)) is None
    assert watch.add(*make_samples([1.0] * 100, 1.0, axis="y")) is None


@pytest.mark.parametrize(
    ("bounds", "message"),
    [
        ({"w": 1e-6}, "no axis 'w'"),
        ({"x": 0.0}, "above 0"),
        ({"x": float("nan")}, "above 0"),
    ],
)
def test_invalid_bounds_are_refused(bounds, message):
    with pytest.raises(InputError, match=message):
        DeviationWatch(ROBOT, bounds)
