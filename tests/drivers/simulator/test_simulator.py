"""The simulator against the nominal model, and what no other device would do."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.drivers.settings import SettingError
from rotemina.drivers.simulator.device import SimulatedDevice
from rotemina.drivers.simulator.driver import MAX_READ_S, Simulator
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
EMPS = load_robot("emps")


def without_sensors(robot):
    return replace(robot, axes={n: replace(a, sensor=None) for n, a in robot.axes.items()})


def unbounded(robot):
    """A robot that may be sent from row to row however far apart these are."""
    free = {"max_speed": None, "max_acceleration": None}
    return replace(robot, axes={n: replace(a, **free) for n, a in robot.axes.items()})


def opened(robot=ROBOT, **given):
    clock = VirtualClock(77.0)
    driver = Simulator(robot, given, clock=clock)
    driver.open()
    return driver, clock


def played(driver, clock, trajectory, step_s=0.37):
    """Play and return the samples of the trajectory's rows alone, as one."""
    driver.play(trajectory)
    parts = []
    while driver.status().state is DeviceState.PLAYING:
        clock.advance(step_s)
        parts.append(driver.read())
    assert driver.status().fault is None
    whole = Samples.joined(parts, len(driver.axes))
    return whole, whole.playback_row >= 0


def smooth(time_s, robot=ROBOT, mode="open_loop"):
    """All axes of a robot, from rest and back to rest, together."""
    turn = 0.5 * (1 - np.cos(2 * np.pi * (time_s - time_s[0]) / (time_s[-1] - time_s[0])))
    signals, units = {}, {}
    for name, axis in robot.axes.items():
        signals[name, Tap.CMD] = axis.range[0] + axis.span * (0.4 + 0.02 * turn)
        units[name] = axis.unit
    return Record.from_signals(time_s, signals, units, {"mode": mode})


EVEN = np.arange(2001) / 2000.0
UNEVEN = 5.0 + np.cumsum(np.random.default_rng(1).uniform(2e-4, 3e-3, 700))
SPARSE = np.arange(201) * 0.01


@pytest.mark.parametrize("time_s", [EVEN, UNEVEN, SPARSE], ids=["even", "uneven", "sparse"])
def test_a_playback_is_the_nominal_response(time_s):
    robot = unbounded(without_sensors(ROBOT))
    trajectory = smooth(time_s)
    samples, own = played(*opened(robot, settle_s=3.0), trajectory)
    response = nominal_response(robot, trajectory)
    for column, name in enumerate(robot.axes):
        modelled = response.signal(name, Tap.MEAS)
        bound = 1e-12 * robot.axes[name].span
        np.testing.assert_allclose(samples.measured[own, column], modelled, rtol=0, atol=bound)
    assert np.isnan(samples.inputs[:, :3]).all()
    np.testing.assert_allclose(samples.inputs[own, 5], response.signal("zn", Tap.U), rtol=1e-12)


def test_distant_rows_are_sampled_in_between_on_the_same_motion():
    samples, own = played(*opened(unbounded(ROBOT)), smooth(SPARSE))
    first, last = np.flatnonzero(own)[[0, -1]]
    inside = samples.device_time_s[first : last + 1]
    np.testing.assert_allclose(np.diff(inside), 1e-3, atol=1e-9)
    held = samples.command[first : last + 1, 0]
    np.testing.assert_array_equal(held[:-1].reshape(-1, 10), np.repeat(held[:-1:10, None], 10, 1))


def test_a_robot_with_a_controller_plays_under_it():
    trajectory = smooth(np.arange(2000) * 1e-3, EMPS, mode="closed_loop")
    samples, own = played(*opened(EMPS, settle_s=2.0), trajectory)
    response = nominal_response(EMPS, trajectory)
    # The model starts without the deviation by which the loop carries the constant force.
    deviation = samples.measured[own, 0] - response.signal("q", Tap.MEAS)
    assert np.abs(deviation[:1]).max() < 4e-6
    assert np.abs(deviation[400:]).max() < 1e-9
    effort = samples.inputs[own, 0] - response.signal("q", Tap.U)
    assert np.abs(effort[400:]).max() < 1e-6


