"""Profiles, captures, voltages, the tool and reservations through the session."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.state import CommandRefused
from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.drivers.contract import DeviceState, Driver
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError, OutOfLimitsError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import KeepOut
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
# Smoothstep: 20 µm down in 20 ms, 1.5 mm/s at most.
DOWN = MotionProfile("zn", (ProfileSegment(0.02, 0.0, -60e-6, 40e-6),))
# In the middle of the workspace the tip is at 33 µm, in the slow zone of this floor.
ROBOT_NEAR_FLOOR = replace(ROBOT, keep_out=KeepOut(floor=-0.2e-3))


@pytest.fixture
def make_ready(make_harness):
    def make(robot="rotemina", **options):
        harness = make_harness(robot, **options)
        harness.step()
        return harness

    return make


def run_profile(harness, profile, owner="operator"):
    harness.session.profiles.upload(profile, owner)
    harness.step()
    harness.session.profiles.trigger(owner)


def test_a_profile_is_uploaded_triggered_and_ends_at_its_target(make_ready):
    harness = make_ready()
    begin = harness.session.snapshot().command["zn"]
    harness.session.profiles.upload(DOWN)
    assert harness.step(0.1).command["zn"] == begin
    harness.session.profiles.trigger()
    with pytest.raises(RequestRefusedError, match="playing"):
        harness.session.go_to({"x": 0.03})
    state = harness.step(0.01, 8)
    assert state.activity is DeviceState.IDLE
    assert state.command["zn"] == pytest.approx(begin - 20e-6, abs=1e-15)
    assert harness.list_events(CommandRefused) == []
    with pytest.raises(RequestRefusedError, match="no profile was uploaded"):
        harness.session.profiles.trigger()


def test_a_profile_is_not_triggered_after_another_move(make_ready):
    harness = make_ready()
    harness.session.profiles.upload(DOWN)
    harness.step()
    harness.session.jog("zn", 1e-6)
    harness.step_until_idle()
    with pytest.raises(RequestRefusedError, match="has moved since"):
        harness.session.profiles.trigger()


def test_an_abort_halts_a_profile_without_a_fault(make_ready):
    harness = make_ready()
    begin = harness.session.snapshot().command["zn"]
    run_profile(harness, DOWN)
    harness.step(0.001)
    harness.session.profiles.abort()
    harness.step(0.008)
    state = harness.step_until_idle()
    assert begin - 19e-6 < state.command["zn"] < begin
    assert state.fault is None
    harness.session.jog("zn", 1e-6)


@pytest.mark.parametrize(
    ("segment", "message"),
    [
        (ProfileSegment(1.0, 0.0, -300e-6, 200e-6), "range"),
        (ProfileSegment(1e-3, 0.0, -60e-6, 40e-6), "at most"),
        (ProfileSegment(1.0, 0.0, float("nan"), 0.0), "finite"),
    ],
)
def test_a_profile_beyond_the_axis_is_refused_at_once(make_ready, segment, message):
    harness = make_ready()
    with pytest.raises(InputError, match=message):
        harness.session.profiles.upload(MotionProfile("zn", (segment,)))
    assert harness.step(0.05).command == harness.session.snapshot().command


def test_near_the_floor_only_the_owner_of_all_axes_may_thrust_and_none_through_it(make_ready):
    harness = make_ready(ROBOT_NEAR_FLOOR)
    profiles, reservations = harness.session.profiles, harness.session.reservations
    profiles.upload(MotionProfile("zn", (ProfileSegment(0.1, 0.0, -60e-6, 40e-6),)))  # slow
    harness.step()
    with pytest.raises(OutOfLimitsError, match="only an armed penetration"):
        profiles.upload(DOWN)
    reservations.reserve("penetration")
    with pytest.raises(OutOfLimitsError, match="only an armed penetration"):
        profiles.upload(DOWN, "operator")
    profiles.upload(DOWN, "penetration")
    harness.step()
    profiles.trigger("penetration")
    assert harness.step(0.01, 10).activity is DeviceState.IDLE
    harness = make_ready(replace(ROBOT, keep_out=KeepOut(floor=20e-6)))
    harness.session.reservations.reserve("penetration")
    with pytest.raises(OutOfLimitsError, match="its floor is"):
        harness.session.profiles.upload(DOWN, "penetration")


def test_reserved_axes_keep_their_owner_at_rest(make_ready):
    harness = make_ready()
    session, reservations = harness.session, harness.session.reservations
    reservations.reserve("penetration")
    assert set(harness.step(0.1, 5).owners.values()) == {"penetration"}
    for request in (
        lambda: session.go_to({"x": 0.03}),
        lambda: session.move_velocity({"y": 1e-3}),
        lambda: session.home(["x"]),
        lambda: session.set_voltage("thx", 60.0),
        lambda: reservations.reserve("another"),
    ):
        with pytest.raises(RequestRefusedError, match="penetration controls axis"):
            request()
    session.stop()
    harness.step_until_idle()
    assert reservations.is_reserved_by("penetration")
    reservations.take_over(["x"], "operator")
    assert not reservations.is_reserved_by("penetration")
    session.go_to({"x": 0.028})
    harness.step()
    with pytest.raises(RequestRefusedError, match="still moving"):
        reservations.reserve("operator")
    harness.step_until_idle()
    harness.step(0.1)
    assert "x" not in session.snapshot().owners
    reservations.end_reservations("penetration")
    assert harness.step(0.1).owners == {}


@pytest.mark.parametrize("stopped", [False, True])
def test_a_capture_comes_in_parts_even_if_a_stop_drops_the_request(make_ready, stopped):
    harness = make_ready()
    captures = harness.session.captures
    captures.begin(("zn",), 500.0, 40)
    parts = list(captures.collect())
    harness.step()
    if stopped:
        parts += captures.collect()
        harness.session.stop()
    for _ in range(12):
        harness.step()
        parts += captures.collect()
    assert sum(len(part.device_time_s) for part in parts) == 40
    assert [part.complete for part in parts] == [False] * (len(parts) - 1) + [True]
    times = np.concatenate([part.device_time_s for part in parts])
    np.testing.assert_allclose(np.diff(times), 2e-3, atol=1e-9)


def test_a_voltage_moves_its_piezo_within_every_limit(make_ready):
    harness = make_ready()
    harness.session.set_voltage("zn", 50.0)
    assert harness.step_until_idle().command["zn"] == pytest.approx(25e-6)
    harness.session.jog("zn", 1e-6)
    assert harness.step_until_idle().command["zn"] == pytest.approx(26e-6)
    with pytest.raises(OutOfLimitsError, match="0 to 130 V"):
        harness.session.set_voltage("zn", 131.0)
    with pytest.raises(OutOfLimitsError, match="no amplifier"):
        harness.session.set_voltage("x", 1.0)
    harness_near_floor = make_ready(ROBOT_NEAR_FLOOR)
    with pytest.raises(RequestRefusedError, match="move the axis instead"):
        harness_near_floor.session.set_voltage("zn", 1.0)


def test_the_tool_goes_off_at_a_stop_and_cannot_be_switched_on_while_motion_is_locked(make_ready):
    harness = make_ready()
    session = harness.session
    assert session.tool.is_on is False
    session.tool.switch(True)
    harness.step()
    assert session.tool.is_on is True
    session.emergency_stop()
    assert session.tool.is_on is False
    harness.step()
    with pytest.raises(RequestRefusedError, match="release it first"):
        session.tool.switch(True)
    session.tool.switch(False)


def test_moves_are_no_faster_than_requested(make_ready):
    harness = make_ready()
    begin = harness.session.snapshot().command["zn"]
    harness.session.go_to({"zn": begin - 10e-6}, speeds={"zn": 100e-6})
    harness.step_until_idle()
    window = harness.session.history.tail(1.0)
    speeds = np.abs(np.diff(window.command[:, 5]) / np.diff(window.device_time_s))
    assert speeds.max() == pytest.approx(100e-6, rel=1e-3)


def test_an_unsupported_request_is_refused_with_the_driver_name(make_ready, monkeypatch):
    harness = make_ready()
    hooks = {name: lambda *_: None for name in Driver.__abstractmethods__}
    plain_driver = type("Plain", (Driver,), {"name": "plain", **hooks})(ROBOT)
    monkeypatch.setattr(harness.session._link, "driver", plain_driver)
    session = harness.session
    assert session.tool.is_on is None
    for request in (
        lambda: session.profiles.upload(DOWN),
        lambda: session.profiles.trigger(),
        lambda: session.profiles.abort(),
        lambda: session.captures.begin(("zn",), 100.0, 10),
        lambda: session.set_voltage("zn", 1.0),
        lambda: session.tool.switch(True),
    ):
        with pytest.raises(RequestRefusedError, match="'plain'"):
            request()
    trajectory = Record.from_signals([0.0, 1.0], {("zn", Tap.CMD): [3e-5, 3e-5]}, {"zn": "m"})
    with pytest.raises(RequestRefusedError, match="'plain' cannot play"):
        session.play(trajectory)


def test_the_simulated_tool_is_off_after_reopening(make_ready):
    driver = make_ready(driver=Simulator).driver
    driver.switch_tool(True)
    driver.close()
    driver.open()
    assert not driver.tool_on
