"""Cases of the second generator: drawn, labelled, and written as record files."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second.effects import MAKERS, PIEZO_ALONE, STEPPER_ALONE, Added, draw
from rotemina.sim.blind_second.machine import Machine, Motion
from rotemina.sim.blind_second.machine_axis import AxisFacts, facts_of
from rotemina.sim.blind_second.motions import motions
from rotemina.sim.blind_second.remainder import draw_remainder
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.matrices import inertia_matrices
from rotemina.sim.robot.model import Robot

KINDS = ("single", "double", "healthy")
_SHARES = (0.6, 0.28, 0.12)
_LEAST, _MOST = 1.6, 300.0  # floors, of the first effect
_LEAST_SECOND = 5.0  # floors, however large the first is
_OVER_REMAINDER = 2.0
_REMAINDER = (0.05, 0.3)  # of the gap's rms
_VOLTAGE_NOISE = 0.003
# On one axis, one of these is another with another size, or hides it.
_ALIKE = (
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
    """A machine, its motions (the last is held back), and what is added to it, in floors."""

    kind: str
    machine: Machine
    motions: tuple[Motion, ...]
    seed: int
    floors: tuple[float, ...]
    gap: float
    remainder: float | None

    def label(self) -> dict[str, Any]:
        """Return the answer that is right, as JSON."""
        added = self.machine.added[: len(self.floors)]
        own = [
            {
                "axis": one.axis.name,
                "effect": one.effect,
                "from_axis": one.from_axis,
                "floors": round(floors, 3),
            }
            for one, floors in zip(added, self.floors, strict=True)
        ]
        return {
            "verdict": "explained" if own else "none",
            "effects": own,
            "hidden": [],
            "kind": self.kind,
            "floors": round(self.gap, 3),
            "remainder": None if self.remainder is None else {"floors": round(self.remainder, 3)},
        }

    def write(self, folder: Path, robot: Robot) -> None:
        """Write the training records, and the commands and readings that are held back."""
        folder.mkdir(parents=True, exist_ok=True)
        for number, asked in enumerate(self.motions[:-1]):
            record = self._record(robot, asked, number, (Tap.CMD, Tap.U, Tap.REF, Tap.MEAS))
            write_record(record, folder / f"train_{number + 1}.csv.gz")
        for name, taps in (("commands", (Tap.CMD,)), ("measured", (Tap.CMD, Tap.MEAS))):
            record = self._record(robot, self.motions[-1], len(self.motions), taps)
            write_record(record, folder / f"test_{name}.csv.gz")

    def _record(self, robot: Robot, asked: Motion, number: int, shown: Sequence[Tap]) -> Record:
        taps = self.machine.run(asked, self.seed * 16 + number)
        rng = np.random.default_rng((self.seed, number))
        signals: dict[tuple[str, Tap], FloatArray] = {}
        for axis in self.machine.axes:
            i, noise = axis.index, rng.normal(size=(3, len(asked.values)))
            read = (taps.reading[:, i] + axis.noise * noise[2]) / axis.resolution
            own = {
                Tap.CMD: asked.values[:, i],
                Tap.U: taps.drive[:, i] / axis.volt + _VOLTAGE_NOISE * noise[0],
                Tap.REF: taps.motion[:, i]
                + (robot.reference.noise_rms.of(robot.unit(axis.name)) or 0.0) * noise[1],
                Tap.MEAS: np.round(read) * axis.resolution,
            }
            if axis.kind == "stepper":
                del own[Tap.U]
            signals |= {(axis.name, tap): own[tap] for tap in shown if tap in own}
        time_s = np.asarray(np.arange(len(asked.values)) * asked.step_s, dtype=np.float64)
        units = {axis.name: robot.unit(axis.name) or "m" for axis in self.machine.axes}
        return Record.from_signals(time_s, signals, units, {"mode": "open_loop"})


def draw_second(robot: Robot, seed: int) -> SecondCase:
    """Draw a case from a seed, odd ones of faulty machines with a remainder.

    Raises
    ------
    RuntimeError
        If none comes about in many attempts.
    """
    for attempt in range(200):
        rng = np.random.default_rng((seed, attempt, 2))
        case = _attempt(robot, seed, str(rng.choice(KINDS, p=_SHARES)), rng)
        if case is not None:
            return case
    raise RuntimeError(f"no case came about; seed {seed}")


def _attempt(robot: Robot, seed: int, kind: str, rng: np.random.Generator) -> SecondCase | None:
    stages = list(robot.stages.values())
    names = tuple(stages[rng.integers(len(stages))])
    asked = motions(robot, names, rng)
    machine = _machine(robot, names, asked)
    if kind == "healthy":
        return SecondCase(kind, machine, tuple(asked), seed, (), 0.0, None)
    trial = _Trial(machine, asked[:-1])
    axis = machine.axes[rng.integers(len(names))]
    added: list[Added] = []
    target = float(np.exp(rng.uniform(np.log(_LEAST), np.log(_MOST))))
    for effect in _chosen(axis, 2 if kind == "double" else 1, rng):
        others = [one for one in machine.axes if one is not axis]
        if effect == "cross_coupling" and not others:
            return None
        size = target
        if added:
            low = min(1.2 * _LEAST_SECOND, target)
            size = float(np.exp(rng.uniform(np.log(low), np.log(2.0 * target))))
        one = trial.sized(draw(effect, axis, others, rng), size)
        if one is None:
            return None
        added.append(one)
    gap = trial.floors(added, [])
    floors = tuple(trial.floors(added, [o for o in added if o is not one]) for one in added)
    if min(floors) < (_LEAST_SECOND if len(added) > 1 else _LEAST):
        return None
    rest = None
    if seed % 2:
        drawn = draw_remainder(axis, rng).sized(axis.floor)
        share = rng.uniform(*_REMAINDER) * gap / max(trial.floors([drawn], []), 1e-12)
        rest = trial.floors([drawn.sized(drawn.size * share)], [])
        if min(floors) < _OVER_REMAINDER * rest:
            return None
        added.append(drawn.sized(drawn.size * share))
    return SecondCase(kind, machine.having(added), tuple(asked), seed, floors, gap, rest)


def _machine(robot: Robot, names: tuple[str, ...], asked: Sequence[Motion]) -> Machine:
    whole = inertia_matrices(robot)
    joined = [set(one.axes) for one in robot.couplings if set(one.axes) & set(names)]
    riding = [n for n in whole.axes if n not in names and any(n in each for each in joined)]
    rows = [whole.axes.index(name) for name in (*names, *riding)]
    values = np.concatenate([one.values for one in asked])
    axes = tuple(facts_of(robot, name, i, values[:, i]) for i, name in enumerate(names))
    mass, damping, stiffness = (matrix[np.ix_(rows, rows)] for matrix in whole[1:])
    return Machine(axes, mass, damping, stiffness)


def _chosen(axis: AxisFacts, number: int, rng: np.random.Generator) -> list[str]:
    """Choose effects that the axis can have and that are not alike."""
    never = STEPPER_ALONE if axis.kind == "piezo" else PIEZO_ALONE
    names = [name for name in (*MAKERS, "cross_coupling") if name not in never]
    while True:
        chosen = [str(name) for name in rng.choice(names, number, replace=False)]
        if not any(len(one & set(chosen)) > 1 for one in _ALIKE):
            return chosen


class _Trial:
    """Runs of a machine over its training motions, to see what something added does."""

    def __init__(self, machine: Machine, asked: Sequence[Motion]) -> None:
        self._machine, self._asked = machine, asked
        self._known: dict[tuple[int, tuple[Added, ...]], FloatArray] = {}

    def floors(self, added: Sequence[Added], without: Sequence[Added]) -> float:
        """Return the rms of the difference that some make, each record's mean off, in floors."""
        axis = added[0].axis
        apart = []
        for number, asked in enumerate(self._asked):
            gap = self._reading(added, number, asked) - self._reading(without, number, asked)
            apart.append((gap - gap.mean(axis=0))[:, axis.index])
        return float(np.sqrt(np.mean(np.concatenate(apart) ** 2))) / axis.floor

    def _reading(self, added: Sequence[Added], number: int, asked: Motion) -> FloatArray:
        key = number, tuple(added)
        if key not in self._known:
            self._known[key] = self._machine.having(added).run(asked, number).reading
        return self._known[key]

    def sized(self, one: Added, floors: float) -> Added | None:
        """Return something that by itself makes about so many floors, or None."""
        one = one.sized(one.usual)
        for _ in range(5):
            got = self.floors([one], [])
            if 0.7 < got / floors < 1.4:
                return one
            factor = float(np.clip(floors / max(got, 1e-9), 0.05, 20.0))
            one = one.sized(min(one.size * factor, 30.0 * one.usual))
        return None
