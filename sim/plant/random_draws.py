"""Chance in a simulation: what noise and random effects draw."""

import numpy as np

from rotemina.sim.arrays import FloatArray

_AHEAD = 1024  # variates that are drawn at once: each drawing lets other threads take over


class Stream:
    """Standard normal variates, the same however many are taken at a time."""

    def __init__(self, generator: np.random.Generator) -> None:
        self._generator, self._left = generator, np.empty(0)

    def take(self, count: int) -> FloatArray:
        """Return the next ones (count,)."""
        missing = count - len(self._left)
        if missing > 0:
            drawn = self._generator.standard_normal(max(missing, _AHEAD))
            self._left = np.concatenate((self._left, drawn))
        taken, self._left = self._left[:count], self._left[count:]
        return taken


class Chance:
    """Standard normal variates, a stream of its own for each sensor and each random effect.

    Streams of their own make a run that is simulated piece by piece the same as one done at once.
    """

    def __init__(self, generator: np.random.Generator) -> None:
        self._generator = generator
        self._sensors: list[Stream] = []
        self._effects: list[Stream] = []

    def draw(self, rows: int, axes: int, effects: int) -> FloatArray:
        """Return (rows, effects + axes) variates: of the random effects, then of the sensors."""
        self._sensors += map(Stream, self._generator.spawn(max(axes - len(self._sensors), 0)))
        self._effects += map(Stream, self._generator.spawn(max(effects - len(self._effects), 0)))
        drawn = np.empty((rows, effects + axes))
        for column, stream in enumerate(self._effects[:effects] + self._sensors[:axes]):
            drawn[:, column] = stream.take(rows)
        return drawn
