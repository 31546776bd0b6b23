"""Driver of the MC68HC11 boards.

Only the one thread that uses the driver exchanges frames with the boards. The exception is a stop,
which the calling thread writes to the ports itself.
"""

from dataclasses import replace
from functools import partial
from math import ceil

from rotemina.drivers.abilities import AxisHomer, TrajectoryPlayer, VelocityMover, VoltageOutput
from rotemina.drivers.contract import DeviceAxis, DeviceState, Permit, StateError
from rotemina.drivers.mc68hc11.board_services import BoardServices
from rotemina.drivers.mc68hc11.connection import BoardConnection
from rotemina.drivers.mc68hc11.protocol import (
    MAX_CONVERTER_CODE,
    PARAMETERS_PER_AXIS,
    BoardAbility,
    BoardAxis,
    HomeAxes,
    MoveTo,
    MoveVelocity,
    SetVoltage,
    WireMessage,
)
from rotemina.drivers.mc68hc11.segment_player import SegmentPlayer
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName
from rotemina.sim.records import Record
from rotemina.sim.robot import StepperAxis

# Indices within the parameters of an axis.
_LOW_INDEX, _HIGH_INDEX, _SPEED_INDEX, _MIN_CODE_MV_INDEX, _MAX_CODE_MV_INDEX = 0, 1, 2, 4, 5


