"""Samples of a board: sensor readings, beside the active commands."""

from rotemina.drivers.mc68hc11.board_messages import Inputs, Telemetry
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.virtual_board.firmware import Firmware

_READING = (1 << 23) - 1
_BUTTON_AT = 6  # in the byte of the switches
_BUTTONS = 3


def take_samples(board: Firmware) -> list[Message]:
    """Take what is due at the present tick; return what a board says unasked on its own line."""
    said: list[Message] = []
    reporter = board.reporter
    board.machine.simulate()
    if reporter.wants_sample(board.now):
        sample = fresh_sample(board)
        said.append(sample)
        if reporter.take_sample(sample, board.now):
            said.append(inputs(board))
    said += reporter.take_captured(board.now)
    return [] if board.line.half_duplex else said


def fresh_sample(board: Firmware) -> Telemetry:
    """Return a sample of the present tick."""
    board.machine.simulate()
    counted = board.machine.counted()[board.indices.start : board.indices.stop]
    readings = [int(min(max(one, -_READING), _READING)) for one in counted]
    commands = [round(drive.position) for drive in board.drives]
    return Telemetry.of(
        board.clock.at_tick(board.now),
        int(board.state),
        int(board.fault),
        _switches(board),
        board.stream.expected,
        tuple(zip(readings, commands, strict=True)),
    )


def inputs(board: Firmware) -> Inputs:
    """Return what the operator holds."""
    return Inputs.of(board.buttons, board.readings)


def _switches(board: Firmware) -> int:
    bits = (board.buttons & _BUTTONS) << _BUTTON_AT
    for axis, index in enumerate(board.indices):
        low, high = board.machine.closed(index)
        bits |= (low | high << 1) << 2 * axis
    return bits
