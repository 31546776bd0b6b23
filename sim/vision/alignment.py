"""Alignment of a template with an image to a fraction of a pixel, with its covariance.

Least squares over the pixels x of the template, solved by repeated linearisation::

    I(x + p) = g T(x + δ) + o ≈ [∂T/∂x  ∂T/∂y  T  1] [g δx, g δy, g, o]ᵀ,    p ← p − δ

Gain g and offset o allow for changes of the light. Tukey's weights leave out pixels that another
object covers. With the weighted columns J and the variance σ² of the residuals, the covariance of p
is the upper 2 × 2 part of σ² (JᵀJ)⁻¹ / g². Sources: B. Lucas, T. Kanade, IJCAI 1981; S. Baker,
I. Matthews, IJCV 56 (2004), whose "inverse" form needs the gradients of the template only once.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.image import Image

# Standard deviation of the interpolation error, which remains without noise.
MIN_DEVIATION_PX = 0.01
# Ratio of the cut-off of Tukey's weights to the scale of the residuals; 95 % efficient for normal
# noise.
_TUKEY_CUTOFF = 4.685
# Pixels around a patch that the interpolation needs.
_INTERPOLATION_MARGIN_PX = 2
_MAX_ITERATIONS = 15
_MAX_SETTLED_STEP_PX = 2e-3
_MIN_GAIN = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class TemplateAlignment:
    """Position of a template in an image.

    Attributes
    ----------
    corner : (2,)
        Column and row, px, of the upper left pixel of the template.
    covariance : (2, 2)
        Covariance of ``corner``, px².
    correlation : float
        Correlation of template and image over the weighted pixels; 1 is perfect.
    used : float
        Share of the pixels with weight, 0 to 1. Pixels that another object covers have none.
    residual_rms : float
        RMS residual of the weighted pixels, in the units of the image.
    settled : bool
        Whether the iteration has converged.
    """

    corner: FloatArray
    covariance: FloatArray
    correlation: float
    used: float
    residual_rms: float
    settled: bool


def interpolate_patch(image: Image, corner: FloatArray, shape: tuple[int, int]) -> Image | None:
    """Return a patch of ``shape`` of an image, with its first pixel at ``corner`` (2,), px.

    Values between pixels are interpolated by Keys' cubic, as two one-dimensional filters. Return
    None if the patch leaves the image.
    """
    first_pixel = np.floor(corner).astype(int)
    left, top = first_pixel - _INTERPOLATION_MARGIN_PX
    right, bottom = first_pixel + np.array(shape[::-1]) + _INTERPOLATION_MARGIN_PX
    if left < 0 or top < 0 or right > image.shape[1] or bottom > image.shape[0]:
        return None
    column_weights, row_weights = (
        _compute_keys_weights(float(part)) for part in corner - first_pixel
    )
    region = image[top:bottom, left:right]
    shifted = cv2.sepFilter2D(region, cv2.CV_32F, column_weights, row_weights)
    return np.asarray(
        shifted[
            _INTERPOLATION_MARGIN_PX:-_INTERPOLATION_MARGIN_PX,
            _INTERPOLATION_MARGIN_PX:-_INTERPOLATION_MARGIN_PX,
        ],
        dtype=np.float32,
    )


def align_template(
    template: Image,
    image: Image,
    start: FloatArray,
    *,
    stride: int = 1,
    max_shift_px: float = 8.0,
) -> TemplateAlignment | None:
    """Align ``template`` with ``image``, beginning at ``start`` (2,).

    Parameters
    ----------
    template, image : images
    start : (2,)
        Estimate of the corner, px. Its error must not exceed the size of the details.
    stride : int
        Spacing of the rows and columns that are used, to save time with large images.
    max_shift_px : float
        Largest distance of the result from ``start``.

    Returns
    -------
    TemplateAlignment or None
        None if the template leaves the image or moves farther than ``max_shift_px``, or has no
        detail.
    """
    subsample = (slice(None, None, stride),) * 2
    columns, coefficients = _make_columns(template, subsample), np.zeros(4)
    corner = np.array(start, dtype=np.float64)
    weights, settled = np.ones(len(columns)), False
    for iteration in range(_MAX_ITERATIONS):
        patch = interpolate_patch(image, corner, template.shape)
        if patch is None:
            return None
        values = patch[subsample].ravel().astype(np.float64)
        normal_matrix = columns.T @ (weights[:, None] * columns)
        solution = _solve(normal_matrix, columns.T @ (weights * values))
        if solution is None or solution[2] < _MIN_GAIN:
            return None
        coefficients = solution
        step = coefficients[:2] / coefficients[2]
        corner -= np.clip(step, -2.0, 2.0)
        if np.linalg.norm(corner - start) > max_shift_px:
            return None
        residual = values - columns @ coefficients
        weights = _compute_tukey_weights(residual)
        settled = bool(np.abs(step).max() < _MAX_SETTLED_STEP_PX)
        if settled and iteration > 1:
            break
    return _make_alignment(columns, weights, residual, float(coefficients[2]), corner, settled)


def _make_alignment(
    columns: FloatArray,
    weights: FloatArray,
    residual: FloatArray,
    gain: float,
    corner: FloatArray,
    settled: bool,
) -> TemplateAlignment | None:
    weight_sum = float(weights.sum())
    variance = float((weights * residual**2).sum()) / max(weight_sum - 4.0, 1.0)
    normal_matrix = columns.T @ (weights[:, None] * columns)
    try:
        position_covariance = variance / gain**2 * np.linalg.inv(normal_matrix)[:2, :2]
    except np.linalg.LinAlgError:
        return None
    model = gain * columns[:, 2]
    mean = float((weights * model).sum()) / weight_sum
    power = float((weights * (model - mean) ** 2).sum()) / weight_sum
    return TemplateAlignment(
        corner=corner,
        covariance=position_covariance + MIN_DEVIATION_PX**2 * np.eye(2),
        correlation=float(np.sqrt(power / (power + variance))),
        used=weight_sum / len(weights),
        residual_rms=float(np.sqrt(variance)),
        settled=settled,
    )


def _make_columns(template: Image, subsample: tuple[slice, slice]) -> FloatArray:
    """Return the columns (pixels, 4) of the linearised model for the subsampled pixels."""
    x_gradient = cv2.sepFilter2D(template, cv2.CV_32F, np.array([-0.5, 0, 0.5]), np.ones(1))
    y_gradient = cv2.sepFilter2D(template, cv2.CV_32F, np.ones(1), np.array([-0.5, 0, 0.5]))
    planes = (x_gradient, y_gradient, template, np.ones_like(template))
    return np.stack([plane[subsample].ravel() for plane in planes], axis=1).astype(np.float64)


def _solve(normal_matrix: FloatArray, right_side: FloatArray) -> FloatArray | None:
    try:
        return np.asarray(np.linalg.solve(normal_matrix, right_side), dtype=np.float64)
    except np.linalg.LinAlgError:
        return None


def _compute_tukey_weights(residual: FloatArray) -> FloatArray:
    scale = 1.4826 * float(np.median(np.abs(residual))) * _TUKEY_CUTOFF
    if scale == 0.0:
        return np.ones_like(residual)
    return np.asarray(np.clip(1.0 - (residual / scale) ** 2, 0.0, None) ** 2)


def _compute_keys_weights(fraction: float) -> FloatArray:
    """Return the five interpolation weights that shift an image by ``fraction`` px.

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
