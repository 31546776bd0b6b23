"""Handling of the frames that move axes."""

from collections.abc import Callable
from typing import Any

import numpy as np

from rotemina.drivers.mc68hc11 import host_messages
from rotemina.drivers.mc68hc11.parameters import CODES
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import SEGMENTS, Fault, Refusal
from rotemina.drivers.mc68hc11.segment_window import ROUNDING
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
from rotemina.sim.arrays import IntArray

_MS_US = 1000
MOST_FRACTION = 16  # binary digits behind the point of a step


def _move_to(board: Firmware, asked: host_messages.MoveTo) -> None:
    axis = axis_of(board, asked.axis)
    demand_free(board, axis)
    demand(board.kept.inside(axis, asked.target) and asked.most_speed > 0, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].move_to(asked.target, asked.most_speed)


def _move_velocity(board: Firmware, asked: host_messages.MoveVelocity) -> None:
    axis = axis_of(board, asked.axis)
    demand_free(board, axis)
    demand(asked.lease_ms > 0 or asked.speed == 0, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].drive(asked.speed)
    if asked.speed:
        board.leases[axis] = board.now + board.clock.ticks(asked.lease_ms * _MS_US)


def _begin_stream(board: Firmware, asked: host_messages.BeginStream) -> None:
    demand_free(board)
    demand(not board.moving, Refusal.BUSY)
    demand(asked.segments > 0 and asked.hold > 0, Refusal.BAD_VALUE)
    demand(asked.fraction <= MOST_FRACTION, Refusal.BAD_VALUE)
    board.profile.clear()  # both lie in the same memory
    board.stream.begin(asked, [round(drive.position) for drive in board.drives])


def _set_point(board: Firmware, asked: host_messages.SetPoint) -> None:
    stream = board.stream
    if not stream.expects(asked.index):
        demand(stream.has_had(asked.index), Refusal.OUT_OF_ORDER)
        return
    demand(not stream.full, Refusal.QUEUE_FULL)
    differences = asked.differences()
    demand(len(differences) == len(board.axes), Refusal.WRONG_LENGTH)
    demand(asked.ticks > 0 and asked.ticks % stream.hold == 0, Refusal.BAD_VALUE)
    if board.clock.tick_at(stream.starts_us, board.now) <= board.now:
        board.halt(Fault.LATE_SETPOINT)
        raise RefusedError(Refusal.FAULTY)
    places = stream.places(asked.ticks, differences)
    steps = stream.steps(places)
    ends = [board.kept.limits(axis) for axis in range(len(board.axes))]
    low, high = np.array(ends).T
    if ((steps < low) | (steps > high)).any():
        board.halt(Fault.SOFT_LIMIT)
        raise RefusedError(Refusal.BAD_VALUE)
    if _too_fast(board, steps):
        board.halt(Fault.TOO_FAST)
        raise RefusedError(Refusal.BAD_VALUE)
    stream.take(
        places, lambda at_us: board.clock.tick_at(at_us, board.now), 1e6 * board.tick_s, asked.ticks
    )


def _too_fast(board: Firmware, steps: IntArray) -> bool:
    """Return whether an axis does not get from one command (n, axes) to the next in its ticks.

    The first of a stream is where the axes stand.
    """
    stream = board.stream
    ways = np.abs(np.diff(np.vstack((stream.latest, steps)), axis=0))
    ticks = np.full((len(ways), 1), stream.hold)
    ticks[0] = stream.hold if stream.begun else 1
    speeds = np.array([board.kept.speed(axis) for axis in range(len(board.axes))])
    return bool((ways > speeds * ticks * board.tick_s + ROUNDING).any())


def _set_voltage(board: Firmware, asked: host_messages.SetVoltage) -> None:
    axis = axis_of(board, asked.axis)
    demand(has_converter(board, axis), Refusal.NOT_ABLE)
    demand_free(board, axis)
    target = round(board.kept.at_voltage(axis, board.kept.voltage(axis, asked.code)))
    low, high = board.kept.limits(axis)
    # The ends of the converter and of the range are the same but for rounding.
    demand(low - 1 <= target <= high + 1 and asked.code <= CODES, Refusal.BAD_VALUE)
    board.leases.pop(axis, None)
    board.drives[axis].ramp(min(max(target, low), high), board.kept.slew(axis))


def _home(board: Firmware, asked: host_messages.Home) -> None:
    axes = axes_of(board, asked.axes)
    demand(all(board.steppers[axis] for axis in axes), Refusal.NOT_ABLE)
    demand(board.fault is Fault.NONE, Refusal.FAULTY)
    demand(not board.moving and not board.stream.playing, Refusal.BUSY)
    board.homing = {axis: HomingAxis(axis, board.drives[axis], board.kept) for axis in axes}


def _begin_profile(board: Firmware, asked: host_messages.BeginProfile) -> None:
    axis = axis_of(board, asked.axis)
    demand(0 < asked.segments <= SEGMENTS, Refusal.BAD_VALUE)
    demand(not board.profile.running and not board.stream.playing, Refusal.BUSY)
    board.profile.begin(axis, asked.segments)


def _segments(board: Firmware, asked: host_messages.Segments) -> None:
    demand(all(one.ticks for one in asked.segments()), Refusal.BAD_VALUE)
    demand(not board.profile.running and board.profile.trigger is None, Refusal.BUSY)
    demand(board.profile.add(asked), Refusal.OUT_OF_ORDER)


def _arm_profile(board: Firmware, asked: host_messages.ArmProfile) -> None:
    profile = board.profile
    demand(profile.complete, Refusal.OUT_OF_ORDER)
    demand_free(board)
    demand(asked.trigger in (0, 1) and asked.check == profile.check, Refusal.BAD_VALUE)
    most = board.kept.speed(profile.axis) * board.tick_s + ROUNDING
    demand(profile.greatest_speed() <= most, Refusal.BAD_VALUE)
    profile.trigger = asked.trigger


def _trigger_profile(board: Firmware, _: host_messages.TriggerProfile) -> None:
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


def _abort_profile(board: Firmware, _: host_messages.AbortProfile) -> None:
    board.end_profile()


HANDLERS: tuple[tuple[type[Message], Callable[[Firmware, Any], Message | None]], ...] = (
    (host_messages.MoveTo, _move_to),
    (host_messages.MoveVelocity, _move_velocity),
    (host_messages.BeginStream, _begin_stream),
    (host_messages.SetPoint, _set_point),
    (host_messages.SetVoltage, _set_voltage),
    (host_messages.Home, _home),
    (host_messages.BeginProfile, _begin_profile),
    (host_messages.Segments, _segments),
    (host_messages.ArmProfile, _arm_profile),
    (host_messages.TriggerProfile, _trigger_profile),
    (host_messages.AbortProfile, _abort_profile),
)
