"""Behaviour of every public method of session and operation while an emergency stop is latched.

A method that is in no list fails here, so a new method must be added to one of them. Properties
only read.
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
    assert session.snapshot().connection is ConnectionState.DISCONNECTED
    session.reconnect()
    session.run_once()
    assert session.snapshot().connection is ConnectionState.CONNECTED


def exchange_driver(session):
    driver = session.driver
    session.use_driver(type(driver)(session.robot, clock=driver.clock))
    session.run_once()


def ignore_events(*_):
    pass


#: They stop, disconnect or read: they move nothing, and a latch never refuses them.
HARMLESS = {
    "profiles.abort": lambda session: session.profiles.abort(),
    "dismiss_stop": lambda session: session.dismiss_stop(),
    "check_play": lambda session: session.check_play(PATH_AT_REST),
    "tip_path": lambda session: session.tip_path(PATH_AT_REST),
    "bar_motion": lambda session: session.bar_motion("a replay"),
    "inverses.find_exceedance": lambda session: session.inverses.find_exceedance("zn"),
    "captures.begin": lambda session: session.captures.begin(["zn"], 1000.0, 10),
    "captures.collect": lambda session: session.captures.collect(),
    "profiles.check_thrust": lambda session: session.profiles.check_thrust(
        "zn", (30e-6, 20e-6), 1e-4
    ),
    "backlash.applied": lambda session: session.backlash.applied,
    "backlash.clear": lambda session: session.backlash.clear(),
    "backlash.is_taken_up": lambda session: session.backlash.is_taken_up("x"),
    "backlash.add_approaches": lambda session: session.backlash.add_approaches([{"x": 0.0}]),
    "ranges.find_range": lambda session: session.ranges.find_range("zn"),
    "ranges.set_initial_ranges": lambda session: session.ranges.set_initial_ranges({}),
    "confirm_position": lambda session: session.confirm_position(),
    "connect": lambda session: session.connect(),
    "disconnect": disconnect_and_reconnect,
    "emergency_stop": lambda session: session.emergency_stop("once more"),
    "reservations.is_reserved_by": lambda session: session.reservations.is_reserved_by("somebody"),
    "bounds.compute_tip": lambda session: session.bounds.compute_tip(session.snapshot()),
    "inverses.check_targets": lambda session: session.inverses.check_targets({"zn": 0.0}),
    "inverses.forget": lambda session: session.inverses.forget(),
    "inverses.convert_trajectory": lambda session: session.inverses.convert_trajectory(
        session.driver.accept(PATH_AT_REST)
    ),
    "loops.forget": lambda session: session.loops.forget(),
    "note_contact": lambda session: session.note_contact("a cell"),
    "permit": lambda session: session.permit(),
    "reconnect": disconnect_and_reconnect,
    "run_once": lambda session: session.run_once(),
    "reservations.end_reservations": lambda session: session.reservations.end_reservations(
        "somebody"
    ),
    "service.show_text": lambda session: session.service.show_text(0, "latched"),
    "snapshot": lambda session: session.snapshot(),
    "stop": lambda session: session.stop(),
    "subscribe": lambda session: session.subscribe(ignore_events),
    "reservations.take_over": lambda session: session.reservations.take_over(["x"], "somebody"),
    "tap": lambda session: session.tap(ignore_events),
    "use_driver": exchange_driver,
    "use_model": lambda session: session.use_model(session.model),
}
#: Also harmless, but not possible with this session or device; release ends the latch.
HARMLESS_ELSEWHERE = {"service.accept_parameters", "close", "release", "start"}
#: Attributes of the session that are not its methods.
ATTRIBUTES = {"history", "pulse", "robot", "screen_heartbeat"}
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
    "start",
    "start_recording",
    "step",
    "stop_recording",
    "use_scales",
}


def list_public_names(instance):
    kind = instance if isinstance(instance, type) else type(instance)
    return {
        name
        for name in dir(instance)
        if not name.startswith("_") and not isinstance(getattr(kind, name, None), property)
    }


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


@pytest.fixture
def latched(harness):
    """A session that was stopped and locked during a move, and has a move to undo."""
    harness.session.go_to({"x": REST + 1e-4})
    harness.step_until_idle()
    harness.session.go_to({"x": 0.05})
    harness.step(0.02, 10)
    harness.session.emergency_stop("the operator")
    harness.step_until_idle()
    harness.step(0.02, 10)
    return harness


def test_while_latched_these_methods_are_refused_and_nothing_moves(latched):
    for name, request in REFUSED.items():
        with pytest.raises(InputError, match="active; release it first"):
            request(latched.session)
        assert latched.holds_position(), name


def test_while_latched_these_methods_are_allowed_and_start_nothing(latched):
    session = latched.session
    for name, request in HARMLESS.items():
        request(session)
        assert latched.holds_position(), name
        assert session.tool.is_on is False, name
        assert session.snapshot().latch_reason, name
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


def test_while_latched_the_operation_refuses_these_methods(latched, tmp_path):
    operation = OperatorControl(latched.session, tmp_path, tmp_path, clock=latched.clock)
    for name in sorted(OPERATION_REFUSED):
        takes_parameters = name in ("arm_penetration", "prepare_penetration")
        message = "not armed" if name == "press_penetration" else "release it first"
        with pytest.raises(InputError, match=message):
            getattr(operation, name)(*[PenetrationParameters()] * takes_parameters)
        assert latched.holds_position(), name
    operation.close()
