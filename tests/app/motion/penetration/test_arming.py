"""Arming: what must be so before anything may move, and what ends it."""

from contextlib import suppress
from dataclasses import replace

import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.penetration.parameters import PenetrationError
from rotemina.app.motion.penetration.status import Phase
from rotemina.drivers.driver import Driver
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import KeepOut
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError

ROBOT = load_robot("rotemina")


def test_what_speaks_against_arming_is_known_before_and_reserves_nothing(bench):
    bench.ready()
    assert bench.why_not() is None
    assert "the run needs 62 µm" in bench.ready(start=32e-6).why_not()
    assert bench.session.snapshot().owners == {}
    bench.session.go_to({"x": 0.03})
    bench.step()
    assert "still moving" in bench.why_not()
    bench.stepped.until_idle()
    bench.session.reservations.reserve("joystick")
    assert "joystick controls axis" in bench.why_not()
    bench.session.reservations.set_free("joystick")
    bench.ready().arm()
    bench.press().step()
    assert "a penetration is approach" in bench.why_not()


def test_it_disarms_by_itself_and_starts_no_more(bench):
    bench.ready().arm(armed_s=5.0)
    bench.step(0.1, 30)
    assert bench.penetration.status.armed_left_s == pytest.approx(2.0, abs=0.15)
    bench.step(0.1, 30)
    assert bench.phase is Phase.DISARMED
    assert bench.session.snapshot().owners == {}
    with pytest.raises(RefusedError, match="not armed; arm it first"):
        bench.press()


def test_a_stop_disarms(bench):
    bench.ready().arm()
    bench.session.stop()
    bench.step()
    assert bench.phase is Phase.DISARMED
    assert "a stop was requested" in bench.penetration.status.reason


def test_a_start_after_a_stop_that_nobody_has_seen_yet_is_refused(bench):
    bench.ready().arm()
    bench.session.stop()
    with pytest.raises(RefusedError, match="a stop was requested"):
        bench.press()


def test_nothing_starts_disarmed(bench):
    with pytest.raises(RefusedError, match="not armed"):
        bench.press()


def test_somebody_else_who_drives_is_not_pushed_aside(bench):
    bench.ready()
    bench.session.go_to({"x": 0.05}, "joystick")
    with pytest.raises(RefusedError, match="still moving"):
        bench.arm()
    bench.stepped.until_idle()
    bench.session.reservations.reserve("joystick")
    with pytest.raises(RefusedError, match="joystick controls axis"):
        bench.arm()
    assert bench.phase is Phase.DISARMED


@pytest.mark.parametrize(
    ("parameters", "error", "message"),
    [
        ({"axis": "q"}, PenetrationError, "has no axis 'q' to penetrate with"),
        ({"axis": "thx"}, PenetrationError, "rotates"),
        ({"direction": "up"}, PenetrationError, "1 µm of travel left upwards"),
        ({"approach_distance": 2e-5}, PenetrationError, "the run needs 72 µm"),
        ({"duration_s": 3e-3}, PenetrationError, "input shaping"),
        ({"duration_s": 4e-3, "shaping": "none"}, InputError, "at most 5 mm/s"),
    ],
)
def test_what_is_impossible_is_refused_when_it_is_armed(bench, parameters, error, message):
    bench.ready()
    refused = None
    with suppress(InputError):  # where there is no plan, there is nothing to ask about it
        refused = bench.why_not(**parameters)
    with pytest.raises(error, match=message) as caught:
        bench.arm(**parameters)
    assert refused in (None, str(caught.value))
    assert bench.phase is Phase.DISARMED
    bench.step()
    assert bench.session.snapshot().owners == {}


def test_a_robot_without_zn_is_refused(make_bench):
    bench = make_bench(robot="picma")
    bench.stepped.step()
    with pytest.raises(PenetrationError, match="has no axis 'zn' to penetrate with; it has p"):
        bench.arm()


def test_a_device_without_profiles_is_refused(bench, monkeypatch):
    hooks = {name: lambda *_: None for name in Driver.__abstractmethods__}
    monkeypatch.setattr(
        bench.session._link, "driver", type("Plain", (Driver,), {"name": "plain", **hooks})(ROBOT)
    )
    with pytest.raises(RefusedError, match="'plain' cannot execute profiles"):
        bench.arm()


def test_the_floor_holds_for_a_thrust_too(make_bench):
    bench = make_bench(robot=replace(ROBOT, keep_out=KeepOut(floor=10e-6)))
    bench.ready()
    with pytest.raises(OutOfLimitsError, match="its floor is 10 µm"):
        bench.arm()
    bench.arm(depth=40e-6)  # through the slow zone, at 0.6 mm/s
    assert bench.phase is Phase.ARMED
