"""Meaning of the state word in a status report: whether axes move, and whether they may move.

Source: GRBL 1.1 (``report.c``), grblHAL (``report.c``, ``system.h``), FluidNC (``State.h``).
"""

from dataclasses import dataclass

from rotemina.drivers.gcode.grbl_reports import StatusReport
from rotemina.sim.messages import message

# Substates of Door: 0 is closed again, and 1 is open and at rest. At higher ones axes brake,
# retract or return.
_LAST_DOOR_STATE_AT_REST = 1


@dataclass(frozen=True, slots=True)
class MachineState:
    """The state of the machine according to a state word.

    Attributes
    ----------
    is_moving : bool
        Whether axes move or brake. Then a reset would lose steps.
    fault : str or None
        Reason why no motion may begin; None if motion may begin.
    position_lost : bool
        Whether steps may be lost, because the motors may have had no current or stopped abruptly.
    is_hold, is_alarm : bool
        Whether the state is a feed hold, as after a stop, or an alarm, as before homing.
    is_recognized : bool
        Whether the state word is documented.
    """

    is_moving: bool = False
    fault: str | None = None
    position_lost: bool = False
    is_hold: bool = False
    is_alarm: bool = False
    is_recognized: bool = True


_AT_REST = MachineState()
_MOVING = MachineState(is_moving=True)
_STATE_BY_WORD = {
    "Idle": _AT_REST,
    "Run": _MOVING,
    "Jog": _MOVING,
    "Home": _MOVING,
    "Alarm": MachineState(
        fault=message("engine", "the controller is locked by an alarm; clear the fault, then home"),
        position_lost=True,
        is_alarm=True,
    ),
    "Check": MachineState(
        fault=message(
            "engine", "the controller only checks G-code and moves nothing ($C); clear the fault"
        )
    ),
    "Sleep": MachineState(
        fault=message(
            "engine",
            "the controller sleeps and its motors have no current; clear the fault, then home",
        ),
        position_lost=True,
    ),
    "Tool": MachineState(
        fault=message("engine", "the controller waits for a tool change; clear the fault to end it")
    ),
    "Starting": MachineState(
        fault=message("engine", "the controller is starting; clear the fault when it is ready"),
        position_lost=True,
    ),
}
_DOOR_OPEN = message("engine", "the safety door is open; close it, then clear the fault")
_DOOR_CLOSED = message("engine", "the safety door was opened and is closed again; clear the fault")
_PAUSED = message(
    "engine",
    "the controller was paused (feed hold) by one of its buttons or by another program; clear "
    "the fault",
)


def interpret_state(status: StatusReport) -> MachineState:
    """Interpret the state word of a report and the substate after its colon."""
    if status.state == "Hold":
        # Without a substate the axes may still be braking.
        return MachineState(is_moving=status.substate != 0, fault=_PAUSED, is_hold=True)
    if status.state == "Door":
        is_moving = status.substate is None or status.substate > _LAST_DOOR_STATE_AT_REST
        return MachineState(
            is_moving=is_moving, fault=_DOOR_CLOSED if status.substate == 0 else _DOOR_OPEN
        )
    state = _STATE_BY_WORD.get(status.state)
    if state is not None:
        return state
    fault = message(
        "engine",
        "the controller reports a state that this program does not know, {state}; check the "
        "machine, then clear the fault",
    ).fill(state=repr(status.state))
    return MachineState(is_moving=True, fault=fault, is_recognized=False)
