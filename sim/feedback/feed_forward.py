"""Feed-forward: the output for a reference, before any feedback.

The reference is sent through an inverse of what the actuator does to a position. What the axis and
the held command would lag behind it (:mod:`rotemina.sim.feedback.reference_lead`) is added::

    w = inverse(r) + lead(r) − r

The push of the lead alternates from sample to sample where the path turns. Sent through the inverse
with the path, it would turn its memory about too, which costs more than it gains on an actuator
whose small loops are not quite those of the inverse.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from rotemina.sim.arrays import FloatArray


class SampledInverse(Protocol):
    """What position to ask for so that the axis takes the one that is wanted, sample by sample.

    :class:`rotemina.sim.compensate.inverse.Inverse` is one.
    """

    def reset(self) -> object:
        """Forget everything: the next sample begins at rest, after a rise from the low end."""

    def step(self, desired: float, /) -> float:
        """Return what to ask for at the next sample."""

    def run(self, desired: FloatArray, /) -> FloatArray:
        """Return what to ask for at the next n samples, the same numbers."""


class FeedForward:
    """Inverse and lead, sample by sample.

    Parameters
    ----------
    taps : sequence of float
        Weights of the present reference and those before it.
    inverse : SampledInverse, optional
        None: what is wanted is requested. One that has a stage against lag of its own must do
        without it (``preview``), as the lead is in its place.
    """

    def __init__(
        self, taps: Sequence[float] | FloatArray = (1.0,), inverse: SampledInverse | None = None
    ) -> None:
        self._taps = tuple(float(tap) for tap in taps)
        self._inverse = inverse
        self._before = [0.0] * (len(self._taps) - 1)

    def start(self, reference: float) -> float:
        """Rest at a reference, and return the output there."""
        self._before = [reference] * (len(self._taps) - 1)
        if self._inverse is None:
            return reference
        self._inverse.reset()
        return self._inverse.step(reference)

    def step(self, reference: float) -> float:
        """Return what to ask for at the next sample."""
        led = self._taps[0] * reference
        for tap, before in zip(self._taps[1:], self._before, strict=True):
            led += tap * before
        self._before = [reference, *self._before][: len(self._before)]
        return led if self._inverse is None else self._inverse.step(reference) + (led - reference)

    def run(self, reference: FloatArray) -> FloatArray:
        """Return what to ask for at every sample (n,), begun at rest at the first."""
        self.start(float(reference[0]))
        return self.go_on(reference)

    def go_on(self, reference: FloatArray) -> FloatArray:
        """Return what to ask for at the next n samples (n,), the same as by :meth:`step`."""
        rows, history = len(reference), len(self._before)
        led = np.concatenate([self._before[::-1], reference])
        wanted = self._taps[0] * led[history:]
        for late, tap in enumerate(self._taps[1:], start=1):
            wanted = wanted + tap * led[history - late : history - late + rows]
        self._before = [float(led[-1 - late]) for late in range(history)]
        if self._inverse is None:
            return wanted
        return self._inverse.run(reference) + (wanted - reference)
