"""A machine as the model sees it: the nominal plant with whatever effects sit on it, sampled."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.messages import message
from rotemina.sim.plant import kernel
from rotemina.sim.plant.assembly import Assembly, assemble
from rotemina.sim.plant.clocks import ROWS, on_skewed_clocks
from rotemina.sim.plant.coupled_groups import Group
from rotemina.sim.plant.equilibrium import rest
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.perturbation import Perturbation
from rotemina.sim.plant.plant_arrays import Machine, phase_of, states_of
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.plant.segment_steps import steps_of_run
from rotemina.sim.plant.settling import lead_of
from rotemina.sim.plant.state import Behind, Motion, PlantState, Stack
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.model import CascadeController, ForceAxis, Robot

_TRIES = 50  # of the input with which a controller holds an axis
_HELD = 1e-12  # relative change of that input which is none


@dataclass(frozen=True, slots=True, eq=False)
class Plant:
    """A robot prepared for simulation; make one by :meth:`of`.

    ``axes`` are those of ``robot``, in its order; ``groups`` those with dynamics, coupled;
    ``loops`` the controllers that are closed.
    """

    robot: Robot
    axes: tuple[str, ...]
    groups: tuple[Group, ...]
    loops: tuple[CascadeController | None, ...]
    assembly: Assembly

    @classmethod
    def of(
        cls, robot: Robot, *, closed_loop: bool = False, only: Collection[str] | None = None
    ) -> Self:
        """Prepare a robot with its effects.

        Parameters
        ----------
        robot : Robot
        closed_loop : bool
            Put every axis that has a controller under it.
        only : collection of str, optional
            Simulate these axes and those that a coupling or an effect joins to them; all by
            default.

        Raises
        ------
        EffectError
            If an effect of the robot cannot be used.
        """
        assembly = assemble(robot, only)
        robot = assembly.robot
        axes = tuple(robot.axes)
        loops = tuple(one.controller if closed_loop else None for one in robot.axes.values())
        return cls(robot, axes, assembly.groups, loops, assembly)

    @property
    def effects(self) -> Sequence[Attached]:
        """The effects that act, in the robot's order."""
        return self.assembly.effects

    def open_loop_inputs(self, command: FloatArray) -> FloatArray:
        """Return the inputs (n, axes) that a command (n, axes) asks for.

        V for piezos, the command itself for steppers; none (0 V) for axes moved by a force, whose
        voltage a command does not tell.
        """
        axes = self.robot.axes.values()
        share = np.array([0.0 if isinstance(one, ForceAxis) else 1.0 / one.gain for one in axes])
        with np.errstate(over="ignore"):  # found, and said, after the run
            return np.asarray(command * share)

    def at_rest(self, time_s: float, command: FloatArray) -> PlantState:
        """Return the state in equilibrium with ``command`` (axes,), at ``time_s``.

        An axis that a force moves is at its command, at rest. Effects with memory are as after a
        rise from the low end of the range, long ago.
        """
        return replace(
            _rest(self, np.asarray(command, dtype=np.float64).tobytes()), time_s=np.array([time_s])
        )

    def _equilibrium(self, command: FloatArray) -> PlantState:
        """Return the state at rest at time 0."""
        inputs = self.open_loop_inputs(command[None])[0]
        risen, reached = self._risen(inputs)
        position, held = self._rest(inputs, reached, command)
        for _ in range(_TRIES):  # a controller holds the axis against what effects make of its u
            if not self.effects or np.allclose(held, inputs, rtol=_HELD, atol=0.0):
                break
            inputs = held
            risen, reached = self._risen(inputs)
            position, held = self._rest(inputs, reached, command)
        inputs = held
        still = np.zeros(len(self.axes))
        state = self._placed(0.0, inputs, position, still, risen, reached)
        return self._led_in(state, reached, command) if self.assembly.leads_in else state

    def _rest(
        self, inputs: FloatArray, reached: FloatArray, command: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return positions (axes,) at rest, and the inputs with those that controllers give there.

        ``inputs`` become ``reached`` by effects, and those of controllers change alike.
        """
        position, held = self._static_position(reached[None])[0], inputs.copy()
        for group in self.groups:
            index = self._index(group)
            loops = tuple(self.loops[i] for i in index)
            gained = (reached - inputs)[index]
            position[index], settled = rest(group, reached[index], command[index], loops, gained)
            looped = [loop is not None for loop in loops]
            held[index[looped]] = settled[looped]
        return position, held

    def at(
        self, time_s: float, inputs: FloatArray, position: FloatArray, velocity: FloatArray
    ) -> PlantState:
        """Return a given state, each (axes,), under inputs that hold until the first sample."""
        return self._placed(time_s, inputs, position, velocity, *self._risen(inputs))

    def _risen(self, inputs: FloatArray) -> tuple[kernel.State, FloatArray]:
        """Return a state whose inputs rose long ago, and the inputs that reach the mechanics."""
        assembly = self.assembly
        state = kernel.State(
            np.zeros(sum(group.states for group in assembly.all_groups)),
            np.zeros(assembly.memory),
            np.zeros(len(assembly.functions)),
        )
        if not self.effects:
            return state, inputs
        low = self.open_loop_inputs(self._low[None])[0]
        return state, kernel.rise_inputs(assembly.machine, state, low, inputs)

    def _placed(
        self,
        time_s: float,
        inputs: FloatArray,
        position: FloatArray,
        velocity: FloatArray,
        risen: kernel.State,
        reached: FloatArray,
    ) -> PlantState:
        """Return a state whose axes are at ``position`` with ``velocity``, each (axes,)."""
        groups = self.assembly.all_groups
        for group, first in zip(groups, self.assembly.machine.group["first"], strict=True):
            index = self._index(group)
            own = group.settled(position[index], reached[index])
            if not group.static:
                own[group.size : 2 * group.size] = velocity[index]
            risen.x[first : first + group.states] = own
        if self.effects:
            kernel.rise_positions(self.assembly.machine, risen, self._low, reached)
        offset = np.array([axis.offset for axis in self.robot.axes.values()])
        return PlantState(
            np.array([time_s]),
            inputs[None],
            position[None],
            velocity[None],
            (position + offset)[None],
            0.0,
            np.zeros(len(self.axes)),
            *risen,
        )

    def _led_in(self, state: PlantState, reached: FloatArray, command: FloatArray) -> PlantState:
        """Return the state at rest that is found by letting the machine come to it."""
        lead = lead_of(self.axes, self.effects)
        back = lead.below / self.assembly.machine.axis["asked"]
        _, after = self.advance(
            state,
            lead.time_s + state.time_s[-1],
            np.tile(command, (len(back), 1)),
            inputs=reached - back,
            behind=Behind.ACTUATOR,
        )
        memory = state.memory.copy()
        for one, function in zip(
            self.assembly.functions, self.assembly.machine.function, strict=True
        ):
            if phase_of(one) == "force":
                own = slice(function["memory_at"], function["memory_at"] + states_of(one))
                memory[own] = after.memory[own]
        looped = np.array([loop is not None for loop in self.loops])
        inputs = np.where(looped, after.inputs[-1:], state.inputs)
        settled = kernel.State(after.x, memory, state.seen.copy())
        kernel.rise_positions(self.assembly.machine, settled, self._low, reached)
        return replace(state, inputs=inputs, x=after.x, memory=memory, seen=settled.seen)

    @property
    def _low(self) -> FloatArray:
        """The low ends (axes,) of the ranges."""
        return np.array([axis.range[0] for axis in self.robot.axes.values()], dtype=np.float64)

    def advance(
        self,
        state: PlantState,
        time_s: FloatArray,
        command: FloatArray,
        *,
        add: FloatArray | None = None,
        inputs: FloatArray | None = None,
        behind: Behind = Behind.COMMAND,
        perturbation: Perturbation | None = None,
        chance: Chance | None = None,
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
            Inputs of the axes without a closed loop instead of those that the command asks for, V.
        behind : Behind
            What the inputs have passed already: effects before it are left out.
        perturbation : Perturbation, optional
            Q of Eq. (1), n rows; for every piece of a run that is shaken.
        chance : Chance, optional
            Noise, rounding and random effects; without it the plant is what a model can know.

        Raises
        ------
        PlantError
            If the response leaves what a float can hold, with axis and time, or a perturbation does
            not fit or ends without a row of zeros.
        """
        # A sample at the state's own time replaces it; later ones find it as their history.
        history = len(state.time_s) if time_s[0] > state.time_s[-1] else 0
        asked = self.open_loop_inputs(command) if inputs is None else np.array(inputs, order="C")
        stack = Stack.of(state, history, time_s, asked)
        # Effects count time from the start of the run, whatever the samples' times count from.
        clock_s = stack.time_s + (state.elapsed_s - state.time_s[-1])
        given = self._given(
            state.perturbation, clock_s[history:], history, command, add, perturbation, chance
        )
        given = given._replace(time_s=clock_s)
        electronics = self.assembly.electronics & (behind is Behind.COMMAND)
        effort = np.empty_like(stack.inputs[: len(stack.inputs) if electronics.any() else 0])
        moved = kernel.State(state.x.copy(), state.memory.copy(), state.seen.copy())
        acting = self._acting(stack, behind)
        kernel.run(
            _machine(self, behind),
            self.steps(stack.time_s, history, behind),
            given,
            acting.taken(effort),
            moved,
            float(clock_s[max(history - 1, 0)]),
        )
        looped = np.array([loop is not None for loop in self.loops])
        stack.inputs[:, looped] = acting.inputs[:, looped]
        self._check(stack)
        effort = np.where(electronics, effort, stack.inputs) if len(effort) else stack.inputs
        reading = on_skewed_clocks(
            self.assembly.skews,
            stack.position,
            stack.reading,
            clock_s,
            self.robot,
            rounded=chance is not None,
        )
        last = state.perturbation if perturbation is None else perturbation.acceleration[-1]
        new = slice(history, None)
        motion = Motion(stack.position[new], stack.velocity[new], effort[new], reading[new])
        return motion, self._after(stack, moved, float(clock_s[-1]), last)

    def _given(
        self,
        shaken: FloatArray,
        clock_s: FloatArray,
        first: int,
        command: FloatArray,
        add: FloatArray | None,
        perturbation: Perturbation | None,
        chance: Chance | None,
    ) -> kernel.Given:
        axes, rows = len(self.axes), len(clock_s)
        force, kick = np.zeros((0, axes)), np.zeros((0, 0))
        if perturbation is None and shaken.any():
            raise PlantError(
                message(
                    "engine",
                    "perturbation: none is given, but Q of the previous row still acts; pass "
                    "one for every piece of a run, with zeros where nothing shakes",
                )
            )
        if perturbation is not None:
            perturbation.check(rows, self.axes)
            force = perturbation.forces(shaken)
            kick = perturbation.kicks(shaken, self.axes, self.assembly.all_groups)
        drawn = np.zeros((0, axes))
        if chance is not None:
            drawn = chance.draw(rows, axes, self.assembly.random)
        return kernel.Given(
            first,
            _only_read(clock_s),
            _only_read(command),
            _only_read(np.zeros((0, axes)) if add is None else add),
            force,
            kick,
            drawn,
        )

    def _acting(self, stack: Stack, behind: Behind) -> Stack:
        """Return the rows with the inputs of static axes as late as they act.

        Such an axis is at once where its input puts it, so it is read with a row's own input. One
        that comes late by less than a row is taken to be on its way there, in a straight line: so
        it passes from no delay to a whole row without a leap, and is right at both.
        """
        late = _lateness(self, behind).of_static
        if not late.any():
            return stack
        inputs = stack.inputs.copy()
        for column in np.flatnonzero(late):
            acts_s = stack.time_s - late[column]
            inputs[:, column] = np.interp(acts_s, stack.time_s, stack.inputs[:, column])
        return stack._replace(inputs=inputs)

    def _lateness(self, behind: Behind) -> "_Lateness":
        at_once = [
            axis.static and loop is None
            for axis, loop in zip(self.robot.axes.values(), self.loops, strict=True)
        ]
        delays_s = self._delays(behind)
        of_static = np.where(at_once, delays_s, 0.0)
        between = tuple(np.asarray(delays_s) - of_static)
        return _Lateness(of_static, between, tuple(sorted(set(between))))

    def steps(self, time_s: FloatArray, first: int, behind: Behind) -> kernel.Steps:
        """Return the steps through samples (n,), of which those before ``first`` are history."""
        return steps_of_run(
            time_s,
            first,
            _lateness(self, behind).distinct,
            self.assembly.all_groups,
            inner_step_s=self.assembly.inner_step_s,
            may_grow=self.assembly.steps_may_grow,
            with_holds=bool(self.effects),
        )

    def machine(self, behind: Behind) -> Machine:
        """Return the tables with the loops entered."""
        machine = self.assembly.machine
        axis = machine.axis.copy()
        _, between, distinct = _lateness(self, behind)
        axis["late"] = [distinct.index(delay) for delay in between]
        for row, loop in zip(axis, self.loops, strict=True):
            if loop is None:
                row["part"] = behind
            else:
                row["kp"], row["kv"], row["limit"] = loop.kp, loop.kv, loop.limit
                by_state = loop.velocity == "state"
                row["loop"] = kernel.STATE_VELOCITY if by_state else kernel.BACKWARD_VELOCITY
        return machine._replace(axis=axis)

    def _delays(self, behind: Behind = Behind.COMMAND) -> tuple[float, ...]:
        """Return the delay of each axis' input, s; what is late, is so before the amplifier."""
        late = self.assembly.delays_s
        return tuple(
            loop.delay_s + late[i] if loop else late[i] * (behind is Behind.COMMAND)
            for i, loop in enumerate(self.loops)
        )

    def _static_position(self, inputs: FloatArray) -> FloatArray:
        """Position (n, axes) of the static axes, ``gain·u`` or the command; 0 for the others."""
        axes = self.robot.axes.values()
        static: FloatArray = np.array([axis.gain if axis.static else 0.0 for axis in axes])
        return np.asarray(np.where(static != 0.0, inputs, 0.0) * static)

    def _index(self, group: Group) -> IntArray:
        return np.array([self.axes.index(name) for name in group.axes], dtype=np.int64)

    def _after(
        self, stack: Stack, moved: kernel.State, elapsed_s: float, perturbation: FloatArray
    ) -> PlantState:
        """Keep the present and every sample whose delayed input has yet to act or acts now."""
        lag_s = max(self.assembly.skews.values(), default=0.0) * elapsed_s
        since_s = stack.time_s[-1] - max(*self._delays(), lag_s, 0.0)
        first = int(np.searchsorted(stack.time_s, since_s, side="right")) - 1
        first -= ROWS if self.assembly.skews else 0
        kept = slice(max(first, 0), None)
        return PlantState(
            stack.time_s[kept].copy(),
            stack.inputs[kept].copy(),
            stack.position[kept].copy(),
            stack.velocity[kept].copy(),
            stack.reading[kept].copy(),
            elapsed_s,
            perturbation,
            moved.x,
            moved.memory,
            moved.seen,
        )

    def _check(self, stack: Stack) -> None:
        with np.errstate(over="ignore", invalid="ignore"):
            if np.isfinite(stack.position.sum()):  # one pass without room for an answer per row
                return
        finite = np.isfinite(stack.position[stack.first :])
        if finite.all():
            return
        row = int(np.argmax(~finite.all(axis=1)))
        axis = self.axes[int(np.argmax(~finite[row]))]
        named = "".join(f" {one.asked.id} on {one.asked.axis}," for one in self.effects)
        raise PlantError(
            message(
                "engine",
                "axis {axis}: the response grows without bound at t = {time_s} s; check the "
                "commands,{named} and the controller's gains",
            ).fill(axis=axis, time_s=rounded(stack.time_s[stack.first + row], 6), named=named)
        )


class _Lateness(NamedTuple):
    """Delays, s.

    ``of_static`` (axes,) are those of static axes without a loop, 0 of others. Inputs of the others
    act ``between`` rows; these delays are ``distinct`` when sorted.
    """

    of_static: FloatArray
    between: tuple[float, ...]
    distinct: tuple[float, ...]


@lru_cache(maxsize=32)
def _lateness(plant: Plant, behind: Behind) -> _Lateness:
    return plant._lateness(behind)


@lru_cache(maxsize=32)
def _machine(plant: Plant, behind: Behind) -> Machine:
    return plant.machine(behind)


@lru_cache(maxsize=32)
def _rest(plant: Plant, command: bytes) -> PlantState:
    """Return the rest at a command, which many runs begin from: nobody may change it."""
    state = plant._equilibrium(np.frombuffer(command))
    for name in state.__slots__:
        value = getattr(state, name)
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return state


def _only_read(values: FloatArray) -> FloatArray:
    """Return values that nobody may change, so that one kind of rows is compiled for, not two."""
    values = np.ascontiguousarray(values).view()
    values.flags.writeable = False
    return values