@pytest.mark.parametrize("apart_s", [0.5, 0.0015, 4e-4])
def test_a_loop_is_closed_at_the_devices_ticks_whatever_the_rows(apart_s):
    time_s = np.arange(round(3.0 / apart_s) + 1) * apart_s
    command = 0.06 + 0.01 * np.sin(np.pi * time_s / time_s[-1]) ** 2
    trajectory = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"})
    samples, own = played(*opened(EMPS), trajectory)
    first, last = np.flatnonzero(own)[[0, -1]]
    inside = samples.device_time_s[first : last + 1]
    np.testing.assert_allclose(np.diff(inside), 1e-3, atol=1e-9)
    asked = command[np.searchsorted(time_s, inside - inside[0] + 1e-9, side="right") - 1]
    np.testing.assert_array_equal(samples.command[first : last + 1, 0], asked)
    assert 0.055 < samples.measured[own, 0].min() < samples.measured[own, 0].max() < 0.075


def test_readings_have_the_declared_noise_and_resolution():
    driver, clock = opened(seed=3)
    clock.advance(4.0)
    samples = driver.read()
    for column, axis in enumerate(ROBOT.axes.values()):
        reading = samples.measured[:, column]
        counts = reading / axis.sensor.resolution
        np.testing.assert_allclose(counts, np.rint(counts), atol=1e-6)
        assert reading.std() <= 1.1 * axis.sensor.noise_floor + axis.sensor.resolution
    assert samples.measured[:, 3].std() == pytest.approx(4.02e-7, rel=0.05)


def test_the_offset_of_an_axis_is_read():
    axes = {**ROBOT.axes, "x": replace(ROBOT.axes["x"], offset=1e-3)}
    driver, _ = opened(replace(ROBOT, axes=axes))
    samples = driver.read()
    assert samples.measured[0, 0] - samples.command[0, 0] == pytest.approx(1e-3, abs=2e-7)


@pytest.mark.parametrize("seed", [0, 5])
def test_a_seed_gives_the_same_record_however_often_one_reads(seed):
    trajectory = smooth(EVEN)
    records = []
    for step_s, idle_s in ((0.013, 0.0), (4.0, 0.7)):
        driver, clock = opened(seed=seed, settle_s=3.0)
        clock.advance(idle_s)
        driver.read()
        samples, own = played(driver, clock, trajectory, step_s)
        records.append(samples.measured[own])
    np.testing.assert_array_equal(*records)


def test_another_seed_gives_other_noise():
    first, second = (played(*opened(seed=seed), smooth(EVEN))[0] for seed in (0, 1))
    assert (first.measured != second.measured).any()


def test_nobody_reading_for_long_bounds_the_work_and_loses_nothing():
    driver, clock = opened()
    clock.advance(12.0)
    counts = [len(driver.read()) for _ in range(4)]
    assert max(counts) <= MAX_READ_S * 1000 + 1
    assert sum(counts) == 12_001


def test_an_hour_later_it_still_samples_evenly():
    driver, clock = opened(sample_rate_hz=100.0)
    last = None
    for _ in range(3600 // 4):
        clock.advance(4.0)
        last = driver.read()
    np.testing.assert_allclose(np.diff(last.device_time_s), 0.01, atol=1e-9)
    assert last.device_time_s[-1] == pytest.approx(3600.0)


def test_a_trajectory_sampled_too_densely_is_refused():
    dense = np.arange(100) / 25_000.0
    driver, _ = opened()
    with pytest.raises(LimitError, match="25000 rows per second"):
        driver.play(_hold(dense))


def _hold(time_s):
    return Record.from_signals(time_s, {("x", Tap.CMD): np.full(len(time_s), 0.02)}, {"x": "m"})


def test_an_unstable_loop_is_a_fault_that_can_be_cleared():
    axis = replace(EMPS.axes["q"], mass=1e-3, damping=0.0)
    wild = replace(axis, controller=replace(axis.controller, limit=1e308))
    driver, clock = opened(replace(EMPS, axes={"q": wild}), sample_rate_hz=20.0)
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


def test_it_stands_where_it_was_left():
    driver, clock = opened()
    driver.move_to({"x": 0.03})
    clock.advance(4.0)
    driver.read()
    driver.close()
    driver.open()
    assert driver.read().command[0, 0] == 0.03


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("sample_rate_hz", 0.0),
        ("sample_rate_hz", 1e6),
        ("seed", -1),
        ("settle_s", -0.1),
        ("start_fraction", 1.5),
    ],
)
def test_settings_out_of_bounds_are_named(name, value):
    with pytest.raises(SettingError, match=name):
        Simulator(ROBOT, {name: value})


