"""Abilities of the simulator in addition to moves and trajectories."""

import numpy as np
import pytest

from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.drivers.contract import DeviceState, LimitError, StateError, VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def open_simulator(robot=ROBOT, **settings):
    clock = VirtualClock(77.0)
    driver = Simulator(robot, settings, clock=clock)
    driver.open()
    return driver, clock


def test_homing_moves_to_the_low_end_at_half_speed_and_makes_the_position_known():
    driver, clock = open_simulator(start_homed=False, start_fraction=0.1)
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


def test_an_interrupted_homing_leaves_the_position_unknown():
    driver, clock = open_simulator()
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


def test_a_piezo_cannot_be_homed():
    driver, _ = open_simulator()
    with pytest.raises(LimitError, match="'zn' has no limit switch"):
        driver.home(["zn"])


def test_the_amplifier_approaches_the_voltage_at_a_limited_rate():
    driver, clock = open_simulator()
    driver.set_voltage("zn", 20.0)
    clock.advance(1.0)
    samples = driver.read()
    # The samples are 1 ms apart.
    assert np.abs(np.diff(samples.inputs[:, 5])).max() <= 130.0 * 1e-3 * (1 + 1e-9)
    assert samples.inputs[-1, 5] == pytest.approx(20.0)
    assert samples.command[-1, 5] == pytest.approx(10e-6)
    assert np.abs(np.diff(samples.command[:, 5])).max() <= 5.0e-3 * 1e-3 * (1 + 1e-9)


@pytest.mark.parametrize(
    ("robot", "axis", "voltage", "reason"),
    [
        ("rotemina", "zn", 131.0, "0 to 130 V"),
        ("rotemina", "x", 1.0, "no amplifier"),
        ("fsm", "m1", 1.95, "outside its range"),
        ("emps", "q", 1.0, "controller"),
    ],
)
def test_an_invalid_voltage_is_refused(robot, axis, voltage, reason):
    driver, _ = open_simulator(load_robot(robot))
    with pytest.raises(LimitError, match=reason):
        driver.set_voltage(axis, voltage)


@pytest.mark.parametrize("rate_hz", [1000.0, 333.0])
def test_a_capture_is_taken_from_the_samples(rate_hz):
    driver, clock = open_simulator()
    assert driver.read_capture() is None
    driver.read()
    driver.capture(["thx", "x"], rate_hz, 50)
    portions, samples = [], []
    for _ in range(10):
        clock.advance(0.04)
        samples.append(driver.read())
        portions.append(driver.read_capture())
    portions = [portion for portion in portions if portion is not None]
    time_s = np.concatenate([portion.device_time_s for portion in portions])
    readings = np.concatenate([portion.measured for portion in portions])
    assert len(time_s) == 50
    assert [portion.complete for portion in portions] == [False] * (len(portions) - 1) + [True]
    delay_s = time_s - time_s[0] - np.arange(50) / rate_hz
    assert delay_s.min() > -1e-8
    assert delay_s.max() < 1e-3
    sampled_s = np.concatenate([portion.device_time_s for portion in samples]).tolist()
    measured = np.concatenate([portion.measured for portion in samples])
    reading_at = dict(zip(sampled_s, measured, strict=True))
    assert all(
        (reading_at[t][[3, 0]] == reading).all()
        for t, reading in zip(time_s.tolist(), readings, strict=True)
    )
    assert driver.read_capture() is None


BUMP_PROFILE = MotionProfile(
    "zn",
    (ProfileSegment(0.1, 0.0, 6e-6, -4e-6), ProfileSegment(0.0505, 0.0, -6e-6, 4e-6)),
)


def test_a_profile_follows_its_polynomial_at_each_tick():
    driver, clock = open_simulator()
    start = driver.read().command[-1, 5]
    driver.upload(BUMP_PROFILE)
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
    final_samples = driver.read()
    assert final_samples.command[-1, 5] == pytest.approx(start, abs=1e-15)
    assert driver.status().state is DeviceState.IDLE
    assert driver.status().progress == 1.0
    assert (final_samples.command[:, :5] == final_samples.command[0, :5]).all()


@pytest.mark.parametrize("method", ["stop", "abort"])
def test_a_profile_is_stopped_within_the_acceleration_limit(method):
    driver, clock = open_simulator()
    driver.upload(MotionProfile("x", (ProfileSegment(1.0, 0.0, 9e-3, -6e-3),)))
    driver.trigger()
    clock.advance(0.5)
    position = driver.read().command[-1, 0]
    getattr(driver, method)()
    clock.advance(0.5)
    samples_after = driver.read()
    distance = samples_after.command[-1, 0] - position
    assert 0 < distance <= 4.5e-3**2 / (2 * 0.2) + 4.5e-3 * 1e-3
    assert driver.status().state is DeviceState.IDLE


def test_a_profile_that_ends_at_speed_brakes_to_rest():
    driver, clock = open_simulator()
    driver.upload(MotionProfile("x", (ProfileSegment(1.0, 0.0, 4e-3, 0.0),)))
    driver.trigger()
    clock.advance(2.0)
    distance = np.ptp(driver.read().command[:, 0])
    assert 4e-3 < distance < 4e-3 + 8e-3**2 / (2 * 0.2) + 8e-6
    assert driver.status().state is DeviceState.IDLE


def test_a_profile_is_valid_only_at_the_position_of_its_upload():
    driver, clock = open_simulator()
    with pytest.raises(StateError, match="upload one first"):
        driver.trigger()
    driver.upload(BUMP_PROFILE)
    driver.move_to({"zn": 1e-5})
    with pytest.raises(StateError, match="upload the profile again"):
        driver.trigger()
    clock.advance(1.0)
    driver.read()
    with pytest.raises(StateError, match="upload the profile again"):
        driver.trigger()
    driver.upload(BUMP_PROFILE)
    driver.abort()
    with pytest.raises(StateError, match="upload one first"):
        driver.trigger()


def test_display_text_and_inputs_keep_their_values():
    driver, _ = open_simulator()
    driver.show(1, "tip above the dish, 12 µm")
    assert driver.display_rows == (" " * 20, "tip above the dish, ")
    assert driver.analog_inputs() == ((), ())
    driver.set_analog_inputs([0.5, 1.0], [True])
    assert driver.analog_inputs() == ((0.5, 1.0), (True,))
    with pytest.raises(LimitError, match="0 to 1"):
        driver.set_analog_inputs([1.5], [])
    assert driver.analog_inputs() == ((0.5, 1.0), (True,))
