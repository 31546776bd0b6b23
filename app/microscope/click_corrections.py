"""Executes a planned move, and corrects it until the tip is at the clicked point."""

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.calibration_file import NANO
from rotemina.app.microscope.click_target import ClickMover, PlannedMove
from rotemina.app.microscope.settled_frame import FrameSource, SettledFrame, SettledFrameGrabber
from rotemina.drivers.contract import Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_fixed, format_rounded
from rotemina.sim.vision import (
    Image,
    TipTrack,
    divide_by_background,
    find_likeliest_place,
    fit_tip,
    is_plausible,
)

ARRIVAL_TOLERANCE_PX = 0.3
MAX_CORRECTIONS = 4
# A larger miss means that the calibration is wrong, so it is not corrected.
_MAX_CORRECTION_PX = 30.0
# Side length of the tip template. The search window extends two side lengths in each direction.
_TEMPLATE_SIZE_PX = 48
# The search evaluates one of this many columns and rows.
_SEARCH_FACTOR = 2
# A pixel counts as uncovered if the pipette blocks at most this fraction of its light.
_MAX_BLOCKED_FRACTION = 0.02


class VisitState(StrEnum):
    """The state of a visit to a clicked point."""

    UNDER_WAY = "under way"
    ARRIVED = "arrived"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, eq=False)
class VisitStatus:
    """Status of a visit, for display.

    ``miss_px`` (2,) is the vector from the tip to the clicked point. ``corrections`` is the number
    of corrections so far.
    """

    state: VisitState
    corrections: int = 0
    miss_px: FloatArray | None = None
    reason: str = ""


class VisitRun:
    """A visit: makes a planned move, finds the tip, and corrects until the tip is at the goal.

    The owner calls :meth:`step`.

    Parameters
    ----------
    mover : ClickMover
    newest_frame : callable
        Returns the camera's newest picture.
    move : PlannedMove
    track : TipTrack
        Appearance of the tip before the move.
    now_s : float
        Host time.
    earlier_image : image, optional
        The picture before the move. If the tip does not cover the goal in this picture, the picture
        serves as the background at the goal, so that a cell under the tip does not disturb the
        search.
    confirmed : bool
        Whether the operator has confirmed a large move.
    earlier_is_clear : bool
        Whether ``earlier_image`` is certain to show the goal without the tip.
    permit : Permit, optional
        Issued with the request; every move uses it.

    Raises
    ------
    InputError
        If the first move is refused.
    """

    def __init__(
        self,
        mover: ClickMover,
        newest_frame: FrameSource,
        move: PlannedMove,
        track: TipTrack,
        *,
        now_s: float,
        earlier_image: Image | None = None,
        confirmed: bool = False,
        earlier_is_clear: bool = False,
        permit: Permit | None = None,
    ) -> None:
        self._mover, self._goal_px, self._stage = mover, move.pixel, move.stage
        self._track, self._expected_px, self._earlier_image = (
            track,
            move.predicted_px,
            earlier_image,
        )
        self._shows_goal_uncovered = earlier_is_clear
        self._grabber = SettledFrameGrabber(mover.session, newest_frame, permit=permit)
        mover.go(move, confirmed=confirmed, permit=self._grabber.permit)
        self._grabber.begin(now_s)
        self.status = VisitStatus(VisitState.UNDER_WAY)

    def step(self, now_s: float) -> VisitStatus:
        """Advance the run; a failure of a device or a camera ends the run and raises nothing."""
        if self.ended:
            return self.status
        try:
            settled = self._grabber.step(now_s)
            if settled is not None:
                self._evaluate_picture(settled, now_s)
        except InputError as error:
            self.status = replace(self.status, state=VisitState.FAILED, reason=str(error))
        return self.status

    @property
    def ended(self) -> bool:
        """Whether the run has ended."""
        return self.status.state is not VisitState.UNDER_WAY

    def abort(self, reason: str) -> None:
        """Stop the machine, which stays where it is, and end the run."""
        if not self.ended:
            self._mover.session.stop(reason)
            self.status = replace(self.status, state=VisitState.FAILED, reason=reason)

    def _evaluate_picture(self, settled: SettledFrame, now_s: float) -> None:
        tip = self._find_tip(settled)
        miss = self._goal_px - tip
        self.status = replace(self.status, miss_px=miss)
        distance = float(np.linalg.norm(miss))
        if distance <= ARRIVAL_TOLERANCE_PX:
            self.status = replace(self.status, state=VisitState.ARRIVED)
            return
        if distance > _MAX_CORRECTION_PX:
            raise MicroscopeError(
                "the tip is {distance} px from its target, but at most {most} px are "
                "permitted after a move; the calibration is no longer valid: calibrate "
                "again",
                distance=format_fixed(distance, 0),
                most=format_fixed(_MAX_CORRECTION_PX, 0),
            )
        if self.status.corrections >= MAX_CORRECTIONS:
            raise MicroscopeError(
                "the tip is still {distance} px off after {n} corrections; at most "
                "{most} px are permitted: the stage drifts, or its resolution is too coarse",
                distance=format_fixed(distance, 2),
                n=MAX_CORRECTIONS,
                most=format_rounded(ARRIVAL_TOLERANCE_PX, 6),
            )
        self._expected_px = self._goal_px
        move = self._plan_correction(tip)
        self._grabber.require_motion_permitted()
        self._mover.go(move, permit=self._grabber.permit)
        self.status = replace(self.status, corrections=self.status.corrections + 1)
        self._grabber.begin(now_s)

    def _plan_correction(self, tip: FloatArray) -> PlannedMove:
        """Plan a correction with the nano stage if the move used it; else the mover chooses."""
        return self._mover.plan(
            self._goal_px, stage=NANO if self._stage == NANO else None, tip_px=tip
        )

    def _find_tip(self, settled: SettledFrame) -> FloatArray:
        """Return the pixel (2,) of the tip, searched near the expected pixel."""
        track = self._track
        centre = np.rint(self._expected_px).astype(int)
        begin = np.maximum(centre - 2 * _TEMPLATE_SIZE_PX, 0)
        end = np.minimum(centre + 2 * _TEMPLATE_SIZE_PX, settled.image.shape[::-1])
        window = slice(begin[1], end[1]), slice(begin[0], end[0])
        window_image = self._remove_background(settled.image[window], window)
        depth = track.depth.distance
        score, offset = find_likeliest_place(
            window_image, track.pipette, (depth,), _SEARCH_FACTOR, _TEMPLATE_SIZE_PX
        )
        fit = fit_tip(window_image, track.pipette, offset, depth) if score > 0.0 else None
        if fit is None or not is_plausible(fit):
            raise MicroscopeError(
                "the tip is not visible near {column}, {row} px, where it should be; no "
                "further moves are made: check the picture",
                column=format_fixed(self._expected_px[0], 0),
                row=format_fixed(self._expected_px[1], 0),
            )
        return np.asarray(fit.pixel + begin)

    def _remove_background(self, window_image: Image, window: tuple[slice, slice]) -> Image:
        """Divide the window by the earlier picture, unless the tip covers the window in it."""
        earlier_image, track = self._earlier_image, self._track
        if earlier_image is None or earlier_image[window].shape != window_image.shape:
            return window_image
        if self._shows_goal_uncovered:
            return divide_by_background(window_image, earlier_image[window])
        corner = np.array([window[1].start, window[0].start])
        shading = track.pipette.draw(
            track.pixel - corner, track.depth.distance, window_image.shape
        )[0]
        return (
            window_image
            if shading.max() > _MAX_BLOCKED_FRACTION
            else divide_by_background(window_image, earlier_image[window])
        )
