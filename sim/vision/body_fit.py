"""A tip placed by its body alone, while the end is hidden in what it presses in.

Across the body, both edges tell the place. Along it, the half width ``h = r + t l`` does
(:mod:`rotemina.sim.vision.pipette`): an edge that is known within 0.01 px tells where a body that
widens by 7 % begins within 0.15 px. What the tip presses in is left out: a disc about it. As much
depends on the light that the body takes, that is held to what was seen before.
"""

from dataclasses import dataclass, replace
from math import hypot
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.image import Image, relative_to
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.tip_fit import (
    DEPTH_FLOOR,
    Depth,
    TipFit,
    averaged,
    least_squares,
    surface,
    tukey,
)

_YIELDING_PX = 45.0  # about the tip, for which the next three are right
_AHEAD_PX, _HALF_PX, _STRIDE_PX = 140.0, 150.0, 6.0
_TURNS = 6
_SETTLED_PX, _UNSETTLED_PX = 0.03, 0.3
_MOST_STEP_PX = 4.0
_MOST_TURN = 0.05  # rad
_MOST_BLUR = 0.5
_LEARNT, _UNLEARNT = (0.01, 0.05), (0.3, 0.05)  # doubts of contrast and bore, of the contrast
_BODY, _BORE, _PLACE, _DEPTH = 6, 7, 8, 10  # where they stand among the coefficients
_LEAST_PART = 0.3  # of the part that must be in the picture


@dataclass(frozen=True, slots=True)
class BodyPart:
    """The part of the body that is examined: larger where a cell gives way over more pixels.

    Attributes
    ----------
    ahead : float
        Its middle, px along the body from the tip.
    half : int
        px to each side.
    stride : int
        Pixels along each side of a square that is averaged.
    """

    ahead: float
    half: int
    stride: int

    @classmethod
    def of(cls, pipette: Pipette) -> Self:
        """Return that of a pipette."""
        scale = max(pipette.yielding / _YIELDING_PX, 1.0)
        return cls(_AHEAD_PX * scale, round(_HALF_PX * scale), round(_STRIDE_PX * scale))


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
    """Fit the tip within some px of ``start`` (2,), and near ``depth``, m; None if none fits.

    Parameters
    ----------
    image : (rows, columns)
        Numbers of any kind; only the part about the body is examined.
    pipette : Pipette
    start : (2,)
        px.
    depth : float
        m.
    contrast : float
        Share of the light that the body was seen to take, negative.
    background : (rows, columns), optional
        The same view without the tip.
    learning : bool
        Whether it presses on nothing, and what its body looks like is fitted too: direction and
        contrast.
    """
    way = np.array([np.cos(pipette.direction), np.sin(pipette.direction)])
    body = BodyPart.of(pipette)
    corner = np.rint(start + body.ahead * way).astype(int) - body.half
    low = np.maximum(corner, 0)
    high = np.minimum(corner + 2 * body.half + 1, image.shape[::-1])
    if (high - low < body.stride).any() or np.prod(high - low) < _LEAST_PART * (2 * body.half) ** 2:
        return None
    window = slice(low[1], high[1]), slice(low[0], high[0])
    part = np.asarray(image[window], dtype=np.float32)
    if background is not None:
        part = relative_to(part, background[window])
    place = np.asarray(start, dtype=np.float64) - low
    blind = 0.0 if learning else pipette.yielding
    fitting = _Fitting(averaged(part, body.stride), place, body.stride, blind)
    if not fitting.settle(pipette, depth, contrast):
        return None
    return fitting.result(low)


