"""Behaviour of every public method of session and operation while an emergency stop is latched.

A method that is in no list fails here, so a new method must be added to one of them.
"""

import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.penetration import PenetrationParameters
from rotemina.app.motion.session import OneSidedApproach
from rotemina.app.motion.state import ConnectionState
from rotemina.app.operation import OperatorControl
from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.drivers.contract import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap

REST = 0.0275
PATH_AT_REST = Record.from_signals([0.0, 1.0], {("x", Tap.CMD): [REST, REST]}, {"x": "m"})
DOWN = MotionProfile("zn", (ProfileSegment(0.02, 0.0, -60e-6, 40e-6),))

#: Refused: they move something, switch something on, or change a protection.
REFUSED = {
    "go_to": lambda session: session.go_to({"x": 0.03}),
    "jog": lambda session: session.jog("x", 1e-3),
    "move_by": lambda session: session.move_by({"x": 1e-3}),
    "move_velocity": lambda session: session.move_velocity({"x": 1e-3}),
    "go_safely": lambda session: session.go_safely({"x": 0.03}),
    "undo": lambda session: session.undo(),
    "home": lambda session: session.home(),
    "play": lambda session: session.play(PATH_AT_REST),
    "set_voltage": lambda session: session.set_voltage("zn", 70.0),
    "profiles.upload": lambda session: session.profiles.upload(DOWN),
    "profiles.trigger": lambda session: session.profiles.trigger(),
    "service.set_effects": lambda session: session.service.set_effects([]),
    "tool.switch": lambda session: session.tool.switch(True),
    "reservations.reserve": lambda session: session.reservations.reserve("somebody"),
    "reservations.check": lambda session: session.reservations.check("somebody"),
    "bounds.teach_floor": lambda session: session.bounds.teach_floor(),
    "bounds.clear_floor": lambda session: session.bounds.clear_floor(),
    "backlash.set_approach": lambda session: session.backlash.set_approach(
        "x", OneSidedApproach(1e-5, rising=True)
    ),
    "ranges.narrow": lambda session: session.ranges.narrow("x", 0.01, 0.05),
    "ranges.restore": lambda session: session.ranges.restore("x"),
}
#: Also refused, but tested elsewhere, with the devices that they need.
REFUSED_ELSEWHERE = {
    "inverses.apply",
    "inverses.remove",
    "loops.apply",
    "loops.remove",
    "service.write_parameters",
    "service.clear_fault",
}


def disconnect_and_reconnect(session):
    session.disconnect()
    session.run_once()
    session.reconnect()
    session.run_once()


def exchange_driver(session):
    driver = session.driver
    session.use_driver(type(driver)(session.robot, clock=driver.clock))
    session.run_once()


def ignore_events(*_):
    pass


#: They stop, disconnect or read: they move nothing, and a latch never refuses them.
HARMLESS = {
    "profiles.abort": lambda session: session.profiles.abort(),
    "at_rest": lambda session: session.at_rest,
    "dismiss_stop": lambda session: session.dismiss_stop(),
    "is_untouched_since_stop": lambda session: session.is_untouched_since_stop,
    "check_play": lambda session: session.check_play(PATH_AT_REST),
    "tip_path": lambda session: session.tip_path(PATH_AT_REST),
    "bar_motion": lambda session: session.bar_motion("a replay"),
    "inverses.find_exceedance": lambda session: session.inverses.find_exceedance("zn"),
    "captures.begin": lambda session: session.captures.begin(["zn"], 1000.0, 10),
    "captures.collect": lambda session: session.captures.collect(),
    "profiles.check_thrust": lambda session: session.profiles.check_thrust(
        "zn", (30e-6, 20e-6), 1e-4
    ),
    "inverses.applied": lambda session: session.inverses.applied,
    "backlash.applied": lambda session: session.backlash.applied,
    "backlash.clear": lambda session: session.backlash.clear(),
    "backlash.is_taken_up": lambda session: session.backlash.is_taken_up("x"),
    "backlash.add_approaches": lambda session: session.backlash.add_approaches([{"x": 0.0}]),
    "ranges.narrowed_ranges": lambda session: session.ranges.narrowed_ranges,
    "ranges.find_range": lambda session: session.ranges.find_range("zn"),
    "ranges.set_initial_ranges": lambda session: session.ranges.set_initial_ranges({}),
    "inverses.position_limits": lambda session: session.inverses.position_limits,
    "inverses.is_applied_per_tick": lambda session: session.inverses.is_applied_per_tick,
    "confirm_position": lambda session: session.confirm_position(),
    "connect": lambda session: session.connect(),
    "corrections": lambda session: session.corrections,
    "disconnect": disconnect_and_reconnect,
    "service.effects": lambda session: session.service.effects,
    "emergency_stop": lambda session: session.emergency_stop("once more"),
    "epoch": lambda session: session.epoch,
    "reservations.is_reserved_by": lambda session: session.reservations.is_reserved_by("somebody"),
    "bounds.keep_out": lambda session: session.bounds.keep_out,
    "bounds.compute_tip": lambda session: session.bounds.compute_tip(session.snapshot()),
    "inverses.check_targets": lambda session: session.inverses.check_targets({"zn": 0.0}),
    "inverses.forget": lambda session: session.inverses.forget(),
    "inverses.convert_trajectory": lambda session: session.inverses.convert_trajectory(
        session.driver.accept(PATH_AT_REST)
    ),
    "labels": lambda session: session.labels,
    "loops.forget": lambda session: session.loops.forget(),
    "memory": lambda session: session.memory,
    "model": lambda session: session.model,
    "loops.unavailable_reason": lambda session: session.loops.unavailable_reason,
    "note_contact": lambda session: session.note_contact("a cell"),
    "permit": lambda session: session.permit(),
    "reported": lambda session: session.reported,
    "reconnect": disconnect_and_reconnect,
    "loops.applied": lambda session: session.loops.applied,
    "loops.limited_axes": lambda session: session.loops.limited_axes,
    "run_once": lambda session: session.run_once(),
    "reservations.end_reservations": lambda session: session.reservations.end_reservations(
        "somebody"
    ),
    "setpoint_period_s": lambda session: session.setpoint_period_s,
    "service.show_text": lambda session: session.service.show_text(0, "latched"),
    "snapshot": lambda session: session.snapshot(),
    "path_check_basis": lambda session: session.path_check_basis,
    "stop": lambda session: session.stop(),
    "stop_requested_s": lambda session: session.stop_requested_s,
    "subscribe": lambda session: session.subscribe(ignore_events),
    "reservations.take_over": lambda session: session.reservations.take_over(["x"], "somebody"),
    "tap": lambda session: session.tap(ignore_events),
    "tool.is_on": lambda session: session.tool.is_on,
    "can_undo": lambda session: session.can_undo,
    "use_driver": exchange_driver,
    "use_model": lambda session: session.use_model(session.model),
}
#: Also harmless, but not possible with this session or device; release ends the latch.
HARMLESS_ELSEWHERE = {"service.accept_parameters", "close", "release", "start"}
#: Attributes of the session that are not its methods.
ATTRIBUTES = {"driver", "history", "pulse", "robot", "screen_heartbeat"}
PARTS = {
    "backlash",
    "bounds",
    "captures",
    "inverses",
    "loops",
    "profiles",
    "ranges",
    "reservations",
    "service",
    "tool",
}
OPERATION_REFUSED = {
    "arm_penetration",
    "press_penetration",
    "prepare_penetration",
    "recentre",
    "toggle_tool",
}
OPERATION_HARMLESS = {
    "close",
    "save_penetration_parameters",
    "recording",
    "recordings",
    "start",
    "start_recording",
    "step",
    "stop_recording",
    "use_scales",
}


