"""Calibration of a stage: the affine map from its plane to the image, fitted to moves.

A fit uses k moves d (m, of the tip or the object, along the axes of the stage) and the image shifts
s (px) that they cause::

    s = A d + b + e,      A = [a₁ a₂] (2 × 2, px/m)

b is the error of the reference picture, from which all shifts are counted. The fit weights shifts
by their covariances. A first fit with the smallest sum of absolute distances identifies the
outliers, and the remaining moves are fitted by least squares. A is expressed as pixel size,
rotation, handedness and skew (angles from columns towards rows)::

    pixel size of axis i = 1/|aᵢ|,   rotation = ∠a₁,   handedness h = sign det A
    skew = h ∠(a₁, a₂) − 90°

Its covariance is that of least squares, but not smaller than the residuals indicate. The
uncertainties of the derived figures follow from it to first order. Source: P. Rousseeuw, A. Leroy,
"Robust Regression and Outlier Detection", 1987 (scale and reweighting).
"""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.errors import StageCalibrationError
from rotemina.sim.messages import format_fixed, format_rounded

MIN_MOVES = 5
# The distance of an outlier from the fit exceeds the scale of all distances by this factor. One
# good move in 450 is farther away.
_OUTLIER_SCALES = 3.5
_ITERATIONS = 30
# Smallest ratio of the smallest to the largest extent of the moves.
_MIN_EXTENT_RATIO = 0.1
# Smallest angle between the images of the two axes.
_MIN_AXIS_ANGLE_RAD = np.radians(20.0)


@dataclass(frozen=True, slots=True)
class CalibrationRequirements:
    """Requirements for a calibration.

    Attributes
    ----------
    residual_px : float
        Largest rms distance between fit and shifts.
    scale : float
        Largest relative uncertainty of a pixel size.
    outliers : float
        Largest share of shifts that do not fit.
    """

    residual_px: float = 0.5
    scale: float = 0.005
    outliers: float = 0.25


@dataclass(frozen=True, slots=True)
class StageMapGeometry:
    """A map in terms of pixel size and angles. Each uncertainty is a standard deviation.

    Attributes
    ----------
    pixel_size, pixel_size_uncertainty : (float, float)
        Pixel size along the first and the second axis, m/px.
    rotation, rotation_uncertainty : float
        Direction of the first axis in the image, rad, from columns towards rows.
    handedness : int
        1 if the axes have the same handedness as columns and rows, −1 if the image is mirrored.
    skew, skew_uncertainty : float
        Deviation of the angle between the axes from a right angle, rad.
    """

    pixel_size: tuple[float, float]
    pixel_size_uncertainty: tuple[float, float]
    rotation: float
    rotation_uncertainty: float
    handedness: int
    skew: float
    skew_uncertainty: float


@dataclass(frozen=True, slots=True, eq=False)
class StageMap:
    """Linear map from the plane of a stage to the image.

    Attributes
    ----------
    matrix : (2, 2)
        px/m, with one column for each axis of the plane.
    covariance : (4, 4)
        Covariance of the entries of the matrix, row by row, (px/m)².
    """

    matrix: FloatArray
    covariance: FloatArray

    def shift_of(self, displacement: FloatArray) -> FloatArray:
        """Return the image shifts (..., 2), px, of displacements (..., 2), m."""
        return np.asarray(displacement @ self.matrix.T)

    def displacement_of(self, pixels: FloatArray) -> FloatArray:
        """Return the displacements (..., 2), m, that shift the image by ``shift_of`` (..., 2)."""
        return np.asarray(pixels @ np.linalg.inv(self.matrix).T)

    def uncertainty_px(self, displacement: FloatArray) -> float:
        """Return the rms uncertainty, px, of the image shift of a displacement (2,), m."""
        jacobian = np.kron(np.eye(2), displacement)
        return float(np.sqrt(np.trace(jacobian @ self.covariance @ jacobian.T)))

    @property
    def geometry(self) -> StageMapGeometry:
        """The map in terms of pixel size and angles."""
        first, second = self.matrix[:, 0], self.matrix[:, 1]
        lengths = np.hypot(*first), np.hypot(*second)
        handedness = 1 if np.linalg.det(self.matrix) > 0.0 else -1
        angles = np.arctan2(first[1], first[0]), np.arctan2(second[1], second[0])
        skew = (handedness * (angles[1] - angles[0])) % (2.0 * np.pi) - 0.5 * np.pi
        # Gradients of lengths and angles with respect to a11, a12, a21, a22.
        zeros = np.zeros((2, 2))
        length_1, angle_1 = (
            np.column_stack([g, zeros[0]]).ravel() for g in _compute_polar_gradients(first)
        )
        length_2, angle_2 = (
            np.column_stack([zeros[0], g]).ravel() for g in _compute_polar_gradients(second)
        )
        size_uncertainties = tuple(
            float(self._propagate_deviation(gradient) / length**2)
            for gradient, length in ((length_1, lengths[0]), (length_2, lengths[1]))
        )
        return StageMapGeometry(
            pixel_size=(1.0 / float(lengths[0]), 1.0 / float(lengths[1])),
            pixel_size_uncertainty=(size_uncertainties[0], size_uncertainties[1]),
            rotation=float(angles[0]),
            rotation_uncertainty=self._propagate_deviation(angle_1),
            handedness=handedness,
            skew=float(skew),
            skew_uncertainty=self._propagate_deviation(angle_2 - angle_1),
        )

    def _propagate_deviation(self, gradient: FloatArray) -> float:
        return float(np.sqrt(gradient @ self.covariance @ gradient))


