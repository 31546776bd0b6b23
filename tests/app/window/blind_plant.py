"""The blind generator's machine under way, tick by tick, as the virtual boards want it.

The generator runs a machine over whole motions. Some of its parts can go on from where they were:
forces, whose memory the generator keeps by load, and hysteresis without creep, which remembers
nothing but the turns of its input that no wider swing has wiped out. They do exactly what the
generator's own run does (a test compares them).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numba
import numpy as np

from rotemina.drivers.virtual_board.ahead import PlantRun, Response
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.machine import machine_of
from rotemina.sim.blind.part import Course, Stage

#: Effects whose parts can go on.
STEPPED = ("hysteresis", "contact", "stiffness_nonlinearity")
_FINE_S = 5e-5


@numba.njit
def _go_on(free, forced, drive, targets, loads, state, memory, first, step_s):
    """As ``mechanics.move``, from a state and a memory that go on."""
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


def turned(points, values):
    """Return the turns (list) that a rate-independent part remembers, after more of the signal."""
    signal = np.concatenate([points[-1:], values])
    way = np.sign(np.diff(signal))
    moves = np.flatnonzero(way)
    turning = moves[1:][way[moves[1:]] != way[moves[:-1]]]
    kept = list(points)
    for point in (*signal[turning], signal[-1]):
        if len(kept) > 1 and (kept[-1] - kept[-2]) * (point - kept[-1]) >= 0.0:
            kept[-1] = float(point)
        else:
            kept.append(float(point))
        while len(kept) > 3:
            a, b, c, d = kept[-4:]
            if abs(c - b) > min(abs(b - a), abs(d - c)):
                break
            del kept[-3:-1]
    return kept


class Memory(NamedTuple):
    """What the axes of one stage remember: positions and speeds, forces, turns, and time."""

    state: np.ndarray
    forces: np.ndarray
    turns: tuple
    ticks: int


class Going:
    """The axes of one stage; it remembers nothing itself."""

    def __init__(self, machine, tick_s):
        self.axes = machine.axes
        self._every = max(round(tick_s / _FINE_S), 1)
        self._step_s = tick_s / self._every
        course = Course(self._step_s, self._every, 0, 0)
        nothing = np.zeros(0)
        forces = [part for part in machine.parts if part.stage is Stage.LOAD]
        self._bent = [part for part in machine.parts if part.stage is Stage.ACTUATOR]
        assert len(forces) + len(self._bent) == len(machine.parts), "a part that cannot go on"
        rows = [part.act(nothing, course, part.size) for part in forces]
        self._loads = np.array(rows).reshape(-1, mechanics.ROW)
        self._course, self._structure = course, machine.structure
        self._steps = mechanics.propagator(machine.structure, self._step_s)

    def at_rest(self, position):
        """Return the memory of axes that have risen from the low end to ``position`` (m,)."""
        turns = tuple([axis.low, float(at)] for axis, at in zip(self.axes, position, strict=True))
        structure = self._structure
        force = np.zeros(len(structure.mass))
        target, turns = self._target(np.asarray(position)[None], turns)
        force[: len(position)] = structure.drive * target[0]
        state = np.zeros(2 * len(force))
        state[: len(force)] = np.linalg.solve(structure.stiffness, force)
        return Memory(state, np.zeros((len(self._loads), 12)), turns, 0)

    def advance(self, memory, commands):
        """Return positions (ticks, m) for the next commands (ticks, m), and the memory then."""
        target, turns = self._target(commands, memory.turns)
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
        after = Memory(state, forces, turns, memory.ticks + len(commands))
        return motion[:: self._every], after

    def _target(self, commands, turns):
        targets, turns = commands.copy(), list(turns)
        for part in self._bent:
            i = part.axis.index
            signal = np.concatenate([turns[i], commands[:, i]])
            targets[:, i] = part.act(signal, self._course, part.size)[len(turns[i]) :]
            turns[i] = turned(turns[i], commands[:, i])
        return targets, tuple(turns)


@dataclass(frozen=True)
class State:
    """What a whole machine remembers, as the boards keep it."""

    memories: tuple
    time_s: np.ndarray


class BlindPlant:
    """All axes of a robot, those of one stage with a case, as the boards' run of a plant wants."""

    def __init__(self, robot, case, tick_s):
        order = list(robot.axes)
        self._stages = []
        for names in robot.stages.values():
            columns = [order.index(name) for name in names]
            travels = {name: np.array(robot.axes[name].range) for name in names}
            mine = tuple(names) == tuple(case.names)
            machine = case.machine if mine else machine_of(robot, names, travels)
            self._stages.append((columns, Going(machine, tick_s)))

    def at_rest(self, time_s, position):
        """Return the state at rest at ``position`` (axes,)."""
        position = np.asarray(position)
        memories = tuple(going.at_rest(position[columns]) for columns, going in self._stages)
        return State(memories, np.array([time_s]))

    def advance(self, state, since_s, commands, *, chance):
        """Return positions and readings (ticks, axes), and the state after them."""
        motion, memories = np.empty_like(commands), []
        noise = chance.draw(*commands.shape, 0)
        reading = np.empty_like(commands)
        for (columns, going), memory in zip(self._stages, state.memories, strict=True):
            motion[:, columns], after = going.advance(memory, commands[:, columns])
            memories.append(after)
            rms = np.array([axis.noise for axis in going.axes])
            step = np.array([axis.resolution for axis in going.axes])
            noisy = motion[:, columns] + rms * noise[:, columns]
            reading[:, columns] = np.round(noisy / step) * step
        return Response(motion, reading), State(tuple(memories), since_s)


class BlindRun(PlantRun):
    """In the place of the boards' ``PlantRun``."""

    def __init__(self, robot, case, tick_s, seed, position):
        super().__init__(BlindPlant(robot, case, tick_s), tick_s, seed, position)
