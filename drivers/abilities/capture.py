"""Captures: samples of some axes at a high rate."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.compatibility import FormerMember, serve_former_names


@dataclass(frozen=True, slots=True)
class CaptureRates:
    """Limits of a capture.

    Attributes
    ----------
    single_axis_hz, multi_axis_hz : float
        Largest rate for one axis, and for two or more axes.
    max_axes, max_samples : int
        Largest numbers of axes and of samples.
    """

    single_axis_hz: float
    multi_axis_hz: float
    max_axes: int
    max_samples: int

    def max_rate_for(self, count: int) -> float:
        """Return the largest rate for a number of axes, Hz."""
        return self.single_axis_hz if count == 1 else self.multi_axis_hz

    # Former names, which work for one more release.
    all_hz = FormerMember("multi_axis_hz")
    axes = FormerMember("max_axes")
    of = FormerMember("max_rate_for")
    one_hz = FormerMember("single_axis_hz")
    samples = FormerMember("max_samples")


@dataclass(frozen=True, slots=True, eq=False)
class CapturedSamples:
    """Consecutive samples from a capture, oldest first.

    Attributes
    ----------
    axes : tuple of str
    device_time_s : (n,)
        Times on the clock of the device's other samples.
    measured : (n, len(axes))
        Sensor readings, m or rad.
    lost : int
        Number of samples lost from the start of the capture to the last of these samples.
    complete : bool
        Whether the last of these samples is the last sample of the capture.
    """

    axes: tuple[str, ...]
    device_time_s: FloatArray
    measured: FloatArray
    lost: int = 0
    complete: bool = False

    def __post_init__(self) -> None:
        for name in ("device_time_s", "measured"):
            array = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, make_read_only(array))


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Captured="CapturedSamples",
    )