@dataclass(frozen=True, slots=True, eq=False)
class StageFit:
    """A fitted map with its residuals.

    Attributes
    ----------
    map : StageMap
    offset : (2,)
        Error of the reference picture, px.
    residuals : (k, 2)
        Measured shift minus fit, px, of every move.
    inliers : (k,) bool
        Which moves the fit uses; the others are outliers.
    residual_rms : float
        RMS residual distance of the inliers, px.
    """

    map: StageMap
    offset: FloatArray
    residuals: FloatArray
    inliers: BoolArray
    residual_rms: float


def fit_stage(
    displacements: FloatArray,
    shifts: FloatArray,
    covariances: FloatArray | None = None,
    requirements: CalibrationRequirements | None = None,
) -> StageFit:
    """Fit the map of a stage.

    Parameters
    ----------
    displacements : (k, 2)
        Moves from the position of the reference picture, m; commanded or measured.
    shifts : (k, 2)
        Image shifts from the registration, px.
    covariances : (k, 2, 2), optional
        Covariances of the shifts, px²; equal by default.
    requirements : CalibrationRequirements, optional

    Raises
    ------
    StageCalibrationError
        If there are too few moves, they do not span the plane, or the fit does not meet the
        requirements. The message gives the figure, its value, its bound and what to do.
    """
    requirements = CalibrationRequirements() if requirements is None else requirements
    displacement_array, shift_array = (
        np.asarray(displacements, dtype=float),
        np.asarray(shifts, dtype=float),
    )
    _check_moves(displacement_array, shift_array)
    fit = fit_robustly(displacement_array, shift_array, covariances)
    _check_fit(fit, requirements)
    return fit


def fit_robustly(
    displacements: FloatArray, shifts: FloatArray, covariances: FloatArray | None = None
) -> StageFit:
    """Fit the map without checking requirements; parameters as for :func:`fit_stage`."""
    count = len(displacements)
    shift_covariances = np.tile(np.eye(2), (count, 1, 1)) if covariances is None else covariances
    whiteners = np.linalg.inv(np.linalg.cholesky(shift_covariances))
    extent = float(np.abs(displacements).max())
    rows = np.column_stack([displacements / extent, np.ones(count)])
    # Unknowns: a11, a12, b1, a21, a22, b2; two whitened equations for every move.
    unwhitened = np.stack([np.kron(np.eye(2), row) for row in rows])
    design = whiteners @ unwhitened
    targets = np.einsum("kij,kj->ki", whiteners, shifts)
    # With given covariances the errors are normalised, so their scale should be 1 or more.
    min_scale = 0.0 if covariances is None else 1.0
    errors = np.ones(count)
    for _ in range(_ITERATIONS):
        weights = 1.0 / np.maximum(errors, 1e-3 * float(errors.max()) + 1e-12)
        errors = _compute_residual_distances(
            design, targets, _solve_weighted(design, targets, weights)
        )
    # 1.1774 is the median of a Rayleigh distribution; the last factor is Rousseeuw's correction for
    # few moves.
    scale = float(np.median(errors)) / 1.1774 * (1.0 + 5.0 / max(count - 3, 1))
    is_inlier = errors <= _OUTLIER_SCALES * max(scale, min_scale, 1e-9)
    solution = _solve_weighted(design, targets, is_inlier.astype(float))
    square_sum = float(
        (_compute_residual_distances(design, targets, solution)[is_inlier] ** 2).sum()
    )
    degrees_of_freedom = max(2.0 * np.count_nonzero(is_inlier) - 6.0, 1.0)
    inlier_rows = design[is_inlier].reshape(-1, 6)
    covariance = np.linalg.pinv(inlier_rows.T @ inlier_rows) * max(
        min_scale, square_sum / degrees_of_freedom
    )
    coefficients, matrix_indices = solution.reshape(2, 3), [0, 1, 3, 4]
    matrix, offset = coefficients[:, :2] / extent, coefficients[:, 2]
    residuals = shifts - displacements @ matrix.T - offset
    return StageFit(
        map=StageMap(matrix, covariance[np.ix_(matrix_indices, matrix_indices)] / extent**2),
        offset=offset,
        residuals=residuals,
        inliers=is_inlier,
        residual_rms=float(np.sqrt((residuals[is_inlier] ** 2).sum(axis=1).mean())),
    )


