"""The simulator follows the nominal model, keeps its limits, and is reproducible."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.drivers.contract import (
    DeviceSamples,
    DeviceState,
    DriverSettingError,
    LimitError,
    StateError,
    VirtualClock,
)
from rotemina.drivers.simulator import SimulatedDevice, Simulator
from rotemina.drivers.simulator.driver import MAX_READ_S
from rotemina.sim.errors import EffectError, PlantError
from rotemina.sim.plant import Plant, simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
EMPS = load_robot("emps")


def remove_sensors(robot):
    return replace(
        robot, axes={name: replace(axis, sensor=None) for name, axis in robot.axes.items()}
    )


def remove_limits(robot):
    """Return the robot without limits of speed and acceleration, so that rows may be far apart."""
    no_limits = {"max_speed": None, "max_acceleration": None}
    axes = {name: replace(axis, **no_limits) for name, axis in robot.axes.items()}
    return replace(robot, axes=axes)


def open_simulator(robot=ROBOT, **settings):
    clock = VirtualClock(77.0)
    driver = Simulator(robot, settings, clock=clock)
    driver.open()
    return driver, clock


def play_and_read(driver, clock, trajectory, step_s=0.37):
    """Play, and return all samples and whether each belongs to a row of the trajectory (n,)."""
    driver.play(trajectory)
    portions = []
    while driver.status().state is DeviceState.PLAYING:
        clock.advance(step_s)
        portions.append(driver.read())
    assert driver.status().fault is None
    samples = DeviceSamples.join(portions, len(driver.axes))
    return samples, samples.playback_row >= 0


def make_smooth_trajectory(time_s, robot=ROBOT, mode="open_loop"):
    """Make a trajectory that moves all axes of a robot from rest to rest together."""
    wave = 0.5 * (1 - np.cos(2 * np.pi * (time_s - time_s[0]) / (time_s[-1] - time_s[0])))
    signals, units = {}, {}
    for name, axis in robot.axes.items():
        signals[name, Tap.CMD] = axis.range[0] + axis.span * (0.4 + 0.02 * wave)
        units[name] = axis.unit
    return Record.from_signals(time_s, signals, units, {"mode": mode})


EVEN = np.arange(2001) / 2000.0
UNEVEN = 5.0 + np.cumsum(np.random.default_rng(1).uniform(2e-4, 3e-3, 700))
SPARSE = np.arange(201) * 0.01


@pytest.mark.parametrize("time_s", [EVEN, UNEVEN, SPARSE], ids=["even", "uneven", "sparse"])
def test_a_playback_is_the_nominal_response(time_s):
    robot = remove_limits(remove_sensors(ROBOT))
    trajectory = make_smooth_trajectory(time_s)
    samples, is_row = play_and_read(*open_simulator(robot, settle_s=3.0), trajectory)
    response = simulate_nominal_response(robot, trajectory)
    for column, name in enumerate(robot.axes):
        modelled = response.signal(name, Tap.MEAS)
        bound = 1e-12 * robot.axes[name].span
        np.testing.assert_allclose(samples.measured[is_row, column], modelled, rtol=0, atol=bound)
    assert np.isnan(samples.inputs[:, :3]).all()
    np.testing.assert_allclose(samples.inputs[is_row, 5], response.signal("zn", Tap.U), rtol=1e-12)


def test_the_motion_between_distant_rows_is_sampled():
    samples, is_row = play_and_read(
        *open_simulator(remove_limits(ROBOT)), make_smooth_trajectory(SPARSE)
    )
    first, last = np.flatnonzero(is_row)[[0, -1]]
    row_times_s = samples.device_time_s[first : last + 1]
    np.testing.assert_allclose(np.diff(row_times_s), 1e-3, atol=1e-9)
    held_command = samples.command[first : last + 1, 0]
    np.testing.assert_array_equal(
        held_command[:-1].reshape(-1, 10), np.repeat(held_command[:-1:10, None], 10, 1)
    )


def test_a_robot_with_a_controller_plays_in_closed_loop():
    trajectory = make_smooth_trajectory(np.arange(2000) * 1e-3, EMPS, mode="closed_loop")
    samples, is_row = play_and_read(*open_simulator(EMPS, settle_s=2.0), trajectory)
    response = simulate_nominal_response(EMPS, trajectory)
    # The model starts without the deviation that the loop needs to balance the constant force.
    deviation = samples.measured[is_row, 0] - response.signal("q", Tap.MEAS)
    assert np.abs(deviation[:1]).max() < 4e-6
    assert np.abs(deviation[400:]).max() < 1e-9
    effort = samples.inputs[is_row, 0] - response.signal("q", Tap.U)
    assert np.abs(effort[400:]).max() < 1e-6


@pytest.mark.parametrize("interval_s", [0.5, 0.0015, 4e-4])
def test_a_loop_runs_at_the_ticks_of_the_device_for_any_row_interval(interval_s):
    time_s = np.arange(round(3.0 / interval_s) + 1) * interval_s
    command = 0.06 + 0.01 * np.sin(np.pi * time_s / time_s[-1]) ** 2
    trajectory = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"})
    samples, is_row = play_and_read(*open_simulator(EMPS), trajectory)
    first, last = np.flatnonzero(is_row)[[0, -1]]
    row_times_s = samples.device_time_s[first : last + 1]
    np.testing.assert_allclose(np.diff(row_times_s), 1e-3, atol=1e-9)
    expected_command = command[
        np.searchsorted(time_s, row_times_s - row_times_s[0] + 1e-9, side="right") - 1
    ]
    np.testing.assert_array_equal(samples.command[first : last + 1, 0], expected_command)
    assert 0.055 < samples.measured[is_row, 0].min() < samples.measured[is_row, 0].max() < 0.075


def test_readings_have_the_declared_noise_and_resolution():
    driver, clock = open_simulator(seed=3)
    clock.advance(4.0)
    samples = driver.read()
    for column, axis in enumerate(ROBOT.axes.values()):
        reading = samples.measured[:, column]
        counts = reading / axis.sensor.resolution
        np.testing.assert_allclose(counts, np.rint(counts), atol=1e-6)
        assert reading.std() <= 1.1 * axis.sensor.noise_floor + axis.sensor.resolution
    assert samples.measured[:, 3].std() == pytest.approx(4.02e-7, rel=0.05)


def test_readings_include_the_offset_of_an_axis():
    axes = {**ROBOT.axes, "x": replace(ROBOT.axes["x"], offset=1e-3)}
    driver, _ = open_simulator(replace(ROBOT, axes=axes))
    samples = driver.read()
    assert samples.measured[0, 0] - samples.command[0, 0] == pytest.approx(1e-3, abs=2e-7)


def test_a_seed_gives_the_same_record_for_any_reading_interval():
    trajectory = make_smooth_trajectory(EVEN)
    records = []
    for seed, step_s, idle_s in ((5, 0.013, 0.0), (5, 4.0, 0.7), (0, 4.0, 0.0)):
        driver, clock = open_simulator(seed=seed, settle_s=3.0)
        clock.advance(idle_s)
        driver.read()
        samples, is_row = play_and_read(driver, clock, trajectory, step_s)
        records.append(samples.measured[is_row])
    np.testing.assert_array_equal(records[0], records[1])
    assert (records[0] != records[2]).any()


def test_a_long_time_without_reading_is_caught_up_in_limited_portions():
    driver, clock = open_simulator()
    clock.advance(12.0)
    counts = [len(driver.read()) for _ in range(4)]
    assert max(counts) <= MAX_READ_S * 1000 + 1
    assert sum(counts) == 12_001


def test_samples_are_still_evenly_spaced_after_an_hour():
    driver, clock = open_simulator(sample_rate_hz=100.0)
    last_samples = None
    for _ in range(3600 // 4):
        clock.advance(4.0)
        last_samples = driver.read()
    np.testing.assert_allclose(np.diff(last_samples.device_time_s), 0.01, atol=1e-9)
    assert last_samples.device_time_s[-1] == pytest.approx(3600.0)


def test_a_trajectory_sampled_too_densely_is_refused():
    dense_times_s = np.arange(100) / 25_000.0
    driver, _ = open_simulator()
    with pytest.raises(LimitError, match="25000 rows per second"):
        driver.play(make_constant_trajectory(dense_times_s))


def make_constant_trajectory(time_s):
    return Record.from_signals(time_s, {("x", Tap.CMD): np.full(len(time_s), 0.02)}, {"x": "m"})


def test_an_unstable_loop_is_a_fault_that_can_be_cleared():
    axis = replace(EMPS.axes["q"], mass=1e-3, damping=0.0)
    unstable_axis = replace(axis, controller=replace(axis.controller, limit=1e308))
    driver, clock = open_simulator(replace(EMPS, axes={"q": unstable_axis}), sample_rate_hz=20.0)
    clock.advance(0.2)
    driver.read()
    driver.move_to({"q": 0.2})
    for _ in range(100):
        clock.advance(1.0)
        driver.read()
    status = driver.status()
    assert status.state is DeviceState.FAULT
    assert "axis q" in status.fault
    driver.clear_fault()
    assert driver.status().state is DeviceState.IDLE
    clock.advance(0.1)
    assert len(driver.read()) > 0


def test_invalid_settings_and_robots_are_refused():
    for name, value in (
        ("sample_rate_hz", 0.0),
        ("sample_rate_hz", 1e6),
        ("seed", -1),
        ("settle_s", -0.1),
        ("start_fraction", 1.5),
    ):
        with pytest.raises(DriverSettingError, match=name):
            Simulator(ROBOT, {name: value})
    uncontrolled = replace(EMPS, axes={"q": replace(EMPS.axes["q"], controller=None)})
    with pytest.raises(DriverSettingError, match="controller"):
        Simulator(uncontrolled)


def test_a_single_row_can_be_played():
    samples, is_row = play_and_read(*open_simulator(), make_constant_trajectory(np.array([3.0])))
    assert is_row.sum() == 1
    assert samples.command[is_row, 0] == 0.02


@given(
    intervals=st.lists(st.sampled_from([3e-4, 1e-3, 1.3e-3, 2e-3, 0.05]), min_size=5, max_size=40),
    steps=st.lists(st.integers(-8, 8), min_size=40, max_size=40),
    stop_fraction=st.floats(0.0, 1.0),
    is_at_low_end=st.booleans(),
)
def test_a_stop_takes_at_most_the_braking_distance(intervals, steps, stop_fraction, is_at_low_end):
    """A stop anywhere in a trajectory keeps the axis in its range, within its braking distance."""
    axis = ROBOT.axes["x"]
    time_s = np.concatenate([[0.0], np.cumsum(intervals)])
    displacement = np.cumsum([0, *steps[: len(intervals)]]) * 1e-6
    start = (
        axis.range[0] - displacement.min() if is_at_low_end else axis.range[1] - displacement.max()
    )
    device = SimulatedDevice(
        ROBOT,
        tick_s=1e-3,
        seed=0,
        settle_s=0.0,
        position=np.array([start + displacement[0], 0.02, 0.02, 5e-4, 5e-4, 3e-5]),
    )
    path = Record.from_signals(time_s, {("x", Tap.CMD): start + displacement}, {"x": "m"})
    device.play(device.prepare_playback(path))
    portions = device.advance(0.005 + stop_fraction * (time_s[-1] - 0.001))
    device.stop()
    last_command = portions[-1].command[-1, 0]
    rows = np.concatenate([portion.playback_row for portion in portions])
    row = rows.max()
    sample_times_s = np.concatenate([portion.device_time_s for portion in portions])
    recent = np.flatnonzero(time_s >= time_s[max(row, 0)] - 1.5e-3)
    recent = recent[recent <= row]
    speed = 0.0
    if len(recent) > 1 and sample_times_s[-1] - sample_times_s[np.argmax(rows)] < 1e-3:
        span = time_s[recent[-1]] - time_s[recent[0]]
        speed = min(abs(displacement[recent[-1]] - displacement[recent[0]]) / span, axis.max_speed)
    commands_after = np.concatenate(
        [portion.command[:, 0] for portion in device.advance(time_s[-1] + 0.5)]
    )
    braking = speed**2 / (2 * axis.max_acceleration) + speed * 1e-3
    assert np.abs(commands_after - last_command).max() <= braking + 1e-12
    assert axis.range[0] <= commands_after.min() <= commands_after.max() <= axis.range[1]


def play_two_fifths(driver, clock):
    """Play 40 % of a slow wave of thx, and return its last command, rad."""
    time_s = np.arange(4000) / 1000
    command = 5e-4 + 5e-4 * np.sin(2 * np.pi * time_s / 8) ** 2
    driver.play(Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"}))
    while driver.status().progress < 0.4:
        clock.advance(0.05)
        last_command = driver.read().command[-1, 3]
    assert last_command > 6e-4
    return last_command


@pytest.mark.parametrize("with_stop", [False, True])
def test_closing_during_a_playback_keeps_the_last_set_point(with_stop):
    driver, clock = open_simulator()
    last_command = play_two_fifths(driver, clock)
    if with_stop:
        driver.stop()
        clock.advance(0.02)
    driver.close()
    driver.open()
    assert driver.read().command[0, 3] == pytest.approx(last_command, abs=1e-6)
    clock.advance(0.1)
    assert np.ptp(driver.read().command[:, 3]) == 0.0


def test_clearing_a_fault_in_a_playback_holds_the_last_set_point(monkeypatch):
    driver, clock = open_simulator(settle_s=0.0)
    last_command = play_two_fifths(driver, clock)

    def raise_plant_error(*_, **options):
        raise PlantError("axis thx: gone")

    with monkeypatch.context() as patch:
        patch.setattr(Plant, "advance", raise_plant_error)
        clock.advance(0.05)
        driver.read()
    assert driver.status().state is DeviceState.FAULT
    driver.clear_fault()
    clock.advance(0.05)
    assert driver.read().command[-1, 3] == last_command


HYSTERESIS = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1e-4})


def test_effects_of_the_robot_file_act_until_others_are_set():
    driver, clock = open_simulator(remove_sensors(replace(ROBOT, effects=(HYSTERESIS,))))
    assert driver.effects == (HYSTERESIS,)
    nominal, nominal_clock = open_simulator(remove_sensors(ROBOT))
    samples, rows = play_and_read(driver, clock, make_smooth_trajectory(np.arange(1000) / 1000.0))
    nominal_samples, nominal_rows = play_and_read(
        nominal, nominal_clock, make_smooth_trajectory(np.arange(1000) / 1000.0)
    )
    column = driver.axes.index("thx")
    deviation = samples.measured[rows, column] - nominal_samples.measured[nominal_rows, column]
    assert 1e-6 < np.ptp(deviation) < 2e-4


def test_effects_set_during_a_playback_cause_no_jump():
    driver, clock = open_simulator(remove_sensors(ROBOT))
    driver.play(make_smooth_trajectory(np.arange(2000) / 1000.0))
    clock.advance(1.5)
    samples_before = driver.read()
    driver.set_effects([HYSTERESIS])
    clock.advance(0.5)
    samples_after = driver.read()
    column = driver.axes.index("x")
    assert driver.status().fault is None
    jump = np.abs(samples_after.measured[0] - samples_before.measured[-1])[column]
    assert jump < 1.5 * np.abs(np.diff(samples_before.measured[-50:, column])).max()
    assert driver.effects == (HYSTERESIS,)


def test_an_invalid_effect_is_refused_and_changes_nothing():
    driver, _ = open_simulator()
    driver.set_effects([HYSTERESIS])
    for effect, reason in (
        (AxisEffect(axis="q", id="delay"), "no such axis"),
        (AxisEffect(axis="x", id="hysteresis"), "piezo"),
        (AxisEffect(axis="x", id="ether_wind"), "ether_wind"),
        (AxisEffect(axis="x", id="delay", parameters={"delay": 9.0}), "between 0 and 0.1 s"),
        (AxisEffect(axis="x", id="delay", parameters={"delay": float("nan")}), "nan"),
    ):
        with pytest.raises(EffectError, match=reason):
            driver.set_effects([effect])
        assert driver.effects == (HYSTERESIS,)


def test_effects_stay_after_reconnecting():
    driver, _ = open_simulator()
    driver.set_effects([HYSTERESIS])
    driver.close()
    with pytest.raises(StateError, match="open it first"):
        driver.set_effects([])
    driver.open()
    assert driver.effects == (HYSTERESIS,)