def test_a_force_that_nothing_holds_is_no_machine():
    free = replace(EMPS, axes={"q": replace(EMPS.axes["q"], controller=None)})
    with pytest.raises(SettingError, match="controller"):
        Simulator(free)


def test_one_row_can_be_played():
    samples, own = played(*opened(), _hold(np.array([3.0])))
    assert own.sum() == 1
    assert samples.command[own, 0] == 0.02


HELD = Record.from_signals(
    np.array([0.0, 0.1, 1.1, 2.0]),
    {("x", Tap.CMD): np.array([1e-4, 1.0e-3, 1.0e-3, 1.0e-3])},
    {"x": "m"},
)


def test_stop_while_a_row_is_held_moves_nothing():
    driver, clock = opened(start_fraction=0.0, settle_s=0.0)
    driver._running.play(
        driver._running.playing_of(HELD)
    )  # past the limits: they would refuse the jump
    while driver.read().playback_row.max(initial=-1) < 1:
        clock.advance(0.001)
    clock.advance(0.3)
    assert driver.read().command[-1, 0] == 1e-3
    driver.stop()
    clock.advance(1.0)
    assert (driver.read().command[:, 0] == 1e-3).all()


@given(
    intervals=st.lists(st.sampled_from([3e-4, 1e-3, 1.3e-3, 2e-3, 0.05]), min_size=5, max_size=40),
    steps=st.lists(st.integers(-8, 8), min_size=40, max_size=40),
    when=st.floats(0.0, 1.0),
    low_end=st.booleans(),
)
def test_after_a_stop_no_axis_goes_farther_than_it_brakes(intervals, steps, when, low_end):
    """Nor out of the range, wherever in a trajectory it is stopped."""
    axis = ROBOT.axes["x"]
    time_s = np.concatenate([[0.0], np.cumsum(intervals)])
    way = np.cumsum([0, *steps[: len(intervals)]]) * 1e-6
    start = axis.range[0] - way.min() if low_end else axis.range[1] - way.max()
    device = SimulatedDevice(
        ROBOT,
        tick_s=1e-3,
        seed=0,
        settle_s=0.0,
        position=np.array([start + way[0], 0.02, 0.02, 5e-4, 5e-4, 3e-5]),
    )
    path = Record.from_signals(time_s, {("x", Tap.CMD): start + way}, {"x": "m"})
    device.play(device.playing_of(path))
    played = device.advance(0.005 + when * (time_s[-1] - 0.001))
    device.stop()
    last = played[-1].command[-1, 0]
    rows = np.concatenate([part.playback_row for part in played])
    row = rows.max()
    begins = np.concatenate([part.device_time_s for part in played])
    recent = np.flatnonzero(time_s >= time_s[max(row, 0)] - 1.5e-3)
    recent = recent[recent <= row]
    speed = 0.0
    if len(recent) > 1 and begins[-1] - begins[np.argmax(rows)] < 1e-3:
        span = time_s[recent[-1]] - time_s[recent[0]]
        speed = min(abs(way[recent[-1]] - way[recent[0]]) / span, axis.max_speed)
    after = np.concatenate([part.command[:, 0] for part in device.advance(time_s[-1] + 0.5)])
    braking = speed**2 / (2 * axis.max_acceleration) + speed * 1e-3
    assert np.abs(after - last).max() <= braking + 1e-12
    assert axis.range[0] <= after.min() <= after.max() <= axis.range[1]


