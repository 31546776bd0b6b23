"""One-sided approaches: their side, their bounds, and the motions without one."""

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.session import OneSidedApproach, find_measured_backlash
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
X_COLUMN = tuple(ROBOT.axes).index("x")
APPROACH_WIDTH_M = 20e-6
RISING = OneSidedApproach(APPROACH_WIDTH_M, rising=True)
MIDDLE_X = ROBOT.axes["x"].range[1] / 2


@pytest.fixture
def machine(make_harness):
    harness = make_harness()
    harness.portions = []
    harness.session.tap(lambda samples, _: harness.portions.append(samples))
    harness.step(0.05, 3)
    harness.session.go_to({"x": MIDDLE_X})
    harness.settle()
    harness.session.backlash.set_approach("x", RISING)
    return harness


def record_commands(harness, action):
    """Execute an action and return the commands of x (n,) until the machine is at rest."""
    harness.portions.clear()
    action()
    harness.settle()
    return np.concatenate([samples.command[:, X_COLUMN] for samples in harness.portions])


def test_every_target_is_approached_from_below(machine):
    session = machine.session
    assert not session.backlash.is_taken_up("x")  # the direction of the last motion is unknown
    for action, lowest in (
        # Too short to take up the backlash.
        (
            lambda: session.jog("x", 5e-6),
            MIDDLE_X + 5e-6 - APPROACH_WIDTH_M,
        ),
        (lambda: session.jog("x", 1e-6), MIDDLE_X + 5e-6),  # taken up, so without an approach
        (lambda: session.jog("x", -1e-6), MIDDLE_X + 5e-6 - APPROACH_WIDTH_M),
        (lambda: session.go_to({"x": MIDDLE_X + 1e-3}), MIDDLE_X + 5e-6),
        (lambda: session.go_to({"x": MIDDLE_X - 1e-3}), MIDDLE_X - 1e-3 - APPROACH_WIDTH_M),
        (session.undo, MIDDLE_X - 1e-3),
        (lambda: session.go_safely({"x": MIDDLE_X - 2e-3}), MIDDLE_X - 2e-3 - APPROACH_WIDTH_M),
    ):
        command = record_commands(machine, action)
        assert command.min() == pytest.approx(lowest, abs=1e-9)
        moving_steps = np.flatnonzero(np.diff(command))
        assert command[moving_steps[-1] + 1] > command[moving_steps[-1]]
        assert session.backlash.is_taken_up("x")
    assert command[-1] == pytest.approx(MIDDLE_X - 2e-3, abs=1e-9)


def test_backlash_does_not_change_the_reading_between_directions(machine):
    session = machine.session
    backlash = AxisEffect(axis="x", id="backlash", parameters={"width": 0.5 * APPROACH_WIDTH_M})
    session.service.set_effects([backlash])
    machine.settle()
    differences = []
    for approach in (None, RISING):
        session.backlash.set_approach("x", approach)
        readings = []
        for start in (MIDDLE_X + 1e-3, MIDDLE_X - 1e-3):
            session.go_to({"x": start})
            machine.settle()
            session.go_to({"x": MIDDLE_X})
            machine.settle()
            machine.step(0.02, 25)
            readings.append(session.snapshot().measured["x"])
        differences.append(abs(readings[0] - readings[1]))
    assert differences[0] > 0.4 * APPROACH_WIDTH_M
    assert differences[1] < 0.05 * APPROACH_WIDTH_M


def test_a_falling_approach_comes_from_above(machine):
    machine.session.backlash.set_approach("x", OneSidedApproach(APPROACH_WIDTH_M, rising=False))
    command = record_commands(machine, lambda: machine.session.jog("x", 1e-4))
    assert command.max() == pytest.approx(MIDDLE_X + 1e-4 + APPROACH_WIDTH_M, abs=1e-9)
    assert command[-1] == pytest.approx(MIDDLE_X + 1e-4, abs=1e-9)


