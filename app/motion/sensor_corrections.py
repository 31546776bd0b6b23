"""Calibrations of the axes' sensors, applied to the samples of a device.

Only this module corrects ``measured``: everything behind the session (history, guard, recorder,
panels) sees corrected readings, and drivers know nothing of calibrations.
"""

import threading
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.calibration.correction import Correction
from rotemina.sim.calibration.sensor import SensorModel

_NONE: Mapping[str, "AppliedCalibration"] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class AppliedCalibration:
    """A calibration as a session applies it.

    Attributes
    ----------
    name : date and digest, as records tell it.
    model : SensorModel
    travel : (low, high) of the fit, m or rad.
    """

    name: str
    model: SensorModel
    travel: tuple[float, float]


class SensorCorrections:
    """Corrects samples; calibrations are put on and off by any thread, at once.

    Parameters
    ----------
    axes : tuple of str
        What the columns of samples are.
    """

    def __init__(self, axes: tuple[str, ...]) -> None:
        self._axes = axes
        self._lock = threading.Lock()
        # Both are replaced as a whole; the worker notices a change by identity.
        self._applied = _NONE
        self._paused: frozenset[str] = frozenset()
        self._seen: tuple[object, object] = (None, None)
        self._corrections: dict[int, Correction] = {}

    @property
    def names(self) -> dict[str, str]:
        """The names of those that act on readings now, by axis."""
        paused = self._paused
        return {axis: one.name for axis, one in self._applied.items() if axis not in paused}

    def use(self, axis: str, calibration: AppliedCalibration | None) -> None:
        """Apply a calibration to an axis, or remove it.

        Raises
        ------
        KeyError
            If there is no such axis.
        """
        if axis not in self._axes:
            raise KeyError(axis)
        with self._lock:
            kept = {name: one for name, one in self._applied.items() if name != axis}
            if calibration is not None:
                kept[axis] = calibration
            self._applied = MappingProxyType(kept)

    def pause(self, axis: str) -> None:
        """Let the readings of an axis pass as they are, as a calibration must see them."""
        with self._lock:
            self._paused = self._paused | {axis}

    def resume(self, axis: str) -> None:
        """Correct the readings of an axis again."""
        with self._lock:
            self._paused = self._paused - {axis}

    def restart(self) -> None:
        """Forget earlier readings: a new connection has its own device time."""
        for correction in self._corrections.values():
            correction.restart()

    def corrected(self, samples: Samples) -> Samples:
        """Return samples with corrected readings; only on the worker's thread."""
        applied, paused = self._applied, self._paused
        if applied is not self._seen[0] or paused is not self._seen[1]:
            self._take_up(applied, paused)
        if not self._corrections or not len(samples):
            return samples
        measured = np.array(samples.measured)
        for column, correction in self._corrections.items():
            measured[:, column] = correction.apply(samples.device_time_s, measured[:, column])
        return replace(samples, measured=measured)

    def _take_up(self, applied: Mapping[str, AppliedCalibration], paused: frozenset[str]) -> None:
        self._seen = applied, paused
        self._corrections = {
            self._axes.index(axis): Correction(one.model, one.travel)
            for axis, one in applied.items()
            if axis not in paused
        }
