"""Search for the tip of a pipette in a whole image, including the sign of its depth.

A template of the pipette (:mod:`rotemina.sim.vision.pipette`) is correlated with the image at a few
depths. The tip is fitted at the likeliest positions (:mod:`rotemina.sim.vision.tip_fit`), and the
most certain plausible fit is the result.

The depth follows from the blur, which is the same on both sides of focus. A body that is inclined
to the focal plane shows the side: if it leads away from focus, it is sharpest at the tip, and if it
leads through focus, it is sharpest farther up. Both signs are fitted. If neither fits clearly
better, the result says that the sign is unknown.
"""

from collections.abc import Iterable
from dataclasses import replace
from math import hypot

import cv2
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import VisionError
from rotemina.sim.messages import format_fixed
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.registration import flatten_brightness
from rotemina.sim.vision.tip_fit import TipFit, fit_tip, half_width

# Smallest correlation with the template.
MIN_SCORE = 0.45
# Limits of the share of the light that the body absorbs.
MIN_CONTRAST, MAX_CONTRAST = 0.1, 1.1
# Smallest share of the pixels that match the model.
MIN_USED_RATIO = 0.45
MAX_DEVIATION_PX = 3.0
# Smallest difference of the sums of squares, relative to the noise variance, at which the sign is
# known.
_MIN_SIGN_ADVANTAGE = 30.0
# Side of the template with which a whole image is searched.
_TEMPLATE_PX = 96
_SEARCH_DEPTHS_M = (0.0, 8e-6, -8e-6, 20e-6, -20e-6)
# Number of directions that are tried if the direction is unknown. The search tolerates an error of
# half a step.
_DIRECTION_COUNT = 30
# Number of the likeliest directions in which a tip is fitted.
_FITTED_DIRECTION_COUNT = 4


def fit_from_depths(
    image: Image,
    pipette: Pipette,
    start: FloatArray,
    depths: tuple[float, ...],
    *,
    fit_direction: bool = True,
) -> TipFit | None:
    """Fit the tip from several start depths, m, and from the opposite of the best depth.

    This determines the sign of the depth, which a tracker then keeps.
    """
    # All fits use the same pixels, so that their residuals can be compared.
    half_size = max(half_width(pipette, depth) for depth in depths)
    attempts = (
        fit_tip(image, pipette, start, depth, turning=fit_direction, half=half_size)
        for depth in depths
    )
    fits = [fit for fit in attempts if fit is not None]
    if not fits:
        return None
    best = min(fits, key=lambda fit: fit.noise / max(fit.used, 1e-3))
    distance = best.depth.distance
    if pipette.depth_per_px == 0.0 or pipette.defocus == 0.0:
        return replace(best, depth=replace(best.depth, distance=abs(distance), sign_known=False))
    opposite = fit_tip(image, pipette, best.pixel, -distance, turning=fit_direction, half=half_size)
    # The opposite start may converge to the same depth. Then there is no rival.
    has_rival = opposite is not None and opposite.depth.distance * distance < 0.0
    is_clear = True
    if has_rival and opposite is not None:
        if opposite.noise < best.noise:
            best, opposite = opposite, best
        excess = (opposite.noise / best.noise) ** 2 - 1.0
        is_clear = excess * best.squares > _MIN_SIGN_ADVANTAGE
    sign_known = is_clear and abs(best.depth.distance) > 2.0 * best.depth.uncertainty
    return replace(best, depth=replace(best.depth, sign_known=sign_known))


def find_tip(image: Image, pipette: Pipette, *, turning: bool = True) -> TipFit:
    """Find the tip of a pipette of known direction in a whole image.

    With ``turning`` the direction needs to be known only roughly and is fitted too. This works best
    if no other object lies beneath the pipette.

    Raises
    ------
    VisionError
        If no tip is found.
    """
    factor = 4 if min(image.shape) >= 3 * _TEMPLATE_PX else 2
    flattened_image, best, best_score = flatten_brightness(image), None, 0.0
    for depth in _SEARCH_DEPTHS_M:
        score, place = find_likeliest_place(flattened_image, pipette, (depth,), factor)
        best_score = max(best_score, score)
        fit = fit_tip(image, pipette, place, depth) if score >= MIN_SCORE else None
        if (
            fit is not None
            and is_plausible(fit)
            and (best is None or fit.uncertainty_px < best.uncertainty_px)
        ):
            best = fit
    if best is not None:
        distance = best.depth.distance
        best = fit_from_depths(image, pipette, best.pixel, (distance, 0.0), fit_direction=turning)
    if best is None or not is_plausible(best):
        raise VisionError(
            "tip: nothing in the picture matches it (best match {likeness}); bring the "
            "tip into view and near focus, or correct its direction in the image",
            likeness=format_fixed(best_score, 2),
        )
    return best


