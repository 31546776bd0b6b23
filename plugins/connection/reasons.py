"""Why something cannot be done now, in a clause; None where it can. Free of Qt."""

from rotemina.app.motion.state import Connection, SessionState
from rotemina.drivers.abilities import Homer, Parameterised
from rotemina.drivers.driver import Driver
from rotemina.drivers.samples import DeviceState
from rotemina.sim.kinematics.keep_out import KeepOutZone

_STEADY = (DeviceState.IDLE, DeviceState.FAULT, DeviceState.CLOSED)


def without_device(state: SessionState) -> str | None:
    """Why nothing can be asked of a device."""
    if state.connection is Connection.CONNECTING:
        return "it is still connecting"
    return None if state.connection is Connection.CONNECTED else "not connected; connect first"


def in_motion(state: SessionState) -> str | None:
    """Why nothing can be begun that needs a machine at rest."""
    if state.activity in _STEADY and not state.queued:
        return None
    return "the machine is still moving; stop it or wait"


def against_connecting(state: SessionState, *, same: bool) -> str | None:
    """Why not connect; ``same`` is whether it would be the device in use, with its settings."""
    if state.connection is Connection.CONNECTING:
        return "it is still connecting"
    if same and state.connection is Connection.CONNECTED:
        return "it is connected with these settings"
    return in_motion(state)


def against_disconnecting(state: SessionState) -> str | None:
    """Why not disconnect."""
    busy = state.connection in (Connection.CONNECTED, Connection.CONNECTING)
    return None if busy else "nothing is connected"


def against_reconnecting(state: SessionState) -> str | None:
    """Why not connect once more."""
    if state.connection is Connection.CONNECTING:
        return "it is still connecting"
    return "it is connected" if state.connection is Connection.CONNECTED else None


def against_clearing(state: SessionState) -> str | None:
    """Why not acknowledge a fault."""
    if (why := without_device(state)) is not None:
        return why
    return None if state.fault is not None else "there is no fault"


def against_homing(state: SessionState, driver: Driver) -> str | None:
    """Why not look for limit switches."""
    if not isinstance(driver, Homer) or not driver.homing_axes:
        return f"{driver.name} has no switches to be found"
    if (why := without_device(state)) is not None:
        return why
    if state.latched is not None:
        return f"{state.latched} is latched; release it first"
    if state.fault is not None:
        return "there is a fault; clear it first"
    if state.silent_s > 0.0:
        return "the device does not answer"
    return in_motion(state)


def against_confirming(state: SessionState) -> str | None:
    """Why not confirm a position that is distrusted since a connection was lost."""
    if (why := without_device(state)) is not None:
        return why
    if state.latched is not None:
        return f"{state.latched} is latched; release it first"
    if not state.position_known:
        return "the position is not known; home first"
    other = state.fault is not None or state.silent_s > 0.0 or bool(state.differences)
    if state.locked is None or other:
        return "no lost connection makes the position doubtful"
    return None


def against_going_back(state: SessionState, *, undoable: bool) -> str | None:
    """Why not take back the latest move."""
    if state.locked is not None:
        return state.locked
    if not undoable:
        return "there is no move to take back"
    return in_motion(state)


def against_writing(state: SessionState, driver: Driver) -> str | None:
    """Why not write the robot file's parameters into the device."""
    if not isinstance(driver, Parameterised):
        return f"{driver.name} keeps no parameters"
    if (why := without_device(state)) is not None:
        return why
    if not state.differences:
        return "the device's parameters are those of the robot file, or accepted"
    return in_motion(state)


def against_teaching(state: SessionState, zone: KeepOutZone | None) -> str | None:
    """Why not put the tip's floor where the tip is."""
    if zone is None:
        return "this robot has no tip that a floor could hold"
    return state.locked if state.locked is not None else in_motion(state)


def against_removing(zone: KeepOutZone | None) -> str | None:
    """Why not take the tip's floor away."""
    if zone is None:
        return "this robot has no tip that a floor could hold"
    return None if zone.low > float("-inf") else "there is no floor"
