"""The outline of a cell, and how a tip stands to it.

From a place inside, rays look for the dark line of the membrane; the closed path around that is
darkest on the whole is found by dynamic programming (A. Amini et al., PAMI 12 (1990)), and an
ellipse fitted to it by robust least squares. Its covariance follows from the residuals.
"""

from dataclasses import dataclass

import cv2
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed, rounded
from rotemina.sim.vision.errors import VisionError
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.registration import flattened

_RAYS = 120
_STEEPEST = 2  # px by which the radius may change from ray to ray
_LEAST_DARKER = 0.02  # share of the light that the membrane takes, on average of the rays
_LINE_PX = 2.0  # half width of what is taken for a line
_FAR = 3.0  # px off the ellipse that counts less
_MOST_RMS = 0.08  # of the mean radius, between path and ellipse
_RIM_PX = 0.7  # by which a bright rim moves the darkest line, as seen on simulated cells
_STEP = 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class CellOutline:
    """An ellipse in the picture.

    Attributes
    ----------
    figures : (5,)
        Column and row of the centre, half axes, px, and where the first one points, rad.
    covariance : (5, 5)
        Of those.
    path : (rays, 2)
        Where the membrane was seen, px.
    darker : float
        Share of the light that it takes.
    """

    figures: FloatArray
    covariance: FloatArray
    path: FloatArray
    darker: float

    @property
    def centre(self) -> FloatArray:
        """Column and row (2,), px."""
        return self.figures[:2]


@dataclass(frozen=True, slots=True)
class MembraneAhead:
    """The membrane in a tip's path; each with its standard deviation.

    Attributes
    ----------
    distance, distance_uncertainty : float
        Along the way, px; negative where the tip is inside.
    angle, angle_uncertainty : float
        Between the way and the membrane's normal, rad, 0 to π/2; 0 is head on.
    """

    distance: float
    distance_uncertainty: float
    angle: float
    angle_uncertainty: float


def find_cell(image: Image, near: FloatArray, radii: tuple[float, float]) -> CellOutline:
    """Find the outline of the cell about ``near`` (2,), px, a place inside it.

    Parameters
    ----------
    image : image
    near : (2,)
    radii : (float, float)
        Between which distances from there the membrane is, px.

    Raises
    ------
    VisionError
        If no line closes about the place, or it is no ellipse.
    """
    low, high = radii
    if not 2.0 < low < high:
        raise VisionError(
            message(
                "engine", "cell: radii {low} to {high} px; must be more than 2 and increasing"
            ).fill(low=low, high=high)
        )
    centre = np.asarray(near, dtype=float)
    soft = np.asarray(cv2.GaussianBlur(flattened(image), (0, 0), 1.0), dtype=np.float32)
    for _ in range(2):  # the second time from its own middle
        path, darker = _path(soft, centre, low, high)
        if darker < _LEAST_DARKER:
            raise VisionError(
                message(
                    "engine",
                    "cell: the line around {column}, {row} px absorbs {darker} % of the "
                    "light, must be at least {least} %; focus on the membrane, or click into "
                    "the cell",
                ).fill(
                    column=fixed(centre[0], 0),
                    row=fixed(centre[1], 0),
                    darker=fixed(100.0 * darker, 1),
                    least=rounded(100.0 * _LEAST_DARKER, 6),
                )
            )
        found, spread, rms = _ellipse(path, centre)
        centre = found[:2]
    if rms > _MOST_RMS * float(found[2:4].mean()):
        raise VisionError(
            message(
                "engine",
                "cell: the outline deviates from an ellipse by {rms} px rms, must be at most "
                "{most} % of its radius; click into the middle of one cell",
            ).fill(rms=fixed(rms, 1), most=rounded(100.0 * _MOST_RMS, 6))
        )
    return CellOutline(found, spread, path, darker)


def membrane_ahead(
    cell: CellOutline, tip: FloatArray, tip_covariance: FloatArray, direction: float
) -> MembraneAhead | None:
    """Return how far the membrane is from ``tip`` (2,), px, that goes in ``direction``, rad.

    None where that way misses the cell, or leads away from it. Uncertainties are of first order.
    """
    values = np.concatenate([cell.figures, tip])
    found = _ahead(values, direction)
    if found is None:
        return None
    spread = np.zeros((7, 7))
    spread[:5, :5], spread[5:, 5:] = cell.covariance, tip_covariance
    rows = []
    for index in range(7):
        step = np.zeros(7)
        step[index] = _STEP
        more, less = _ahead(values + step, direction), _ahead(values - step, direction)
        if more is None or less is None:  # it only just grazes the cell
            return MembraneAhead(found[0], float("inf"), found[1], float("inf"))
        rows.append((np.array(more) - np.array(less)) / (2.0 * _STEP))
    gradients = np.array(rows).T
    doubts = np.sqrt(np.diag(gradients @ spread @ gradients.T))
    return MembraneAhead(found[0], float(doubts[0]), found[1], float(doubts[1]))


def _ahead(values: FloatArray, direction: float) -> tuple[float, float] | None:
    """Return distance and angle for the ellipse and tip in ``values`` (7,)."""
    centre, axes, turn, tip = values[:2], values[2:4], values[4], values[5:]
    c, s = np.cos(turn), np.sin(turn)
    own = np.array([[c, s], [-s, c]])  # into the ellipse's axes
    begin = own @ (tip - centre) / axes
    aim = np.array([np.cos(direction), np.sin(direction)])
    way = own @ aim / axes
    a, b, k = way @ way, begin @ way, begin @ begin - 1.0
    under = b * b - a * k
    if under <= 0.0:
        return None
    distance = float((-b - np.sqrt(under)) / a)
    if k > 0.0 and distance < 0.0:
        return None  # it is behind
    normal = own.T @ ((begin + distance * way) / axes)
    cosine = abs(float(aim @ normal)) / float(np.linalg.norm(normal))
    return distance, float(np.arccos(min(cosine, 1.0)))