def find_tip_in_any_direction(image: Image, pipette: Pipette) -> TipFit:
    """Find the tip of a pipette of unknown direction in a whole image.

    It takes about ten times as long as :func:`find_tip`.

    Raises
    ------
    VisionError
        If no tip is found.
    """
    # The template is larger than for a known direction, because a long body shows the direction.
    size = 2 * _TEMPLATE_PX if min(image.shape) >= 4 * _TEMPLATE_PX else _TEMPLATE_PX
    flattened_image = flatten_brightness(image)
    scores = []
    for direction in np.linspace(-np.pi, np.pi, _DIRECTION_COUNT, endpoint=False):
        candidate = replace(pipette, direction=float(direction))
        scores.append(
            (
                find_likeliest_place(
                    flattened_image, candidate, _SEARCH_DEPTHS_M, size // 24, size
                )[0],
                candidate,
            )
        )
    scores.sort(key=lambda item: -item[0])
    fits, last_error = [], VisionError("")
    for _, candidate in scores[:_FITTED_DIRECTION_COUNT]:
        try:
            fits.append(find_tip(image, candidate))
        except VisionError as error:
            last_error = error
    if not fits:
        raise VisionError(
            "tip: nothing in the picture looks like a pipette in any direction; bring "
            "the tip into view and near focus"
        ) from last_error
    return min(fits, key=lambda fit: fit.uncertainty_px)


def is_plausible(fit: TipFit) -> bool:
    """Return whether contrast, matching pixels and uncertainty of a fit are those of a tip."""
    return (
        -MAX_CONTRAST <= fit.contrast <= -MIN_CONTRAST
        and fit.used >= MIN_USED_RATIO
        and fit.uncertainty_px <= MAX_DEVIATION_PX
    )


def find_likeliest_place(
    image: Image,
    pipette: Pipette,
    depths: Iterable[float],
    factor: int,
    size: int = _TEMPLATE_PX,
) -> tuple[float, FloatArray]:
    """Return the largest correlation with the pipette and its position (2,), px.

    Parameters
    ----------
    image : image
    pipette : Pipette
    depths : iterable of float
        Depths of the template, m.
    factor : int
        Factor by which the image is reduced first.
    size : int
        Side of the template around the tip, px of the original image.
    """
    reduced = np.asarray(
        cv2.resize(image, None, fx=1.0 / factor, fy=1.0 / factor, interpolation=cv2.INTER_AREA),
        dtype=np.float32,
    )
    half_size, brightness = size // factor // 2, abs(float(np.median(reduced)))
    best, place = -1.0, np.zeros(2)
    # The reduction blurs the image; 0.3 is about √(1/12), the standard deviation of a pixel.
    blurred = replace(pipette, sharpest=hypot(pipette.sharpest, 0.3 * factor))
    tip_position = np.full(2, float(half_size * factor))
    if min(reduced.shape) < 2 * half_size + 1:
        return best, place
    for depth in depths:
        body_image = blurred.draw(
            tip_position, depth, (2 * half_size + 1, 2 * half_size + 1), factor
        )[0]
        # The template is negative, because the pipette absorbs light.
        template = np.asarray(-body_image, dtype=np.float32)
        correlation = cv2.matchTemplate(reduced, template, cv2.TM_CCOEFF_NORMED)
        # A gradient of the light may correlate too, but its amplitude is small.
        amplitude = cv2.matchTemplate(reduced, template, cv2.TM_CCOEFF)
        energy = float(((template - template.mean()) ** 2).sum())
        correlation[amplitude < MIN_CONTRAST * brightness * energy] = 0.0
        row, column = np.unravel_index(int(np.argmax(correlation)), correlation.shape)
        if correlation[row, column] > best:
            best = float(correlation[row, column])
            reduced_place = np.array([column + half_size, row + half_size], dtype=np.float64)
            place = factor * reduced_place + 0.5 * (factor - 1)
    return best, place
