"""What a board does with a frame: one small function for each message."""

from collections.abc import Callable
from typing import Any

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11 import reports, requests
from rotemina.drivers.mc68hc11.budget import rates
from rotemina.drivers.mc68hc11.codes import (
    LCD_COLUMNS,
    LCD_ROWS,
    SEGMENTS,
    VERSION,
    Ability,
    Fault,
    Refusal,
)
from rotemina.drivers.mc68hc11.framing import BROADCAST, STOP, Frame
from rotemina.drivers.mc68hc11.message import Message
from rotemina.drivers.mc68hc11.parameters import CODES
from rotemina.drivers.virtual_board.firmware import Firmware
from rotemina.drivers.virtual_board.homing import HomingAxis
from rotemina.drivers.virtual_board.sampling import Capture, Schedule
from rotemina.drivers.virtual_board.stream import Point

_NAME = 10  # bytes of the robot's name in the board's
_MS_US = 1000
_INPUTS_EVERY = 4
_SLACK = 1.001  # of the greatest speed, that rounding of coefficients takes
_ALWAYS = (requests.Identify.TYPE, requests.Stop.TYPE)  # executed, whatever their number


class _RefusedError(Exception):
    """The board does not do it; the reason is what it answers."""

    def __init__(self, reason: Refusal) -> None:
        self.reason = reason


def answer(board: Firmware, frame: Frame, at_s: float) -> Frame | None:
    """Let a board act on a frame that ended at this time; return what it answers, if anything."""
    if frame.from_board:
        return None
    if frame is not STOP:  # a bare zero proves no host
        board.watch_tick = board.now + board.clock.ticks(board.watch_us)
    if frame.address == BROADCAST:
        report = _executed(board, frame, at_s)
        return board.framed(report) if frame.type == requests.Poll.TYPE else None
    if frame.address != board.number:
        return None
    if board.last is not None and board.last[0] == frame.number and frame.type not in _ALWAYS:
        return board.last[1]
    said = board.framed(_executed(board, frame, at_s))
    board.last = frame.number, said
    return said


def _executed(board: Firmware, frame: Frame, at_s: float) -> Message:
    if frame.type == requests.Stop.TYPE and not frame.payload:
        board.stop(at_s)
        return reports.Done(frame.number)
    if frame.type not in _HANDLERS:
        return reports.Refused(frame.number, Refusal.UNKNOWN_TYPE)
    kind, handler = _HANDLERS[frame.type]
    try:
        message = kind.unpacked(frame.payload)
    except ProtocolError:
        return reports.Refused(frame.number, Refusal.WRONG_LENGTH)
    try:
        return handler(board, message) or reports.Done(frame.number)
    except _RefusedError as refused:
        return reports.Refused(frame.number, refused.reason)


def _demand(condition: bool, reason: Refusal) -> None:
    if not condition:
        raise _RefusedError(reason)


def _axis(board: Firmware, axis: int) -> int:
    _demand(axis < len(board.axes), Refusal.BAD_VALUE)
    return axis


def _axes(board: Firmware, bits: int) -> list[int]:
    _demand(0 < bits < 1 << len(board.axes), Refusal.BAD_VALUE)
    return [axis for axis in range(len(board.axes)) if bits >> axis & 1]


def _demand_free(board: Firmware, axis: int | None = None) -> None:
    """Refuse unless an axis, or every one, may be moved by a frame now."""
    _demand(board.fault is Fault.NONE, Refusal.FAULTY)
    _demand(board.known, Refusal.NOT_HOMED)
    _demand(not board.homing and not board.stream.playing, Refusal.BUSY)
    own = board.profile.axis if axis is None else axis
    _demand(not (board.profile.running and board.profile.axis == own), Refusal.BUSY)


def _identify(board: Firmware, _: requests.Identify) -> Message:
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
    if any(_has_converter(board, axis) for axis in range(len(board.axes))):
        abilities |= Ability.DAC
    if board.line.half_duplex:
        abilities |= Ability.HALF_DUPLEX
    name = board.robot.name.encode("ascii", "replace")[:_NAME] + b" %d" % board.number
    own = board.kept
    count = len(board.axes)
    return reports.Identity(
        VERSION, abilities, count, board.line.baud, len(own), own.fingerprint, name
    )


def _has_converter(board: Firmware, axis: int) -> bool:
    return not board.steppers[axis] and not board.machine.looped[board.indices[axis]]


def _clear_fault(board: Firmware, _: requests.ClearFault) -> None:
    own = zip(board.steppers, board.drives, strict=True)
    _demand(not any(stepper and drive.moving for stepper, drive in own), Refusal.FAULTY)
    board.fault = Fault.NONE


