"""Profiles, captures, voltages, a tool and reservations, asked for through the session."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.state import CommandRefused
from rotemina.drivers.driver import Driver
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import KeepOut
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

ROBOT = load_robot("rotemina")
# Smoothstep: 20 µm down in 20 ms, 1.5 mm/s at most.
DOWN = Profile("zn", (ProfileSegment(0.02, 0.0, -60e-6, 40e-6),))
# The tip stands 33 µm high in the middle of the workspace: in the slow zone of this floor.
CLOSE = replace(ROBOT, keep_out=KeepOut(floor=-0.2e-3))


@pytest.fixture
def ready(make_stepped):
    def make(robot="rotemina", **options):
        stepped = make_stepped(robot, **options)
        stepped.step()
        return stepped

    return make


def run(stepped, profile, owner="operator"):
    stepped.session.profiles.upload(profile, owner)
    stepped.step()
    stepped.session.profiles.trigger(owner)


def test_a_profile_is_uploaded_triggered_and_ends_where_it_says(ready):
    stepped = ready()
    begin = stepped.session.snapshot().command["zn"]
    stepped.session.profiles.upload(DOWN)
    assert stepped.step(0.1).command["zn"] == begin
    stepped.session.profiles.trigger()
    with pytest.raises(RefusedError, match="playing"):
        stepped.session.go_to({"x": 0.03})
    state = stepped.step(0.01, 8)
    assert state.activity is DeviceState.IDLE
    assert state.command["zn"] == pytest.approx(begin - 20e-6, abs=1e-15)
    assert stepped.told(CommandRefused) == []
    with pytest.raises(RefusedError, match="no profile was uploaded"):
        stepped.session.profiles.trigger()


def test_a_profile_is_not_triggered_from_elsewhere(ready):
    stepped = ready()
    stepped.session.profiles.upload(DOWN)
    stepped.step()
    stepped.session.jog("zn", 1e-6)
    stepped.until_idle()
    with pytest.raises(RefusedError, match="has moved since"):
        stepped.session.profiles.trigger()


def test_an_abort_halts_a_profile_without_a_fault(ready):
    stepped = ready()
    begin = stepped.session.snapshot().command["zn"]
    run(stepped, DOWN)
    stepped.step(0.001)
    stepped.session.profiles.abort()
    stepped.step(0.008)
    state = stepped.until_idle()
    assert begin - 19e-6 < state.command["zn"] < begin
    assert state.fault is None
    stepped.session.jog("zn", 1e-6)


@pytest.mark.parametrize(
    ("segment", "message"),
    [
        (ProfileSegment(1.0, 0.0, -300e-6, 200e-6), "range"),
        (ProfileSegment(1e-3, 0.0, -60e-6, 40e-6), "at most"),
        (ProfileSegment(1.0, 0.0, float("nan"), 0.0), "finite"),
    ],
)
def test_a_profile_beyond_the_axis_is_refused_at_once(ready, segment, message):
    stepped = ready()
    with pytest.raises(InputError, match=message):
        stepped.session.profiles.upload(Profile("zn", (segment,)))
    assert stepped.step(0.05).command == stepped.session.snapshot().command


def test_close_above_the_floor_only_who_reserved_all_axes_may_thrust(ready):
    stepped = ready(CLOSE)
    with pytest.raises(OutOfLimitsError, match="only an armed penetration"):
        stepped.session.profiles.upload(DOWN)
    stepped.session.reservations.reserve("penetration")
    with pytest.raises(OutOfLimitsError, match="only an armed penetration"):
        stepped.session.profiles.upload(DOWN, "operator")
    stepped.session.profiles.upload(DOWN, "penetration")
    stepped.step()
    stepped.session.profiles.trigger("penetration")
    assert stepped.step(0.01, 10).activity is DeviceState.IDLE


def test_nothing_lets_a_thrust_through_the_floor(ready):
    stepped = ready(replace(ROBOT, keep_out=KeepOut(floor=20e-6)))
    stepped.session.reservations.reserve("penetration")
    with pytest.raises(OutOfLimitsError, match="its floor is"):
        stepped.session.profiles.upload(DOWN, "penetration")


def test_a_slow_profile_needs_no_permission(ready):
    stepped = ready(CLOSE)
    slow = Profile("zn", (ProfileSegment(0.1, 0.0, -60e-6, 40e-6),))
    stepped.session.profiles.upload(slow)


def test_reserved_axes_stay_their_owners_at_rest(ready):
    stepped = ready()
    session = stepped.session
    session.reservations.reserve("penetration")
    assert set(stepped.step(0.1, 5).owners.values()) == {"penetration"}
    for ask in (
        lambda: session.go_to({"x": 0.03}),
        lambda: session.move_velocity({"y": 1e-3}),
        lambda: session.home(["x"]),
        lambda: session.set_voltage("thx", 60.0),
        lambda: session.reservations.reserve("another"),
    ):
        with pytest.raises(RefusedError, match="penetration controls axis"):
            ask()
    session.stop()
    stepped.until_idle()
    assert session.reservations.held_by("penetration")
    session.reservations.take_over(["x"], "operator")
    assert not session.reservations.held_by("penetration")
    session.go_to({"x": 0.028})
    stepped.until_idle()
    stepped.step(0.1)
    assert "x" not in session.snapshot().owners
    session.reservations.set_free("penetration")
    assert stepped.step(0.1).owners == {}


def test_axes_that_somebody_drives_cannot_be_reserved(ready):
    stepped = ready()
    stepped.session.go_to({"x": 0.03})
    stepped.step()
    with pytest.raises(RefusedError, match="still moving"):
        stepped.session.reservations.reserve("penetration")


def test_a_capture_comes_in_parts(ready):
    stepped = ready()
    stepped.session.captures.begin(("zn",), 500.0, 40)
    parts = []
    for _ in range(12):
        parts += stepped.session.captures.collected()
        stepped.step()
    assert sum(len(part.device_time_s) for part in parts) == 40
    assert [part.complete for part in parts] == [False] * (len(parts) - 1) + [True]
    times = np.concatenate([part.device_time_s for part in parts])
    np.testing.assert_allclose(np.diff(times), 2e-3, atol=1e-9)


def test_a_stop_that_drops_the_question_does_not_end_a_capture(ready):
    stepped = ready()
    stepped.session.captures.begin(("zn",), 500.0, 40)
    stepped.step()
    stepped.session.captures.collected()
    stepped.session.stop()
    parts = []
    for _ in range(12):
        stepped.step()
        parts += stepped.session.captures.collected()
    assert sum(len(part.device_time_s) for part in parts) == 40


def test_a_voltage_moves_its_piezo_and_is_held_against_every_limit(ready):
    stepped = ready()
    stepped.session.set_voltage("zn", 50.0)
    assert stepped.until_idle().command["zn"] == pytest.approx(25e-6)
    stepped.session.jog("zn", 1e-6)
    assert stepped.until_idle().command["zn"] == pytest.approx(26e-6)
    with pytest.raises(OutOfLimitsError, match="0 to 130 V"):
        stepped.session.set_voltage("zn", 131.0)
    with pytest.raises(OutOfLimitsError, match="no amplifier"):
        stepped.session.set_voltage("x", 1.0)
    low = ready(CLOSE)
    with pytest.raises(RefusedError, match="move the axis instead"):
        low.session.set_voltage("zn", 1.0)


def test_the_tool_goes_off_at_a_stop_and_cannot_be_switched_on_while_motion_is_locked(ready):
    stepped = ready()
    session = stepped.session
    assert session.tool.on is False
    session.tool.switch(True)
    stepped.step()
    assert session.tool.on is True
    session.emergency_stop()
    assert session.tool.on is False
    stepped.step()
    with pytest.raises(RefusedError, match="release it first"):
        session.tool.switch(True)
    session.tool.switch(False)


def test_moves_go_no_faster_than_asked(ready):
    stepped = ready()
    begin = stepped.session.snapshot().command["zn"]
    stepped.session.go_to({"zn": begin - 10e-6}, speeds={"zn": 100e-6})
    stepped.until_idle()
    window = stepped.session.history.tail(1.0)
    speeds = np.abs(np.diff(window.command[:, 5]) / np.diff(window.device_time_s))
    assert speeds.max() == pytest.approx(100e-6, rel=1e-3)


def test_what_a_device_cannot_is_refused_with_its_name(ready, monkeypatch):
    stepped = ready()
    hooks = {name: lambda *_: None for name in Driver.__abstractmethods__}
    plain = type("Plain", (Driver,), {"name": "plain", **hooks})(ROBOT)
    monkeypatch.setattr(stepped.session._link, "driver", plain)
    session = stepped.session
    assert session.tool.on is None
    for ask in (
        lambda: session.profiles.upload(DOWN),
        lambda: session.profiles.trigger(),
        lambda: session.profiles.abort(),
        lambda: session.captures.begin(("zn",), 100.0, 10),
        lambda: session.set_voltage("zn", 1.0),
        lambda: session.tool.switch(True),
    ):
        with pytest.raises(RefusedError, match="'plain'"):
            ask()


def test_the_simulated_tool_is_off_after_it_was_opened(ready):
    driver = ready(driver=Simulator).driver
    driver.switch_tool(True)
    driver.close()
    driver.open()
    assert not driver.tool_on
