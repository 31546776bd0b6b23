"""Feed-forward: the output for a reference, before any feedback.

The reference is sent through an inverse of the actuator. The lag of the axis and of the held
command (:mod:`rotemina.sim.feedback.reference_lead`) is compensated by a lead that is added::

    w = inverse(r) + lead(r) − r

The lead alternates from sample to sample where the path turns. If it were sent through the inverse,
the hysteresis state of the inverse would reverse as well. On an actuator whose small loops differ
slightly from those of the inverse, that costs more accuracy than it gains.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from rotemina.sim.arrays import FloatArray


class SampledInverse(Protocol):
    """An inverse model, which returns the command for a desired position, sample by sample.

    :class:`rotemina.sim.compensate.Inverse` is one.
    """

    def reset(self) -> object:
        """Erase the state: the next sample begins at rest, after a rise from the low end."""

    def step(self, desired: float, /) -> float:
        """Return the command of the next sample."""

    def run(self, desired: FloatArray, /) -> FloatArray:
        """Return the commands of the next n samples, identical to those of :meth:`step`."""


class FeedForward:
    """Feed-forward through an inverse and a lead, sample by sample.

    Parameters
    ----------
    taps : sequence of float
        Weights of the present reference and the previous ones.
    inverse : SampledInverse, optional
        By default, the reference itself is commanded. An inverse that compensates lag must be used
        without that stage (``preview``), because the lead replaces it.
    """

    def __init__(
        self, taps: Sequence[float] | FloatArray = (1.0,), inverse: SampledInverse | None = None
    ) -> None:
        self._taps = tuple(float(tap) for tap in taps)
        self._inverse = inverse
        self._previous = [0.0] * (len(self._taps) - 1)

    def start(self, reference: float) -> float:
        """Set a state of rest at a reference, and return the output there."""
        self._previous = [reference] * (len(self._taps) - 1)
        if self._inverse is None:
            return reference
        self._inverse.reset()
        return self._inverse.step(reference)

    def step(self, reference: float) -> float:
        """Return the output of the next sample."""
        lead_output = self._taps[0] * reference
        for tap, previous in zip(self._taps[1:], self._previous, strict=True):
            lead_output += tap * previous
        self._previous = [reference, *self._previous][: len(self._previous)]
        if self._inverse is None:
            return lead_output
        return self._inverse.step(reference) + (lead_output - reference)

    def run(self, reference: FloatArray) -> FloatArray:
        """Return the outputs (n,) of all samples, starting at rest at the first reference."""
        self.start(float(reference[0]))
        return self.continue_run(reference)

    def continue_run(self, reference: FloatArray) -> FloatArray:
        """Return the outputs (n,) of the next n samples, identical to those of :meth:`step`."""
        rows, history = len(reference), len(self._previous)
        path = np.concatenate([self._previous[::-1], reference])
        lead_output = self._taps[0] * path[history:]
        for delay, tap in enumerate(self._taps[1:], start=1):
            lead_output = lead_output + tap * path[history - delay : history - delay + rows]
        self._previous = [float(path[-1 - delay]) for delay in range(history)]
        if self._inverse is None:
            return lead_output
        return self._inverse.run(reference) + (lead_output - reference)
