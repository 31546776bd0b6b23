"""Tracking of a tip from frame to frame, including its loss and the search for a lost tip.

When the tip presses on a membrane its end is hidden, and its position is fitted from its body
(:mod:`rotemina.sim.vision.body_fit`). A Kalman filter then combines the position in a single frame
with the expected position, which follows from the previous one and the commanded move.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.errors import VisionError
from rotemina.sim.messages import format_fixed, message
from rotemina.sim.vision.body_fit import fit_body
from rotemina.sim.vision.image import Image, divide_by_background
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.tip_fit import TipDepth, TipFit, fit_tip
from rotemina.sim.vision.tip_search import (
    MAX_DEVIATION_PX,
    MIN_USED_RATIO,
    find_likeliest_place,
    find_tip,
    fit_from_depths,
    is_plausible,
)

# Distance from the expected position within which the tip is searched.
SEARCH_REACH_PX = 20.0
# Side of the template that is compared there.
_TEMPLATE_PX = 32
# Growth of the search region for every frame without the tip.
_GROWTH_PER_LOST_FRAME_PX = 8.0
# Interval, in frames, at which the whole image is searched for a lost tip.
_FULL_SEARCH_INTERVAL_FRAMES = 5
# Limits of the ratio of the contrast to the contrast when the tip was found.
_MIN_CONTRAST_RATIO, _MAX_CONTRAST_RATIO = 0.4, 2.0
# Changes of depth between two frames that are tried.
_DEPTH_CHANGES_M = (8e-6, -8e-6, 20e-6, -20e-6)
# Weight of the latest frame in the running mean of the speed.
_SPEED_SMOOTHING = 0.5
# Margin around the search region that a fit may use.
_FIT_MARGIN_PX = 90
# Standard deviations of the move of a pressing tip in one frame: a constant for drift, a share of
# the commanded move, and a constant if the commanded move is unknown.
_WANDER_PX, _MOVE_DEVIATION_RATIO, _UNKNOWN_MOVE_DEVIATION_PX = 0.05, 0.2, 0.3
# Standard deviations along and across the body that a cell in the background causes.
_BACKGROUND_CELL_DEVIATIONS_PX = 6.0, 0.5
# Deviation from the expected position, in standard deviations, above which the tip has jumped.
_JUMP_SIGMAS = 5.0


@dataclass(frozen=True, slots=True, eq=False)
class TipTrack:
    """The tracking state of a tip after a frame.

    Attributes
    ----------
    pipette : Pipette
        The image model, with the direction that was found.
    pixel, covariance : (2,), (2, 2)
        Position of the tip, px, and its covariance, px²; the last known values while it is lost.
    depth : TipDepth
    speed : (2,)
        Speed of the tip, px per frame.
    quality : float
        Share of the pixels around the tip that match the model, 0 to 1; 0 while it is lost.
    contrast : float
        Contrast of the body when the tip was found.
    dimple : bool
        Whether the tip may press on a membrane, which shades it.
    learnt : int
        Number of frames in the means of :func:`learn_body`.
    offset : (2,)
        Learnt offset from the position by the body to the position of the tip, px.
    lost_for : int
        Number of frames since the tip was lost.
    reason : str
        Reason why the tip is lost, empty if it is not.
    """

    pipette: Pipette
    pixel: FloatArray
    covariance: FloatArray
    depth: TipDepth
    speed: FloatArray
    quality: float
    contrast: float
    dimple: bool = False
    learnt_frames: int = 0
    offset: FloatArray = field(default_factory=lambda: np.zeros(2))
    lost_frames: int = 0
    reason: str = ""

    @property
    def lost(self) -> bool:
        """Whether the tip was not found in the latest frame."""
        return self.lost_frames > 0


def begin_track(
    image: Image, pipette: Pipette, *, turning: bool = True, dimple: bool = False
) -> TipTrack:
    """Find the tip in a whole image and begin to track it.

    Parameters
    ----------
    image : image
    pipette : Pipette
    turning : bool
        Whether to fit the direction of the pipette too.
    dimple : bool
        Whether the tip is going to press on a membrane.

    Raises
    ------
    VisionError
        If no tip is found.
    """
    return replace(_start_track(find_tip(image, pipette, turning=turning), pipette), dimple=dimple)


def follow_tip(
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
        Image of any numeric type. Usually only a part of it is examined.
    background : (rows, columns), optional
        The same view without the tip.
    moved : (2,), optional
        Expected move of the tip since the previous frame, px, from kinematics and calibration. By
        default it continues at its speed.
    """
    fit = None
    if track.dimple and not track.lost:
        start = track.pixel - track.offset + (0.0 if moved is None else moved)
        fit = fit_body(
            image, track.pipette, start, track.depth.distance, track.contrast, background
        )
        if fit is not None and not _find_objection(fit, track):
            return _filter_track(track, fit, moved, background is not None)
    fit = _fit_near(track, image, background, moved)
    reason = _find_objection(fit, track)
    if fit is not None and not reason:
        return _update_track(
            track, _add_background_deviation(fit) if track.dimple and background is None else fit
        )
    lost_for = track.lost_frames + 1
    if lost_for % _FULL_SEARCH_INTERVAL_FRAMES == 0:
        full_image = np.asarray(image, dtype=np.float32)
        try:
            full_image = (
                full_image if background is None else divide_by_background(full_image, background)
            )
            fit = find_tip(full_image, track.pipette, turning=False)
        except VisionError as error:
            reason = str(error)
        else:
            reason = _find_objection(fit, track)
            if not reason:
                return replace(_start_track(fit, track.pipette), dimple=track.dimple)
    return replace(
        track, lost_frames=lost_for, reason=reason, quality=0.0, speed=np.zeros(2, dtype=np.float64)
    )


