"""What the simulator can do beside moves and trajectories, in figures that are its own."""

import numpy as np
import pytest

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")


def opened(robot=ROBOT, **given):
    clock = VirtualClock(77.0)
    driver = Simulator(robot, given, clock=clock)
    driver.open()
    return driver, clock


def test_a_move_arrives_at_the_very_number():
    driver, clock = opened()
    driver.move_to({"x": 0.0300000001, "zn": 10e-6})
    clock.advance(2.0)
    assert driver.read().command[-1, [0, 5]].tolist() == [0.0300000001, 10e-6]


def test_homing_goes_to_the_low_end_at_half_speed_and_then_knows():
    driver, clock = opened(start_homed=False, start_fraction=0.1)
    assert driver.status().unhomed == ("x", "y", "z")
    with pytest.raises(StateError, match="x, y, z is unknown; home first"):
        driver.move_to({"thx": 1e-4})
    driver.home(["x", "z"])
    assert driver.status().state is DeviceState.HOMING
    clock.advance(5.0)
    command = driver.read().command
    assert command[-1, [0, 2]].tolist() == [0.0, 0.0]
    assert np.abs(np.diff(command[:, 0])).max() == pytest.approx(0.005 * 1e-3)
    assert driver.status().unhomed == ("y",)
    driver.home(["y"])
    clock.advance(5.0)
    driver.read()
    assert driver.status().position_known
    driver.move_to({"x": 0.001})


def test_a_search_that_is_stopped_or_closed_leaves_the_position_unknown():
    driver, clock = opened()
    driver.home(["x"])
    clock.advance(0.5)
    driver.stop()
    clock.advance(0.5)
    driver.read()
    assert driver.status().state is DeviceState.IDLE
    assert driver.status().unhomed == ("x",)
    driver.home(["x"])
    driver.close()
    driver.open()
    assert driver.status().unhomed == ("x",)
    assert driver.status().state is DeviceState.IDLE


def test_a_piezo_has_no_switch():
    driver, _ = opened()
    with pytest.raises(LimitError, match="'zn' has no limit switch"):
        driver.home(["zn"])


def test_a_voltage_is_what_the_amplifier_puts_out():
    driver, clock = opened()
    driver.set_voltage("zn", 20.0)
    clock.advance(1.0)
    samples = driver.read()
    assert np.abs(np.diff(samples.inputs[:, 5])).max() <= 130.0 * 1e-3 * (1 + 1e-9)  # in 1 ms
    assert samples.inputs[-1, 5] == pytest.approx(20.0)
    assert samples.command[-1, 5] == pytest.approx(10e-6)
    assert np.abs(np.diff(samples.command[:, 5])).max() <= 5.0e-3 * 1e-3 * (1 + 1e-9)


@pytest.mark.parametrize(
    ("robot", "axis", "voltage", "named"),
    [
        ("rotemina", "zn", 131.0, "0 to 130 V"),
        ("rotemina", "x", 1.0, "no amplifier"),
        ("fsm", "m1", 1.95, "outside its range"),
        ("emps", "q", 1.0, "controller"),
    ],
)
def test_a_voltage_that_cannot_be_is_refused(robot, axis, voltage, named):
    driver, _ = opened(load_robot(robot))
    with pytest.raises(LimitError, match=named):
        driver.set_voltage(axis, voltage)


@pytest.mark.parametrize("rate_hz", [1000.0, 400.0, 333.0])
def test_a_capture_is_taken_from_the_samples(rate_hz):
    driver, clock = opened()
    assert driver.captured() is None
    driver.read()
    driver.capture(["thx", "x"], rate_hz, 50)
    parts, seen = [], []
    for _ in range(10):
        clock.advance(0.04)
        seen.append(driver.read())
        parts.append(driver.captured())
    parts = [part for part in parts if part is not None]
    time_s = np.concatenate([part.device_time_s for part in parts])
    readings = np.concatenate([part.measured for part in parts])
    assert len(time_s) == 50
    assert [part.complete for part in parts] == [False] * (len(parts) - 1) + [True]
    since = time_s - time_s[0]
    late = since - np.arange(50) / rate_hz
    assert late.min() > -1e-8
    assert late.max() < 1e-3
    sampled = {t: m for one in seen for t, m in zip(one.device_time_s, one.measured, strict=True)}
    assert all((sampled[t][[3, 0]] == r).all() for t, r in zip(time_s, readings, strict=True))
    assert driver.captured() is None


