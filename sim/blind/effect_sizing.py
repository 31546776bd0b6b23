"""Trial runs of a machine that show and size the effects of its parts."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.machine import Commands, Machine
from rotemina.sim.blind.part import Axis, Part

LEAST_FLOORS = 1.5
LEAST_BESIDE = 5.0  # floors of an effect beside a larger one, however large that is
OVER_REMAINDER = 2.0  # rms of an effect over that of a remainder, at least
MOST_FLOORS = 300.0
_LEAST_STRANGE = 0.4  # of an effect in no catalogue, that simple shapes do not explain
_GAINS = ("gain_error", "sensor_gain")


class Present(NamedTuple):
    """A part and what it adds to its axis' gap: in noise floors, and as a share of the power.

    ``gap`` is the whole gap of that axis in noise floors.
    """

    part: Part
    floors: float
    share: float
    gap: float = 0.0


@dataclass(frozen=True, slots=True)
class Trial:
    """Runs of a machine over the training records, to see what a part does."""

    machine: Machine
    training: tuple[Commands, ...]
    seed: int
    _known: dict[tuple[Part, ...], list[FloatArray]] = field(default_factory=dict)

    def readings(self, parts: Sequence[Part]) -> list[FloatArray]:
        """Return the noise-free readings (n, m) of each record."""
        key = tuple(parts)
        if key not in self._known:
            machine = self.machine.having(parts)
            self._known[key] = [
                machine.respond(c, record_seed(self.seed, k)).reading
                for k, c in enumerate(self.training)
            ]
        return self._known[key]

    def sized(
        self, part: Part, floors: float, low: float = LEAST_FLOORS, *, free: bool = False
    ) -> Part | None:
        """Return the part, sized so that alone it makes about so many floors; None if it cannot."""
        plain = self.readings([])
        if free:
            part = replace(part, sizes=(1e-9, part.sizes[1]))
        part = part.sized(np.sqrt(part.sizes[0] * part.sizes[1]))
        for _ in range(4):
            got = difference(self.readings([part]), plain, part.axis)
            if 0.7 < got / floors < 1.4:
                break
            part = part.sized(part.size * float(np.clip(floors / max(got, 1e-9), 0.02, 50.0)))
        got = difference(self.readings([part]), plain, part.axis)
        return part if got >= low and got < 4.0 * MOST_FLOORS else None

    def with_share(self, remainder: Part, parts: Sequence[Part], share: float) -> Part:
        """Return a remainder, sized to a share of the gap's rms that parts make on its axis."""
        plain = self.readings([])
        gap = difference(self.readings(parts), plain, remainder.axis)
        alone = difference(
            self.readings([remainder.sized(remainder.axis.floor)]), plain, remainder.axis
        )
        return remainder.sized(remainder.axis.floor * share * gap / alone)

    def rms(self, part: Part) -> float:
        """Return what a part does by itself, in floors."""
        return difference(self.readings([part]), self.readings([]), part.axis)

    def present(self, parts: list[Part]) -> list[Present] | None:
        """Return what each part adds when all others are in; None if one does too little."""
        whole, plain = self.readings(parts), self.readings([])
        out = []
        for part in parts:
            rest = self.readings([other for other in parts if other is not part])
            floors = difference(whole, rest, part.axis)
            gap = difference(whole, plain, part.axis)
            share = (floors / gap) ** 2
            together = sum(other.axis is part.axis for other in parts) > 1
            if floors < (LEAST_BESIDE if together else LEAST_FLOORS):
                return None
            out.append(Present(part, floors, share, gap))
        return out

    def distinct(self, parts: list[Part]) -> bool:
        """Whether each part does something that no other gain and no other part's size would do.

        Of an effect in no catalogue: that no simple shape would do, for a good share of it.
        """
        whole = self.readings(parts)
        added = []
        for part in parts:
            rest = self.readings([other for other in parts if other is not part])
            added.append(residual_difference(whole, rest, part.axis))
        for number, part in enumerate(parts):
            others = [a for a, p in zip(added, parts, strict=True) if p.axis is part.axis]
            shapes = [one for one in others if one is not added[number]]
            if part.effect not in _GAINS:
                shapes += self._shapes(part.axis, simple=part.effect == "unknown")
            left = beyond(added[number], shapes)
            floors = float(np.sqrt(np.mean(left**2)) / part.axis.floor)
            share = float(np.sum(left**2) / np.sum(added[number] ** 2))
            if floors < LEAST_FLOORS or (part.effect == "unknown" and share < _LEAST_STRANGE):
                return False
        return True

    def _shapes(self, axis: Axis, *, simple: bool) -> list[FloatArray]:
        """Return the command (rows,), and with ``simple`` what a plain model makes of it."""
        records = []
        for commands in self.training:
            own = (commands.values[:, axis.index] - axis.start) / axis.travel - 0.5
            shapes = [own]
            if simple:
                speed = np.gradient(own)
                time_s = np.linspace(0.0, 1.0, len(own)) * len(own) * commands.step_s
                shapes += [own**2, own**3, speed, np.gradient(speed), time_s]
                shapes += [*np.delete(commands.values, axis.index, axis=1).T]
            records.append(np.array([shape - shape.mean() for shape in shapes]))
        return list(np.concatenate(records, axis=1))


def residual_difference(
    first: list[FloatArray], second: list[FloatArray], axis: Axis
) -> FloatArray:
    """Return the difference of two sets of readings (rows,), the mean of each record removed."""
    gaps = [a[:, axis.index] - b[:, axis.index] for a, b in zip(first, second, strict=True)]
    return np.concatenate([gap - gap.mean() for gap in gaps])


def beyond(values: FloatArray, shapes: Sequence[FloatArray]) -> FloatArray:
    """Return the residual of ``values`` (rows,) after the best sum of ``shapes``."""
    if not shapes:
        return values
    matrix = np.column_stack(shapes)
    matrix = matrix / (np.linalg.norm(matrix, axis=0) + 1e-300)
    return np.asarray(values - matrix @ np.linalg.lstsq(matrix, values, rcond=1e-9)[0])


def record_seed(seed: int, number: int) -> int:
    """Return the seed of one record's chance."""
    return seed * 16 + number


def difference(first: list[FloatArray], second: list[FloatArray], axis: Axis) -> float:
    """Return the rms of the difference of two sets of readings, means removed, in floors."""
    return float(np.sqrt(np.mean(residual_difference(first, second, axis) ** 2)) / axis.floor)
