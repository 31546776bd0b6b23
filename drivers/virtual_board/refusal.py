"""Refusals of a board, and checks common to most frames."""

from rotemina.drivers.mc68hc11.protocol_codes import Fault, Refusal
from rotemina.drivers.virtual_board.firmware import Firmware


class RefusedError(Exception):
    """The board does not do it; the reason is what it answers."""

    def __init__(self, reason: Refusal) -> None:
        self.reason = reason


def demand(condition: bool, reason: Refusal) -> None:
    """Refuse for this reason unless something holds."""
    if not condition:
        raise RefusedError(reason)


def axis_of(board: Firmware, axis: int) -> int:
    """Return an axis' number if the board has it; refuse otherwise."""
    demand(axis < len(board.axes), Refusal.BAD_VALUE)
    return axis


def axes_of(board: Firmware, bits: int) -> list[int]:
    """Return the axis numbers of a bit mask; refuse none, or unknown ones."""
    demand(0 < bits < 1 << len(board.axes), Refusal.BAD_VALUE)
    return [axis for axis in range(len(board.axes)) if bits >> axis & 1]


def demand_free(board: Firmware, axis: int | None = None) -> None:
    """Refuse unless an axis, or every one, may be moved by a frame now."""
    demand(board.fault is Fault.NONE, Refusal.FAULTY)
    demand(board.known, Refusal.NOT_HOMED)
    demand(not board.homing and not board.stream.playing, Refusal.BUSY)
    own = board.profile.axis if axis is None else axis
    demand(not (board.profile.running and board.profile.axis == own), Refusal.BUSY)


def has_converter(board: Firmware, axis: int) -> bool:
    """Return whether a converter alone decides where an axis goes."""
    return not board.steppers[axis] and not board.machine.looped[board.indices[axis]]
