"""Handlers of the frames that do not move axes."""

from collections.abc import Callable
from typing import Any

from rotemina.drivers.mc68hc11 import compute_rates
from rotemina.drivers.mc68hc11.protocol import (
    LCD_COLUMNS,
    LCD_ROWS,
    PROTOCOL_VERSION,
    VIRTUAL_KIND,
    BoardAbility,
    BoardFault,
    RefusalReason,
    WireMessage,
    board_messages,
    host_messages,
)
from rotemina.drivers.virtual_board.firmware import BoardFirmware
from rotemina.drivers.virtual_board.refusal import has_converter, parse_axes, require, require_axis
from rotemina.drivers.virtual_board.samples import make_inputs, make_sample
from rotemina.drivers.virtual_board.sampling import FirmwareCapture, SamplingSchedule

# The name of the board contains the robot's name up to this length.
_MAX_NAME_BYTES = 10
_US_PER_MS = 1000


def _identify(board: BoardFirmware, _: host_messages.IdentifyBoard) -> WireMessage:
    abilities = (
        BoardAbility.MOVE
        | BoardAbility.VELOCITY
        | BoardAbility.SETPOINTS
        | BoardAbility.CAPTURE
        | BoardAbility.PROFILE
        | BoardAbility.JOYSTICK
        | BoardAbility.DISPLAY
        | BoardAbility.PARAMETERS
    )
    if any(board.is_stepper):
        abilities |= BoardAbility.HOMING
    if any(has_converter(board, axis) for axis in range(len(board.axes))):
        abilities |= BoardAbility.DAC
    if board.line_capacity.half_duplex:
        abilities |= BoardAbility.HALF_DUPLEX
    name = board.robot.name.encode("ascii", "replace")[:_MAX_NAME_BYTES] + b" %d" % board.number
    parameters = board.parameters
    count = len(board.axes)
    return board_messages.BoardIdentity(
        PROTOCOL_VERSION,
        abilities,
        count,
        board.line_capacity.baud,
        len(parameters),
        parameters.fingerprint,
        name,
    )


def _report_kind(_board: BoardFirmware, _: host_messages.AskKind) -> WireMessage:
    return board_messages.BoardKind(VIRTUAL_KIND)


def _answer_poll(board: BoardFirmware, _: host_messages.PollBoard) -> WireMessage:
    if board.reporter.count_poll():
        return make_inputs(board)
    return board.reporter.answer_poll() or make_sample(board)


def _describe_axis(board: BoardFirmware, request: host_messages.DescribeAxis) -> WireMessage:
    return board.axes[require_axis(board, request.axis)].describe(board.robot)


def _report_rates(board: BoardFirmware, _: host_messages.RequestRates) -> WireMessage:
    return _compute_rates(board)


def _compute_rates(board: BoardFirmware) -> board_messages.BoardRates:
    return compute_rates(board.line_capacity, round(1.0 / board.tick_s))


def _read_parameter(board: BoardFirmware, request: host_messages.ReadParameter) -> WireMessage:
    require(request.index < len(board.parameters), RefusalReason.BAD_VALUE)
    return board_messages.ParameterValue(request.index, board.parameters[request.index])


def _show_text(board: BoardFirmware, request: host_messages.ShowText) -> None:
    end = request.column + len(request.text)
    require(request.row < LCD_ROWS and end <= LCD_COLUMNS, RefusalReason.BAD_VALUE)
    line = board.lcd[request.row]
    text = request.text.decode("ascii", "replace")
    board.lcd[request.row] = line[: request.column] + text + line[end:]


def _set_telemetry(board: BoardFirmware, request: host_messages.SetTelemetry) -> None:
    if request.period_ms == 0:
        board.reporter.set_telemetry(None)
        return
    require(
        request.period_ms * _compute_rates(board).telemetry >= _US_PER_MS, RefusalReason.BAD_VALUE
    )
    schedule = SamplingSchedule(
        board.clock, request.period_ms * _US_PER_MS, request.begin_us, board.latest_tick
    )
    board.reporter.set_telemetry(schedule)


def _begin_capture(board: BoardFirmware, request: host_messages.BeginCapture) -> None:
    if request.samples == 0:
        board.reporter.set_capture(None)
        return
    axes = parse_axes(board, request.axes)
    rates_hz = _compute_rates(board)
    max_hz = rates_hz.capture_one if len(axes) == 1 else rates_hz.capture_three
    require(request.period_us * max_hz >= 1_000_000, RefusalReason.BAD_VALUE)
    require(board.reporter.capture is None, RefusalReason.BUSY)
    telemetry = board.reporter.telemetry
    first_tick = telemetry.next_tick if telemetry is not None else board.latest_tick + 1
    begin_us = board.clock.find_time_us(first_tick)
    schedule = SamplingSchedule(board.clock, request.period_us, begin_us, first_tick - 1)
    indices = tuple(board.machine_indices[axis] for axis in axes)
    board.reporter.set_capture(FirmwareCapture(board.machine, indices, schedule, request.samples))


def _clear_fault(board: BoardFirmware, _: host_messages.ClearFault) -> None:
    is_stepper_moving = any(
        is_stepper and drive.moving
        for is_stepper, drive in zip(board.is_stepper, board.drives, strict=True)
    )
    require(not is_stepper_moving, RefusalReason.FAULTY)
    board.fault = BoardFault.NONE
    # An axis at a limit switch may now move away from it.
    board.last_directions = [0.0] * len(board.axes)


def _set_watchdog(board: BoardFirmware, request: host_messages.SetWatchdog) -> None:
    require(request.silence_ms > 0, RefusalReason.BAD_VALUE)
    board.watchdog_us = request.silence_ms * _US_PER_MS
    board.watchdog_tick = board.latest_tick + board.clock.count_ticks(board.watchdog_us)


def _write_parameter(board: BoardFirmware, request: host_messages.WriteParameter) -> None:
    require(request.index < len(board.parameters), RefusalReason.BAD_VALUE)
    require(not board.moving and not board.stream.playing, RefusalReason.BUSY)
    require(board.parameters.is_acceptable(request.index, request.value), RefusalReason.BAD_VALUE)
    board.parameters.write(request.index, request.value, board.now_s)
    for axis, drive in enumerate(board.drives):
        board.apply_limits(axis, drive)


HANDLERS: tuple[
    tuple[type[WireMessage], Callable[[BoardFirmware, Any], WireMessage | None]], ...
] = (
    (host_messages.IdentifyBoard, _identify),
    (host_messages.ClearFault, _clear_fault),
    (host_messages.PollBoard, _answer_poll),
    (host_messages.DescribeAxis, _describe_axis),
    (host_messages.SetWatchdog, _set_watchdog),
    (host_messages.RequestRates, _report_rates),
    (host_messages.AskKind, _report_kind),
    (host_messages.ReadParameter, _read_parameter),
    (host_messages.WriteParameter, _write_parameter),
    (host_messages.ShowText, _show_text),
    (host_messages.SetTelemetry, _set_telemetry),
    (host_messages.BeginCapture, _begin_capture),
)
