"""Reasons why an action is unavailable.

Each function returns the reason as a clause, or None if the action is available.
"""

from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.app.workbench import is_answering, is_reported_moving
from rotemina.drivers.abilities import (
    AxisHomer,
    ParameterStore,
    VoltageOutput,
)
from rotemina.drivers.contract import DeviceState, Driver
from rotemina.plugins.connection import tr
from rotemina.sim.kinematics import KeepOutZone

_RESTING_STATES = (DeviceState.IDLE, DeviceState.FAULT, DeviceState.CLOSED)


def find_device_objection(state: SessionState) -> str | None:
    """Return why no device can carry out a command."""
    if state.connection is ConnectionState.CONNECTING:
        return tr("the connection is being opened")
    return (
        None
        if state.connection is ConnectionState.CONNECTED
        else tr("not connected; connect first")
    )


def find_rest_objection(state: SessionState) -> str | None:
    """Return why an action cannot begin that requires the machine to be at rest."""
    if state.activity in _RESTING_STATES and not state.queued:
        return None
    return tr("the machine is still moving; stop it or wait")


def find_connect_objection(state: SessionState, *, is_in_use: bool) -> str | None:
    """Return why the chosen device cannot be connected.

    ``is_in_use`` says whether it is the current device with the current settings. Another device
    is refused only while the current device reports motion.
    """
    if is_in_use and state.connection is ConnectionState.CONNECTING:
        return tr("the connection is being opened")
    if is_in_use and is_answering(state):
        return tr("already connected with these settings")
    return tr("the machine is still moving; stop it or wait") if is_reported_moving(state) else None


def find_disconnect_objection(state: SessionState) -> str | None:
    """Return why the device cannot be disconnected."""
    has_connection = state.connection in (ConnectionState.CONNECTED, ConnectionState.CONNECTING)
    return None if has_connection else tr("nothing is connected")


def find_reconnect_objection(state: SessionState) -> str | None:
    """Return why the current device cannot be connected again."""
    if state.connection is ConnectionState.CONNECTING:
        return tr("the connection is being opened")
    return tr("already connected") if state.connection is ConnectionState.CONNECTED else None


def find_clear_objection(state: SessionState) -> str | None:
    """Return why no fault can be acknowledged."""
    if (objection := find_device_objection(state)) is not None:
        return objection
    return None if state.fault is not None else tr("there is no fault")


def find_homing_objection(state: SessionState, driver: Driver) -> str | None:
    """Return why the axes cannot be homed to their limit switches."""
    if not isinstance(driver, AxisHomer) or not driver.homing_axes:
        return tr("{name} has no limit switches").format(name=driver.name)
    if (objection := find_device_objection(state)) is not None:
        return objection
    if state.latch_reason is not None:
        return tr("{latched} is locked; release it first").format(latched=state.latch_reason)
    if state.fault is not None:
        return tr("there is a fault; clear it first")
    if state.silent_s > 0.0:
        return tr("the device does not answer")
    return find_rest_objection(state)


def find_confirm_objection(state: SessionState) -> str | None:
    """Return why there is no position that the operator could confirm after a lost connection."""
    if (objection := find_device_objection(state)) is not None:
        return objection
    if state.latch_reason is not None:
        return tr("{latched} is locked; release it first").format(latched=state.latch_reason)
    if not state.position_known:
        return tr("the position is unknown; home first")
    if state.doubt is None:
        return tr("the position is certain: no connection was lost")
    # Any other problem also locks motion, and must be solved first.
    if state.fault is not None:
        return tr("there is a fault; clear it first")
    if state.silent_s > 0.0:
        return tr("the device does not answer")
    if state.differences:
        return tr("the parameters differ from the robot file; write or accept them first")
    return None


def find_undo_objection(state: SessionState, *, undoable: bool) -> str | None:
    """Return why the latest move cannot be undone."""
    if state.lock_reason is not None:
        return state.lock_reason
    if not undoable:
        return tr("there is no previous position")
    return find_rest_objection(state)


def find_write_objection(state: SessionState, driver: Driver) -> str | None:
    """Return why the parameters of the robot file cannot be written to the device."""
    if not isinstance(driver, ParameterStore):
        return tr("{name} stores no parameters").format(name=driver.name)
    if (objection := find_device_objection(state)) is not None:
        return objection
    if not state.differences:
        return tr("the parameters match the robot file or are accepted")
    return find_rest_objection(state)


def find_voltage_objection(state: SessionState, driver: Driver) -> str | None:
    """Return why the voltage of an amplifier cannot be set."""
    if not isinstance(driver, VoltageOutput):
        return tr("{name} cannot set a voltage").format(name=driver.name)
    return state.lock_reason if state.lock_reason is not None else find_rest_objection(state)


def find_teach_objection(state: SessionState, zone: KeepOutZone | None) -> str | None:
    """Return why the floor cannot be set at the current height of the tip."""
    if zone is None:
        return tr("this robot has no tip for a floor to limit")
    return state.lock_reason if state.lock_reason is not None else find_rest_objection(state)


def find_removal_objection(
    zone: KeepOutZone | None, state: SessionState | None = None
) -> str | None:
    """Return why the floor of the tip cannot be removed.

    Without a state, check only whether there is a floor.
    """
    if zone is None:
        return tr("this robot has no tip for a floor to limit")
    if zone.floor == float("-inf"):
        return tr("there is no floor")
    if state is None or state.lock_reason is not None:
        return None if state is None else state.lock_reason
    return find_rest_objection(state)
