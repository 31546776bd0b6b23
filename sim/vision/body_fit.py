"""Position of a tip from its body alone, while the membrane that it presses on hides the end.

Across the body, both edges give the position. Along the body, the half width ``h = r + t l`` gives
it (:mod:`rotemina.sim.vision.pipette`): with a taper of 7 %, an edge that is known to 0.01 px gives
the position to 0.15 px. A disc around the tip, where the membrane is indented, is left out. The
result depends strongly on the light that the body absorbs, so this contrast is held close to its
previous value.
"""

from dataclasses import dataclass, replace
from math import hypot
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.image import Image, divide_by_background
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.tip_fit import (
    MIN_DEPTH_DEVIATION_RATIO,
    TipDepth,
    TipFit,
    average_squares,
    background_terms,
    least_squares,
    tukey_weights,
)

# The examined part of the body has the following size at this indentation radius.
_BASE_SOFT_RADIUS_PX = 45.0
_BASE_AHEAD_PX, _BASE_HALF_PX, _BASE_STRIDE_PX = 140.0, 150.0, 6.0
_MAX_ITERATIONS = 6
_SETTLED_PX, _MAX_FINAL_STEP_PX = 0.03, 0.3
_MAX_STEP_PX = 4.0
_MAX_TURN_RAD = 0.05
# Largest relative change of the blur in one step.
_MAX_BLUR_CHANGE_RATIO = 0.5
# Standard deviations of the contrasts of body and bore, relative to the contrast: once learnt, and
# while learning.
_LEARNT_DEVIATIONS, _LEARNING_DEVIATIONS = (0.01, 0.05), (0.3, 0.05)
# Indices of the coefficients.
_BODY_INDEX, _BORE_INDEX, _POSITION_INDEX, _DEPTH_INDEX = 6, 7, 8, 10
# Smallest share of the part that must be in the picture.
_MIN_VISIBLE_RATIO = 0.3


@dataclass(frozen=True, slots=True)
class BodyPart:
    """The examined square part of the body. It grows with the indentation radius.

    Attributes
    ----------
    ahead : float
        Distance of its centre from the tip along the body, px.
    half : int
        Half its side, px.
    stride : int
        Side of the squares that are averaged, px.
    """

    ahead: float
    half: int
    stride: int

    @classmethod
    def of(cls, pipette: Pipette) -> Self:
        """Return the part for a pipette."""
        scale = max(pipette.indentation_radius / _BASE_SOFT_RADIUS_PX, 1.0)
        return cls(
            _BASE_AHEAD_PX * scale, round(_BASE_HALF_PX * scale), round(_BASE_STRIDE_PX * scale)
        )


def fit_body(
    image: NDArray[Any],
    pipette: Pipette,
    start: FloatArray,
    depth: float,
    contrast: float,
    background: Image | None = None,
    *,
    learning: bool = False,
) -> TipFit | None:
    """Fit the tip from the part of its body; return None if no tip fits.

    Parameters
    ----------
    image : (rows, columns)
        Image of any numeric type. Only the part around the body is examined.
    pipette : Pipette
    start : (2,)
        Estimate of the position, within a few px.
    depth : float
        Estimate of the depth, m.
    contrast : float
        Previous contrast of the body, a share of the light, negative.
    background : (rows, columns), optional
        The same view without the tip.
    learning : bool
        Whether to fit direction and contrast of the body too. The tip must not press on anything.
    """
    direction = np.array([np.cos(pipette.direction), np.sin(pipette.direction)])
    body_part = BodyPart.of(pipette)
    corner = np.rint(start + body_part.ahead * direction).astype(int) - body_part.half
    low = np.maximum(corner, 0)
    high = np.minimum(corner + 2 * body_part.half + 1, image.shape[::-1])
    if (high - low < body_part.stride).any() or np.prod(high - low) < _MIN_VISIBLE_RATIO * (
        2 * body_part.half
    ) ** 2:
        return None
    window = slice(low[1], high[1]), slice(low[0], high[0])
    pixels = np.asarray(image[window], dtype=np.float32)
    if background is not None:
        pixels = divide_by_background(pixels, background[window])
    position = np.asarray(start, dtype=np.float64) - low
    blind_radius = 0.0 if learning else pipette.indentation_radius
    fitting = _BodyFitting(
        average_squares(pixels, body_part.stride), position, body_part.stride, blind_radius
    )
    if not fitting.iterate(pipette, depth, contrast):
        return None
    return fitting.make_result(low)


