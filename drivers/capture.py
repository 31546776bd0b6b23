"""Samples of some axes at a high rate."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only


@dataclass(frozen=True, slots=True)
class CaptureRates:
    """The greatest rates of a capture of one axis and of ``axes`` axes, Hz; samples at most."""

    one_hz: float
    all_hz: float
    axes: int
    samples: int

    def of(self, count: int) -> float:
        """Return the greatest rate for so many axes, Hz."""
        return self.one_hz if count == 1 else self.all_hz


@dataclass(frozen=True, slots=True, eq=False)
class Captured:
    """Part of a capture, oldest first.

    Attributes
    ----------
    axes : tuple of str
    device_time_s : (n,)
        On the clock of the device's other samples.
    measured : (n, len(axes))
        m or rad.
    lost : int
        Samples that never arrived, of those up to the last one here, since the capture began.
    complete : bool
        Whether the last sample of the capture is among these.
    """

    axes: tuple[str, ...]
    device_time_s: FloatArray
    measured: FloatArray
    lost: int = 0
    complete: bool = False

    def __post_init__(self) -> None:
        for name in ("device_time_s", "measured"):
            array = np.ascontiguousarray(getattr(self, name), dtype=np.float64)
            object.__setattr__(self, name, read_only(array))
