"""A running machine of the blind generator, stepped sample by sample like a simulator's plant.

The generator runs a machine over whole motions. Some of its parts can go on from where they were:
forces, whose memory the generator keeps by load, and hysteresis without creep, which remembers
nothing but the turns of its input that no wider swing has wiped out.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.case import Case
from rotemina.sim.blind.machine import Machine, machine_of
from rotemina.sim.blind.part import SimulationRun, Stage
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.robot.model import Robot

#: Effects whose parts can go on.
STEPPED = ("hysteresis", "contact", "stiffness_nonlinearity")
_FINE_S = 5e-5
_MEMORY = 12  # numbers of a load


@numba.njit(cache=True)  # type: ignore[untyped-decorator]
def _go_on(free, forced, drive, targets, loads, state, memory, first, step_s):  # type: ignore[no-untyped-def]
    """As ``mechanics.move``, from a state and a memory that continue."""
    n, m = targets.shape
    d = len(state) // 2
    after, force, out = state.copy(), np.zeros(d), np.empty((n, m))
    for k in range(n):
        force[:] = 0.0
        for i in range(m):
            out[k, i] = state[i]
            force[i] = drive[i] * targets[k, i]
        for j in range(len(loads)):
            i = int(loads[j, 1])
            force[i] += mechanics.load_force(
                loads[j], memory[j], state[i], state[d + i], first + k, step_s
            )
        for i in range(2 * d):
            total = 0.0
            for j in range(2 * d):
                total += free[i, j] * state[j]
            for j in range(d):
                total += forced[i, j] * force[j]
            after[i] = total
        state[:] = after
    return out


def turned(points: Sequence[float], values: FloatArray) -> list[float]:
    """Return the turns that a rate-independent part remembers, after more of the signal."""
    signal = np.concatenate([points[-1:], values])
    way = np.sign(np.diff(signal))
    moves = np.flatnonzero(way)
    turning = moves[1:][way[moves[1:]] != way[moves[:-1]]]
    kept = list(points)
    for point in (*signal[turning].tolist(), float(signal[-1])):
        if len(kept) > 1 and (kept[-1] - kept[-2]) * (point - kept[-1]) >= 0.0:
            kept[-1] = point
        else:
            kept.append(point)
        while len(kept) > 3:
            a, b, c, d = kept[-4:]
            if abs(c - b) > min(abs(b - a), abs(d - c)):
                break
            del kept[-3:-1]
    return kept


class Memory(NamedTuple):
    """What the axes of one stage remember: positions and speeds, forces, turns, and ticks."""

    state: FloatArray
    forces: FloatArray
    turns: tuple[list[float], ...]
    ticks: int


class Going:
    """The axes of one stage; it remembers nothing itself."""

    def __init__(self, machine: Machine, tick_s: float) -> None:
        self.axes = machine.axes
        self._every = max(round(tick_s / _FINE_S), 1)
        self._step_s = tick_s / self._every
        run = SimulationRun(self._step_s, self._every, 0, 0)
        forces = [part for part in machine.parts if part.stage is Stage.LOAD]
        self._bent = [part for part in machine.parts if part.stage is Stage.ACTUATOR]
        assert len(forces) + len(self._bent) == len(machine.parts), "a part that cannot go on"
        rows = [part.act(np.zeros(0), run, part.size) for part in forces]
        self._loads = np.array(rows).reshape(-1, mechanics.ROW)
        self._run, self._structure = run, machine.structure
        self._steps = mechanics.propagator(machine.structure, self._step_s)

    def at_rest(self, position: FloatArray) -> Memory:
        """Return the memory of axes that have risen from the low end to ``position`` (m,)."""
        turns: tuple[list[float], ...] = tuple(
            [float(axis.low), float(at)] for axis, at in zip(self.axes, position, strict=True)
        )
        structure = self._structure
        force = np.zeros(len(structure.mass))
        target, turns = self._target(np.asarray(position)[None], turns)
        force[: len(position)] = structure.drive * target[0]
        state = np.zeros(2 * len(force))
        state[: len(force)] = np.linalg.solve(structure.stiffness, force)
        return Memory(state, np.zeros((len(self._loads), _MEMORY)), turns, 0)

    def advance(
        self, memory: Memory, commands: FloatArray, ticks: IntArray | int = 1
    ) -> tuple[FloatArray, Memory]:
        """Return positions (ticks, m) for the next commands (n, m), and the memory then.

        ``ticks`` (n,) is for how long each of them holds.
        """
        target, turns = self._target(commands, memory.turns)
        target = np.repeat(target, ticks, axis=0)
        state, forces = memory.state.copy(), memory.forces.copy()
        motion = _go_on(
            *self._steps,
            self._structure.drive,
            np.repeat(target, self._every, axis=0),
            self._loads,
            state,
            forces,
            memory.ticks * self._every,
            self._step_s,
        )
        after = Memory(state, forces, turns, memory.ticks + len(target))
        return motion[:: self._every], after

    def _target(
        self, commands: FloatArray, turns: tuple[list[float], ...]
    ) -> tuple[FloatArray, tuple[list[float], ...]]:
        targets, kept = commands.copy(), list(turns)
        for part in self._bent:
            i = part.axis.index
            signal = np.concatenate([kept[i], commands[:, i]])
            targets[:, i] = part.act(signal, self._run, part.size)[len(kept[i]) :]
            kept[i] = turned(kept[i], commands[:, i])
        return targets, tuple(kept)


@dataclass(frozen=True, slots=True, eq=False)
class SteppedState:
    """What a whole machine remembers; the rest is as of any plant's state."""

    memories: tuple[Memory, ...]
    time_s: FloatArray
    position: FloatArray
    command: FloatArray


