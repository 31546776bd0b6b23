"""What every public method of session and operation may do while an emergency stop is latched.

A method that is in no list fails here: whoever adds one says what holds for it.
"""

import pytest

from rotemina.app.motion.backlash import Approach
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.operation import Operation
from rotemina.app.motion.penetration.parameters import PenetrationParameters
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
    "move_by": lambda session: session.move_by({"x": 1e-3}),
    "move_velocity": lambda session: session.move_velocity({"x": 1e-3}),
    "go_safely": lambda session: session.go_safely({"x": 0.03}),
    "undo": lambda session: session.undo(),
    "home": lambda session: session.home(),
    "play": lambda session: session.play(PATH),
    "set_voltage": lambda session: session.set_voltage("zn", 70.0),
    "profiles.upload": lambda session: session.profiles.upload(DOWN),
    "profiles.trigger": lambda session: session.profiles.trigger(),
    "service.set_effects": lambda session: session.service.set_effects([]),
    "tool.switch": lambda session: session.tool.switch(True),
    "reservations.reserve": lambda session: session.reservations.reserve("somebody"),
    "reservations.check": lambda session: session.reservations.check("somebody"),
    "bounds.teach_floor": lambda session: session.bounds.teach_floor(),
    "bounds.clear_floor": lambda session: session.bounds.clear_floor(),
    "backlash.use": lambda session: session.backlash.use("x", Approach(1e-5, rising=True)),
    "ranges.narrow": lambda session: session.ranges.narrow("x", 0.01, 0.05),
    "ranges.restore": lambda session: session.ranges.restore("x"),
}
#: Refused as well, tested where what they need is at hand.
REFUSED_ELSEWHERE = {
    "inverses.apply",
    "inverses.remove",
    "loops.apply",
    "loops.remove",
    "service.write_parameters",
    "service.clear_fault",
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
    "profiles.abort": lambda session: session.profiles.abort(),
    "at_rest": lambda session: session.at_rest,
    "dismiss_stop": lambda session: session.dismiss_stop(),
    "is_untouched_since_stop": lambda session: session.is_untouched_since_stop,
    "check_play": lambda session: session.check_play(PATH),
    "tip_path": lambda session: session.tip_path(PATH),
    "bar": lambda session: session.bar("a replay"),
    "inverses.exceedance": lambda session: session.inverses.exceedance("zn"),
    "captures.begin": lambda session: session.captures.begin(["zn"], 1000.0, 10),
    "captures.collected": lambda session: session.captures.collected(),
    "profiles.check_thrust": lambda session: session.profiles.check_thrust(
        "zn", (30e-6, 20e-6), 1e-4
    ),
    "inverses.applied": lambda session: session.inverses.applied,
    "backlash.applied": lambda session: session.backlash.applied,
    "backlash.forget": lambda session: session.backlash.forget(),
    "backlash.taken_up": lambda session: session.backlash.taken_up("x"),
    "backlash.ways": lambda session: session.backlash.ways([{"x": 0.0}]),
    "ranges.narrowed": lambda session: session.ranges.narrowed,
    "ranges.of": lambda session: session.ranges.of("zn"),
    "ranges.begin_with": lambda session: session.ranges.begin_with({}),
    "inverses.ends": lambda session: session.inverses.ends,
    "inverses.live": lambda session: session.inverses.live,
    "confirm_position": lambda session: session.confirm_position(),
    "connect": lambda session: session.connect(),
    "corrections": lambda session: session.corrections,
    "disconnect": let_go,
    "service.effects": lambda session: session.service.effects,
    "emergency_stop": lambda session: session.emergency_stop("once more"),
    "epoch": lambda session: session.epoch,
    "reservations.held_by": lambda session: session.reservations.held_by("somebody"),
    "bounds.keep_out": lambda session: session.bounds.keep_out,
    "bounds.tip": lambda session: session.bounds.tip(session.snapshot()),
    "inverses.check": lambda session: session.inverses.check({"zn": 0.0}),
    "inverses.forget": lambda session: session.inverses.forget(),
    "inverses.sent": lambda session: session.inverses.sent(session.driver.accept(PATH)),
    "labels": lambda session: session.labels,
    "loops.forget": lambda session: session.loops.forget(),
    "memory": lambda session: session.memory,
    "model": lambda session: session.model,
    "loops.unavailable": lambda session: session.loops.unavailable,
    "note_contact": lambda session: session.note_contact("a cell"),
    "permit": lambda session: session.permit(),
    "reported": lambda session: session.reported,
    "reconnect": let_go,
    "loops.applied": lambda session: session.loops.applied,
    "loops.limited": lambda session: session.loops.limited,
    "run_once": lambda session: session.run_once(),
    "reservations.set_free": lambda session: session.reservations.set_free("somebody"),
    "setpoint_period_s": lambda session: session.setpoint_period_s,
    "service.show": lambda session: session.service.show(0, "latched"),
    "snapshot": lambda session: session.snapshot(),
    "standing": lambda session: session.standing,
    "stop": lambda session: session.stop(),
    "stop_asked_s": lambda session: session.stop_asked_s,
    "subscribe": lambda session: session.subscribe(told),
    "reservations.take_over": lambda session: session.reservations.take_over(["x"], "somebody"),
    "tap": lambda session: session.tap(told),
    "tool.on": lambda session: session.tool.on,
    "undoable": lambda session: session.undoable,
    "use": exchanged,
    "use_model": lambda session: session.use_model(session.model),
}
#: Harmless as well, but not on a session that a test steps or on this device; the latch's end.
HARMLESS_ELSEWHERE = {"service.accept_parameters", "close", "release", "start"}
#: No methods of the session's: the device, who shows it, and what was read.
HELD = {"driver", "history", "pulse", "robot", "screen"}
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
    "keep_penetration",
    "recording",
    "recordings",
    "start",
    "start_recording",
    "step",
    "stop_recording",
    "use_scales",
}


