"""Fit of a tip to the pixels around it: position, depth and their uncertainties.

The model of :mod:`rotemina.sim.vision.pipette` is fitted by least squares. Position and depth are
found by repeated linearisation, together with the contrasts of body and bore and a background of
second order. Tukey's weights leave out objects that the model does not contain, such as a membrane
or a nucleus that crosses the pipette. The covariance is σ² (JᵀJ)⁻¹ of the weighted pixels plus a
contribution of an uneven background.
"""

from dataclasses import dataclass, replace
from math import hypot

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.pipette import Pipette

# Half width, in focus, of the part of the image that is fitted.
MIN_HALF_WIDTH_PX = 26
# Growth of this half width per growth of the blur.
_HALF_WIDTH_BLUR_RATIO = 3.0
_MAX_HALF_WIDTH_PX = 90
# Ratio of the cut-off of Tukey's weights to the scale of the residuals; 95 % efficient for normal
# noise.
_TUKEY_CUTOFF = 4.685
_MAX_ITERATIONS = 12
# The fit has converged if its last step is smaller than this.
_SETTLED_PX = 0.02
# A fit is rejected if its last step is larger than this.
_MAX_FINAL_STEP_PX = 0.2
_MAX_STEP_PX = 4.0
_MAX_TURN_RAD = 0.1
# Largest relative change of the blur in one step.
_MAX_BLUR_CHANGE_RATIO = 0.5
# Rows of a drawn pipette that are its derivatives by depth and by direction.
_DEPTH_ROW, _DIRECTION_ROW = 4, 5
# Indices of the coefficients, counted from that of the body.
_BORE_OFFSET, _POSITION_OFFSET, _DEPTH_OFFSET = 1, 2, 4
# Standard deviation of the change of the contrast from its previous value, relative to that value.
_CONTRAST_DEVIATION_RATIO = 0.1
# Standard deviation of the shade that a dimple causes.
_DIMPLE_SIGMA_PX = 15.0
# Standard deviation of the contrast of the bore, relative to that of the body.
_BORE_DEVIATION_RATIO = 0.15
# Uncertainties that dust and uneven light of 1 % cause even without noise. That of the position,
# 1/px, is multiplied by the square of the blur; it was measured on simulated frames. That of the
# depth is a share of the distance from focus.
MIN_PLACE_DEVIATION = 0.01
MIN_DEPTH_DEVIATION_RATIO = 0.03


#: Prior of a coefficient: its index, its weight and its expected value.
CoefficientPrior = tuple[int, float, float]


@dataclass(frozen=True, slots=True)
class TipDepth:
    """Distance of the tip from focus.

    Attributes
    ----------
    distance : float
        Distance, m; positive if the body leads away from focus. If ``sign_known`` is False, the
        sign may equally well be the opposite.
    uncertainty : float
        Standard deviation, m.
    sign_known : bool
    """

    distance: float
    uncertainty: float
    sign_known: bool


@dataclass(frozen=True, slots=True, eq=False)
class TipFit:
    """A fitted tip.

    Attributes
    ----------
    pixel : (2,)
        Column and row, px.
    covariance : (2, 2)
        Covariance of ``pixel``, px².
    depth : TipDepth
    direction : float
        Direction of the body, rad.
    contrast : float
        Change of the light by the wall, as a share of the background; negative if darker.
    significance : float
        Ratio of the contrast to its standard deviation.
    used : float
        Share of the pixels with weight.
    noise : float
        RMS residual of the weighted pixels, in the units of the image.
    squares : float
        Sum of weighted squares relative to the variance of the noise, to compare fits to the same
        pixels.
    """

    pixel: FloatArray
    covariance: FloatArray
    depth: TipDepth
    direction: float
    contrast: float
    significance: float
    used: float
    noise: float
    squares: float

    @property
    def uncertainty_px(self) -> float:
        """Standard deviation along the least certain direction."""
        return float(np.sqrt(np.linalg.eigvalsh(self.covariance)[-1]))


