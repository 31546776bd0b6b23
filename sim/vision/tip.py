"""The tip of a pipette found in a whole image, and on which side of focus it is.

A template of the pipette (:mod:`rotemina.sim.vision.pipette`) is laid over the image at a few
depths; the likeliest places are fitted (:mod:`rotemina.sim.vision.tip_fit`), and the most certain
fit that may be a tip at all is kept.

Depth comes from blur, which is the same on both sides of focus. A body that climbs tells them
apart: before focus its sharpest place is the tip, behind it a place farther up. Both signs are
fitted, and where neither fits clearly better the estimate says so.
"""

from collections.abc import Iterable
from dataclasses import replace
from math import hypot

import cv2
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed
from rotemina.sim.vision.errors import VisionError
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.registration import flattened
from rotemina.sim.vision.tip_fit import TipFit, fit_tip, half_width

LEAST_SCORE = 0.45  # of the correlation with the template
LEAST_CONTRAST, MOST_CONTRAST = 0.1, 1.1  # share of the light that the body takes
LEAST_USED = 0.45  # share of the pixels that look as they should
MOST_DOUBT_PX = 3.0
_LEAST_CLEARER = 30.0  # of squares over noise, by which one sign must fit better
_FINDING_PX = 96  # of the template that a whole image is searched with
_FINDING_DEPTHS = (0.0, 8e-6, -8e-6, 20e-6, -20e-6)
_DIRECTIONS = 30  # that a body may lead in, if nobody knows: each is found within half of a step
_TRIED = 4  # of the likeliest of them


def fit_depths(
    image: Image,
    pipette: Pipette,
    start: FloatArray,
    depths: tuple[float, ...],
    *,
    turning: bool = True,
) -> TipFit | None:
    """Fit from several depths, m, and from the mirror image of the best.

    This is what finds the sign of the depth; a tracker then keeps it.
    """
    half = max(half_width(pipette, at) for at in depths)  # the same pixels for all, to be compared
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
            message(
                "engine",
                "tip: nothing in the picture matches it (best match {likeness}); bring the "
                "tip into view and near focus, or correct its direction in the image",
            ).fill(likeness=fixed(likeness, 2))
        )
    return best


def find_body(image: Image, pipette: Pipette) -> TipFit:
    """Find the tip in a whole image, whatever direction its body leads in.

    It takes some ten times as long as :func:`find_tip`.

    Raises
    ------
    VisionError
        If nothing looks like it.
    """
    # A longer part of the body than shows the tip: that is what tells the direction.
    long = 2 * _FINDING_PX if min(image.shape) >= 4 * _FINDING_PX else _FINDING_PX
    flat = flattened(image)
    scores = []
    for turn in np.linspace(-np.pi, np.pi, _DIRECTIONS, endpoint=False):
        aimed = replace(pipette, direction=float(turn))
        scores.append((likeliest(flat, aimed, _FINDING_DEPTHS, long // 24, long)[0], aimed))
    scores.sort(key=lambda one: -one[0])
    fits, refusal = [], VisionError("")
    for _, aimed in scores[:_TRIED]:
        try:
            fits.append(find_tip(image, aimed))
        except VisionError as error:
            refusal = error
    if not fits:
        raise VisionError(
            message(
                "engine",
                "tip: nothing in the picture looks like a pipette in any direction; bring "
                "the tip into view and near focus",
            )
        ) from refusal
    return min(fits, key=lambda fit: fit.uncertainty_px)


def plausible(fit: TipFit) -> bool:
    """Return whether a fit may be a tip at all."""
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
