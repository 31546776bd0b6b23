"""Handlers of the frames that move axes."""

from collections.abc import Callable
from typing import Any

import numpy as np

from rotemina.drivers.mc68hc11 import ROUNDING_STEPS
from rotemina.drivers.mc68hc11.protocol import (
    MAX_CONVERTER_CODE,
    MAX_PROFILE_SEGMENTS,
    BoardFault,
    RefusalReason,
    WireMessage,
    host_messages,
)
from rotemina.drivers.virtual_board.firmware import BoardFirmware
from rotemina.drivers.virtual_board.homing import HomingAxis
from rotemina.drivers.virtual_board.refusal import (
    FrameRefusedError,
    has_converter,
    parse_axes,
    require,
    require_axis,
    require_free,
)
from rotemina.sim.arrays import IntArray

_US_PER_MS = 1000
# Maximum number of fractional bits of a position in steps.
MAX_FRACTION_BITS = 16


def _move_to(board: BoardFirmware, command: host_messages.MoveTo) -> None:
    axis = require_axis(board, command.axis)
    require_free(board, axis)
    require(
        board.parameters.is_inside(axis, command.target) and command.max_speed > 0,
        RefusalReason.BAD_VALUE,
    )
    board.lease_end_ticks.pop(axis, None)
    board.drives[axis].move_to(command.target, command.max_speed)


def _move_velocity(board: BoardFirmware, command: host_messages.MoveVelocity) -> None:
    axis = require_axis(board, command.axis)
    require_free(board, axis)
    require(command.lease_ms > 0 or command.speed == 0, RefusalReason.BAD_VALUE)
    board.lease_end_ticks.pop(axis, None)
    board.drives[axis].drive(command.speed)
    if command.speed:
        board.lease_end_ticks[axis] = board.latest_tick + board.clock.count_ticks(
            command.lease_ms * _US_PER_MS
        )


def _begin_stream(board: BoardFirmware, command: host_messages.BeginStream) -> None:
    require_free(board)
    require(not board.moving, RefusalReason.BUSY)
    require(command.segments > 0 and command.hold > 0, RefusalReason.BAD_VALUE)
    require(command.fraction <= MAX_FRACTION_BITS, RefusalReason.BAD_VALUE)
    # The stream and the profile share the same memory.
    board.profile.clear()
    board.stream.begin(command, [round(drive.position) for drive in board.drives])


def _queue_set_point(board: BoardFirmware, command: host_messages.StreamSegment) -> None:
    stream = board.stream
    if not stream.is_expected(command.index):
        require(stream.has_taken(command.index), RefusalReason.OUT_OF_ORDER)
        return
    require(not stream.full, RefusalReason.QUEUE_FULL)
    differences = command.unpack_differences()
    require(len(differences) == len(board.axes), RefusalReason.WRONG_LENGTH)
    require(command.ticks > 0 and command.ticks % stream.hold == 0, RefusalReason.BAD_VALUE)
    if board.clock.find_tick(stream.next_start_us, board.latest_tick) <= board.latest_tick:
        board.halt(BoardFault.LATE_SETPOINT)
        raise FrameRefusedError(RefusalReason.FAULTY)
    positions = stream.compute_positions(command.ticks, differences)
    steps = stream.to_steps(positions)
    limits = [board.parameters.get_limits(axis) for axis in range(len(board.axes))]
    low, high = np.array(limits).T
    if ((steps < low) | (steps > high)).any():
        board.halt(BoardFault.SOFT_LIMIT)
        raise FrameRefusedError(RefusalReason.BAD_VALUE)
    if _is_too_fast(board, steps):
        board.halt(BoardFault.TOO_FAST)
        raise FrameRefusedError(RefusalReason.BAD_VALUE)
    stream.take_segment(
        positions,
        lambda at_us: board.clock.find_tick(at_us, board.latest_tick),
        1e6 * board.tick_s,
        command.ticks,
    )


def _is_too_fast(board: BoardFirmware, steps: IntArray) -> bool:
    """Return whether an axis cannot move from one command (n, axes) to the next in time.

    The first command of a stream is compared with the current position.
    """
    stream = board.stream
    distances = np.abs(np.diff(np.vstack((stream.latest_steps, steps)), axis=0))
    ticks = np.full((len(distances), 1), stream.hold)
    ticks[0] = stream.hold if stream.has_begun else 1
    speeds = np.array([board.parameters.get_max_speed(axis) for axis in range(len(board.axes))])
    return bool((distances > speeds * ticks * board.tick_s + ROUNDING_STEPS).any())


