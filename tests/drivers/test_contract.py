"""The contract, run over every installed driver that lives on a clock set by hand."""

import threading

import numpy as np
import pytest

from rotemina.drivers.abilities import TrajectoryPlayer
from rotemina.drivers.errors import DriverError, LimitError, StateError
from rotemina.drivers.registry import discover_drivers
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.drivers.settings import SettingError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOTS = {name: load_robot(name) for name in ("rotemina", "emps", "fsm", "picma")}
DRIVERS = {n: found for n, found in discover_drivers().found.items() if found.virtual_time}
PLAYERS = {n: found for n, found in DRIVERS.items() if issubclass(found, TrajectoryPlayer)}


@pytest.fixture(params=sorted(DRIVERS))
def make(request, clock):
    return lambda robot="rotemina", **settings: DRIVERS[request.param](
        ROBOTS[robot], settings, clock=clock
    )


@pytest.fixture
def driver(make):
    opened = make()
    opened.open()
    yield opened
    opened.close()


def read_until(driver, clock, *states, step_s=0.05, limit_s=60.0):
    """Let time pass until the device is in one of the states; return what was sampled."""
    parts = [driver.read()]
    for _ in range(round(limit_s / step_s)):
        if driver.status().state in states:
            return Samples.joined(parts, len(driver.axes))
        clock.advance(step_s)
        parts.append(driver.read())
    raise AssertionError(f"still {driver.status()} after {limit_s} s")


def there_and_back(axis, start, distance, unit="m", rate_hz=1000.0, duration_s=1.0):
    """A smooth trajectory, from rest to rest."""
    time_s = np.arange(round(duration_s * rate_hz) + 1) / rate_hz
    command = start + 0.5 * distance * (1 - np.cos(2 * np.pi * time_s / duration_s))
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit})


def test_there_is_a_driver_to_test():
    assert "simulator" in PLAYERS
    assert discover_drivers().broken == {}


def test_making_a_driver_touches_nothing(make):
    driver = make()
    assert driver.status().state is DeviceState.CLOSED


def test_an_unknown_setting_is_named(make):
    with pytest.raises(SettingError, match="velocity_of_light"):
        make(velocity_of_light=3e8)


def test_settings_take_the_type_of_their_default(make):
    driver = make()
    for name, default in driver.default_settings.items():
        assert driver.settings[name] == default
        with pytest.raises(SettingError, match=name):
            make(**{name: ["no", "scalar"]})


def test_closed_refuses_all_but_stop_and_close(make):
    driver = make()
    for request in (driver.read, driver.clear_fault, lambda: driver.move_to({"x": 0.01})):
        with pytest.raises(StateError, match="open it first"):
            request()
    driver.stop()
    driver.close()
    driver.close()
    driver.stop()


def test_opening_twice_is_refused_and_reopening_is_not(driver):
    with pytest.raises(StateError, match="open already"):
        driver.open()
    driver.close()
    driver.open()
    assert driver.status().state is DeviceState.IDLE


@pytest.mark.parametrize("robot", ROBOTS)
def test_it_opens_at_rest_inside_the_range_and_holds(make, clock, robot):
    driver = make(robot)
    driver.open()
    clock.advance(0.5)
    samples = driver.read()
    assert len(samples) > 10
    assert driver.status().state is DeviceState.IDLE
    assert (samples.command == samples.command[0]).all()
    for column, axis in enumerate(ROBOTS[robot].axes.values()):
        assert axis.range[0] <= samples.command[0, column] <= axis.range[1]
        still = np.ptp(samples.measured[:, column])
        assert still <= 5e-3 * axis.span
    driver.close()


def test_samples_follow_one_another_and_belong_to_no_trajectory(driver, clock):
    clock.advance(0.1)
    first = driver.read()
    assert len(driver.read()) == 0
    clock.advance(0.1)
    second = driver.read()
    assert first.device_time_s[-1] < second.device_time_s[0]
    assert (second.playback_row == -1).all()
    assert not second.command.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        second.measured[0, 0] = 0.0


def test_a_move_arrives_exactly_and_within_the_limits(driver, clock):
    driver.move_to({"x": 0.0300000001, "zn": 10e-6})
    clock.advance(0.05)
    driver.read()
    assert driver.status().state is DeviceState.MOVING
    samples = read_until(driver, clock, DeviceState.IDLE)
    assert samples.command[-1, 0] == 0.0300000001
    assert samples.command[-1, 5] == 10e-6
    clock.advance(0.5)
    settled = driver.read()
    assert abs(settled.measured[-1, 0] - 0.03) < 1e-6


