"""An axis as a sampled linear system, for the analysis of its loop.

Held commands and exact steps (:mod:`rotemina.sim.plant.zero_order_hold`), with the linear states
that effects bring, so that the analysis and the simulation are of the same axis::

    x_{k+1} = A x_k + b u_{k−d},   y_k = c x_k + g u_{k−d−1}

g is that of a static axis, which is read before the new command acts.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.messages import message
from rotemina.sim.plant.coupled_groups import asked_position
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.zero_order_hold import step_matrices
from rotemina.sim.quantities import rounded

_WHOLE = 1e-6  # of an interval: how near to whole ones a delay must be


@dataclass(frozen=True, slots=True, eq=False)
class SampledAxis:
    """One axis, the other inputs of its group held.

    Attributes
    ----------
    axis : str
    interval_s : float
    a : (n, n)
    b, c : (n,)
        The input is the position that is requested, m or rad (V of an axis that a force moves).
    through : float
        g.
    delay : int
        d, intervals.
    """

    axis: str
    interval_s: float
    a: FloatArray
    b: FloatArray
    c: FloatArray
    through: float
    delay: int

    @classmethod
    def of(cls, plant: Plant, axis: str, interval_s: float, *, delay: int = 0) -> Self:
        """Sample an axis of a plant; ``delay`` intervals come beside those of its effects.

        Raises
        ------
        FeedbackError
            If an effect's delay is no whole number of intervals.
        """
        group = next(one for one in plant.assembly.all_groups if axis in one.axes)
        column, asked = group.axes.index(axis), asked_position(plant.robot.axes[axis])
        states, inputs = step_matrices(group, np.array([interval_s]))
        output = group.outputs[column]
        return cls(
            axis,
            interval_s,
            states[0],
            inputs[0][:, column] / asked,
            output.weights,
            output.through / asked,
            delay + late_intervals(plant, axis, interval_s),
        )

    def scaled(self, gain: float) -> "SampledAxis":
        """Return the axis that goes ``gain`` times as far."""
        return replace(self, b=gain * self.b, through=gain * self.through)

    def response(self, z: ComplexArray) -> ComplexArray:
        """Return the frequency response (m,) at points (m,) of the unit circle."""
        states = np.zeros(len(z), dtype=np.complex128)
        if len(self.a):
            inner = z[:, None, None] * np.eye(len(self.a)) - self.a
            load = np.broadcast_to(self.b.astype(complex)[:, None], (*inner.shape[:2], 1))
            states = np.linalg.solve(inner, load)[:, :, 0] @ self.c
        return np.asarray((states + self.through / z) * z ** -float(self.delay))


def late_intervals(plant: Plant, axis: str, interval_s: float) -> int:
    """Return by how many intervals the effects of an axis delay its input.

    Raises
    ------
    FeedbackError
        If that is no whole number.
    """
    delay_s = float(plant.assembly.delays_s[plant.axes.index(axis)])
    late = round(delay_s / interval_s)
    if abs(delay_s - late * interval_s) > _WHOLE * interval_s:
        raise FeedbackError(
            message(
                "engine",
                "axis {axis}: effect delay of {delay_s} s is {intervals} intervals of a loop at "
                "{rate_hz} Hz, and must be a whole number of them; choose another rate or delay",
            ).fill(
                axis=axis,
                delay_s=delay_s,
                intervals=rounded(delay_s / interval_s, 4),
                rate_hz=1.0 / interval_s,
            )
        )
    return late
