"""Whole runs on the simulator: success, every way to end one early, and what must never be."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.penetration.penetration import Penetration
from rotemina.app.motion.penetration.run_log import Verdict
from rotemina.app.motion.penetration.status import UNDER_WAY, Phase
from rotemina.app.motion.run_labels import RunLabels
from rotemina.drivers.errors import ConnectionLostError
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
START = 64e-6
MOVING = [Phase.APPROACH, Phase.CONTACT, Phase.THRUST, Phase.HOLD, Phase.INJECT, Phase.HOLD_AFTER]
QUICK = {
    ("emergency stop", Phase.THRUST),
    ("emergency stop", Phase.HOLD),
    ("emergency stop", Phase.INJECT),
    ("stop", Phase.RETRACT),
    ("lost link", Phase.HOLD),
    ("taken over", Phase.THRUST),
}
INJECTING = {"inject_s": 0.2, "hold_after_s": 0.2}


def cell(place=58e-6, stiffness=0.1):
    return AxisEffect(axis="zn", id="contact", parameters={"place": place, "stiffness": -stiffness})


HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6})
CREEP = AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02})


def commands(bench):
    window = bench.session.history.tail()
    return window.device_time_s, window.command[:, 5]


def test_a_whole_run_succeeds_and_is_logged(bench):
    bench.ready([cell(58e-6, 0.05)]).arm(drift=0.02, **INJECTING).step(times=20)
    bench.session.labels = RunLabels(sample="oocyte 7")
    bench.press()
    tool = {}
    while bench.phase in UNDER_WAY:
        bench.step(0.01)
        tool.setdefault(bench.phase, []).append(bench.session.tool.on)
    assert bench.phase is Phase.DONE
    assert any(tool[Phase.INJECT])
    assert not any(tool[Phase.HOLD] + tool[Phase.RETRACT])
    (run,), problems = bench.log.read()
    assert problems == ()
    assert run.verdict is Verdict.DONE
    assert run.started == "2026-11-21T00:00:00+00:00"
    assert (run.run, run.sample) == ("", "oocyte 7")
    assert [name for name, _ in run.phases] == [
        "approach", "contact", "thrust", "hold", "inject", "hold after", "retract", "done",
    ]  # fmt: skip
    assert run.contact == pytest.approx(58e-6, abs=0.3e-6)
    assert 0.0 < run.contact_delay_s < 0.1
    assert run.noise_rms == pytest.approx(12.2e-9, rel=0.1)
    assert run.thrust.depth == pytest.approx(50e-6 * (1 - 0.05 / 1.05), rel=0.01)
    assert run.thrust.average_speed == pytest.approx(run.thrust.depth / 0.09)
    assert run.thrust.peak_speed == pytest.approx(run.planned_peak_speed, rel=0.1)
    assert run.peak_deviation == pytest.approx(50e-6 * 0.05 / 1.05, rel=0.1)
    assert run.gave_way is False
    assert bench.session.snapshot().command["zn"] == START
    bench.stepped.step(0.1)
    assert bench.session.snapshot().owners == {}


def test_a_membrane_that_gives_way_leaves_the_nominal_robot_within_one_percent(bench):
    bench.ready([cell(58e-6, 0.05)]).arm(drift=0.02).press()
    bench.until(Phase.THRUST)
    bench.step(0.03)
    bench.session.service.set_effects([])
    bench.run()
    run = bench.penetration.status.run
    assert run.verdict is Verdict.DONE
    assert run.gave_way
    assert run.thrust.depth == pytest.approx(50e-6, rel=0.01)


def test_the_thrust_goes_as_deep_as_asked_from_where_the_contact_was(bench):
    bench.ready([cell(58e-6, 0.05)]).arm(drift=0.02).press()
    bench.until(Phase.HOLD)
    way = bench.places[-1][1] - bench.penetration._attempt.thrust_from
    assert way == pytest.approx(-50e-6, abs=1e-12)


def test_the_thrust_can_be_drawn_beside_its_profile(bench):
    bench.ready([cell(58e-6, 0.05)]).arm(drift=0.02).press()
    trace = bench.until(Phase.HOLD).trace
    wanted = trace.plan.wanted.position(trace.time_s) / 1.05  # the cell pushes back
    assert np.abs(trace.way - wanted).max() < 0.04 * 50e-6
    assert bench.run().trace is trace
    assert not trace.way.flags.writeable


def test_a_capture_that_begins_before_the_thrust_leaves_no_time_twice(bench, monkeypatch):
    """Boards' captures do; their samples and telemetry are of the same instants."""
    captures = bench.session.captures
    collected = captures.collected

    def with_earlier():
        parts = collected()
        if not parts or bench.penetration._attempt.captured:
            return parts
        time_s, measured = parts[0].device_time_s, parts[0].measured
        earlier = replace(
            parts[0],
            device_time_s=np.concatenate([time_s[0] - 1e-3 * np.arange(20, 0, -1), time_s]),
            measured=np.concatenate([np.repeat(measured[:1], 20, axis=0), measured]),
        )
        return (earlier, *parts[1:])

    monkeypatch.setattr(captures, "collected", with_earlier)
    bench.ready([cell(58e-6, 0.05)]).arm(drift=0.02).press()
    trace = bench.until(Phase.HOLD).trace
    assert (np.diff(trace.time_s) > 0.0).all()


