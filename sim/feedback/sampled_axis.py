"""An axis as a sampled linear system, for the analysis of its loop.

It has held commands and exact steps (:mod:`rotemina.sim.plant.zero_order_hold`), and the linear
states of its effects. So the analysis and the simulation describe the same axis::

    x_{k+1} = A x_k + b u_{k−d},   y_k = c x_k + g u_{k−d−1}

g is nonzero only for a static axis, which is read before the new command acts.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.errors import FeedbackError
from rotemina.sim.messages import format_rounded
from rotemina.sim.plant import Plant, compute_position_gain, compute_step_matrices

# Largest deviation of a delay from a whole number of intervals, in intervals.
_WHOLE_INTERVAL_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class SampledAxis:
    """One axis as a linear system; the other inputs of its group are held.

    Attributes
    ----------
    axis : str
    interval_s : float
    a : (n, n)
    b, c : (n,)
        The input is the requested position, m or rad (V for an axis that a force moves).
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
        """Sample an axis of a plant; ``delay`` intervals are added to those of its effects.

        Raises
        ------
        FeedbackError
            If the delay of an effect is not a whole number of intervals.
        """
        group = next(candidate for candidate in plant.assembly.all_groups if axis in candidate.axes)
        column, position_per_input = (
            group.axes.index(axis),
            compute_position_gain(plant.robot.axes[axis]),
        )
        states, inputs = compute_step_matrices(group, np.array([interval_s]))
        output = group.outputs[column]
        return cls(
            axis,
            interval_s,
            states[0],
            inputs[0][:, column] / position_per_input,
            output.weights,
            output.through / position_per_input,
            delay + count_late_intervals(plant, axis, interval_s),
        )

    def with_gain(self, gain: float) -> "SampledAxis":
        """Return a copy of the axis with ``gain`` times its motion."""
        return replace(self, b=gain * self.b, through=gain * self.through)

    def compute_response(self, z: ComplexArray) -> ComplexArray:
        """Return the frequency response (m,) at points (m,) of the unit circle."""
        states = np.zeros(len(z), dtype=np.complex128)
        if len(self.a):
            system = z[:, None, None] * np.eye(len(self.a)) - self.a
            right_side = np.broadcast_to(self.b.astype(complex)[:, None], (*system.shape[:2], 1))
            states = np.linalg.solve(system, right_side)[:, :, 0] @ self.c
        return np.asarray((states + self.through / z) * z ** -float(self.delay))


def count_late_intervals(plant: Plant, axis: str, interval_s: float) -> int:
    """Return the number of intervals by which the effects of an axis delay its input.

    Raises
    ------
    FeedbackError
        If that is not a whole number.
    """
    delay_s = float(plant.assembly.delays_s[plant.axes.index(axis)])
    delay_count = round(delay_s / interval_s)
    if abs(delay_s - delay_count * interval_s) > _WHOLE_INTERVAL_TOLERANCE * interval_s:
        raise FeedbackError(
            "axis {axis}: effect delay of {delay_s} s is {intervals} intervals of a loop at "
            "{rate_hz} Hz, and must be a whole number of them; choose another rate or delay",
            axis=axis,
            delay_s=delay_s,
            intervals=format_rounded(delay_s / interval_s, 4),
            rate_hz=1.0 / interval_s,
        )
    return delay_count
