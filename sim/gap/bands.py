"""In which frequencies a gap lies."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray

_PER_DECADE = 3
_SEGMENTS = 4  # at least, of a record, for its spectrum
_EVEN = 1e-3  # relative spread of sample intervals up to which a record counts as evenly sampled


class Spectrum(NamedTuple):
    """Power (b,) of a gap above its floor, in floors squared, in bands ``edges_hz`` (b + 1,)."""

    edges_hz: FloatArray
    power: FloatArray

    @property
    def worst_hz(self) -> tuple[float, float]:
        """The band that holds most."""
        band = int(np.argmax(self.power))
        return float(self.edges_hz[band]), float(self.edges_hz[band + 1])


def spectrum(time_s: FloatArray, gap: FloatArray) -> Spectrum | None:
    """Return the spectrum of a gap (n,) over its floor; None where it cannot be told.

    The floor is taken as white.
    """
    from scipy.signal import welch  # takes its time to import

    intervals = np.diff(time_s)
    if len(intervals) < 8 * _SEGMENTS or np.ptp(intervals) > _EVEN * float(intervals.mean()):
        return None
    rate_hz = 1.0 / float(intervals.mean())
    frequency_hz, density = welch(gap, rate_hz, nperseg=2 * len(gap) // (_SEGMENTS + 1))
    lowest, highest = float(frequency_hz[1]), float(frequency_hz[-1])
    bands = max(int(np.ceil(_PER_DECADE * np.log10(highest / lowest))), 1)
    edges_hz = np.geomspace(lowest, highest, bands + 1)
    above = (density - 2.0 / rate_hz) * (frequency_hz[1] - frequency_hz[0])
    place = np.clip(np.searchsorted(edges_hz, frequency_hz, side="right") - 1, 0, bands - 1)
    power = np.bincount(place[1:], above[1:], bands)
    return Spectrum(edges_hz, np.maximum(power, 0.0))
