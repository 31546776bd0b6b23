"""The teleoperation loop on the simulator, stepped by the test."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from rotemina.app.motion.inputs import Intent, OperatorAction
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionPhase
from rotemina.app.motion.teleoperation import (
    CoordinateScale,
    LawKind,
    ModeScales,
    Teleoperator,
)
from rotemina.app.motion.teleoperation.teleoperation_loop import JOYSTICK_OWNER
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import dry_run

TICK_S = 0.005
CENTRE = {"x": 0.0, "y": 0.0, "z": 0.0}


class OperatorBench:
    """An operator at a session that the test steps."""

    def __init__(self, robot="rotemina", delay_steps=1, **settings):
        self.delay_steps = (
            delay_steps  # steps of the operator's loop until a speed reaches the machine
        )
        self.clock = VirtualClock(5.0)
        driver = Simulator(load_robot(robot), settings, clock=self.clock)
        self.session = MotionSession(driver)
        self.session.connect()
        self.session.run_once()
        self.teleoperator = Teleoperator(self.session)
        self.axes = list(self.session.robot.axes)
        self.samples = []
        self.session.tap(lambda samples, _: self.samples.append(samples))

    def run(self, seconds, deflections=CENTRE, held=(), pressed=(), loss_reason=None):
        """Hold the sticks at these deflections; actions are pressed at the beginning."""
        steps = max(1, round(seconds / TICK_S))
        for number in range(steps):
            self.clock.advance(TICK_S)
            if number % self.delay_steps == 0:
                self.session.run_once()
            intent = Intent(
                self.clock(),
                dict(deflections),
                frozenset(pressed if number == 0 else ()),
                frozenset(held),
                "test",
                loss_reason if number == 0 else None,
            )
            self.teleoperator.step(intent, self.clock())
        return self.session.snapshot()

    def read_path(self, axis):
        """Return times and applied commands of an axis since the connection."""
        column = self.axes.index(axis)
        times = np.concatenate([samples.device_time_s for samples in self.samples])
        return times, np.concatenate([samples.command[:, column] for samples in self.samples])

    def assert_smooth(self, axis):
        """Assert that the command of an axis has no step and keeps to its acceleration."""
        times, path = self.read_path(axis)
        model = self.session.robot.axes[axis]
        dt = np.diff(times)
        speed = np.diff(path) / dt
        assert np.abs(speed).max() <= model.max_speed * (1 + 1e-6)
        # Rounding the command to ticks is no acceleration of the axis.
        assert np.abs(np.diff(speed)).max() <= model.max_acceleration * dt.max() * (1 + 1e-6)


@pytest.fixture
def bench():
    return OperatorBench()


def test_a_stick_moves_an_axis_at_a_rate_until_it_is_released(bench):
    start = bench.run(0.1).command
    bench.run(1.0, {**CENTRE, "x": 0.5})
    state = bench.session.snapshot()
    assert state.owners["x"] == JOYSTICK_OWNER
    assert set(state.owners) == {"x"}  # the others are free
    assert bench.teleoperator.state.is_driving
    state = bench.run(0.5)
    assert not bench.teleoperator.state.is_driving
    assert state.phase is SessionPhase.READY
    assert state.command["x"] - start["x"] == pytest.approx(0.5e-3, rel=0.02)
    reference = bench.teleoperator.state.coordinates[0].position
    assert state.command["x"] == pytest.approx(reference, abs=1e-7)
    assert state.command["y"] == start["y"]
    bench.assert_smooth("x")


def test_linear_position_follows_the_stick_and_returns(bench):
    bench.teleoperator.use_law(LawKind.POSITION)
    start = bench.run(0.1).command["x"]
    state = bench.run(1.0, {**CENTRE, "x": 1.0})
    assert state.command["x"] - start == pytest.approx(5e-4, abs=1.5e-7)
    state = bench.run(1.0)
    assert state.command["x"] - start == pytest.approx(0.0, abs=1.5e-7)
    x = bench.read_path("x")[1]
    assert x.max() - start <= 1.01 * 5e-4  # nearly no overshoot
    bench.assert_smooth("x")


@pytest.mark.parametrize("delay_steps", [1, 3, 6])
@pytest.mark.parametrize("stick", ["y", "z"])
def test_a_piezo_follows_a_jump_of_the_stick_without_overshoot_at_any_delay(delay_steps, stick):
    bench = OperatorBench(delay_steps=delay_steps)
    axis = {"y": "thx", "z": "zn"}[stick]
    bench.teleoperator.use_mode("nano")
    bench.teleoperator.use_law(LawKind.POSITION)
    bench.run(0.2)
    bench.run(1.5, {**CENTRE, stick: 0.5})
    travel = np.abs(bench.read_path(axis)[1] - bench.read_path(axis)[1][0])
    assert travel[-1] == pytest.approx(0.125 * bench.session.robot.axes[axis].span, rel=2e-3)
    assert travel.max() <= (1.01 if delay_steps <= 3 else 1.1) * travel[-1]


@pytest.mark.parametrize("law", list(LawKind))
def test_a_path_steered_to_the_end_of_a_piezos_range_can_be_played(law):
    bench = OperatorBench(delay_steps=3)
    robot = bench.session.robot
    quick = CoordinateScale(way=1e-3, speed=0.04, time_constant_s=0.1)
    bench.teleoperator.use_scales(ModeScales().with_scale("nano", "thx", quick))
    bench.teleoperator.use_mode("nano")
    bench.teleoperator.use_law(law)
    bench.run(0.2)
    bench.run(1.0, {**CENTRE, "y": 1.0})
    bench.run(1.0, {**CENTRE, "y": -1.0})
    bench.run(0.5)
    times, path = bench.read_path("thx")
    low, high = robot.axes["thx"].range
    assert np.ptp(path) > 0.9 * (high - low)
    grid = np.arange(times[0], times[-1], TICK_S)
    signals = {("thx", Tap.CMD): np.interp(grid, times, path)}
    record = Record.from_signals(grid - grid[0], signals, {"thx": "rad"}, {})
    assert dry_run(robot, record).objections == ()


def test_a_clutch_reindexes(bench):
    bench.teleoperator.use_law(LawKind.POSITION)
    start = bench.run(0.1).command["x"]
    bench.run(1.0, {**CENTRE, "x": 1.0})
    bench.run(0.3, {**CENTRE, "x": 1.0}, held={OperatorAction.CLUTCH})
    indexed_x = bench.run(0.3, held={OperatorAction.CLUTCH}).command["x"]
    assert indexed_x - start == pytest.approx(5e-4, abs=2e-7)
    state = bench.run(0.5)
    assert state.command["x"] == pytest.approx(indexed_x, abs=1e-7)
    state = bench.run(1.0, {**CENTRE, "x": 1.0})
    assert state.command["x"] - start == pytest.approx(1e-3, abs=3e-7)


def test_a_stick_deflected_at_the_start_of_a_mode_does_nothing_until_centred(bench):
    start = bench.run(0.5, {**CENTRE, "x": 1.0}).command["x"]
    assert "x" in {c.name for c in bench.teleoperator.state.coordinates if c.is_waiting}
    assert bench.run(0.1).command["x"] == start
    assert bench.run(0.5, {**CENTRE, "x": 1.0}).command["x"] > start


def test_switching_laws_during_a_move_causes_no_jump(bench):
    bench.run(0.1)
    for first, second in permutations(LawKind, 2):
        bench.teleoperator.use_law(first)
        bench.run(0.3, {**CENTRE, "x": 0.8})
        bench.teleoperator.use_law(second)
        bench.run(0.3, {**CENTRE, "x": 0.8})
        bench.run(0.3)
    bench.assert_smooth("x")


@pytest.mark.parametrize("law", list(LawKind))
def test_switching_modes_during_a_move_causes_no_jump(bench, law):
    bench.teleoperator.use_law(law)
    sticks = {"x": 0.6, "y": -0.4, "z": 0.5}
    bench.run(0.1)
    modes = []
    for _ in range(len(bench.teleoperator.modes.names)):
        bench.run(0.15)
        bench.run(0.3, sticks)
        bench.run(TICK_S, sticks, pressed={OperatorAction.STAGE})
        modes.append(bench.teleoperator.state.mode)
        # The switch starts no motion: the deflection of the stick is not taken over.
        bench.run(0.25, sticks)
        assert bench.teleoperator.state.refusal_reason is None
    assert sorted(modes) == sorted(bench.teleoperator.modes.names)
    for axis in bench.axes:
        bench.assert_smooth(axis)


def test_fine_and_coarse_and_presets_change_the_speed_without_a_jump(bench):
    bench.run(0.1)
    distances = []
    for held in ((), (OperatorAction.FINE,), (OperatorAction.COARSE,)):
        begin = bench.run(0.2, {**CENTRE, "x": 0.5}, held=held).command["x"]
        end = bench.run(0.5, {**CENTRE, "x": 0.5}, held=held).command["x"]
        distances.append(end - begin)
    assert distances[1] / distances[0] == pytest.approx(0.1, rel=0.25)
    assert distances[2] / distances[0] == pytest.approx(10.0, rel=0.15)
    bench.run(TICK_S, pressed={OperatorAction.STEP_PRESET})
    assert bench.teleoperator.state.preset == 2.0
    bench.assert_smooth("x")


def test_releasing_the_dead_man_switch_halts(bench):
    for law in LawKind:
        bench.teleoperator.use_law(law)
        bench.run(0.1)
        bench.run(0.1, {**CENTRE, "x": 1.0})
        begin = bench.session.snapshot().command["x"]
        state = bench.run(1.0, {})
        assert abs(state.command["x"] - begin) < 3e-4
        assert state.phase is SessionPhase.READY
        assert "no stick" in bench.teleoperator.state.reason


def test_a_lost_device_stops(bench):
    bench.run(0.1)
    bench.run(0.3, {**CENTRE, "x": 1.0})
    begin = bench.session.snapshot().command["x"]
    state = bench.run(0.3, {}, loss_reason="stick: unplugged")
    assert state.command["x"] - begin < 5e-5
    assert state.stop_latency_s is not None
    assert bench.teleoperator.state.refusal_reason == "stick: unplugged"


def test_stop_and_emergency_stop_by_button(bench):
    bench.run(0.1)
    bench.run(0.2, {**CENTRE, "x": 1.0})
    bench.run(0.2, pressed={OperatorAction.STOP})
    assert bench.session.snapshot().phase is SessionPhase.READY
    bench.run(0.2, {**CENTRE, "x": 1.0})
    bench.run(0.2, {**CENTRE, "x": 1.0}, pressed={OperatorAction.EMERGENCY_STOP})
    state = bench.session.snapshot()
    assert state.latch_reason == "the joystick's stop and lock"
    begin = state.command["x"]
    assert bench.run(0.3, {**CENTRE, "x": 1.0}).command["x"] == begin
    bench.session.release()
    # After the release, a stick that is still deflected must be centred first.
    assert bench.run(0.3, {**CENTRE, "x": 1.0}).command["x"] == begin
    bench.run(0.1)
    assert bench.run(0.3, {**CENTRE, "x": 1.0}).command["x"] > begin


def test_after_a_stop_at_rest_a_held_stick_has_no_effect(bench):
    high = bench.session.robot.axes["x"].range[1]
    bench.session.go_to({"x": high})
    bench.run(8.0)
    bench.run(0.3, {**CENTRE, "x": 1.0})
    assert not bench.teleoperator.state.is_driving  # it is already at its end
    bench.session.stop()
    bench.run(0.3, {**CENTRE, "x": 1.0})
    is_waiting_by_name = {
        view.name: view.is_waiting for view in bench.teleoperator.state.coordinates
    }
    assert is_waiting_by_name["x"]
    bench.run(0.1)
    assert bench.run(0.3, {**CENTRE, "x": -1.0}).command["x"] < high


def test_it_does_not_interfere_with_another_owner_of_an_axis(bench):
    start = bench.run(0.1).command["x"]
    bench.session.go_to({"x": start + 2e-3})
    state = bench.run(3.0)
    assert state.command["x"] == pytest.approx(start + 2e-3, abs=1e-9)
    bench.session.go_to({"y": start - 2e-3})
    bench.run(0.1, {**CENTRE, "x": 1.0})
    assert "moved by operator" in bench.teleoperator.state.reason
    bench.run(2.0)
    state = bench.run(0.5, {**CENTRE, "x": 1.0})
    assert state.command["x"] > start + 2.1e-3  # and it starts from the position of the axis


def test_it_stops_smoothly_at_the_end_of_a_range(bench):
    bench.session.go_to({"x": 0.0548})
    bench.run(8.0)
    state = bench.run(2.0, {**CENTRE, "x": 1.0})
    assert state.command["x"] == pytest.approx(0.055, abs=2e-7)
    bench.run(1.0)
    assert bench.run(0.5, {**CENTRE, "x": -1.0}).command["x"] < 0.0548
    bench.assert_smooth("x")


def test_it_slows_near_the_floor_and_never_goes_below_it(bench):
    bench.teleoperator.use_preset(5.0)
    bench.session.bounds.teach_floor(1e-3)
    floor = bench.session.bounds.keep_out.low
    bench.run(0.1)
    heights = []
    for _ in range(40):
        bench.run(0.1, {**CENTRE, "z": -1.0})
        heights.append(bench.session.snapshot().tip[2])
    assert min(heights) >= floor
    assert heights[-1] < floor + 0.3e-3
    assert bench.teleoperator.state.refusal_reason is not None
    assert bench.run(1.0, {**CENTRE, "z": 1.0}).tip[2] > heights[-1]


def test_an_axis_mapped_by_its_name_moves_in_every_mode(bench):
    start = bench.run(0.1, {**CENTRE, "zn": 0.0}).command
    state = bench.run(1.0, {**CENTRE, "x": 0.5, "zn": 1.0})
    assert state.command["zn"] > start["zn"] + 1e-6
    assert state.command["x"] > start["x"] + 1e-4


def test_hybrid_z_keeps_the_speed_of_the_tip_where_the_table_takes_over(bench):
    bench.teleoperator.use_mode("hybrid")
    bench.teleoperator.use_preset(0.2)
    bench.run(0.1)
    bench.run(0.05, {**CENTRE, "z": 1.0})
    begin = len(bench.read_path("z")[0])
    reserve = []
    for _ in range(8):
        bench.run(0.05, {**CENTRE, "z": 1.0})
        reserve.append(bench.teleoperator.state.reserve)
    assert reserve[0] > 0.4
    assert reserve[-1] == 0.0  # the piezo has come to its end
    times, z = bench.read_path("z")
    height = z + bench.read_path("zn")[1]
    speeds = np.diff(height[begin:]) / np.diff(times[begin:])
    assert np.abs(speeds / speeds.mean() - 1.0).max() < 0.15
    bench.assert_smooth("z")
    bench.assert_smooth("zn")


def test_pivot_holds_the_tip_and_shows_the_tilt(bench):
    bench.teleoperator.use_mode("pivot")
    before = np.array(bench.run(0.1).tip)
    state = bench.run(2.0, {**CENTRE, "x": 1.0, "y": 0.5})
    assert state.command["thy"] != pytest.approx(5.8e-4, abs=5e-5)
    assert np.abs(np.array(state.tip) - before).max() < 0.4e-6  # as commanded, during the move
    state = bench.run(0.5)
    assert np.abs(np.array(state.tip) - before).max() < 0.15e-6
    assert bench.teleoperator.state.tilt > 1e-4


def test_a_contact_is_felt_with_impedance(bench):
    teleoperator = bench.teleoperator
    teleoperator.use_mode("nano")
    teleoperator.use_law(LawKind.IMPEDANCE)
    bench.run(0.1)
    coordinate = teleoperator._find_frame().coordinates["zn"]
    scale = replace(teleoperator.scales.find_scale("nano", coordinate), contact_gain=1.0)
    teleoperator.use_scales(teleoperator.scales.with_scale("nano", "zn", scale))
    wall = AxisEffect(axis="zn", id="contact", parameters={"place": 36e-6, "stiffness": 2.0})
    bench.session.service.set_effects((wall,))
    bench.run(0.2)
    free = bench.run(0.3, {**CENTRE, "z": 0.5}).command["zn"]
    assert free < 36e-6
    force_ratios = []
    for _ in range(30):
        bench.run(0.1, {**CENTRE, "z": 0.5})
        view = next(c for c in teleoperator.state.coordinates if c.name == "zn")
        force_ratios.append(view.contact_force_ratio)
    assert force_ratios[0] == 0.0
    assert force_ratios[-1] < -0.3  # pushes back
    speed = next(c for c in teleoperator.state.coordinates if c.name == "zn").law.motion.velocity
    assert abs(speed) < 1e-6  # the stick's force and the wall's are in balance


def test_other_robots_can_be_steered():
    bench = OperatorBench("picma")
    axis = bench.axes[0]
    start = bench.run(0.1).command[axis]
    assert bench.run(0.5, {**CENTRE, "x": 1.0}).command[axis] != start


def test_a_disconnected_machine_is_reported(bench):
    bench.session.disconnect()
    bench.run(0.1)
    assert "not connected" in bench.teleoperator.state.reason
    assert bench.session.snapshot().activity is DeviceState.CLOSED