def learn_body(
    track: TipTrack, image: NDArray[Any], *, background: Image | None = None
) -> TipTrack:
    """Return the track after a frame in which the tip approaches but does not yet press.

    The function averages three figures over all such frames: the direction of the body, its
    contrast, and the offset of the tip from the position by the body alone. Their errors fall with
    the square root of the number of frames; 30 frames are enough.
    """
    depth = track.depth.distance
    fit = fit_body(
        image, track.pipette, track.pixel, depth, track.contrast, background, learning=True
    )
    if fit is None or _find_objection(fit, track):
        return follow_tip(track, image, background=background)
    weight = 1.0 / (track.learnt_frames + 1)
    direction = track.pipette.direction if track.learnt_frames else fit.direction
    learnt_pipette = replace(
        track.pipette, direction=direction + weight * (fit.direction - direction)
    )
    contrast = track.contrast if track.learnt_frames else fit.contrast
    contrast += weight * (fit.contrast - contrast)
    blind_fit = fit_body(image, learnt_pipette, fit.pixel, fit.depth.distance, contrast, background)
    if blind_fit is None:
        return follow_tip(track, image, background=background)
    offset = track.offset + weight * (fit.pixel - blind_fit.pixel - track.offset)
    learnt_track = replace(
        track,
        pipette=learnt_pipette,
        contrast=contrast,
        offset=offset,
        learnt_frames=track.learnt_frames + 1,
    )
    return _update_track(learnt_track, fit)


def _fit_near(
    track: TipTrack, image: NDArray[Any], background: Image | None, moved: FloatArray | None
) -> TipFit | None:
    expected = track.pixel + (track.speed if moved is None else moved)
    low, high = _compute_search_bounds(track, expected, image.shape, _FIT_MARGIN_PX)
    if (high - low < 2 * _TEMPLATE_PX).any():
        return None
    window = slice(low[1], high[1]), slice(low[0], high[0])
    region = np.ascontiguousarray(image[window], dtype=np.float32)
    if background is not None:
        region = divide_by_background(region, background[window])
    fit = _fit_at_depths(replace(track, pixel=expected - low), region)
    return None if fit is None else replace(fit, pixel=fit.pixel + low)


def _fit_at_depths(track: TipTrack, image: Image) -> TipFit | None:
    depth = track.depth.distance
    position = _find_likely_place(track, image, (depth,))
    if position is None:
        return None
    fit = fit_tip(
        image,
        track.pipette,
        position,
        depth,
        position_iterations=1,
        dimple=track.dimple,
        contrast=track.contrast,
    )
    if not _find_objection(fit, track):
        return fit
    depths = tuple(depth + change for change in _DEPTH_CHANGES_M)
    position = _find_likely_place(track, image, depths)
    return (
        None
        if position is None
        else fit_from_depths(image, track.pipette, position, depths, fit_direction=False)
    )


def _find_likely_place(
    track: TipTrack, image: Image, depths: tuple[float, ...]
) -> FloatArray | None:
    low, high = _compute_search_bounds(track, track.pixel, image.shape, 0)
    if (high - low < 2 * _TEMPLATE_PX).any():
        return None
    region = image[low[1] : high[1], low[0] : high[0]]
    _, place = find_likeliest_place(region, track.pipette, depths, 2, _TEMPLATE_PX)
    return np.asarray(place + low)