@pytest.mark.parametrize("held", [False, True])
def test_an_end_is_never_shown_without_its_run(bench, monkeypatch, held):
    """Windows and scripts look at the status from other threads, at any moment."""
    shown = []

    def noting(self, name, value):
        object.__setattr__(self, name, value)
        if name == "status":
            shown.append(value)

    monkeypatch.setattr(Penetration, "__setattr__", noting, raising=False)
    bench.ready([cell()]).arm(depth_tolerance=0.2).press()
    bench.until(Phase.HOLD)
    bench.session.stop() if held else bench.press()
    end = bench.run().phase
    assert end is (Phase.HELD if held else Phase.ABORTED)
    seen = [status.run for status in shown if status.phase is end]
    assert seen
    assert all(run is not None and run.verdict == end for run in seen)


@pytest.mark.parametrize("phase", MOVING)
def test_the_button_aborts_every_phase_and_the_tip_comes_back(bench, phase):
    bench.ready([cell()]).arm(depth_tolerance=0.2, contact_pause_s=0.2, **INJECTING).press()
    bench.until(phase)
    bench.press()
    assert bench.phase is Phase.RETRACT
    status = bench.run()
    assert status.phase is Phase.ABORTED
    assert status.run.reason == f"stopped by the button in {phase}"
    state = bench.session.snapshot()
    assert state.command["zn"] == START
    assert state.fault is None
    assert bench.session.tool.on is False


@pytest.mark.parametrize(
    ("how", "phase"),
    [
        pytest.param(how, phase, marks=() if (how, phase) in QUICK else pytest.mark.slow)
        for how in ("emergency stop", "stop", "lost link", "taken over")
        for phase in (*MOVING, Phase.RETRACT)
    ],
)
def test_what_somebody_else_ends_is_held_and_never_goes_back_by_itself(bench, how, phase):
    bench.ready([cell()]).arm(depth_tolerance=0.2, contact_pause_s=0.2, **INJECTING).press()
    bench.until(phase)
    if how == "emergency stop":
        bench.session.emergency_stop()
    elif how == "stop":
        bench.session.stop()
    elif how == "taken over":
        bench.session.reservations.take_over(["x"], "operator")
    else:

        def lost():
            raise ConnectionLostError("torn off")

        bench.stepped.driver.before["read"] = lost
    bench.step(0.02, 10)
    assert bench.phase is Phase.HELD
    assert bench.session.tool.on is False
    place = bench.session.snapshot().command["zn"]
    bench.session.release()
    bench.step(0.1, 20)
    assert bench.phase is Phase.HELD
    assert bench.session.snapshot().command["zn"] == place
    assert bench.penetration.status.run.verdict is Verdict.HELD


def test_a_held_tip_goes_back_by_the_button_when_that_is_safe(bench):
    bench.ready([cell()]).arm(depth_tolerance=0.2).press()
    bench.until(Phase.HOLD)
    bench.session.emergency_stop()
    bench.step(0.02, 5)
    with pytest.raises(RefusedError, match="release it first"):
        bench.press()
    with pytest.raises(RefusedError, match="held"):
        bench.arm()
    with pytest.raises(RefusedError, match="release it first"):
        bench.session.go_to({"x": 0.03})
    bench.session.release()
    with pytest.raises(RefusedError, match="penetration controls axis"):
        bench.session.go_to({"x": 0.03})
    bench.press()
    assert bench.run().phase is Phase.ABORTED
    assert bench.session.snapshot().command["zn"] == START


def test_a_held_tip_can_be_let_go_of_where_it_is(bench):
    bench.ready([cell()]).arm(depth_tolerance=0.2).press()
    bench.until(Phase.HOLD)
    bench.session.stop()
    bench.step(0.02, 5)
    place = bench.session.snapshot().command["zn"]
    bench.penetration.disarm()
    bench.step(0.1, 5)
    assert bench.session.snapshot().command["zn"] == place
    assert bench.session.snapshot().owners == {}
    with pytest.raises(RefusedError, match="not armed"):
        bench.press()


def test_no_contact_ends_within_the_distance_and_goes_back(bench):
    bench.ready().arm().press()
    status = bench.run()
    assert status.phase is Phase.FAILED
    assert "no contact within 10 µm" in status.reason
    _, way = commands(bench)
    assert START - 13e-6 < way[-2000:].min() < START - 9.9e-6
    assert bench.session.snapshot().command["zn"] == START


