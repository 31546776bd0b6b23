"""The outline of a cell, and the distance of a tip from its membrane.

The image is sampled along rays from a point inside the cell, where the membrane is a dark line.
Dynamic programming finds the closed path that is darkest in total (A. Amini et al., PAMI 12
(1990)). An ellipse is fitted to the path by robust least squares, and its covariance follows from
the residuals.
"""

from dataclasses import dataclass

import cv2
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import VisionError
from rotemina.sim.messages import format_fixed, format_rounded
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.registration import flatten_brightness

_RAYS = 120
# Largest change of the radius from ray to ray.
_MAX_RADIUS_CHANGE_PX = 2
# Smallest share of the light that the membrane absorbs, as a mean over the rays.
_MIN_ABSORPTION_RATIO = 0.02
# Half width of a line.
_LINE_HALF_WIDTH_PX = 2.0
# Distance from the ellipse beyond which a point has less weight.
_OUTLIER_PX = 3.0
# Largest rms distance between path and ellipse, as a share of the mean radius.
_MAX_RMS_RATIO = 0.08
# Shift of the darkest line by a bright rim, from simulated cells.
_RIM_DEVIATION_PX = 0.7
# Step of the numerical derivatives, px or rad.
_DIFFERENCE_STEP = 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class CellOutline:
    """Outline of a cell as an ellipse in the picture.

    Attributes
    ----------
    parameters : (5,)
        Column and row of the centre and the two half axes, px, and the direction of the first half
        axis, rad.
    covariance : (5, 5)
        Covariance of the parameters.
    path : (rays, 2)
        Detected points of the membrane, px.
    absorption : float
        Share of the light that the membrane absorbs.
    """

    parameters: FloatArray
    covariance: FloatArray
    path: FloatArray
    absorption: float

    @property
    def centre(self) -> FloatArray:
        """Column and row (2,), px, of the centre."""
        return self.parameters[:2]


@dataclass(frozen=True, slots=True)
class MembraneAhead:
    """Distance and angle at which the path of a tip meets the membrane.

    Attributes
    ----------
    distance, distance_uncertainty : float
        Distance along the path and its standard deviation, px; negative if the tip is inside.
    angle, angle_uncertainty : float
        Angle between path and normal of the membrane and its standard deviation, rad, 0 to π/2.
    """

    distance: float
    distance_uncertainty: float
    angle: float
    angle_uncertainty: float


def find_cell(image: Image, near: FloatArray, radii: tuple[float, float]) -> CellOutline:
    """Find the outline of the cell around a point.

    Parameters
    ----------
    image : image
    near : (2,)
        A point inside the cell, px.
    radii : (float, float)
        Smallest and largest distance of the membrane from this point, px.

    Raises
    ------
    VisionError
        If no dark line surrounds the point, or the line is not an ellipse.
    """
    low, high = radii
    if not 2.0 < low < high:
        raise VisionError(
            "cell: radii {low} to {high} px; must be more than 2 and increasing", low=low, high=high
        )
    centre = np.asarray(near, dtype=float)
    smoothed = np.asarray(
        cv2.GaussianBlur(flatten_brightness(image), (0, 0), 1.0), dtype=np.float32
    )
    # The second search starts from the centre of the first ellipse.
    for _ in range(2):
        path, absorption = _find_path(smoothed, centre, low, high)
        if absorption < _MIN_ABSORPTION_RATIO:
            raise VisionError(
                "cell: the line around {column}, {row} px absorbs {darker} % of the "
                "light, must be at least {least} %; focus on the membrane, or click into "
                "the cell",
                column=format_fixed(centre[0], 0),
                row=format_fixed(centre[1], 0),
                darker=format_fixed(100.0 * absorption, 1),
                least=format_rounded(100.0 * _MIN_ABSORPTION_RATIO, 6),
            )
        parameters, covariance, rms = _fit_ellipse(path, centre)
        centre = parameters[:2]
    if rms > _MAX_RMS_RATIO * float(parameters[2:4].mean()):
        raise VisionError(
            "cell: the outline deviates from an ellipse by {rms} px rms, must be at most "
            "{most} % of its radius; click into the middle of one cell",
            rms=format_fixed(rms, 1),
            most=format_rounded(100.0 * _MAX_RMS_RATIO, 6),
        )
    return CellOutline(parameters, covariance, path, absorption)


