"""Inverses in a session: every path goes through them, and no command jumps."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.session import NamedInverse
from rotemina.app.motion.state import CommandRefused, PlaybackFinished
from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.sim.compensate import Inverse, InverseExceedance, InverseModel
from rotemina.sim.errors import CompensationError, InputError, OutOfLimitsError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
ZN = ROBOT.axes["zn"]
COLUMN = tuple(ROBOT.axes).index("zn")
TICK_S = 1e-3
MODEL = InverseModel(
    axis="zn",
    unit="m",
    kind="prandtl_ishlinskii",
    sample_s=TICK_S,
    origin=0.0,
    command_origin=0.0,
    span=ZN.span,
    desired_range=(2e-6, 60e-6),
    command_range=ZN.range,
    speed=1.0,
    consequents=np.array([[0.0, 0.9, 0.1]]),
    radii=np.array([0.1]),
    initial=np.zeros(1),
)
NAMED = NamedInverse(MODEL, ROBOT.name, "PI, zn.json")
PATH = 30e-6 + 15e-6 * np.sin(2.0 * np.pi * 2.0 * TICK_S * np.arange(500))


@pytest.fixture
def machine(make_harness):
    """A session at rest with the inverse applied; ``portions`` holds its samples since then."""
    harness = make_harness()
    harness.portions = []
    harness.session.tap(lambda samples, _: harness.portions.append(samples))
    harness.step(0.05, 3)
    harness.session.inverses.apply(NAMED)
    harness.step(0.05, 2)
    assert set(harness.session.inverses.applied) == {"zn"}
    return harness


def make_trajectory(path=PATH):
    return Record.from_signals(TICK_S * np.arange(len(path)), {("zn", Tap.CMD): path}, {"zn": "m"})


def read_commands(harness):
    """Return the wanted and the sent commands (n,), m, of all samples."""
    command = np.concatenate([samples.command[:, COLUMN] for samples in harness.portions])
    return command, np.concatenate(
        [samples.inputs[:, COLUMN] for samples in harness.portions]
    ) * ZN.gain


def test_applying_and_removing_an_inverse_causes_no_jump(machine):
    command, sent = read_commands(machine)
    assert np.ptp(sent) < 1e-15
    start = machine.session.snapshot().command["zn"]
    assert start != pytest.approx(sent[-1], abs=1e-7)
    assert Inverse(MODEL, TICK_S).step(start) == pytest.approx(sent[-1], abs=1e-12)
    machine.session.jog("zn", 5e-6)  # from the present command
    machine.settle()
    assert machine.session.snapshot().command["zn"] == pytest.approx(start + 5e-6)
    previous = read_commands(machine)[1][-1]
    machine.session.inverses.remove("zn")
    machine.step(0.05, 2)
    assert machine.session.inverses.applied == {}
    command, sent = read_commands(machine)
    assert sent[-1] == pytest.approx(previous, abs=1e-15)
    assert command[-1] == pytest.approx(previous, abs=1e-15)
    assert not machine.session.can_undo


def test_moves_speeds_profiles_and_trajectories_use_the_inverse(machine):
    session = machine.session
    start = session.snapshot().command["zn"]
    machine.portions.clear()
    session.go_to({"zn": 50e-6})
    machine.settle()
    session.move_velocity({"zn": -1e-4}, 0.1)
    machine.settle()
    session.profiles.upload(MotionProfile("zn", (ProfileSegment(0.05, 0.0, 0.0, -4e-6),)))
    machine.step()
    session.profiles.trigger()
    machine.settle()
    session.play(make_trajectory())
    machine.settle()
    command, sent = read_commands(machine)
    inverse = Inverse(MODEL, TICK_S)
    inverse.step(start)
    assert np.allclose(sent, inverse.run(command), rtol=0.0, atol=1e-12)
    assert np.abs(sent - command).max() > 1e-6
    assert not machine.list_events(CommandRefused)
    record = machine.list_events(PlaybackFinished)[0].record
    assert np.allclose(record.signal("zn", Tap.CMD), PATH, atol=1e-15)
    assert np.abs(record.signal("zn", Tap.U) * ZN.gain - PATH).max() > 1e-6
    assert record.metadata["compensation zn"] == "PI, zn.json"


def test_motion_outside_the_training_range_is_refused(machine):
    session = machine.session
    with pytest.raises(
        OutOfLimitsError, match="outside 2 µm to 60 µm, the training range of its inverse"
    ):
        session.go_to({"zn": 61e-6})
    with pytest.raises(OutOfLimitsError, match="outside 2 µm to 60 µm"):
        session.profiles.upload(MotionProfile("zn", (ProfileSegment(0.1, 0.0, 0.0, -35e-6),)))
    with pytest.raises(CompensationError, match="which the inverse was trained on"):
        session.play(make_trajectory(PATH + 16e-6))
    session.move_velocity({"zn": 1e-3}, 0.15)  # halts at the end
    machine.settle()
    assert session.snapshot().command["zn"] <= 60e-6
    assert session.inverses.find_exceedance("zn") == InverseExceedance(0)


def test_the_output_of_the_inverse_is_checked_against_the_limits(machine):
    steep = replace(MODEL, consequents=np.array([[0.0, 1.2, 0.1]]))
    machine.session.inverses.remove("zn")
    machine.step(0.05, 2)
    machine.session.inverses.apply(NamedInverse(steep, ROBOT.name, "steep"))
    machine.step(0.05, 2)
    machine.portions.clear()
    with pytest.raises(InputError, match="the limits of the machine"):
        machine.session.play(make_trajectory(PATH + 12e-6))
    machine.session.play(make_trajectory(PATH - 5e-6))


@pytest.mark.parametrize(
    ("inverse", "message"),
    [
        (replace(NAMED, robot="another"), "trained for robot 'another', not for 'RoTeMiNa'"),
        (replace(NAMED, model=replace(MODEL, axis="x")), "axis x.* is not a piezo in open loop"),
        (replace(NAMED, model=replace(MODEL, axis="q")), "axis q.* is not a piezo in open loop"),
    ],
)
def test_a_foreign_inverse_is_refused(harness, inverse, message):
    with pytest.raises(CompensationError, match=message):
        harness.session.inverses.apply(inverse)


def test_inverses_change_only_at_rest_and_not_while_a_stop_is_latched(machine):
    inverses = machine.session.inverses
    machine.session.jog("zn", 5e-6)
    machine.step(0.002)
    with pytest.raises(RequestRefusedError, match="still moving"):
        inverses.remove("zn")
    machine.settle()
    with pytest.raises(RequestRefusedError, match="axis thx has no inverse"):
        inverses.remove("thx")
    machine.session.emergency_stop()
    for request in (lambda: inverses.apply(NAMED), lambda: inverses.remove("zn")):
        with pytest.raises(RequestRefusedError, match="release it first"):
            request()
    assert set(inverses.applied) == {"zn"}


def test_a_too_narrow_inverse_and_a_voltage_past_the_inverse_are_refused(machine):
    check_refusals_with_an_inverse(machine)


def check_refusals_with_an_inverse(machine):
    """Check that a voltage past the inverse, and then a too narrow inverse, are refused."""
    machine.session.set_voltage("zn", 60.0)
    machine.step(0.05, 2)
    machine.session.inverses.remove("zn")
    machine.step(0.05, 2)
    narrow_model = replace(MODEL, desired_range=(2e-6, 20e-6))
    machine.session.inverses.apply(replace(NAMED, model=narrow_model))
    machine.step(0.05, 2)
    voltage, inverse = [event.message for event in machine.list_events(CommandRefused)]
    assert "sets its voltage" in voltage
    assert "move the axis there first" in inverse
    assert machine.session.inverses.applied == {}


def test_a_new_connection_removes_the_inverse_and_keeps_the_position(machine):
    machine.session.go_to({"zn": 50e-6})
    machine.settle()
    sent = read_commands(machine)[1][-1]
    machine.session.disconnect()
    machine.step(0.05, 2)
    machine.session.reconnect()
    machine.step(0.05, 3)
    assert machine.session.inverses.applied == {}
    assert machine.session.snapshot().command["zn"] == pytest.approx(sent, abs=1e-12)