class SteppedMotion(NamedTuple):
    """Positions, readings, and hidden inputs, each (n, axes)."""

    position: FloatArray
    reading: FloatArray
    inputs: FloatArray


class SteppedPlant:
    """All axes of a robot, those of one stage with a case, in the place of a simulator's plant."""

    loops: tuple[None, ...] = ()  # of controllers: none is closed

    def __init__(self, robot: Robot, case: Case | None) -> None:
        self.axes = tuple(robot.axes)
        self._stages: list[tuple[list[int], Going]] = []
        for names in robot.stages.values():
            columns = [self.axes.index(name) for name in names]
            travels = {name: np.array(robot.axes[name].range) for name in names}
            mine = case is not None and tuple(names) == tuple(case.names)
            machine = case.machine if mine and case else machine_of(robot, names, travels)
            self._stages.append((columns, Going(machine, _FINE_S)))

    def at_rest(self, time_s: float, position: FloatArray) -> SteppedState:
        """Return the state at rest at ``position`` (axes,)."""
        position = np.asarray(position, dtype=np.float64)
        memories = tuple(going.at_rest(position[columns]) for columns, going in self._stages)
        return SteppedState(memories, np.array([time_s]), position[None], position)

    def advance(
        self, state: SteppedState, time_s: FloatArray, command: FloatArray, *, chance: Chance
    ) -> tuple[SteppedMotion, SteppedState]:
        """Sample the response to commands (n, axes) at times (n,); each holds until the next."""
        since_s = np.concatenate([state.time_s[-1:], time_s]) - state.time_s[-1]
        ticks = np.maximum(np.diff(np.rint(since_s / _FINE_S).astype(np.int64)), 1)
        held = np.vstack([state.command[None], command])
        rows = np.cumsum(ticks) - 1
        # Each acts from its own sample on: so far, the latest one for a tick.
        durations = np.concatenate([[ticks[0] - 1], ticks[1:], [1]])
        motion, reading = np.empty_like(command), np.empty_like(command)
        noise = chance.draw(len(command), len(self.axes), 0)
        memories = []
        for (columns, going), memory in zip(self._stages, state.memories, strict=True):
            told, after = going.advance(memory, held[:, columns], durations)
            motion[:, columns] = told[rows]
            memories.append(after)
            rms = np.array([axis.noise for axis in going.axes])
            step = np.array([axis.resolution for axis in going.axes])
            noisy = motion[:, columns] + rms * noise[:, columns]
            reading[:, columns] = np.round(noisy / step) * step
        unknown = np.full(command.shape, np.nan)
        latest = SteppedState(tuple(memories), time_s[-1:], motion[-1:], command[-1].copy())
        return SteppedMotion(motion, reading, unknown), latest


def can_go_on(case: Case) -> bool:
    """Whether every part of a case can continue from where it was."""
    effects: list[Any] = case.label()["effects"]
    return case.remainder is None and all(one["effect"] in STEPPED for one in effects)
