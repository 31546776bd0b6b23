"""A template laid over an image to a fraction of a pixel, with the covariance of where it lies.

Least squares over the template's pixels x, solved by repeated linearisation::

    I(x + p) = g T(x + δ) + o ≈ [∂T/∂x  ∂T/∂y  T  1] [g δx, g δy, g, o]ᵀ,    p ← p − δ

Gain g and offset o let the light change. Tukey's weights leave out pixels that something else
covers. With the weighted columns J and the residuals' variance σ², the covariance of p is the
upper 2 × 2 of σ² (JᵀJ)⁻¹ / g². Source: B. Lucas, T. Kanade, IJCAI 1981; S. Baker, I. Matthews,
IJCV 56 (2004), whose "inverse" form keeps the template's gradients.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.image import Image

FLOOR_PX = 0.01  # what interpolation leaves, however little noise there is
_TUKEY = 4.685  # of the residuals' scale: 95 % efficient on normal noise
_MARGIN = 2  # px that the interpolation needs about a patch
_TURNS = 15
_SETTLED_PX = 2e-3
_LEAST_GAIN = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Alignment:
    """Where a template lies in an image.

    Attributes
    ----------
    corner : (2,)
        Column and row, px, of the template's upper left pixel.
    covariance : (2, 2)
        Of ``corner``, px².
    correlation : float
        Of template and image, by the pixels that count; 1 is perfect.
    used : float
        Share of the pixels that count, 0 to 1; what is covered by something else does not.
    residual_rms : float
        Of the pixels that count, in the image's units.
    settled : bool
        Whether the iteration came to rest.
    """

    corner: FloatArray
    covariance: FloatArray
    correlation: float
    used: float
    residual_rms: float
    settled: bool


def patch_at(image: Image, corner: FloatArray, shape: tuple[int, int]) -> Image | None:
    """Return the ``shape`` patch of an image whose first pixel is at ``corner`` (2,), px.

    Between pixels by Keys' cubic, as two one-dimensional filters; None where it leaves the image.
    """
    whole = np.floor(corner).astype(int)
    left, top = whole - _MARGIN
    right, bottom = whole + np.array(shape[::-1]) + _MARGIN
    if left < 0 or top < 0 or right > image.shape[1] or bottom > image.shape[0]:
        return None
    across, along = (_keys(float(part)) for part in corner - whole)
    region = image[top:bottom, left:right]
    moved = cv2.sepFilter2D(region, cv2.CV_32F, across, along)
    return np.asarray(moved[_MARGIN:-_MARGIN, _MARGIN:-_MARGIN], dtype=np.float32)


def align(
    template: Image,
    image: Image,
    start: FloatArray,
    *,
    stride: int = 1,
    most_px: float = 8.0,
) -> Alignment | None:
    """Find where ``template`` lies in ``image``, from ``start`` (2,) on.

    Parameters
    ----------
    template, image : images
    start : (2,)
        A guess of its corner, px, within about the size of its details.
    stride : int
        Only every so many rows and columns are looked at: a large image has pixels to spare.
    most_px : float
        How far it may wander from the guess.

    Returns
    -------
    Alignment or None
        None where it left the image or the neighbourhood, or the template has no detail.
    """
    thin = (slice(None, None, stride),) * 2
    columns, fit = _columns(template, thin), np.zeros(4)
    corner = np.array(start, dtype=np.float64)
    weighed, settled = np.ones(len(columns)), False
    for turn in range(_TURNS):
        patch = patch_at(image, corner, template.shape)
        if patch is None:
            return None
        seen = patch[thin].ravel().astype(np.float64)
        normal = columns.T @ (weighed[:, None] * columns)
        solved = _solved(normal, columns.T @ (weighed * seen))
        if solved is None or solved[2] < _LEAST_GAIN:
            return None
        fit = solved
        step = fit[:2] / fit[2]
        corner -= np.clip(step, -2.0, 2.0)
        if np.linalg.norm(corner - start) > most_px:
            return None
        residual = seen - columns @ fit
        weighed = _tukey(residual)
        settled = bool(np.abs(step).max() < _SETTLED_PX)
        if settled and turn > 1:
            break
    return _judged(columns, weighed, residual, float(fit[2]), corner, settled)


def _judged(
    columns: FloatArray,
    weighed: FloatArray,
    residual: FloatArray,
    gain: float,
    corner: FloatArray,
    settled: bool,
) -> Alignment | None:
    total = float(weighed.sum())
    variance = float((weighed * residual**2).sum()) / max(total - 4.0, 1.0)
    normal = columns.T @ (weighed[:, None] * columns)
    try:
        spread = variance / gain**2 * np.linalg.inv(normal)[:2, :2]
    except np.linalg.LinAlgError:
        return None
    model = gain * columns[:, 2]
    mean = float((weighed * model).sum()) / total
    power = float((weighed * (model - mean) ** 2).sum()) / total
    return Alignment(
        corner=corner,
        covariance=spread + FLOOR_PX**2 * np.eye(2),
        correlation=float(np.sqrt(power / (power + variance))),
        used=total / len(weighed),
        residual_rms=float(np.sqrt(variance)),
        settled=settled,
    )


def _columns(template: Image, thin: tuple[slice, slice]) -> FloatArray:
    """Return the linearised model's columns (pixels, 4), of the pixels that are looked at."""
    along = cv2.sepFilter2D(template, cv2.CV_32F, np.array([-0.5, 0, 0.5]), np.ones(1))
    down = cv2.sepFilter2D(template, cv2.CV_32F, np.ones(1), np.array([-0.5, 0, 0.5]))
    planes = (along, down, template, np.ones_like(template))
    return np.stack([plane[thin].ravel() for plane in planes], axis=1).astype(np.float64)


def _solved(normal: FloatArray, right: FloatArray) -> FloatArray | None:
    try:
        return np.asarray(np.linalg.solve(normal, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        return None


def _tukey(residual: FloatArray) -> FloatArray:
    scale = 1.4826 * float(np.median(np.abs(residual))) * _TUKEY
    if scale == 0.0:
        return np.ones_like(residual)
    return np.asarray(np.clip(1.0 - (residual / scale) ** 2, 0.0, None) ** 2)


def _keys(fraction: float) -> FloatArray:
    """Return the five weights that take an image ``fraction`` px further.

    Source: R. Keys, IEEE Trans. ASSP 29 (1981), with a = −1/2; the first weight is 0.
    """
    t = fraction
    return np.array(
        [
            0.0,
            t * (-0.5 + t * (1.0 - 0.5 * t)),
            1.0 + t * t * (1.5 * t - 2.5),
            t * (0.5 + t * (2.0 - 1.5 * t)),
            0.5 * t * t * (t - 1.0),
        ]
    )
