"""The perturbation Q of Eq. (1): acceleration of the base of the machine."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.errors import PlantError
from rotemina.sim.plant.coupled_groups import AxisGroup


@dataclass(frozen=True, slots=True, eq=False)
class Perturbation:
    """Perturbation ``A Q̇ + B Q`` of Eq. (1), on all axes of a plant in its order.

    Q is held from one sample to the next, as a command is. ``A Q̇`` is therefore an impulse at each
    sample at which Q changes: it changes the speeds instantly by ``M⁻¹ A ΔQ``. Before a run Q is
    zero. The paper prints Q̈ next to A but calls it the first derivative; here it is the first
    derivative.

    Attributes
    ----------
    acceleration : (n, axes)
        Q, m/s² or rad/s², one row for each sample.
    a, b : (axes, axes)
        A, kg s (or kg m² s), and B, kg (or kg m²). The rows are the axes that are perturbed.

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
                "perturbation: acceleration has shape {shape}; give it a row for each sample "
                "and a column for each axis",
                shape=str(shape),
            )
        for name in ("a", "b"):
            if np.shape(getattr(self, name)) != (shape[1], shape[1]):
                raise PlantError(
                    "perturbation: {name} has shape {shape}; acceleration has {axes} axes, "
                    "so it must be {wanted}",
                    name=name,
                    shape=np.shape(getattr(self, name)),
                    axes=shape[1],
                    wanted=str((shape[1], shape[1])),
                )
        for name in ("acceleration", "a", "b"):
            array = np.array(getattr(self, name), dtype=np.float64)
            if not np.isfinite(array).all():
                place = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
                raise PlantError(
                    "perturbation: {name}{place} is not finite", name=name, place=str(list(place))
                )
            object.__setattr__(self, name, make_read_only(array))

    def check(self, rows: int, axes: Sequence[str]) -> None:
        """Check that there is a row for each sample and a column for each axis of the plant.

        Raises
        ------
        PlantError
            If the number of axes or rows differs from that of the plant or the samples.
        """
        if self.acceleration.shape[1] != len(axes):
            raise PlantError(
                "perturbation: it has {shape} axes; the plant has {count}: {names}",
                shape=self.acceleration.shape[1],
                count=len(axes),
                names=" ".join(axes),
            )
        if len(self.acceleration) != rows:
            raise PlantError(
                "perturbation: it has {count} rows; the commands have {rows}",
                count=len(self.acceleration),
                rows=rows,
            )

    def part(self, rows: slice) -> Self:
        """Return some of the rows."""
        return replace(self, acceleration=self.acceleration[rows])

    def compute_forces(self, before: FloatArray) -> FloatArray:
        """Return ``B Q`` (n + 1, axes), N or N m; the first row is for Q ``before`` (axes,)."""
        return np.asarray(np.vstack([before, self.acceleration]) @ self.b.T)

    def compute_state_jumps(
        self, before: FloatArray, axes: Sequence[str], groups: Sequence[AxisGroup]
    ) -> FloatArray:
        """Return the jumps (n, states) of the states of all groups."""
        impulse = np.diff(np.vstack([before, self.acceleration]), axis=0) @ self.a.T
        jumps = []
        for group in groups:
            m, n = group.size, group.states
            jump = np.zeros((len(impulse), n))
            if not group.static:
                per_force = group.generator[m : 2 * m, n + m + 1 :]
                columns = [axes.index(name) for name in group.axes]
                jump[:, m : 2 * m] = impulse[:, columns] @ per_force.T
            jumps.append(jump)
        return np.concatenate(jumps, axis=1)
