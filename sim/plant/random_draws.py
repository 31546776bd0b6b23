"""Chance in a simulation: what noise and random effects draw."""

import numpy as np

from rotemina.sim.arrays import FloatArray


class Chance:
    """Standard normal variates, a stream of its own for each sensor and each random effect.

    Streams of their own make a run that is simulated piece by piece the same as one done at once.
    """

    def __init__(self, generator: np.random.Generator) -> None:
        self._generator = generator
        self._sensors: list[np.random.Generator] = []
        self._effects: list[np.random.Generator] = []

    def draw(self, rows: int, axes: int, effects: int) -> FloatArray:
        """Return (rows, effects + axes) variates: of the random effects, then of the sensors."""
        self._sensors += self._generator.spawn(max(axes - len(self._sensors), 0))
        self._effects += self._generator.spawn(max(effects - len(self._effects), 0))
        drawn = np.empty((rows, effects + axes))
        for column, stream in enumerate(self._effects[:effects] + self._sensors[:axes]):
            drawn[:, column] = stream.standard_normal(rows)
        return drawn