def test_range_narrowed_range_and_floor_apply_to_the_approach(machine):
    session = machine.session
    with pytest.raises(OutOfLimitsError, match=r"to 10 µm begins at -10 µm, outside 0 .* 20 µm"):
        session.go_to({"x": 1e-5})
    session.ranges.narrow("x", MIDDLE_X - 1e-3, MIDDLE_X + 1e-3)
    with pytest.raises(OutOfLimitsError, match="one-sided approach to"):
        session.go_to({"x": MIDDLE_X - 1e-3 + 0.5 * APPROACH_WIDTH_M})
    session.go_to({"x": MIDDLE_X - 1e-3 + APPROACH_WIDTH_M})
    machine.settle()
    session.bounds.teach_floor(5e-6)
    session.backlash.set_approach("z", OneSidedApproach(APPROACH_WIDTH_M, rising=True))
    with pytest.raises(OutOfLimitsError, match=r"floor.*the one-sided approach begins there"):
        session.jog("z", -1e-6)
    session.backlash.set_approach("z", OneSidedApproach(APPROACH_WIDTH_M, rising=False))
    session.jog("z", -1e-6)
    machine.settle()


def test_another_move_does_not_leave_an_axis_beyond_its_target(machine):
    session = machine.session
    session.go_to({"x": MIDDLE_X - 1e-3})
    machine.step(0.02, 3)
    session.jog("y", 1e-4)
    machine.settle()
    assert session.snapshot().command["x"] == pytest.approx(MIDDLE_X - 1e-3, abs=1e-9)
    session.jog("x", -1e-4)
    session.jog("y", 1e-4)  # before the first jog has begun
    machine.settle()
    assert session.snapshot().command["x"] == pytest.approx(MIDDLE_X - 1.1e-3, abs=1e-9)


def test_a_jog_during_an_approach_counts_from_the_target(machine):
    session = machine.session
    session.jog("x", -1e-3)
    machine.step(0.02, 3)
    session.jog("x", -1e-3)
    machine.settle()
    assert session.snapshot().command["x"] == pytest.approx(MIDDLE_X - 2e-3, abs=1e-9)
    assert not session.backlash.is_taken_up("x")


def test_a_stop_ends_an_approach_beyond_the_target(machine):
    session = machine.session
    session.go_to({"x": MIDDLE_X - 1e-3})
    machine.step(0.02, 3)
    session.stop()
    machine.settle()
    machine.step(0.05, 10)
    halted = session.snapshot().command["x"]
    assert halted > MIDDLE_X - 1e-3
    assert not session.backlash.is_taken_up("x")


def test_speeds_do_not_overshoot_and_leave_the_backlash_not_taken_up(machine):
    session = machine.session
    record_commands(machine, lambda: session.jog("x", 1e-6))
    assert session.backlash.is_taken_up("x")
    command = record_commands(machine, lambda: session.move_velocity({"x": -1e-4}, 0.1))
    assert (np.diff(command) <= 0.0).all()
    assert not session.backlash.is_taken_up("x")


def test_an_invalid_approach_is_refused_with_the_bound(machine):
    session = machine.session
    with pytest.raises(OutOfLimitsError, match="zn is not a stepper axis"):
        session.backlash.set_approach("zn", RISING)
    for width in (0.0, 1e-3, float("nan")):
        with pytest.raises(OutOfLimitsError, match="above 0 and at most 550 µm"):
            session.backlash.set_approach("x", OneSidedApproach(width, rising=True))
    session.jog("x", 1e-3)
    machine.step(0.02)
    with pytest.raises(RequestRefusedError, match="still moving"):
        session.backlash.set_approach("x", None)
    machine.settle()
    assert machine.session.snapshot().activity is DeviceState.IDLE
    session.use_driver(type(machine.driver)(ROBOT, clock=machine.clock))
    assert session.backlash.applied == {}


def test_the_measured_backlash_is_that_of_the_enabled_effect():
    def make_effect(axis="x", name="backlash", *, enabled=True, **parameters):
        return AxisEffect(axis=axis, id=name, parameters=parameters, enabled=enabled)

    effects = (
        make_effect(width=1e-6),
        make_effect(width=5e-6, enabled=False),
        make_effect("y", width=3e-6),
        make_effect(name="periodic_error"),
    )
    assert find_measured_backlash(ROBOT, effects, "x") == pytest.approx(1e-6)
    assert find_measured_backlash(ROBOT, effects, "z") is None