def find_membrane_ahead(
    cell: CellOutline, tip: FloatArray, tip_covariance: FloatArray, direction: float
) -> MembraneAhead | None:
    """Return where a tip that moves from ``tip`` (2,), px, in ``direction``, rad, meets the cell.

    Return None if the path misses the cell or leads away from it. Uncertainties are propagated to
    first order.
    """
    values = np.concatenate([cell.parameters, tip])
    nominal = _intersect_ellipse(values, direction)
    if nominal is None:
        return None
    covariance = np.zeros((7, 7))
    covariance[:5, :5], covariance[5:, 5:] = cell.covariance, tip_covariance
    gradient_rows = []
    for index in range(7):
        step = np.zeros(7)
        step[index] = _DIFFERENCE_STEP
        upper, lower = (
            _intersect_ellipse(values + step, direction),
            _intersect_ellipse(values - step, direction),
        )
        if upper is None or lower is None:
            # The path nearly misses the cell, so the derivatives do not exist.
            return MembraneAhead(nominal[0], float("inf"), nominal[1], float("inf"))
        gradient_rows.append((np.array(upper) - np.array(lower)) / (2.0 * _DIFFERENCE_STEP))
    gradients = np.array(gradient_rows).T
    deviations = np.sqrt(np.diag(gradients @ covariance @ gradients.T))
    return MembraneAhead(nominal[0], float(deviations[0]), nominal[1], float(deviations[1]))


def _intersect_ellipse(values: FloatArray, direction: float) -> tuple[float, float] | None:
    """Return distance and angle for the ellipse and tip in ``values`` (7,)."""
    centre, axes, tilt, tip = values[:2], values[2:4], values[4], values[5:]
    c, s = np.cos(tilt), np.sin(tilt)
    # Rotation into the axes of the ellipse.
    rotation = np.array([[c, s], [-s, c]])
    relative_tip = rotation @ (tip - centre) / axes
    unit_direction = np.array([np.cos(direction), np.sin(direction)])
    relative_direction = rotation @ unit_direction / axes
    a, b, k = (
        relative_direction @ relative_direction,
        relative_tip @ relative_direction,
        relative_tip @ relative_tip - 1.0,
    )
    discriminant = b * b - a * k
    if discriminant <= 0.0:
        return None
    distance = float((-b - np.sqrt(discriminant)) / a)
    if k > 0.0 and distance < 0.0:
        # The tip is outside, and the cell is behind it.
        return None
    normal = rotation.T @ ((relative_tip + distance * relative_direction) / axes)
    cosine = abs(float(unit_direction @ normal)) / float(np.linalg.norm(normal))
    return distance, float(np.arccos(min(cosine, 1.0)))