def test_a_cell_that_is_touched_at_once_is_found(bench):
    bench.ready([cell(63.95e-6, 1.0)]).arm(depth=10e-6, depth_tolerance=0.5).press()
    bench.until(Phase.CONTACT)
    assert START - bench.session.snapshot().command["zn"] < 2e-6
    bench.run()


def test_hysteresis_creep_and_noise_are_no_contact_and_a_cell_is(bench):
    bench.ready([HYSTERESIS, CREEP], start=60e-6).arm(depth=40e-6).press()
    assert "no contact" in bench.run().reason
    bench.session.service.set_effects([HYSTERESIS, CREEP, cell(62e-6, 0.3)])
    bench.step(0.02, 50)
    bench.arm(depth=40e-6, depth_tolerance=0.5, overload=3e-5).press()
    bench.until(Phase.CONTACT)
    measured = bench.penetration._attempt.contact.measured
    assert measured == pytest.approx(62e-6, abs=0.5e-6)
    assert bench.run().phase is Phase.DONE


def test_an_overload_ends_the_thrust(bench):
    bench.ready([cell(58e-6, 1.0)]).arm(overload=5e-6).press()
    status = bench.run()
    assert status.phase is Phase.FAILED
    assert "overload" in status.reason
    assert "at most 5 µm" in status.reason
    _, way = commands(bench)
    assert way.min() > 58e-6 - 45e-6
    assert bench.session.snapshot().command["zn"] == START


def test_a_thrust_that_stays_too_shallow_fails_and_goes_back(bench):
    bench.ready([cell(58e-6, 0.15)]).arm(depth_tolerance=0.1).press()
    status = bench.run()
    assert status.phase is Phase.FAILED
    assert "instead of 50 µm, more than 10 % off" in status.reason
    assert status.run.thrust.depth == pytest.approx(50e-6 / 1.15, rel=0.02)


def test_a_full_disk_is_told_and_stops_nothing(bench, tmp_path):
    bench.log.path = str(tmp_path)
    bench.ready().arm().press()
    status = bench.run()
    assert status.phase is Phase.FAILED
    assert "cannot be written" in status.problem


def test_a_program_that_closes_holds_the_tip(bench):
    bench.ready([cell()]).arm(depth_tolerance=0.2).press()
    bench.until(Phase.THRUST)
    bench.penetration.close()
    assert bench.phase is Phase.HELD
    assert [run.verdict for run in bench.log.read()[0]] == [Verdict.HELD]
    bench.stepped.step(0.02, 50)
    assert START - bench.session.snapshot().command["zn"] > 5e-6


def test_an_approach_that_nobody_steps_ends_by_itself(bench):
    bench.ready().arm().press()
    bench.step(0.02, 20)
    bench.stepped.step(0.02, 20)
    place = bench.session.snapshot().command["zn"]
    bench.stepped.step(0.02, 50)
    assert bench.session.snapshot().command["zn"] == place


def test_a_thrust_that_the_device_will_not_run_goes_back_with_its_reason(bench, monkeypatch):
    bench.ready([cell()]).arm().press()
    monkeypatch.setattr(type(bench.stepped.driver), "_trigger", _refuse)
    status = bench.run()
    assert status.phase is Phase.FAILED
    assert "the device did not run the thrust: broken" in status.reason


def _refuse(self, permit):
    raise InputError("broken")


@pytest.mark.slow
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=8, deadline=None
)
@given(
    place=st.floats(45e-6, 64e-6),
    stiffness=st.floats(0.02, 3.0),
    presses=st.lists(st.integers(0, 250), max_size=2),
    shape=st.sampled_from(["s_curve", "minimum_jerk"]),
    shaping=st.sampled_from(["none", "zv", "zvdd", "inverse"]),
)
def test_at_every_moment_it_is_within_its_limits(
    make_bench, place, stiffness, presses, shape, shaping
):
    bench = make_bench().ready([cell(place, stiffness)])
    bench.arm(shape=shape, shaping=shaping, hold_s=0.1, depth_tolerance=0.5).press()
    for step in range(400):
        if step in presses and bench.phase in UNDER_WAY | {Phase.HELD}:
            bench.press()
        bench.step(0.01)
    time_s, way = commands(bench)
    axis = ROBOT.axes["zn"]
    late = time_s > time_s[-1] - 4.0
    speed = np.abs(np.diff(way[late]) / np.diff(time_s[late]))
    assert way[late].min() >= START - (10e-6 + 2e-6 + 50e-6) - 1e-12
    assert way[late].max() <= START + 1e-12
    assert speed.max() <= axis.max_speed
    assert np.abs(np.diff(speed)).max() / 1e-3 <= axis.max_acceleration * (1 + 1e-6)
    assert bench.phase in {Phase.DONE, Phase.FAILED, Phase.ABORTED, Phase.HELD}
