"""Autofocus: sharpness of a picture, its peak over the focus position, and the search for it.

Sharpness is the mean square of the gradient (Tenengrad) divided by the square of the mean
brightness, corrected for noise. As a function of the focus position z it is fitted by

    S(z) = b + a / (1 + ((z − z₀)/w)²)

This is the squared gradient of an edge if the variance of the blur grows with the square of the
distance from focus.
Sources: J. Tenenbaum, thesis, Stanford 1970; S. Pertuz et al., Pattern Recognition 46 (2013).
"""

from dataclasses import dataclass, replace
from typing import Self

import cv2
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import VisionError
from rotemina.sim.messages import format_fixed, format_rounded
from rotemina.sim.vision.image import Image, estimate_noise_rms

# Smoothing (σ) before gradients are computed.
_SMOOTHING_PX = 1.0
_MIN_PICTURES = 5
# Smallest ratio of the half width of a peak to the spacing of the pictures.
_MIN_HALF_WIDTH_RATIO = 0.5
# Smallest ratio of the height of a peak to its standard deviation.
_MIN_SIGNIFICANCE = 8.0
# Number of pictures over the whole range, and around the best of them.
_COARSE_PICTURES, _FINE_PICTURES = 9, 7


@dataclass(frozen=True, slots=True)
class FocusPeak:
    """Sharpest focus position, m, its standard deviation, m, and the half width of the peak, m."""

    place: float
    uncertainty: float
    width: float


def measure_sharpness(image: Image) -> float:
    """Return the sharpness of an image, 1/px²; 0 on average for an image without detail."""
    smoothed = cv2.GaussianBlur(image, (0, 0), _SMOOTHING_PX)
    x_gradient, y_gradient = (
        cv2.Sobel(smoothed, cv2.CV_32F, *direction, ksize=3, scale=0.125)
        for direction in _GRADIENT_DIRECTIONS
    )
    squares = float((x_gradient**2 + y_gradient**2)[2:-2, 2:-2].mean())
    return (squares - _NOISE_GAIN * estimate_noise_rms(image) ** 2) / float(image.mean()) ** 2


def fit_peak(places: FloatArray, values: FloatArray) -> FocusPeak:
    """Fit the peak of sharpness ``values`` (n,) at focus positions ``places`` (n,), m.

    Raises
    ------
    VisionError
        If there are too few pictures, there is no distinct peak, or it lies outside their range.
    """
    z, s = np.asarray(places, dtype=float), np.asarray(values, dtype=float)
    if len(z) < _MIN_PICTURES or not (np.isfinite(z).all() and np.isfinite(s).all()):
        raise VisionError(
            "focus: {count} pictures, must be at least {least_looks} with finite "
            "sharpness; use more positions",
            count=len(z),
            least_looks=_MIN_PICTURES,
        )
    span, low, sharpness_range = float(np.ptp(z)), float(s.min()), float(np.ptp(s))
    if span == 0.0 or sharpness_range == 0.0:
        raise VisionError("focus: all pictures are equally sharp; bring detail into view")

    def compute_misfit(values: FloatArray) -> FloatArray:
        base, height, place, width = values
        x = (z - z.mean()) / span
        return np.asarray(
            base + height / (1.0 + ((x - place) / width) ** 2) - (s - low) / sharpness_range
        )

    start_place = float((z[int(np.argmax(s))] - z.mean()) / span)
    fit = scipy.optimize.least_squares(
        compute_misfit, [0.0, 1.0, start_place, 0.2], x_scale=[1.0, 1.0, 0.1, 0.1]
    )
    degrees_of_freedom = max(len(z) - 4, 1)
    jacobian = np.asarray(fit.jac, dtype=np.float64)
    covariance = np.linalg.pinv(jacobian.T @ jacobian) * 2.0 * float(fit.cost) / degrees_of_freedom
    height, place, width = float(fit.x[1]), float(fit.x[2]), abs(float(fit.x[3]))
    if height < _MIN_SIGNIFICANCE * float(np.sqrt(abs(covariance[1, 1]))) or height <= 0.0:
        raise VisionError(
            "focus: the sharpness has no distinct peak; bring detail into view, increase "
            "the light, or search a larger range"
        )
    if width < _MIN_HALF_WIDTH_RATIO / (len(z) - 1):
        raise VisionError(
            "focus: the peak, {width} µm wide, is narrower than the spacing of the "
            "pictures; it is noise, or the spacing must be smaller",
            width=format_rounded(width * span * 1000000.0, 2),
        )
    peak_place = float(z.mean() + place * span)
    if not z.min() <= peak_place <= z.max():
        raise VisionError(
            "focus: the sharpest position would be {place} µm, outside the searched "
            "range {low} to {high} µm; search there",
            place=format_fixed(peak_place * 1e6, 1),
            low=format_fixed(z.min() * 1e6, 1),
            high=format_fixed(z.max() * 1e6, 1),
        )
    return FocusPeak(peak_place, float(np.sqrt(abs(covariance[2, 2]))) * span, width * span)