@pytest.mark.parametrize("stopped", [False, True])
def test_closed_while_playing_it_stands_where_the_last_set_point_was(stopped):
    driver, clock = opened()
    time_s = np.arange(4000) / 1000
    command = 5e-4 + 5e-4 * np.sin(2 * np.pi * time_s / 8) ** 2
    driver.play(Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"}))
    while driver.status().progress < 0.4:
        clock.advance(0.05)
        last = driver.read().command[-1, 3]
    if stopped:
        driver.stop()
        clock.advance(0.02)
    driver.close()
    driver.open()
    assert last > 6e-4
    assert driver.read().command[0, 3] == pytest.approx(last, abs=1e-6)
    clock.advance(0.1)
    assert np.ptp(driver.read().command[:, 3]) == 0.0


def test_clearing_a_fault_in_a_playback_holds_the_last_set_point(monkeypatch):
    driver, clock = opened(settle_s=0.0)
    time_s = np.arange(4000) / 1000
    command = 5e-4 + 5e-4 * np.sin(2 * np.pi * time_s / 8) ** 2
    driver.play(Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"}))
    while driver.status().progress < 0.4:
        clock.advance(0.05)
        last = driver.read().command[-1, 3]

    def diverges(*_, **options):
        raise PlantError("axis thx: gone")

    with monkeypatch.context() as broken:
        broken.setattr(Plant, "advance", diverges)
        clock.advance(0.05)
        driver.read()
    assert driver.status().state is DeviceState.FAULT
    driver.clear_fault()
    clock.advance(0.05)
    assert driver.read().command[-1, 3] == last


LOOP = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1e-4})


def test_effects_of_the_robot_file_act_until_others_are_set():
    driver, clock = opened(without_sensors(replace(ROBOT, effects=(LOOP,))))
    assert driver.effects == (LOOP,)
    nominal, nominal_clock = opened(without_sensors(ROBOT))
    samples, rows = played(driver, clock, smooth(np.arange(1000) / 1000.0))
    bare, bare_rows = played(nominal, nominal_clock, smooth(np.arange(1000) / 1000.0))
    column = driver.axes.index("thx")
    gap = samples.measured[rows, column] - bare.measured[bare_rows, column]
    assert 1e-6 < np.ptp(gap) < 2e-4


def test_effects_are_set_in_mid_playback_and_the_axes_go_on():
    driver, clock = opened(without_sensors(ROBOT))
    driver.play(smooth(np.arange(2000) / 1000.0))
    clock.advance(1.5)
    before = driver.read()
    driver.set_effects([LOOP])
    clock.advance(0.5)
    after = driver.read()
    column = driver.axes.index("x")
    assert driver.status().fault is None
    jump = np.abs(after.measured[0] - before.measured[-1])[column]
    assert jump < 1.5 * np.abs(np.diff(before.measured[-50:, column])).max()
    assert driver.effects == (LOOP,)


@pytest.mark.parametrize(
    ("effect", "named"),
    [
        (AxisEffect(axis="q", id="delay"), "no such axis"),
        (AxisEffect(axis="x", id="hysteresis"), "piezo"),
        (AxisEffect(axis="x", id="ether_wind"), "ether_wind"),
        (AxisEffect(axis="x", id="delay", parameters={"delay": 9.0}), "between 0 and 0.1 s"),
        (AxisEffect(axis="x", id="delay", parameters={"delay": float("nan")}), "nan"),
    ],
)
def test_an_effect_that_cannot_be_is_refused_and_nothing_changes(effect, named):
    driver, _ = opened()
    driver.set_effects([LOOP])
    with pytest.raises(EffectError, match=named):
        driver.set_effects([effect])
    assert driver.effects == (LOOP,)


def test_effects_stay_over_a_closed_connection():
    driver, _ = opened()
    driver.set_effects([LOOP])
    driver.close()
    with pytest.raises(StateError, match="open it first"):
        driver.set_effects([])
    driver.open()
    assert driver.effects == (LOOP,)
