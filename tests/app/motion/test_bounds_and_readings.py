"""Bounds do not trust a single reading: sessions whose command and reading disagree."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.state import AlarmRaised, FaultRaised
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.simulator import Simulator
from rotemina.sim.effects import AttachedEffect, list_effect_ids
from rotemina.sim.errors import EffectError, OutOfLimitsError
from rotemina.sim.kinematics import MAX_SLOW_ZONE_SPEED_M_PER_S
from rotemina.sim.robot import AxisEffect, KeepOut
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
DISH = replace(ROBOT, keep_out=KeepOut(floor=-0.02, objective=-0.03))
WIDE_AXES = {name: replace(axis, following_bound=axis.span) for name, axis in ROBOT.axes.items()}


class MisreadingSimulator(Simulator):
    """A simulator whose sensors read with errors."""

    name = "misread"

    def __init__(self, *args, **options):
        super().__init__(*args, **options)
        self.errors = {}
        self.single_errors = {}

    def _read(self):
        samples = super()._read()
        if not len(samples) or not (self.errors or self.single_errors):
            return samples
        measured = samples.measured.copy()
        for axis, error in self.errors.items():
            measured[:, self.axes.index(axis)] += error
        for axis, error in self.single_errors.items():
            measured[-1, self.axes.index(axis)] += error
        self.single_errors = {}
        return replace(samples, measured=measured)


@pytest.fixture
def make_misreading(make_harness):
    def make_misreading(robot=DISH, **errors):
        harness = make_harness(robot, driver=MisreadingSimulator)
        harness.driver.errors = errors
        harness.step(times=3)
        return harness

    return make_misreading


@pytest.mark.parametrize("z", [-0.04, -0.021])
def test_a_wrong_reading_of_z_allows_no_motion_down(make_misreading, z):
    """A reading 40 mm too low with a floor at -20 mm allows no motion down, locked or not."""
    harness = make_misreading(replace(DISH, axes=WIDE_AXES), z=z)
    before = harness.session.snapshot().command["z"]
    with pytest.raises(OutOfLimitsError, match="below its floor"):
        harness.session.go_to({"z": 0.005})
    with pytest.raises(OutOfLimitsError):
        harness.session.go_to({"z": 0.005}, confirmed=True)
    with pytest.raises(OutOfLimitsError, match="does not bring it back"):
        harness.session.jog("x", 1e-3, confirmed=True)
    for request in (
        lambda: harness.session.jog("z", 1e-3),
        lambda: harness.session.move_velocity({"z": 1e-3}),
        lambda: harness.session.set_voltage("zn", 60.0),
        lambda: harness.session.go_safely({"z": 0.05}),
    ):
        with pytest.raises(OutOfLimitsError, match="may only move back inside"):
            request()
    harness.step(times=10)
    assert harness.session.snapshot().command["z"] == before
    harness.session.jog("z", 1e-3, confirmed=True)
    harness.step_until_idle()
    window = harness.session.history.tail()
    assert np.diff(window.command[:, 2]).max() <= 1.001e-3 * MAX_SLOW_ZONE_SPEED_M_PER_S
    assert harness.session.snapshot().command["z"] == pytest.approx(before + 1e-3)


def test_a_wrong_reading_locks_motion_until_repaired_and_confirmed(make_misreading):
    harness = make_misreading()
    harness.session.go_to({"x": 0.03})
    harness.step()
    harness.driver.errors = {"z": -0.04}
    state = harness.step(times=8)
    assert state.lock_reason.startswith("axis z reads 40 mm away from its command")
    assert "home, or confirm it" in state.lock_reason
    assert len(harness.list_events(FaultRaised)) == 1
    stopped_x = harness.step_until_idle().command["x"]
    assert 0.0275 < stopped_x < 0.03
    for confirmed in (False, True):
        with pytest.raises(RequestRefusedError, match="motion is locked: axis z"):
            harness.session.go_to({"z": 0.005}, confirmed=confirmed)
    harness.session.confirm_position()  # the error is still there
    assert "axis z reads" in harness.step(0.02, 10).lock_reason
    harness.driver.errors = {}
    assert harness.step(0.02, 20).lock_reason is not None  # the repair is not confirmed yet
    harness.session.confirm_position()
    assert harness.step(times=3).lock_reason is None
    harness.session.go_to({"x": 0.03})
    assert harness.step_until_idle().command["x"] == 0.03


def lock_by_misreading(make_misreading, axis):
    """Return a session locked by an axis that reads wrong by a fifth of its range."""
    harness = make_misreading(**{axis: 0.2 * ROBOT.axes[axis].span})
    if axis == "zn":
        harness.driver.errors = {axis: 0.5 * ROBOT.axes[axis].span}
    assert f"axis {axis} reads" in harness.step(times=8).lock_reason
    harness.driver.errors = {}
    return harness


def home(harness, *axes):
    harness.session.home(axes)
    harness.step()
    assert harness.session.snapshot().activity is DeviceState.HOMING
    return harness.step_until_idle()


def test_homing_unlocks_only_the_homed_axes(make_misreading):
    harness = lock_by_misreading(make_misreading, "x")
    assert "axis x reads" in home(harness, "y").lock_reason
    assert home(harness, "x").lock_reason is None
    # zn has no switch, so the operator has to confirm it.
    harness = lock_by_misreading(make_misreading, "zn")
    assert "axis zn reads" in home(harness, "x", "y", "z").lock_reason
    harness.session.confirm_position()
    assert harness.step(times=3).lock_reason is None


def test_a_stop_cancels_a_confirmation_of_the_position(make_misreading, monkeypatch):
    harness = lock_by_misreading(make_misreading, "x")
    session, take_command = harness.session, harness.session._link.mailbox.take_command

    def take_command_and_stop():
        command = take_command()
        if command is not None:
            session.stop()
        return command

    monkeypatch.setattr(session._link.mailbox, "take_command", take_command_and_stop)
    session.confirm_position()
    assert "axis x reads" in harness.step(times=3).lock_reason


def test_a_single_outlier_changes_nothing(make_misreading):
    harness = make_misreading()
    for error in (-0.04, 0.04):
        for _ in range(20):
            harness.driver.single_errors = {"z": error}
            harness.step()
            with pytest.raises(OutOfLimitsError, match="its floor is"):
                harness.session.go_to({"z": 0.005})
    assert harness.session.snapshot().lock_reason is None
    assert not harness.list_events(AlarmRaised)
    harness.session.go_to({"z": 0.041})


def test_removing_or_teaching_the_floor_keeps_the_objective(make_harness):
    harness = make_harness(DISH, driver=Simulator)
    harness.step()
    harness.session.bounds.clear_floor()
    with pytest.raises(OutOfLimitsError, match="its floor is -30 mm, where the objective is"):
        harness.session.go_to({"z": 0.005})
    harness.session.bounds.teach_floor(0.035)
    with pytest.raises(OutOfLimitsError, match="where the objective is"):
        harness.session.go_to({"z": 0.005})


@pytest.mark.parametrize("clearance", [float("nan"), 1e308, 1.0, -1e-3])
def test_an_invalid_floor_is_refused(make_harness, clearance):
    harness = make_harness(DISH, driver=Simulator)
    harness.step()
    before = harness.session.bounds.keep_out
    with pytest.raises(OutOfLimitsError, match="must be"):
        harness.session.bounds.teach_floor(clearance)
    assert harness.session.bounds.keep_out is before


@pytest.mark.parametrize("request_", ["teach_floor", "clear_floor"])
def test_the_floor_changes_only_at_rest(make_harness, request_):
    harness = make_harness(DISH, driver=Simulator)
    harness.step()
    change = getattr(harness.session.bounds, request_)
    harness.session.go_to({"z": 0.035})
    for _ in range(3):  # queued, handed over but not moving yet, and moving
        with pytest.raises(RequestRefusedError, match="still moving"):
            change()
        harness.session.run_once()
    harness.step(0.1)
    with pytest.raises(RequestRefusedError, match="still moving"):
        change()
    harness.step_until_idle()
    change()


def test_a_voltage_is_set_only_at_rest(make_harness):
    harness = make_harness(driver=Simulator)
    harness.step()
    harness.session.jog("x", 1e-3)
    with pytest.raises(RequestRefusedError, match="still moving"):
        harness.session.set_voltage("zn", 10.0)
    harness.step_until_idle()
    harness.session.set_voltage("zn", 10.0)


#: Overshoot as a share of the range, as docs/safety.md states it for a single move.
OVERSHOOT = {"x": 1e-5, "y": 1e-5, "z": 1e-5, "thx": 0.065, "thy": 0.065, "zn": 0.06}
#: Overshoot after any sequence of requests.
IN_ANY_ORDER = {**OVERSHOOT, "thx": 0.10, "thy": 0.10}


def test_the_safety_page_states_the_overshoot():
    page = (Path(__file__).parents[3] / "docs" / "safety.md").read_text("utf-8")
    row = r"^\| ([\w, ]+) \| ([0-9.]+) % \| ([0-9.]+) % \|$"
    for column, expected in ((1, OVERSHOOT), (2, IN_ANY_ORDER)):
        rows = [(match[0], match[column]) for match in re.findall(row, page, re.MULTILINE)]
        stated = {
            axis: 0.01 * float(percent) for axes, percent in rows for axis in axes.split(", ")
        }
        assert stated == pytest.approx(expected)


def cross_ranges(harness):
    """Move each axis from end to end, and the piezos also by voltage."""
    session = harness.session
    for share in (0.0, 1.0, 0.0):
        for axis, model in ROBOT.axes.items():
            low, high = model.range
            session.go_to({axis: low + share * (high - low)})
            harness.step_until_idle()
            harness.step(0.02, 10)
    for volts in (130.0, 0.0):
        for axis in ("thx", "thy", "zn"):
            session.set_voltage(axis, volts)
            harness.step_until_idle()
            harness.step(0.02, 10)


def test_no_axis_overshoots_its_range_more_than_stated(make_harness):
    harness = make_harness(driver=Simulator)
    harness.step()
    overshoot = dict.fromkeys(ROBOT.axes, 0.0)

    def record_overshoot(samples, _):
        for column, (name, axis) in enumerate(ROBOT.axes.items()):
            position, (low, high) = samples.reference[:, column], axis.range
            share = max(low - position.min(), position.max() - high) / axis.span
            overshoot[name] = max(overshoot[name], float(share))

    harness.session.tap(record_overshoot)
    cross_ranges(harness)
    for axis, share in OVERSHOOT.items():
        assert overshoot[axis] <= share, axis


def attach_typical_effects(effect):
    """Return an effect of typical size on every axis to which it can be attached."""
    effects = []
    source_axes = {"x": "y", "y": "x", "z": "y", "thx": "thy", "thy": "thx", "zn": None}
    for axis in ROBOT.axes:
        if effect == "contact" and ROBOT.axes[axis].kind == "stepper":
            continue  # a table that is moved millimetres into a stop must lock
        for source_axis in (None, source_axes[axis]):
            try:
                AttachedEffect.of(
                    ROBOT, attached := AxisEffect(axis=axis, id=effect, from_axis=source_axis)
                )
            except EffectError:
                continue
            effects.append(attached)
            break
    return tuple(effects)


@pytest.mark.parametrize("effect", list_effect_ids())
def test_no_typical_effect_locks_motion(make_harness, effect):
    effects = attach_typical_effects(effect)
    assert effects
    harness = make_harness(replace(ROBOT, effects=effects), driver=Simulator)
    harness.step()
    for share in (0.0, 1.0):
        harness.session.go_to(
            {name: axis.range[0] + share * axis.span for name, axis in ROBOT.axes.items()}
        )
        harness.step_until_idle()
        harness.step(0.02, 10)
    for axis in ("thx", "thy", "zn"):
        harness.session.set_voltage(axis, 130.0)
        harness.step_until_idle()
        harness.step(0.02, 10)
    assert harness.session.snapshot().lock_reason is None
    assert not harness.list_events(FaultRaised)
