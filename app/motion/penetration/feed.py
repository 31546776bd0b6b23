"""The samples of one axis, from the session's worker to whoever steps a penetration."""

from collections import deque
from dataclasses import dataclass

import numpy as np

from rotemina.app.motion.session import MotionSession
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray

_MOST_PORTIONS = 2000


@dataclass(frozen=True, slots=True, eq=False)
class AxisSamples:
    """Samples of one axis, (n,) each: device time, command, reading and reading − model."""

    time_s: FloatArray
    command: FloatArray
    measured: FloatArray
    residual: FloatArray

    def __len__(self) -> int:
        return len(self.time_s)

    def since(self, time_s: float) -> "AxisSamples":
        """Return those that are later."""
        kept = self.time_s > time_s
        return AxisSamples(
            self.time_s[kept], self.command[kept], self.measured[kept], self.residual[kept]
        )


NONE = AxisSamples(*(np.empty(0) for _ in range(4)))


def joined(parts: list[AxisSamples]) -> AxisSamples:
    """Return consecutive samples as one."""
    if not parts:
        return NONE
    return AxisSamples(
        np.concatenate([part.time_s for part in parts]),
        np.concatenate([part.command for part in parts]),
        np.concatenate([part.measured for part in parts]),
        np.concatenate([part.residual for part in parts]),
    )


class AxisFeed:
    """Keeps the samples of an axis until they are taken; two threads share it."""

    def __init__(self, session: MotionSession, axis: str) -> None:
        self._column = session.driver.axes.index(axis)
        self._portions: deque[AxisSamples] = deque(maxlen=_MOST_PORTIONS)
        self.end = session.tap(self._take)

    def _take(self, samples: Samples, model: FloatArray) -> None:
        column = self._column
        measured = samples.measured[:, column]
        self._portions.append(
            AxisSamples(
                samples.device_time_s,
                samples.command[:, column],
                measured,
                measured - model[:, column],
            )
        )

    def taken(self) -> AxisSamples:
        """Return what has come since the last call; without those that the model cannot answer."""
        parts = []
        while self._portions:
            parts.append(self._portions.popleft())
        found = joined(parts)
        sound = np.isfinite(found.residual)
        if sound.all():
            return found
        columns = (found.time_s, found.command, found.measured, found.residual)
        return AxisSamples(*(column[sound] for column in columns))
