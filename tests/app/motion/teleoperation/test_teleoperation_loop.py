"""The loop of teleoperation on the simulator, stepped by hand."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Phase
from rotemina.app.motion.teleoperation.intent import Action, Intent
from rotemina.app.motion.teleoperation.scales import LawKind, Scale, Scales
from rotemina.app.motion.teleoperation.teleoperation_loop import JOYSTICK, Teleoperator
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.dry_run import dry_run

TICK_S = 0.005
CENTRE = {"x": 0.0, "y": 0.0, "z": 0.0}


class Desk:
    """An operator at a stepped session."""

    def __init__(self, robot="rotemina", late=1, **settings):
        self.late = late  # how many steps of the operator's loop a speed takes to the machine
        self.clock = VirtualClock(5.0)
        driver = Simulator(load_robot(robot), settings, clock=self.clock)
        self.session = MotionSession(driver)
        self.session.connect()
        self.session.run_once()
        self.teleoperator = Teleoperator(self.session)
        self.axes = list(self.session.robot.axes)
        self.samples = []
        self.session.tap(lambda samples, _: self.samples.append(samples))

    def run(self, seconds, deflections=CENTRE, held=(), pressed=(), lost=None):
        """Hold the sticks there for a while; actions are pressed at the beginning."""
        steps = max(1, round(seconds / TICK_S))
        for number in range(steps):
            self.clock.advance(TICK_S)
            if number % self.late == 0:
                self.session.run_once()
            intent = Intent(
                self.clock(),
                dict(deflections),
                frozenset(pressed if number == 0 else ()),
                frozenset(held),
                "test",
                lost if number == 0 else None,
            )
            self.teleoperator.step(intent, self.clock())
        return self.session.snapshot()

    def path(self, axis):
        """Return times and commands of an axis, as applied, since the connection."""
        column = self.axes.index(axis)
        times = np.concatenate([one.device_time_s for one in self.samples])
        return times, np.concatenate([one.command[:, column] for one in self.samples])

    def smooth(self, axis):
        """Assert that an axis' command has neither a step nor more than its acceleration."""
        times, path = self.path(axis)
        model = self.session.robot.axes[axis]
        dt = np.diff(times)
        speed = np.diff(path) / dt
        assert np.abs(speed).max() <= model.max_speed * (1 + 1e-6)
        # A tick's rounding of the command is no acceleration of the axis.
        assert np.abs(np.diff(speed)).max() <= model.max_acceleration * dt.max() * (1 + 1e-6)


@pytest.fixture
def desk():
    return Desk()


def test_a_stick_moves_an_axis_at_a_rate_and_lets_it_rest(desk):
    start = desk.run(0.1).command
    desk.run(1.0, {**CENTRE, "x": 0.5})
    state = desk.session.snapshot()
    assert state.owners["x"] == JOYSTICK
    assert set(state.owners) == {"x"}  # the others are free
    assert desk.teleoperator.state.driving
    state = desk.run(0.5)
    assert not desk.teleoperator.state.driving
    assert state.phase is Phase.READY
    assert state.command["x"] - start["x"] == pytest.approx(0.5e-3, rel=0.02)
    assert state.command["y"] == start["y"]
    desk.smooth("x")


def test_the_axis_ends_on_the_reference(desk):
    desk.run(0.1)
    desk.run(0.8, {**CENTRE, "y": -1.0})
    state = desk.run(0.6)
    view = desk.teleoperator.state.coordinates[1]
    assert abs(view.position - state.command["y"]) <= 1e-7


def test_linear_position_follows_the_stick_and_comes_back(desk):
    desk.teleoperator.use_law(LawKind.POSITION)
    start = desk.run(0.1).command["x"]
    state = desk.run(1.0, {**CENTRE, "x": 1.0})
    assert state.command["x"] - start == pytest.approx(5e-4, abs=1.5e-7)
    state = desk.run(1.0)
    assert state.command["x"] - start == pytest.approx(0.0, abs=1.5e-7)
    x = desk.path("x")[1]
    assert x.max() - start <= 1.01 * 5e-4  # nearly no overshoot
    desk.smooth("x")


