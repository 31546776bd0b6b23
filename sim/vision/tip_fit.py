"""A tip fitted to the pixels about it: place, depth, and how far they can be trusted.

The model of :mod:`rotemina.sim.vision.pipette` is fitted by least squares: place and depth by
linearisation, background (of second order) and what body and bore do to the light along with them.
Tukey's weights leave out what the model does not know, such as a membrane or a nucleus that
crosses. The covariance is σ² (JᵀJ)⁻¹ of the pixels that count, and what a background that is not
even leaves.
"""

from dataclasses import dataclass, replace
from math import hypot

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.pipette import Pipette

LEAST_HALF_PX = 26  # of the part that is fitted, in focus
_BLURS = 3.0  # by which it grows with the blur
_MOST_HALF_PX = 90
_TUKEY = 4.685
_TURNS = 12
_SETTLED_PX = 0.02
_UNSETTLED_PX = 0.2
_MOST_STEP_PX = 4.0
_MOST_TURN = 0.1  # rad
_MOST_BLUR = 0.5
_BORE, _PLACE, _DEPTH = 1, 2, 4  # where they stand among the coefficients, after the body
_CONTRAST_DOUBT = 0.1  # of a contrast that was seen before
_DIMPLE_PX = 15.0
_BORE_DOUBT = 0.15  # by how much its light may differ, of the tube's
# What dust and lamp of 1 % leave, however little noise there is: 1/px times the blur squared, as
# measured on simulated frames, and a share of the distance from focus.
FLOOR = 0.01
DEPTH_FLOOR = 0.03


#: A coefficient's index, with what weight it is held, and to which value.
Tie = tuple[int, float, float]


@dataclass(frozen=True, slots=True)
class Depth:
    """How far the tip is from focus.

    Attributes
    ----------
    distance : float
        m; positive where the body leads away from focus. Where ``sign_known`` is False it may as
        well be the negative of this.
    uncertainty : float
        Standard deviation, m.
    sign_known : bool
    """

    distance: float
    uncertainty: float
    sign_known: bool


@dataclass(frozen=True, slots=True, eq=False)
class TipFit:
    """A tip in an image.

    Attributes
    ----------
    pixel : (2,)
        Column and row.
    covariance : (2, 2)
        px².
    depth : Depth
    direction : float
        Of the body, rad.
    contrast : float
        What the wall does to the light, as a share of the background; negative: darker.
    significance : float
        That, over its standard deviation.
    used : float
        Share of the pixels that count.
    noise : float
        rms residual of those, in the image's units.
    squares : float
        Sum of weighted squares over the noise's variance: to compare fits to the same pixels.
    """

    pixel: FloatArray
    covariance: FloatArray
    depth: Depth
    direction: float
    contrast: float
    significance: float
    used: float
    noise: float
    squares: float

    @property
    def uncertainty_px(self) -> float:
        """Standard deviation along the worst direction."""
        return float(np.sqrt(np.linalg.eigvalsh(self.covariance)[-1]))


