"""Whole runs on the simulator: success, every early end, and limits that always hold."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.penetration import (
    RUNNING_PHASES,
    PenetrationController,
    PenetrationPhase,
    PenetrationVerdict,
)
from rotemina.app.motion.state import RunLabels
from rotemina.drivers.contract import ConnectionLostError
from rotemina.sim.errors import InputError
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
START = 64e-6
MOVING = [
    PenetrationPhase.APPROACH,
    PenetrationPhase.CONTACT,
    PenetrationPhase.THRUST,
    PenetrationPhase.HOLD,
    PenetrationPhase.INJECT,
    PenetrationPhase.HOLD_AFTER,
]
INJECTING = {"contact_pause_s": 0.2, "inject_s": 0.2, "hold_after_s": 0.2}


def make_cell(place=58e-6, stiffness=0.1):
    return AxisEffect(axis="zn", id="contact", parameters={"place": place, "stiffness": -stiffness})


HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 0.12 * 65e-6})
CREEP = AxisEffect(axis="zn", id="creep", parameters={"rate": 0.02})


def read_commands(bench):
    window = bench.session.history.tail()
    return window.device_time_s, window.command[:, 5]


def start_penetration(bench, phase=None):
    """Penetrate a soft cell until a phase."""
    bench.prepare([make_cell(58e-6, 0.05)]).arm(drift=0.02).press()
    if phase is not None:
        bench.step_until(phase)


def start_shallow_penetration(bench, phase, **parameters):
    """Penetrate a stiffer cell, which the thrust does not reach fully, until a phase."""
    bench.prepare([make_cell()]).arm(depth_tolerance=0.2, **parameters).press()
    bench.step_until(phase)


def test_a_whole_run_succeeds_and_is_logged(bench):
    bench.prepare([make_cell(58e-6, 0.05)]).arm(drift=0.02, inject_s=0.2, hold_after_s=0.2).step(
        times=20
    )
    bench.session.labels = RunLabels(sample="oocyte 7")
    bench.press()
    tool = {}
    while bench.phase in RUNNING_PHASES:
        bench.step(0.01)
        tool.setdefault(bench.phase, []).append(bench.session.tool.is_on)
    assert bench.phase is PenetrationPhase.DONE
    assert any(tool[PenetrationPhase.INJECT])
    assert not any(tool[PenetrationPhase.HOLD] + tool[PenetrationPhase.RETRACT])
    (run,), problems = bench.log.read()
    assert problems == ()
    assert run.verdict is PenetrationVerdict.DONE
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
    bench.harness.step(0.1)
    assert bench.session.snapshot().owners == {}


def test_after_a_membrane_gives_way_the_depth_is_within_one_percent(bench):
    start_penetration(bench, PenetrationPhase.THRUST)
    bench.step(0.03)
    bench.session.service.set_effects([])
    bench.run()
    run = bench.penetration.status.run
    assert run.verdict is PenetrationVerdict.DONE
    assert run.gave_way
    assert run.thrust.depth == pytest.approx(50e-6, rel=0.01)


def test_the_thrust_follows_its_profile_from_the_contact(bench):
    start_penetration(bench)
    trace = bench.step_until(PenetrationPhase.HOLD).trace
    travel = bench.history[-1][1] - bench.penetration._attempt.thrust_start
    assert travel == pytest.approx(-50e-6, abs=1e-12)
    expected_travel = trace.plan.target_shape.position(trace.time_s) / 1.05  # the cell pushes back
    assert np.abs(trace.travel - expected_travel).max() < 0.04 * 50e-6
    assert bench.run().trace is trace
    assert not trace.travel.flags.writeable


def test_a_capture_that_begins_before_the_thrust_repeats_no_time(bench, monkeypatch):
    """Captures of boards do: their samples and the telemetry belong to the same instants."""
    captures = bench.session.captures
    collect = captures.collect

    def collect_with_earlier_samples():
        parts = collect()
        if not parts or bench.penetration._attempt.captures:
            return parts
        time_s, measured = parts[0].device_time_s, parts[0].measured
        earlier = replace(
            parts[0],
            device_time_s=np.concatenate([time_s[0] - 1e-3 * np.arange(20, 0, -1), time_s]),
            measured=np.concatenate([np.repeat(measured[:1], 20, axis=0), measured]),
        )
        return (earlier, *parts[1:])

    monkeypatch.setattr(captures, "collect", collect_with_earlier_samples)
    start_penetration(bench)
    trace = bench.step_until(PenetrationPhase.HOLD).trace
    assert (np.diff(trace.time_s) > 0.0).all()


@pytest.mark.parametrize("is_held", [False, True])
def test_an_end_is_never_shown_without_its_run(bench, monkeypatch, is_held):
    """Windows and scripts read the status from other threads at any moment."""
    statuses = []

    def record_status(self, name, value):
        object.__setattr__(self, name, value)
        if name == "status":
            statuses.append(value)

    monkeypatch.setattr(PenetrationController, "__setattr__", record_status, raising=False)
    start_shallow_penetration(bench, PenetrationPhase.HOLD)
    bench.session.stop() if is_held else bench.press()
    end = bench.run().phase
    assert end is (PenetrationPhase.HELD if is_held else PenetrationPhase.ABORTED)
    runs = [status.run for status in statuses if status.phase is end]
    assert runs
    assert all(run is not None and run.verdict == end for run in runs)


@pytest.mark.parametrize("phase", MOVING)
def test_the_button_aborts_every_phase_and_the_tip_comes_back(bench, phase):
    start_shallow_penetration(bench, phase, **INJECTING)
    bench.press()
    assert bench.phase is PenetrationPhase.RETRACT
    status = bench.run()
    assert status.phase is PenetrationPhase.ABORTED
    assert status.run.reason == f"stopped by the button in {phase}"
    state = bench.session.snapshot()
    assert state.command["zn"] == START
    assert state.fault is None
    assert bench.session.tool.is_on is False


@pytest.mark.parametrize("phase", [*MOVING, PenetrationPhase.RETRACT])
@pytest.mark.parametrize("cause", ["emergency stop", "stop", "lost link", "taken over"])
def test_an_external_end_holds_the_tip_and_never_retracts_by_itself(bench, cause, phase):
    start_shallow_penetration(bench, phase, **INJECTING)
    if cause == "emergency stop":
        bench.session.emergency_stop()
    elif cause == "stop":
        bench.session.stop()
    elif cause == "taken over":
        bench.session.reservations.take_over(["x"], "operator")
    else:

        def lose_link():
            raise ConnectionLostError("torn off")

        bench.harness.driver.before["read"] = lose_link
    bench.step(0.02, 10)
    assert bench.phase is PenetrationPhase.HELD
    assert bench.session.tool.is_on is False
    position = bench.session.snapshot().command["zn"]
    bench.session.release()
    bench.step(0.1, 20)
    assert bench.phase is PenetrationPhase.HELD
    assert bench.session.snapshot().command["zn"] == position
    assert bench.penetration.status.run.verdict is PenetrationVerdict.HELD


def test_the_button_retracts_a_held_tip_only_when_safe(bench):
    start_shallow_penetration(bench, PenetrationPhase.HOLD)
    bench.session.emergency_stop()
    bench.step(0.02, 5)
    with pytest.raises(RequestRefusedError, match="release it first"):
        bench.press()
    with pytest.raises(RequestRefusedError, match="held"):
        bench.arm()
    with pytest.raises(RequestRefusedError, match="release it first"):
        bench.session.go_to({"x": 0.03})
    bench.session.release()
    with pytest.raises(RequestRefusedError, match="penetration controls axis"):
        bench.session.go_to({"x": 0.03})
    bench.press()
    assert bench.run().phase is PenetrationPhase.ABORTED
    assert bench.session.snapshot().command["zn"] == START


def test_disarming_leaves_a_held_tip_where_it_is(bench):
    start_shallow_penetration(bench, PenetrationPhase.HOLD)
    bench.session.stop()
    bench.step(0.02, 5)
    position = bench.session.snapshot().command["zn"]
    bench.penetration.disarm()
    bench.step(0.1, 5)
    assert bench.session.snapshot().command["zn"] == position
    assert bench.session.snapshot().owners == {}
    with pytest.raises(RequestRefusedError, match="not armed"):
        bench.press()


def test_without_contact_the_approach_ends_at_its_distance_and_retracts(bench):
    bench.prepare().arm().press()
    status = bench.run()
    assert status.phase is PenetrationPhase.FAILED
    assert "no contact within 10 µm" in status.reason
    _, zn = read_commands(bench)
    assert START - 13e-6 < zn[-2000:].min() < START - 9.9e-6
    assert bench.session.snapshot().command["zn"] == START


def test_a_cell_that_is_touched_at_the_start_is_detected(bench):
    bench.prepare([make_cell(63.95e-6, 1.0)]).arm(depth=10e-6, depth_tolerance=0.5).press()
    bench.step_until(PenetrationPhase.CONTACT)
    assert START - bench.session.snapshot().command["zn"] < 2e-6
    bench.run()


def test_a_cell_is_a_contact_but_hysteresis_creep_and_noise_are_not(bench):
    bench.prepare([HYSTERESIS, CREEP], start=60e-6).arm(depth=40e-6).press()
    assert "no contact" in bench.run().reason
    bench.session.service.set_effects([HYSTERESIS, CREEP, make_cell(62e-6, 0.3)])
    bench.step(0.02, 50)
    bench.arm(depth=40e-6, depth_tolerance=0.5, overload=3e-5).press()
    bench.step_until(PenetrationPhase.CONTACT)
    measured = bench.penetration._attempt.contact.measured
    assert measured == pytest.approx(62e-6, abs=0.5e-6)
    assert bench.run().phase is PenetrationPhase.DONE


def test_an_overload_ends_the_thrust(bench):
    bench.prepare([make_cell(58e-6, 1.0)]).arm(overload=5e-6).press()
    status = bench.run()
    assert status.phase is PenetrationPhase.FAILED
    assert "overload" in status.reason
    assert "at most 5 µm" in status.reason
    _, zn = read_commands(bench)
    assert zn.min() > 58e-6 - 45e-6
    assert bench.session.snapshot().command["zn"] == START


def test_a_thrust_that_stays_too_shallow_fails_and_retracts(bench):
    bench.prepare([make_cell(58e-6, 0.15)]).arm(depth_tolerance=0.1).press()
    status = bench.run()
    assert status.phase is PenetrationPhase.FAILED
    assert "instead of 50 µm, more than 10 % off" in status.reason
    assert status.run.thrust.depth == pytest.approx(50e-6 / 1.15, rel=0.02)


def test_a_full_disk_is_reported_and_does_not_stop_the_run(bench, tmp_path):
    bench.log.path = str(tmp_path)
    bench.prepare().arm().press()
    status = bench.run()
    assert status.phase is PenetrationPhase.FAILED
    assert "cannot be written" in status.log_problem


def test_closing_the_program_holds_the_tip(bench):
    start_shallow_penetration(bench, PenetrationPhase.THRUST)
    bench.penetration.close()
    assert bench.phase is PenetrationPhase.HELD
    assert [run.verdict for run in bench.log.read()[0]] == [PenetrationVerdict.HELD]
    bench.harness.step(0.02, 50)
    assert START - bench.session.snapshot().command["zn"] > 5e-6


def test_an_approach_ends_when_the_controller_is_no_longer_stepped(bench):
    bench.prepare().arm().press()
    bench.step(0.02, 20)
    bench.harness.step(0.02, 20)
    position = bench.session.snapshot().command["zn"]
    bench.harness.step(0.02, 50)
    assert bench.session.snapshot().command["zn"] == position


def test_a_thrust_that_the_device_refuses_retracts_and_gives_the_reason(bench, monkeypatch):
    def refuse(self, permit):
        raise InputError("broken")

    bench.prepare([make_cell()]).arm().press()
    monkeypatch.setattr(type(bench.harness.driver), "_trigger", refuse)
    status = bench.run()
    assert status.phase is PenetrationPhase.FAILED
    assert "the device did not run the thrust: broken" in status.reason


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
def test_limits_hold_at_every_moment(make_bench, place, stiffness, presses, shape, shaping):
    bench = make_bench().prepare([make_cell(place, stiffness)])
    bench.arm(shape=shape, shaping=shaping, hold_s=0.1, depth_tolerance=0.5).press()
    for step in range(400):
        if step in presses and bench.phase in RUNNING_PHASES | {PenetrationPhase.HELD}:
            bench.press()
        bench.step(0.01)
    time_s, zn = read_commands(bench)
    axis = ROBOT.axes["zn"]
    is_recent = time_s > time_s[-1] - 4.0
    speed = np.abs(np.diff(zn[is_recent]) / np.diff(time_s[is_recent]))
    assert zn[is_recent].min() >= START - (10e-6 + 2e-6 + 50e-6) - 1e-12
    assert zn[is_recent].max() <= START + 1e-12
    assert speed.max() <= axis.max_speed
    assert np.abs(np.diff(speed)).max() / 1e-3 <= axis.max_acceleration * (1 + 1e-6)
    assert bench.phase in {
        PenetrationPhase.DONE,
        PenetrationPhase.FAILED,
        PenetrationPhase.ABORTED,
        PenetrationPhase.HELD,
    }
