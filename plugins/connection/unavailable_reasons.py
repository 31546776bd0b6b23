"""Reasons why an action is unavailable, as a clause; None if it is available."""

from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.shell.operator_requests import is_answering, is_seen_moving
from rotemina.drivers.abilities import Homer, Parameterised, VoltageOutput
from rotemina.drivers.driver import Driver
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.connection import tr
from rotemina.sim.kinematics.keep_out import KeepOutZone

_STEADY = (DeviceState.IDLE, DeviceState.FAULT, DeviceState.CLOSED)


def without_device(state: SessionState) -> str | None:
    """Why nothing can be asked of a device."""
    if state.connection is Connection.CONNECTING:
        return tr("the connection is being opened")
    return None if state.connection is Connection.CONNECTED else tr("not connected; connect first")


def in_motion(state: SessionState) -> str | None:
    """Why nothing can be begun that needs a machine at rest."""
    if state.activity in _STEADY and not state.queued:
        return None
    return tr("the machine is still moving; stop it or wait")


def against_connecting(state: SessionState, *, same: bool) -> str | None:
    """Why not connect; ``same`` is whether it would be the device in use, with its settings.

    Only motion that the present device reports keeps anybody from another one.
    """
    if same and state.connection is Connection.CONNECTING:
        return tr("the connection is being opened")
    if same and is_answering(state):
        return tr("already connected with these settings")
    return tr("the machine is still moving; stop it or wait") if is_seen_moving(state) else None


def against_disconnecting(state: SessionState) -> str | None:
    """Why not disconnect."""
    busy = state.connection in (Connection.CONNECTED, Connection.CONNECTING)
    return None if busy else tr("nothing is connected")


def against_reconnecting(state: SessionState) -> str | None:
    """Why not connect again."""
    if state.connection is Connection.CONNECTING:
        return tr("the connection is being opened")
    return tr("already connected") if state.connection is Connection.CONNECTED else None


def against_clearing(state: SessionState) -> str | None:
    """Why not acknowledge a fault."""
    if (why := without_device(state)) is not None:
        return why
    return None if state.fault is not None else tr("there is no fault")


def against_homing(state: SessionState, driver: Driver) -> str | None:
    """Why not look for limit switches."""
    if not isinstance(driver, Homer) or not driver.homing_axes:
        return tr("{name} has no limit switches").format(name=driver.name)
    if (why := without_device(state)) is not None:
        return why
    if state.latched is not None:
        return tr("{latched} is locked; release it first").format(latched=state.latched)
    if state.fault is not None:
        return tr("there is a fault; clear it first")
    if state.silent_s > 0.0:
        return tr("the device does not answer")
    return in_motion(state)


def against_confirming(state: SessionState) -> str | None:
    """Why not confirm a position that is distrusted since a connection was lost."""
    if (why := without_device(state)) is not None:
        return why
    if state.latched is not None:
        return tr("{latched} is locked; release it first").format(latched=state.latched)
    if not state.position_known:
        return tr("the position is unknown; home first")
    other = state.fault is not None or state.silent_s > 0.0 or bool(state.differences)
    if state.doubt is None or other:
        return tr("the position is certain: no connection was lost")
    return None


def against_going_back(state: SessionState, *, undoable: bool) -> str | None:
    """Why not take back the latest move."""
    if state.locked is not None:
        return state.locked
    if not undoable:
        return tr("there is no previous position")
    return in_motion(state)


def against_writing(state: SessionState, driver: Driver) -> str | None:
    """Why not write the robot file's parameters into the device."""
    if not isinstance(driver, Parameterised):
        return tr("{name} stores no parameters").format(name=driver.name)
    if (why := without_device(state)) is not None:
        return why
    if not state.differences:
        return tr("the parameters match the robot file or are accepted")
    return in_motion(state)


def against_voltage(state: SessionState, driver: Driver) -> str | None:
    """Why not put out an amplifier's voltage."""
    if not isinstance(driver, VoltageOutput):
        return tr("{name} cannot set a voltage").format(name=driver.name)
    return state.locked if state.locked is not None else in_motion(state)


def against_teaching(state: SessionState, zone: KeepOutZone | None) -> str | None:
    """Why not put the tip's floor where the tip is."""
    if zone is None:
        return tr("this robot has no tip for a floor to limit")
    return state.locked if state.locked is not None else in_motion(state)


def against_removing(zone: KeepOutZone | None, state: SessionState | None = None) -> str | None:
    """Why not take the tip's floor away; without a state, whether there is one to take away."""
    if zone is None:
        return tr("this robot has no tip for a floor to limit")
    if zone.floor == float("-inf"):
        return tr("there is no floor")
    if state is None or state.locked is not None:
        return None if state is None else state.locked
    return in_motion(state)