def _set_voltage(board: BoardFirmware, command: host_messages.SetVoltage) -> None:
    axis = require_axis(board, command.axis)
    require(has_converter(board, axis), RefusalReason.NOT_ABLE)
    require_free(board, axis)
    target = round(
        board.parameters.compute_position(
            axis, board.parameters.compute_voltage(axis, command.code)
        )
    )
    low, high = board.parameters.get_limits(axis)
    # The ends of the converter's range are those of the axis' range, apart from rounding.
    require(
        low - 1 <= target <= high + 1 and command.code <= MAX_CONVERTER_CODE,
        RefusalReason.BAD_VALUE,
    )
    board.lease_end_ticks.pop(axis, None)
    board.drives[axis].ramp(min(max(target, low), high), board.parameters.compute_slew(axis))


def _home(board: BoardFirmware, command: host_messages.HomeAxes) -> None:
    axes = parse_axes(board, command.axes)
    require(all(board.is_stepper[axis] for axis in axes), RefusalReason.NOT_ABLE)
    require(board.fault is BoardFault.NONE, RefusalReason.FAULTY)
    require(not board.moving and not board.stream.playing, RefusalReason.BUSY)
    board.homing = {axis: HomingAxis(axis, board.drives[axis], board.parameters) for axis in axes}


def _begin_profile(board: BoardFirmware, command: host_messages.BeginProfile) -> None:
    axis = require_axis(board, command.axis)
    require(0 < command.segments <= MAX_PROFILE_SEGMENTS, RefusalReason.BAD_VALUE)
    require(not board.profile.running and not board.stream.playing, RefusalReason.BUSY)
    board.profile.begin(axis, command.segments)


def _load_segments(board: BoardFirmware, command: host_messages.LoadSegments) -> None:
    require(all(segment.ticks for segment in command.unpack_segments()), RefusalReason.BAD_VALUE)
    require(not board.profile.running and board.profile.trigger is None, RefusalReason.BUSY)
    require(board.profile.add_segments(command), RefusalReason.OUT_OF_ORDER)


def _arm_profile(board: BoardFirmware, command: host_messages.ArmProfile) -> None:
    profile = board.profile
    require(profile.complete, RefusalReason.OUT_OF_ORDER)
    require_free(board)
    require(
        command.trigger in (0, 1) and command.check == profile.checksum, RefusalReason.BAD_VALUE
    )
    max_speed = board.parameters.get_max_speed(profile.axis) * board.tick_s + ROUNDING_STEPS
    require(profile.compute_max_speed() <= max_speed, RefusalReason.BAD_VALUE)
    profile.trigger = command.trigger


def _trigger_profile(board: BoardFirmware, _: host_messages.TriggerProfile) -> None:
    require(board.profile.trigger == 0, RefusalReason.OUT_OF_ORDER)
    require_free(board)
    start_profile(board)


def start_profile(board: BoardFirmware) -> None:
    """Start the armed profile at the next tick. If its axis moves, halt with a PROFILE fault."""
    drive = board.drives[board.profile.axis]
    if drive.moving:
        board.halt(BoardFault.PROFILE)
        return
    board.profile.start(board.latest_tick, drive.position)


def press_buttons(board: BoardFirmware, buttons: int) -> None:
    """Set the pressed buttons, as bits. The first button triggers a profile that waits for it."""
    newly_pressed = buttons & ~board.buttons & 1
    board.buttons = buttons
    is_waiting = board.profile.trigger == 1 and not board.stream.playing and not board.homing
    if newly_pressed and is_waiting:
        start_profile(board)


def _abort_profile(board: BoardFirmware, _: host_messages.AbortProfile) -> None:
    board.end_profile()


HANDLERS: tuple[
    tuple[type[WireMessage], Callable[[BoardFirmware, Any], WireMessage | None]], ...
] = (
    (host_messages.MoveTo, _move_to),
    (host_messages.MoveVelocity, _move_velocity),
    (host_messages.BeginStream, _begin_stream),
    (host_messages.StreamSegment, _queue_set_point),
    (host_messages.SetVoltage, _set_voltage),
    (host_messages.HomeAxes, _home),
    (host_messages.BeginProfile, _begin_profile),
    (host_messages.LoadSegments, _load_segments),
    (host_messages.ArmProfile, _arm_profile),
    (host_messages.TriggerProfile, _trigger_profile),
    (host_messages.AbortProfile, _abort_profile),
)
