"""Cases of the second generator: drawing them, their labels, and their record files."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second.effects import (
    DRAW_FUNCTIONS,
    PIEZO_ONLY_EFFECTS,
    STEPPER_ONLY_EFFECTS,
    AddedEffect,
    draw_effect,
)
from rotemina.sim.blind_second.machine import SecondMachine, SecondMotion
from rotemina.sim.blind_second.machine_axis import SecondAxis, describe_axis
from rotemina.sim.blind_second.motions import draw_motions
from rotemina.sim.blind_second.remainder import draw_remainder
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot import Robot, assemble_inertia_matrices

CASE_KINDS = ("single", "double", "healthy")
_KIND_SHARES = (0.6, 0.28, 0.12)
# Bounds of the size of the first effect, in noise floors.
_MIN_FLOORS, _MAX_FLOORS = 1.6, 300.0
# A second effect must be at least this large, however large the first effect is.
_MIN_SECOND_FLOORS = 5.0
_MIN_EFFECT_TO_REMAINDER_RATIO = 2.0
# Bounds of the ratio of the remainder's rms to that of the gap.
_REMAINDER_SHARES = (0.05, 0.3)
_VOLTAGE_NOISE_V = 0.003
# Two effects of one set are not drawn on the same axis: they would look like each other with
# another size, or hide each other.
_INDISTINGUISHABLE_EFFECTS = (
    {"delay", "amplifier_lag", "sensor_lag"},
    {"gain_error", "sensor_gain", "stiffness_nonlinearity", "hysteresis"},
    {"static_nonlinearity", "sensor_nonlinearity", "saturation", "contact"},
    {"thermal_drift", "sensor_drift", "creep"},
    {"quantization", "sensor_quantization"},
    {"backlash", "friction"},
    {"resonance_mismatch", "flexible_mode"},
    {"leadscrew_error", "microstep_error", "encoder_interpolation"},
)


@dataclass(frozen=True, slots=True, eq=False)
class SecondCase:
    """A machine with its effects, and the motions that are recorded.

    The last motion is held out. ``floors`` has the size of each effect, ``gap`` that of the whole
    gap, and ``remainder`` that of the remainder, all in noise floors.
    """

    kind: str
    machine: SecondMachine
    motions: tuple[SecondMotion, ...]
    seed: int
    floors: tuple[float, ...]
    gap: float
    remainder: float | None

    def label(self) -> dict[str, Any]:
        """Return the correct answer as JSON."""
        added = self.machine.added[: len(self.floors)]
        effects = [
            {
                "axis": effect.axis.name,
                "effect": effect.effect,
                "from_axis": effect.from_axis,
                "floors": round(floors, 3),
            }
            for effect, floors in zip(added, self.floors, strict=True)
        ]
        return {
            "verdict": "explained" if effects else "none",
            "effects": effects,
            "hidden": [],
            "kind": self.kind,
            "floors": round(self.gap, 3),
            "remainder": None if self.remainder is None else {"floors": round(self.remainder, 3)},
        }

    def write(self, folder: Path, robot: Robot) -> None:
        """Write the training records, and the held-out commands and readings."""
        folder.mkdir(parents=True, exist_ok=True)
        for number, motion in enumerate(self.motions[:-1]):
            record = self._simulate_record(
                robot, motion, number, (Tap.CMD, Tap.U, Tap.REF, Tap.MEAS)
            )
            write_record(record, folder / f"train_{number + 1}.csv.gz")
        for name, taps in (("commands", (Tap.CMD,)), ("measured", (Tap.CMD, Tap.MEAS))):
            record = self._simulate_record(robot, self.motions[-1], len(self.motions), taps)
            write_record(record, folder / f"test_{name}.csv.gz")

    def _simulate_record(
        self, robot: Robot, motion: SecondMotion, number: int, selected_taps: Sequence[Tap]
    ) -> Record:
        taps = self.machine.run(motion, self.seed * 16 + number)
        rng = np.random.default_rng((self.seed, number))
        signals: dict[tuple[str, Tap], FloatArray] = {}
        for axis in self.machine.axes:
            i, noise = axis.index, rng.normal(size=(3, len(motion.values)))
            reading_steps = (taps.reading[:, i] + axis.noise * noise[2]) / axis.resolution
            axis_signals = {
                Tap.CMD: motion.values[:, i],
                Tap.U: taps.drive[:, i] / axis.position_per_volt + _VOLTAGE_NOISE_V * noise[0],
                Tap.REF: taps.motion[:, i]
                + (robot.reference.noise_rms.of(robot.unit(axis.name)) or 0.0) * noise[1],
                Tap.MEAS: np.round(reading_steps) * axis.resolution,
            }
            if axis.kind == "stepper":
                del axis_signals[Tap.U]
            signals |= {
                (axis.name, tap): axis_signals[tap] for tap in selected_taps if tap in axis_signals
            }
        time_s = np.asarray(np.arange(len(motion.values)) * motion.step_s, dtype=np.float64)
        units = {axis.name: robot.unit(axis.name) or "m" for axis in self.machine.axes}
        return Record.from_signals(time_s, signals, units, {"mode": "open_loop"})


def draw_second_case(robot: Robot, seed: int) -> SecondCase:
    """Draw a case from a seed. If the seed is odd, a faulty machine also has a remainder.

    Raises
    ------
    RuntimeError
        If no usable case is found in 200 attempts.
    """
    for attempt in range(200):
        rng = np.random.default_rng((seed, attempt, 2))
        case = _try_draw_case(robot, seed, str(rng.choice(CASE_KINDS, p=_KIND_SHARES)), rng)
        if case is not None:
            return case
    raise RuntimeError(f"no usable case in 200 attempts, seed {seed}")


def _try_draw_case(
    robot: Robot, seed: int, kind: str, rng: np.random.Generator
) -> SecondCase | None:
    stages = list(robot.stages.values())
    names = tuple(stages[rng.integers(len(stages))])
    motions = draw_motions(robot, names, rng)
    machine = _build_machine(robot, names, motions)
    if kind == "healthy":
        return SecondCase(kind, machine, tuple(motions), seed, (), 0.0, None)
    trial = _SizingTrial(machine, motions[:-1])
    axis = machine.axes[rng.integers(len(names))]
    added: list[AddedEffect] = []
    first_floors = float(np.exp(rng.uniform(np.log(_MIN_FLOORS), np.log(_MAX_FLOORS))))
    for effect in _choose_effects(axis, 2 if kind == "double" else 1, rng):
        others = [other for other in machine.axes if other is not axis]
        if effect == "cross_coupling" and not others:
            return None
        target_floors = first_floors
        if added:
            min_floors = min(1.2 * _MIN_SECOND_FLOORS, first_floors)
            target_floors = float(
                np.exp(rng.uniform(np.log(min_floors), np.log(2.0 * first_floors)))
            )
        sized_effect = trial.find_size(draw_effect(effect, axis, others, rng), target_floors)
        if sized_effect is None:
            return None
        added.append(sized_effect)
    gap = trial.compute_floors(added, [])
    floors = tuple(
        trial.compute_floors(added, [e for e in added if e is not sized_effect])
        for sized_effect in added
    )
    if min(floors) < (_MIN_SECOND_FLOORS if len(added) > 1 else _MIN_FLOORS):
        return None
    remainder_floors = None
    if seed % 2:
        remainder = draw_remainder(axis, rng).with_size(axis.floor)
        share = (
            rng.uniform(*_REMAINDER_SHARES)
            * gap
            / max(trial.compute_floors([remainder], []), 1e-12)
        )
        remainder_floors = trial.compute_floors([remainder.with_size(remainder.size * share)], [])
        if min(floors) < _MIN_EFFECT_TO_REMAINDER_RATIO * remainder_floors:
            return None
        added.append(remainder.with_size(remainder.size * share))
    return SecondCase(
        kind, machine.with_effects(added), tuple(motions), seed, floors, gap, remainder_floors
    )


def _build_machine(
    robot: Robot, names: tuple[str, ...], motions: Sequence[SecondMotion]
) -> SecondMachine:
    matrices = assemble_inertia_matrices(robot)
    # Axes that are coupled to the selected ones move with them.
    coupled = [set(pair.axes) for pair in robot.couplings if set(pair.axes) & set(names)]
    passive = [n for n in matrices.axes if n not in names and any(n in axes for axes in coupled)]
    rows = [matrices.axes.index(name) for name in (*names, *passive)]
    values = np.concatenate([motion.values for motion in motions])
    axes = tuple(describe_axis(robot, name, i, values[:, i]) for i, name in enumerate(names))
    mass, damping, stiffness = (matrix[np.ix_(rows, rows)] for matrix in matrices[1:])
    return SecondMachine(axes, mass, damping, stiffness)


def _choose_effects(axis: SecondAxis, count: int, rng: np.random.Generator) -> list[str]:
    """Choose effects that can occur on the axis and that can be distinguished."""
    excluded = STEPPER_ONLY_EFFECTS if axis.kind == "piezo" else PIEZO_ONLY_EFFECTS
    names = [name for name in (*DRAW_FUNCTIONS, "cross_coupling") if name not in excluded]
    while True:
        effects = [str(name) for name in rng.choice(names, count, replace=False)]
        if not any(len(alike & set(effects)) > 1 for alike in _INDISTINGUISHABLE_EFFECTS):
            return effects


class _SizingTrial:
    def __init__(self, machine: SecondMachine, motions: Sequence[SecondMotion]) -> None:
        self._machine, self._motions = machine, motions
        self._cache: dict[tuple[int, tuple[AddedEffect, ...]], FloatArray] = {}

    def compute_floors(
        self, added: Sequence[AddedEffect], baseline: Sequence[AddedEffect]
    ) -> float:
        """Return the rms difference between a machine with ``added`` and one with ``baseline``.

        It is in noise floors. The mean of each record is removed.
        """
        axis = added[0].axis
        differences = []
        for number, motion in enumerate(self._motions):
            difference = self._simulate_reading(added, number, motion) - self._simulate_reading(
                baseline, number, motion
            )
            differences.append((difference - difference.mean(axis=0))[:, axis.index])
        return float(np.sqrt(np.mean(np.concatenate(differences) ** 2))) / axis.floor

    def _simulate_reading(
        self, added: Sequence[AddedEffect], number: int, motion: SecondMotion
    ) -> FloatArray:
        key = number, tuple(added)
        if key not in self._cache:
            self._cache[key] = self._machine.with_effects(added).run(motion, number).reading
        return self._cache[key]

    def find_size(self, effect: AddedEffect, floors: float) -> AddedEffect | None:
        """Return the effect with the size at which it alone makes about ``floors``, or None."""
        effect = effect.with_size(effect.usual_size)
        for _ in range(5):
            reached_floors = self.compute_floors([effect], [])
            if 0.7 < reached_floors / floors < 1.4:
                return effect
            factor = float(np.clip(floors / max(reached_floors, 1e-9), 0.05, 20.0))
            effect = effect.with_size(min(effect.size * factor, 30.0 * effect.usual_size))
        return None
