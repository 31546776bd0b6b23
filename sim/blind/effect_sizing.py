"""Trial runs of a machine, which measure and set the sizes of its effects."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.machine import BlindMachine, SampledCommands
from rotemina.sim.blind.part import BlindAxis, EffectPart

# An effect must add at least this rms to the gap, in noise floors.
MIN_FLOORS = 1.5
# An effect must be at least this large if another one, however large, acts on the same axis.
MIN_FLOORS_IF_SEVERAL = 5.0
# Minimum ratio of the rms of an effect to that of the remainder.
MIN_EFFECT_TO_REMAINDER_RATIO = 2.0
MAX_FLOORS = 300.0
# A fit of simple shapes must leave at least this fraction of the power of an effect outside the
# catalogue unexplained.
_MIN_UNEXPLAINED_SHARE = 0.4
_GAIN_EFFECTS = ("gain_error", "sensor_gain")


class PresentEffect(NamedTuple):
    """An effect that is present, and its share in the gap of its axis.

    Attributes
    ----------
    part : EffectPart
    floors : float
        Rms that it adds to the gap, in noise floors.
    share : float
        Share of the power of the gap.
    gap : float
        Rms of the whole gap of the axis, in noise floors.
    """

    part: EffectPart
    floors: float
    share: float
    gap: float = 0.0


@dataclass(frozen=True, slots=True)
class SizingTrial:
    """Trial runs of a machine over its training records, which measure the gap of its effects."""

    machine: BlindMachine
    training: tuple[SampledCommands, ...]
    seed: int
    _cache: dict[tuple[EffectPart, ...], list[FloatArray]] = field(default_factory=dict)

    def simulate_readings(self, parts: Sequence[EffectPart]) -> list[FloatArray]:
        """Return the noise-free readings (n, m) of each training record."""
        key = tuple(parts)
        if key not in self._cache:
            machine = self.machine.with_parts(parts)
            self._cache[key] = [
                machine.respond(c, make_record_seed(self.seed, k)).reading
                for k, c in enumerate(self.training)
            ]
        return self._cache[key]

    def find_size(
        self,
        part: EffectPart,
        floors: float,
        min_gap_floors: float = MIN_FLOORS,
        *,
        allow_tiny_size: bool = False,
    ) -> EffectPart | None:
        """Return the effect, with the size at which it alone makes a gap of about ``floors``.

        Returns
        -------
        EffectPart or None
            None if the gap stays below ``min_gap_floors``, or far too large, within the bounds of
            the size. If ``allow_tiny_size``, the size may be almost zero.
        """
        baseline = self.simulate_readings([])
        if allow_tiny_size:
            part = replace(part, sizes=(1e-9, part.sizes[1]))
        part = part.with_size(np.sqrt(part.sizes[0] * part.sizes[1]))
        for _ in range(4):
            reached_floors = compute_rms_difference(
                self.simulate_readings([part]), baseline, part.axis
            )
            if 0.7 < reached_floors / floors < 1.4:
                break
            part = part.with_size(
                part.size * float(np.clip(floors / max(reached_floors, 1e-9), 0.02, 50.0))
            )
        reached_floors = compute_rms_difference(self.simulate_readings([part]), baseline, part.axis)
        return (
            part if reached_floors >= min_gap_floors and reached_floors < 4.0 * MAX_FLOORS else None
        )

    def scale_remainder(
        self, remainder: EffectPart, parts: Sequence[EffectPart], share: float
    ) -> EffectPart:
        """Return a remainder whose rms is ``share`` times that of the gap on its axis.

        The gap is that of a machine with ``parts``.
        """
        baseline = self.simulate_readings([])
        gap = compute_rms_difference(self.simulate_readings(parts), baseline, remainder.axis)
        alone = compute_rms_difference(
            self.simulate_readings([remainder.with_size(remainder.axis.floor)]),
            baseline,
            remainder.axis,
        )
        return remainder.with_size(remainder.axis.floor * share * gap / alone)

    def compute_floors(self, part: EffectPart) -> float:
        """Return the rms of the gap that the effect alone makes, in noise floors."""
        return compute_rms_difference(
            self.simulate_readings([part]), self.simulate_readings([]), part.axis
        )

    def measure_effects(self, parts: list[EffectPart]) -> list[PresentEffect] | None:
        """Measure what each effect adds to the gap when all others are present.

        Return None if one of them adds too little.
        """
        complete, baseline = self.simulate_readings(parts), self.simulate_readings([])
        effects = []
        for part in parts:
            without_part = self.simulate_readings([other for other in parts if other is not part])
            floors = compute_rms_difference(complete, without_part, part.axis)
            gap = compute_rms_difference(complete, baseline, part.axis)
            share = (floors / gap) ** 2
            shares_axis = sum(other.axis is part.axis for other in parts) > 1
            if floors < (MIN_FLOORS_IF_SEVERAL if shares_axis else MIN_FLOORS):
                return None
            effects.append(PresentEffect(part, floors, share, gap))
        return effects

    def are_distinct(self, parts: list[EffectPart]) -> bool:
        """Return whether no gain error and no other effect on the axis can imitate any effect.

        If an effect is outside the catalogue, simple shapes must also fail to explain it.
        """
        complete = self.simulate_readings(parts)
        added_gaps = []
        for part in parts:
            without_part = self.simulate_readings([other for other in parts if other is not part])
            added_gaps.append(subtract_readings(complete, without_part, part.axis))
        for k, part in enumerate(parts):
            gaps_on_axis = [
                a for a, p in zip(added_gaps, parts, strict=True) if p.axis is part.axis
            ]
            # A wrong gain or another effect with a wrong size could also explain the motion.
            shapes = [shape for shape in gaps_on_axis if shape is not added_gaps[k]]
            if part.effect not in _GAIN_EFFECTS:
                shapes += self._make_shapes(part.axis, include_derived=part.effect == "unknown")
            unexplained = remove_shapes(added_gaps[k], shapes)
            floors = float(np.sqrt(np.mean(unexplained**2)) / part.axis.floor)
            share = float(np.sum(unexplained**2) / np.sum(added_gaps[k] ** 2))
            if floors < MIN_FLOORS or (part.effect == "unknown" and share < _MIN_UNEXPLAINED_SHARE):
                return False
        return True

    def _make_shapes(self, axis: BlindAxis, *, include_derived: bool) -> list[FloatArray]:
        """Return the command of an axis over all records as one shape (rows,).

        With ``include_derived``, the list also has powers and derivatives of the command, the time,
        and the commands of the other axes.
        """
        records = []
        for commands in self.training:
            command = (commands.values[:, axis.index] - axis.start) / axis.travel - 0.5
            shapes = [command]
            if include_derived:
                speed = np.gradient(command)
                time_s = np.linspace(0.0, 1.0, len(command)) * len(command) * commands.step_s
                shapes += [command**2, command**3, speed, np.gradient(speed), time_s]
                shapes += [*np.delete(commands.values, axis.index, axis=1).T]
            records.append(np.array([shape - shape.mean() for shape in shapes]))
        return list(np.concatenate(records, axis=1))


def subtract_readings(
    first: list[FloatArray], second: list[FloatArray], axis: BlindAxis
) -> FloatArray:
    """Return the difference (rows,) of two sets of readings of an axis, all records joined.

    The mean of each record is removed.
    """
    gaps = [a[:, axis.index] - b[:, axis.index] for a, b in zip(first, second, strict=True)]
    return np.concatenate([gap - gap.mean() for gap in gaps])


def remove_shapes(values: FloatArray, shapes: Sequence[FloatArray]) -> FloatArray:
    """Return the residual (rows,) of ``values`` after a least-squares fit of ``shapes``."""
    if not shapes:
        return values
    matrix = np.column_stack(shapes)
    matrix = matrix / (np.linalg.norm(matrix, axis=0) + 1e-300)
    return np.asarray(values - matrix @ np.linalg.lstsq(matrix, values, rcond=1e-9)[0])


def make_record_seed(seed: int, number: int) -> int:
    """Return the seed of the random effects in one record."""
    return seed * 16 + number


def compute_rms_difference(
    first: list[FloatArray], second: list[FloatArray], axis: BlindAxis
) -> float:
    """Return the rms difference of two sets of readings, in noise floors.

    The mean of each record is removed.
    """
    return float(np.sqrt(np.mean(subtract_readings(first, second, axis) ** 2)) / axis.floor)
