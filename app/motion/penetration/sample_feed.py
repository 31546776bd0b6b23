"""Samples of one axis, passed from the session's worker to a penetration."""

from collections import deque
from dataclasses import dataclass, fields

import numpy as np

from rotemina.app.motion.model import ModelOutputs
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import BoolArray, FloatArray

_MAX_BATCH_COUNT = 2000


@dataclass(frozen=True, slots=True, eq=False)
class AxisSamples:
    """Samples of one axis.

    Attributes
    ----------
    time_s : (n,)
        Device time.
    command, measured : (n,)
        Command and sensor reading, m.
    residual : (n,)
        Reading minus the output of the model in use, m, without effects that the model may have
        learned from a contact.
    nominal : (n,)
        Reading minus the output of the nominal model, m.
    """

    time_s: FloatArray
    command: FloatArray
    measured: FloatArray
    residual: FloatArray
    nominal: FloatArray

    def __len__(self) -> int:
        return len(self.time_s)

    def select_later(self, time_s: float) -> "AxisSamples":
        """Return the samples after a device time."""
        return self.select(self.time_s > time_s)

    def select(self, mask: BoolArray) -> "AxisSamples":
        """Return the samples that a mask (n,) selects."""
        return AxisSamples(*(getattr(self, name)[mask] for name in _FIELD_NAMES))


_FIELD_NAMES = tuple(field.name for field in fields(AxisSamples))
NO_SAMPLES = AxisSamples(*(np.empty(0) for _ in _FIELD_NAMES))


def join_samples(batches: list[AxisSamples]) -> AxisSamples:
    """Return consecutive batches of samples as one."""
    if not batches:
        return NO_SAMPLES
    return AxisSamples(
        *(np.concatenate([getattr(batch, name) for batch in batches]) for name in _FIELD_NAMES)
    )


class AxisSampleQueue:
    """Queue of the samples of one axis, shared by two threads."""

    def __init__(self, session: MotionSession, axis: str) -> None:
        self._column = session.driver.axes.index(axis)
        self._batches: deque[AxisSamples] = deque(maxlen=_MAX_BATCH_COUNT)
        self.unsubscribe = session.tap(self._on_samples)

    def _on_samples(self, samples: DeviceSamples, model_outputs: ModelOutputs) -> None:
        column = self._column
        measured = samples.measured[:, column]
        self._batches.append(
            AxisSamples(
                samples.device_time_s,
                samples.command[:, column],
                measured,
                measured - model_outputs.without_contact_effects[:, column],
                measured - model_outputs.nominal[:, column],
            )
        )

    def take(self) -> AxisSamples:
        """Return the samples since the last call, except those without a finite model output."""
        batches = []
        while self._batches:
            batches.append(self._batches.popleft())
        samples = join_samples(batches)
        is_finite = np.isfinite(samples.residual) & np.isfinite(samples.nominal)
        return samples if is_finite.all() else samples.select(is_finite)