class _Fitting:
    """One fit: averaged pixels, and which of them count: those that are not in a blind disc.

    The coefficients are six of the background's surface (of second order), contrast, bore, and the
    changes of column, row, depth and, where it learns and nothing is blind, direction.
    """

    def __init__(self, seen: FloatArray, start: FloatArray, stride: int, blind: float) -> None:
        self.shape, self.aim, self.learning = seen.shape, seen.ravel(), not blind
        self.stride, self.middle = stride, 0.5 * (stride - 1)  # of the pixels that are averaged
        self.place = start - self.middle
        down, across = np.indices(seen.shape, dtype=np.float64)
        away = np.hypot(stride * across - self.place[0], stride * down - self.place[1])
        self.counted = (away >= blind).ravel().astype(np.float64)
        x, y = 2.0 * across / seen.shape[1] - 1.0, 2.0 * down / seen.shape[0] - 1.0
        self.ground = surface(x.ravel(), y.ravel())
        self.level, self.variance, self.weights = float(np.median(seen)), 0.0, self.counted

    def settle(self, pipette: Pipette, depth: float, contrast: float) -> bool:
        """Iterate; return whether it has converged."""
        self.pipette, self.depth = pipette, depth
        moved = np.inf
        for turn in range(_TURNS):
            found = self._solved(contrast)
            if found is None:
                return False
            moved = self._moved(found)
            self.weights = self.counted * tukey(self.residual)
            total = max(float(self.weights.sum()), 1.0)
            self.variance = float((self.weights * self.residual**2).sum()) / total
            if turn > 0 and moved < _SETTLED_PX:
                break
        return moved < _UNSETTLED_PX

    def result(self, low: FloatArray) -> TipFit | None:
        """Return the fit; ``low`` (2,) is where the part begins, px."""
        normal = (self.rows * self.weights) @ self.rows.T
        for index, weight, _ in self.ties:
            normal[index, index] += weight
        try:
            spread = self.variance * np.linalg.inv(normal)
        except np.linalg.LinAlgError:
            return None
        doubt = hypot(float(np.sqrt(spread[_DEPTH, _DEPTH])), DEPTH_FLOOR * self.depth)
        body, total = float(self.found[_BODY]), float(self.weights.sum())
        return TipFit(
            pixel=self.place + low + self.middle,
            covariance=spread[_PLACE:_DEPTH, _PLACE:_DEPTH],
            depth=Depth(self.depth, doubt, sign_known=False),
            direction=self.pipette.direction,
            contrast=body / max(abs(self.level), 1e-12),
            significance=abs(body) / float(np.sqrt(spread[_BODY, _BODY])),
            used=total / max(float(self.counted.sum()), 1.0),
            noise=float(np.sqrt(self.variance)),
            squares=total,
        )

    def _solved(self, contrast: float) -> FloatArray | None:
        drawn = self.pipette.drawn(self.place, self.depth, self.shape, self.stride).reshape(6, -1)
        held, last = contrast * self.level, 6 if self.learning else 5
        doubts = _UNLEARNT if self.learning else _LEARNT
        self.rows = np.vstack([self.ground, drawn[:2], held * drawn[2:last]])
        self.ties = (
            (_BODY, self.variance / (doubts[0] * held) ** 2, held),
            (_BORE, self.variance / (doubts[1] * held) ** 2, 0.0),
        )
        found = least_squares(self.rows, self.aim, self.weights, self.ties)
        if found is not None:
            self.found, self.residual = found, self.aim - found @ self.rows
        return found

    def _moved(self, found: FloatArray) -> float:
        """Go where the coefficients say, with bounds; return by how many px."""
        step = np.clip(found[_PLACE:_DEPTH], -_MOST_STEP_PX, _MOST_STEP_PX)
        most = _MOST_BLUR * float(self.pipette.blur(self.depth))
        most /= max(self.pipette.defocus, 1e-300)
        deeper = float(np.clip(found[_DEPTH], -most, most))
        self.place, self.depth = self.place + step, self.depth + deeper
        self.level = float(found[0])
        if self.learning:
            turned = float(np.clip(found[_DEPTH + 1], -_MOST_TURN, _MOST_TURN))
            self.pipette = replace(self.pipette, direction=self.pipette.direction + turned)
        return max(float(np.abs(step).max()), abs(deeper) * self.pipette.defocus)
