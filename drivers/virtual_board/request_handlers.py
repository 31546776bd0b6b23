"""Handling of frames that query, or change the stored parameters."""

from collections.abc import Callable
from typing import Any

from rotemina.drivers.mc68hc11 import board_messages, host_messages
from rotemina.drivers.mc68hc11.line_budget import rates
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import (
    LCD_COLUMNS,
    LCD_ROWS,
    VERSION,
    VIRTUAL,
    Ability,
    Fault,
    Refusal,
)
from rotemina.drivers.virtual_board.firmware import Firmware
from rotemina.drivers.virtual_board.refusal import axes_of, axis_of, demand, has_converter
from rotemina.drivers.virtual_board.samples import fresh_sample, inputs
from rotemina.drivers.virtual_board.sampling import Capture, Schedule

_NAME = 10  # bytes of the robot's name in the board's
_MS_US = 1000


def _identify(board: Firmware, _: host_messages.Identify) -> Message:
    abilities = (
        Ability.MOVE
        | Ability.VELOCITY
        | Ability.SETPOINTS
        | Ability.CAPTURE
        | Ability.PROFILE
        | Ability.JOYSTICK
        | Ability.DISPLAY
        | Ability.PARAMETERS
    )
    if any(board.steppers):
        abilities |= Ability.HOMING
    if any(has_converter(board, axis) for axis in range(len(board.axes))):
        abilities |= Ability.DAC
    if board.line.half_duplex:
        abilities |= Ability.HALF_DUPLEX
    name = board.robot.name.encode("ascii", "replace")[:_NAME] + b" %d" % board.number
    own = board.kept
    count = len(board.axes)
    return board_messages.Identity(
        VERSION, abilities, count, board.line.baud, len(own), own.fingerprint, name
    )


def _say_kind(_board: Firmware, _: host_messages.AskKind) -> Message:
    return board_messages.BoardKind(VIRTUAL)


def _poll(board: Firmware, _: host_messages.Poll) -> Message:
    if board.reporter.tells_inputs():
        return inputs(board)
    return board.reporter.polled() or fresh_sample(board)


def _describe_axis(board: Firmware, asked: host_messages.DescribeAxis) -> Message:
    return board.axes[axis_of(board, asked.axis)].described(board.robot)


def _ask_rates(board: Firmware, _: host_messages.AskRates) -> Message:
    return _rates(board)


def _rates(board: Firmware) -> board_messages.Rates:
    return rates(board.line, round(1.0 / board.tick_s))


def _read_parameter(board: Firmware, asked: host_messages.ReadParameter) -> Message:
    demand(asked.index < len(board.kept), Refusal.BAD_VALUE)
    return board_messages.Parameter(asked.index, board.kept[asked.index])


def _show_text(board: Firmware, asked: host_messages.ShowText) -> None:
    end = asked.column + len(asked.text)
    demand(asked.row < LCD_ROWS and end <= LCD_COLUMNS, Refusal.BAD_VALUE)
    line = board.lcd[asked.row]
    text = asked.text.decode("ascii", "replace")
    board.lcd[asked.row] = line[: asked.column] + text + line[end:]


def _set_telemetry(board: Firmware, asked: host_messages.SetTelemetry) -> None:
    if asked.period_ms == 0:
        board.reporter.set_telemetry(None)
        return
    demand(asked.period_ms * _rates(board).telemetry >= _MS_US, Refusal.BAD_VALUE)
    schedule = Schedule(board.clock, asked.period_ms * _MS_US, asked.begin_us, board.now)
    board.reporter.set_telemetry(schedule)


def _capture(board: Firmware, asked: host_messages.Capture) -> None:
    if asked.samples == 0:
        board.reporter.set_capture(None)
        return
    axes = axes_of(board, asked.axes)
    own = _rates(board)
    most_hz = own.capture_one if len(axes) == 1 else own.capture_three
    demand(asked.period_us * most_hz >= 1_000_000, Refusal.BAD_VALUE)
    demand(board.reporter.capture is None, Refusal.BUSY)
    telemetry = board.reporter.telemetry
    first = telemetry.tick if telemetry is not None else board.now + 1
    begin_us = board.clock.at_tick(first)
    schedule = Schedule(board.clock, asked.period_us, begin_us, first - 1)
    indices = tuple(board.indices[axis] for axis in axes)
    board.reporter.set_capture(Capture(board.machine, indices, schedule, asked.samples))


def _clear_fault(board: Firmware, _: host_messages.ClearFault) -> None:
    own = zip(board.steppers, board.drives, strict=True)
    demand(not any(stepper and drive.moving for stepper, drive in own), Refusal.FAULTY)
    board.fault = Fault.NONE
    board.ways = [0.0] * len(board.axes)  # away from a switch is right now


def _watch(board: Firmware, asked: host_messages.Watch) -> None:
    demand(asked.silence_ms > 0, Refusal.BAD_VALUE)
    board.watch_us = asked.silence_ms * _MS_US
    board.watch_tick = board.now + board.clock.ticks(board.watch_us)


def _write_parameter(board: Firmware, asked: host_messages.WriteParameter) -> None:
    demand(asked.index < len(board.kept), Refusal.BAD_VALUE)
    demand(not board.moving and not board.stream.playing, Refusal.BUSY)
    demand(board.kept.accepts(asked.index, asked.value), Refusal.BAD_VALUE)
    board.kept.write(asked.index, asked.value, board.now_s)
    for axis, drive in enumerate(board.drives):
        board.rebound(axis, drive)


HANDLERS: tuple[tuple[type[Message], Callable[[Firmware, Any], Message | None]], ...] = (
    (host_messages.Identify, _identify),
    (host_messages.ClearFault, _clear_fault),
    (host_messages.Poll, _poll),
    (host_messages.DescribeAxis, _describe_axis),
    (host_messages.Watch, _watch),
    (host_messages.AskRates, _ask_rates),
    (host_messages.AskKind, _say_kind),
    (host_messages.ReadParameter, _read_parameter),
    (host_messages.WriteParameter, _write_parameter),
    (host_messages.ShowText, _show_text),
    (host_messages.SetTelemetry, _set_telemetry),
    (host_messages.Capture, _capture),
)
