"""Refusal of a frame by a board, and the checks that most frames need."""

from rotemina.drivers.mc68hc11.protocol import BoardFault, RefusalReason
from rotemina.drivers.virtual_board.firmware import BoardFirmware


class FrameRefusedError(Exception):
    """Refusal of a frame. The board answers with the reason."""

    def __init__(self, reason: RefusalReason) -> None:
        self.reason = reason


def require(condition: bool, reason: RefusalReason) -> None:
    """Refuse the frame for a reason unless a condition holds."""
    if not condition:
        raise FrameRefusedError(reason)


def require_axis(board: BoardFirmware, axis: int) -> int:
    """Return the number of an axis. Refuse the frame if the board does not have the axis."""
    require(axis < len(board.axes), RefusalReason.BAD_VALUE)
    return axis


def parse_axes(board: BoardFirmware, bits: int) -> list[int]:
    """Return the axis numbers in a bit mask. Refuse the frame if there are none or unknown ones."""
    require(0 < bits < 1 << len(board.axes), RefusalReason.BAD_VALUE)
    return [axis for axis in range(len(board.axes)) if bits >> axis & 1]


def require_free(board: BoardFirmware, axis: int | None = None) -> None:
    """Refuse the frame unless the axis, or every axis if it is None, may start to move now."""
    require(board.fault is BoardFault.NONE, RefusalReason.FAULTY)
    require(board.is_position_known, RefusalReason.NOT_HOMED)
    require(not board.homing and not board.stream.playing, RefusalReason.BUSY)
    profile_axis = board.profile.axis if axis is None else axis
    require(not (board.profile.running and board.profile.axis == profile_axis), RefusalReason.BUSY)


def has_converter(board: BoardFirmware, axis: int) -> bool:
    """Return whether an axis is an open-loop piezo, which its converter moves directly."""
    return not board.is_stepper[axis] and not board.machine.has_loop[board.machine_indices[axis]]
