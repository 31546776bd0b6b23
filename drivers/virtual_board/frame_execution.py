"""Handling of frames by a board: each is executed once, and answered."""

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11 import board_messages, host_messages
from rotemina.drivers.mc68hc11.framing import BROADCAST, STOP, Frame
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import Refusal
from rotemina.drivers.virtual_board import motion_handlers, request_handlers
from rotemina.drivers.virtual_board.firmware import Firmware
from rotemina.drivers.virtual_board.refusal import RefusedError

_COUNTED = host_messages.SetPoint.TYPE  # by its own index
_ALWAYS = (
    host_messages.Identify.TYPE,
    host_messages.Stop.TYPE,
    _COUNTED,
)  # executed, whatever their number
_HANDLERS = {
    kind.TYPE: (kind, handler)
    for kind, handler in (*request_handlers.HANDLERS, *motion_handlers.HANDLERS)
}


def answer(board: Firmware, frame: Frame, at_s: float) -> Frame | None:
    """Let a board act on a frame that ended at this time; return what it answers, if anything."""
    if frame.from_board:
        return None
    if frame is not STOP:  # a bare zero proves no host
        board.watch_tick = board.now + board.clock.ticks(board.watch_us)
    if frame.address == BROADCAST:
        report = _executed(board, frame, at_s)
        return board.framed(report) if frame.type == host_messages.Poll.TYPE else None
    if frame.address != board.number:
        return None
    if board.last is not None and board.last[0] == frame.number and frame.type not in _ALWAYS:
        return board.last[1]
    report = _executed(board, frame, at_s)
    # Telemetry tells what a stream has; on a bus a board is to answer, or nobody knows whose turn
    # it is.
    silent = frame.type == _COUNTED and isinstance(report, board_messages.Done)
    said = None if silent and not board.line.half_duplex else board.framed(report)
    board.last = frame.number, said
    return said


def _executed(board: Firmware, frame: Frame, at_s: float) -> Message:
    if frame.type == host_messages.Stop.TYPE and not frame.payload:
        board.stop(at_s)
        return board_messages.Done(frame.number)
    if frame.type not in _HANDLERS:
        return board_messages.Refused(frame.number, Refusal.UNKNOWN_TYPE)
    kind, handler = _HANDLERS[frame.type]
    try:
        return handler(board, kind.unpacked(frame.payload)) or board_messages.Done(frame.number)
    except ProtocolError:
        return board_messages.Refused(frame.number, Refusal.WRONG_LENGTH)
    except RefusedError as refused:
        return board_messages.Refused(frame.number, refused.reason)