def test_no_axis_moves_when_one_target_is_beyond(driver, clock):
    before = driver.read().command[-1]
    with pytest.raises(LimitError, match="axis y"):
        driver.move_to({"x": 0.03, "y": 0.056})
    with pytest.raises(LimitError, match="no such axis"):
        driver.move_to({"x": 0.03, "elbow": 0.0})
    with pytest.raises(LimitError, match="finite"):
        driver.move_to({"x": float("nan")})
    clock.advance(0.2)
    assert (driver.read().command == before).all()
    assert isinstance(LimitError("too far"), (DriverError, ValueError))


def test_stop_in_mid_move_holds_within_the_stopping_distance(driver, clock):
    axis = ROBOTS["rotemina"].axes["x"]
    driver.move_to({"x": 0.05})
    clock.advance(0.5)
    at = driver.read().command[-1, 0]
    driver.stop()
    samples = read_until(driver, clock, DeviceState.IDLE, step_s=0.01)
    distance = samples.command[-1, 0] - at
    tick_s = float(np.diff(samples.device_time_s).min())
    braking = axis.max_speed**2 / (2 * axis.max_acceleration)
    assert 0 < distance <= braking + axis.max_speed * tick_s
    clock.advance(1.0)
    assert (driver.read().command[:, 0] == samples.command[-1, 0]).all()


def test_stop_takes_effect_when_it_was_called_not_when_it_was_read(driver, clock):
    driver.move_to({"x": 0.05})
    clock.advance(0.5)
    stopper = threading.Thread(target=driver.stop)
    stopper.start()
    stopper.join()
    clock.advance(2.0)
    samples = driver.read()
    moved = np.flatnonzero(np.diff(samples.command[:, 0]))
    since_open = samples.device_time_s[moved[-1] + 1] - samples.device_time_s[0]
    assert since_open < 0.56
    assert driver.status().state is DeviceState.IDLE


def test_stop_before_a_move_does_not_undo_it(driver, clock):
    driver.stop()
    clock.advance(0.01)
    driver.move_to({"x": 0.03})
    read_until(driver, clock, DeviceState.IDLE)
    clock.advance(0.1)
    assert driver.read().command[-1, 0] == 0.03


def test_clearing_no_fault_does_nothing(driver, clock):
    driver.clear_fault()
    clock.advance(0.01)
    assert len(driver.read()) > 0


@pytest.fixture(params=sorted(PLAYERS))
def player(request, clock):
    opened = PLAYERS[request.param](ROBOTS["rotemina"], {}, clock=clock)
    opened.open()
    yield opened
    opened.close()


def test_playing_names_every_row_once_and_in_order(player, clock):
    trajectory = there_and_back("x", 0.02, 1e-3)
    player.play(trajectory)
    assert player.status().state is DeviceState.PLAYING
    samples = read_until(player, clock, DeviceState.IDLE, DeviceState.MOVING)
    own = samples.playback_row >= 0
    np.testing.assert_array_equal(samples.playback_row[own], np.arange(len(trajectory.time_s)))
    np.testing.assert_array_equal(samples.command[own, 0], trajectory.signal("x", Tap.CMD))
    since = samples.device_time_s[own] - samples.device_time_s[own][0]
    np.testing.assert_allclose(since, trajectory.time_s, atol=1e-9)
    assert player.status().progress == 1.0
    others = samples.command[:, 1:]
    assert (others == others[0]).all()


def test_a_player_refuses_what_breaks_a_limit(player, clock):
    with pytest.raises(LimitError, match="speed"):
        player.play(there_and_back("x", 0.02, 0.02))
    with pytest.raises(LimitError, match="elbow"):
        player.play(there_and_back("elbow", 0.02, 0.02))
    assert player.status().state is DeviceState.IDLE


def test_a_player_has_one_owner(player, clock):
    player.move_to({"x": 0.03})
    clock.advance(0.1)
    player.read()
    with pytest.raises(StateError, match="moving"):
        player.play(there_and_back("x", 0.02, 1e-3))
    read_until(player, clock, DeviceState.IDLE)
    player.play(there_and_back("x", 0.02, 1e-3))
    with pytest.raises(StateError, match="playing"):
        player.play(there_and_back("x", 0.02, 1e-3))
    with pytest.raises(StateError, match="playing"):
        player.move_to({"y": 0.02})


@pytest.mark.parametrize("after_s", [0.2, 1.0, 1.55])
def test_stop_ends_a_trajectory_in_any_phase(player, clock, after_s):
    player.play(there_and_back("x", 0.03, 2e-3))
    clock.advance(after_s)
    player.read()
    assert player.status().state is DeviceState.PLAYING
    player.stop()
    samples = read_until(player, clock, DeviceState.IDLE, step_s=0.01)
    clock.advance(2.0)
    assert (player.read().command == samples.command[-1]).all()
    assert player.status().progress < 1.0
    player.move_to({"x": 0.02})
