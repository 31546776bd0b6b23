"""A machine of the blind generator that is stepped sample by sample, like a simulator's plant.

The generator itself computes whole motions. Two kinds of its parts can be continued from a saved
state: loads, for each of which the generator keeps a memory, and hysteresis without creep. Such
hysteresis remembers only the turning points of its input that no larger swing has erased.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.blind import (
    BlindCase,
    BlindMachine,
    SignalStage,
    SimulationRun,
    build_machine,
    mechanics,
)
from rotemina.sim.plant import RandomStreams
from rotemina.sim.robot import Robot

#: Effects whose parts can be continued from a saved state.
STEPPED_EFFECTS = ("hysteresis", "contact", "stiffness_nonlinearity")
_TICK_S = 5e-5
# Length of the memory that the generator keeps for each load.
_LOAD_MEMORY_SIZE = 12


@numba.njit(cache=True)  # type: ignore[untyped-decorator]
def _step_mechanics(free, forced, drive, targets, loads, state, memory, first_step, step_s):  # type: ignore[no-untyped-def]
    """Compute the motion like ``mechanics.simulate_motion``; update state and memory in place."""
    n, m = targets.shape
    d = len(state) // 2
    next_state, force, out = state.copy(), np.zeros(d), np.empty((n, m))
    for k in range(n):
        force[:] = 0.0
        for i in range(m):
            out[k, i] = state[i]
            force[i] = drive[i] * targets[k, i]
        for j in range(len(loads)):
            i = int(loads[j, 1])
            force[i] += mechanics.compute_load_force(
                loads[j], memory[j], state[i], state[d + i], first_step + k, step_s
            )
        for i in range(2 * d):
            total = 0.0
            for j in range(2 * d):
                total += free[i, j] * state[j]
            for j in range(d):
                total += forced[i, j] * force[j]
            next_state[i] = total
        state[:] = next_state
    return out


def update_turning_points(points: Sequence[float], values: FloatArray) -> list[float]:
    """Return the turning points that a rate-independent part remembers after ``values``."""
    signal = np.concatenate([points[-1:], values])
    direction = np.sign(np.diff(signal))
    moving_rows = np.flatnonzero(direction)
    has_turned = direction[moving_rows[1:]] != direction[moving_rows[:-1]]
    turning_rows = moving_rows[1:][has_turned]
    turning_points = list(points)
    for point in (*signal[turning_rows].tolist(), float(signal[-1])):
        if (
            len(turning_points) > 1
            and (turning_points[-1] - turning_points[-2]) * (point - turning_points[-1]) >= 0.0
        ):
            turning_points[-1] = point
        else:
            turning_points.append(point)
        while len(turning_points) > 3:
            a, b, c, d = turning_points[-4:]
            if abs(c - b) > min(abs(b - a), abs(d - c)):
                break
            del turning_points[-3:-1]
    return turning_points


class StageMemory(NamedTuple):
    """Memory of the axes of a stage.

    It holds positions and speeds (``state``), the memory of each load (``forces``), the turning
    points of each axis, and the number of ticks so far.
    """

    state: FloatArray
    forces: FloatArray
    turning_points: tuple[list[float], ...]
    ticks: int


class SteppedStage:
    """The axes of one stage; it has no state, but receives and returns the memory of the axes."""

    def __init__(self, machine: BlindMachine, tick_s: float) -> None:
        self.axes = machine.axes
        self._steps_per_tick = max(round(tick_s / _TICK_S), 1)
        self._step_s = tick_s / self._steps_per_tick
        run = SimulationRun(self._step_s, self._steps_per_tick, 0, 0)
        load_parts = [part for part in machine.parts if part.stage is SignalStage.LOAD]
        self._actuator_parts = [
            part for part in machine.parts if part.stage is SignalStage.ACTUATOR
        ]
        assert len(load_parts) + len(self._actuator_parts) == len(machine.parts), (
            "a part cannot be continued"
        )
        load_rows = [part.act(np.zeros(0), run, part.size) for part in load_parts]
        self._loads = np.array(load_rows).reshape(-1, mechanics.LOAD_ROW_LENGTH)
        self._run, self._structure = run, machine.structure
        self._propagators = mechanics.compute_propagator(machine.structure, self._step_s)

    def make_memory_at_rest(self, position: FloatArray) -> StageMemory:
        """Return the memory of axes that have moved from the low end up to ``position`` (m,)."""
        turning_points: tuple[list[float], ...] = tuple(
            [float(axis.low), float(coordinate)]
            for axis, coordinate in zip(self.axes, position, strict=True)
        )
        structure = self._structure
        force = np.zeros(len(structure.mass))
        target, turning_points = self._compute_targets(np.asarray(position)[None], turning_points)
        force[: len(position)] = structure.drive * target[0]
        state = np.zeros(2 * len(force))
        state[: len(force)] = np.linalg.solve(structure.stiffness, force)
        return StageMemory(
            state, np.zeros((len(self._loads), _LOAD_MEMORY_SIZE)), turning_points, 0
        )

    def advance(
        self, memory: StageMemory, commands: FloatArray, ticks: IntArray | int = 1
    ) -> tuple[FloatArray, StageMemory]:
        """Return the positions (ticks, m) for the next commands (n, m), and the memory after them.

        ``ticks`` (n,) is the number of ticks for which each command holds.
        """
        target, turning_points = self._compute_targets(commands, memory.turning_points)
        target = np.repeat(target, ticks, axis=0)
        state, forces = memory.state.copy(), memory.forces.copy()
        motion = _step_mechanics(
            *self._propagators,
            self._structure.drive,
            np.repeat(target, self._steps_per_tick, axis=0),
            self._loads,
            state,
            forces,
            memory.ticks * self._steps_per_tick,
            self._step_s,
        )
        next_memory = StageMemory(state, forces, turning_points, memory.ticks + len(target))
        return motion[:: self._steps_per_tick], next_memory

    def _compute_targets(
        self, commands: FloatArray, turning_points: tuple[list[float], ...]
    ) -> tuple[FloatArray, tuple[list[float], ...]]:
        targets, new_turning_points = commands.copy(), list(turning_points)
        for part in self._actuator_parts:
            i = part.axis.index
            signal = np.concatenate([new_turning_points[i], commands[:, i]])
            targets[:, i] = part.act(signal, self._run, part.size)[len(new_turning_points[i]) :]
            new_turning_points[i] = update_turning_points(new_turning_points[i], commands[:, i])
        return targets, tuple(new_turning_points)


@dataclass(frozen=True, slots=True, eq=False)
class SteppedState:
    """State of the whole machine: the memory of each stage, time, position and command."""

    memories: tuple[StageMemory, ...]
    time_s: FloatArray
    position: FloatArray
    command: FloatArray


class SteppedMotion(NamedTuple):
    """Positions, readings and hidden inputs, each (n, axes)."""

    position: FloatArray
    reading: FloatArray
    inputs: FloatArray


class SteppedPlant:
    """All axes of a robot, with the effects of a case in one stage, as the plant of a simulator."""

    # A plant lists the control loops that it closes; this one closes none.
    loops: tuple[None, ...] = ()

    def __init__(self, robot: Robot, case: BlindCase | None) -> None:
        self.axes = tuple(robot.axes)
        self._stages: list[tuple[list[int], SteppedStage]] = []
        for names in robot.stages.values():
            columns = [self.axes.index(name) for name in names]
            travels = {name: np.array(robot.axes[name].range) for name in names}
            has_case = case is not None and tuple(names) == tuple(case.axis_names)
            machine = case.machine if has_case and case else build_machine(robot, names, travels)
            self._stages.append((columns, SteppedStage(machine, _TICK_S)))

    def find_rest_state(self, time_s: float, position: FloatArray) -> SteppedState:
        """Return the state at rest at ``position`` (axes,)."""
        position = np.asarray(position, dtype=np.float64)
        memories = tuple(
            stage.make_memory_at_rest(position[columns]) for columns, stage in self._stages
        )
        return SteppedState(memories, np.array([time_s]), position[None], position)

    def advance(
        self,
        state: SteppedState,
        time_s: FloatArray,
        command: FloatArray,
        *,
        random_streams: RandomStreams,
    ) -> tuple[SteppedMotion, SteppedState]:
        """Compute the response to commands (n, axes) at times (n,); each holds until the next."""
        elapsed_s = np.concatenate([state.time_s[-1:], time_s]) - state.time_s[-1]
        ticks = np.maximum(np.diff(np.rint(elapsed_s / _TICK_S).astype(np.int64)), 1)
        held_commands = np.vstack([state.command[None], command])
        sample_rows = np.cumsum(ticks) - 1
        # Each command acts from its own sample on. The previous one has already held for one tick
        # in the last call, and the newest one holds for one tick in this call.
        durations = np.concatenate([[ticks[0] - 1], ticks[1:], [1]])
        motion, reading = np.empty_like(command), np.empty_like(command)
        noise = random_streams.draw(len(command), len(self.axes), 0)
        memories = []
        for (columns, stage), memory in zip(self._stages, state.memories, strict=True):
            stage_motion, next_memory = stage.advance(memory, held_commands[:, columns], durations)
            motion[:, columns] = stage_motion[sample_rows]
            memories.append(next_memory)
            rms = np.array([axis.noise for axis in stage.axes])
            step = np.array([axis.resolution for axis in stage.axes])
            noisy = motion[:, columns] + rms * noise[:, columns]
            reading[:, columns] = np.round(noisy / step) * step
        unknown_inputs = np.full(command.shape, np.nan)
        latest_state = SteppedState(tuple(memories), time_s[-1:], motion[-1:], command[-1].copy())
        return SteppedMotion(motion, reading, unknown_inputs), latest_state


def can_step_case(case: BlindCase) -> bool:
    """Whether every part of a case can be continued from a saved state."""
    effects: list[Any] = case.label()["effects"]
    return case.remainder is None and all(effect["effect"] in STEPPED_EFFECTS for effect in effects)
