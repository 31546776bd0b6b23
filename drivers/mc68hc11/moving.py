"""How the driver moves axes: targets, speeds, homing, voltages and trajectories."""

from dataclasses import replace
from functools import partial
from math import ceil

from rotemina.drivers.abilities import Homer, TrajectoryPlayer, VelocityMover, VoltageOutput
from rotemina.drivers.axes import AxisDescription
from rotemina.drivers.errors import StateError
from rotemina.drivers.gate import Permit
from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.mc68hc11.connection import Connected
from rotemina.drivers.mc68hc11.host_messages import Home, MoveTo, MoveVelocity, SetVoltage
from rotemina.drivers.mc68hc11.parameters import CODES, PER_AXIS
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.mc68hc11.protocol_codes import Ability
from rotemina.drivers.mc68hc11.segment_player import Player
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.messages import AxisName, message
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import StepperAxis

_LOW, _HIGH, _SPEED, _FIRST_MV, _LAST_MV = 0, 1, 2, 4, 5  # parameters of an axis


class Moving(Connected, TrajectoryPlayer, VelocityMover, Homer, VoltageOutput):
    """Motion of the axes, by the boards' own ramps or by set-points."""

    @property
    def descriptions(self) -> tuple[AxisDescription, ...]:
        """What the axes are, with the boards' steps, and the ends that lie on them."""
        return tuple(self._described(one) for one in super().descriptions)

    @property
    def homing_axes(self) -> tuple[str, ...]:
        """The steppers; a piezo's sensor always knows where it is."""
        return tuple(n for n, axis in self.robot.axes.items() if isinstance(axis, StepperAxis))

    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        self._prepare("move")
        for name, target in targets.items():
            board, axis = self._running.board_of(name)
            low, high = self._ends(name)
            steps = min(max(axis.steps(target), low), high)
            most = self._speed(name)
            if name in speeds:
                most = min(max(axis.steps(speeds[name]), 1), most)
            message = MoveTo(axis.number, steps, most)
            board.orders.give(("axis", axis.number), message, permit=permit)
        self._serve()

    def _move_velocity(self, velocities: dict[str, float], lease_s: float, permit: Permit) -> None:
        self._prepare("move")
        now_s = self.clock()
        for name, velocity in velocities.items():
            board, axis = self._running.board_of(name)
            most = self._speed(name)
            speed = min(max(axis.steps(velocity), -most), most)
            # What is said late is vouched for by no longer than it was asked; a halt always is.
            expires_s = now_s + 0.5 * lease_s if speed else float("inf")
            make = partial(_velocity, axis.number, speed, now_s + lease_s)
            key = ("axis", axis.number)
            board.orders.give(key, make, expires_s=expires_s, permit=permit, halts=not speed)
        self._serve()

    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        self._prepare("home")
        self._searched = set(axes)
        self._distrusted |= self._searched
        session = self._running
        for board in session.boards:
            own = [axis.number for axis in board.axes if axis.name in axes]
            if own:
                message = Home(sum(1 << number for number in own))
                board.orders.give("home", message, DeviceState.HOMING, permit=permit)
        self._serve()

    def _set_voltage(self, axis: str, voltage: float, permit: Permit) -> None:
        self._prepare("set a voltage")
        board, own = self._running.board_of(axis)
        trust = self._running.trust
        first = 1e-3 * trust.value(board, PER_AXIS * own.number + _FIRST_MV)
        last = 1e-3 * trust.value(board, PER_AXIS * own.number + _LAST_MV)
        if last <= first:
            raise StateError(
                message(
                    "engine",
                    "{where}: by its parameters the voltage of axis {axis} goes from {first} V to "
                    "{last} V; write the parameters of the robot file to the board",
                ).fill(where=board.where, axis=AxisName(axis), first=first, last=last)
            )
        code = min(max(round((voltage - first) / (last - first) * CODES), 0), CODES)
        order = SetVoltage(own.number, code)
        board.orders.give(("axis", own.number), order, permit=permit)
        self._serve()

    def _play(self, trajectory: Record, permit: Permit) -> None:
        self._prepare("play")
        session = self._running
        for board in session.boards:
            if not board.able(Ability.SETPOINTS):
                raise StateError(
                    message("engine", "{name}: {where} cannot play trajectories").fill(
                        name=self.name, where=board.where
                    )
                )
        speeds = {name: self._speed(name) for name in self.axes}
        ends = {name: self._ends(name) for name in self.axes}
        session.player = session.playback = Player(
            trajectory,
            session.boards,
            speeds,
            ends,
            self._settle_s,
            permit,
            session.setpoint_every,
        )
        self._progress = 0.0
        self._serve()

    def _described(self, own: AxisDescription) -> AxisDescription:
        try:
            axis = BoardAxis.of(self.robot, own.name, 0)
        except InputError:  # no board can move it; opening says so
            return own
        low, high = (axis.value(end) for end in axis.ends(own.low, own.high))
        return replace(own, low=low, high=high, resolution=axis.step)

    def _ends(self, name: str) -> tuple[int, int]:
        """Return the first and the last step that both the robot file and the board allow."""
        board, axis = self._running.board_of(name)
        low, high = axis.ends(*self.robot.axes[name].range)
        trust, first = self._running.trust, PER_AXIS * axis.number
        own_low, own_high = trust.value(board, first + _LOW), trust.value(board, first + _HIGH)
        return max(low, own_low), min(high, own_high)

    def _speed(self, name: str) -> int:
        """Return the greatest speed that both the robot file and the board allow, steps/s."""
        board, axis = self._running.board_of(name)
        trust, index = self._running.trust, PER_AXIS * axis.number + _SPEED
        return max(1, min(trust.wanted(board, index), trust.value(board, index)))


def _velocity(axis: int, speed: int, end_s: float, now_s: float) -> Message:
    left_ms = ceil(1e3 * (end_s - now_s)) if speed else 1
    return MoveVelocity(axis, speed, max(left_ms, 1))
