"""The nominal plant: what the model believes of a machine, sampled exactly."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.plant import kernel
from rotemina.sim.plant.equilibrium import rest
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.group import Group, groups_of
from rotemina.sim.plant.sampling import Segments, cut, step_matrices
from rotemina.sim.robot.model import Axis, CascadeController, PiezoAxis, Robot, StepperAxis


class Motion(NamedTuple):
    """Response at n samples of all axes of a plant, each (n, axes), in the plant's order.

    ``position`` m or rad, ``velocity`` m/s or rad/s (zero for static axes), ``inputs`` V, or the
    commanded position of a stepper.
    """

    position: FloatArray
    velocity: FloatArray
    inputs: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class PlantState:
    """Where a run stands, with the samples whose inputs still act or have yet to act.

    ``time_s`` (h,), and ``inputs``, ``position``, ``velocity`` (h, axes) of the last h samples;
    the very last is the present.
    """

    time_s: FloatArray
    inputs: FloatArray
    position: FloatArray
    velocity: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Plant:
    """A robot prepared for simulation; make one by :meth:`of`.

    ``axes`` are those of ``robot``, in its order; ``loops`` the controllers that are closed.
    """

    robot: Robot
    axes: tuple[str, ...]
    groups: tuple[Group, ...]
    loops: tuple[CascadeController | None, ...]

    @classmethod
    def of(
        cls, robot: Robot, *, closed_loop: bool = False, only: Collection[str] | None = None
    ) -> Self:
        """Prepare a robot.

        Parameters
        ----------
        robot : Robot
        closed_loop : bool
            Put every axis that has a controller under it.
        only : collection of str, optional
            Simulate these axes and those that a coupling joins to them; all by default.
        """
        groups = groups_of(robot)
        if only is not None:
            groups = tuple(group for group in groups if set(only) & set(group.axes))
            joined = {name for group in groups for name in group.axes} | set(only)
            robot = _restricted(robot, joined)
        axes = tuple(robot.axes)
        loops = tuple(_controller(robot, name) if closed_loop else None for name in axes)
        return cls(robot, axes, groups, loops)

    def open_loop_inputs(self, command: FloatArray) -> FloatArray:
        """Return the inputs (n, axes) that a command (n, axes) asks for.

        V for piezos, the command itself for steppers; none (0 V) for axes moved by a force, whose
        voltage a command does not tell.
        """
        share = np.array([_input_per_command(axis) for axis in self.robot.axes.values()])
        with np.errstate(over="ignore"):  # found, and said, after the run
            return np.asarray(np.where(share != 0.0, command, 0.0) * share)

    def at_rest(self, time_s: float, command: FloatArray) -> PlantState:
        """Return the state in equilibrium with ``command`` (axes,), at ``time_s``.

        An axis that a force moves is at its command, at rest.
        """
        inputs = self.open_loop_inputs(command[None])[0]
        position = self._static_position(inputs[None])[0]
        for group in self.groups:
            index = self._index(group)
            loops = tuple(self.loops[i] for i in index)
            position[index], inputs[index] = rest(group, inputs[index], command[index], loops)
        return self.at(time_s, inputs, position, np.zeros(len(self.axes)))

    def at(
        self, time_s: float, inputs: FloatArray, position: FloatArray, velocity: FloatArray
    ) -> PlantState:
        """Return a given state, each (axes,), under inputs that hold until the first sample."""
        return PlantState(np.array([time_s]), inputs[None], position[None], velocity[None])

    def advance(
        self,
        state: PlantState,
        time_s: FloatArray,
        command: FloatArray,
        *,
        add: FloatArray | None = None,
        inputs: FloatArray | None = None,
    ) -> tuple[Motion, PlantState]:
        """Sample the response to ``command`` and return it with the state after it.

        Parameters
        ----------
        state : PlantState
            From :meth:`at_rest`, :meth:`at` or an earlier call.
        time_s : (n,)
            Sample times, increasing, from the state's time on (at that very time, the state is
            the first sample). A response is sampled at
            ``time_s[k]`` before ``command[k]`` acts.
        command : (n, axes)
            m or rad.
        add : (n, axes), optional
            V, added to the controllers' outputs.
        inputs : (n, axes), optional
            Inputs of the axes without a closed loop instead of those that the command asks for:
            what an amplifier really put out, V.

        Raises
        ------
        PlantError
            If the response leaves what a float can hold, with axis and time.
        """
        # A sample at the state's own time replaces it; later ones find it as their history.
        history = len(state.time_s) if time_s[0] > state.time_s[-1] else 0
        given = self.open_loop_inputs(command) if inputs is None else inputs
        stack = _Stack(
            first=history,
            time_s=np.concatenate([state.time_s[:history], time_s]),
            inputs=np.concatenate([state.inputs[:history], given]),
            position=_extended(state.position[:history], len(time_s)),
            velocity=_extended(state.velocity[:history], len(time_s)),
            command=np.ascontiguousarray(command),
            add=np.empty((0, len(self.axes))) if add is None else np.ascontiguousarray(add),
        )
        if any(axis.static for axis in self.robot.axes.values()):
            stack.position[history:] = self._static_position(stack.inputs[history:])
            stack.velocity[history:] = 0.0
        delays = self._delays()
        segments = cut(stack.time_s, history, delays)
        for group in self.groups:
            self._run(group, stack, segments, delays, state)
        self._check(stack, history)
        motion = Motion(
            *(array[history:] for array in (stack.position, stack.velocity, stack.inputs))
        )
        return motion, self._after(stack)

    def _run(
        self,
        group: Group,
        stack: "_Stack",
        segments: Segments,
        delays: tuple[float, ...],
        state: PlantState,
    ) -> None:
        index = self._index(group)
        loops = [self.loops[i] for i in index]
        state_step, input_step = step_matrices(group, segments.lengths_s)
        kernel.run(
            state_step,
            input_step,
            segments.step,
            segments.sample,
            segments.applied,
            np.array([delays.index(_delay(loop)) for loop in loops], dtype=np.int64),
            index,
            stack.first,
            stack.time_s,
            stack.command,
            stack.add,
            np.array([_loop_code(loop) for loop in loops], dtype=np.int64),
            np.array([_loop_gains(loop) for loop in loops]),
            stack.inputs,
            stack.position,
            stack.velocity,
            np.concatenate([state.position[-1, index], state.velocity[-1, index]]),
        )

    def _delays(self) -> tuple[float, ...]:
        """Return the different delays of the axes' inputs, s."""
        return tuple(sorted({_delay(loop) for loop in self.loops}))

    def _static_position(self, inputs: FloatArray) -> FloatArray:
        """Position (n, axes) of the static axes, ``gain·u`` or the command; 0 for the others."""
        gains = []
        for axis in self.robot.axes.values():
            static_gain = 1.0 if isinstance(axis, StepperAxis) else axis.gain
            gains.append(static_gain if axis.static else 0.0)
        static: FloatArray = np.array(gains)
        return np.asarray(np.where(static != 0.0, inputs, 0.0) * static)

    def _index(self, group: Group) -> IntArray:
        return np.array([self.axes.index(name) for name in group.axes], dtype=np.int64)

    def _after(self, stack: "_Stack") -> PlantState:
        """Keep the present and every sample whose delayed input has yet to act or acts now."""
        since_s = stack.time_s[-1] - max(self._delays())
        first = int(np.searchsorted(stack.time_s, since_s, side="right")) - 1
        first = max(first, 0)
        return PlantState(
            stack.time_s[first:].copy(),
            stack.inputs[first:].copy(),
            stack.position[first:].copy(),
            stack.velocity[first:].copy(),
        )

    def _check(self, stack: "_Stack", history: int) -> None:
        finite = np.isfinite(stack.position)
        if finite.all():
            return
        row = int(np.argmax(~finite.all(axis=1)))
        axis = self.axes[int(np.argmax(~finite[row]))]
        raise PlantError(
            f"axis {axis}: the response grows beyond what a number can hold at "
            f"t = {stack.time_s[row]:.6g} s; check the commands and the controller's gains"
        )


