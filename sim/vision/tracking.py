"""A tip followed from frame to frame: kept, lost with the reason, found again."""

from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.errors import VisionError
from rotemina.sim.vision.image import Image
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


@dataclass(frozen=True, slots=True, eq=False)
class TipTrack:
    """What is known of a tip after a frame.

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

    Without ``turning`` the pipette's direction is taken as it is, not found anew.

    Raises
    ------
    VisionError
        If it is not there.
    """
    return replace(_found(find_tip(image, pipette, turning=turning), pipette), dimple=dimple)


def follow(track: TipTrack, image: Image) -> TipTrack:
    """Return the track after one more frame (rows, columns)."""
    fit = _near(track, image)
    reason = _doubt(fit, track)
    if fit is not None and not reason:
        return _kept(track, fit)
    lost_for = track.lost_for + 1
    if lost_for % _ANEW == 0:
        try:
            fit = find_tip(image, track.pipette, turning=False)
        except VisionError as error:
            reason = str(error)
        else:
            reason = _doubt(fit, track)
            if not reason:
                return replace(_found(fit, track.pipette), dimple=track.dimple)
    return replace(
        track, lost_for=lost_for, reason=reason, quality=0.0, speed=np.zeros(2, dtype=np.float64)
    )


def _near(track: TipTrack, image: Image) -> TipFit | None:
    """Look for it where it should be, then at other depths."""
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
    half = round(REACH_PX + _WIDER_PX * track.lost_for) + _LOOK_PX
    middle = np.rint(track.pixel + track.speed).astype(int)
    low = np.maximum(middle - half, 0)
    high = np.minimum(middle + half + 1, image.shape[::-1])
    if (high - low < 2 * _LOOK_PX).any():
        return None
    part = image[low[1] : high[1], low[0] : high[0]]
    _, place = likeliest(part, track.pipette, depths, 2, _LOOK_PX)
    return np.asarray(place + low)


def _doubt(fit: TipFit | None, track: TipTrack) -> str:
    """Return what speaks against a fit; nothing if it is the tip."""
    if fit is None:
        return "nothing like it where it should be"
    if fit.used < LEAST_USED:
        return f"only {100.0 * fit.used:.0f} % of its surroundings look as they should"
    if fit.uncertainty_px > MOST_DOUBT_PX:
        return f"its place is uncertain by {fit.uncertainty_px:.1f} px"
    if not plausible(fit):
        return f"what is there takes {-100.0 * fit.contrast:.0f} % of the light"
    ratio = fit.contrast / track.contrast
    if not _LEAST_CONTRAST <= ratio <= _MOST_CONTRAST:
        return f"its contrast is {100.0 * ratio:.0f} % of what it was"
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