def _poll(board: Firmware, _: requests.Poll) -> Message:
    board.polls += 1
    if board.polls % _INPUTS_EVERY == 0:
        return board.inputs()
    if board.waiting:
        return board.waiting.popleft()
    return board.sample if board.sample is not None else board.fresh_sample()


def _describe_axis(board: Firmware, asked: requests.DescribeAxis) -> Message:
    return board.axes[_axis(board, asked.axis)].described(board.robot)


def _watch(board: Firmware, asked: requests.Watch) -> None:
    _demand(asked.silence_ms > 0, Refusal.BAD_VALUE)
    board.watch_us = asked.silence_ms * _MS_US
    board.watch_tick = board.now + board.clock.ticks(board.watch_us)


def _ask_rates(board: Firmware, _: requests.AskRates) -> Message:
    return _rates(board)


def _rates(board: Firmware) -> reports.Rates:
    own, most = rates(board.line), round(1.0 / board.tick_s)
    return reports.Rates(
        min(own.telemetry, most),
        min(own.telemetry_while_capturing, most),
        min(own.capture_one, most),
        min(own.capture_three, most),
    )


def _move_to(board: Firmware, asked: requests.MoveTo) -> None:
    axis = _axis(board, asked.axis)
    _demand_free(board, axis)
    _demand(board.kept.inside(axis, asked.target) and asked.most_speed > 0, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].move_to(asked.target, asked.most_speed)


def _move_velocity(board: Firmware, asked: requests.MoveVelocity) -> None:
    axis = _axis(board, asked.axis)
    _demand_free(board, axis)
    _demand(asked.lease_ms > 0 or asked.speed == 0, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].drive(asked.speed)
    if asked.speed:
        board.leases[axis] = board.now + board.clock.ticks(asked.lease_ms * _MS_US)


def _set_point(board: Firmware, asked: requests.SetPoint) -> None:
    stream = board.stream
    if not stream.expects(asked.index):
        _demand(stream.has_had(asked.index), Refusal.OUT_OF_ORDER)
        return
    if not stream.playing:
        _demand_free(board)
        _demand(not board.moving, Refusal.BUSY)
    _demand(not stream.full, Refusal.QUEUE_FULL)
    position = (asked.first, asked.second, asked.third)[: len(board.axes)]
    tick = board.clock.tick_at(asked.time_us, board.now)
    _demand(stream.last_tick is None or tick >= stream.last_tick, Refusal.BAD_VALUE)
    if tick <= board.now:
        board.halt(Fault.LATE_SETPOINT)
        raise _RefusedError(Refusal.FAULTY)
    if not all(board.kept.inside(axis, at) for axis, at in enumerate(position)):
        board.halt(Fault.SOFT_LIMIT)
        raise _RefusedError(Refusal.BAD_VALUE)
    stream.take(asked.index, asked.left, Point(tick, position))


def _set_voltage(board: Firmware, asked: requests.SetVoltage) -> None:
    axis = _axis(board, asked.axis)
    _demand(_has_converter(board, axis), Refusal.NOT_ABLE)
    _demand_free(board, axis)
    target = round(board.kept.at_voltage(axis, board.kept.voltage(axis, asked.code)))
    low, high = board.kept.limits(axis)
    # The ends of the converter and of the range are the same but for rounding.
    _demand(low - 1 <= target <= high + 1 and asked.code <= CODES, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].ramp(min(max(target, low), high), board.kept.slew(axis))


def _home(board: Firmware, asked: requests.Home) -> None:
    axes = _axes(board, asked.axes)
    _demand(all(board.steppers[axis] for axis in axes), Refusal.NOT_ABLE)
    _demand(board.fault is Fault.NONE, Refusal.FAULTY)
    _demand(not board.moving and not board.stream.playing, Refusal.BUSY)
    board.homing = {axis: HomingAxis(axis, board.drives[axis], board.kept) for axis in axes}


def _read_parameter(board: Firmware, asked: requests.ReadParameter) -> Message:
    _demand(asked.index < len(board.kept), Refusal.BAD_VALUE)
    return reports.Parameter(asked.index, board.kept[asked.index])


def _write_parameter(board: Firmware, asked: requests.WriteParameter) -> None:
    _demand(asked.index < len(board.kept), Refusal.BAD_VALUE)
    _demand(not board.moving and not board.stream.playing, Refusal.BUSY)
    _demand(board.kept.accepts(asked.index, asked.value), Refusal.BAD_VALUE)
    board.kept.write(asked.index, asked.value)
    for axis, drive in enumerate(board.drives):
        board.rebound(axis, drive)


