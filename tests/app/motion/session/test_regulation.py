"""Loops in a session: applied and removed at rest, named in records, refused with a reason."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.playback import play_offline
from rotemina.app.motion.session import NamedRegulation, make_regulation
from rotemina.app.motion.state import CommandRefused, PlaybackFinished
from rotemina.sim.errors import FeedbackError, InputError, OutOfLimitsError, UnstableError
from rotemina.sim.feedback import AxisRegulation, ControllerGains, NotchFilter
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.tuning import FrontPoint, SecondObjective, TuningResult
from rotemina.sim.tuning.performance_figures import INFINITE_FIGURES
from rotemina.sim.tuning.tuning_result import TuningProvenance

ROBOT = load_robot("rotemina")
ZN = ROBOT.axes["zn"]
WORN_ROBOT = replace(
    ROBOT,
    effects=(
        AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * ZN.span}),
        AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02}),
    ),
)
GAINS = ControllerGains(
    proportional=0.07,
    integral=1100.0,
    double_integral=300e3,
    derivative=1.7e-4,
    derivative_filter_s=4e-5,
    low_pass_hz=2000.0,
    notch=NotchFilter(420.0, 0.8, 0.03),
    tracking_s=2e-3,
)
LOOP = NamedRegulation(AxisRegulation(ROBOT, "zn", GAINS, 5000.0), "zn.toml, point 0")
SWING = 32e-6 + 20e-6 * np.sin(2.0 * np.pi * 5.0 * 1e-3 * np.arange(600))


def make_trajectory(path=SWING):
    return Record.from_signals(1e-3 * np.arange(len(path)), {("zn", Tap.CMD): path}, {"zn": "m"})


def make_tuning_result(gains=GAINS, axis="zn", delay=0):
    source = TuningProvenance(
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
    return TuningResult(
        axis=axis,
        rate_hz=5000.0,
        delay=delay,
        recommended=0,
        chosen=0,
        provenance=source,
        points=(FrontPoint(gains=gains, figures=INFINITE_FIGURES),),
    )


@pytest.fixture
def machine(make_harness):
    harness = make_harness()
    harness.step(0.05, 3)
    harness.session.service.set_effects(WORN_ROBOT.effects)
    harness.session.go_to({"zn": 45e-6})
    harness.settle()
    return harness


def test_a_loop_is_applied_moves_the_axis_and_is_removed(machine):
    session = machine.session
    measured = session.snapshot().measured["zn"]
    session.loops.apply(LOOP)
    machine.step(0.05, 4)
    assert session.loops.applied["zn"].name == "zn.toml, point 0"
    assert session.snapshot().command["zn"] == pytest.approx(measured, abs=1e-7)
    assert not session.can_undo
    with pytest.raises(OutOfLimitsError):
        session.go_to({"zn": 66e-6})
    session.go_to({"zn": 20e-6})
    machine.step(0.004)
    with pytest.raises(RequestRefusedError, match="still moving"):
        session.loops.remove("zn")
    machine.settle()
    assert session.snapshot().measured["zn"] == pytest.approx(20e-6, abs=6e-8)
    session.loops.remove("zn")
    machine.step(0.05, 2)
    assert session.loops.applied == {}
    with pytest.raises(RequestRefusedError, match="axis zn has no loop"):
        session.loops.remove("zn")
    assert not machine.list_events(CommandRefused)


def test_a_record_names_the_loop_and_has_a_smaller_error(machine):
    errors = []
    for with_loop in (False, True):
        if with_loop:
            machine.session.loops.apply(LOOP)
            machine.step(0.05, 2)
        machine.events.clear()
        machine.session.play(make_trajectory())
        machine.settle()
        record = machine.list_events(PlaybackFinished)[0].record
        assert record.metadata.get("feedback zn") == ("zn.toml, point 0" if with_loop else None)
        errors.append(float(np.std(record.signal("zn", Tap.MEAS) - record.signal("zn", Tap.CMD))))
    assert errors[1] < 0.03 * errors[0]
    offline = play_offline(WORN_ROBOT, make_trajectory(), loop=LOOP)
    assert offline.metadata["feedback zn"] == "zn.toml, point 0"
    np.testing.assert_allclose(offline.signal("zn", Tap.CMD), SWING, rtol=0.0, atol=1e-15)


def test_a_stop_keeps_the_loop_until_its_release_and_a_new_connection_removes_it(machine):
    session, loops = machine.session, machine.session.loops
    loops.apply(LOOP)
    machine.step(0.05)
    session.play(make_trajectory())
    machine.step(0.05, 12)
    session.emergency_stop()
    machine.settle()
    for request in (lambda: loops.apply(LOOP), lambda: loops.remove("zn")):
        with pytest.raises(RequestRefusedError, match="release it first"):
            request()
    machine.step(0.05, 2)
    assert set(loops.applied) == {"zn"}
    session.disconnect()
    machine.step(0.05, 2)
    session.reconnect()
    machine.step(0.05, 3)
    assert loops.applied == {}


def test_a_device_that_cannot_close_a_loop_refuses(machine, monkeypatch):
    monkeypatch.setattr(
        "rotemina.app.motion.session.regulation.AxisRegulator", type("Other", (), {})
    )
    assert machine.session.loops.applied == {}
    with pytest.raises(
        RequestRefusedError, match="cannot close a loop: its samples are too infrequent"
    ):
        machine.session.loops.apply(LOOP)


def test_an_unsuitable_loop_is_refused_before_any_motion():
    assert make_regulation(ROBOT, make_tuning_result(), "a.toml").name == "a.toml, point 0"
    with pytest.raises(UnstableError, match=r"a\.toml, point 0: axis zn: .* nothing was applied"):
        make_regulation(ROBOT, make_tuning_result(replace(GAINS, integral=9000.0)), "a.toml")
    with pytest.raises(FeedbackError, match="2 intervals late"):
        make_regulation(ROBOT, make_tuning_result(delay=2), "a.toml")
    with pytest.raises(FeedbackError, match="tuned for robot 'RoTeMiNa', not for"):
        make_regulation(load_robot("picma"), make_tuning_result(), "a.toml")
    with pytest.raises(FeedbackError, match=r"axis x of robot .* is not a piezo"):
        make_regulation(ROBOT, make_tuning_result(axis="x"), "a.toml")
    slow_loop = NamedRegulation(
        AxisRegulation(ROBOT, "zn", ControllerGains(integral=5.0), 1500.0), "slow"
    )
    with pytest.raises(InputError, match="must be a whole multiple"):
        play_offline(ROBOT, make_trajectory(), loop=slow_loop)