BOW = Profile(
    "zn",
    (ProfileSegment(0.1, 0.0, 6e-6, -4e-6), ProfileSegment(0.0505, 0.0, -6e-6, 4e-6)),
)


def test_a_profile_is_its_polynomial_at_each_tick():
    driver, clock = opened()
    start = driver.read().command[-1, 5]
    driver.upload(BOW)
    clock.advance(0.01)
    driver.read()
    driver.trigger()
    assert driver.status().state is DeviceState.PLAYING
    clock.advance(0.05)
    driver.read()
    assert driver.status().progress == pytest.approx(50 / 151)
    clock.advance(0.05)
    middle = driver.read()
    assert middle.command[-1, 5] == pytest.approx(start + 2e-6, abs=1e-15)
    tau = 0.75
    assert middle.command[-26, 5] == pytest.approx(start + 6e-6 * tau**2 - 4e-6 * tau**3, abs=1e-15)
    assert (middle.playback_row == -1).all()
    clock.advance(0.1)
    rest = driver.read()
    assert rest.command[-1, 5] == pytest.approx(start, abs=1e-15)
    assert driver.status().state is DeviceState.IDLE
    assert driver.status().progress == 1.0
    assert (rest.command[:, :5] == rest.command[0, :5]).all()


@pytest.mark.parametrize("how", ["stop", "abort"])
def test_a_profile_is_halted_within_the_acceleration(how):
    driver, clock = opened()
    driver.upload(Profile("x", (ProfileSegment(1.0, 0.0, 9e-3, -6e-3),)))
    driver.trigger()
    clock.advance(0.5)
    at = driver.read().command[-1, 0]
    getattr(driver, how)()
    clock.advance(0.5)
    after = driver.read()
    way = after.command[-1, 0] - at
    assert 0 < way <= 4.5e-3**2 / (2 * 0.2) + 4.5e-3 * 1e-3
    assert driver.status().state is DeviceState.IDLE


def test_a_profile_that_ends_at_speed_comes_to_a_halt():
    driver, clock = opened()
    driver.upload(Profile("x", (ProfileSegment(1.0, 0.0, 4e-3, 0.0),)))
    driver.trigger()
    clock.advance(2.0)
    way = np.ptp(driver.read().command[:, 0])
    assert 4e-3 < way < 4e-3 + 8e-3**2 / (2 * 0.2) + 8e-6
    assert driver.status().state is DeviceState.IDLE


def test_a_profile_holds_for_where_its_axis_was():
    driver, clock = opened()
    with pytest.raises(StateError, match="upload one first"):
        driver.trigger()
    driver.upload(BOW)
    driver.move_to({"zn": 1e-5})
    with pytest.raises(StateError, match="upload the profile again"):
        driver.trigger()
    clock.advance(1.0)
    driver.read()
    with pytest.raises(StateError, match="upload the profile again"):
        driver.trigger()
    driver.upload(BOW)
    driver.abort()
    with pytest.raises(StateError, match="upload one first"):
        driver.trigger()


def test_the_display_keeps_its_text_and_inputs_are_what_they_were_set_to():
    driver, _ = opened()
    driver.show(1, "tip above the dish, 12 µm")
    assert driver.shown == (" " * 20, "tip above the dish, ")
    assert driver.analog_inputs() == ((), ())
    driver.set_analog_inputs([0.5, 1.0], [True])
    assert driver.analog_inputs() == ((0.5, 1.0), (True,))
    with pytest.raises(LimitError, match="0 to 1"):
        driver.set_analog_inputs([1.5], [])
    assert driver.analog_inputs() == ((0.5, 1.0), (True,))
