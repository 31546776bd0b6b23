"""The affine map from a stage's plane to the image, fitted to moves and the shifts they caused.

Of k moves d (m, of the tip or the object, by the stage's own axes) and their image shifts s (px)::

    s = A d + b + e,      A = [a₁ a₂] (2 × 2, px/m)

b is the error of the picture that all shifts are counted from. The fit weighs shifts by their
covariances; what is far off a fit by least distances is left out, the rest fitted by squares.
A is told as pixel size, rotation, handedness and skew (angles from columns towards rows)::

    pixel size of axis i = 1/|aᵢ|,   rotation = ∠a₁,   handedness h = sign det A
    skew = h ∠(a₁, a₂) − 90°

Its covariance is that of least squares, never smaller than what the residuals say; the figures'
follow from it to first order. Source: P. Rousseeuw, A. Leroy, "Robust Regression and Outlier
Detection", 1987 (scale and reweighting).
"""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed, rounded
from rotemina.sim.vision.errors import CalibrationError

LEAST_MOVES = 5
_FAR = 3.5  # scales off the fit: one good move in 450 is
_TURNS = 30
_LEAST_SPREAD = 0.1  # of the smallest extent of the moves to the greatest
_LEAST_ANGLE = np.radians(20.0)  # between the images of the two axes


@dataclass(frozen=True, slots=True)
class Demands:
    """What a calibration must come up to.

    Attributes
    ----------
    residual_px : float
        Greatest rms distance between fit and shifts.
    scale : float
        Greatest relative uncertainty of a pixel size.
    outliers : float
        Greatest share of shifts that do not fit.
    """

    residual_px: float = 0.5
    scale: float = 0.005
    outliers: float = 0.25


