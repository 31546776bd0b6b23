"""Inverses in a session: every path goes through them, and nothing jumps."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.compensation import NamedInverse
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import CommandRefused, PlaybackFinished
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance, Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

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
def machine(make_stepped):
    """A session at rest with the inverse on; ``seen`` holds its samples since."""
    stepped = make_stepped()
    stepped.seen = []
    stepped.session.tap(lambda samples, _: stepped.seen.append(samples))
    stepped.step(0.05, 3)
    stepped.session.inverses.apply(NAMED)
    stepped.step(0.05, 2)
    assert set(stepped.session.inverses.applied) == {"zn"}
    return stepped


def trajectory(path=PATH):
    return Record.from_signals(TICK_S * np.arange(len(path)), {("zn", Tap.CMD): path}, {"zn": "m"})


def columns(stepped):
    """Return what was wanted and what was sent (n,), m, of all samples."""
    command = np.concatenate([one.command[:, COLUMN] for one in stepped.seen])
    return command, np.concatenate([one.inputs[:, COLUMN] for one in stepped.seen]) * ZN.gain


def settle(stepped):
    stepped.step(0.05, 4)
    while stepped.session.snapshot().activity is not DeviceState.IDLE:
        stepped.step(0.05)


def record_of(stepped):
    return next(one.record for one in stepped.events if isinstance(one, PlaybackFinished))


def test_nothing_jumps_when_it_is_put_on_and_taken_off(machine):
    command, sent = columns(machine)
    assert np.ptp(sent) < 1e-15
    now = machine.session.snapshot().command["zn"]
    assert now != pytest.approx(sent[-1], abs=1e-7)
    assert Inverse(MODEL, TICK_S).step(now) == pytest.approx(sent[-1], abs=1e-12)
    machine.session.jog("zn", 5e-6)  # from where the command is now
    settle(machine)
    assert machine.session.snapshot().command["zn"] == pytest.approx(now + 5e-6)
    before = columns(machine)[1][-1]
    machine.session.inverses.remove("zn")
    machine.step(0.05, 2)
    assert machine.session.inverses.applied == {}
    command, sent = columns(machine)
    assert sent[-1] == pytest.approx(before, abs=1e-15)
    assert command[-1] == pytest.approx(before, abs=1e-15)
    assert not machine.session.undoable


def test_moves_speeds_profiles_and_trajectories_go_through_it(machine):
    session = machine.session
    start = session.snapshot().command["zn"]
    machine.seen.clear()
    session.go_to({"zn": 50e-6})
    settle(machine)
    session.move_velocity({"zn": -1e-4}, 0.1)
    settle(machine)
    session.profiles.upload(Profile("zn", (ProfileSegment(0.05, 0.0, 0.0, -4e-6),)))
    machine.step()
    session.profiles.trigger()
    settle(machine)
    session.play(trajectory())
    settle(machine)
    command, sent = columns(machine)
    inverse = Inverse(MODEL, TICK_S)
    inverse.step(start)
    assert np.allclose(sent, inverse.run(command), rtol=0.0, atol=1e-12)
    assert np.abs(sent - command).max() > 1e-6
    assert not [event for event in machine.events if isinstance(event, CommandRefused)]


def test_a_record_holds_what_was_wanted_what_was_sent_and_the_inverse(machine):
    machine.session.play(trajectory())
    settle(machine)
    record = record_of(machine)
    assert np.allclose(record.signal("zn", Tap.CMD), PATH, atol=1e-15)
    sent = record.signal("zn", Tap.U) * ZN.gain
    assert np.abs(sent - PATH).max() > 1e-6
    assert record.metadata["compensation zn"] == "PI, zn.json"


def test_beyond_what_it_saw_nothing_goes(machine):
    session = machine.session
    with pytest.raises(
        OutOfLimitsError, match="outside 2 µm to 60 µm, the training range of its inverse"
    ):
        session.go_to({"zn": 61e-6})
    with pytest.raises(OutOfLimitsError, match="outside 2 µm to 60 µm"):
        session.profiles.upload(Profile("zn", (ProfileSegment(0.1, 0.0, 0.0, -35e-6),)))
    with pytest.raises(CompensationError, match="which the inverse was trained on"):
        session.play(trajectory(PATH + 16e-6))
    session.move_velocity({"zn": 1e-3}, 0.15)  # halts at the end
    settle(machine)
    assert session.snapshot().command["zn"] <= 60e-6
    assert session.inverses.exceedance("zn") == Exceedance(0)


def test_what_the_inverse_asks_for_is_held_against_the_limits(machine):
    steep = replace(MODEL, consequents=np.array([[0.0, 1.2, 0.1]]))
    machine.session.inverses.remove("zn")
    machine.step(0.05, 2)
    machine.session.inverses.apply(NamedInverse(steep, ROBOT.name, "steep"))
    machine.step(0.05, 2)
    machine.seen.clear()
    with pytest.raises(InputError, match="the limits of the machine"):
        machine.session.play(trajectory(PATH + 12e-6))
    machine.session.play(trajectory(PATH - 5e-6))


@pytest.mark.parametrize(
    ("inverse", "message"),
    [
        (replace(NAMED, robot="another"), "trained for robot 'another', not for 'RoTeMiNa'"),
        (replace(NAMED, model=replace(MODEL, axis="x")), "axis x.* is not a piezo in open loop"),
        (replace(NAMED, model=replace(MODEL, axis="q")), "axis q.* is not a piezo in open loop"),
    ],
)
def test_a_foreign_inverse_is_refused(machine, inverse, message):
    with pytest.raises(CompensationError, match=message):
        machine.session.inverses.apply(inverse)


def test_it_changes_at_rest_alone(machine):
    machine.session.jog("zn", 5e-6)
    machine.step(0.002)
    with pytest.raises(RefusedError, match="still moving"):
        machine.session.inverses.remove("zn")
    settle(machine)
    with pytest.raises(RefusedError, match="axis thx has no inverse"):
        machine.session.inverses.remove("thx")


def test_an_axis_where_the_inverse_does_not_reach_is_left_alone(make_stepped):
    machine = make_stepped()
    machine.step(0.05, 3)
    narrow = replace(MODEL, desired_range=(2e-6, 20e-6))
    machine.session.inverses.apply(replace(NAMED, model=narrow))
    machine.step(0.05, 2)
    (refused,) = [one for one in machine.events if isinstance(one, CommandRefused)]
    assert "move the axis there first" in refused.message
    assert machine.session.inverses.applied == {}


def test_a_new_connection_ends_it_where_the_axis_stands(machine):
    machine.session.go_to({"zn": 50e-6})
    settle(machine)
    sent = columns(machine)[1][-1]
    machine.session.disconnect()
    machine.step(0.05, 2)
    machine.session.reconnect()
    machine.step(0.05, 3)
    assert machine.session.inverses.applied == {}
    assert machine.session.snapshot().command["zn"] == pytest.approx(sent, abs=1e-12)


def test_no_voltage_is_put_out_past_it(machine):
    machine.session.set_voltage("zn", 60.0)
    machine.step(0.05, 2)
    (refused,) = [one for one in machine.events if isinstance(one, CommandRefused)]
    assert "sets its voltage" in refused.message


def test_sessions_without_an_inverse_send_what_is_wanted(make_stepped):
    machine = make_stepped()
    assert isinstance(machine.session, MotionSession)
    assert machine.session.inverses.applied == {}
    assert machine.session.inverses.sent(machine.session.driver.accept(trajectory())) == (None, {})


def test_while_a_stop_is_latched_none_is_put_on_or_taken_off(machine):
    machine.session.emergency_stop()
    for request in (
        lambda: machine.session.inverses.apply(NAMED),
        lambda: machine.session.inverses.remove("zn"),
    ):
        with pytest.raises(RefusedError, match="release it first"):
            request()
    assert set(machine.session.inverses.applied) == {"zn"}
