"""Which effects records can show, and which motion would show the others."""

import numpy as np
import pytest

from rotemina.sim.errors import GapError
from rotemina.sim.gap.experiment import MIN_VISIBLE_FLOORS, find_visible_effects
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
RATE_HZ = 500.0
TIME_S = np.arange(round(6.0 * RATE_HZ)) / RATE_HZ


def record_motion(share, time_s=TIME_S):
    """Return a healthy record of zn: its motion (n,) about the centre is a share of its range."""
    model = ROBOT.axes["zn"]
    command = sum(model.range) / 2 + model.span * share
    commands = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": model.unit})
    return simulate(ROBOT, (), commands, np.random.default_rng(0))


def list_visible(*records):
    visibility = find_visible_effects(ROBOT, "zn", records)
    return {item.effect: item for item in visibility.effects}


@pytest.fixture(scope="module")
def sweep():
    return list_visible(record_motion(0.1 * np.sin(np.pi * TIME_S) * np.linspace(0.2, 1.0, 3000)))


def test_an_axis_at_rest_shows_no_effect_of_motion_but_a_motion_that_would():
    effects = list_visible(record_motion(0.0 * TIME_S), record_motion(1e-7 * np.sin(TIME_S)))
    assert not any(
        item.is_visible
        for name, item in effects.items()
        if name in ("hysteresis", "delay", "gain_error", "static_nonlinearity", "creep")
    )


def test_a_sweep_about_the_centre_shows_hysteresis_and_gain_but_no_contact_at_an_end(sweep):
    assert sweep["hysteresis"].is_visible
    assert sweep["gain_error"].is_visible
    assert not sweep["contact"].is_visible


def test_a_hidden_effect_has_a_motion_that_shows_it(sweep):
    hidden = [item for item in sweep.values() if item.test is not None]
    assert "contact" in {item.effect for item in hidden}
    for item in hidden:
        assert item.floors < MIN_VISIBLE_FLOORS <= item.test_floors
        command = item.test.record.signal("zn", Tap.CMD)
        low, high = ROBOT.axes["zn"].range
        assert low <= command.min() < command.max() <= high


def test_a_fast_motion_shows_a_delay_that_a_slow_one_hides():
    slow, fast = (
        list_visible(record_motion(0.2 * np.sin(2 * np.pi * rate_hz * TIME_S)))["delay"].floors
        for rate_hz in (0.05, 5.0)
    )
    assert slow < MIN_VISIBLE_FLOORS < fast
    # A delay shows in proportion to the speed, here 100 times as large.
    assert fast / slow == pytest.approx(100.0, rel=0.5)


def test_random_effects_are_listed_apart():
    visibility = find_visible_effects(ROBOT, "zn", [record_motion(0.1 * np.sin(TIME_S))])
    assert {"sensor_noise", "sensor_outliers"} <= set(visibility.random_effects)
    assert not set(visibility.random_effects) & {item.effect for item in visibility.effects}


def test_a_long_record_is_cut_and_shows_the_same():
    whole, cut = (
        list_visible(record_motion(0.3 * np.sin(np.pi * time_s), time_s))["hysteresis"].floors
        for time_s in (np.arange(rows) / RATE_HZ for rows in (60_000, 120_000))
    )
    assert cut == pytest.approx(whole, rel=0.05)


def test_records_without_a_measured_channel_are_refused():
    commands = Record.from_signals(TIME_S, {("zn", Tap.CMD): 1e-5 * TIME_S}, {"zn": "m"})
    with pytest.raises(GapError, match="no record holds a measured channel"):
        find_visible_effects(ROBOT, "zn", [commands])
