"""Inverses on a device that has none of its own: jogs, speeds, profiles and go-to go through them.

The simulator stands for it, with its own ability hidden.
"""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion import compensation, executor
from rotemina.app.motion.compensation import NamedInverse
from rotemina.app.motion.state import Alarmed, CommandRefused, PlaybackFinished
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState
from rotemina.sim.compensate.held_setpoint_inverse import HeldInverse
from rotemina.sim.compensate.inverse import Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

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
GAINS = ("gain_error", "sensor_gain")


class Hidden:
    """An ability that no device has."""


@pytest.fixture
def plain(make_stepped, monkeypatch):
    """A session at rest on a device without inverses of its own."""
    for module in (compensation, executor):
        monkeypatch.setattr(module, "Compensator", Hidden)
    stepped = make_stepped()
    stepped.seen = []
    stepped.session.tap(lambda samples, _: stepped.seen.append(samples))
    stepped.step(0.05, 3)
    return stepped


@pytest.fixture
def machine(plain):
    """The same with an inverse on."""
    plain.session.inverses.apply(NAMED)
    plain.step(0.05, 2)
    assert set(plain.session.inverses.applied) == {"zn"}
    assert not plain.session.inverses.live
    return plain


def columns(stepped):
    """Return what was wanted and what was sent (n,), m, of all samples."""
    command = np.concatenate([one.command[:, COLUMN] for one in stepped.seen])
    return command, np.concatenate([one.inputs[:, COLUMN] for one in stepped.seen]) * ZN.gain


def settle(stepped):
    stepped.step(0.05, 4)
    while stepped.session.snapshot().activity is not DeviceState.IDLE:
        stepped.step(0.05)


def wanted(stepped):
    return stepped.session.snapshot().command["zn"]


def test_jogs_and_targets_end_where_they_are_wanted_and_nothing_jumps(machine):
    session = machine.session
    sent = columns(machine)[1]
    assert np.ptp(sent) < 1e-15
    own = HeldInverse(MODEL, sent[-1])
    assert wanted(machine) == pytest.approx(own.wanted, abs=1e-12)
    for target in (50e-6, 12e-6):
        session.go_to({"zn": target})
        settle(machine)
        assert wanted(machine) == pytest.approx(target, abs=1e-12)
        assert columns(machine)[1][-1] == pytest.approx(own.aim(target), abs=1e-12)
        own.follow(np.array([own.aim(target)]))
    session.jog("zn", -2e-6)
    settle(machine)
    assert wanted(machine) == pytest.approx(10e-6, abs=1e-12)
    assert columns(machine)[1][-1] == pytest.approx(own.aim(10e-6), abs=1e-12)
    command = columns(machine)[0]
    assert np.abs(np.diff(command)).max() < 1.3 * TICK_S * ZN.max_speed  # it never leaps


def test_it_stays_where_it_is_when_the_inverse_is_taken_off(machine):
    machine.session.go_to({"zn": 40e-6})
    settle(machine)
    sent = columns(machine)[1][-1]
    machine.session.inverses.remove("zn")
    machine.step(0.05, 2)
    assert machine.session.inverses.applied == {}
    assert wanted(machine) == pytest.approx(sent, abs=1e-15)
    assert columns(machine)[1][-1] == pytest.approx(sent, abs=1e-15)


def test_a_stop_on_the_way_leaves_a_command_from_which_the_next_target_is_met(machine):
    session = machine.session
    session.go_to({"zn": 50e-6}, speeds={"zn": 20e-6})
    machine.step(0.05, 8)
    session.stop()
    settle(machine)
    halted = wanted(machine)
    assert 33e-6 < halted < 45e-6
    sent = columns(machine)[1]
    assert np.ptp(sent[-50:]) < 1e-15
    own = HeldInverse(MODEL, sent[0])
    own.follow(sent[1:])
    session.go_to({"zn": 20e-6})
    settle(machine)
    assert wanted(machine) == pytest.approx(20e-6, abs=1e-12)
    assert columns(machine)[1][-1] == pytest.approx(own.aim(20e-6), abs=5e-9)


def test_a_speed_is_no_faster_than_wanted_and_ends_before_what_the_inverse_saw(machine):
    session = machine.session
    machine.seen.clear()
    for _ in range(60):
        session.move_velocity({"zn": 100e-6}, 0.15)
        machine.step(0.05)
    settle(machine)
    command = columns(machine)[0]
    assert 59e-6 < command[-1] <= 60e-6
    assert np.diff(command).max() <= 100e-6 * TICK_S * (1.0 + 1e-6)
    session.move_velocity({"zn": -100e-6}, 0.15)  # back it goes at once
    settle(machine)
    assert wanted(machine) < 59e-6


