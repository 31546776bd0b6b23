"""What every public method of session and operation may do while an emergency stop is latched.

A method that is in no list fails here: whoever adds one says what holds for it.
"""

import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.operation import Operation
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap

REST = 0.0275
PATH = Record.from_signals([0.0, 1.0], {("x", Tap.CMD): [REST, REST]}, {"x": "m"})
DOWN = Profile("zn", (ProfileSegment(0.02, 0.0, -60e-6, 40e-6),))

#: Refused: they move something, switch something on, or change what stands between the two.
REFUSED = {
    "go_to": lambda session: session.go_to({"x": 0.03}),
    "jog": lambda session: session.jog("x", 1e-3),
    "move_velocity": lambda session: session.move_velocity({"x": 1e-3}),
    "go_safely": lambda session: session.go_safely({"x": 0.03}),
    "undo": lambda session: session.undo(),
    "home": lambda session: session.home(),
    "play": lambda session: session.play(PATH),
    "set_voltage": lambda session: session.set_voltage("zn", 70.0),
    "upload_profile": lambda session: session.upload_profile(DOWN),
    "trigger_profile": lambda session: session.trigger_profile(),
    "set_effects": lambda session: session.set_effects([]),
    "switch_tool": lambda session: session.switch_tool(True),
    "reserve": lambda session: session.reserve("somebody"),
    "check_reservable": lambda session: session.check_reservable("somebody"),
    "teach_floor": lambda session: session.teach_floor(),
    "clear_floor": lambda session: session.clear_floor(),
}
#: Refused as well, tested where what they need is at hand.
REFUSED_ELSEWHERE = {
    "compensate",
    "uncompensate",
    "regulate",
    "unregulate",
    "write_parameters",
    "clear_fault",
}


def let_go(session):
    session.disconnect()
    session.run_once()
    session.reconnect()
    session.run_once()


def exchanged(session):
    driver = session.driver
    session.use(type(driver)(session.robot, clock=driver.clock))
    session.run_once()


def told(*_):
    pass


#: They stop, let go, ask or tell: nothing moves by them, and they are never refused for a latch.
HARMLESS = {
    "abort_profile": lambda session: session.abort_profile(),
    "at_rest": lambda session: session.at_rest,
    "bar": lambda session: session.bar("a replay"),
    "beyond_inverse": lambda session: session.beyond_inverse("zn"),
    "capture": lambda session: session.capture(["zn"], 1000.0, 10),
    "captured": lambda session: session.captured(),
    "check_thrust": lambda session: session.check_thrust("zn", (30e-6, 20e-6), 1e-4),
    "compensated": lambda session: session.compensated,
    "compensates_all": lambda session: session.compensates_all,
    "confirm_position": lambda session: session.confirm_position(),
    "connect": lambda session: session.connect(),
    "corrections": lambda session: session.corrections,
    "disconnect": let_go,
    "effects": lambda session: session.effects,
    "emergency_stop": lambda session: session.emergency_stop("once more"),
    "epoch": lambda session: session.epoch,
    "has_reserved": lambda session: session.has_reserved("somebody"),
    "keep_out": lambda session: session.keep_out,
    "memory": lambda session: session.memory,
    "model": lambda session: session.model,
    "no_regulation": lambda session: session.no_regulation,
    "note_contact": lambda session: session.note_contact("a cell"),
    "permit": lambda session: session.permit(),
    "reconnect": let_go,
    "regulated": lambda session: session.regulated,
    "regulation_limited": lambda session: session.regulation_limited,
    "run_once": lambda session: session.run_once(),
    "set_free": lambda session: session.set_free("somebody"),
    "setpoint_period_s": lambda session: session.setpoint_period_s,
    "show": lambda session: session.show(0, "latched"),
    "snapshot": lambda session: session.snapshot(),
    "stop": lambda session: session.stop(),
    "stop_asked_s": lambda session: session.stop_asked_s,
    "subscribe": lambda session: session.subscribe(told),
    "take_over": lambda session: session.take_over(["x"], "somebody"),
    "tap": lambda session: session.tap(told),
    "tool_on": lambda session: session.tool_on,
    "undoable": lambda session: session.undoable,
    "use": exchanged,
    "use_model": lambda session: session.use_model(session.model),
}
#: Harmless as well, but not on a session that a test steps or on this device; the latch's end.
HARMLESS_ELSEWHERE = {"accept_parameters", "close", "release", "start"}
OPERATION_REFUSED = {"arm_penetration", "press_penetration", "recentre", "toggle_tool"}
OPERATION_HARMLESS = {
    "close",
    "keep_penetration",
    "recording",
    "recordings",
    "start",
    "start_recording",
    "step",
    "stop_recording",
    "unfinished_recordings",
    "use_scales",
}


