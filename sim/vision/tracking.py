"""A tip followed from frame to frame: kept, lost with the reason, found again.

Where it presses on a membrane its end is hidden, and it is placed by its body
(:mod:`rotemina.sim.vision.body_fit`). What a single frame tells is then weighed against where the
tip should be: where it was, and by how much it was told to move since (Kalman's filter, with the
covariances of both).
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed
from rotemina.sim.vision.body_fit import fit_body
from rotemina.sim.vision.errors import VisionError
from rotemina.sim.vision.image import Image, relative_to
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.tip import (
    LEAST_USED,
    MOST_DOUBT_PX,
    find_tip,
    fit_depths,
    likeliest,
    plausible,
)
from rotemina.sim.vision.tip_fit import Depth, TipFit, fit_tip

REACH_PX = 20.0  # within which a tip is looked for that did not move on as before
_LOOK_PX = 32  # of the body that is compared there
_WIDER_PX = 8.0  # more for every frame it was not seen
_ANEW = 5  # frames after which the whole image is searched, and again after as many
_LEAST_CONTRAST, _MOST_CONTRAST = 0.4, 2.0  # of that when it was found
_AWAY = (8e-6, -8e-6, 20e-6, -20e-6)  # m that it may have gone in depth between two frames
_SMOOTHED = 0.5  # share of the new in the running speed
_PART_PX = 90  # beyond what is searched, that a fit may look at
# By how much a tip that presses may be off where it should be after a frame: whatever drifts, a
# share of the way that it was told to go, and where nobody says how far that is.
_WANDERS_PX, _WAY_DOUBT, _UNTOLD_PX = 0.05, 0.2, 0.3
_BENEATH_PX = 6.0, 0.5  # along the body and across, that a cell leaves that is not taken off
_JUMP = 5.0  # standard deviations beyond which it was moved by something else


@dataclass(frozen=True, slots=True, eq=False)
class TipTrack:
    """The tracking state of a tip after a frame.

    Attributes
    ----------
    pipette : Pipette
        Its shape, with the direction in which it was found.
    pixel, covariance : (2,), (2, 2)
        Where it is, px; where it was seen last while it is lost.
    depth : Depth
    speed : (2,)
        px per frame.
    quality : float
        Share of the pixels about it that look as they should, 0 to 1; 0 while it is lost.
    contrast : float
        What it had when it was found.
    dimple : bool
        Whether the tip may press something in that shades it.
    learnt : int
        Frames from which :func:`learn` knows the body.
    offset : (2,)
        From where the body tells the tip to where it is, px, as learnt.
    lost_for : int
        Frames since it was seen.
    reason : str
        Why it is lost.
    """

    pipette: Pipette
    pixel: FloatArray
    covariance: FloatArray
    depth: Depth
    speed: FloatArray
    quality: float
    contrast: float
    dimple: bool = False
    learnt: int = 0
    offset: FloatArray = field(default_factory=lambda: np.zeros(2))
    lost_for: int = 0
    reason: str = ""

    @property
    def lost(self) -> bool:
        """Whether the latest frame did not show it."""
        return self.lost_for > 0


def begin_track(
    image: Image, pipette: Pipette, *, turning: bool = True, dimple: bool = False
) -> TipTrack:
    """Find the tip in a whole image; with ``dimple`` it is going to press on a membrane.

    Without ``turning`` the pipette's direction is taken as it is, not found again.

    Raises
    ------
    VisionError
        If it is not there.
    """
    return replace(_found(find_tip(image, pipette, turning=turning), pipette), dimple=dimple)


def follow(
    track: TipTrack,
    image: NDArray[Any],
    *,
    background: Image | None = None,
    moved: FloatArray | None = None,
) -> TipTrack:
    """Return the track after one more frame.

    Parameters
    ----------
    track : TipTrack
    image : (rows, columns)
        Numbers of any kind; mostly a part of them is examined.
    background : (rows, columns), optional
        The same view without the tip.
    moved : (2,), optional
        By how many px the tip should have moved since the frame before, by kinematics and
        calibration; by default as it did before.
    """
    fit = None
    if track.dimple and not track.lost:
        start = track.pixel - track.offset + (0.0 if moved is None else moved)
        fit = fit_body(
            image, track.pipette, start, track.depth.distance, track.contrast, background
        )
        if fit is not None and not _doubt(fit, track):
            return _weighed(track, fit, moved, background is not None)
    fit = _near(track, image, background, moved)
    reason = _doubt(fit, track)
    if fit is not None and not reason:
        return _kept(track, _doubted(fit) if track.dimple and background is None else fit)
    lost_for = track.lost_for + 1
    if lost_for % _ANEW == 0:
        whole = np.asarray(image, dtype=np.float32)
        try:
            whole = whole if background is None else relative_to(whole, background)
            fit = find_tip(whole, track.pipette, turning=False)
        except VisionError as error:
            reason = str(error)
        else:
            reason = _doubt(fit, track)
            if not reason:
                return replace(_found(fit, track.pipette), dimple=track.dimple)
    return replace(
        track, lost_for=lost_for, reason=reason, quality=0.0, speed=np.zeros(2, dtype=np.float64)
    )


def learn(track: TipTrack, image: NDArray[Any], *, background: Image | None = None) -> TipTrack:
    """Return the track after a frame in which the tip presses on nothing yet, and nears it.

    What the body looks like is kept as the mean of all frames so far: its direction, the light
    that it takes, and how far the tip is from where the body alone would place it. All three
    become better with the square root of the frames; 30 are enough.
    """
    depth = track.depth.distance
    fit = fit_body(
        image, track.pipette, track.pixel, depth, track.contrast, background, learning=True
    )
    if fit is None or _doubt(fit, track):
        return follow(track, image, background=background)
    share = 1.0 / (track.learnt + 1)
    old = track.pipette.direction if track.learnt else fit.direction
    turned = replace(track.pipette, direction=old + share * (fit.direction - old))
    light = track.contrast if track.learnt else fit.contrast
    light += share * (fit.contrast - light)
    blind = fit_body(image, turned, fit.pixel, fit.depth.distance, light, background)
    if blind is None:
        return follow(track, image, background=background)
    offset = track.offset + share * (fit.pixel - blind.pixel - track.offset)
    known = replace(track, pipette=turned, contrast=light, offset=offset, learnt=track.learnt + 1)
    return _kept(known, fit)


def _near(
    track: TipTrack, image: NDArray[Any], background: Image | None, moved: FloatArray | None
) -> TipFit | None:
    """Look for it where it should be, in the part of the picture that may be needed."""
    expected = track.pixel + (track.speed if moved is None else moved)
    low, high = _around(track, expected, image.shape, _PART_PX)
    if (high - low < 2 * _LOOK_PX).any():
        return None
    window = slice(low[1], high[1]), slice(low[0], high[0])
    part = np.ascontiguousarray(image[window], dtype=np.float32)
    if background is not None:
        part = relative_to(part, background[window])
    fit = _fitted(replace(track, pixel=expected - low), part)
    return None if fit is None else replace(fit, pixel=fit.pixel + low)


def _fitted(track: TipTrack, image: Image) -> TipFit | None:
    """Look for it about ``track.pixel``, then at other depths."""
    depth = track.depth.distance
    place = _likely_place(track, image, (depth,))
    if place is None:
        return None
    fit = fit_tip(
        image,
        track.pipette,
        place,
        depth,
        placed=1,
        dimple=track.dimple,
        contrast=track.contrast,
    )
    if not _doubt(fit, track):
        return fit
    depths = tuple(depth + away for away in _AWAY)
    place = _likely_place(track, image, depths)
    return None if place is None else fit_depths(image, track.pipette, place, depths, turning=False)


def _likely_place(track: TipTrack, image: Image, depths: tuple[float, ...]) -> FloatArray | None:
    low, high = _around(track, track.pixel, image.shape, 0)
    if (high - low < 2 * _LOOK_PX).any():
        return None
    part = image[low[1] : high[1], low[0] : high[0]]
    _, place = likeliest(part, track.pipette, depths, 2, _LOOK_PX)
    return np.asarray(place + low)


def _around(
    track: TipTrack, place: FloatArray, shape: tuple[int, ...], beyond: int
) -> tuple[IntArray, IntArray]:
    """Return where the part about a place (2,), px, that is searched begins and ends, (2,) each."""
    half = round(REACH_PX + _WIDER_PX * track.lost_for) + _LOOK_PX + beyond
    middle = np.rint(place).astype(int)
    return np.maximum(middle - half, 0), np.minimum(middle + half + 1, shape[::-1])


def _doubt(fit: TipFit | None, track: TipTrack) -> str:
    """Return what speaks against a fit; nothing if it is the tip."""
    if fit is None:
        return message("engine", "nothing matches it at its expected place")
    if fit.used < LEAST_USED:
        return message("engine", "only {part} % of its surroundings match").fill(
            part=fixed(100.0 * fit.used, 0)
        )
    if fit.uncertainty_px > MOST_DOUBT_PX:
        return message("engine", "its position is uncertain by {doubt} px").fill(
            doubt=fixed(fit.uncertainty_px, 1)
        )
    if not plausible(fit):
        return message("engine", "the object there absorbs {part} % of the light").fill(
            part=fixed(-100.0 * fit.contrast, 0)
        )
    ratio = fit.contrast / track.contrast
    if not _LEAST_CONTRAST <= ratio <= _MOST_CONTRAST:
        return message("engine", "its contrast has changed to {part} %").fill(
            part=fixed(100.0 * ratio, 0)
        )
    return ""


def _kept(track: TipTrack, fit: TipFit) -> TipTrack:
    moved = (fit.pixel - track.pixel) / (track.lost_for + 1)
    return replace(
        track,
        pixel=fit.pixel,
        covariance=fit.covariance,
        depth=replace(fit.depth, sign_known=track.depth.sign_known),
        speed=_SMOOTHED * moved + (1.0 - _SMOOTHED) * track.speed,
        quality=fit.used,
        lost_for=0,
        reason="",
    )


def _weighed(track: TipTrack, fit: TipFit, moved: FloatArray | None, alone: bool) -> TipTrack:
    """Weigh what a frame tells of a pressing tip against where it should be."""
    way = np.zeros(2) if moved is None else np.asarray(moved, dtype=np.float64)
    off = _UNTOLD_PX if moved is None else _WANDERS_PX + _WAY_DOUBT * float(np.hypot(*way))
    before = track.covariance + off**2 * np.eye(2)
    fit = replace(fit, pixel=fit.pixel + track.offset)
    if not alone:  # what lies beneath is no noise: it does not become less with more frames
        return _kept(track, _doubted(fit))
    news = fit.pixel - track.pixel - way
    total = before + fit.covariance
    if float(news @ np.linalg.solve(total, news)) > _JUMP**2:
        return _kept(track, fit)  # it is where it is seen, whatever it was told
    gain = before @ np.linalg.inv(total)
    pixel, covariance = track.pixel + way + gain @ news, before - gain @ before
    return _kept(track, replace(fit, pixel=pixel, covariance=covariance))


def _doubted(fit: TipFit) -> TipFit:
    """Return a fit over a cell whose picture is not taken off, with what that leaves."""
    body = np.array([np.cos(fit.direction), np.sin(fit.direction)])
    left = _BENEATH_PX[0] ** 2 * np.outer(body, body) + _BENEATH_PX[1] ** 2 * np.eye(2)
    return replace(fit, covariance=fit.covariance + left)


def _found(fit: TipFit, pipette: Pipette) -> TipTrack:
    return TipTrack(
        pipette=replace(pipette, direction=fit.direction),
        pixel=fit.pixel,
        covariance=fit.covariance,
        depth=fit.depth,
        speed=np.zeros(2),
        quality=fit.used,
        contrast=fit.contrast,
    )
