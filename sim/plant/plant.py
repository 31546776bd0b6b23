"""Model of a machine: the nominal plant with its effects, sampled."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.effects import AttachedEffect
from rotemina.sim.errors import PlantError
from rotemina.sim.messages import format_rounded
from rotemina.sim.plant import kernel
from rotemina.sim.plant.assembly import PlantAssembly, assemble
from rotemina.sim.plant.clocks import INTERPOLATION_ROWS, skew_readings
from rotemina.sim.plant.coupled_groups import AxisGroup
from rotemina.sim.plant.equilibrium import find_equilibrium
from rotemina.sim.plant.perturbation import Perturbation
from rotemina.sim.plant.plant_arrays import PlantTables, count_states, find_phase
from rotemina.sim.plant.random_draws import RandomStreams
from rotemina.sim.plant.segment_steps import make_steps_of_run
from rotemina.sim.plant.settling import make_settling_path
from rotemina.sim.plant.state import ChainPoint, PlantMotion, PlantState, SampleRows
from rotemina.sim.robot import (
    CascadeController,
    ForceAxis,
    Robot,
)

# The input with which a controller holds an axis is iterated until its relative change is smaller
# than the tolerance.
_MAX_ITERATIONS = 50
_INPUT_TOLERANCE_RATIO = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class Plant:
    """Robot prepared for simulation; create it with :meth:`of`.

    ``axes`` are the axes of ``robot``, in its order; ``groups`` are the groups of coupled axes with
    dynamics; ``loops`` are the controllers of the closed loops.
    """

    robot: Robot
    axes: tuple[str, ...]
    groups: tuple[AxisGroup, ...]
    loops: tuple[CascadeController | None, ...]
    assembly: PlantAssembly

    @classmethod
    def of(
        cls, robot: Robot, *, closed_loop: bool = False, only: Collection[str] | None = None
    ) -> Self:
        """Prepare a robot with its effects.

        Parameters
        ----------
        robot : Robot
        closed_loop : bool
            Close the loop of every axis that has a controller.
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
        loops = tuple(axis.controller if closed_loop else None for axis in robot.axes.values())
        return cls(robot, axes, assembly.groups, loops, assembly)

    @property
    def effects(self) -> Sequence[AttachedEffect]:
        """The active effects, in the robot's order."""
        return self.assembly.effects

    def compute_open_loop_inputs(self, command: FloatArray) -> FloatArray:
        """Return the inputs (n, axes) that a command (n, axes) requests.

        These are V for piezos, the command itself for steppers, and 0 V for axes that a force
        moves, because their command does not determine a voltage.
        """
        axes = self.robot.axes.values()
        input_per_position = np.array(
            [0.0 if isinstance(axis, ForceAxis) else 1.0 / axis.gain for axis in axes]
        )
        # An overflow is detected and reported after the run.
        with np.errstate(over="ignore"):
            return np.asarray(command * input_per_position)

    def find_rest_state(self, time_s: float, command: FloatArray) -> PlantState:
        """Return the state in equilibrium with ``command`` (axes,), at ``time_s``.

        An axis that a force moves rests at its command. Effects with memory are in the state after
        a rise from the low end of the range long ago.
        """
        return replace(
            _find_rest_state(self, np.asarray(command, dtype=np.float64).tobytes()),
            time_s=np.array([time_s]),
        )

    def _find_equilibrium(self, command: FloatArray) -> PlantState:
        inputs = self.compute_open_loop_inputs(command[None])[0]
        kernel_state, acting_inputs = self._simulate_rise(inputs)
        position, rest_inputs = self._find_rest(inputs, acting_inputs, command)
        # Effects change the input of a controller, so the input that holds the axis is iterated.
        for _ in range(_MAX_ITERATIONS):
            if not self.effects or np.allclose(
                rest_inputs, inputs, rtol=_INPUT_TOLERANCE_RATIO, atol=0.0
            ):
                break
            inputs = rest_inputs
            kernel_state, acting_inputs = self._simulate_rise(inputs)
            position, rest_inputs = self._find_rest(inputs, acting_inputs, command)
        inputs = rest_inputs
        zero_velocity = np.zeros(len(self.axes))
        state = self._place_axes(0.0, inputs, position, zero_velocity, kernel_state, acting_inputs)
        return (
            self._settle_from_below(state, acting_inputs, command)
            if self.assembly.needs_settling
            else state
        )

    def _find_rest(
        self, inputs: FloatArray, acting_inputs: FloatArray, command: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the rest positions (axes,), and the inputs that hold them there.

        ``acting_inputs`` are the ``inputs`` after the effects on them. Effects change the inputs of
        controllers by the same amount.
        """
        position, rest_inputs = self._compute_static_position(acting_inputs[None])[0], inputs.copy()
        for group in self.groups:
            columns = self._find_columns(group)
            loops = tuple(self.loops[i] for i in columns)
            effect_inputs = (acting_inputs - inputs)[columns]
            position[columns], holding_inputs = find_equilibrium(
                group, acting_inputs[columns], command[columns], loops, effect_inputs
            )
            has_loop = [loop is not None for loop in loops]
            rest_inputs[columns[has_loop]] = holding_inputs[has_loop]
        return position, rest_inputs

    def make_state(
        self, time_s: float, inputs: FloatArray, position: FloatArray, velocity: FloatArray
    ) -> PlantState:
        """Return the state at these positions and velocities; all arrays (axes,).

        The inputs are held until the first sample.
        """
        return self._place_axes(time_s, inputs, position, velocity, *self._simulate_rise(inputs))

    def _simulate_rise(self, inputs: FloatArray) -> tuple[kernel.KernelState, FloatArray]:
        assembly = self.assembly
        state = kernel.KernelState(
            np.zeros(sum(group.states for group in assembly.all_groups)),
            np.zeros(assembly.memory_size),
            np.zeros(len(assembly.functions)),
        )
        if not self.effects:
            return state, inputs
        low = self.compute_open_loop_inputs(self._range_lows[None])[0]
        return state, kernel.simulate_input_rise(assembly.tables, state, low, inputs)

    def _place_axes(
        self,
        time_s: float,
        inputs: FloatArray,
        position: FloatArray,
        velocity: FloatArray,
        kernel_state: kernel.KernelState,
        acting_inputs: FloatArray,
    ) -> PlantState:
        groups = self.assembly.all_groups
        for group, first in zip(groups, self.assembly.tables.group["first"], strict=True):
            columns = self._find_columns(group)
            group_state = group.compute_rest_state(position[columns], acting_inputs[columns])
            if not group.static:
                group_state[group.size : 2 * group.size] = velocity[columns]
            kernel_state.x[first : first + group.states] = group_state
        if self.effects:
            kernel.simulate_position_rise(
                self.assembly.tables, kernel_state, self._range_lows, acting_inputs
            )
        offset = np.array([axis.offset for axis in self.robot.axes.values()])
        return PlantState(
            np.array([time_s]),
            inputs[None],
            position[None],
            velocity[None],
            (position + offset)[None],
            0.0,
            np.zeros(len(self.axes)),
            *kernel_state,
        )

    def _settle_from_below(
        self, state: PlantState, acting_inputs: FloatArray, command: FloatArray
    ) -> PlantState:
        """Return the state at rest, found by simulating the path to rest.

        Only the memory of forces is taken from the end of the path. All other effects keep their
        memory after the rise.
        """
        path = make_settling_path(self.axes, self.effects)
        retraction = path.retraction / self.assembly.tables.axis["asked"]
        _, end_state = self.advance(
            state,
            path.time_s + state.time_s[-1],
            np.tile(command, (len(retraction), 1)),
            inputs=acting_inputs - retraction,
            entry_point=ChainPoint.ACTUATOR,
        )
        memory = state.memory.copy()
        for effect, function in zip(
            self.assembly.functions, self.assembly.tables.function, strict=True
        ):
            if find_phase(effect) == "force":
                memory_slice = slice(
                    function["memory_at"], function["memory_at"] + count_states(effect)
                )
                memory[memory_slice] = end_state.memory[memory_slice]
        has_loop = np.array([loop is not None for loop in self.loops])
        inputs = np.where(has_loop, end_state.inputs[-1:], state.inputs)
        settled_state = kernel.KernelState(end_state.x, memory, state.called_s.copy())
        kernel.simulate_position_rise(
            self.assembly.tables, settled_state, self._range_lows, acting_inputs
        )
        return replace(
            state, inputs=inputs, x=end_state.x, memory=memory, called_s=settled_state.called_s
        )

    @property
    def _range_lows(self) -> FloatArray:
        return np.array([axis.range[0] for axis in self.robot.axes.values()], dtype=np.float64)

    def advance(
        self,
        state: PlantState,
        time_s: FloatArray,
        command: FloatArray,
        *,
        add: FloatArray | None = None,
        inputs: FloatArray | None = None,
        entry_point: ChainPoint = ChainPoint.COMMAND,
        perturbation: Perturbation | None = None,
        random_streams: RandomStreams | None = None,
    ) -> tuple[PlantMotion, PlantState]:
        """Sample the response to ``command`` and return it with the state after it.

        Parameters
        ----------
        state : PlantState
            From :meth:`at_rest`, :meth:`make_state` or an earlier call.
        time_s : (n,)
            Increasing sample times, not before the state's time. If the first one equals the
            state's time, the state is the first sample. The response is sampled at ``time_s[k]``
            before ``command[k]`` acts.
        command : (n, axes)
            m or rad.
        add : (n, axes), optional
            V, added to the controllers' outputs.
        inputs : (n, axes), optional
            Inputs of the axes without a closed loop, V, instead of those that the command requests.
        entry_point : ChainPoint
            Point after which the inputs enter; effects before it are ignored.
        perturbation : Perturbation, optional
            Q of Eq. (1), n rows. A run with a perturbation needs one for each of its pieces.
        random_streams : RandomStreams, optional
            Source of noise and random effects. With it, readings are rounded. Without it the result
            is what a model can predict.

        Raises
        ------
        PlantError
            If the response overflows a float, with axis and time, or a perturbation does not fit or
            ends without a row of zeros.
        """
        # A sample at the state's own time replaces it; for later ones the state is their history.
        history = len(state.time_s) if time_s[0] > state.time_s[-1] else 0
        requested = (
            self.compute_open_loop_inputs(command)
            if inputs is None
            else np.array(inputs, order="C")
        )
        rows = SampleRows.of(state, history, time_s, requested)
        # Effects count time from the start of the run, wherever the times of the samples start.
        clock_s = rows.time_s + (state.elapsed_s - state.time_s[-1])
        run_inputs = self._make_kernel_inputs(
            state.perturbation,
            clock_s[history:],
            history,
            command,
            add,
            perturbation,
            random_streams,
        )
        run_inputs = run_inputs._replace(time_s=clock_s)
        electronics = self.assembly.has_electronics & (entry_point is ChainPoint.COMMAND)
        effort = np.empty_like(rows.inputs[: len(rows.inputs) if electronics.any() else 0])
        kernel_state = kernel.KernelState(
            state.x.copy(), state.memory.copy(), state.called_s.copy()
        )
        acting_rows = self._delay_static_inputs(rows, entry_point)
        kernel.run(
            _find_tables(self, entry_point),
            self.make_steps(rows.time_s, history, entry_point),
            run_inputs,
            acting_rows.to_kernel_samples(effort),
            kernel_state,
            float(clock_s[max(history - 1, 0)]),
        )
        has_loop = np.array([loop is not None for loop in self.loops])
        rows.inputs[:, has_loop] = acting_rows.inputs[:, has_loop]
        self._check_finite(rows)
        effort = np.where(electronics, effort, rows.inputs) if len(effort) else rows.inputs
        reading = skew_readings(
            self.assembly.skews,
            rows.position,
            rows.reading,
            clock_s,
            self.robot,
            rounded=random_streams is not None,
        )
        last_acceleration = (
            state.perturbation if perturbation is None else perturbation.acceleration[-1]
        )
        new_rows = slice(history, None)
        motion = PlantMotion(
            rows.position[new_rows], rows.velocity[new_rows], effort[new_rows], reading[new_rows]
        )
        return motion, self._make_next_state(
            rows, kernel_state, float(clock_s[-1]), last_acceleration
        )

    def _make_kernel_inputs(
        self,
        previous_acceleration: FloatArray,
        clock_s: FloatArray,
        first: int,
        command: FloatArray,
        add: FloatArray | None,
        perturbation: Perturbation | None,
        random_streams: RandomStreams | None,
    ) -> kernel.KernelInputs:
        axes, rows = len(self.axes), len(clock_s)
        force, kick = np.zeros((0, axes)), np.zeros((0, 0))
        if perturbation is None and previous_acceleration.any():
            raise PlantError(
                "perturbation: none is given, but Q of the previous row still acts; pass "
                "one for every piece of a run, with zeros where nothing shakes"
            )
        if perturbation is not None:
            perturbation.check(rows, self.axes)
            force = perturbation.compute_forces(previous_acceleration)
            kick = perturbation.compute_state_jumps(
                previous_acceleration, self.axes, self.assembly.all_groups
            )
        variates = np.zeros((0, axes))
        if random_streams is not None:
            variates = random_streams.draw(rows, axes, self.assembly.variate_count)
        return kernel.KernelInputs(
            first,
            _make_read_only(clock_s),
            _make_read_only(command),
            _make_read_only(np.zeros((0, axes)) if add is None else add),
            force,
            kick,
            variates,
        )

    def _delay_static_inputs(self, rows: SampleRows, behind: ChainPoint) -> SampleRows:
        """Return the rows with the inputs of static axes delayed.

        A static axis follows its input immediately, so a sample sees the input of the same row. A
        delay by a fraction of a row is interpolated linearly. So the response depends continuously
        on the delay, and is exact for a delay of zero or one row.
        """
        delays_s = _find_input_delays(self, behind).static_s
        if not delays_s.any():
            return rows
        inputs = rows.inputs.copy()
        for column in np.flatnonzero(delays_s):
            input_time_s = rows.time_s - delays_s[column]
            inputs[:, column] = np.interp(input_time_s, rows.time_s, rows.inputs[:, column])
        return rows._replace(inputs=inputs)

    def _split_delays(self, behind: ChainPoint) -> "_InputDelays":
        follows_immediately = [
            axis.static and loop is None
            for axis, loop in zip(self.robot.axes.values(), self.loops, strict=True)
        ]
        delays_s = self._compute_delays(behind)
        static_delays_s = np.where(follows_immediately, delays_s, 0.0)
        dynamic_delays_s = tuple(np.asarray(delays_s) - static_delays_s)
        return _InputDelays(static_delays_s, dynamic_delays_s, tuple(sorted(set(dynamic_delays_s))))

    def make_steps(self, time_s: FloatArray, first: int, behind: ChainPoint) -> kernel.KernelSteps:
        """Return the steps through samples (n,), of which those before ``first`` are history."""
        return make_steps_of_run(
            time_s,
            first,
            _find_input_delays(self, behind).distinct_s,
            self.assembly.all_groups,
            inner_step_s=self.assembly.inner_step_s,
            may_grow=self.assembly.steps_may_grow,
            with_holds=bool(self.effects),
        )

    def make_tables(self, behind: ChainPoint) -> PlantTables:
        """Return the tables with controllers and delays entered."""
        tables = self.assembly.tables
        axis = tables.axis.copy()
        _, dynamic_s, distinct_s = _find_input_delays(self, behind)
        axis["late"] = [distinct_s.index(delay) for delay in dynamic_s]
        for row, loop in zip(axis, self.loops, strict=True):
            if loop is None:
                row["part"] = behind
            else:
                row["kp"], row["kv"], row["limit"] = loop.kp, loop.kv, loop.limit
                uses_state_velocity = loop.velocity == "state"
                row["loop"] = (
                    kernel.STATE_VELOCITY if uses_state_velocity else kernel.BACKWARD_VELOCITY
                )
        return tables._replace(axis=axis)

    def _compute_delays(self, behind: ChainPoint = ChainPoint.COMMAND) -> tuple[float, ...]:
        """Return the delay of each axis' input, s; an effect's delay acts before the amplifier."""
        effect_delays_s = self.assembly.delays_s
        return tuple(
            loop.delay_s + effect_delays_s[i]
            if loop
            else effect_delays_s[i] * (behind is ChainPoint.COMMAND)
            for i, loop in enumerate(self.loops)
        )

    def _compute_static_position(self, inputs: FloatArray) -> FloatArray:
        """Return positions (n, axes) of static axes, ``gain·u`` or the command; 0 for others."""
        axes = self.robot.axes.values()
        static: FloatArray = np.array([axis.gain if axis.static else 0.0 for axis in axes])
        return np.asarray(np.where(static != 0.0, inputs, 0.0) * static)

    def _find_columns(self, group: AxisGroup) -> IntArray:
        return np.array([self.axes.index(name) for name in group.axes], dtype=np.int64)

    def _make_next_state(
        self,
        sample_rows: SampleRows,
        kernel_state: kernel.KernelState,
        elapsed_s: float,
        perturbation: FloatArray,
    ) -> PlantState:
        lag_s = max(self.assembly.skews.values(), default=0.0) * elapsed_s
        oldest_needed_s = sample_rows.time_s[-1] - max(*self._compute_delays(), lag_s, 0.0)
        first = int(np.searchsorted(sample_rows.time_s, oldest_needed_s, side="right")) - 1
        # Skewed clocks also interpolate through earlier rows.
        first -= INTERPOLATION_ROWS if self.assembly.skews else 0
        rows = slice(max(first, 0), None)
        return PlantState(
            sample_rows.time_s[rows].copy(),
            sample_rows.inputs[rows].copy(),
            sample_rows.position[rows].copy(),
            sample_rows.velocity[rows].copy(),
            sample_rows.reading[rows].copy(),
            elapsed_s,
            perturbation,
            kernel_state.x,
            kernel_state.memory,
            kernel_state.called_s,
        )

    def _check_finite(self, rows: SampleRows) -> None:
        with np.errstate(over="ignore", invalid="ignore"):
            # The sum takes one pass and no array with a flag per row.
            if np.isfinite(rows.position.sum()):
                return
        finite = np.isfinite(rows.position[rows.first_new_row :])
        if finite.all():
            return
        row = int(np.argmax(~finite.all(axis=1)))
        axis = self.axes[int(np.argmax(~finite[row]))]
        effects = "".join(f" {effect.entry.id} on {effect.entry.axis}," for effect in self.effects)
        raise PlantError(
            "axis {axis}: the response grows without bound at t = {time_s} s; check the "
            "commands,{named} and the controller's gains",
            axis=axis,
            time_s=format_rounded(rows.time_s[rows.first_new_row + row], 6),
            named=effects,
        )


class _InputDelays(NamedTuple):
    """Delays of inputs, s.

    ``static_s`` (axes,): those of static axes without a controller; 0 for other axes.
    ``dynamic_s``: those of the other axes, whose inputs may begin to act between rows; 0 for static
    axes. ``distinct_s``: the sorted distinct values of ``dynamic_s``.
    """

    static_s: FloatArray
    dynamic_s: tuple[float, ...]
    distinct_s: tuple[float, ...]


@lru_cache(maxsize=32)
def _find_input_delays(plant: Plant, behind: ChainPoint) -> _InputDelays:
    return plant._split_delays(behind)


@lru_cache(maxsize=32)
def _find_tables(plant: Plant, behind: ChainPoint) -> PlantTables:
    return plant.make_tables(behind)


@lru_cache(maxsize=32)
def _find_rest_state(plant: Plant, command: bytes) -> PlantState:
    """Return the rest at a command.

    The arrays are read-only, because many runs start from this cached state.
    """
    state = plant._find_equilibrium(np.frombuffer(command))
    for name in state.__slots__:
        value = getattr(state, name)
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return state


def _make_read_only(values: FloatArray) -> FloatArray:
    """Return a read-only view of the values.

    numba then compiles for one kind of array, not for two.
    """
    values = np.ascontiguousarray(values).view()
    values.flags.writeable = False
    return values