def public(kind):
    return {name for name in dir(kind) if not name.startswith("_")}


def stands(stepped):
    before = dict(stepped.session.snapshot().command)
    stepped.step(0.02, 20)
    return dict(stepped.session.snapshot().command) == before


def test_every_public_method_is_in_a_list():
    assert public(MotionSession) == REFUSED.keys() | (
        REFUSED_ELSEWHERE | HARMLESS.keys() | HARMLESS_ELSEWHERE
    )
    assert public(Operation) == OPERATION_REFUSED | OPERATION_HARMLESS


@pytest.mark.parametrize("name", REFUSED)
def test_while_latched_it_is_refused_and_nothing_moves(stepped, name):
    stepped.session.go_to({"x": REST + 1e-4})  # so that there is a move to take back
    stepped.until_idle()
    stepped.session.emergency_stop("the operator")
    stepped.step(0.02, 3)
    with pytest.raises(InputError, match="latched; release it first"):
        REFUSED[name](stepped.session)
    assert stands(stepped)


@pytest.mark.parametrize("name", HARMLESS)
def test_while_latched_it_is_not_refused_and_moves_and_switches_on_nothing(stepped, name):
    session = stepped.session
    session.go_to({"x": 0.05})
    stepped.step(0.02, 10)
    session.emergency_stop("the operator")
    stepped.until_idle()
    stepped.step(0.02, 10)
    HARMLESS[name](session)
    assert stands(stepped)
    assert session.tool_on is False
    assert session.snapshot().latched
    with pytest.raises(InputError, match="latched"):
        session.go_to({"x": 0.03})


def test_a_fault_is_not_cleared_while_latched(stepped):
    stepped.driver._fault = "something broke"
    stepped.step(0.02, 3)
    stepped.session.emergency_stop()
    with pytest.raises(RefusedError, match="latched"):
        stepped.session.clear_fault()
    stepped.step(0.02, 3)
    assert stepped.session.snapshot().activity is DeviceState.FAULT
    stepped.session.release()
    stepped.session.clear_fault()
    stepped.step(0.02, 3)
    assert stepped.session.snapshot().fault is None


def test_while_latched_one_can_let_go_of_the_device_and_connect_again(stepped):
    session = stepped.session
    session.emergency_stop()
    session.disconnect()
    stepped.step()
    assert session.snapshot().connection is Connection.DISCONNECTED
    session.reconnect()
    stepped.step(0.02, 3)
    assert session.snapshot().connection is Connection.CONNECTED
    assert session.snapshot().latched
    with pytest.raises(InputError, match="latched"):
        session.go_to({"x": 0.03})


@pytest.mark.parametrize("name", sorted(OPERATION_REFUSED))
def test_while_latched_the_operation_refuses_it(stepped, tmp_path, name):
    operation = Operation(stepped.session, tmp_path, tmp_path, clock=stepped.clock)
    stepped.session.emergency_stop()
    stepped.step(0.02, 3)
    given = (PenetrationParameters(),) if name == "arm_penetration" else ()
    with pytest.raises(InputError, match="latched" if name != "press_penetration" else "not armed"):
        getattr(operation, name)(*given)
    assert stands(stepped)
    operation.close()
