"""Cases of a controlled force axis, such as a ball screw on a DC motor.

The controller hides most of the gap in the position, so effects are measured by its output u.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.effect_sizing import MIN_FLOORS, MIN_FLOORS_IF_SEVERAL
from rotemina.sim.blind.machine import SampledCommands
from rotemina.sim.blind.mechanics import (
    DAHL,
    ELASTOPLASTIC,
    LOAD_ROW_LENGTH,
    SLIP,
    LinearStructure,
    compute_load_force,
    compute_propagator,
)
from rotemina.sim.robot import ForceAxis, Robot

FORCE_EFFECTS = ("friction", "gain_error", "delay", "flexible_mode", "saturation", "vibration")
# Simulation steps of the plant in each period of the controller.
_SUBSTEP_COUNT = 20
_PERIOD_S = 1e-3
_NOISE_M = 5e-8
_MAX_ATTEMPTS = 60


class ForceLoop(NamedTuple):
    """A controlled axis with its imperfections; each of them is 0 in the nominal axis.

    Attributes
    ----------
    friction : (12,) load row of ``mechanics``.
    mass_share : relative error of the mass.
    delay_s : delay of u.
    saturation_v : voltage at which u saturates; 0 for no saturation.
    appendage_share, appendage_hz : fraction of the mass and frequency of a flexible mode.
    vibration_n, vibration_hz : force and frequency of a vibration.
    """

    friction: FloatArray
    mass_share: float = 0.0
    delay_s: float = 0.0
    saturation_v: float = 0.0
    appendage_share: float = 0.0
    appendage_hz: float = 0.0
    vibration_n: float = 0.0
    vibration_hz: float = 1.0


@dataclass(frozen=True, slots=True)
class ForceCase:
    """A controlled axis, its commands, and its effects with their sizes in floors."""

    kind: str
    axis: ForceAxis
    name: str
    loop: ForceLoop
    training: tuple[SampledCommands, ...]
    held_out: SampledCommands
    seed: int
    present_effects: tuple[tuple[str, float], ...]

    def label(self) -> dict[str, Any]:
        """Return the correct answer as JSON."""
        effects = [
            {"axis": self.name, "effect": effect, "from_axis": None, "floors": round(floors, 3)}
            for effect, floors in self.present_effects
        ]
        return {
            "verdict": "explained" if effects else "none",
            "effects": effects,
            "kind": self.kind,
            "floors": round(max((floors for _, floors in self.present_effects), default=0.0), 3),
        }

    def simulate_signals(
        self, commands: SampledCommands, number: int
    ) -> tuple[FloatArray, FloatArray]:
        """Return u (V) and the reading (m), each (n,), of one record."""
        noise = np.random.default_rng((self.seed, number)).normal(
            0.0, _NOISE_M, len(commands.values)
        )
        return run_loop(self.axis, self.loop, commands.values[:, 0], noise)


def run_loop(
    axis: ForceAxis, loop: ForceLoop, command: FloatArray, noise: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Simulate the loop and return u (V) and the reading (m), each (n,), every millisecond.

    Raises
    ------
    ValueError
        If the axis has no mass or no controller.
    """
    inertia, controller = axis.inertia, axis.controller
    if inertia is None or controller is None:
        raise ValueError("a force axis of the blind test needs a mass and a controller")
    structure = _build_structure(inertia.mass * (1.0 + loop.mass_share), inertia.damping, loop)
    free, forced = compute_propagator(structure, _PERIOD_S / _SUBSTEP_COUNT)
    gains = np.array([controller.kp, controller.kv, controller.limit, axis.gain, axis.force_offset])
    imperfections = np.array([loop.delay_s, loop.saturation_v, loop.vibration_n, loop.vibration_hz])
    return _simulate_loop(free, forced, gains, imperfections, loop.friction, command, noise)