def fit_tip(
    image: Image,
    pipette: Pipette,
    start: FloatArray,
    depth: float = 0.0,
    *,
    turning: bool = False,
    position_iterations: int = 2,
    half: int | None = None,
    dimple: bool = False,
    contrast: float | None = None,
) -> TipFit | None:
    """Fit the tip near a start position and depth; return None if no tip fits.

    Parameters
    ----------
    image : image
    pipette : Pipette
    start : (2,)
        Estimate of the position, within one or two px.
    depth : float
        Estimate of the depth, m.
    turning : bool
        Whether to fit the direction too.
    placed : int
        Number of first iterations that fit only the position, because a misplaced tip looks like
        a blurred one.
    half : int, optional
        Half width of the examined part of the image, px. By default it follows from the blur.
    dimple : bool
        Whether to fit a shade around the tip, as a pressed-in membrane causes. If there is no such
        shade, this costs precision far from focus.
    contrast : float, optional
        Previous contrast, a share of the light. The fitted one stays close to it.
    """
    half = half_width(pipette, depth) if half is None else half
    corner = np.rint(start).astype(int) - half
    low, high = np.maximum(corner, 0), np.minimum(corner + 2 * half + 1, image.shape[::-1])
    if (high - low < half).any():
        return None
    part = image[low[1] : high[1], low[0] : high[0]]
    stride = max(1, half // MIN_HALF_WIDTH_PX)
    fitting = _TipFitting(part, stride, pipette, turning, position_iterations, dimple, contrast)
    return fitting.run(start - low, depth, low.astype(float))


def half_width(pipette: Pipette, depth: float) -> int:
    """Return the half width, px, of the examined part around a tip at a depth, m."""
    wider = _HALF_WIDTH_BLUR_RATIO * float(pipette.blur_at(depth) - pipette.sharpest)
    return min(round(MIN_HALF_WIDTH_PX + wider), _MAX_HALF_WIDTH_PX)


class _TipFitting:
    """One fit: its pixels and its free coefficients.

    The coefficients are, in this order: six of the background (of second order), the shade of the
    dimple if it is fitted, the contrast of the body, the deviation of the bore, and the changes of
    column, row, depth and direction. Depth and direction are left out if they are fixed.
    """

    def __init__(
        self,
        part: Image,
        stride: int,
        pipette: Pipette,
        turning: bool,
        position_iterations: int,
        dimple: bool,
        contrast: float | None,
    ) -> None:
        # In a strongly blurred image, averages contain as much information as single pixels.
        self.pixels = average_squares(part, stride)
        self.stride, self.pipette, self.position_iterations = stride, pipette, position_iterations
        self.dimple, self.contrast = dimple, contrast
        self.max_shift_px = 0.5 * max(part.shape)
        y, x = np.meshgrid(*(np.linspace(-1.0, 1.0, n) for n in self.pixels.shape), indexing="ij")
        self.background = background_terms(x.ravel(), y.ravel())
        # Index of the first coefficient of the body.
        self.body_index = len(self.background) + dimple
        # Rows of the drawn pipette that are its derivatives by the free parameters: column and row
        # of the tip, then depth and direction.
        free_rows = [2, 3]
        if pipette.defocus > 0.0:
            free_rows.append(_DEPTH_ROW)
        if turning:
            free_rows.append(_DIRECTION_ROW)
        self.free_rows = free_rows

    def run(self, start: FloatArray, depth: float, low: FloatArray) -> TipFit | None:
        """Iterate from ``start`` (2,), px, in the part of the image that begins at ``low``."""
        # Offset from the first of the averaged pixels to their centre.
        centre_offset = 0.5 * (self.stride - 1)
        position, pipette, target = start - centre_offset, self.pipette, self.pixels.ravel()
        weights, variance, contrast, brightness = np.ones(target.size), 0.0, 0.0, 0.0
        is_settled, iteration, depth_step = False, 0, 0.0
        while iteration < _MAX_ITERATIONS and not is_settled:
            background = self.background
            if self.dimple:
                background = np.vstack([background, self._make_dimple_shade(position)])
            pipette_rows = pipette.draw(position, depth, self.pixels.shape, self.stride)
            pipette_rows = pipette_rows.reshape(6, -1)
            if iteration == 0:
                start_coefficients = least_squares(
                    np.vstack([background, pipette_rows[:1]]), target, weights
                )
                if start_coefficients is None:
                    return None
                contrast, brightness = (
                    float(start_coefficients[self.body_index]),
                    float(start_coefficients[0]),
                )
            free_rows = (
                self.free_rows if iteration >= self.position_iterations else self.free_rows[:2]
            )
            rows = np.vstack([background, pipette_rows[:2], contrast * pipette_rows[free_rows]])
            ties = self._make_ties(contrast, brightness, variance)
            solution = least_squares(rows, target, weights, ties)
            if solution is None:
                return None
            coefficients = solution
            changes = dict(
                zip(free_rows, coefficients[self.body_index + _POSITION_OFFSET :], strict=True)
            )
            step = np.clip(
                coefficients[self.body_index + _POSITION_OFFSET : self.body_index + _DEPTH_OFFSET],
                -_MAX_STEP_PX,
                _MAX_STEP_PX,
            )
            position, contrast, brightness = (
                position + step,
                float(coefficients[self.body_index]),
                float(coefficients[0]),
            )
            if iteration >= self.position_iterations:
                depth_step = self._limit_depth_step(changes.get(_DEPTH_ROW, 0.0), depth)
                depth += depth_step
            turn_step = float(
                np.clip(changes.get(_DIRECTION_ROW, 0.0), -_MAX_TURN_RAD, _MAX_TURN_RAD)
            )
            pipette = replace(pipette, direction=pipette.direction + turn_step)
            if np.abs(position - start).max() > self.max_shift_px:
                return None
            residual = target - coefficients @ rows
            if iteration >= self.position_iterations:
                weights = tukey_weights(residual)
            variance = float((weights * residual**2).sum()) / float(weights.sum())
            iteration += 1
            last_step_px = max(float(np.abs(step).max()), abs(depth_step) * self.pipette.defocus)
            is_settled = last_step_px < _SETTLED_PX and iteration > self.position_iterations + 1
        if not is_settled and float(np.abs(step).max()) > _MAX_FINAL_STEP_PX:
            return None
        return self._make_fit(
            rows, residual, weights, coefficients, position + low + centre_offset, depth, pipette
        )

    def _make_dimple_shade(self, position: FloatArray) -> FloatArray:
        rows, columns = self.pixels.shape
        width = np.sqrt(0.5) * _DIMPLE_SIGMA_PX / self.stride
        column_profile = np.exp(
            -(((np.arange(columns) - position[0] / self.stride) / width / 2.0) ** 2)
        )
        row_profile = np.exp(-(((np.arange(rows) - position[1] / self.stride) / width / 2.0) ** 2))
        return np.asarray(np.outer(row_profile, column_profile).ravel())

    def _make_ties(
        self, contrast: float, brightness: float, variance: float
    ) -> tuple[CoefficientPrior, ...]:
        ties = []
        if contrast:
            ties.append(
                (
                    self.body_index + _BORE_OFFSET,
                    variance / (_BORE_DEVIATION_RATIO * contrast) ** 2,
                    0.0,
                )
            )
        if self.contrast is not None and brightness:
            expected = self.contrast * brightness
            ties.append(
                (self.body_index, variance / (_CONTRAST_DEVIATION_RATIO * expected) ** 2, expected)
            )
        return tuple(ties)

    def _limit_depth_step(self, change: float, depth: float) -> float:
        """Limit a step of the depth, so that the blur changes by at most a given share."""
        limit = (
            _MAX_BLUR_CHANGE_RATIO
            * float(self.pipette.blur_at(depth))
            / max(self.pipette.defocus, 1e-300)
        )
        return float(np.clip(change, -limit, limit))

    def _make_fit(
        self,
        rows: FloatArray,
        residual: FloatArray,
        weights: FloatArray,
        coefficients: FloatArray,
        pixel: FloatArray,
        depth: float,
        pipette: Pipette,
    ) -> TipFit | None:
        weight_sum = float(weights.sum())
        variance = float((weights * residual**2).sum()) / max(weight_sum - len(rows), 1.0)
        normal_matrix, body = np.empty((len(rows), len(rows))), self.body_index
        _fill_normal_equations(
            np.ascontiguousarray(rows), residual, weights, normal_matrix, np.empty(len(rows))
        )
        for index, weight, _ in self._make_ties(
            float(coefficients[body]), float(coefficients[0]), variance
        ):
            normal_matrix[index, index] += weight
        try:
            covariance = variance * np.linalg.inv(normal_matrix)
        except np.linalg.LinAlgError:
            return None
        min_deviation = MIN_PLACE_DEVIATION * float(pipette.blur_at(depth)) ** 2
        depth_deviation = float("inf")
        if _DEPTH_ROW in self.free_rows:
            depth_deviation = hypot(
                float(np.sqrt(covariance[body + _DEPTH_OFFSET, body + _DEPTH_OFFSET])),
                MIN_DEPTH_DEVIATION_RATIO * depth,
            )
        return TipFit(
            pixel=pixel,
            covariance=covariance[
                body + _POSITION_OFFSET : body + _DEPTH_OFFSET,
                body + _POSITION_OFFSET : body + _DEPTH_OFFSET,
            ]
            + 0.5 * min_deviation**2 * np.eye(2),
            depth=TipDepth(depth, depth_deviation, sign_known=False),
            direction=pipette.direction,
            contrast=float(coefficients[self.body_index] / max(abs(coefficients[0]), 1e-12)),
            significance=float(
                abs(coefficients[self.body_index]) / np.sqrt(covariance[body, body])
            ),
            used=weight_sum / weights.size,
            noise=float(np.sqrt(variance)),
            squares=weight_sum,
        )


def average_squares(part: Image, stride: int) -> FloatArray:
    """Return the means (rows, columns) of squares with ``stride`` pixels along each side."""
    rows, columns = part.shape[0] // stride, part.shape[1] // stride
    cells = part[: rows * stride, : columns * stride].reshape(rows, stride, columns, stride)
    return np.asarray(cells.mean(axis=(1, 3), dtype=np.float64))


def background_terms(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the terms (6, pixels) of a second-order background at coordinates (pixels,)."""
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y])


def least_squares(
    rows: FloatArray,
    target: FloatArray,
    weights: FloatArray,
    ties: tuple[CoefficientPrior, ...] = (),
) -> FloatArray | None:
    """Return the coefficients (k,) of functions (k, pixels) that fit ``target`` best."""
    normal_matrix, right_side = np.empty((len(rows), len(rows))), np.empty(len(rows))
    _fill_normal_equations(np.ascontiguousarray(rows), target, weights, normal_matrix, right_side)
    for index, weight, value in ties:
        normal_matrix[index, index] += weight
        right_side[index] += weight * value
    try:
        return np.asarray(np.linalg.solve(normal_matrix, right_side))
    except np.linalg.LinAlgError:
        return None


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def _fill_normal_equations(
    rows: FloatArray, target: FloatArray, weights: FloatArray, normal: FloatArray, right: FloatArray
) -> None:
    """Fill in the normal equations.

    It is compiled, because for so few rows the threads of BLAS would mostly wait.

    Parameters
    ----------
    rows : (k, pixels)
    target, weights : (pixels,)
    normal, right : (k, k), (k,)
        The output arrays.
    """
    for i in range(len(rows)):
        weighted_row = weights * rows[i]
        total = 0.0
        for n in range(len(target)):
            total += weighted_row[n] * target[n]
        right[i] = total
        for j in range(i + 1):
            total = 0.0
            for n in range(len(target)):
                total += weighted_row[n] * rows[j, n]
            normal[i, j] = normal[j, i] = total


def tukey_weights(residual: FloatArray) -> FloatArray:
    """Return Tukey's weights (pixels,) of residuals, which are 0 for outliers."""
    scale = max(1.4826 * float(np.median(np.abs(residual))), 1e-9) * _TUKEY_CUTOFF
    return np.asarray(np.clip(1.0 - (residual / scale) ** 2, 0.0, None) ** 2)
