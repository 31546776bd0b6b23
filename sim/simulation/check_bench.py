"""Bench for the check of an effect: an axis, its commands, and the contribution of the effect."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import isfinite, pi
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import (
    AttachedEffect,
    AxisChange,
    AxisProperties,
    Effect,
    EffectParameter,
    ForceFunction,
    Formulation,
    Values,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import (
    Axis,
    AxisEffect,
    ForceAxis,
    Robot,
    StepperAxis,
)
from rotemina.sim.simulation.simulation import simulate

SEED = 20260
_ROWS_PER_PERIOD = 8.0
_RATE_LIMITS_HZ = (500.0, 8000.0)
# Travel from mid-range to each side, relative to the range.
_TRAVEL_RATIO = 0.3
# Largest travel of a stepper to each side, in pitches.
_MAX_TRAVEL_PITCHES = 2.0
# Value that stands for the bound of an unbounded parameter, relative to its preset.
_UNBOUNDED_PRESET_RATIO = 1e3
# An axis counts as at rest after this many of its time constants.
_REST_TIME_CONSTANTS = 50.0
_MAX_REST_ROWS = 4000
_NO_DYNAMICS = dict.fromkeys(
    ("mass", "damping", "stiffness", "natural_frequency_hz", "damping_ratio"), None
)


@dataclass(frozen=True, slots=True, eq=False)
class EffectBench:
    """Check bench for one formulation of an effect, on one axis of a robot with perfect sensors."""

    robot: Robot
    axis: str
    from_axis: str | None
    effect: Effect
    formulation: Formulation

    @property
    def location(self) -> str:
        """Names of robot and axis, as in a report."""
        return f"{self.robot.name} {self.axis}"

    @property
    def robot_axis(self) -> Axis:
        """Model of the axis."""
        return self.robot.axes[self.axis]

    @property
    def facts(self) -> AxisProperties:
        """Properties of the axis."""
        return AxisProperties.of(self.robot_axis)

    @property
    def presets(self) -> dict[str, float]:
        """All parameters at their presets."""
        return {p.name: p.preset(self.facts) for p in self.formulation.parameters}

    @property
    def is_held(self) -> bool:
        """Whether the axis rests at one position under a constant command."""
        return not isinstance(self.robot_axis, ForceAxis)

    @property
    def rate_hz(self) -> float:
        """Sampling rate."""
        return float(np.clip(_ROWS_PER_PERIOD * self.facts.pace_hz, *_RATE_LIMITS_HZ))

    @property
    def rest_rows(self) -> int:
        """Number of rows in which the axis comes to rest."""
        decay = 2.0 * pi * self.facts.frequency_hz * self.facts.damping_ratio
        if decay <= 0.0:
            return 200
        return int(min(_REST_TIME_CONSTANTS / decay * self.rate_hz + 200.0, _MAX_REST_ROWS))

    def make_entry(self, values: Values | None = None) -> AxisEffect:
        """Return the entry of the effect with these values, or with its presets."""
        return AxisEffect(
            axis=self.axis,
            id=self.effect.id,
            formulation=self.formulation.name,
            parameters=dict(values or {}),
            from_axis=self.from_axis,
        )

    def attach(self, values: Values | None = None) -> AttachedEffect:
        """Attach the effect.

        Raises
        ------
        EffectError
            If it is refused.
        """
        return AttachedEffect.of(self.robot, self.make_entry(values))

    def as_static(self) -> Self | None:
        """Return the bench with an axis that follows its input immediately.

        It is None if the effect needs an axis with dynamics.
        """
        if not self.is_held or isinstance(self.formulation.acts, ForceFunction | AxisChange):
            return None
        static_axes = {self.axis, self.from_axis}
        axes = {
            name: replace(axis, static=True, **_NO_DYNAMICS)  # type: ignore[arg-type]
            if name in static_axes and not isinstance(axis, ForceAxis)
            else axis
            for name, axis in self.robot.axes.items()
        }
        return replace(self, robot=replace(self.robot, axes=axes, couplings=()))

    def make_commands(self, shape: FloatArray, *, slowdown: float = 1.0) -> Record:
        """Return commands that follow ``shape`` (n,), −1 … 1 about mid-range.

        Every axis that the effect needs moves in the same way. A force axis gets a voltage about
        the one that keeps it at rest.
        """
        time_s = np.arange(len(shape), dtype=np.float64) * (slowdown / self.rate_hz)
        names = [self.axis] if self.from_axis is None else [self.axis, self.from_axis]
        signals: dict[tuple[str, Tap], FloatArray] = {}
        for name in names:
            axis = self.robot.axes[name]
            if isinstance(axis, ForceAxis):
                facts = AxisProperties.of(axis)
                balance = axis.force_offset / axis.gain
                signals[name, Tap.CMD] = np.full(len(shape), _find_middle(axis))
                signals[name, Tap.U] = balance + 0.05 * facts.input_span * shape
            else:
                signals[name, Tap.CMD] = _find_middle(axis) + compute_travel(axis) * shape
        units = {name: self.robot.axes[name].unit or "m" for name in names}
        return Record.from_signals(time_s, signals, units)

    def run(
        self,
        commands: Record,
        values: Values | None = None,
        *,
        seed: int | None = None,
        effects: Sequence[AxisEffect] | None = None,
    ) -> Record:
        """Return the record of a run with the effect, or with ``effects`` instead."""
        applied_effects = [self.make_entry(values)] if effects is None else effects
        rng = np.random.default_rng(seed) if seed is not None else None
        return simulate(self.robot, applied_effects, commands, rng)

    def measure_contribution(
        self, commands: Record, values: Values | None = None, *, seed: int | None = None
    ) -> FloatArray:
        """Return the contribution of the effect to reference and reading, (n, 2), m or rad."""
        return self.read_signals(self.run(commands, values, seed=seed)) - self.read_signals(
            self.run(commands, seed=seed, effects=())
        )

    def read_signals(self, record: Record) -> FloatArray:
        """Return reference and reading of the axis, (n, 2)."""
        return np.stack([record.signal(self.axis, tap) for tap in (Tap.REF, Tap.MEAS)], axis=1)

    def find_zero_values(self) -> dict[str, float] | None:
        """Return 0 for each parameter that may be 0, or None if none may.

        These values may remove the effect.
        """
        zero = {p.name: 0.0 for p in self.formulation.parameters if p.low <= 0.0 <= p.high}
        return zero or None

    def list_corners(self) -> Iterable[dict[str, float]]:
        """Yield values at the bounds: all lower bounds, all upper bounds, and each bound alone."""
        ends = {p.name: self._find_ends(p) for p in self.formulation.parameters}
        for side in (0, 1):
            yield {name: pair[side] for name, pair in ends.items()}
        for name, pair in ends.items():
            for end in pair:
                yield {name: end}

    def _find_ends(self, parameter: EffectParameter) -> tuple[float, float]:
        low, high = parameter.bounds(self.facts)
        far_value = _UNBOUNDED_PRESET_RATIO * abs(parameter.preset(self.facts)) or 1.0
        return (low if isfinite(low) else -far_value), (high if isfinite(high) else far_value)


def compute_travel(axis: Axis) -> float:
    """Return the travel of an axis to each side, m or rad."""
    travel = _TRAVEL_RATIO * axis.span
    if isinstance(axis, StepperAxis):
        travel = min(travel, _MAX_TRAVEL_PITCHES * AxisProperties.of(axis).pitch)
    return travel


def make_benches(effect: Effect, robots: Sequence[Robot]) -> list[EffectBench]:
    """Return a bench for every formulation on one axis of each kind, with dynamics and static."""
    benches: list[EffectBench] = []
    for formulation in effect.formulations:
        covered_kinds: set[tuple[str, bool]] = set()
        for robot in map(_without_noise, robots):
            for name, axis in robot.axes.items():
                needs_dynamics = isinstance(formulation.acts, ForceFunction | AxisChange)
                others = [other for other in robot.axes if other != name]
                is_unsuitable = axis.kind not in effect.kinds or (axis.static and needs_dynamics)
                if (
                    is_unsuitable
                    or (axis.kind, axis.static) in covered_kinds
                    or (effect.coupled and not others)
                ):
                    continue
                covered_kinds.add((axis.kind, axis.static))
                source = others[0] if effect.coupled else None
                benches.append(EffectBench(robot, name, source, effect, formulation))
    return benches


def _without_noise(robot: Robot) -> Robot:
    """Return the robot without effects, declared noise and rounding, so that motions superpose."""
    axes: Mapping[str, Axis] = {
        name: replace(axis, sensor=None) for name, axis in robot.axes.items()
    }
    return replace(robot, axes=axes, effects=())


def _find_middle(axis: Axis) -> float:
    return 0.5 * (axis.range[0] + axis.range[1])


@lru_cache
def make_waves(rows: int) -> FloatArray:
    """Return a motion that begins softly: three sines without a common period."""
    phase = np.linspace(0.0, 2.0 * pi, rows)
    wave = 0.5 * np.sin(3.0 * phase) + 0.3 * np.sin(7.3 * phase) - 0.2 * np.sin(1.6 * phase)
    return np.asarray(wave * np.minimum(phase, 1.0))


@lru_cache
def make_moves(rows: int) -> FloatArray:
    """Return steps up and down with rests in between."""
    levels = np.array([0.0, 0.6, 0.1, -0.8, -0.3, 0.9])
    return np.repeat(levels, -(-rows // len(levels)))[:rows]


def make_path(places: Sequence[float], rise_rows: int, rest_rows: int) -> FloatArray:
    """Return a smooth path through places, −1 … 1, that rests at the last one."""
    ease = 0.5 - 0.5 * np.cos(np.linspace(0.0, pi, rise_rows))
    parts = [begin + (end - begin) * ease for begin, end in pairwise(places)]
    return np.concatenate([*parts, np.full(rest_rows, places[-1])])
