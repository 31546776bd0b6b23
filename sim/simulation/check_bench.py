"""The bench on which effects are checked: an axis, commands for it, and what an effect adds."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import isfinite, pi
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import (
    Change,
    Effect,
    Force,
    Formulation,
    Parameter,
    Values,
)
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis, AxisEffect, ForceAxis, Robot, StepperAxis
from rotemina.sim.simulation.simulation import simulate

SEED = 20260
_ROWS_PER_PERIOD = 8.0
_RATES_HZ = (500.0, 8000.0)
_TRAVEL = 0.3  # of the range, to each side
_PITCHES = 2.0  # that a stepper travels to each side at most
_FAR = 1e3  # times the preset, where a parameter has no upper bound
_SETTLED = 50.0  # time constants of the axis after which it rests
_LONGEST_REST = 4000  # rows
_UNTOLD = dict.fromkeys(
    ("mass", "damping", "stiffness", "natural_frequency_hz", "damping_ratio"), None
)


@dataclass(frozen=True, slots=True, eq=False)
class Bench:
    """One formulation of an effect on one axis of a robot whose sensors are perfect."""

    robot: Robot
    axis: str
    from_axis: str | None
    effect: Effect
    formulation: Formulation

    @property
    def place(self) -> str:
        """The axis by name, as a report says it."""
        return f"{self.robot.name} {self.axis}"

    @property
    def own(self) -> Axis:
        """The axis."""
        return self.robot.axes[self.axis]

    @property
    def facts(self) -> Facts:
        """The figures of the axis."""
        return Facts.of(self.own)

    @property
    def presets(self) -> dict[str, float]:
        """All parameters at their presets."""
        return {p.name: p.preset(self.facts) for p in self.formulation.parameters}

    @property
    def held(self) -> bool:
        """Whether a constant command has the axis rest at one position."""
        return not isinstance(self.own, ForceAxis)

    @property
    def rate_hz(self) -> float:
        """Samples a second."""
        return float(np.clip(_ROWS_PER_PERIOD * self.facts.pace_hz, *_RATES_HZ))

    @property
    def rest_rows(self) -> int:
        """Rows in which the axis comes to rest."""
        decay = 2.0 * pi * self.facts.frequency_hz * self.facts.damping_ratio
        if decay <= 0.0:
            return 200
        return int(min(_SETTLED / decay * self.rate_hz + 200.0, _LONGEST_REST))

    def asked(self, values: Values | None = None) -> AxisEffect:
        """Return the effect with these values, or its presets."""
        return AxisEffect(
            axis=self.axis,
            id=self.effect.id,
            formulation=self.formulation.name,
            parameters=dict(values or {}),
            from_axis=self.from_axis,
        )

    def attach(self, values: Values | None = None) -> Attached:
        """Attach it; EffectError if it is refused."""
        return Attached.of(self.robot, self.asked(values))

    def as_static(self) -> Self | None:
        """Return the bench with an axis that follows at once; None if the effect needs more."""
        if not self.held or isinstance(self.formulation.acts, Force | Change):
            return None
        followed = {self.axis, self.from_axis}
        axes = {
            name: replace(axis, static=True, **_UNTOLD)  # type: ignore[arg-type]
            if name in followed and not isinstance(axis, ForceAxis)
            else axis
            for name, axis in self.robot.axes.items()
        }
        return replace(self, robot=replace(self.robot, axes=axes, couplings=()))

    def record(self, shape: FloatArray, *, slower: float = 1.0) -> Record:
        """Return commands that follow ``shape`` (n,), −1 … 1 about mid-range.

        Every axis that the effect needs moves alike. A force axis gets a voltage about the one
        that keeps it at rest.
        """
        time_s = np.arange(len(shape), dtype=np.float64) * (slower / self.rate_hz)
        names = [self.axis] if self.from_axis is None else [self.axis, self.from_axis]
        signals: dict[tuple[str, Tap], FloatArray] = {}
        for name in names:
            axis = self.robot.axes[name]
            if isinstance(axis, ForceAxis):
                facts = Facts.of(axis)
                balance = axis.force_offset / axis.gain
                signals[name, Tap.CMD] = np.full(len(shape), _middle(axis))
                signals[name, Tap.U] = balance + 0.05 * facts.input_span * shape
            else:
                signals[name, Tap.CMD] = _middle(axis) + travel_of(axis) * shape
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
        """Return what is recorded with the effect, or with ``effects`` instead."""
        own = [self.asked(values)] if effects is None else effects
        rng = np.random.default_rng(seed) if seed is not None else None
        return simulate(self.robot, own, commands, rng)

    def added(
        self, commands: Record, values: Values | None = None, *, seed: int | None = None
    ) -> FloatArray:
        """Return what the effect adds to reference and reading, (n, 2), m or rad."""
        return self.seen(self.run(commands, values, seed=seed)) - self.seen(
            self.run(commands, seed=seed, effects=())
        )

    def seen(self, record: Record) -> FloatArray:
        """Return reference and reading of the axis, (n, 2)."""
        return np.stack([record.signal(self.axis, tap) for tap in (Tap.REF, Tap.MEAS)], axis=1)

    def nothing(self) -> dict[str, float] | None:
        """Return 0 wherever it is allowed, which may be no effect; None if nowhere."""
        zero = {p.name: 0.0 for p in self.formulation.parameters if p.low <= 0.0 <= p.high}
        return zero or None

    def corners(self) -> Iterable[dict[str, float]]:
        """Return values at the bounds: all low, all high, and each alone."""
        ends = {p.name: self._ends(p) for p in self.formulation.parameters}
        for side in (0, 1):
            yield {name: pair[side] for name, pair in ends.items()}
        for name, pair in ends.items():
            for end in pair:
                yield {name: end}

    def _ends(self, parameter: Parameter) -> tuple[float, float]:
        low, high = parameter.bounds(self.facts)
        far = _FAR * abs(parameter.preset(self.facts)) or 1.0
        return (low if isfinite(low) else -far), (high if isfinite(high) else far)


def travel_of(axis: Axis) -> float:
    """Return how far an axis moves to each side, m or rad."""
    travel = _TRAVEL * axis.span
    if isinstance(axis, StepperAxis):
        travel = min(travel, _PITCHES * Facts.of(axis).pitch)
    return travel


def benches_of(effect: Effect, robots: Sequence[Robot]) -> list[Bench]:
    """Return a bench for every formulation on one axis of every kind, moving and static."""
    benches: list[Bench] = []
    for formulation in effect.formulations:
        taken: set[tuple[str, bool]] = set()
        for robot in map(_silent, robots):
            for name, axis in robot.axes.items():
                dynamics = isinstance(formulation.acts, Force | Change)
                others = [other for other in robot.axes if other != name]
                refused = axis.kind not in effect.kinds or (axis.static and dynamics)
                if refused or (axis.kind, axis.static) in taken or (effect.coupled and not others):
                    continue
                taken.add((axis.kind, axis.static))
                source = others[0] if effect.coupled else None
                benches.append(Bench(robot, name, source, effect, formulation))
    return benches


def _silent(robot: Robot) -> Robot:
    """Return the robot without effects and declared noise or rounding: sums stay sums."""
    axes: Mapping[str, Axis] = {
        name: replace(axis, sensor=None) for name, axis in robot.axes.items()
    }
    return replace(robot, axes=axes, effects=())


def _middle(axis: Axis) -> float:
    return 0.5 * (axis.range[0] + axis.range[1])


@lru_cache
def waves(rows: int) -> FloatArray:
    """Return a motion that begins softly: three sines that share no period."""
    phase = np.linspace(0.0, 2.0 * pi, rows)
    wave = 0.5 * np.sin(3.0 * phase) + 0.3 * np.sin(7.3 * phase) - 0.2 * np.sin(1.6 * phase)
    return np.asarray(wave * np.minimum(phase, 1.0))


@lru_cache
def moves(rows: int) -> FloatArray:
    """Return steps up and down with rests in between."""
    levels = np.array([0.0, 0.6, 0.1, -0.8, -0.3, 0.9])
    return np.repeat(levels, -(-rows // len(levels)))[:rows]


def visit(places: Sequence[float], rise_rows: int, rest_rows: int) -> FloatArray:
    """Return a smooth way through places, −1 … 1, that rests at the last."""
    ease = 0.5 - 0.5 * np.cos(np.linspace(0.0, pi, rise_rows))
    parts = [begin + (end - begin) * ease for begin, end in pairwise(places)]
    return np.concatenate([*parts, np.full(rest_rows, places[-1])])