def _find_path(
    smoothed: Image, centre: FloatArray, low: float, high: float
) -> tuple[FloatArray, float]:
    """Return the darkest closed line (rays, 2), px, and its absorption.

    The absorption is the mean difference between the surroundings and the line.
    """
    angles = np.linspace(0.0, 2.0 * np.pi, _RAYS, endpoint=False)
    radius = np.arange(low, high + 0.5)
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    points = (centre + radius[None, :, None] * directions[:, None]).astype(np.float32)
    samples = cv2.remap(
        smoothed, points[..., 0], points[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    surroundings = cv2.GaussianBlur(samples, (0, 0), sigmaX=3.0 * _LINE_HALF_WIDTH_PX, sigmaY=0.5)
    line = cv2.GaussianBlur(samples, (0, 0), sigmaX=0.5 * _LINE_HALF_WIDTH_PX, sigmaY=0.5)
    line_contrast = np.asarray(surroundings - line, dtype=np.float64)
    columns = _find_closed_path(line_contrast)
    rows = np.arange(_RAYS)
    inner_columns = np.clip(columns, 1, len(radius) - 2)
    left, middle, right = (line_contrast[rows, inner_columns + k] for k in (-1, 0, 1))
    curvature = left - 2.0 * middle + right
    fraction = np.where(
        curvature < 0.0, 0.5 * (left - right) / np.where(curvature < 0.0, curvature, -1.0), 0.0
    )
    exact_radius = radius[inner_columns] + np.clip(fraction, -0.5, 0.5)
    return centre + exact_radius[:, None] * directions, float(line_contrast[rows, columns].mean())


def _find_closed_path(gain: FloatArray) -> np.ndarray:
    """Return the columns (rays,) of the closed path with the largest total gain."""
    start = _find_best_path(gain, None)[len(gain) // 2]
    # The middle of the open path is most reliable, so the closed path begins and ends there.
    rolled = np.roll(gain, -(len(gain) // 2), axis=0)
    return np.roll(_find_best_path(rolled, int(start)), len(gain) // 2)


def _find_best_path(gain: FloatArray, ends: int | None) -> np.ndarray:
    """Return the columns (rays,) of the path with the largest total gain.

    If ``ends`` is given, the path begins in this column and ends next to it.
    """
    rays, columns = gain.shape
    total = gain[0].copy()
    if ends is not None:
        total[np.abs(np.arange(columns) - ends) > 0] = -np.inf
    previous_columns = np.zeros((rays, columns), dtype=int)
    moves = range(-_MAX_RADIUS_CHANGE_PX, _MAX_RADIUS_CHANGE_PX + 1)
    for ray in range(1, rays):
        padded = np.pad(total, _MAX_RADIUS_CHANGE_PX, constant_values=-np.inf)
        options = np.stack(
            [padded[_MAX_RADIUS_CHANGE_PX + m : _MAX_RADIUS_CHANGE_PX + m + columns] for m in moves]
        )
        best_move = options.argmax(axis=0)
        previous_columns[ray] = np.clip(
            np.arange(columns) + best_move - _MAX_RADIUS_CHANGE_PX, 0, columns - 1
        )
        total = options.max(axis=0) + gain[ray]
    if ends is not None:
        total[np.abs(np.arange(columns) - ends) > _MAX_RADIUS_CHANGE_PX] = -np.inf
    path = np.empty(rays, dtype=int)
    path[-1] = int(np.argmax(total))
    for ray in range(rays - 1, 0, -1):
        path[ray - 1] = previous_columns[ray, path[ray]]
    return path


def _fit_ellipse(path: FloatArray, centre: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return the ellipse (5,), its covariance (5, 5) and the rms distance of the path from it."""
    radius = float(np.linalg.norm(path - centre, axis=1).mean())

    def compute_distances(values: FloatArray) -> FloatArray:
        c, s = np.cos(values[4]), np.sin(values[4])
        x, y = (path - values[:2]).T
        rotated = np.stack([c * x + s * y, c * y - s * x])
        radius_ratio = np.linalg.norm(rotated / values[2:4, None], axis=0)
        # Sampson's distance: the difference of the ratio from 1, divided by its gradient.
        slope = np.linalg.norm(rotated / values[2:4, None] ** 2, axis=0) / np.maximum(
            radius_ratio, 1e-9
        )
        return np.asarray((radius_ratio - 1.0) / np.maximum(slope, 1e-9))

    start = np.array([*centre, 1.05 * radius, 0.95 * radius, 0.0])
    best_fit = min(
        (
            scipy.optimize.least_squares(
                compute_distances, np.array([*start[:4], tilt]), loss="soft_l1", f_scale=_OUTLIER_PX
            )
            for tilt in (0.0, np.pi / 2)
        ),
        key=lambda fit: float(fit.cost),
    )
    parameters = _order_half_axes(np.asarray(best_fit.x, dtype=np.float64))
    residual = compute_distances(np.asarray(best_fit.x))
    scale = 1.4826 * float(np.median(np.abs(residual)))
    jacobian = np.asarray(best_fit.jac)
    # Neighbouring rays sample the same pixels: only about every third one is independent.
    covariance = 3.0 * scale**2 * np.linalg.pinv(jacobian.T @ jacobian)
    covariance[[2, 3], [2, 3]] += _RIM_DEVIATION_PX**2
    if parameters[2] != best_fit.x[2]:
        swap = [0, 1, 3, 2, 4]
        covariance = covariance[np.ix_(swap, swap)]
    return parameters, covariance, float(np.sqrt((residual**2).mean()))


def _order_half_axes(values: FloatArray) -> FloatArray:
    """Return the parameters with the long half axis first, pointing to the right."""
    column, row, first, second, tilt = values
    first, second = abs(first), abs(second)
    if first < second:
        first, second, tilt = second, first, tilt + np.pi / 2
    tilt = (tilt + np.pi / 2) % np.pi - np.pi / 2
    return np.array([column, row, first, second, tilt])
