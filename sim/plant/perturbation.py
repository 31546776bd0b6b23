"""The perturbation Q of Eq. (1): how the base of the machine is shaken."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.group import Group


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
    """

    acceleration: FloatArray
    a: FloatArray
    b: FloatArray

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
