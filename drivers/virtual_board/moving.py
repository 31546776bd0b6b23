"""What a board does with the frames that move axes."""

from collections.abc import Callable
from typing import Any

from rotemina.drivers.mc68hc11 import requests
from rotemina.drivers.mc68hc11.codes import SEGMENTS, Fault, Refusal
from rotemina.drivers.mc68hc11.message import Message
from rotemina.drivers.mc68hc11.parameters import CODES
from rotemina.drivers.virtual_board.firmware import Firmware
from rotemina.drivers.virtual_board.homing import HomingAxis
from rotemina.drivers.virtual_board.refusal import (
    RefusedError,
    axes_of,
    axis_of,
    demand,
    demand_free,
    has_converter,
)
from rotemina.drivers.virtual_board.stream import Point

_MS_US = 1000
_SLACK = 1.001  # of the greatest speed, that rounding of coefficients takes


def _move_to(board: Firmware, asked: requests.MoveTo) -> None:
    axis = axis_of(board, asked.axis)
    demand_free(board, axis)
    demand(board.kept.inside(axis, asked.target) and asked.most_speed > 0, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].move_to(asked.target, asked.most_speed)


def _move_velocity(board: Firmware, asked: requests.MoveVelocity) -> None:
    axis = axis_of(board, asked.axis)
    demand_free(board, axis)
    demand(asked.lease_ms > 0 or asked.speed == 0, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].drive(asked.speed)
    if asked.speed:
        board.leases[axis] = board.now + board.clock.ticks(asked.lease_ms * _MS_US)


def _set_point(board: Firmware, asked: requests.SetPoint) -> None:
    stream = board.stream
    if not stream.expects(asked.index):
        demand(stream.has_had(asked.index), Refusal.OUT_OF_ORDER)
        return
    if not stream.playing:
        demand_free(board)
        demand(not board.moving, Refusal.BUSY)
        board.profile.clear()  # both lie in the same memory
    demand(not stream.full, Refusal.QUEUE_FULL)
    position = (asked.first, asked.second, asked.third)[: len(board.axes)]
    tick = board.clock.tick_at(asked.time_us, board.now)
    demand(stream.last_tick is None or tick >= stream.last_tick, Refusal.BAD_VALUE)
    if tick <= board.now:
        board.halt(Fault.LATE_SETPOINT)
        raise RefusedError(Refusal.FAULTY)
    if not all(board.kept.inside(axis, at) for axis, at in enumerate(position)):
        board.halt(Fault.SOFT_LIMIT)
        raise RefusedError(Refusal.BAD_VALUE)
    stream.take(asked.index, asked.left, Point(tick, position))


def _set_voltage(board: Firmware, asked: requests.SetVoltage) -> None:
    axis = axis_of(board, asked.axis)
    demand(has_converter(board, axis), Refusal.NOT_ABLE)
    demand_free(board, axis)
    target = round(board.kept.at_voltage(axis, board.kept.voltage(axis, asked.code)))
    low, high = board.kept.limits(axis)
    # The ends of the converter and of the range are the same but for rounding.
    demand(low - 1 <= target <= high + 1 and asked.code <= CODES, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].ramp(min(max(target, low), high), board.kept.slew(axis))


def _home(board: Firmware, asked: requests.Home) -> None:
    axes = axes_of(board, asked.axes)
    demand(all(board.steppers[axis] for axis in axes), Refusal.NOT_ABLE)
    demand(board.fault is Fault.NONE, Refusal.FAULTY)
    demand(not board.moving and not board.stream.playing, Refusal.BUSY)
    board.homing = {axis: HomingAxis(axis, board.drives[axis], board.kept) for axis in axes}


def _begin_profile(board: Firmware, asked: requests.BeginProfile) -> None:
    axis = axis_of(board, asked.axis)
    demand(0 < asked.segments <= SEGMENTS, Refusal.BAD_VALUE)
    demand(not board.profile.running and not board.stream.playing, Refusal.BUSY)
    board.profile.begin(axis, asked.segments)


def _segment(board: Firmware, asked: requests.Segment) -> None:
    demand(asked.duration_us > 0, Refusal.BAD_VALUE)
    demand(not board.profile.running and board.profile.trigger is None, Refusal.BUSY)
    demand(board.profile.add(asked), Refusal.OUT_OF_ORDER)


def _arm_profile(board: Firmware, asked: requests.ArmProfile) -> None:
    profile = board.profile
    demand(profile.complete, Refusal.OUT_OF_ORDER)
    demand_free(board)
    demand(asked.trigger in (0, 1) and asked.check == profile.check, Refusal.BAD_VALUE)
    most = _SLACK * board.kept.speed(profile.axis)
    demand(profile.greatest_speed() <= most, Refusal.BAD_VALUE)
    profile.trigger = asked.trigger


def _trigger_profile(board: Firmware, _: requests.TriggerProfile) -> None:
    demand(board.profile.trigger == 0, Refusal.OUT_OF_ORDER)
    demand_free(board)
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


HANDLERS: tuple[tuple[type[Message], Callable[[Firmware, Any], Message | None]], ...] = (
    (requests.MoveTo, _move_to),
    (requests.MoveVelocity, _move_velocity),
    (requests.SetPoint, _set_point),
    (requests.SetVoltage, _set_voltage),
    (requests.Home, _home),
    (requests.BeginProfile, _begin_profile),
    (requests.Segment, _segment),
    (requests.ArmProfile, _arm_profile),
    (requests.TriggerProfile, _trigger_profile),
    (requests.AbortProfile, _abort_profile),
)