@pytest.mark.parametrize("late", [1, 2, 3, 6])
@pytest.mark.parametrize("stick", ["y", "z"])
def test_a_piezo_follows_a_stick_that_jumps_without_overshoot_however_late_it_hears(late, stick):
    desk = Desk(late=late)
    axis = {"y": "thx", "z": "zn"}[stick]
    desk.teleoperator.use_mode("nano")
    desk.teleoperator.use_law(LawKind.POSITION)
    desk.run(0.2)
    desk.run(1.5, {**CENTRE, stick: 0.5})
    way = np.abs(desk.path(axis)[1] - desk.path(axis)[1][0])
    assert way[-1] == pytest.approx(0.125 * desk.session.robot.axes[axis].span, rel=2e-3)
    assert way.max() <= (1.01 if late <= 3 else 1.1) * way[-1]


@pytest.mark.parametrize("law", list(LawKind))
def test_what_was_steered_to_the_end_of_a_piezo_s_range_may_be_played_again(law):
    desk = Desk(late=3)
    robot = desk.session.robot
    quick = Scale(way=1e-3, speed=0.04, time_constant_s=0.1)
    desk.teleoperator.use_scales(Scales().with_scale("nano", "thx", quick))
    desk.teleoperator.use_mode("nano")
    desk.teleoperator.use_law(law)
    desk.run(0.2)
    desk.run(1.0, {**CENTRE, "y": 1.0})
    desk.run(1.0, {**CENTRE, "y": -1.0})
    desk.run(0.5)
    times, path = desk.path("thx")
    low, high = robot.axes["thx"].range
    assert np.ptp(path) > 0.9 * (high - low)
    grid = np.arange(times[0], times[-1], TICK_S)
    signals = {("thx", Tap.CMD): np.interp(grid, times, path)}
    record = Record.from_signals(grid - grid[0], signals, {"thx": "rad"}, {})
    assert dry_run(robot, record).objections == ()


def test_a_clutch_reindexes(desk):
    desk.teleoperator.use_law(LawKind.POSITION)
    start = desk.run(0.1).command["x"]
    desk.run(1.0, {**CENTRE, "x": 1.0})
    desk.run(0.3, {**CENTRE, "x": 1.0}, held={Action.CLUTCH})
    there = desk.run(0.3, held={Action.CLUTCH}).command["x"]
    assert there - start == pytest.approx(5e-4, abs=2e-7)
    state = desk.run(0.5)
    assert state.command["x"] == pytest.approx(there, abs=1e-7)
    state = desk.run(1.0, {**CENTRE, "x": 1.0})
    assert state.command["x"] - start == pytest.approx(1e-3, abs=3e-7)


def test_a_stick_that_is_deflected_when_a_mode_begins_does_nothing_until_centred(desk):
    start = desk.run(0.5, {**CENTRE, "x": 1.0}).command["x"]
    assert "x" in {c.name for c in desk.teleoperator.state.coordinates if c.waiting}
    assert desk.run(0.1).command["x"] == start
    assert desk.run(0.5, {**CENTRE, "x": 1.0}).command["x"] > start


@pytest.mark.parametrize("first", list(LawKind))
@pytest.mark.parametrize("second", list(LawKind))
def test_laws_are_switched_in_mid_move_without_a_jump(desk, first, second):
    desk.teleoperator.use_law(first)
    desk.run(0.1)
    desk.run(0.3, {**CENTRE, "x": 0.8})
    desk.teleoperator.use_law(second)
    desk.run(0.3, {**CENTRE, "x": 0.8})
    desk.run(0.3)
    desk.smooth("x")


@pytest.mark.parametrize("law", list(LawKind))
def test_every_mode_follows_every_other_in_mid_move_without_a_jump(desk, law):
    desk.teleoperator.use_law(law)
    sticks = {"x": 0.6, "y": -0.4, "z": 0.5}
    desk.run(0.1)
    seen = []
    for _ in range(len(desk.teleoperator.modes.names)):
        desk.run(0.15)
        desk.run(0.3, sticks)
        before = desk.session.snapshot().command
        desk.run(TICK_S, sticks, pressed={Action.STAGE})
        seen.append(desk.teleoperator.state.mode)
        # Nothing begins to move by the switch: what the stick held is not taken over.
        desk.run(0.25, sticks)
        assert desk.teleoperator.state.refused is None
        assert before
    assert sorted(seen) == sorted(desk.teleoperator.modes.names)
    for axis in desk.axes:
        desk.smooth(axis)