class _BodyFitting:
    """One fit: averaged pixels, without those in a disc around the tip, where the fit is blind.

    The coefficients are six of the background (of second order), those of body and bore, and the
    changes of column, row, depth and, only while learning, direction.
    """

    def __init__(
        self, pixels: FloatArray, start: FloatArray, stride: int, blind_radius: float
    ) -> None:
        self.shape, self.target, self.learning = pixels.shape, pixels.ravel(), not blind_radius
        # ``centre_offset`` is the offset from the first of the averaged pixels to their centre.
        self.stride, self.centre_offset = stride, 0.5 * (stride - 1)
        self.position = start - self.centre_offset
        rows, columns = np.indices(pixels.shape, dtype=np.float64)
        distance = np.hypot(stride * columns - self.position[0], stride * rows - self.position[1])
        self.pixel_mask = (distance >= blind_radius).ravel().astype(np.float64)
        x, y = 2.0 * columns / pixels.shape[1] - 1.0, 2.0 * rows / pixels.shape[0] - 1.0
        self.background = background_terms(x.ravel(), y.ravel())
        self.brightness, self.variance, self.weights = (
            float(np.median(pixels)),
            0.0,
            self.pixel_mask,
        )

    def iterate(self, pipette: Pipette, depth: float, contrast: float) -> bool:
        """Iterate and return whether the fit has converged."""
        self.pipette, self.depth = pipette, depth
        step_px = np.inf
        for iteration in range(_MAX_ITERATIONS):
            coefficients = self._solve(contrast)
            if coefficients is None:
                return False
            step_px = self._apply_changes(coefficients)
            self.weights = self.pixel_mask * tukey_weights(self.residual)
            weight_sum = max(float(self.weights.sum()), 1.0)
            self.variance = float((self.weights * self.residual**2).sum()) / weight_sum
            if iteration > 0 and step_px < _SETTLED_PX:
                break
        return step_px < _MAX_FINAL_STEP_PX

    def make_result(self, low: FloatArray) -> TipFit | None:
        """Return the fit of a part of the image that begins at ``low`` (2,), px."""
        normal_matrix = (self.rows * self.weights) @ self.rows.T
        for index, weight, _ in self.priors:
            normal_matrix[index, index] += weight
        try:
            covariance = self.variance * np.linalg.inv(normal_matrix)
        except np.linalg.LinAlgError:
            return None
        depth_deviation = hypot(
            float(np.sqrt(covariance[_DEPTH_INDEX, _DEPTH_INDEX])),
            MIN_DEPTH_DEVIATION_RATIO * self.depth,
        )
        body, weight_sum = float(self.coefficients[_BODY_INDEX]), float(self.weights.sum())
        return TipFit(
            pixel=self.position + low + self.centre_offset,
            covariance=covariance[_POSITION_INDEX:_DEPTH_INDEX, _POSITION_INDEX:_DEPTH_INDEX],
            depth=TipDepth(self.depth, depth_deviation, sign_known=False),
            direction=self.pipette.direction,
            contrast=body / max(abs(self.brightness), 1e-12),
            significance=abs(body) / float(np.sqrt(covariance[_BODY_INDEX, _BODY_INDEX])),
            used=weight_sum / max(float(self.pixel_mask.sum()), 1.0),
            noise=float(np.sqrt(self.variance)),
            squares=weight_sum,
        )

    def _solve(self, contrast: float) -> FloatArray | None:
        pipette_rows = self.pipette.draw(
            self.position, self.depth, self.shape, self.stride
        ).reshape(6, -1)
        expected_contrast, row_end = contrast * self.brightness, 6 if self.learning else 5
        deviations = _LEARNING_DEVIATIONS if self.learning else _LEARNT_DEVIATIONS
        self.rows = np.vstack(
            [self.background, pipette_rows[:2], expected_contrast * pipette_rows[2:row_end]]
        )
        self.priors = (
            (
                _BODY_INDEX,
                self.variance / (deviations[0] * expected_contrast) ** 2,
                expected_contrast,
            ),
            (_BORE_INDEX, self.variance / (deviations[1] * expected_contrast) ** 2, 0.0),
        )
        coefficients = least_squares(self.rows, self.target, self.weights, self.priors)
        if coefficients is not None:
            self.coefficients, self.residual = coefficients, self.target - coefficients @ self.rows
        return coefficients

    def _apply_changes(self, coefficients: FloatArray) -> float:
        step = np.clip(coefficients[_POSITION_INDEX:_DEPTH_INDEX], -_MAX_STEP_PX, _MAX_STEP_PX)
        limit = _MAX_BLUR_CHANGE_RATIO * float(self.pipette.blur_at(self.depth))
        limit /= max(self.pipette.defocus, 1e-300)
        depth_step = float(np.clip(coefficients[_DEPTH_INDEX], -limit, limit))
        self.position, self.depth = self.position + step, self.depth + depth_step
        self.brightness = float(coefficients[0])
        if self.learning:
            turn_step = float(
                np.clip(coefficients[_DEPTH_INDEX + 1], -_MAX_TURN_RAD, _MAX_TURN_RAD)
            )
            self.pipette = replace(self.pipette, direction=self.pipette.direction + turn_step)
        return max(float(np.abs(step).max()), abs(depth_step) * self.pipette.defocus)