def _build_structure(mass: float, damping: float, loop: ForceLoop) -> LinearStructure:
    drive = np.zeros(1)
    if loop.appendage_share == 0.0:
        return LinearStructure(np.array([[mass]]), np.array([[damping]]), np.zeros((1, 1)), drive)
    appendage_mass, rate = loop.appendage_share * mass, 2.0 * np.pi * loop.appendage_hz
    coupling = np.array([[1.0, -1.0], [-1.0, 1.0]])
    # The mass on the spring is part of the total mass, not added to it.
    masses = np.diag([mass - appendage_mass, appendage_mass])
    return LinearStructure(
        masses,
        np.diag([damping, 0.0]) + 0.04 * rate * appendage_mass * coupling,
        rate**2 * appendage_mass * coupling,
        drive,
    )


@numba.njit(cache=True, error_model="numpy")
def _simulate_loop(
    free: FloatArray,
    forced: FloatArray,
    gains: FloatArray,
    imperfections: FloatArray,
    friction: FloatArray,
    command: FloatArray,
    noise: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    d = len(forced[0])
    state, next_state, memory = np.zeros(2 * d), np.zeros(2 * d), np.zeros(12)
    state[:d] = command[0]
    n = len(command)
    out, reading = np.zeros(n), np.zeros(n)
    last_reading = command[0] + noise[0]
    kp, kv, max_voltage, force_per_volt, force_offset = (
        gains[0],
        gains[1],
        gains[2],
        gains[3],
        gains[4],
    )
    delay_rows, saturation_v = imperfections[0] / _PERIOD_S, imperfections[1]
    vibration_n, vibration_hz = imperfections[2], imperfections[3]
    h = _PERIOD_S / _SUBSTEP_COUNT
    for k in range(n):
        reading[k] = state[0] + noise[k]
        u = kv * (kp * (command[k] - reading[k]) - (reading[k] - last_reading) / _PERIOD_S)
        last_reading = reading[k]
        u = min(max(u, -max_voltage), max_voltage)
        # The output stage saturates softly.
        if saturation_v > 0.0:
            u = u / (1.0 + (abs(u) / saturation_v) ** 8) ** 0.125
        out[k] = u
        for s in range(_SUBSTEP_COUNT):
            sample = int(np.floor(k + s / _SUBSTEP_COUNT - delay_rows))
            output = out[sample] if sample >= 0 else 0.0
            now_s = (k + s / _SUBSTEP_COUNT) * _PERIOD_S
            total_force = force_per_volt * output - force_offset
            total_force += vibration_n * np.sin(2.0 * np.pi * vibration_hz * now_s)
            if friction[2] > 0.0:
                total_force += compute_load_force(friction, memory, state[0], state[d], k, h)
            for i in range(2 * d):
                next_state[i] = forced[i, 0] * total_force
                for j in range(2 * d):
                    next_state[i] += free[i, j] * state[j]
            state, next_state = next_state, state
    return out, reading


def draw_force_case(robot: Robot, seed: int) -> ForceCase:
    """Draw a case that is healthy, has one effect, or has friction and a flexible mode."""
    rng = np.random.default_rng((seed, 5))
    name, axis = next((n, a) for n, a in robot.axes.items() if isinstance(a, ForceAxis))
    training = (_draw_moves(rng, 20.0), _draw_moves(rng, 20.0))
    held_out = _draw_moves(rng, 12.0)
    effect_count = int(rng.choice([0, 1, 1, 1, 2]))
    effects_by_number: dict[int, list[str]] = {
        0: [],
        1: [FORCE_EFFECTS[rng.integers(len(FORCE_EFFECTS))]],
        2: ["friction", "flexible_mode"],
    }
    nominal = ForceLoop(np.zeros(LOAD_ROW_LENGTH))
    noise_v = _compute_rms_difference(axis, nominal, nominal, training, _NOISE_M)
    loop, present = nominal, tuple[tuple[str, float], ...]()
    for _ in range(_MAX_ATTEMPTS):
        loop_and_effects = _draw_effects(
            axis, effects_by_number[effect_count], training, noise_v, rng
        )
        if loop_and_effects is not None:
            loop, present = loop_and_effects
            break
    kind = ("healthy", "single", "double")[len(present)]
    return ForceCase(kind, axis, name, loop, training, held_out, seed, present)


def _draw_effects(
    axis: ForceAxis,
    effects: Sequence[str],
    training: tuple[SampledCommands, ...],
    noise_v: float,
    rng: np.random.Generator,
) -> tuple[ForceLoop, tuple[tuple[str, float], ...]] | None:
    """Draw the sizes of the effects; return None if one of them is too small to detect."""
    nominal = ForceLoop(np.zeros(LOAD_ROW_LENGTH))
    loops = [nominal]
    for effect in effects:
        loops.append(_add_effect(loops[-1], effect, rng, 10.0 ** rng.uniform(-1.5, 0.0)))
    present = []
    for before, effect, after in zip(loops, effects, loops[1:], strict=False):
        floors = _compute_rms_difference(axis, after, before, training, 0.0) / noise_v
        if floors < (MIN_FLOORS_IF_SEVERAL if len(effects) > 1 else MIN_FLOORS):
            return None
        present.append((effect, floors))
    return loops[-1], tuple(present)


def _add_effect(loop: ForceLoop, effect: str, rng: np.random.Generator, size: float) -> ForceLoop:
    match effect:
        case "friction":
            code = (SLIP, SLIP, DAHL, ELASTOPLASTIC)[rng.integers(4)]
            coulomb = 60.0 * size
            shape = {SLIP: 2e-3, DAHL: rng.uniform(0.7, 1.5)}.get(code, 0.6)
            row = np.zeros(LOAD_ROW_LENGTH)
            row[0], row[2:9] = (
                code,
                (coulomb, coulomb * rng.uniform(0.8, 1.2), 1.2, shape, 1e-5, 3e3, 0.0),
            )
            return loop._replace(friction=row)
        case "gain_error":
            return loop._replace(mass_share=0.3 * size * rng.choice([-1.0, 1.0]))
        case "delay":
            return loop._replace(delay_s=2.5e-3 * size)
        case "flexible_mode":
            share, hertz = 0.1 + 0.3 * size, np.exp(rng.uniform(np.log(5.0), np.log(45.0)))
            return loop._replace(appendage_share=share, appendage_hz=hertz)
        case "saturation":
            return loop._replace(saturation_v=rng.uniform(2.0, 6.0))
        case _:
            return loop._replace(vibration_n=20.0 * size, vibration_hz=rng.uniform(3.0, 30.0))


def _compute_rms_difference(
    axis: ForceAxis,
    loop: ForceLoop,
    other: ForceLoop,
    training: tuple[SampledCommands, ...],
    noise_m: float,
) -> float:
    """Return the rms difference (V) of u between two loops.

    Sensor noise is added only to the first loop.
    """
    mean_square_sum = 0.0
    for commands in training:
        command = commands.values[:, 0]
        noise = np.random.default_rng(1).normal(0.0, 1.0, len(command)) * noise_m
        noisy_u = run_loop(axis, loop, command, noise)[0]
        mean_square_sum += float(
            np.mean((noisy_u - run_loop(axis, other, command, 0.0 * noise)[0]) ** 2)
        )
    return float(np.sqrt(mean_square_sum / len(training)))


def _draw_moves(rng: np.random.Generator, length_s: float) -> SampledCommands:
    n = round(length_s / _PERIOD_S)
    path = np.full(n, 0.02)
    row, position = round(0.5 / _PERIOD_S), 0.02
    while row < n:
        target = rng.uniform(0.01, 0.24)
        min_duration_s = max(abs(target - position) / 0.2, 0.4)
        rows = round(min_duration_s * rng.uniform(1.0, 2.5) / _PERIOD_S)
        progress = np.minimum(np.arange(n - row) / rows, 1.0)
        path[row:] = position + (target - position) * (
            progress**3 * (10.0 - 15.0 * progress + 6.0 * progress**2)
        )
        row, position = row + rows + round(rng.uniform(0.1, 0.6) / _PERIOD_S), target
    return SampledCommands(_PERIOD_S, np.round(path, 9)[:, None])