@dataclass(frozen=True, slots=True)
class Geometry:
    """A map in terms of optics; each uncertainty is a standard deviation.

    Attributes
    ----------
    pixel_size, pixel_size_uncertainty : (float, float)
        Of the first and the second axis, m/px.
    rotation, rotation_uncertainty : float
        Where the first axis points in the image, rad, from columns towards rows.
    handedness : int
        1 if the second axis follows the first as rows follow columns, −1 if it is mirrored.
    skew, skew_uncertainty : float
        By how much the second axis is off the right angle, rad.
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
    """How a stage's plane lies in the image.

    Attributes
    ----------
    matrix : (2, 2)
        px/m; a column for each axis of the plane.
    covariance : (4, 4)
        Of the matrix, row after row, (px/m)².
    """

    matrix: FloatArray
    covariance: FloatArray

    def pixels(self, displacement: FloatArray) -> FloatArray:
        """Return the image shifts (..., 2), px, of displacements (..., 2), m."""
        return np.asarray(displacement @ self.matrix.T)

    def displacement(self, pixels: FloatArray) -> FloatArray:
        """Return the displacements (..., 2), m, that shift the image by ``pixels`` (..., 2)."""
        return np.asarray(pixels @ np.linalg.inv(self.matrix).T)

    def uncertainty_px(self, displacement: FloatArray) -> float:
        """Return by how much the image shift of a displacement (2,), m, may be off, px rms."""
        jacobian = np.kron(np.eye(2), displacement)
        return float(np.sqrt(np.trace(jacobian @ self.covariance @ jacobian.T)))

    @property
    def geometry(self) -> Geometry:
        """The map in words of optics."""
        first, second = self.matrix[:, 0], self.matrix[:, 1]
        lengths = np.hypot(*first), np.hypot(*second)
        handedness = 1 if np.linalg.det(self.matrix) > 0.0 else -1
        angles = np.arctan2(first[1], first[0]), np.arctan2(second[1], second[0])
        skew = (handedness * (angles[1] - angles[0])) % (2.0 * np.pi) - 0.5 * np.pi
        # Rows of gradients by a11, a12, a21, a22.
        zeros = np.zeros((2, 2))
        length_1, angle_1 = (np.column_stack([g, zeros[0]]).ravel() for g in _gradients(first))
        length_2, angle_2 = (np.column_stack([zeros[0], g]).ravel() for g in _gradients(second))
        sizes = tuple(
            float(self._spread(gradient) / length**2)
            for gradient, length in ((length_1, lengths[0]), (length_2, lengths[1]))
        )
        return Geometry(
            pixel_size=(1.0 / float(lengths[0]), 1.0 / float(lengths[1])),
            pixel_size_uncertainty=(sizes[0], sizes[1]),
            rotation=float(angles[0]),
            rotation_uncertainty=self._spread(angle_1),
            handedness=handedness,
            skew=float(skew),
            skew_uncertainty=self._spread(angle_2 - angle_1),
        )

    def _spread(self, gradient: FloatArray) -> float:
        return float(np.sqrt(gradient @ self.covariance @ gradient))


@dataclass(frozen=True, slots=True, eq=False)
class StageFit:
    """A map and what it was fitted to.

    Attributes
    ----------
    map : StageMap
    offset : (2,)
        Error of the reference picture, px.
    residuals : (k, 2)
        Shift less fit, px, of every move.
    kept : (k,) bool
        Which moves the fit goes by; the others are outliers.
    residual_rms : float
        Of the distances of kept moves, px.
    """

    map: StageMap
    offset: FloatArray
    residuals: FloatArray
    kept: BoolArray
    residual_rms: float


def fit_stage(
    displacements: FloatArray,
    shifts: FloatArray,
    covariances: FloatArray | None = None,
    demands: Demands | None = None,
) -> StageFit:
    """Fit the map of a stage.

    Parameters
    ----------
    displacements : (k, 2)
        Moves from the place of the reference picture, m; commanded or measured.
    shifts : (k, 2)
        What registration found, px.
    covariances : (k, 2, 2), optional
        Of the shifts, px²; all alike by default.
    demands : Demands, optional

    Raises
    ------
    CalibrationError
        If there are too few moves, they do not span the plane, or the fit does not come up to the
        demands; says what, the value, the bound and what to do.
    """
    demands = Demands() if demands is None else demands
    moves, seen = np.asarray(displacements, dtype=float), np.asarray(shifts, dtype=float)
    _check_moves(moves, seen)
    fit = robust_fit(moves, seen, covariances)
    _check_fit(fit, demands)
    return fit


def robust_fit(
    displacements: FloatArray, shifts: FloatArray, covariances: FloatArray | None = None
) -> StageFit:
    """Fit without judging; parameters as :func:`fit_stage`."""
    count = len(displacements)
    spreads = np.tile(np.eye(2), (count, 1, 1)) if covariances is None else covariances
    whiteners = np.linalg.inv(np.linalg.cholesky(spreads))
    extent = float(np.abs(displacements).max())
    rows = np.column_stack([displacements / extent, np.ones(count)])
    # Unknowns: a11, a12, b1, a21, a22, b2; two whitened equations for every move.
    unwhitened = np.stack([np.kron(np.eye(2), row) for row in rows])
    design = whiteners @ unwhitened
    aims = np.einsum("kij,kj->ki", whiteners, shifts)
    least = 0.0 if covariances is None else 1.0  # of the scale: what registration itself says
    errors = np.ones(count)
    for _ in range(_TURNS):
        weights = 1.0 / np.maximum(errors, 1e-3 * float(errors.max()) + 1e-12)
        errors = _errors(design, aims, _solution(design, aims, weights))
    # Median of a Rayleigh distribution, and Rousseeuw's correction for few moves.
    scale = float(np.median(errors)) / 1.1774 * (1.0 + 5.0 / max(count - 3, 1))
    kept = errors <= _FAR * max(scale, least, 1e-9)
    solution = _solution(design, aims, kept.astype(float))
    squares = float((_errors(design, aims, solution)[kept] ** 2).sum())
    freedom = max(2.0 * np.count_nonzero(kept) - 6.0, 1.0)
    counted = design[kept].reshape(-1, 6)
    covariance = np.linalg.pinv(counted.T @ counted) * max(least, squares / freedom)
    table, places = solution.reshape(2, 3), [0, 1, 3, 4]
    matrix, offset = table[:, :2] / extent, table[:, 2]
    residuals = shifts - displacements @ matrix.T - offset
    return StageFit(
        map=StageMap(matrix, covariance[np.ix_(places, places)] / extent**2),
        offset=offset,
        residuals=residuals,
        kept=kept,
        residual_rms=float(np.sqrt((residuals[kept] ** 2).sum(axis=1).mean())),
    )


def _solution(design: FloatArray, aims: FloatArray, weights: FloatArray) -> FloatArray:
    root = np.sqrt(weights)[:, None]
    rows, right = (root[..., None] * design).reshape(-1, 6), (root * aims).ravel()
    return np.asarray(np.linalg.lstsq(rows, right, rcond=None)[0])


def _errors(design: FloatArray, aims: FloatArray, solution: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.norm(aims - design @ solution, axis=1))


def _check_moves(moves: FloatArray, shifts: FloatArray) -> None:
    if moves.shape != shifts.shape or moves.ndim != 2 or moves.shape[1] != 2:
        raise CalibrationError(
            message(
                "engine",
                "calibration: moves of shape {shape} against shifts of shape {shifts_shape}; both "
                "must be (moves, 2)",
            ).fill(shape=str(moves.shape), shifts_shape=str(shifts.shape))
        )
    if len(moves) < LEAST_MOVES:
        raise CalibrationError(
            message(
                "engine", "calibration: {n} moves, must be at least {least}; allow more of them"
            ).fill(n=len(moves), least=LEAST_MOVES)
        )
    if not (np.isfinite(moves).all() and np.isfinite(shifts).all()):
        raise CalibrationError(
            message("engine", "calibration: a move or shift is not a finite number; start again")
        )
    spread = np.linalg.svd(moves - moves.mean(axis=0), compute_uv=False)
    if not spread[1] > _LEAST_SPREAD * spread[0]:
        part = 0.0 if spread[0] == 0.0 else spread[1] / spread[0]
        raise CalibrationError(
            message(
                "engine",
                "calibration: the moves do not span the plane: across their main "
                "direction they reach {part} % of the way along it, must be at least "
                "{least} %; move both axes",
            ).fill(part=fixed(100.0 * part, 1), least=fixed(100.0 * _LEAST_SPREAD, 0))
        )


def _check_fit(fit: StageFit, demands: Demands) -> None:
    lost = 1.0 - float(fit.kept.mean())
    if lost > demands.outliers:
        raise CalibrationError(
            message(
                "engine",
                "calibration: {bad} of {n} moves do not fit, must be at most {most} %; "
                "something else moved, or the tracking slipped: check the picture, and start "
                "again",
            ).fill(
                bad=int(np.count_nonzero(~fit.kept)),
                n=len(fit.kept),
                most=fixed(100.0 * demands.outliers, 0),
            )
        )
    if fit.residual_rms > demands.residual_px:
        worst = int(np.argmax(np.where(fit.kept, np.linalg.norm(fit.residuals, axis=1), -1.0)))
        raise CalibrationError(
            message(
                "engine",
                "calibration: residuals of {rms} px rms (greatest at move {worst}), must be "
                "at most {most} px; backlash, drift or a loose tool: let the stage settle, "
                "home it, and start again",
            ).fill(
                rms=fixed(fit.residual_rms, 2),
                worst=worst + 1,
                most=rounded(demands.residual_px, 6),
            )
        )
    first, second = fit.map.matrix.T
    lengths = float(np.hypot(*first)), float(np.hypot(*second))
    sine = abs(float(np.linalg.det(fit.map.matrix))) / max(lengths[0] * lengths[1], 1e-300)
    if min(lengths) == 0.0 or sine < np.sin(_LEAST_ANGLE):
        raise CalibrationError(
            message(
                "engine",
                "calibration: both axes move the picture in nearly the same "
                "direction ({angle}° apart, must be at least {least}°); one of them "
                "does not move, or moves along the view",
            ).fill(
                angle=fixed(np.degrees(np.arcsin(min(sine, 1.0))), 1),
                least=fixed(np.degrees(_LEAST_ANGLE), 0),
            )
        )
    told = fit.map.geometry
    worst_scale = max(
        doubt / size
        for size, doubt in zip(told.pixel_size, told.pixel_size_uncertainty, strict=True)
    )
    if worst_scale > demands.scale:
        raise CalibrationError(
            message(
                "engine",
                "calibration: the pixel size is uncertain by {known} %, must be at most "
                "{asked} %; make larger or more moves",
            ).fill(known=fixed(100.0 * worst_scale, 2), asked=rounded(100.0 * demands.scale, 6))
        )


def _gradients(vector: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how a vector's length and angle change with its parts."""
    length = float(np.hypot(*vector))
    return vector / length, np.array([-vector[1], vector[0]]) / length**2