def public(thing):
    return {name for name in dir(thing) if not name.startswith("_")}


def stands(stepped):
    before = dict(stepped.session.snapshot().command)
    stepped.step(0.02, 20)
    return dict(stepped.session.snapshot().command) == before


def test_every_public_method_of_session_and_parts_is_in_a_list(stepped):
    session = stepped.session
    own = public(session) - PARTS - HELD
    of_parts = {f"{part}.{name}" for part in PARTS for name in public(getattr(session, part))}
    assert own | of_parts == REFUSED.keys() | (
        REFUSED_ELSEWHERE | HARMLESS.keys() | HARMLESS_ELSEWHERE
    )
    assert public(Operation) == OPERATION_REFUSED | OPERATION_HARMLESS


@pytest.mark.parametrize("name", REFUSED)
def test_while_latched_it_is_refused_and_nothing_moves(stepped, name):
    stepped.session.go_to({"x": REST + 1e-4})  # so that there is a move to take back
    stepped.until_idle()
    stepped.session.emergency_stop("the operator")
    stepped.step(0.02, 3)
    with pytest.raises(InputError, match="active; release it first"):
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
    assert session.tool.on is False
    assert session.snapshot().latched
    with pytest.raises(InputError, match="release it first"):
        session.go_to({"x": 0.03})


def test_a_fault_is_not_cleared_while_latched(stepped):
    stepped.driver._fault = "something broke"
    stepped.step(0.02, 3)
    stepped.session.emergency_stop()
    with pytest.raises(RefusedError, match="release it first"):
        stepped.session.service.clear_fault()
    stepped.step(0.02, 3)
    assert stepped.session.snapshot().activity is DeviceState.FAULT
    stepped.session.release()
    stepped.session.service.clear_fault()
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
    with pytest.raises(InputError, match="release it first"):
        session.go_to({"x": 0.03})


@pytest.mark.parametrize("name", sorted(OPERATION_REFUSED))
def test_while_latched_the_operation_refuses_it(stepped, tmp_path, name):
    operation = Operation(stepped.session, tmp_path, tmp_path, clock=stepped.clock)
    stepped.session.emergency_stop()
    stepped.step(0.02, 3)
    given = (PenetrationParameters(),) if name in ("arm_penetration", "prepare_penetration") else ()
    with pytest.raises(
        InputError, match="release it first" if name != "press_penetration" else "not armed"
    ):
        getattr(operation, name)(*given)
    assert stands(stepped)
    operation.close()
