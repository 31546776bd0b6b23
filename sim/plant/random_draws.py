"""Random numbers of a simulation: draws for noise and random effects."""

import numpy as np

from rotemina.sim.arrays import FloatArray

# At least this many variates are drawn at a time, because each draw lets other threads run.
_MIN_DRAW_COUNT = 1024


class NormalStream:
    """Standard normal variates that do not depend on how many are taken at a time."""

    def __init__(self, generator: np.random.Generator) -> None:
        self._generator, self._buffer = generator, np.empty(0)

    def take(self, count: int) -> FloatArray:
        """Return the next ``count`` variates (count,)."""
        missing = count - len(self._buffer)
        if missing > 0:
            drawn = self._generator.standard_normal(max(missing, _MIN_DRAW_COUNT))
            self._buffer = np.concatenate((self._buffer, drawn))
        taken, self._buffer = self._buffer[:count], self._buffer[count:]
        return taken


class RandomStreams:
    """Standard normal variates, with a separate stream for each sensor and each random effect.

    The separate streams make a run simulated in pieces equal to one simulated as a whole.
    """

    def __init__(self, generator: np.random.Generator) -> None:
        self._generator = generator
        self._sensors: list[NormalStream] = []
        self._effects: list[NormalStream] = []

    def draw(self, rows: int, axes: int, effects: int) -> FloatArray:
        """Return (rows, effects + axes) variates: of the random effects, then of the sensors."""
        self._sensors += map(NormalStream, self._generator.spawn(max(axes - len(self._sensors), 0)))
        self._effects += map(
            NormalStream, self._generator.spawn(max(effects - len(self._effects), 0))
        )
        drawn = np.empty((rows, effects + axes))
        for column, stream in enumerate(self._effects[:effects] + self._sensors[:axes]):
            drawn[:, column] = stream.take(rows)
        return drawn