def test_a_profile_ends_where_it_is_wanted(machine):
    session = machine.session
    session.go_to({"zn": 50e-6})
    settle(machine)
    down = (ProfileSegment(0.05, 0.0, -8e-6, 4e-6), ProfileSegment(0.05, -4e-6, 4e-6, -4e-6 / 3))
    session.profiles.upload(Profile("zn", (*down, ProfileSegment(0.1, 0.0, 9e-6, -6e-6))))
    machine.step()
    machine.seen.clear()
    session.profiles.trigger()
    settle(machine)
    command, _ = columns(machine)
    turn = 50e-6 - 4e-6 - 4e-6 / 3
    assert command.min() == pytest.approx(turn, abs=0.05e-6)
    assert command[-1] == pytest.approx(turn + 3e-6, abs=1e-9)
    assert not machine.told(CommandRefused)


def test_a_trajectory_is_shown_as_it_is_wanted_and_what_follows_goes_on_from_it(machine):
    session = machine.session
    time_s = TICK_S * np.arange(len(PATH))
    session.play(Record.from_signals(time_s, {("zn", Tap.CMD): PATH}, {"zn": "m"}))
    settle(machine)
    (finished,) = machine.told(PlaybackFinished)
    assert finished.completed
    assert np.allclose(finished.record.signal("zn", Tap.CMD), PATH, atol=1e-15)
    sent = finished.record.signal("zn", Tap.U) * ZN.gain
    asked = Inverse(MODEL, TICK_S, preview=True).run(PATH)
    assert np.allclose(sent, asked, rtol=0.0, atol=1e-12)
    assert finished.record.metadata["compensation zn"] == "PI, zn.json"
    assert wanted(machine) == pytest.approx(PATH[-1], abs=1e-12)
    session.jog("zn", -3e-6)
    settle(machine)
    assert wanted(machine) == pytest.approx(PATH[-1] - 3e-6, abs=1e-12)


def test_a_playback_that_is_stopped_leaves_the_command_where_the_axis_halted(machine):
    time_s = TICK_S * np.arange(len(PATH))
    machine.session.play(Record.from_signals(time_s, {("zn", Tap.CMD): PATH}, {"zn": "m"}))
    while not 0.3 < machine.step(0.02).progress < 0.9:
        pass
    machine.session.stop()
    settle(machine)
    command, sent = columns(machine)
    assert np.ptp(sent[-50:]) < 1e-15
    assert np.ptp(command[-50:]) < 1e-15
    assert 15e-6 < wanted(machine) < 45e-6
    assert wanted(machine) != pytest.approx(sent[-1], abs=1e-7)


def test_a_stop_before_it_is_put_on_keeps_it_off(plain):
    plain.session.inverses.apply(NAMED)
    plain.session.stop()
    plain.step(0.05, 4)
    assert plain.session.inverses.applied == {}


def test_what_does_not_reach_is_refused_and_a_voltage_is_not_put_out_past_it(machine):
    machine.session.set_voltage("zn", 60.0)
    machine.step(0.05, 2)
    machine.session.inverses.remove("zn")
    machine.step(0.05, 2)
    narrow = replace(MODEL, desired_range=(2e-6, 20e-6))
    machine.session.inverses.apply(replace(NAMED, model=narrow))
    machine.step(0.05, 2)
    told = [one.message for one in machine.told(CommandRefused)]
    assert len(told) == 2
    assert "sets its voltage" in told[0]
    assert "move the axis there first" in told[1]
    assert machine.session.inverses.applied == {}


def test_an_axis_that_is_not_where_it_was_sent_loses_its_inverse_and_locks(machine):
    machine.session.go_to({"zn": 55e-6})
    settle(machine)
    sent = columns(machine)[1][-1]
    apart = [AxisEffect(axis="zn", id=one, parameters={"error": 0.5}) for one in GAINS]
    machine.session.service.set_effects(apart)
    machine.step(0.05, 6)
    assert machine.session.snapshot().locked
    assert machine.session.inverses.applied == {}
    assert any("inverse of axis zn is off" in one.message for one in machine.told(Alarmed))
    assert wanted(machine) == pytest.approx(sent, abs=1e-15)


def test_a_new_connection_ends_it(machine):
    machine.session.disconnect()
    machine.step(0.05, 2)
    assert machine.session.inverses.applied == {}
    machine.session.reconnect()
    machine.step(0.05, 3)
    assert machine.session.inverses.applied == {}
