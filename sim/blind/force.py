"""Cases of a controlled force axis, such as a ball screw on a DC motor.

The position hides most of the gap there: sizes are told in what the controller's output shows.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.effect_sizing import LEAST_BESIDE, LEAST_FLOORS
from rotemina.sim.blind.machine import Commands
from rotemina.sim.blind.mechanics import (
    DAHL,
    ELASTOPLASTIC,
    ROW,
    SLIP,
    Structure,
    load_force,
    propagator,
)
from rotemina.sim.robot.model import ForceAxis, Robot

EFFECTS = ("friction", "gain_error", "delay", "flexible_mode", "saturation", "vibration")
_SUBSTEPS = 20
_PERIOD_S = 1e-3
_NOISE_M = 5e-8
_ATTEMPTS = 60


class Loop(NamedTuple):
    """A controlled axis with its imperfections; all 0 in the nominal one.

    ``friction`` row of a load, ``mass_share`` by which the mass is off, ``late_s`` of u,
    ``ceiling`` V (0: none), ``hung_share`` and ``hung_hz`` of a flexible mode, ``shake`` N at
    ``shake_hz``.
    """

    friction: FloatArray
    mass_share: float = 0.0
    late_s: float = 0.0
    ceiling: float = 0.0
    hung_share: float = 0.0
    hung_hz: float = 0.0
    shake: float = 0.0
    shake_hz: float = 1.0


@dataclass(frozen=True, slots=True)
class ForceCase:
    """A controlled axis, its commands, and the effects that are in it with their floors."""

    kind: str
    axis: ForceAxis
    name: str
    loop: Loop
    training: tuple[Commands, ...]
    held_out: Commands
    seed: int
    present: tuple[tuple[str, float], ...]

    def label(self) -> dict[str, Any]:
        """Return the answer that is right, as JSON."""
        effects = [
            {"axis": self.name, "effect": effect, "from_axis": None, "floors": round(floors, 3)}
            for effect, floors in self.present
        ]
        return {
            "verdict": "explained" if effects else "none",
            "effects": effects,
            "kind": self.kind,
            "floors": round(max((floors for _, floors in self.present), default=0.0), 3),
        }

    def signals(self, commands: Commands, number: int) -> tuple[FloatArray, FloatArray]:
        """Return u (V) and the reading (m), each (n,), of one record."""
        noise = np.random.default_rng((self.seed, number)).normal(
            0.0, _NOISE_M, len(commands.values)
        )
        return run_loop(self.axis, self.loop, commands.values[:, 0], noise)


def run_loop(
    axis: ForceAxis, loop: Loop, command: FloatArray, noise: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return u (V) and reading (m), each (n,), sampled every millisecond."""
    inertia, controller = axis.inertia, axis.controller
    if inertia is None or controller is None:
        raise ValueError("a force axis of the blind test needs a mass and a controller")
    structure = _structure(inertia.mass * (1.0 + loop.mass_share), inertia.damping, loop)
    free, forced = propagator(structure, _PERIOD_S / _SUBSTEPS)
    gains = np.array([controller.kp, controller.kv, controller.limit, axis.gain, axis.force_offset])
    numbers = np.array([loop.late_s, loop.ceiling, loop.shake, loop.shake_hz])
    return _looped(free, forced, gains, numbers, loop.friction, command, noise)


def _structure(mass: float, damping: float, loop: Loop) -> Structure:
    drive = np.zeros(1)
    if loop.hung_share == 0.0:
        return Structure(np.array([[mass]]), np.array([[damping]]), np.zeros((1, 1)), drive)
    hung, rate = loop.hung_share * mass, 2.0 * np.pi * loop.hung_hz
    tie = np.array([[1.0, -1.0], [-1.0, 1.0]])
    masses = np.diag([mass - hung, hung])  # the rigid part keeps what is not on the spring
    return Structure(
        masses, np.diag([damping, 0.0]) + 0.04 * rate * hung * tie, rate**2 * hung * tie, drive
    )