def _show_text(board: Firmware, asked: requests.ShowText) -> None:
    end = asked.column + len(asked.text)
    _demand(asked.row < LCD_ROWS and end <= LCD_COLUMNS, Refusal.BAD_VALUE)
    line = board.lcd[asked.row]
    text = asked.text.decode("ascii", "replace")
    board.lcd[asked.row] = line[: asked.column] + text + line[end:]


def _set_telemetry(board: Firmware, asked: requests.SetTelemetry) -> None:
    if asked.period_ms == 0:
        board.telemetry = board.sample = None
        return
    _demand(asked.period_ms * _rates(board).telemetry >= _MS_US, Refusal.BAD_VALUE)
    board.sample = None
    board.telemetry = Schedule(board.clock, asked.period_ms * _MS_US, asked.begin_us, board.now)


def _capture(board: Firmware, asked: requests.Capture) -> None:
    if asked.samples == 0:
        board.capture = None
        return
    axes = _axes(board, asked.axes)
    own = _rates(board)
    most_hz = own.capture_one if len(axes) == 1 else own.capture_three
    _demand(asked.period_us * most_hz >= 1_000_000, Refusal.BAD_VALUE)
    _demand(board.capture is None, Refusal.BUSY)
    first = board.telemetry.tick if board.telemetry is not None else board.now + 1
    begin_us = board.clock.at_tick(first)
    schedule = Schedule(board.clock, asked.period_us, begin_us, first - 1)
    indices = tuple(board.indices[axis] for axis in axes)
    board.waiting.clear()
    board.capture = Capture(board.machine, indices, schedule, asked.samples)


def _begin_profile(board: Firmware, asked: requests.BeginProfile) -> None:
    axis = _axis(board, asked.axis)
    _demand(0 < asked.segments <= SEGMENTS, Refusal.BAD_VALUE)
    _demand(not board.profile.running, Refusal.BUSY)
    board.profile.begin(axis, asked.segments)


def _segment(board: Firmware, asked: requests.Segment) -> None:
    _demand(asked.duration_us > 0, Refusal.BAD_VALUE)
    _demand(not board.profile.running and board.profile.trigger is None, Refusal.BUSY)
    _demand(board.profile.add(asked), Refusal.OUT_OF_ORDER)


def _arm_profile(board: Firmware, asked: requests.ArmProfile) -> None:
    profile = board.profile
    _demand(profile.complete, Refusal.OUT_OF_ORDER)
    _demand_free(board)
    _demand(asked.trigger in (0, 1) and asked.check == profile.check, Refusal.BAD_VALUE)
    most = _SLACK * board.kept.speed(profile.axis)
    _demand(profile.greatest_speed() <= most, Refusal.BAD_VALUE)
    profile.trigger = asked.trigger


def _trigger_profile(board: Firmware, _: requests.TriggerProfile) -> None:
    _demand(board.profile.trigger == 0, Refusal.OUT_OF_ORDER)
    _demand_free(board)
    start_profile(board)


def start_profile(board: Firmware) -> None:
    """Let the armed profile begin at the next tick; the fault ``PROFILE`` if its axis moves."""
    drive = board.drives[board.profile.axis]
    if drive.moving:
        board.halt(Fault.PROFILE)
        return
    board.profile.start(board.now, drive.position)


def press(board: Firmware, buttons: int) -> None:
    """Let the operator hold these buttons; the first one triggers a profile that waits for it."""
    pressed = buttons & ~board.buttons & 1
    board.buttons = buttons
    waits = board.profile.trigger == 1 and not board.stream.playing and not board.homing
    if pressed and waits:
        start_profile(board)


def _abort_profile(board: Firmware, _: requests.AbortProfile) -> None:
    board.end_profile()


_Handler = Callable[[Firmware, Any], Message | None]
_HANDLERS: dict[int, tuple[type[Message], _Handler]] = {
    kind.TYPE: (kind, handler)
    for kind, handler in (
        (requests.Identify, _identify),
        (requests.ClearFault, _clear_fault),
        (requests.Poll, _poll),
        (requests.DescribeAxis, _describe_axis),
        (requests.Watch, _watch),
        (requests.AskRates, _ask_rates),
        (requests.MoveTo, _move_to),
        (requests.MoveVelocity, _move_velocity),
        (requests.SetPoint, _set_point),
        (requests.SetVoltage, _set_voltage),
        (requests.Home, _home),
        (requests.ReadParameter, _read_parameter),
        (requests.WriteParameter, _write_parameter),
        (requests.ShowText, _show_text),
        (requests.SetTelemetry, _set_telemetry),
        (requests.Capture, _capture),
        (requests.BeginProfile, _begin_profile),
        (requests.Segment, _segment),
        (requests.ArmProfile, _arm_profile),
        (requests.TriggerProfile, _trigger_profile),
        (requests.AbortProfile, _abort_profile),
    )
}