def _solve_weighted(design: FloatArray, targets: FloatArray, weights: FloatArray) -> FloatArray:
    root_weights = np.sqrt(weights)[:, None]
    rows, right_side = (
        (root_weights[..., None] * design).reshape(-1, 6),
        (root_weights * targets).ravel(),
    )
    return np.asarray(np.linalg.lstsq(rows, right_side, rcond=None)[0])


def _compute_residual_distances(
    design: FloatArray, targets: FloatArray, solution: FloatArray
) -> FloatArray:
    return np.asarray(np.linalg.norm(targets - design @ solution, axis=1))


def _check_moves(moves: FloatArray, shifts: FloatArray) -> None:
    if moves.shape != shifts.shape or moves.ndim != 2 or moves.shape[1] != 2:
        raise StageCalibrationError(
            "calibration: moves of shape {shape} against shifts of shape {shifts_shape}; both "
            "must be (moves, 2)",
            shape=str(moves.shape),
            shifts_shape=str(shifts.shape),
        )
    if len(moves) < MIN_MOVES:
        raise StageCalibrationError(
            "calibration: {n} moves, must be at least {least}; increase the number of moves",
            n=len(moves),
            least=MIN_MOVES,
        )
    if not (np.isfinite(moves).all() and np.isfinite(shifts).all()):
        raise StageCalibrationError(
            "calibration: a move or shift is not a finite number; start again"
        )
    extents = np.linalg.svd(moves - moves.mean(axis=0), compute_uv=False)
    if not extents[1] > _MIN_EXTENT_RATIO * extents[0]:
        ratio = 0.0 if extents[0] == 0.0 else extents[1] / extents[0]
        raise StageCalibrationError(
            "calibration: the moves do not span the plane: their extent across the main "
            "direction is {part} % of that along it, must be at least {least} %; move both "
            "axes",
            part=format_fixed(100.0 * ratio, 1),
            least=format_fixed(100.0 * _MIN_EXTENT_RATIO, 0),
        )


def _check_fit(fit: StageFit, requirements: CalibrationRequirements) -> None:
    outlier_share = 1.0 - float(fit.inliers.mean())
    if outlier_share > requirements.outliers:
        raise StageCalibrationError(
            "calibration: {bad} of {n} moves do not fit, must be at most {most} %; "
            "something else moved, or the tracking slipped: check the picture, and start "
            "again",
            bad=int(np.count_nonzero(~fit.inliers)),
            n=len(fit.inliers),
            most=format_fixed(100.0 * requirements.outliers, 0),
        )
    if fit.residual_rms > requirements.residual_px:
        worst_move = int(
            np.argmax(np.where(fit.inliers, np.linalg.norm(fit.residuals, axis=1), -1.0))
        )
        raise StageCalibrationError(
            "calibration: residuals of {rms} px rms (greatest at move {worst}), must be "
            "at most {most} px; backlash, drift or a loose tool: let the stage settle, "
            "home it, and start again",
            rms=format_fixed(fit.residual_rms, 2),
            worst=worst_move + 1,
            most=format_rounded(requirements.residual_px, 6),
        )
    first, second = fit.map.matrix.T
    lengths = float(np.hypot(*first)), float(np.hypot(*second))
    sine = abs(float(np.linalg.det(fit.map.matrix))) / max(lengths[0] * lengths[1], 1e-300)
    if min(lengths) == 0.0 or sine < np.sin(_MIN_AXIS_ANGLE_RAD):
        raise StageCalibrationError(
            "calibration: both axes move the picture in nearly the same "
            "direction ({angle}° apart, must be at least {least}°); one of them "
            "does not move, or moves along the view",
            angle=format_fixed(np.degrees(np.arcsin(min(sine, 1.0))), 1),
            least=format_fixed(np.degrees(_MIN_AXIS_ANGLE_RAD), 0),
        )
    geometry = fit.map.geometry
    worst_scale = max(
        uncertainty / size
        for size, uncertainty in zip(
            geometry.pixel_size, geometry.pixel_size_uncertainty, strict=True
        )
    )
    if worst_scale > requirements.scale:
        raise StageCalibrationError(
            "calibration: the pixel size is uncertain by {known} %, must be at most "
            "{asked} %; make larger or more moves",
            known=format_fixed(100.0 * worst_scale, 2),
            asked=format_rounded(100.0 * requirements.scale, 6),
        )


def _compute_polar_gradients(vector: FloatArray) -> tuple[FloatArray, FloatArray]:
    length = float(np.hypot(*vector))
    return vector / length, np.array([-vector[1], vector[0]]) / length**2
