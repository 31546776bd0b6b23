"""Focus: how sharp a picture is, where it is sharpest, and where to look next.

Sharpness is the mean square of the gradient (Tenengrad) over the square of the mean brightness,
less what the noise adds. Against the place of the focus it is fitted by

    S(z) = b + a / (1 + ((z − z₀)/w)²)

which a blur whose variance grows with the square of the distance gives an edge's gradient.
Sources: J. Tenenbaum, thesis, Stanford 1970; S. Pertuz et al., Pattern Recognition 46 (2013).
"""

from dataclasses import dataclass, replace
from typing import Self

import cv2
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed, rounded
from rotemina.sim.vision.errors import VisionError
from rotemina.sim.vision.image import Image, noise_rms

_SOFTENED = 1.0  # px, before gradients are taken
_LEAST_LOOKS = 5
_NARROWEST = 0.5  # half width of a peak, of the distance between looks
_LEAST_SIGNIFICANCE = 8.0  # of the peak's height over its uncertainty
_COARSE, _FINE = 9, 7  # looks at the whole range, and about the best of them


@dataclass(frozen=True, slots=True)
class FocusPeak:
    """Where it is sharpest, m, with its standard deviation; the peak's half width, m."""

    place: float
    uncertainty: float
    width: float


def sharpness(image: Image) -> float:
    """Return how sharp an image is, 1/px²; 0 on average for one without detail."""
    soft = cv2.GaussianBlur(image, (0, 0), _SOFTENED)
    across, down = (cv2.Sobel(soft, cv2.CV_32F, *way, ksize=3, scale=0.125) for way in _WAYS)
    squares = float((across**2 + down**2)[2:-2, 2:-2].mean())
    return (squares - _NOISE_GAIN * noise_rms(image) ** 2) / float(image.mean()) ** 2


def fit_peak(places: FloatArray, values: FloatArray) -> FocusPeak:
    """Return where sharpness ``values`` (n,) at focus ``places`` (n,), m, has its peak.

    Raises
    ------
    VisionError
        If there are too few looks, no peak stands out, or it is not among them.
    """
    z, s = np.asarray(places, dtype=float), np.asarray(values, dtype=float)
    if len(z) < _LEAST_LOOKS or not (np.isfinite(z).all() and np.isfinite(s).all()):
        raise VisionError(
            message(
                "engine",
                "focus: {count} pictures, must be at least {least_looks} with finite "
                "sharpness; use more positions",
            ).fill(count=len(z), least_looks=_LEAST_LOOKS)
        )
    span, low, rise = float(np.ptp(z)), float(s.min()), float(np.ptp(s))
    if span == 0.0 or rise == 0.0:
        raise VisionError(
            message("engine", "focus: all pictures are equally sharp; bring detail into view")
        )

    def misfit(values: FloatArray) -> FloatArray:
        base, height, place, width = values
        x = (z - z.mean()) / span
        return np.asarray(base + height / (1.0 + ((x - place) / width) ** 2) - (s - low) / rise)

    best = float((z[int(np.argmax(s))] - z.mean()) / span)
    fit = scipy.optimize.least_squares(misfit, [0.0, 1.0, best, 0.2], x_scale=[1.0, 1.0, 0.1, 0.1])
    freedom = max(len(z) - 4, 1)
    jacobian = np.asarray(fit.jac, dtype=np.float64)
    spread = np.linalg.pinv(jacobian.T @ jacobian) * 2.0 * float(fit.cost) / freedom
    height, place, width = float(fit.x[1]), float(fit.x[2]), abs(float(fit.x[3]))
    if height < _LEAST_SIGNIFICANCE * float(np.sqrt(abs(spread[1, 1]))) or height <= 0.0:
        raise VisionError(
            message(
                "engine",
                "focus: the sharpness has no distinct peak; bring detail into view, increase "
                "the light, or search a larger range",
            )
        )
    if width < _NARROWEST / (len(z) - 1):
        raise VisionError(
            message(
                "engine",
                "focus: the peak, {width} µm wide, is narrower than the spacing of the "
                "pictures; it is noise, or the spacing must be smaller",
            ).fill(width=rounded(width * span * 1000000.0, 2))
        )
    found = float(z.mean() + place * span)
    if not z.min() <= found <= z.max():
        raise VisionError(
            message(
                "engine",
                "focus: the sharpest position would be {place} µm, outside the searched "
                "range {low} to {high} µm; search there",
            ).fill(
                place=fixed(found * 1e6, 1),
                low=fixed(z.min() * 1e6, 1),
                high=fixed(z.max() * 1e6, 1),
            )
        )
    return FocusPeak(found, float(np.sqrt(abs(spread[2, 2]))) * span, width * span)


@dataclass(frozen=True, slots=True)
class Autofocus:
    """A search for the sharpest position; move to :attr:`target`, measure, and report.

    Make one by :meth:`between`; each :meth:`with_sharpness` returns the search after one more look.

    Attributes
    ----------
    planned : tuple of float
        Places still to be looked at, m.
    places, values : tuple of float
        What was looked at, and how sharp it was.
    fine : bool
        Whether it looks about the best place already.
    peak : FocusPeak or None
        What was found.
    """

    planned: tuple[float, ...]
    places: tuple[float, ...] = ()
    values: tuple[float, ...] = ()
    fine: bool = False
    peak: FocusPeak | None = None

    @classmethod
    def between(cls, low: float, high: float) -> Self:
        """Return a search between two places, m, upwards: backlash is taken up one way.

        Raises
        ------
        VisionError
            If that is no range.
        """
        if not (np.isfinite([low, high]).all() and low < high):
            raise VisionError(
                message(
                    "engine", "focus: {low} m to {high} m is not a range; low must be below high"
                ).fill(low=low, high=high)
            )
        return cls(tuple(np.linspace(low, high, _COARSE).tolist()))

    @property
    def target(self) -> float | None:
        """Where to look next, m; the sharpest place when all is done."""
        if self.planned:
            return self.planned[0]
        return None if self.peak is None else self.peak.place

    @property
    def done(self) -> bool:
        """Whether it is found."""
        return self.peak is not None

    def with_sharpness(self, value: float) -> Self:
        """Return the search after the look at :attr:`target`, which was so sharp.

        Raises
        ------
        VisionError
            As :func:`fit_peak`.
        """
        if not self.planned:
            raise VisionError(message("engine", "focus: the search has ended; start a new one"))
        after = replace(
            self,
            planned=self.planned[1:],
            places=(*self.places, self.planned[0]),
            values=(*self.values, float(value)),
        )
        if after.planned:
            return after
        if not after.fine:
            return after._refined()
        near = np.array(after.places[_COARSE:]), np.array(after.values[_COARSE:])
        return replace(after, peak=fit_peak(*near))

    def _refined(self) -> Self:
        best = int(np.argmax(self.values))
        low = self.places[max(best - 1, 0)]
        high = self.places[min(best + 1, len(self.places) - 1)]
        return replace(self, planned=tuple(np.linspace(low, high, _FINE).tolist()), fine=True)


_WAYS = ((1, 0), (0, 1))


def _noise_gain() -> float:
    """Return what white noise of variance 1 adds to the mean square of the gradient."""
    impulse = np.zeros((33, 33), dtype=np.float32)
    impulse[16, 16] = 1.0
    soft = cv2.GaussianBlur(impulse, (0, 0), _SOFTENED)
    parts = (cv2.Sobel(soft, cv2.CV_32F, *way, ksize=3, scale=0.125) for way in _WAYS)
    return sum(float((part**2).sum()) for part in parts)


_NOISE_GAIN = _noise_gain()