def test_fine_and_coarse_and_presets_change_the_speed_without_a_jump(desk):
    desk.run(0.1)
    travelled = []
    for held in ((), (Action.FINE,), (Action.COARSE,)):
        begin = desk.run(0.2, {**CENTRE, "x": 0.5}, held=held).command["x"]
        end = desk.run(0.5, {**CENTRE, "x": 0.5}, held=held).command["x"]
        travelled.append(end - begin)
    assert travelled[1] / travelled[0] == pytest.approx(0.1, rel=0.25)
    assert travelled[2] / travelled[0] == pytest.approx(10.0, rel=0.15)
    desk.run(TICK_S, pressed={Action.STEP_PRESET})
    assert desk.teleoperator.state.preset == 2.0
    desk.smooth("x")


def test_a_dead_man_let_go_of_halts(desk):
    for law in LawKind:
        desk.teleoperator.use_law(law)
        desk.run(0.1)
        desk.run(0.1, {**CENTRE, "x": 1.0})
        begin = desk.session.snapshot().command["x"]
        state = desk.run(1.0, {})
        assert abs(state.command["x"] - begin) < 3e-4
        assert state.phase is Phase.READY
        assert "no stick" in desk.teleoperator.state.reason


def test_a_lost_device_stops(desk):
    desk.run(0.1)
    desk.run(0.3, {**CENTRE, "x": 1.0})
    begin = desk.session.snapshot().command["x"]
    state = desk.run(0.3, {}, lost="stick: unplugged")
    assert state.command["x"] - begin < 5e-5
    assert state.stop_latency_s is not None
    assert desk.teleoperator.state.refused == "stick: unplugged"


def test_stop_and_emergency_stop_by_button(desk):
    desk.run(0.1)
    desk.run(0.2, {**CENTRE, "x": 1.0})
    desk.run(0.2, pressed={Action.STOP})
    assert desk.session.snapshot().phase is Phase.READY
    desk.run(0.2, {**CENTRE, "x": 1.0})
    desk.run(0.2, {**CENTRE, "x": 1.0}, pressed={Action.EMERGENCY_STOP})
    state = desk.session.snapshot()
    assert state.latched == "the joystick's stop and lock"
    begin = state.command["x"]
    assert desk.run(0.3, {**CENTRE, "x": 1.0}).command["x"] == begin
    desk.session.release()
    # Released, a stick that is still deflected must come back to the middle first.
    assert desk.run(0.3, {**CENTRE, "x": 1.0}).command["x"] == begin
    desk.run(0.1)
    assert desk.run(0.3, {**CENTRE, "x": 1.0}).command["x"] > begin


def test_after_a_stop_that_found_all_at_rest_a_held_stick_counts_no_more(desk):
    high = desk.session.robot.axes["x"].range[1]
    desk.session.go_to({"x": high})
    desk.run(8.0)
    desk.run(0.3, {**CENTRE, "x": 1.0})
    assert not desk.teleoperator.state.driving  # it is at its end already
    desk.session.stop()
    desk.run(0.3, {**CENTRE, "x": 1.0})
    waiting = {view.name: view.waiting for view in desk.teleoperator.state.coordinates}
    assert waiting["x"]
    desk.run(0.1)
    assert desk.run(0.3, {**CENTRE, "x": -1.0}).command["x"] < high


def test_a_stick_that_was_in_the_middle_counts_at_once_where_the_machine_was_moved(desk):
    desk.run(0.3)
    start = desk.session.snapshot().command["x"]
    desk.session.go_to({"x": start + 1e-4})
    moved = desk.run(2.0).command["x"]
    assert moved == pytest.approx(start + 1e-4, abs=1e-9)
    assert desk.run(0.3, {**CENTRE, "x": 1.0}).command["x"] > moved


def test_it_does_not_fight_with_what_else_moves_an_axis(desk):
    start = desk.run(0.1).command["x"]
    desk.session.go_to({"x": start + 2e-3})
    state = desk.run(3.0)
    assert state.command["x"] == pytest.approx(start + 2e-3, abs=1e-9)
    desk.session.go_to({"y": start - 2e-3})
    desk.run(0.1, {**CENTRE, "x": 1.0})
    assert "moved by operator" in desk.teleoperator.state.reason
    desk.run(2.0)
    state = desk.run(0.5, {**CENTRE, "x": 1.0})
    assert state.command["x"] > start + 2.1e-3  # and it begins where the axis is


def test_it_ends_softly_at_the_end_of_a_range(desk):
    desk.session.go_to({"x": 0.0548})
    desk.run(8.0)
    state = desk.run(2.0, {**CENTRE, "x": 1.0})
    assert state.command["x"] == pytest.approx(0.055, abs=2e-7)
    desk.run(1.0)
    assert desk.run(0.5, {**CENTRE, "x": -1.0}).command["x"] < 0.0548
    desk.smooth("x")


