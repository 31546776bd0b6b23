"""What the state word of a report means: whether axes move, and what forbids a new move.

Source: GRBL 1.1 (``report.c``), grblHAL (``report.c``, ``system.h``), FluidNC (``State.h``).
"""

from dataclasses import dataclass

from rotemina.drivers.gcode.grbl_reports import Status
from rotemina.sim.messages import message

# Door: 0 closed again, 1 open and at rest; above, the axes brake, retract, or return.
_LAST_DOOR_STATE_AT_REST = 1


@dataclass(frozen=True, slots=True)
class MachineState:
    """What a state word says of the machine.

    Attributes
    ----------
    moving : bool
        Whether axes move, or still brake: a reset would lose steps now.
    fault : str or None
        Why nothing may begin to move.
    position_lost : bool
        Whether the motors may have been without current, or the axes halted abruptly.
    holds, alarm : bool
        Whether it is a feed hold, which a stop brings about, or an alarm, which a controller has
        until it is homed.
    recognized : bool
        Whether the word is one that the firmware documents.
    """

    moving: bool = False
    fault: str | None = None
    position_lost: bool = False
    holds: bool = False
    alarm: bool = False
    recognized: bool = True


_REST = MachineState()
_MOVING = MachineState(moving=True)
_BY_WORD = {
    "Idle": _REST,
    "Run": _MOVING,
    "Jog": _MOVING,
    "Home": _MOVING,
    "Alarm": MachineState(
        fault=message("engine", "the controller is locked by an alarm; clear the fault, then home"),
        position_lost=True,
        alarm=True,
    ),
    "Check": MachineState(
        fault=message(
            "engine", "the controller only checks G-code and moves nothing ($C); clear the fault"
        )
    ),
    "Sleep": MachineState(
        fault=message(
            "engine",
            "the controller sleeps, its motors are without current; clear the fault, then home",
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
_HELD = message(
    "engine",
    "the controller was paused (feed hold), by a button of its own or another program; "
    "clear the fault",
)


def interpret_state(status: Status) -> MachineState:
    """Return what the state word of a report means, with its number after the colon."""
    if status.state == "Hold":
        # Without a number nobody can tell whether the axes still brake.
        return MachineState(moving=status.substate != 0, fault=_HELD, holds=True)
    if status.state == "Door":
        moving = status.substate is None or status.substate > _LAST_DOOR_STATE_AT_REST
        return MachineState(
            moving=moving, fault=_DOOR_CLOSED if status.substate == 0 else _DOOR_OPEN
        )
    known = _BY_WORD.get(status.state)
    if known is not None:
        return known
    unknown = message(
        "engine",
        "the controller reports a state that this program does not know, {state}; check the "
        "machine, then clear the fault",
    ).fill(state=repr(status.state))
    return MachineState(moving=True, fault=unknown, recognized=False)
