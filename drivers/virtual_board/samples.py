"""Samples of a board: sensor readings and the commands in effect."""

from rotemina.drivers.mc68hc11.protocol import OperatorInputs, Telemetry, WireMessage
from rotemina.drivers.virtual_board.firmware import BoardFirmware

_MAX_READING_STEPS = (1 << 23) - 1
# The buttons follow the switches in the same byte.
_BUTTON_SHIFT = 6
_BUTTON_MASK = 3


def take_samples(board: BoardFirmware) -> list[WireMessage]:
    """Take the samples of the current tick. Return the messages to send without a request."""
    messages: list[WireMessage] = []
    reporter = board.reporter
    board.machine.simulate()
    if reporter.is_sample_due(board.latest_tick):
        sample = make_sample(board)
        messages.append(sample)
        if reporter.take_sample(sample, board.latest_tick):
            messages.append(make_inputs(board))
    messages += reporter.take_captured_frames(board.latest_tick)
    return [] if board.line_capacity.half_duplex else messages


def make_sample(board: BoardFirmware) -> Telemetry:
    """Return a sample of the current tick."""
    board.machine.simulate()
    counters = board.machine.read_counters()[
        board.machine_indices.start : board.machine_indices.stop
    ]
    readings = [
        int(min(max(counter, -_MAX_READING_STEPS), _MAX_READING_STEPS)) for counter in counters
    ]
    commands = [round(drive.position) for drive in board.drives]
    return Telemetry.from_samples(
        board.clock.find_time_us(board.latest_tick),
        int(board.state),
        int(board.fault),
        _pack_switches(board),
        board.stream.expected_index,
        tuple(zip(readings, commands, strict=True)),
    )


def make_inputs(board: BoardFirmware) -> OperatorInputs:
    """Return the message with the buttons and readings of the joystick."""
    return OperatorInputs.from_readings(board.buttons, board.joystick_readings)


def _pack_switches(board: BoardFirmware) -> int:
    bits = (board.buttons & _BUTTON_MASK) << _BUTTON_SHIFT
    for axis, index in enumerate(board.machine_indices):
        low, high = board.machine.read_switches(index)
        bits |= (low | high << 1) << 2 * axis
    return bits
