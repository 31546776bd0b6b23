"""The samples of one axis, from the session's worker to a penetration."""

from collections import deque
from dataclasses import dataclass, fields

import numpy as np

from rotemina.app.motion.live_models import ModelOutputs
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import BoolArray, FloatArray

_MOST_PORTIONS = 2000


@dataclass(frozen=True, slots=True, eq=False)
class AxisSamples:
    """Samples of one axis, (n,) each: device time, command, reading, and reading − model.

    ``residual`` uses the model in use, without effects that may be a contact in its records;
    ``nominal`` uses the nominal model.
    """

    time_s: FloatArray
    command: FloatArray
    measured: FloatArray
    residual: FloatArray
    nominal: FloatArray

    def __len__(self) -> int:
        return len(self.time_s)

    def since(self, time_s: float) -> "AxisSamples":
        """Return those that are later."""
        return self.part(self.time_s > time_s)

    def part(self, kept: BoolArray) -> "AxisSamples":
        """Return some of them."""
        return AxisSamples(*(getattr(self, name)[kept] for name in _NAMES))


_NAMES = tuple(one.name for one in fields(AxisSamples))
NONE = AxisSamples(*(np.empty(0) for _ in _NAMES))


def joined(parts: list[AxisSamples]) -> AxisSamples:
    """Return consecutive samples as one."""
    if not parts:
        return NONE
    return AxisSamples(*(np.concatenate([getattr(p, name) for p in parts]) for name in _NAMES))


class AxisFeed:
    """Keeps the samples of an axis until they are taken; two threads share it."""

    def __init__(self, session: MotionSession, axis: str) -> None:
        self._column = session.driver.axes.index(axis)
        self._portions: deque[AxisSamples] = deque(maxlen=_MOST_PORTIONS)
        self.end = session.tap(self._take)

    def _take(self, samples: Samples, answers: ModelOutputs) -> None:
        column = self._column
        measured = samples.measured[:, column]
        self._portions.append(
            AxisSamples(
                samples.device_time_s,
                samples.command[:, column],
                measured,
                measured - answers.cautious[:, column],
                measured - answers.nominal[:, column],
            )
        )

    def taken(self) -> AxisSamples:
        """Return the samples since the last call, without those that the model cannot answer."""
        parts = []
        while self._portions:
            parts.append(self._portions.popleft())
        found = joined(parts)
        sound = np.isfinite(found.residual) & np.isfinite(found.nominal)
        return found if sound.all() else found.part(sound)