@numba.njit(cache=True, error_model="numpy")
def _looped(
    free: FloatArray,
    forced: FloatArray,
    gains: FloatArray,
    numbers: FloatArray,
    friction: FloatArray,
    command: FloatArray,
    noise: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    d = len(forced[0])
    state, after, memory = np.zeros(2 * d), np.zeros(2 * d), np.zeros(12)
    state[:d] = command[0]
    n = len(command)
    out, reading = np.zeros(n), np.zeros(n)
    before = command[0] + noise[0]
    late = numbers[0] / _PERIOD_S
    h = _PERIOD_S / _SUBSTEPS
    for k in range(n):
        reading[k] = state[0] + noise[k]
        u = gains[1] * (gains[0] * (command[k] - reading[k]) - (reading[k] - before) / _PERIOD_S)
        before = reading[k]
        u = min(max(u, -gains[2]), gains[2])
        if numbers[1] > 0.0:  # an output stage that gives way softly
            u = u / (1.0 + (abs(u) / numbers[1]) ** 8) ** 0.125
        out[k] = u
        for s in range(_SUBSTEPS):
            whole = int(np.floor(k + s / _SUBSTEPS - late))
            acting = out[whole] if whole >= 0 else 0.0
            now_s = (k + s / _SUBSTEPS) * _PERIOD_S
            push = gains[3] * acting - gains[4]
            push += numbers[2] * np.sin(2.0 * np.pi * numbers[3] * now_s)
            if friction[2] > 0.0:
                push += load_force(friction, memory, state[0], state[d], k, h)
            for i in range(2 * d):
                after[i] = forced[i, 0] * push
                for j in range(2 * d):
                    after[i] += free[i, j] * state[j]
            state, after = after, state
    return out, reading


def draw_force_case(robot: Robot, seed: int) -> ForceCase:
    """Draw a case: healthy, one effect, or friction and another one."""
    rng = np.random.default_rng((seed, 5))
    name, axis = next((n, a) for n, a in robot.axes.items() if isinstance(a, ForceAxis))
    training = (_moves(rng, 20.0), _moves(rng, 20.0))
    held_out = _moves(rng, 12.0)
    number = int(rng.choice([0, 1, 1, 1, 2]))
    wanted: dict[int, list[str]] = {
        0: [],
        1: [EFFECTS[rng.integers(len(EFFECTS))]],
        2: ["friction", "flexible_mode"],
    }
    plain = Loop(np.zeros(ROW))
    noise_v = _difference(axis, plain, plain, training, _NOISE_M)
    loop, present = plain, tuple[tuple[str, float], ...]()
    for _ in range(_ATTEMPTS):
        drawn = _drawn(axis, wanted[number], training, noise_v, rng)
        if drawn is not None:
            loop, present = drawn
            break
    kind = ("healthy", "single", "double")[len(present)]
    return ForceCase(kind, axis, name, loop, training, held_out, seed, present)


def _drawn(
    axis: ForceAxis,
    effects: Sequence[str],
    training: tuple[Commands, ...],
    noise_v: float,
    rng: np.random.Generator,
) -> tuple[Loop, tuple[tuple[str, float], ...]] | None:
    """Draw sizes of effects; None where one of them would not be there to be found."""
    plain = Loop(np.zeros(ROW))
    loops = [plain]
    for effect in effects:
        loops.append(_with(loops[-1], effect, rng, 10.0 ** rng.uniform(-1.5, 0.0)))
    present = []
    for before, effect, after in zip(loops, effects, loops[1:], strict=False):
        floors = _difference(axis, after, before, training, 0.0) / noise_v
        if floors < (LEAST_BESIDE if len(effects) > 1 else LEAST_FLOORS):
            return None
        present.append((effect, floors))
    return loops[-1], tuple(present)


def _with(loop: Loop, effect: str, rng: np.random.Generator, size: float) -> Loop:
    match effect:
        case "friction":
            code = (SLIP, SLIP, DAHL, ELASTOPLASTIC)[rng.integers(4)]
            coulomb = 60.0 * size
            shape = {SLIP: 2e-3, DAHL: rng.uniform(0.7, 1.5)}.get(code, 0.6)
            row = np.zeros(ROW)
            row[0], row[2:9] = (
                code,
                (coulomb, coulomb * rng.uniform(0.8, 1.2), 1.2, shape, 1e-5, 3e3, 0.0),
            )
            return loop._replace(friction=row)
        case "gain_error":
            return loop._replace(mass_share=0.3 * size * rng.choice([-1.0, 1.0]))
        case "delay":
            return loop._replace(late_s=2.5e-3 * size)
        case "flexible_mode":
            share, hertz = 0.1 + 0.3 * size, np.exp(rng.uniform(np.log(5.0), np.log(45.0)))
            return loop._replace(hung_share=share, hung_hz=hertz)
        case "saturation":
            return loop._replace(ceiling=rng.uniform(2.0, 6.0))
        case _:
            return loop._replace(shake=20.0 * size, shake_hz=rng.uniform(3.0, 30.0))


def _difference(
    axis: ForceAxis,
    loop: Loop,
    other: Loop,
    training: tuple[Commands, ...],
    noise_m: float,
) -> float:
    """Return the rms (V) by which u differs between two loops, the first with sensor noise."""
    power = 0.0
    for commands in training:
        command = commands.values[:, 0]
        noise = np.random.default_rng(1).normal(0.0, 1.0, len(command)) * noise_m
        first = run_loop(axis, loop, command, noise)[0]
        power += float(np.mean((first - run_loop(axis, other, command, 0.0 * noise)[0]) ** 2))
    return float(np.sqrt(power / len(training)))


def _moves(rng: np.random.Generator, length_s: float) -> Commands:
    """Draw smooth moves of various lengths and speeds over the range, with holds between."""
    n = round(length_s / _PERIOD_S)
    path = np.full(n, 0.02)
    at, place = round(0.5 / _PERIOD_S), 0.02
    while at < n:
        goal = rng.uniform(0.01, 0.24)
        least_s = max(abs(goal - place) / 0.2, 0.4)
        rows = round(least_s * rng.uniform(1.0, 2.5) / _PERIOD_S)
        x = np.minimum(np.arange(n - at) / rows, 1.0)
        path[at:] = place + (goal - place) * (x**3 * (10.0 - 15.0 * x + 6.0 * x**2))
        at, place = at + rows + round(rng.uniform(0.1, 0.6) / _PERIOD_S), goal
    return Commands(_PERIOD_S, np.round(path, 9)[:, None])