def test_close_to_the_floor_it_is_slowed_and_never_goes_below(desk):
    desk.teleoperator.use_preset(5.0)
    desk.session.bounds.teach_floor(1e-3)
    floor = desk.session.bounds.keep_out.low
    desk.run(0.1)
    heights = []
    for _ in range(40):
        desk.run(0.1, {**CENTRE, "z": -1.0})
        heights.append(desk.session.snapshot().tip[2])
    assert min(heights) >= floor
    assert heights[-1] < floor + 0.3e-3
    assert desk.teleoperator.state.refused is not None
    assert desk.run(1.0, {**CENTRE, "z": 1.0}).tip[2] > heights[-1]


def test_an_axis_that_is_mapped_by_its_own_name_moves_in_every_mode(desk):
    start = desk.run(0.1, {**CENTRE, "zn": 0.0}).command
    state = desk.run(1.0, {**CENTRE, "x": 0.5, "zn": 1.0})
    assert state.command["zn"] > start["zn"] + 1e-6
    assert state.command["x"] > start["x"] + 1e-4


def test_hybrid_z_keeps_the_speed_of_the_tip_where_the_table_takes_over(desk):
    desk.teleoperator.use_mode("hybrid")
    desk.teleoperator.use_preset(0.2)
    desk.run(0.1)
    desk.run(0.05, {**CENTRE, "z": 1.0})
    begin = len(desk.path("z")[0])
    reserve = []
    for _ in range(8):
        desk.run(0.05, {**CENTRE, "z": 1.0})
        reserve.append(desk.teleoperator.state.reserve)
    assert reserve[0] > 0.4
    assert reserve[-1] == 0.0  # the piezo has come to its end
    times, z = desk.path("z")
    height = z + desk.path("zn")[1]
    speeds = np.diff(height[begin:]) / np.diff(times[begin:])
    assert np.abs(speeds / speeds.mean() - 1.0).max() < 0.15
    desk.smooth("z")
    desk.smooth("zn")


def test_pivot_holds_the_tip_and_shows_what_it_turns(desk):
    desk.teleoperator.use_mode("pivot")
    before = np.array(desk.run(0.1).tip)
    state = desk.run(2.0, {**CENTRE, "x": 1.0, "y": 0.5})
    assert state.command["thy"] != pytest.approx(5.8e-4, abs=5e-5)
    assert np.abs(np.array(state.tip) - before).max() < 0.4e-6  # as commanded, in mid-move
    state = desk.run(0.5)
    assert np.abs(np.array(state.tip) - before).max() < 0.15e-6
    assert desk.teleoperator.state.tilt > 1e-4


def test_a_contact_is_felt_with_impedance(desk):
    teleoperator = desk.teleoperator
    teleoperator.use_mode("nano")
    teleoperator.use_law(LawKind.IMPEDANCE)
    desk.run(0.1)
    coordinate = teleoperator._frame().coordinates["zn"]
    scale = replace(teleoperator.scales.of("nano", coordinate), contact_gain=1.0)
    teleoperator.use_scales(teleoperator.scales.with_scale("nano", "zn", scale))
    wall = AxisEffect(axis="zn", id="contact", parameters={"place": 36e-6, "stiffness": 2.0})
    desk.session.service.set_effects((wall,))
    desk.run(0.2)
    free = desk.run(0.3, {**CENTRE, "z": 0.5}).command["zn"]
    assert free < 36e-6
    felt = []
    for _ in range(30):
        desk.run(0.1, {**CENTRE, "z": 0.5})
        view = next(c for c in teleoperator.state.coordinates if c.name == "zn")
        felt.append(view.felt)
    assert felt[0] == 0.0
    assert felt[-1] < -0.3  # pushes back
    speed = next(c for c in teleoperator.state.coordinates if c.name == "zn").law.motion.velocity
    assert abs(speed) < 1e-6  # the stick's force and the wall's are in balance


def test_other_robots_are_steered_by_their_axes():
    desk = Desk("picma")
    axis = desk.axes[0]
    start = desk.run(0.1).command[axis]
    assert desk.run(0.5, {**CENTRE, "x": 1.0}).command[axis] != start


def test_a_disconnected_machine_is_said(desk):
    desk.session.disconnect()
    desk.run(0.1)
    assert "not connected" in desk.teleoperator.state.reason
    assert desk.session.snapshot().activity is DeviceState.CLOSED