class _Stack(NamedTuple):
    """All arrays of one call: history rows first, but for ``command`` and ``add``."""

    first: int
    time_s: FloatArray
    inputs: FloatArray
    position: FloatArray
    velocity: FloatArray
    command: FloatArray
    add: FloatArray


def _extended(history: FloatArray, rows: int) -> FloatArray:
    """Return room for ``rows`` more rows behind those of the history."""
    extended = np.empty((len(history) + rows, history.shape[1]))
    extended[: len(history)] = history
    return extended


def _restricted(robot: Robot, names: Collection[str]) -> Robot:
    """Return the robot with some of its axes alone."""
    return replace(
        robot,
        axes={name: axis for name, axis in robot.axes.items() if name in names},
        couplings=tuple(c for c in robot.couplings if set(c.axes) <= set(names)),
        stages={},
    )


def _input_per_command(axis: Axis) -> float:
    if isinstance(axis, PiezoAxis):
        return 1.0 / axis.gain
    return 1.0 if isinstance(axis, StepperAxis) else 0.0


def _controller(robot: Robot, name: str) -> CascadeController | None:
    axis = robot.axes[name]
    return None if isinstance(axis, StepperAxis) else axis.controller


def _delay(loop: CascadeController | None) -> float:
    return loop.delay_s if loop else 0.0


def _loop_code(loop: CascadeController | None) -> int:
    if loop is None:
        return kernel.NO_LOOP
    return kernel.STATE_VELOCITY if loop.velocity == "state" else kernel.BACKWARD_VELOCITY


def _loop_gains(loop: CascadeController | None) -> tuple[float, float, float]:
    return (loop.kp, loop.kv, loop.limit) if loop else (0.0, 0.0, 0.0)
