"""Arming: the conditions for it, and the events that end it."""

from contextlib import suppress
from dataclasses import replace

import pytest

from rotemina.app.errors import PenetrationError, RequestRefusedError
from rotemina.app.motion.penetration import PenetrationPhase
from rotemina.drivers.contract import Driver
from rotemina.sim.errors import InputError, OutOfLimitsError
from rotemina.sim.robot import KeepOut
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def assert_refused(bench, reason):
    """Assert that the reason is available before arming, and that arming reserves nothing."""
    owners = bench.session.snapshot().owners
    assert reason in bench.find_refusal_reason()
    with pytest.raises(InputError, match=reason):
        bench.arm()
    bench.step()
    assert bench.session.snapshot().owners == owners


def test_arming_is_refused_while_there_is_no_room_or_the_axes_are_in_use(bench):
    bench.prepare()
    assert bench.find_refusal_reason() is None
    assert_refused(bench.prepare(start=32e-6), "the run needs 62 µm")
    bench.session.go_to({"x": 0.03}, "joystick")
    bench.step()
    assert_refused(bench, "still moving")
    bench.harness.step_until_idle()
    bench.session.reservations.reserve("joystick")
    assert_refused(bench, "joystick controls axis")
    assert bench.phase is PenetrationPhase.DISARMED
    bench.session.reservations.end_reservations("joystick")
    bench.prepare().arm()
    bench.press().step()
    assert_refused(bench, "a penetration is in phase approach")


def test_it_disarms_after_its_time_and_then_does_not_start(bench):
    bench.prepare().arm(armed_s=5.0)
    bench.step(0.1, 30)
    assert bench.penetration.status.armed_remaining_s == pytest.approx(2.0, abs=0.15)
    bench.step(0.1, 30)
    assert bench.phase is PenetrationPhase.DISARMED
    assert bench.session.snapshot().owners == {}
    with pytest.raises(RequestRefusedError, match="not armed; arm it first"):
        bench.press()


def test_a_stop_disarms_even_before_it_is_processed(bench):
    bench.prepare().arm()
    bench.session.stop()
    with pytest.raises(RequestRefusedError, match="a stop was requested"):
        bench.press()
    bench.step()
    assert bench.phase is PenetrationPhase.DISARMED
    assert "a stop was requested" in bench.penetration.status.reason


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
def test_impossible_parameters_are_refused_at_arming(bench, parameters, error, message):
    bench.prepare()
    refusal_reason = None
    with suppress(InputError):  # without a plan there is no refusal reason
        refusal_reason = bench.find_refusal_reason(**parameters)
    with pytest.raises(error, match=message) as caught:
        bench.arm(**parameters)
    assert refusal_reason in (None, str(caught.value))
    assert bench.phase is PenetrationPhase.DISARMED
    bench.step()
    assert bench.session.snapshot().owners == {}


def test_a_device_without_profiles_is_refused(bench, monkeypatch):
    hooks = {name: lambda *_: None for name in Driver.__abstractmethods__}
    monkeypatch.setattr(
        bench.session._link, "driver", type("Plain", (Driver,), {"name": "plain", **hooks})(ROBOT)
    )
    with pytest.raises(RequestRefusedError, match="'plain' cannot execute profiles"):
        bench.arm()


def test_the_floor_applies_to_a_thrust_too(make_bench):
    bench = make_bench(robot=replace(ROBOT, keep_out=KeepOut(floor=10e-6)))
    bench.prepare()
    with pytest.raises(OutOfLimitsError, match="its floor is 10 µm"):
        bench.arm()
    bench.arm(depth=40e-6)  # through the slow zone at 0.6 mm/s
    assert bench.phase is PenetrationPhase.ARMED
