"""Inverses on a device that cannot compensate: all motions go through inverses in the session.

The simulator acts as this device; its ability to compensate is hidden.
"""

import numpy as np
import pytest
from tests.app.motion.session.test_compensation import (
    MODEL,
    NAMED,
    PATH,
    TICK_S,
    ZN,
    check_refusals_with_an_inverse,
    make_trajectory,
    read_commands,
)

from rotemina.app.motion.device import executor
from rotemina.app.motion.session import compensation
from rotemina.app.motion.state import (
    AlarmRaised,
    CommandRefused,
    PlaybackFinished,
)
from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.sim.compensate import Inverse, SetpointInverse
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect

GAINS = ("gain_error", "sensor_gain")


class HiddenCompensator:
    """An ability that no device has."""


@pytest.fixture
def machine_without_inverses(make_harness, monkeypatch):
    """A session at rest on a device that cannot compensate."""
    for module in (compensation, executor):
        monkeypatch.setattr(module, "HysteresisCompensator", HiddenCompensator)
    harness = make_harness()
    harness.portions = []
    harness.session.tap(lambda samples, _: harness.portions.append(samples))
    harness.step(0.05, 3)
    return harness


@pytest.fixture
def machine(machine_without_inverses):
    """The same session with an inverse applied."""
    machine_without_inverses.session.inverses.apply(NAMED)
    machine_without_inverses.step(0.05, 2)
    assert set(machine_without_inverses.session.inverses.applied) == {"zn"}
    assert not machine_without_inverses.session.inverses.is_applied_per_tick
    return machine_without_inverses


def read_wanted_command(harness):
    return harness.session.snapshot().command["zn"]


def test_jogs_and_targets_end_as_commanded_without_a_jump(machine):
    session = machine.session
    sent = read_commands(machine)[1]
    assert np.ptp(sent) < 1e-15
    inverse = SetpointInverse(MODEL, sent[-1])
    assert read_wanted_command(machine) == pytest.approx(inverse.desired, abs=1e-12)
    for target in (50e-6, 12e-6):
        session.go_to({"zn": target})
        machine.settle()
        assert read_wanted_command(machine) == pytest.approx(target, abs=1e-12)
        assert read_commands(machine)[1][-1] == pytest.approx(
            inverse.add_setpoint(target), abs=1e-12
        )
        inverse.advance(np.array([inverse.add_setpoint(target)]))
    session.jog("zn", -2e-6)
    machine.settle()
    assert read_wanted_command(machine) == pytest.approx(10e-6, abs=1e-12)
    assert read_commands(machine)[1][-1] == pytest.approx(inverse.add_setpoint(10e-6), abs=1e-12)
    command = read_commands(machine)[0]
    assert np.abs(np.diff(command)).max() < 1.3 * TICK_S * ZN.max_speed  # it never jumps


def test_removing_the_inverse_causes_no_motion(machine):
    machine.session.go_to({"zn": 40e-6})
    machine.settle()
    sent = read_commands(machine)[1][-1]
    machine.session.inverses.remove("zn")
    machine.step(0.05, 2)
    assert machine.session.inverses.applied == {}
    assert read_wanted_command(machine) == pytest.approx(sent, abs=1e-15)
    assert read_commands(machine)[1][-1] == pytest.approx(sent, abs=1e-15)


def test_after_a_stop_the_next_target_is_reached(machine):
    session = machine.session
    session.go_to({"zn": 50e-6}, speeds={"zn": 20e-6})
    machine.step(0.05, 8)
    session.stop()
    machine.settle()
    halted = read_wanted_command(machine)
    assert 33e-6 < halted < 45e-6
    sent = read_commands(machine)[1]
    assert np.ptp(sent[-50:]) < 1e-15
    inverse = SetpointInverse(MODEL, sent[0])
    inverse.advance(sent[1:])
    session.go_to({"zn": 20e-6})
    machine.settle()
    assert read_wanted_command(machine) == pytest.approx(20e-6, abs=1e-12)
    assert read_commands(machine)[1][-1] == pytest.approx(inverse.add_setpoint(20e-6), abs=5e-9)