@dataclass(frozen=True, slots=True)
class AutofocusSearch:
    """A search for the sharpest focus position.

    Make a search by :meth:`between`. Then move to :attr:`target`, measure the sharpness, and
    continue with the search that :meth:`with_sharpness` returns, until it is done.

    Attributes
    ----------
    planned : tuple of float
        Positions that still have to be measured, m.
    places, values : tuple of float
        Measured positions, m, and their sharpness.
    fine : bool
        Whether the search has reached its fine stage around the best position.
    peak : FocusPeak or None
        The result.
    """

    planned: tuple[float, ...]
    places: tuple[float, ...] = ()
    values: tuple[float, ...] = ()
    fine: bool = False
    peak: FocusPeak | None = None

    @classmethod
    def between(cls, low: float, high: float) -> Self:
        """Return a search between two positions, m.

        It moves upwards, so that backlash always acts in the same direction.

        Raises
        ------
        VisionError
            If a position is not finite, or ``low`` is not below ``high``.
        """
        if not (np.isfinite([low, high]).all() and low < high):
            raise VisionError(
                "focus: {low} m to {high} m is not a range; low must be below high",
                low=low,
                high=high,
            )
        return cls(tuple(np.linspace(low, high, _COARSE_PICTURES).tolist()))

    @property
    def target(self) -> float | None:
        """The next position to measure, m; the sharpest position when the search is done."""
        if self.planned:
            return self.planned[0]
        return None if self.peak is None else self.peak.place

    @property
    def is_done(self) -> bool:
        """Whether the sharpest position is found."""
        return self.peak is not None

    def with_sharpness(self, value: float) -> Self:
        """Return the search after a measurement of the sharpness at :attr:`target`.

        Raises
        ------
        VisionError
            For the same reasons as in :func:`fit_peak`, or if the search has ended.
        """
        if not self.planned:
            raise VisionError("focus: the search has ended; start a new one")
        search = replace(
            self,
            planned=self.planned[1:],
            places=(*self.places, self.planned[0]),
            values=(*self.values, float(value)),
        )
        if search.planned:
            return search
        if not search.fine:
            return search._refine_search()
        fine_stage = (
            np.array(search.places[_COARSE_PICTURES:]),
            np.array(search.values[_COARSE_PICTURES:]),
        )
        return replace(search, peak=fit_peak(*fine_stage))

    def _refine_search(self) -> Self:
        best = int(np.argmax(self.values))
        low = self.places[max(best - 1, 0)]
        high = self.places[min(best + 1, len(self.places) - 1)]
        return replace(
            self, planned=tuple(np.linspace(low, high, _FINE_PICTURES).tolist()), fine=True
        )


_GRADIENT_DIRECTIONS = ((1, 0), (0, 1))


def _compute_noise_gain() -> float:
    """Return the mean square of the gradient of white noise with variance 1."""
    impulse = np.zeros((33, 33), dtype=np.float32)
    impulse[16, 16] = 1.0
    smoothed = cv2.GaussianBlur(impulse, (0, 0), _SMOOTHING_PX)
    parts = (
        cv2.Sobel(smoothed, cv2.CV_32F, *direction, ksize=3, scale=0.125)
        for direction in _GRADIENT_DIRECTIONS
    )
    return sum(float((part**2).sum()) for part in parts)


_NOISE_GAIN = _compute_noise_gain()