def _compute_search_bounds(
    track: TipTrack, position: FloatArray, shape: tuple[int, ...], margin: int
) -> tuple[IntArray, IntArray]:
    half_size = (
        round(SEARCH_REACH_PX + _GROWTH_PER_LOST_FRAME_PX * track.lost_frames)
        + _TEMPLATE_PX
        + margin
    )
    centre = np.rint(position).astype(int)
    return np.maximum(centre - half_size, 0), np.minimum(centre + half_size + 1, shape[::-1])


def _find_objection(fit: TipFit | None, track: TipTrack) -> str:
    """Return the reason why a fit cannot be the tip, or an empty text."""
    if fit is None:
        return message("engine", "nothing matches it at its expected position")
    if fit.used < MIN_USED_RATIO:
        return message("engine", "only {part} % of its surroundings match").fill(
            part=format_fixed(100.0 * fit.used, 0)
        )
    if fit.uncertainty_px > MAX_DEVIATION_PX:
        return message("engine", "its position is uncertain by {doubt} px").fill(
            doubt=format_fixed(fit.uncertainty_px, 1)
        )
    if not is_plausible(fit):
        return message("engine", "the object there absorbs {part} % of the light").fill(
            part=format_fixed(-100.0 * fit.contrast, 0)
        )
    ratio = fit.contrast / track.contrast
    if not _MIN_CONTRAST_RATIO <= ratio <= _MAX_CONTRAST_RATIO:
        return message("engine", "its contrast has changed to {part} %").fill(
            part=format_fixed(100.0 * ratio, 0)
        )
    return ""


def _update_track(track: TipTrack, fit: TipFit) -> TipTrack:
    step = (fit.pixel - track.pixel) / (track.lost_frames + 1)
    return replace(
        track,
        pixel=fit.pixel,
        covariance=fit.covariance,
        depth=replace(fit.depth, sign_known=track.depth.sign_known),
        speed=_SPEED_SMOOTHING * step + (1.0 - _SPEED_SMOOTHING) * track.speed,
        quality=fit.used,
        lost_frames=0,
        reason="",
    )


def _filter_track(
    track: TipTrack, fit: TipFit, moved: FloatArray | None, background_removed: bool
) -> TipTrack:
    move = np.zeros(2) if moved is None else np.asarray(moved, dtype=np.float64)
    deviation = (
        _UNKNOWN_MOVE_DEVIATION_PX
        if moved is None
        else _WANDER_PX + _MOVE_DEVIATION_RATIO * float(np.hypot(*move))
    )
    prior_covariance = track.covariance + deviation**2 * np.eye(2)
    fit = replace(fit, pixel=fit.pixel + track.offset)
    if not background_removed:
        # The cell beneath the tip causes a systematic error, which would not average out over
        # frames.
        return _update_track(track, _add_background_deviation(fit))
    innovation = fit.pixel - track.pixel - move
    innovation_covariance = prior_covariance + fit.covariance
    if float(innovation @ np.linalg.solve(innovation_covariance, innovation)) > _JUMP_SIGMAS**2:
        # The tip has jumped, so the expected position is not used.
        return _update_track(track, fit)
    gain = prior_covariance @ np.linalg.inv(innovation_covariance)
    pixel, covariance = (
        track.pixel + move + gain @ innovation,
        prior_covariance - gain @ prior_covariance,
    )
    return _update_track(track, replace(fit, pixel=pixel, covariance=covariance))


def _add_background_deviation(fit: TipFit) -> TipFit:
    """Return a fit with the additional covariance of a cell that is not in the background."""
    body = np.array([np.cos(fit.direction), np.sin(fit.direction)])
    extra = _BACKGROUND_CELL_DEVIATIONS_PX[0] ** 2 * np.outer(
        body, body
    ) + _BACKGROUND_CELL_DEVIATIONS_PX[1] ** 2 * np.eye(2)
    return replace(fit, covariance=fit.covariance + extra)


def _start_track(fit: TipFit, pipette: Pipette) -> TipTrack:
    return TipTrack(
        pipette=replace(pipette, direction=fit.direction),
        pixel=fit.pixel,
        covariance=fit.covariance,
        depth=fit.depth,
        speed=np.zeros(2),
        quality=fit.used,
        contrast=fit.contrast,
    )
