"""Cases of a blind test: the machine, the effects added to it, and the correct answer."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import excitation
from rotemina.sim.blind.catalogue import CATALOGUE
from rotemina.sim.blind.effect_functions import draw_part
from rotemina.sim.blind.effect_sizing import (
    MAX_FLOORS,
    MIN_EFFECT_TO_REMAINDER_RATIO,
    MIN_FLOORS,
    MIN_FLOORS_IF_SEVERAL,
    PresentEffect,
    SizingTrial,
    make_record_seed,
)
from rotemina.sim.blind.machine import BlindMachine, MachineResponse, SampledCommands, build_machine
from rotemina.sim.blind.part import BlindAxis, EffectPart
from rotemina.sim.blind.remainder import MAX_REMAINDER_SHARE, MIN_REMAINDER_SHARE, draw_remainder
from rotemina.sim.robot import Robot

# Two effects of one set are not drawn on the same axis: together they would look like a third
# effect, or like one of the two with another size.
_INDISTINGUISHABLE_EFFECTS = (
    {"delay", "amplifier_lag", "sensor_lag"},
    {"gain_error", "sensor_gain", "hysteresis", "stiffness_nonlinearity"},
    {"gain_error", "sensor_gain", "static_nonlinearity", "sensor_nonlinearity"},
    {"static_nonlinearity", "sensor_nonlinearity", "saturation", "contact"},
    {"thermal_drift", "sensor_drift", "creep"},
    {"quantization", "sensor_quantization"},
    {"backlash", "friction"},
    {"resonance_mismatch", "flexible_mode"},
)
_PARAMETER_EFFECTS = ("gain_error", "resonance_mismatch")
# Half of the cases of these kinds have a remainder that no effect explains.
_KINDS_WITH_REMAINDER = ("single", "double", "triple", "parameter")
# At a single frequency and amplitude, all these effects look the same.
_EFFECTS_ALIKE_IN_SINE = (
    "delay",
    "amplifier_lag",
    "gain_error",
    "creep",
    "hysteresis",
    "sensor_gain",
    "sensor_lag",
)
# In a single step, all these effects look the same.
_EFFECTS_ALIKE_IN_STEP = (
    "gain_error",
    "static_nonlinearity",
    "sensor_gain",
    "sensor_nonlinearity",
    "hysteresis",
)
# Effects of the actuator and of the sensor that only a reference sensor can distinguish.
_EFFECTS_NEEDING_REFERENCE = (
    "sensor_gain",
    "sensor_nonlinearity",
    "sensor_lag",
    "gain_error",
    "static_nonlinearity",
    "amplifier_lag",
)


@dataclass(frozen=True, slots=True)
class BlindCase:
    """A machine with added effects, its commands, and the taps that are recorded."""

    kind: str
    machine: BlindMachine
    axis_names: tuple[str, ...]
    training: tuple[SampledCommands, ...]
    held_out: SampledCommands
    taps: tuple[str, ...]
    seed: int
    present_effects: tuple[PresentEffect, ...]
    remainder: PresentEffect | None = None

    def label(self) -> dict[str, Any]:
        """Return the correct answer as a dictionary that can be written as JSON.

        All values called ``floors`` are multiples of the noise floor. Those of an effect are the
        rms that it adds to the gap, and that of the case is the rms of the largest gap of an axis.
        A ``share`` is a fraction of the gap of the axis: of its power for an effect, of its rms for
        the remainder. The effects are ``hidden`` if the excitation is too poor to identify them.
        """
        effects = [
            {
                "axis": effect.part.axis.name,
                "effect": effect.part.effect,
                "from_axis": effect.part.from_axis,
                "floors": round(effect.floors, 3),
                "share": round(effect.share, 4),
            }
            for effect in self.present_effects
        ]
        return {
            "verdict": _get_verdict(self.kind),
            "effects": [] if self.kind == "poor" else effects,
            "hidden": effects if self.kind == "poor" else [],
            "kind": self.kind,
            "floors": round(max((effect.gap for effect in self.present_effects), default=0.0), 3),
            "remainder": None
            if self.remainder is None
            else {
                "axis": self.remainder.part.axis.name,
                "floors": round(self.remainder.floors, 3),
                "share": round(self.remainder.share, 4),
            },
        }


def _get_verdict(kind: str) -> str:
    return {"healthy": "none", "unknown": "unknown", "poor": "insufficient_excitation"}.get(
        kind, "explained"
    )


def draw_case(robot: Robot, kind: str, seed: int, effect: str | None = None) -> BlindCase:
    """Draw a case of the given kind.

    Parameters
    ----------
    robot : Robot
    kind : str
        Such as ``single``, ``double``, ``healthy`` or ``unknown``.
    seed : int
    effect : str, optional
        Id of an effect that the case must contain.

    Raises
    ------
    RuntimeError
        If no usable case is found in 100 attempts.
    """
    for attempt in range(100):
        rng = np.random.default_rng((seed, attempt))
        case = _try_draw_case(robot, kind, rng, seed, effect)
        if case is not None:
            return case
    raise RuntimeError(f"no usable case of kind {kind} with {effect} in 100 attempts, seed {seed}")


def _try_draw_case(
    robot: Robot, kind: str, rng: np.random.Generator, seed: int, required_effect: str | None
) -> BlindCase | None:
    names = _draw_axis_names(robot, rng, required_effect)
    is_step_excitation = bool(rng.uniform() < 0.4)
    if kind == "poor":
        training = excitation.draw_poor_training(robot, names, rng, step=is_step_excitation)
    else:
        training = excitation.draw_training(robot, names, rng)
    low, high = np.array([robot.axes[name].range for name in names]).T
    training = [SampledCommands(c.step_s, np.clip(c.values, low, high)) for c in training]
    lowest = np.min([c.values.min(axis=0) for c in training], axis=0)
    highest = np.max([c.values.max(axis=0) for c in training], axis=0)
    travels = {n: np.array([lowest[i], highest[i]]) for i, n in enumerate(names)}
    held_out = excitation.draw_held_out(robot, names, travels, rng)
    rounded_commands = [_round_as_written(robot, names, c) for c in (*training, held_out)]
    machine = build_machine(robot, names, travels)
    trial = SizingTrial(machine, tuple(rounded_commands[:-1]), int(rng.integers(2**31)))
    present_effects = _draw_present_effects(
        trial, kind, rng, required_effect, is_step_excitation=is_step_excitation
    )
    if present_effects is None:
        return None
    remainder = None
    if kind in _KINDS_WITH_REMAINDER and seed % 2:
        remainder = _draw_sized_remainder(trial, present_effects, rng)
        if remainder is None:
            return None
    parts = [effect.part for effect in present_effects] + ([remainder.part] if remainder else [])
    machine = machine.with_parts(parts)
    return BlindCase(
        kind,
        machine,
        names,
        tuple(rounded_commands[:-1]),
        rounded_commands[-1],
        _draw_taps(machine, rng),
        seed,
        () if kind == "healthy" else tuple(present_effects),
        remainder,
    )


def _draw_sized_remainder(
    trial: SizingTrial, present: Sequence[PresentEffect], rng: np.random.Generator
) -> PresentEffect | None:
    """Draw and size a remainder; return None if it would hide an effect."""
    parts = [effect.part for effect in present]
    gap_share = float(rng.uniform(MIN_REMAINDER_SHARE, MAX_REMAINDER_SHARE))
    part = trial.scale_remainder(draw_remainder(parts[0].axis, rng), parts, gap_share)
    size_in_floors = trial.compute_floors(part)
    effect_sizes_in_floors = [effect.floors for effect in present if effect.part.axis is part.axis]
    return (
        PresentEffect(part, size_in_floors, gap_share)
        if min(effect_sizes_in_floors) >= MIN_EFFECT_TO_REMAINDER_RATIO * size_in_floors
        else None
    )


def _draw_axis_names(
    robot: Robot, rng: np.random.Generator, required_effect: str | None
) -> tuple[str, ...]:
    """Return the axes of a random stage on which the effect can occur, or else of any stage."""
    axis_kinds = (
        CATALOGUE[required_effect].kinds if required_effect in CATALOGUE else ("piezo", "stepper")
    )
    all_stages = list(robot.stages.values())
    stages = [
        stage for stage in all_stages if robot.axes[stage[0]].kind in axis_kinds
    ] or all_stages
    return tuple(stages[rng.integers(len(stages))])


def _round_as_written(
    robot: Robot, names: Sequence[str], commands: SampledCommands
) -> SampledCommands:
    """Round the commands to the digits that the files contain, so that files and runs agree."""
    values = np.empty_like(commands.values, order="F")
    for i, name in enumerate(names):
        per_si = get_file_unit(robot, name)[1]
        values[:, i] = round_significant(commands.values[:, i] * per_si) / per_si
    return SampledCommands(commands.step_s, values)


def get_file_unit(robot: Robot, name: str) -> tuple[str, float]:
    """Return the unit that files use for an axis, and the factor from SI to that unit."""
    if robot.unit(name) == "rad":
        return "urad", 1e6
    return ("mm", 1e3) if robot.axes[name].kind == "stepper" else ("um", 1e6)


def round_significant(values: FloatArray, digits: int = 7) -> FloatArray:
    """Round values to the given number of significant digits."""
    magnitude = np.floor(np.log10(np.maximum(np.abs(values), 1e-300)))
    # The bound keeps the scale finite for values that are zero or almost zero.
    scale = 10.0 ** (digits - 1 - np.maximum(magnitude, -12.0))
    return np.asarray(np.round(values * scale) / scale)


def _draw_taps(machine: BlindMachine, rng: np.random.Generator) -> tuple[str, ...]:
    effects = {part.effect for part in machine.parts}
    if machine.axes[0].kind == "stepper":
        choices: tuple[tuple[str, ...], ...] = (("meas",), ("ref", "meas"))
    else:
        choices = (("meas",), ("u", "ref", "meas"), ("u", "meas"), ("ref", "meas"))
    choices_with_reference = [choice for choice in choices if "ref" in choice]
    if effects & set(_EFFECTS_NEEDING_REFERENCE) and rng.uniform() < 0.85:
        return choices_with_reference[rng.integers(len(choices_with_reference))]
    return choices[
        rng.choice(len(choices), p=(0.5, 0.5) if len(choices) == 2 else (0.4, 0.4, 0.1, 0.1))
    ]


def _draw_present_effects(
    trial: SizingTrial,
    kind: str,
    rng: np.random.Generator,
    required_effect: str | None,
    *,
    is_step_excitation: bool,
) -> list[PresentEffect] | None:
    """Draw the effects with their sizes; return None if one of them would be too small to find."""
    if kind == "healthy":
        return _draw_small_deviation(trial, rng)
    # Sizes are in noise floors.
    min_size = 4.0 if kind == "poor" else 1.1 * MIN_FLOORS
    first_size = float(np.exp(rng.uniform(np.log(min_size), np.log(MAX_FLOORS))))
    parts: list[EffectPart] = []
    for axis, name in _choose_axes_and_effects(
        trial.machine.axes, kind, rng, required_effect, is_step_excitation=is_step_excitation
    ):
        others = tuple(a for a in trial.machine.axes if a is not axis)
        part = draw_part(name, axis, others, rng)
        size = _draw_additional_size(first_size, rng) if parts else first_size
        sized = trial.find_size(part, size)
        if sized is None:
            return None
        parts.append(sized)
    present = trial.measure_effects(parts)
    # With poor excitation no effects are distinct, so this is not checked.
    if present is not None and kind != "poor" and not trial.are_distinct(parts):
        return None
    return present


def _draw_additional_size(first_size: float, rng: np.random.Generator) -> float:
    """Draw the size of a second or third effect; all sizes are in noise floors.

    It may be as small as a few noise floors, however large the first effect is.
    """
    min_size = min(1.2 * MIN_FLOORS_IF_SEVERAL, first_size)
    return float(np.exp(rng.uniform(np.log(min_size), np.log(2.2 * first_size))))


def _choose_axes_and_effects(
    axes: tuple[BlindAxis, ...],
    kind: str,
    rng: np.random.Generator,
    required_effect: str | None,
    *,
    is_step_excitation: bool,
) -> list[tuple[BlindAxis, str]]:
    count = {"double": 2, "triple": 3}.get(kind, 1)
    first_axis = axes[rng.integers(len(axes))]
    possible_effects = [name for name, entry in CATALOGUE.items() if first_axis.kind in entry.kinds]
    if len(axes) == 1:
        possible_effects.remove("cross_coupling")
    if kind == "unknown":
        return [(first_axis, "unknown")]
    if kind == "poor":
        candidates = [
            name
            for name in (_EFFECTS_ALIKE_IN_STEP if is_step_excitation else _EFFECTS_ALIKE_IN_SINE)
            if name in possible_effects
        ]
        return [(first_axis, candidates[rng.integers(len(candidates))])]
    if kind == "parameter":
        return [(first_axis, _PARAMETER_EFFECTS[rng.integers(len(_PARAMETER_EFFECTS))])]
    effects = [str(name) for name in rng.choice(possible_effects, count, replace=False)]
    if required_effect in possible_effects:
        effects = [str(required_effect), *(name for name in effects if name != required_effect)][
            :count
        ]
    is_shared_axis = rng.uniform() < 0.5 and not any(
        len(set(effects) & alike) > 1 for alike in _INDISTINGUISHABLE_EFFECTS
    )
    axis_order = rng.permutation(len(axes))
    start = int(np.flatnonzero(axis_order == first_axis.index)[0])
    effect_axes = [
        first_axis if is_shared_axis else axes[axis_order[(start + k) % len(axes)]]
        for k in range(count)
    ]
    return list(zip(effect_axes, effects, strict=True))


def _draw_small_deviation(
    trial: SizingTrial, rng: np.random.Generator
) -> list[PresentEffect] | None:
    """Draw the small deviation of a healthy machine.

    Half of the healthy machines have a parameter error that is too small to detect.
    """
    if rng.uniform() < 0.5:
        return []
    axes = trial.machine.axes
    name = _PARAMETER_EFFECTS[rng.integers(len(_PARAMETER_EFFECTS))]
    part = draw_part(name, axes[rng.integers(len(axes))], (), rng)
    sized = trial.find_size(part, rng.uniform(0.05, 0.2), min_gap_floors=0.0, allow_tiny_size=True)
    return None if sized is None else [PresentEffect(sized, 0.0, 0.0)]


def simulate_record(
    case: BlindCase, commands: SampledCommands, number: int
) -> tuple[MachineResponse, FloatArray]:
    """Simulate the case over one record.

    Returns
    -------
    response : MachineResponse
        The taps of the machine, without sensor noise.
    reading : (n, m)
        Readings with sensor noise, rounded to the resolution of the sensors, m or rad.
    """
    response = case.machine.respond(commands, make_record_seed(case.seed, number))
    rng = np.random.default_rng((case.seed, 77, number))
    reading = response.reading.copy()
    for axis in case.machine.axes:
        noisy = reading[:, axis.index] + rng.normal(0.0, axis.noise, len(reading))
        reading[:, axis.index] = np.round(noisy / axis.resolution) * axis.resolution
    return response, reading