def test_a_speed_is_not_exceeded_and_ends_inside_the_training_range(machine):
    session = machine.session
    machine.portions.clear()
    for _ in range(60):
        session.move_velocity({"zn": 100e-6}, 0.15)
        machine.step(0.05)
    machine.settle()
    command = read_commands(machine)[0]
    assert 59e-6 < command[-1] <= 60e-6
    assert np.diff(command).max() <= 100e-6 * TICK_S * (1.0 + 1e-6)
    session.move_velocity({"zn": -100e-6}, 0.15)  # it reverses at once
    machine.settle()
    assert read_wanted_command(machine) < 59e-6


def test_a_profile_ends_as_commanded(machine):
    session = machine.session
    session.go_to({"zn": 50e-6})
    machine.settle()
    down_segments = (
        ProfileSegment(0.05, 0.0, -8e-6, 4e-6),
        ProfileSegment(0.05, -4e-6, 4e-6, -4e-6 / 3),
    )
    session.profiles.upload(
        MotionProfile("zn", (*down_segments, ProfileSegment(0.1, 0.0, 9e-6, -6e-6)))
    )
    machine.step()
    machine.portions.clear()
    session.profiles.trigger()
    machine.settle()
    command, _ = read_commands(machine)
    lowest = 50e-6 - 4e-6 - 4e-6 / 3
    assert command.min() == pytest.approx(lowest, abs=0.05e-6)
    assert command[-1] == pytest.approx(lowest + 3e-6, abs=1e-9)
    assert not machine.list_events(CommandRefused)


def test_a_trajectory_is_recorded_as_commanded_and_the_next_motion_starts_from_it(machine):
    session = machine.session
    session.play(make_trajectory())
    machine.settle()
    (finished,) = machine.list_events(PlaybackFinished)
    assert finished.completed
    assert np.allclose(finished.record.signal("zn", Tap.CMD), PATH, atol=1e-15)
    sent = finished.record.signal("zn", Tap.U) * ZN.gain
    expected = Inverse(MODEL, TICK_S, preview=True).run(PATH)
    assert np.allclose(sent, expected, rtol=0.0, atol=1e-12)
    assert finished.record.metadata["compensation zn"] == "PI, zn.json"
    assert read_wanted_command(machine) == pytest.approx(PATH[-1], abs=1e-12)
    session.jog("zn", -3e-6)
    machine.settle()
    assert read_wanted_command(machine) == pytest.approx(PATH[-1] - 3e-6, abs=1e-12)


def test_a_stopped_playback_leaves_the_command_at_the_position_of_the_axis(machine):
    machine.session.play(make_trajectory())
    while not 0.3 < machine.step(0.02).progress < 0.9:
        pass
    machine.session.stop()
    machine.settle()
    command, sent = read_commands(machine)
    assert np.ptp(sent[-50:]) < 1e-15
    assert np.ptp(command[-50:]) < 1e-15
    assert 15e-6 < read_wanted_command(machine) < 45e-6
    assert read_wanted_command(machine) != pytest.approx(sent[-1], abs=1e-7)


def test_a_stop_before_an_inverse_is_applied_prevents_it(machine_without_inverses):
    machine_without_inverses.session.inverses.apply(NAMED)
    machine_without_inverses.session.stop()
    machine_without_inverses.step(0.05, 4)
    assert machine_without_inverses.session.inverses.applied == {}


def test_a_too_narrow_inverse_and_a_voltage_past_the_inverse_are_refused(machine):
    check_refusals_with_an_inverse(machine)


def test_an_axis_that_is_not_at_its_command_loses_its_inverse_and_locks(machine):
    machine.session.go_to({"zn": 55e-6})
    machine.settle()
    sent = read_commands(machine)[1][-1]
    gain_effects = [AxisEffect(axis="zn", id=name, parameters={"error": 0.5}) for name in GAINS]
    machine.session.service.set_effects(gain_effects)
    machine.step(0.05, 6)
    assert machine.session.snapshot().lock_reason
    assert machine.session.inverses.applied == {}
    assert any(
        "inverse of axis zn is off" in event.message for event in machine.list_events(AlarmRaised)
    )
    assert read_wanted_command(machine) == pytest.approx(sent, abs=1e-15)


def test_a_new_connection_removes_the_inverse(machine):
    machine.session.disconnect()
    machine.step(0.05, 2)
    assert machine.session.inverses.applied == {}
    machine.session.reconnect()
    machine.step(0.05, 3)
    assert machine.session.inverses.applied == {}