def _path(soft: Image, centre: FloatArray, low: float, high: float) -> tuple[FloatArray, float]:
    """Return the darkest closed line (rays, 2), px, and how much darker it is than beside it."""
    angles = np.linspace(0.0, 2.0 * np.pi, _RAYS, endpoint=False)
    radius = np.arange(low, high + 0.5)
    away = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    points = (centre + radius[None, :, None] * away[:, None]).astype(np.float32)
    seen = cv2.remap(
        soft, points[..., 0], points[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    beside = cv2.GaussianBlur(seen, (0, 0), sigmaX=3.0 * _LINE_PX, sigmaY=0.5)
    line = cv2.GaussianBlur(seen, (0, 0), sigmaX=0.5 * _LINE_PX, sigmaY=0.5)
    darker = np.asarray(beside - line, dtype=np.float64)
    chosen = _closed(darker)
    rows = np.arange(_RAYS)
    inner = np.clip(chosen, 1, len(radius) - 2)
    left, mid, right = (darker[rows, inner + k] for k in (-1, 0, 1))
    bend = left - 2.0 * mid + right
    part = np.where(bend < 0.0, 0.5 * (left - right) / np.where(bend < 0.0, bend, -1.0), 0.0)
    exact = radius[inner] + np.clip(part, -0.5, 0.5)
    return centre + exact[:, None] * away, float(darker[rows, chosen].mean())


def _closed(gain: FloatArray) -> np.ndarray:
    """Return the column (rays,) of the path of most gain that comes back to where it began."""
    start = _best(gain, None)[len(gain) // 2]
    # Begun where the open path is surest, in its middle, it is closed there.
    turned = np.roll(gain, -(len(gain) // 2), axis=0)
    return np.roll(_best(turned, int(start)), len(gain) // 2)


def _best(gain: FloatArray, ends: int | None) -> np.ndarray:
    rays, columns = gain.shape
    total = gain[0].copy()
    if ends is not None:
        total[np.abs(np.arange(columns) - ends) > 0] = -np.inf
    came = np.zeros((rays, columns), dtype=int)
    moves = range(-_STEEPEST, _STEEPEST + 1)
    for ray in range(1, rays):
        padded = np.pad(total, _STEEPEST, constant_values=-np.inf)
        options = np.stack([padded[_STEEPEST + m : _STEEPEST + m + columns] for m in moves])
        pick = options.argmax(axis=0)
        came[ray] = np.clip(np.arange(columns) + pick - _STEEPEST, 0, columns - 1)
        total = options.max(axis=0) + gain[ray]
    if ends is not None:
        total[np.abs(np.arange(columns) - ends) > _STEEPEST] = -np.inf
    path = np.empty(rays, dtype=int)
    path[-1] = int(np.argmax(total))
    for ray in range(rays - 1, 0, -1):
        path[ray - 1] = came[ray, path[ray]]
    return path


def _ellipse(path: FloatArray, centre: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return the ellipse (5,), its covariance (5, 5) and the rms distance of the path from it."""
    radius = float(np.linalg.norm(path - centre, axis=1).mean())

    def off(values: FloatArray) -> FloatArray:
        c, s = np.cos(values[4]), np.sin(values[4])
        x, y = (path - values[:2]).T
        own = np.stack([c * x + s * y, c * y - s * x])
        level = np.linalg.norm(own / values[2:4, None], axis=0)
        # Sampson's distance: the level over its gradient.
        slope = np.linalg.norm(own / values[2:4, None] ** 2, axis=0) / np.maximum(level, 1e-9)
        return np.asarray((level - 1.0) / np.maximum(slope, 1e-9))

    start = np.array([*centre, 1.05 * radius, 0.95 * radius, 0.0])
    best = min(
        (
            scipy.optimize.least_squares(
                off, np.array([*start[:4], turn]), loss="soft_l1", f_scale=_FAR
            )
            for turn in (0.0, np.pi / 2)
        ),
        key=lambda fit: float(fit.cost),
    )
    found = _ordered(np.asarray(best.x, dtype=np.float64))
    residual = off(np.asarray(best.x))
    scale = 1.4826 * float(np.median(np.abs(residual)))
    jacobian = np.asarray(best.jac)
    # Neighbouring rays see the same pixels: about every third says something of its own.
    spread = 3.0 * scale**2 * np.linalg.pinv(jacobian.T @ jacobian)
    spread[[2, 3], [2, 3]] += _RIM_PX**2
    if found[2] != best.x[2]:
        swap = [0, 1, 3, 2, 4]
        spread = spread[np.ix_(swap, swap)]
    return found, spread, float(np.sqrt((residual**2).mean()))


def _ordered(values: FloatArray) -> FloatArray:
    """Return an ellipse with its long half axis first, which points to the right."""
    column, row, first, second, turn = values
    first, second = abs(first), abs(second)
    if first < second:
        first, second, turn = second, first, turn + np.pi / 2
    turn = (turn + np.pi / 2) % np.pi - np.pi / 2
    return np.array([column, row, first, second, turn])