def fit_tip(
    image: Image,
    pipette: Pipette,
    start: FloatArray,
    depth: float = 0.0,
    *,
    turning: bool = False,
    placed: int = 2,
    half: int | None = None,
    dimple: bool = False,
    contrast: float | None = None,
) -> TipFit | None:
    """Fit the tip within a px or two of ``start`` (2,), and near ``depth``, m; None if none fits.

    Only the part of the image about the start is examined, more of it the more it is blurred.
    With ``turning`` the direction is fitted too. In the first ``placed`` turns only the place is:
    a tip out of place looks like a blurred one. ``half`` is how far about the start it is looked
    at, px, where that shall not follow from the blur. ``contrast`` is what it had before, a
    share of the light; it is not let far from that. With ``dimple`` a shade about the tip is
    fitted too, as a pressed-in membrane makes one; without such, that costs precision far from
    focus.
    """
    half = half_width(pipette, depth) if half is None else half
    corner = np.rint(start).astype(int) - half
    low, high = np.maximum(corner, 0), np.minimum(corner + 2 * half + 1, image.shape[::-1])
    if (high - low < half).any():
        return None
    part = image[low[1] : high[1], low[0] : high[0]]
    stride = max(1, half // LEAST_HALF_PX)
    fitting = _Fitting(part, stride, pipette, turning, placed, dimple, contrast)
    return fitting.run(start - low, depth, low.astype(float))


def half_width(pipette: Pipette, depth: float) -> int:
    """Return how far about a tip at a depth, m, it is examined, px."""
    wider = _BLURS * float(pipette.blur(depth) - pipette.sharpest)
    return min(round(LEAST_HALF_PX + wider), _MOST_HALF_PX)


class _Fitting:
    """One fit: the pixels, and what may change.

    The coefficients are six of the background's surface (of second order), the shade of a dimple
    where there may be one, the contrast, what the bore deviates by, and the changes of column, row,
    depth and direction, in that order, as far as they are free.
    """

    def __init__(
        self,
        part: Image,
        stride: int,
        pipette: Pipette,
        turning: bool,
        placed: int,
        dimple: bool,
        contrast: float | None,
    ) -> None:
        # Where the blur is wide, averages of pixels say as much as all of them.
        self.seen = averaged(part, stride)
        self.stride, self.pipette, self.placed = stride, pipette, placed
        self.dimple, self.contrast = dimple, contrast
        self.reach = 0.5 * max(part.shape)
        y, x = np.meshgrid(*(np.linspace(-1.0, 1.0, n) for n in self.seen.shape), indexing="ij")
        self.ground = surface(x.ravel(), y.ravel())
        self.body = len(self.ground) + dimple  # where its coefficients begin
        free = [2, 3]
        if pipette.defocus > 0.0:
            free.append(4)
        if turning:
            free.append(5)
        self.free = free

    def run(self, start: FloatArray, depth: float, low: FloatArray) -> TipFit | None:
        """Iterate from ``start`` (2,), px of the part, whose first pixel is ``low``."""
        middle = 0.5 * (self.stride - 1)  # of the pixels that were averaged
        place, pipette, aim = start - middle, self.pipette, self.seen.ravel()
        weights, variance, contrast, level = np.ones(aim.size), 0.0, 0.0, 0.0
        settled, turn, deeper = False, 0, 0.0
        while turn < _TURNS and not settled:
            ground = self.ground
            if self.dimple:
                ground = np.vstack([ground, self._shade(place)])
            drawn = pipette.drawn(place, depth, self.seen.shape, self.stride)
            drawn = drawn.reshape(6, -1)
            if turn == 0:
                light = least_squares(np.vstack([ground, drawn[:1]]), aim, weights)
                if light is None:
                    return None
                contrast, level = float(light[self.body]), float(light[0])
            free = self.free if turn >= self.placed else self.free[:2]
            rows = np.vstack([ground, drawn[:2], contrast * drawn[free]])
            ties = self._ties(contrast, level, variance)
            solved = least_squares(rows, aim, weights, ties)
            if solved is None:
                return None
            found = solved
            change = dict(zip(free, found[self.body + _PLACE :], strict=True))
            step = np.clip(
                found[self.body + _PLACE : self.body + _DEPTH], -_MOST_STEP_PX, _MOST_STEP_PX
            )
            place, contrast, level = place + step, float(found[self.body]), float(found[0])
            if turn >= self.placed:
                deeper = self._bounded(change.get(4, 0.0), depth)
                depth += deeper
            turned = float(np.clip(change.get(5, 0.0), -_MOST_TURN, _MOST_TURN))
            pipette = replace(pipette, direction=pipette.direction + turned)
            if np.abs(place - start).max() > self.reach:
                return None
            residual = aim - found @ rows
            if turn >= self.placed:
                weights = tukey(residual)
            variance = float((weights * residual**2).sum()) / float(weights.sum())
            turn += 1
            last = max(float(np.abs(step).max()), abs(deeper) * self.pipette.defocus)
            settled = last < _SETTLED_PX and turn > self.placed + 1
        if not settled and float(np.abs(step).max()) > _UNSETTLED_PX:
            return None
        return self._told(rows, residual, weights, found, place + low + middle, depth, pipette)

    def _shade(self, place: FloatArray) -> FloatArray:
        """Return the shade of what the tip presses in, (pixels,)."""
        rows, columns = self.seen.shape
        width = np.sqrt(0.5) * _DIMPLE_PX / self.stride
        across = np.exp(-(((np.arange(columns) - place[0] / self.stride) / width / 2.0) ** 2))
        down = np.exp(-(((np.arange(rows) - place[1] / self.stride) / width / 2.0) ** 2))
        return np.asarray(np.outer(down, across).ravel())

    def _ties(self, contrast: float, level: float, variance: float) -> tuple[Tie, ...]:
        """Return what is known beforehand: the bore's light, and the contrast if it was seen."""
        ties = []
        if contrast:
            ties.append((self.body + _BORE, variance / (_BORE_DOUBT * contrast) ** 2, 0.0))
        if self.contrast is not None and level:
            aim = self.contrast * level
            ties.append((self.body, variance / (_CONTRAST_DOUBT * aim) ** 2, aim))
        return tuple(ties)

    def _bounded(self, change: float, depth: float) -> float:
        """Return a step of the depth that changes the blur by a part of itself at most."""
        most = _MOST_BLUR * float(self.pipette.blur(depth)) / max(self.pipette.defocus, 1e-300)
        return float(np.clip(change, -most, most))

    def _told(
        self,
        rows: FloatArray,
        residual: FloatArray,
        weights: FloatArray,
        found: FloatArray,
        pixel: FloatArray,
        depth: float,
        pipette: Pipette,
    ) -> TipFit | None:
        total = float(weights.sum())
        variance = float((weights * residual**2).sum()) / max(total - len(rows), 1.0)
        normal, at = np.empty((len(rows), len(rows))), self.body
        _sum_up(np.ascontiguousarray(rows), residual, weights, normal, np.empty(len(rows)))
        for index, weight, _ in self._ties(float(found[at]), float(found[0]), variance):
            normal[index, index] += weight
        try:
            spread = variance * np.linalg.inv(normal)
        except np.linalg.LinAlgError:
            return None
        floor = FLOOR * float(pipette.blur(depth)) ** 2
        doubt = float("inf")
        if 4 in self.free:
            doubt = hypot(float(np.sqrt(spread[at + _DEPTH, at + _DEPTH])), DEPTH_FLOOR * depth)
        return TipFit(
            pixel=pixel,
            covariance=spread[at + _PLACE : at + _DEPTH, at + _PLACE : at + _DEPTH]
            + 0.5 * floor**2 * np.eye(2),
            depth=Depth(depth, doubt, sign_known=False),
            direction=pipette.direction,
            contrast=float(found[self.body] / max(abs(found[0]), 1e-12)),
            significance=float(abs(found[self.body]) / np.sqrt(spread[at, at])),
            used=total / weights.size,
            noise=float(np.sqrt(variance)),
            squares=total,
        )


def averaged(part: Image, stride: int) -> FloatArray:
    """Return the means of whole squares of ``stride`` pixels along each side, (rows, columns)."""
    rows, columns = part.shape[0] // stride, part.shape[1] // stride
    cells = part[: rows * stride, : columns * stride].reshape(rows, stride, columns, stride)
    return np.asarray(cells.mean(axis=(1, 3), dtype=np.float64))


def surface(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the terms (6, pixels) of a background of second order at places (pixels,)."""
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y])


def least_squares(
    rows: FloatArray, aim: FloatArray, weights: FloatArray, ties: tuple[Tie, ...] = ()
) -> FloatArray | None:
    """Return the coefficients (k,) of functions (k, pixels) that come nearest to ``aim``."""
    normal, right = np.empty((len(rows), len(rows))), np.empty(len(rows))
    _sum_up(np.ascontiguousarray(rows), aim, weights, normal, right)
    for index, weight, value in ties:
        normal[index, index] += weight
        right[index] += weight * value
    try:
        return np.asarray(np.linalg.solve(normal, right))
    except np.linalg.LinAlgError:
        return None


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def _sum_up(
    rows: FloatArray, aim: FloatArray, weights: FloatArray, normal: FloatArray, right: FloatArray
) -> None:
    """Fill in the normal equations; compiled, as a product this flat keeps BLAS' threads waiting.

    Parameters
    ----------
    rows : (k, pixels)
    aim, weights : (pixels,)
    normal, right : (k, k), (k,)
        What is filled in.
    """
    for i in range(len(rows)):
        weighed = weights * rows[i]
        total = 0.0
        for n in range(len(aim)):
            total += weighed[n] * aim[n]
        right[i] = total
        for j in range(i + 1):
            total = 0.0
            for n in range(len(aim)):
                total += weighed[n] * rows[j, n]
            normal[i, j] = normal[j, i] = total


def tukey(residual: FloatArray) -> FloatArray:
    """Return the weights (pixels,) of residuals: none for what is far off the others."""
    scale = max(1.4826 * float(np.median(np.abs(residual))), 1e-9) * _TUKEY
    return np.asarray(np.clip(1.0 - (residual / scale) ** 2, 0.0, None) ** 2)
