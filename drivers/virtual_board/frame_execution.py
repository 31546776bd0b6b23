"""Handling of received frames by a board: each frame is executed once and answered."""

from rotemina.drivers.contract import ProtocolError
from rotemina.drivers.mc68hc11.protocol import (
    BROADCAST_ADDRESS,
    STOP_FRAME,
    RefusalReason,
    SerialFrame,
    WireMessage,
    board_messages,
    host_messages,
)
from rotemina.drivers.virtual_board import motion_handlers, request_handlers
from rotemina.drivers.virtual_board.firmware import BoardFirmware
from rotemina.drivers.virtual_board.refusal import FrameRefusedError

# Set-points have their own index, by which the board recognizes repeated ones.
_INDEXED_TYPE = host_messages.StreamSegment.TYPE
# These types are executed even if the number of the frame is the same as before.
_ALWAYS_EXECUTED_TYPES = (
    host_messages.IdentifyBoard.TYPE,
    host_messages.StopBoard.TYPE,
    _INDEXED_TYPE,
)
_HANDLERS = {
    message_class.TYPE: (message_class, handler)
    for message_class, handler in (*request_handlers.HANDLERS, *motion_handlers.HANDLERS)
}


def answer_frame(board: BoardFirmware, frame: SerialFrame, at_s: float) -> SerialFrame | None:
    """Execute a frame that a board received at the time ``at_s``; return its answer, or None."""
    if frame.from_board:
        return None
    # A stop may be a disturbance of a single zero, so it does not prove that the host is alive.
    if frame is not STOP_FRAME:
        board.watchdog_tick = board.latest_tick + board.clock.count_ticks(board.watchdog_us)
    if frame.address == BROADCAST_ADDRESS:
        report = _execute_frame(board, frame, at_s)
        return board.make_frame(report) if frame.type == host_messages.PollBoard.TYPE else None
    if frame.address != board.number:
        return None
    if (
        board.last_exchange is not None
        and board.last_exchange[0] == frame.number
        and frame.type not in _ALWAYS_EXECUTED_TYPES
    ):
        return board.last_exchange[1]
    report = _execute_frame(board, frame, at_s)
    # On its own line a board acknowledges set-points by telemetry. On a bus it must answer each
    # frame, because the host sends the next frame only after the answer.
    needs_no_answer = frame.type == _INDEXED_TYPE and isinstance(report, board_messages.FrameDone)
    reply = (
        None
        if needs_no_answer and not board.line_capacity.half_duplex
        else board.make_frame(report)
    )
    board.last_exchange = frame.number, reply
    return reply


def _execute_frame(board: BoardFirmware, frame: SerialFrame, at_s: float) -> WireMessage:
    if frame.type == host_messages.StopBoard.TYPE and not frame.payload:
        board.stop(at_s)
        return board_messages.FrameDone(frame.number)
    if frame.type not in _HANDLERS:
        return board_messages.FrameRefused(frame.number, RefusalReason.UNKNOWN_TYPE)
    message_class, handler = _HANDLERS[frame.type]
    try:
        report = handler(board, message_class.unpack(frame.payload))
        return report or board_messages.FrameDone(frame.number)
    except ProtocolError:
        return board_messages.FrameRefused(frame.number, RefusalReason.WRONG_LENGTH)
    except FrameRefusedError as refusal:
        return board_messages.FrameRefused(frame.number, refusal.reason)
