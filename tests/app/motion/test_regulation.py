"""Loops in a session: put on and taken off at rest, in records, and refused with the reason."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.player import play_offline
from rotemina.app.motion.regulation import NamedRegulation, regulation_of
from rotemina.app.motion.state import CommandRefused, PlaybackFinished
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.gains import Gains, Notch
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.feedback.stability import UnstableError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.tuning.objectives import SecondObjective
from rotemina.sim.tuning.pareto_front import Point
from rotemina.sim.tuning.performance_figures import UNUSABLE
from rotemina.sim.tuning.tuning_result import Provenance, Tuning

ROBOT = load_robot("rotemina")
ZN = ROBOT.axes["zn"]
WORN = replace(
    ROBOT,
    effects=(
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * ZN.span}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    ),
)
GAINS = Gains(
    proportional=0.07,
    integral=1100.0,
    double_integral=300e3,
    derivative=1.7e-4,
    derivative_filter_s=4e-5,
    low_pass_hz=2000.0,
    notch=Notch(420.0, 0.8, 0.03),
    tracking_s=2e-3,
)
LOOP = NamedRegulation(Regulation(ROBOT, "zn", GAINS, 5000.0), "zn.toml, point 0")
PATH = 32e-6 + 20e-6 * np.sin(2.0 * np.pi * 5.0 * 1e-3 * np.arange(600))


def trajectory(path=PATH):
    return Record.from_signals(1e-3 * np.arange(len(path)), {("zn", Tap.CMD): path}, {"zn": "m"})


def tuning(gains=GAINS, **changed):
    source = Provenance(
        program="",
        robot=ROBOT.name,
        effects=(),
        inverse="",
        generations=1,
        done=1,
        population=4,
        seed=1,
        against=SecondObjective.EFFORT,
        peak_sensitivity=1.7,
        overshoot=0.02,
        spread=0.05,
    )
    whole = Tuning(
        axis="zn",
        rate_hz=5000.0,
        delay=0,
        recommended=0,
        chosen=0,
        provenance=source,
        points=(Point(gains=gains, figures=UNUSABLE),),
    )
    return replace(whole, **changed)


def settle(stepped):
    stepped.step(0.05, 4)
    while stepped.session.snapshot().activity is not DeviceState.IDLE:
        stepped.step(0.05)


@pytest.fixture
def machine(make_stepped):
    stepped = make_stepped()
    stepped.step(0.05, 3)
    stepped.session.service.set_effects(WORN.effects)
    stepped.session.go_to({"zn": 45e-6})
    settle(stepped)
    return stepped


def test_it_is_put_on_moves_and_is_taken_off(machine):
    session = machine.session
    before = session.snapshot().measured["zn"]
    session.loops.apply(LOOP)
    machine.step(0.05, 4)
    assert session.loops.applied["zn"].name == "zn.toml, point 0"
    assert session.snapshot().command["zn"] == pytest.approx(before, abs=1e-7)
    assert not session.undoable
    with pytest.raises(OutOfLimitsError):
        session.go_to({"zn": 66e-6})
    session.go_to({"zn": 20e-6})
    machine.step(0.004)
    with pytest.raises(RefusedError, match="still moving"):
        session.loops.remove("zn")
    settle(machine)
    assert session.snapshot().measured["zn"] == pytest.approx(20e-6, abs=6e-8)
    session.loops.remove("zn")
    machine.step(0.05, 2)
    assert session.loops.applied == {}
    with pytest.raises(RefusedError, match="axis zn has no loop"):
        session.loops.remove("zn")
    assert not [event for event in machine.events if isinstance(event, CommandRefused)]


def test_a_record_names_it_and_holds_a_smaller_error(machine):
    left = []
    for on in (False, True):
        if on:
            machine.session.loops.apply(LOOP)
            machine.step(0.05, 2)
        machine.events.clear()
        machine.session.play(trajectory())
        settle(machine)
        (record,) = [one.record for one in machine.events if isinstance(one, PlaybackFinished)]
        assert record.metadata.get("feedback zn") == ("zn.toml, point 0" if on else None)
        left.append(float(np.std(record.signal("zn", Tap.MEAS) - record.signal("zn", Tap.CMD))))
    assert left[1] < 0.03 * left[0]
    offline = play_offline(WORN, trajectory(), loop=LOOP)
    assert offline.metadata["feedback zn"] == "zn.toml, point 0"
    np.testing.assert_allclose(offline.signal("zn", Tap.CMD), PATH, rtol=0.0, atol=1e-15)


def test_a_stop_leaves_it_on_and_a_new_connection_ends_it(machine):
    session = machine.session
    session.loops.apply(LOOP)
    machine.step(0.05)
    session.play(trajectory())
    machine.step(0.05, 12)
    session.stop()
    settle(machine)
    assert set(session.loops.applied) == {"zn"}
    session.disconnect()
    machine.step(0.05, 2)
    session.reconnect()
    machine.step(0.05, 3)
    assert session.loops.applied == {}


def test_a_device_that_closes_none_refuses(machine, monkeypatch):
    monkeypatch.setattr("rotemina.app.motion.regulation.Regulator", type("Other", (), {}))
    assert machine.session.loops.applied == {}
    with pytest.raises(RefusedError, match="cannot close a loop: its samples are too infrequent"):
        machine.session.loops.apply(LOOP)


def test_what_does_not_fit_is_refused_before_anything_moves():
    assert regulation_of(ROBOT, tuning(), "a.toml").name == "a.toml, point 0"
    with pytest.raises(UnstableError, match=r"a\.toml, point 0: axis zn: .* nothing was applied"):
        regulation_of(ROBOT, tuning(replace(GAINS, integral=9000.0)), "a.toml")
    with pytest.raises(FeedbackError, match="2 intervals late"):
        regulation_of(ROBOT, tuning(delay=2), "a.toml")
    with pytest.raises(FeedbackError, match="tuned for robot 'RoTeMiNa', not for"):
        regulation_of(load_robot("picma"), tuning(), "a.toml")
    with pytest.raises(FeedbackError, match=r"axis x of robot .* is not a piezo"):
        regulation_of(ROBOT, tuning(axis="x"), "a.toml")
    slow = NamedRegulation(Regulation(ROBOT, "zn", Gains(integral=5.0), 1500.0), "slow")
    with pytest.raises(InputError, match="must be a whole multiple"):
        play_offline(ROBOT, trajectory(), loop=slow)


def test_while_a_stop_is_latched_none_is_closed_or_opened(machine):
    session = machine.session
    session.loops.apply(LOOP)
    machine.step(0.05, 2)
    session.emergency_stop()
    for request in (lambda: session.loops.apply(LOOP), lambda: session.loops.remove("zn")):
        with pytest.raises(RefusedError, match="release it first"):
            request()
    machine.step(0.05, 2)
    assert set(session.loops.applied) == {"zn"}