def list_public_names(instance):
    return {name for name in dir(instance) if not name.startswith("_")}


def holds_position(harness):
    before = dict(harness.session.snapshot().command)
    harness.step(0.02, 20)
    return dict(harness.session.snapshot().command) == before


def test_every_public_method_of_session_and_parts_is_in_a_list(harness):
    session = harness.session
    session_names = list_public_names(session) - PARTS - ATTRIBUTES
    part_names = {
        f"{part}.{name}" for part in PARTS for name in list_public_names(getattr(session, part))
    }
    assert session_names | part_names == REFUSED.keys() | (
        REFUSED_ELSEWHERE | HARMLESS.keys() | HARMLESS_ELSEWHERE
    )
    assert list_public_names(OperatorControl) == OPERATION_REFUSED | OPERATION_HARMLESS


@pytest.mark.parametrize("name", REFUSED)
def test_while_latched_these_methods_are_refused_and_nothing_moves(harness, name):
    harness.session.go_to({"x": REST + 1e-4})  # so that there is a move to undo
    harness.step_until_idle()
    harness.session.emergency_stop("the operator")
    harness.step(0.02, 3)
    with pytest.raises(InputError, match="active; release it first"):
        REFUSED[name](harness.session)
    assert holds_position(harness)


@pytest.mark.parametrize("name", HARMLESS)
def test_while_latched_these_methods_are_allowed_and_start_nothing(harness, name):
    session = harness.session
    session.go_to({"x": 0.05})
    harness.step(0.02, 10)
    session.emergency_stop("the operator")
    harness.step_until_idle()
    harness.step(0.02, 10)
    HARMLESS[name](session)
    assert holds_position(harness)
    assert session.tool.is_on is False
    assert session.snapshot().latch_reason
    with pytest.raises(InputError, match="release it first"):
        session.go_to({"x": 0.03})


def test_a_fault_is_not_cleared_while_latched(harness):
    harness.driver._fault = "something broke"
    harness.step(0.02, 3)
    harness.session.emergency_stop()
    with pytest.raises(RequestRefusedError, match="release it first"):
        harness.session.service.clear_fault()
    harness.step(0.02, 3)
    assert harness.session.snapshot().activity is DeviceState.FAULT
    harness.session.release()
    harness.session.service.clear_fault()
    harness.step(0.02, 3)
    assert harness.session.snapshot().fault is None


def test_while_latched_the_device_can_be_reconnected(harness):
    session = harness.session
    session.emergency_stop()
    session.disconnect()
    harness.step()
    assert session.snapshot().connection is ConnectionState.DISCONNECTED
    session.reconnect()
    harness.step(0.02, 3)
    assert session.snapshot().connection is ConnectionState.CONNECTED
    assert session.snapshot().latch_reason
    with pytest.raises(InputError, match="release it first"):
        session.go_to({"x": 0.03})


@pytest.mark.parametrize("name", sorted(OPERATION_REFUSED))
def test_while_latched_the_operation_refuses_these_methods(harness, tmp_path, name):
    operation = OperatorControl(harness.session, tmp_path, tmp_path, clock=harness.clock)
    harness.session.emergency_stop()
    harness.step(0.02, 3)
    args = (PenetrationParameters(),) if name in ("arm_penetration", "prepare_penetration") else ()
    with pytest.raises(
        InputError, match="release it first" if name != "press_penetration" else "not armed"
    ):
        getattr(operation, name)(*args)
    assert holds_position(harness)
    operation.close()
