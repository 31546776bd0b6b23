"""The perturbation Q of Eq. (1): how the base of the machine is shaken."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.messages import message
from rotemina.sim.plant.coupled_groups import Group
from rotemina.sim.plant.errors import PlantError


@dataclass(frozen=True, slots=True, eq=False)
class Perturbation:
    """``A Q̇ + B Q`` of Eq. (1), on all axes of a plant in its order.

    Q is held from one sample to the next as a command is, so ``A Q̇`` is an impulse at each sample
    at which Q changes: it changes the speeds by ``M⁻¹ A ΔQ`` at once. Before a run Q is zero. The
    paper prints Q̈ beside A and calls it the first derivative; the words are taken.

    Attributes
    ----------
    acceleration : (n, axes)
        Q, m/s² or rad/s², one row for each sample.
    a, b : (axes, axes)
        A, kg s (or kg m² s), and B, kg (or kg m²). Rows are the axes that are pushed.

    Raises
    ------
    PlantError
        If shapes disagree or a number is not finite.
    """

    acceleration: FloatArray
    a: FloatArray
    b: FloatArray

    def __post_init__(self) -> None:
        shape = np.shape(self.acceleration)
        if len(shape) != 2:
            raise PlantError(
                message(
                    "engine",
                    "perturbation: acceleration has shape {shape}; give it a row for each sample "
                    "and a column for each axis",
                ).fill(shape=str(shape))
            )
        for name in ("a", "b"):
            if np.shape(getattr(self, name)) != (shape[1], shape[1]):
                raise PlantError(
                    message(
                        "engine",
                        "perturbation: {name} has shape {shape}; acceleration has {axes} axes, "
                        "so it must be {wanted}",
                    ).fill(
                        name=name,
                        shape=np.shape(getattr(self, name)),
                        axes=shape[1],
                        wanted=str((shape[1], shape[1])),
                    )
                )
        for name in ("acceleration", "a", "b"):
            array = np.array(getattr(self, name), dtype=np.float64)
            if not np.isfinite(array).all():
                place = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
                raise PlantError(
                    message("engine", "perturbation: {name}{place} is not finite").fill(
                        name=name, place=str(list(place))
                    )
                )
            object.__setattr__(self, name, read_only(array))

    def check(self, rows: int, axes: Sequence[str]) -> None:
        """Raise :class:`PlantError` unless there is a row for each sample, a column for each axis.

        ``axes`` are those of the plant.
        """
        if self.acceleration.shape[1] != len(axes):
            raise PlantError(
                message(
                    "engine", "perturbation: it has {shape} axes; the plant has {count}: {names}"
                ).fill(shape=self.acceleration.shape[1], count=len(axes), names=" ".join(axes))
            )
        if len(self.acceleration) != rows:
            raise PlantError(
                message(
                    "engine", "perturbation: it has {count} rows; the commands have {rows}"
                ).fill(count=len(self.acceleration), rows=rows)
            )

    def part(self, rows: slice) -> Self:
        """Return some of the rows."""
        return replace(self, acceleration=self.acceleration[rows])

    def forces(self, before: FloatArray) -> FloatArray:
        """Return ``B Q`` (n + 1, axes), N or N m, that of the row ``before`` (axes,) first."""
        return np.asarray(np.vstack([before, self.acceleration]) @ self.b.T)

    def kicks(self, before: FloatArray, axes: Sequence[str], groups: Sequence[Group]) -> FloatArray:
        """Return the jumps (n, states) of the states of all groups."""
        impulse = np.diff(np.vstack([before, self.acceleration]), axis=0) @ self.a.T
        parts = []
        for group in groups:
            m, n = group.size, group.states
            jump = np.zeros((len(impulse), n))
            if not group.static:
                per_force = group.generator[m : 2 * m, n + m + 1 :]
                own = [axes.index(name) for name in group.axes]
                jump[:, m : 2 * m] = impulse[:, own] @ per_force.T
            parts.append(jump)
        return np.concatenate(parts, axis=1)