class BoardMotion(BoardConnection, TrajectoryPlayer, VelocityMover, AxisHomer, VoltageOutput):
    """Motion of the axes, by the ramps of the boards or by set-points."""

    @property
    def descriptions(self) -> tuple[DeviceAxis, ...]:
        """Descriptions of the axes, with the boards' step sizes, and ranges in whole steps."""
        return tuple(self._describe_axis(description) for description in super().descriptions)

    @property
    def homing_axes(self) -> tuple[str, ...]:
        """Stepper axes. A piezo needs no homing, because its sensor is absolute."""
        return tuple(
            name for name, axis in self.robot.axes.items() if isinstance(axis, StepperAxis)
        )

    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        self._prepare_action("move")
        for name, target in targets.items():
            board, axis = self._open_session.find_axis(name)
            low, high = self._find_ends(name)
            steps = min(max(axis.to_steps(target), low), high)
            speed = self._find_max_speed(name)
            if name in speeds:
                speed = min(max(axis.to_steps(speeds[name]), 1), speed)
            message = MoveTo(axis.number, steps, speed)
            board.orders.queue_order(("axis", axis.number), message, permit=permit)
        self._serve()

    def _move_velocity(self, velocities: dict[str, float], lease_s: float, permit: Permit) -> None:
        self._prepare_action("move")
        now_s = self.clock()
        for name, velocity in velocities.items():
            board, axis = self._open_session.find_axis(name)
            max_speed = self._find_max_speed(name)
            speed = min(max(axis.to_steps(velocity), -max_speed), max_speed)
            # A motion must not start late, so its order expires. An order to halt never does.
            expires_s = now_s + 0.5 * lease_s if speed else float("inf")
            make_message = partial(_make_velocity_message, axis.number, speed, now_s + lease_s)
            key = ("axis", axis.number)
            board.orders.queue_order(
                key, make_message, expires_s=expires_s, permit=permit, halts=not speed
            )
        self._serve()

    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        self._prepare_action("home")
        self._axes_being_homed = set(axes)
        self._untrusted_axes |= self._axes_being_homed
        session = self._open_session
        for board in session.boards:
            numbers = [axis.number for axis in board.axes if axis.name in axes]
            if numbers:
                message = HomeAxes(sum(1 << number for number in numbers))
                board.orders.queue_order("home", message, DeviceState.HOMING, permit=permit)
        self._serve()

    def _set_voltage(self, axis: str, voltage: float, permit: Permit) -> None:
        self._prepare_action("set a voltage")
        board, board_axis = self._open_session.find_axis(axis)
        parameter_check = self._open_session.parameter_check
        first_v = 1e-3 * parameter_check.get_board_value(
            board, PARAMETERS_PER_AXIS * board_axis.number + _MIN_CODE_MV_INDEX
        )
        last_v = 1e-3 * parameter_check.get_board_value(
            board, PARAMETERS_PER_AXIS * board_axis.number + _MAX_CODE_MV_INDEX
        )
        if last_v <= first_v:
            raise StateError(
                "{where}: according to its parameters, the voltage of axis {axis} goes from "
                "{first} V to {last} V; write the parameters of the robot file to the board",
                where=board.where,
                axis=AxisName(axis),
                first=first_v,
                last=last_v,
            )
        code = min(
            max(round((voltage - first_v) / (last_v - first_v) * MAX_CONVERTER_CODE), 0),
            MAX_CONVERTER_CODE,
        )
        order = SetVoltage(board_axis.number, code)
        board.orders.queue_order(("axis", board_axis.number), order, permit=permit)
        self._serve()

    def _play(self, trajectory: Record, permit: Permit) -> None:
        self._prepare_action("play")
        session = self._open_session
        for board in session.boards:
            if not board.has_ability(BoardAbility.SETPOINTS):
                raise StateError(
                    "{name}: {where} cannot play trajectories", name=self.name, where=board.where
                )
        speeds = {name: self._find_max_speed(name) for name in self.axes}
        ends = {name: self._find_ends(name) for name in self.axes}
        session.player = session.latest_player = SegmentPlayer(
            trajectory,
            session.boards,
            speeds,
            ends,
            self._settle_s,
            permit,
            session.samples_per_setpoint,
        )
        self._progress = 0.0
        self._serve()

    def _describe_axis(self, description: DeviceAxis) -> DeviceAxis:
        try:
            axis = BoardAxis.from_robot(self.robot, description.name, 0)
        except InputError:
            # No board can move this axis. Opening the driver reports it.
            return description
        low, high = (
            axis.to_si(end) for end in axis.to_step_range(description.low, description.high)
        )
        return replace(description, low=low, high=high, resolution=axis.step_size)

    def _find_ends(self, name: str) -> tuple[int, int]:
        """Return the lowest and the highest step that both the robot file and the board allow."""
        board, axis = self._open_session.find_axis(name)
        low, high = axis.to_step_range(*self.robot.axes[name].range)
        parameter_check = self._open_session.parameter_check
        first_index = PARAMETERS_PER_AXIS * axis.number
        board_low, board_high = (
            parameter_check.get_board_value(board, first_index + _LOW_INDEX),
            parameter_check.get_board_value(board, first_index + _HIGH_INDEX),
        )
        return max(low, board_low), min(high, board_high)

    def _find_max_speed(self, name: str) -> int:
        """Return the maximum speed that both the robot file and the board allow, steps/s."""
        board, axis = self._open_session.find_axis(name)
        parameter_check = self._open_session.parameter_check
        index = PARAMETERS_PER_AXIS * axis.number + _SPEED_INDEX
        return max(
            1,
            min(
                parameter_check.get_robot_value(board, index),
                parameter_check.get_board_value(board, index),
            ),
        )


def _make_velocity_message(axis: int, speed: int, lease_end_s: float, now_s: float) -> WireMessage:
    lease_ms = ceil(1e3 * (lease_end_s - now_s)) if speed else 1
    return MoveVelocity(axis, speed, max(lease_ms, 1))


class MC68HC11Driver(BoardMotion, BoardServices):
    """Driver of one or two MC68HC11 boards on serial lines.

    The settings are:

    - ``port``: a device, or a URL of pyserial
    - ``second_port``: port of the second board. Leave it empty for a robot of up to three axes,
      and for two boards on one shared bus.
    - ``baud``: baud rate
    - ``settle_s``: time of rest at the first row of a trajectory, s
    - ``watchdog_s``: time without a message from this program after which a board halts, s
    - ``latency_s``: time that the operating system and adapters may add to a round trip, s. If
      a longer time is measured at opening, that time is used.

    Parameters
    ----------
    robot, settings, clock
        See :class:`rotemina.drivers.contract.Driver`.
    open_port : callable
        Return an open port for a URL and a baud rate.
    pause : callable
        Wait for some seconds. It is used only while the boards are opened.
    """
