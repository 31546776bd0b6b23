"""The tip of a pipette, to a fraction of a pixel: found in a whole image, fitted in a part of it.

The model of :mod:`rotemina.sim.vision.pipette` is fitted by least squares: place and depth by
linearisation, background (of second order) and what body and bore do to the light along with them.
Tukey's weights leave out what the model does not know, such as a membrane or a nucleus that
crosses. The covariance is σ² (JᵀJ)⁻¹ of the pixels that count.

Depth comes from blur, which is the same on both sides of focus. A body that climbs tells them
apart: before focus its sharpest place is the tip, behind it a place farther up. Both signs are
fitted, and where neither fits clearly better the estimate says so.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import hypot

import cv2
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.errors import VisionError
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.registration import flattened

LEAST_HALF_PX = 26  # of the part that is fitted, in focus
_BLURS = 3.0  # by which it grows with the blur
_MOST = 90
_TUKEY = 4.685
_TURNS = 12
_SETTLED_PX = 0.02
_UNSETTLED_PX = 0.2
_MOST_STEP_PX = 4.0
_MOST_TURN = 0.1  # rad
_MOST_BLUR = 0.5
_BORE, _PLACE, _DEPTH = 1, 2, 4  # where they stand among the coefficients, after the body
_DIMPLE_PX = 15.0
_BORE_DOUBT = 0.15  # by how much its light may differ, of the tube's
_LEAST_CLEARER = 30.0  # of squares over noise, by which one sign must fit better
_FINDING_PX = 96  # of the template that a whole image is searched with
_FINDING_DEPTHS = (0.0, 8e-6, -8e-6, 20e-6, -20e-6)
LEAST_SCORE = 0.45  # of the correlation with the template
LEAST_CONTRAST, MOST_CONTRAST = 0.1, 1.1  # share of the light that the body takes
LEAST_USED = 0.45  # share of the pixels that look as they should
MOST_DOUBT_PX = 3.0
# What dust and lamp of 1 % leave, however little noise there is: 1/px times the blur squared, as
# measured on simulated frames, and a share of the distance from focus.
FLOOR = 0.01
DEPTH_FLOOR = 0.03


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
) -> TipFit | None:
    """Fit the tip within a px or two of ``start`` (2,), and near ``depth``, m; None if none fits.

    Only the part of the image about the start is looked at, more of it the more it is blurred.
    With ``turning`` the direction is fitted too. In the first ``placed`` turns only the place is:
    a tip out of place looks like a blurred one. ``half`` is how far about the start it is looked
    at, px, where that shall not follow from the blur. With ``dimple`` a shade about the tip is
    fitted too, as a pressed-in membrane makes one; without such, that costs precision far from
    focus.
    """
    half = _half(pipette, depth) if half is None else half
    corner = np.rint(start).astype(int) - half
    low, high = np.maximum(corner, 0), np.minimum(corner + 2 * half + 1, image.shape[::-1])
    if (high - low < half).any():
        return None
    part = image[low[1] : high[1], low[0] : high[0]]
    stride = max(1, half // LEAST_HALF_PX)
    fitting = _Fitting(part, stride, pipette, turning, placed, dimple)
    return fitting.run(start - low, depth, low.astype(float))


def _half(pipette: Pipette, depth: float) -> int:
    wider = _BLURS * float(pipette.blur(depth) - pipette.sharpest)
    return min(round(LEAST_HALF_PX + wider), _MOST)


def fit_depths(
    image: Image,
    pipette: Pipette,
    start: FloatArray,
    depths: tuple[float, ...],
    *,
    turning: bool = True,
) -> TipFit | None:
    """Fit from several depths, m, and from the mirror image of the best; tell whether it differs.

    This is what finds the sign of the depth; a tracker then keeps it.
    """
    half = max(_half(pipette, at) for at in depths)  # the same pixels for all, to be compared
    tries = (fit_tip(image, pipette, start, at, turning=turning, half=half) for at in depths)
    fits = [fit for fit in tries if fit is not None]
    if not fits:
        return None
    best = min(fits, key=lambda fit: fit.noise / max(fit.used, 1e-3))
    away = best.depth.distance
    if pipette.climb == 0.0 or pipette.defocus == 0.0:
        return replace(best, depth=replace(best.depth, distance=abs(away), sign_known=False))
    other = fit_tip(image, pipette, best.pixel, -away, turning=turning, half=half)
    # The other start may lead back to the same place: then there is no rival.
    rivals = other is not None and other.depth.distance * away < 0.0
    clear = True
    if rivals and other is not None:
        if other.noise < best.noise:
            best, other = other, best
        excess = (other.noise / best.noise) ** 2 - 1.0
        clear = excess * best.squares > _LEAST_CLEARER
    known = clear and abs(best.depth.distance) > 2.0 * best.depth.uncertainty
    return replace(best, depth=replace(best.depth, sign_known=known))


def find_tip(image: Image, pipette: Pipette, *, turning: bool = True) -> TipFit:
    """Find the tip in a whole image, by the shape of a body that leads in its known direction.

    With ``turning`` the direction is known roughly and found too: best where nothing lies beneath.

    Raises
    ------
    VisionError
        If nothing looks like it.
    """
    factor = 4 if min(image.shape) >= 3 * _FINDING_PX else 2
    flat, best, likeness = flattened(image), None, 0.0
    for depth in _FINDING_DEPTHS:
        score, place = likeliest(flat, pipette, (depth,), factor)
        likeness = max(likeness, score)
        fit = fit_tip(image, pipette, place, depth) if score >= LEAST_SCORE else None
        if (
            fit is not None
            and plausible(fit)
            and (best is None or fit.uncertainty_px < best.uncertainty_px)
        ):
            best = fit
    if best is not None:
        away = best.depth.distance
        best = fit_depths(image, pipette, best.pixel, (away, 0.0), turning=turning)
    if best is None or not plausible(best):
        raise VisionError(
            f"tip: nothing looks like it (greatest likeness {likeness:.2f}); bring the tip into "
            "view and near focus, or correct its direction in the image"
        )
    return best


def plausible(fit: TipFit) -> bool:
    """Tell whether a fit may be a tip at all."""
    return (
        -MOST_CONTRAST <= fit.contrast <= -LEAST_CONTRAST
        and fit.used >= LEAST_USED
        and fit.uncertainty_px <= MOST_DOUBT_PX
    )


def likeliest(
    image: Image,
    pipette: Pipette,
    depths: Iterable[float],
    factor: int,
    size: int = _FINDING_PX,
) -> tuple[float, FloatArray]:
    """Return the greatest likeness to the pipette at one of ``depths``, m, and where, px (2,).

    Every ``factor`` pixels are made one first; the likeness (correlation) is that of ``size`` px
    about the tip.
    """
    small = np.asarray(
        cv2.resize(image, None, fx=1.0 / factor, fy=1.0 / factor, interpolation=cv2.INTER_AREA),
        dtype=np.float32,
    )
    half, brightness = size // factor // 2, abs(float(np.median(small)))
    best, place = -1.0, np.zeros(2)
    broad = replace(pipette, sharpest=hypot(pipette.sharpest, 0.3 * factor))  # of a small pixel
    middle = np.full(2, float(half * factor))
    if min(small.shape) < 2 * half + 1:
        return best, place
    for depth in depths:
        drawn = broad.drawn(middle, depth, (2 * half + 1, 2 * half + 1), factor)[0]
        template = np.asarray(-drawn, dtype=np.float32)  # it takes light away
        likeness = cv2.matchTemplate(small, template, cv2.TM_CCOEFF_NORMED)
        # A slope of the light may be alike, but is faint.
        amplitude = cv2.matchTemplate(small, template, cv2.TM_CCOEFF)
        energy = float(((template - template.mean()) ** 2).sum())
        likeness[amplitude < LEAST_CONTRAST * brightness * energy] = 0.0
        row, column = np.unravel_index(int(np.argmax(likeness)), likeness.shape)
        if likeness[row, column] > best:
            best = float(likeness[row, column])
            found = np.array([column + half, row + half], dtype=np.float64)
            place = factor * found + 0.5 * (factor - 1)
    return best, place


class _Fitting:
    """One fit: the pixels, and what may change.

    The coefficients are six of the background's surface (of second order), the shade of a dimple
    where there may be one, the contrast, what the bore deviates by, and the changes of column, row,
    depth and direction, in that order, as far as they are free.
    """

    def __init__(
        self, part: Image, stride: int, pipette: Pipette, turning: bool, placed: int, dimple: bool
    ) -> None:
        # Where the blur is wide, averages of pixels say as much as all of them.
        rows, columns = part.shape[0] // stride, part.shape[1] // stride
        kept = part[: rows * stride, : columns * stride]
        self.seen = kept.reshape(rows, stride, columns, stride).mean(axis=(1, 3), dtype=np.float64)
        self.stride, self.pipette, self.placed = stride, pipette, placed
        self.dimple = dimple
        self.reach = 0.5 * max(part.shape)
        down, across = np.meshgrid(
            np.linspace(-1.0, 1.0, rows), np.linspace(-1.0, 1.0, columns), indexing="ij"
        )
        x, y = across.ravel(), down.ravel()
        self.ground = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y])
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
        weights, variance, contrast = np.ones(aim.size), 0.0, 0.0
        settled, turn, deeper = False, 0, 0.0
        while turn < _TURNS and not settled:
            ground = self.ground
            if self.dimple:
                ground = np.vstack([ground, self._shade(place)])
            drawn = pipette.drawn(place, depth, self.seen.shape, self.stride)
            drawn = drawn.reshape(6, -1)
            if turn == 0:
                light = _least_squares(np.vstack([ground, drawn[:1]]), aim, weights)
                if light is None:
                    return None
                contrast = float(light[self.body])
            free = self.free if turn >= self.placed else self.free[:2]
            rows = np.vstack([ground, drawn[:2], contrast * drawn[free]])
            solved = _least_squares(
                rows, aim, weights, (self.body + _BORE, _tied(contrast, variance))
            )
            if solved is None:
                return None
            found = solved
            change = dict(zip(free, found[self.body + _PLACE :], strict=True))
            step = np.clip(
                found[self.body + _PLACE : self.body + _DEPTH], -_MOST_STEP_PX, _MOST_STEP_PX
            )
            place, contrast = place + step, float(found[self.body])
            if turn >= self.placed:
                deeper = self._bounded(change.get(4, 0.0), depth)
                depth += deeper
            turned = float(np.clip(change.get(5, 0.0), -_MOST_TURN, _MOST_TURN))
            pipette = replace(pipette, direction=pipette.direction + turned)
            if np.abs(place - start).max() > self.reach:
                return None
            residual = aim - found @ rows
            if turn >= self.placed:
                weights = _tukey(residual)
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
        normal = (weights * rows) @ rows.T
        bore, at = self.body + _BORE, self.body
        normal[bore, bore] += _tied(float(found[at]), variance)
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


def _least_squares(
    rows: FloatArray,
    aim: FloatArray,
    weights: FloatArray,
    tied: tuple[int, float] = (0, 0.0),
) -> FloatArray | None:
    """Return the coefficients (k,) of functions (k, pixels) that come nearest to ``aim``.

    ``tied`` is a coefficient that is held to zero, and with what weight.
    """
    weighed = weights * rows
    normal = weighed @ rows.T
    normal[tied[0], tied[0]] += tied[1]
    try:
        return np.asarray(np.linalg.solve(normal, weighed @ aim))
    except np.linalg.LinAlgError:
        return None


def _tied(contrast: float, variance: float) -> float:
    """Return the weight that ties the bore to what it is said to be, within its doubt."""
    return variance / (_BORE_DOUBT * contrast) ** 2 if contrast else 0.0


def _tukey(residual: FloatArray) -> FloatArray:
    scale = max(1.4826 * float(np.median(np.abs(residual))), 1e-9) * _TUKEY
    return np.asarray(np.clip(1.0 - (residual / scale) ** 2, 0.0, None) ** 2)
