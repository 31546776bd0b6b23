"""Calibrations of the axes' sensors, applied to the samples of a device.

``measured`` is corrected only here. Everything that receives samples from the session (history,
guard, recorder, panels) gets corrected readings. Drivers do not know about calibrations.
"""

import threading
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.calibration import ReadingCorrection, SensorModel

_NO_CALIBRATIONS: Mapping[str, "AppliedCalibration"] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class AppliedCalibration:
    """A calibration as a session applies it.

    Attributes
    ----------
    name : str
        Date and digest, as used in records.
    model : SensorModel
    travel : (low, high)
        Range of the fit, m or rad.
    """

    name: str
    model: SensorModel
    travel: tuple[float, float]


class SensorCorrections:
    """Corrects samples; any thread may apply and remove calibrations, with immediate effect.

    Parameters
    ----------
    axes : tuple of str
        Names of the samples' columns.
    """

    def __init__(self, axes: tuple[str, ...]) -> None:
        self._axes = axes
        self._lock = threading.Lock()
        # Both are replaced as a whole. So the worker, which takes no lock, detects a change by
        # identity.
        self._applied = _NO_CALIBRATIONS
        self._paused_axes: frozenset[str] = frozenset()
        self._corrections_built_for: tuple[object, object] = (None, None)
        self._corrections: dict[int, ReadingCorrection] = {}

    @property
    def names(self) -> dict[str, str]:
        """The names of the calibrations that now correct readings, by axis."""
        paused_axes = self._paused_axes
        return {
            axis: calibration.name
            for axis, calibration in self._applied.items()
            if axis not in paused_axes
        }

    def set_calibration(self, axis: str, calibration: AppliedCalibration | None) -> None:
        """Apply a calibration to an axis, or remove it.

        Raises
        ------
        KeyError
            If the axis does not exist.
        """
        if axis not in self._axes:
            raise KeyError(axis)
        with self._lock:
            applied = {name: other for name, other in self._applied.items() if name != axis}
            if calibration is not None:
                applied[axis] = calibration
            self._applied = MappingProxyType(applied)

    def pause(self, axis: str) -> None:
        """Leave the readings of an axis uncorrected, for example for a calibration run."""
        with self._lock:
            self._paused_axes = self._paused_axes | {axis}

    def resume(self, axis: str) -> None:
        """Correct the readings of an axis again."""
        with self._lock:
            self._paused_axes = self._paused_axes - {axis}

    def restart(self) -> None:
        """Forget earlier readings when a new connection with its own device time begins."""
        for correction in self._corrections.values():
            correction.restart()

    def correct(self, samples: DeviceSamples) -> DeviceSamples:
        """Return samples with corrected readings. Only the worker calls this."""
        applied, paused_axes = self._applied, self._paused_axes
        if (
            applied is not self._corrections_built_for[0]
            or paused_axes is not self._corrections_built_for[1]
        ):
            self._rebuild_corrections(applied, paused_axes)
        if not self._corrections or not len(samples):
            return samples
        measured = np.array(samples.measured)
        for column, correction in self._corrections.items():
            measured[:, column] = correction.apply(samples.device_time_s, measured[:, column])
        return replace(samples, measured=measured)

    def _rebuild_corrections(
        self, applied: Mapping[str, AppliedCalibration], paused_axes: frozenset[str]
    ) -> None:
        self._corrections_built_for = applied, paused_axes
        self._corrections = {
            self._axes.index(axis): ReadingCorrection(calibration.model, calibration.travel)
            for axis, calibration in applied.items()
            if axis not in paused_axes
        }
