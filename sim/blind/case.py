"""One case: its machine, its added parts, their sizes, and its label."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import excitation
from rotemina.sim.blind.catalogue import CATALOGUE
from rotemina.sim.blind.effect_functions import draw_part
from rotemina.sim.blind.effect_sizing import (
    LEAST_BESIDE,
    LEAST_FLOORS,
    MOST_FLOORS,
    OVER_REMAINDER,
    Present,
    Trial,
    record_seed,
)
from rotemina.sim.blind.machine import Commands, Machine, Response, machine_of
from rotemina.sim.blind.part import Axis, Part
from rotemina.sim.blind.remainder import LEAST_SHARE, MOST_SHARE, draw_remainder
from rotemina.sim.robot.model import Robot

# On one axis, the sum of two of these is a third, or the same with another size.
_ALIKE = (
    {"delay", "amplifier_lag", "sensor_lag"},
    {"gain_error", "sensor_gain", "hysteresis", "stiffness_nonlinearity"},
    {"gain_error", "sensor_gain", "static_nonlinearity", "sensor_nonlinearity"},
    {"static_nonlinearity", "sensor_nonlinearity", "saturation", "contact"},
    {"thermal_drift", "sensor_drift", "creep"},
    {"quantization", "sensor_quantization"},
    {"backlash", "friction"},
    {"resonance_mismatch", "flexible_mode"},
)
_PARAMETERS = ("gain_error", "resonance_mismatch")
_WITH_REMAINDER = ("single", "double", "triple", "parameter")  # half of these have one
# At one frequency and amplitude, or in one step, each of these is any of the others.
_POOR_SINE = (
    "delay",
    "amplifier_lag",
    "gain_error",
    "creep",
    "hysteresis",
    "sensor_gain",
    "sensor_lag",
)
_POOR_STEP = (
    "gain_error",
    "static_nonlinearity",
    "sensor_gain",
    "sensor_nonlinearity",
    "hysteresis",
)
_TWINS = (
    "sensor_gain",
    "sensor_nonlinearity",
    "sensor_lag",
    "gain_error",
    "static_nonlinearity",
    "amplifier_lag",
)


@dataclass(frozen=True, slots=True)
class Case:
    """A machine with parts, the commands it is run with and the taps that are recorded."""

    kind: str
    machine: Machine
    names: tuple[str, ...]
    training: tuple[Commands, ...]
    held_out: Commands
    taps: tuple[str, ...]
    seed: int
    present: tuple[Present, ...]
    remainder: Present | None = None

    def label(self) -> dict[str, Any]:
        """Return the answer that is right, as JSON."""
        effects = [
            {
                "axis": one.part.axis.name,
                "effect": one.part.effect,
                "from_axis": one.part.from_axis,
                "floors": round(one.floors, 3),
                "share": round(one.share, 4),
            }
            for one in self.present
        ]
        return {
            "verdict": _verdict(self.kind),
            "effects": [] if self.kind == "poor" else effects,
            "hidden": effects if self.kind == "poor" else [],
            "kind": self.kind,
            "floors": round(max((one.gap for one in self.present), default=0.0), 3),
            "remainder": None
            if self.remainder is None
            else {
                "axis": self.remainder.part.axis.name,
                "floors": round(self.remainder.floors, 3),
                "share": round(self.remainder.share, 4),
            },
        }


def _verdict(kind: str) -> str:
    return {"healthy": "none", "unknown": "unknown", "poor": "insufficient_excitation"}.get(
        kind, "explained"
    )


def draw_case(robot: Robot, kind: str, seed: int, effect: str | None = None) -> Case:
    """Draw a case of a kind whose parts count by what they do; ``effect``: which it must hold."""
    for attempt in range(100):
        rng = np.random.default_rng((seed, attempt))
        case = _attempt(robot, kind, rng, seed, effect)
        if case is not None:
            return case
    raise RuntimeError(f"no case of kind {kind} with {effect} came about; seed {seed}")


def _attempt(
    robot: Robot, kind: str, rng: np.random.Generator, seed: int, effect: str | None
) -> Case | None:
    names = _names(robot, rng, effect)
    step = bool(rng.uniform() < 0.4)
    if kind == "poor":
        training = excitation.poor_training(robot, names, rng, step=step)
    else:
        training = excitation.training(robot, names, rng)
    spans = np.array([robot.axes[name].range for name in names]).T
    training = [Commands(c.step_s, np.clip(c.values, *spans)) for c in training]
    lowest = np.min([c.values.min(axis=0) for c in training], axis=0)
    highest = np.max([c.values.max(axis=0) for c in training], axis=0)
    travels = {n: np.array([lowest[i], highest[i]]) for i, n in enumerate(names)}
    held_out = excitation.held_out(robot, names, travels, rng)
    rounded = [_as_written(robot, names, c) for c in (*training, held_out)]
    machine = machine_of(robot, names, travels)
    trial = Trial(machine, tuple(rounded[:-1]), int(rng.integers(2**31)))
    present = _present(trial, kind, rng, effect, step=step)
    if present is None:
        return None
    remainder = None
    if kind in _WITH_REMAINDER and seed % 2:
        remainder = _remainder(trial, present, rng)
        if remainder is None:
            return None
    parts = [one.part for one in present] + ([remainder.part] if remainder else [])
    machine = machine.having(parts)
    return Case(
        kind,
        machine,
        names,
        tuple(rounded[:-1]),
        rounded[-1],
        _taps(machine, rng),
        seed,
        () if kind == "healthy" else tuple(present),
        remainder,
    )


def _remainder(
    trial: Trial, present: Sequence[Present], rng: np.random.Generator
) -> Present | None:
    """Return what the machine also does; None where it does not leave every effect clear."""
    parts = [one.part for one in present]
    share = float(rng.uniform(LEAST_SHARE, MOST_SHARE))
    part = trial.with_share(draw_remainder(parts[0].axis, rng), parts, share)
    floors = trial.rms(part)
    own = [one.floors for one in present if one.part.axis is part.axis]
    return Present(part, floors, share) if min(own) >= OVER_REMAINDER * floors else None


def _names(robot: Robot, rng: np.random.Generator, effect: str | None) -> tuple[str, ...]:
    """Return the axes of one stage on which the effect can sit, of any where none can carry it."""
    kinds = CATALOGUE[effect].kinds if effect in CATALOGUE else ("piezo", "stepper")
    every = list(robot.stages.values())
    stages = [stage for stage in every if robot.axes[stage[0]].kind in kinds] or every
    return tuple(stages[rng.integers(len(stages))])


def _as_written(robot: Robot, names: Sequence[str], commands: Commands) -> Commands:
    """Round commands to the digits that files hold: what was applied is what is written."""
    values = np.empty_like(commands.values, order="F")
    for i, name in enumerate(names):
        per_si = file_unit(robot, name)[1]
        values[:, i] = significant(commands.values[:, i] * per_si) / per_si
    return Commands(commands.step_s, values)


def file_unit(robot: Robot, name: str) -> tuple[str, float]:
    """Return the unit in which files show an axis, and how many of it make the SI unit."""
    if robot.unit(name) == "rad":
        return "urad", 1e6
    return ("mm", 1e3) if robot.axes[name].kind == "stepper" else ("um", 1e6)


def significant(values: FloatArray, digits: int = 7) -> FloatArray:
    """Round to so many significant digits."""
    size = np.floor(np.log10(np.maximum(np.abs(values), 1e-300)))
    scale = 10.0 ** (digits - 1 - np.maximum(size, -12.0))
    return np.asarray(np.round(values * scale) / scale)


def _taps(machine: Machine, rng: np.random.Generator) -> tuple[str, ...]:
    effects = {part.effect for part in machine.parts}
    if machine.axes[0].kind == "stepper":
        choices: tuple[tuple[str, ...], ...] = (("meas",), ("ref", "meas"))
    else:
        choices = (("meas",), ("u", "ref", "meas"), ("u", "meas"), ("ref", "meas"))
    with_ref = [choice for choice in choices if "ref" in choice]
    if effects & set(_TWINS) and rng.uniform() < 0.85:
        return with_ref[rng.integers(len(with_ref))]
    return choices[
        rng.choice(len(choices), p=(0.5, 0.5) if len(choices) == 2 else (0.4, 0.4, 0.1, 0.1))
    ]


def _present(
    trial: Trial,
    kind: str,
    rng: np.random.Generator,
    effect: str | None,
    *,
    step: bool,
) -> list[Present] | None:
    """Draw parts and sizes; None where one of them would not be there to be found."""
    if kind == "healthy":
        return _slightly_off(trial, rng)
    least = 4.0 if kind == "poor" else 1.1 * LEAST_FLOORS
    floors = float(np.exp(rng.uniform(np.log(least), np.log(MOST_FLOORS))))
    parts: list[Part] = []
    for axis, name in _places(trial.machine.axes, kind, rng, effect, step=step):
        others = tuple(a for a in trial.machine.axes if a is not axis)
        part = draw_part(name, axis, others, rng)
        near = _beside(floors, rng) if parts else floors
        sized = trial.sized(part, near)
        if sized is None:
            return None
        parts.append(sized)
    present = trial.present(parts)
    # Under poor excitation it is the point that nothing is distinct.
    return present if present is None or kind == "poor" or trial.distinct(parts) else None


def _beside(floors: float, rng: np.random.Generator) -> float:
    """Draw the size of a further effect: down to a few floors, however large the first is."""
    least = min(1.2 * LEAST_BESIDE, floors)
    return float(np.exp(rng.uniform(np.log(least), np.log(2.2 * floors))))


def _places(
    axes: tuple[Axis, ...],
    kind: str,
    rng: np.random.Generator,
    effect: str | None,
    *,
    step: bool,
) -> list[tuple[Axis, str]]:
    number = {"double": 2, "triple": 3}.get(kind, 1)
    first = axes[rng.integers(len(axes))]
    names = [name for name, entry in CATALOGUE.items() if first.kind in entry.kinds]
    if len(axes) == 1:
        names.remove("cross_coupling")
    if kind == "unknown":
        return [(first, "unknown")]
    if kind == "poor":
        pool = [name for name in (_POOR_STEP if step else _POOR_SINE) if name in names]
        return [(first, pool[rng.integers(len(pool))])]
    if kind == "parameter":
        return [(first, _PARAMETERS[rng.integers(len(_PARAMETERS))])]
    chosen = [str(name) for name in rng.choice(names, number, replace=False)]
    if effect in names:
        chosen = [str(effect), *(name for name in chosen if name != effect)][:number]
    together = rng.uniform() < 0.5 and not any(len(set(chosen) & one) > 1 for one in _ALIKE)
    order = rng.permutation(len(axes))
    start = int(np.flatnonzero(order == first.index)[0])
    places = [first if together else axes[order[(start + k) % len(axes)]] for k in range(number)]
    return list(zip(places, chosen, strict=True))


def _slightly_off(trial: Trial, rng: np.random.Generator) -> list[Present] | None:
    """Return parameters that are off by less than shows, for half of the healthy machines."""
    if rng.uniform() < 0.5:
        return []
    axes = trial.machine.axes
    name = _PARAMETERS[rng.integers(len(_PARAMETERS))]
    part = draw_part(name, axes[rng.integers(len(axes))], (), rng)
    sized = trial.sized(part, rng.uniform(0.05, 0.2), low=0.0, free=True)
    return None if sized is None else [Present(sized, 0.0, 0.0)]


def measured(case: Case, commands: Commands, number: int) -> tuple[Response, FloatArray]:
    """Run the case over one record; return its taps and the reading with noise, rounded."""
    response = case.machine.respond(commands, record_seed(case.seed, number))
    chance = np.random.default_rng((case.seed, 77, number))
    reading = response.reading.copy()
    for axis in case.machine.axes:
        noisy = reading[:, axis.index] + chance.normal(0.0, axis.noise, len(reading))
        reading[:, axis.index] = np.round(noisy / axis.resolution) * axis.resolution
    return response, reading
