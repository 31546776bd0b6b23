"""The blind generator's machine under way, tick by tick, as the virtual boards want it.

The generator runs a machine over whole motions. Some of its parts can go on from where they were:
forces, whose memory the generator keeps by load, and hysteresis without creep, which remembers
nothing but the turns of its input that no wider swing has wiped out. They do exactly what the
generator's own run does (a test compares them).
"""

import numba
import numpy as np

from rotemina.drivers.virtual_board.ahead import Response
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


class Turns:
    """The turns of a signal that a rate-independent part still remembers."""

    def __init__(self, *points):
        self.points = list(points)

    def add(self, values):
        """Take note of more of the signal."""
        signal = np.concatenate([self.points[-1:], values])
        way = np.sign(np.diff(signal))
        moves = np.flatnonzero(way)
        turning = moves[1:][way[moves[1:]] != way[moves[:-1]]]
        for point in (*signal[turning], signal[-1]):
            self._take(float(point))

    def _take(self, point):
        points = self.points
        if len(points) > 1 and (points[-1] - points[-2]) * (point - points[-1]) >= 0.0:
            points[-1] = point
        else:
            points.append(point)
        while len(points) > 3:
            a, b, c, d = points[-4:]
            if abs(c - b) > min(abs(b - a), abs(d - c)):
                break
            del points[-3:-1]


class Going:
    """The axes of one stage, from rest at ``position`` (m,)."""

    def __init__(self, machine, tick_s, position, seed):
        self._axes = machine.axes
        self._every = max(round(tick_s / _FINE_S), 1)
        self._step_s = tick_s / self._every
        course = Course(self._step_s, self._every, 0, seed)
        nothing = np.zeros(0)
        forces = [part for part in machine.parts if part.stage is Stage.LOAD]
        self._bent = [part for part in machine.parts if part.stage is Stage.ACTUATOR]
        assert len(forces) + len(self._bent) == len(machine.parts), "a part that cannot go on"
        rows = [part.act(nothing, course, part.size) for part in forces]
        self._loads = np.array(rows).reshape(-1, mechanics.ROW)
        self._memory = np.zeros((len(self._loads), 12))
        self._course, self._ticks = course, 0
        # It has risen from the low end to where it stands, long ago.
        self._turns = [Turns(axis.low, at) for axis, at in zip(self._axes, position, strict=True)]
        structure = machine.structure
        self._drive = structure.drive
        self._steps = mechanics.propagator(structure, self._step_s)
        d = len(structure.mass)
        self._state = np.zeros(2 * d)
        force = np.zeros(d)
        force[: len(position)] = structure.drive * self._target(position[None])[0]
        self._state[:d] = np.linalg.solve(structure.stiffness, force)
        self._chance = np.random.default_rng(seed)

    def advance(self, commands):
        """Return positions and readings (ticks, m) for the next commands (ticks, m)."""
        targets = np.repeat(self._target(commands), self._every, axis=0)
        first = self._ticks * self._every
        motion = _go_on(
            *self._steps, self._drive, targets, self._loads, self._state, self._memory,
            first, self._step_s,
        )[:: self._every]  # fmt: skip
        self._ticks += len(commands)
        reading = motion.copy()
        for i, axis in enumerate(self._axes):
            noisy = reading[:, i] + self._chance.normal(0.0, axis.noise, len(reading))
            reading[:, i] = np.round(noisy / axis.resolution) * axis.resolution
        return motion, reading

    def _target(self, commands):
        targets = commands.copy()
        for part in self._bent:
            i = part.axis.index
            turns = self._turns[i]
            signal = np.concatenate([turns.points, commands[:, i]])
            targets[:, i] = part.act(signal, self._course, part.size)[len(turns.points) :]
            turns.add(commands[:, i])
        return targets


class BlindRun:
    """In the place of the boards' ``PlantRun``: all axes of a robot, one stage with a case."""

    def __init__(self, robot, case, tick_s, seed, position):
        order = list(robot.axes)
        self._stages = []
        for number, names in enumerate(robot.stages.values()):
            columns = [order.index(name) for name in names]
            travels = {name: np.array(robot.axes[name].range) for name in names}
            mine = tuple(names) == tuple(case.names)
            machine = case.machine if mine else machine_of(robot, names, travels)
            going = Going(machine, tick_s, np.asarray(position)[columns], seed + number)
            self._stages.append((columns, going))

    def advance(self, commands, expected):
        """Return the response to commands (ticks, axes); it needs no look ahead."""
        motion, reading = np.empty_like(commands), np.empty_like(commands)
        for columns, going in self._stages:
            motion[:, columns], reading[:, columns] = going.advance(commands[:, columns])
        return Response(motion, reading)
