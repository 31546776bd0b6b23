"""Executes a planned move, and corrects it until the tip is at the clicked point."""

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from rotemina.app.microscope.calibration_file import NANO
from rotemina.app.microscope.click_target import ClickToMove, PlannedMove
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.settled_frame import Newest, SettledFrame, SettledFrameGrabber
from rotemina.drivers.gate import Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed, rounded
from rotemina.sim.vision.image import Image, relative_to
from rotemina.sim.vision.tip import likeliest, plausible
from rotemina.sim.vision.tip_fit import fit_tip
from rotemina.sim.vision.tracking import TipTrack

TOLERANCE_PX = 0.3
CORRECTIONS = 4
_MOST_CORRECTION_PX = 30.0  # farther off than this is no matter of refinement
_LOOKED_PX = 48
_COVERED = 0.02  # share of a pixel that a pipette may still shade


class Visit(StrEnum):
    """The state of a visit to a clicked point."""

    UNDER_WAY = "under way"
    ARRIVED = "arrived"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, eq=False)
class VisitStatus:
    """Status for display: the latest miss (2,), px, seen after so many corrections."""

    visit: Visit
    corrections: int = 0
    miss: FloatArray | None = None
    reason: str = ""


class ClickRun:
    """Goes to a planned place, looks where the tip is, and corrects until it is there.

    Somebody calls :meth:`step`.

    Parameters
    ----------
    clicks : ClickToMove
    newest : callable
        The camera's newest picture.
    move : PlannedMove
    track : TipTrack
        What the tip looks like, as it was seen before the move.
    now_s : float
    before : image, optional
        The picture in which it was seen. Where the tip goes to a place that it does not cover
        there, that place is known without the tip, and a cell beneath it misleads nobody.
    confirmed : bool
    clear : bool
        Whether ``before`` shows the goal without the tip for certain.
    permit : Permit, optional
        Of the request; every move goes with it.

    Raises
    ------
    InputError
        If the first move is refused.
    """

    def __init__(
        self,
        clicks: ClickToMove,
        newest: Newest,
        move: PlannedMove,
        track: TipTrack,
        *,
        now_s: float,
        before: Image | None = None,
        confirmed: bool = False,
        clear: bool = False,
        permit: Permit | None = None,
    ) -> None:
        self._clicks, self._goal, self._stage = clicks, move.pixel, move.stage
        self._track, self._ghost, self._before = track, move.ghost, before
        self._clear = clear
        self._looking = SettledFrameGrabber(clicks.session, newest, permit=permit)
        clicks.go(move, confirmed=confirmed, permit=self._looking.permit)
        self._looking.begin(now_s)
        self.status = VisitStatus(Visit.UNDER_WAY)

    def step(self, now_s: float) -> VisitStatus:
        """Advance; never raises for what a device or a camera does."""
        if self.ended:
            return self.status
        try:
            look = self._looking.step(now_s)
            if look is not None:
                self._judge(look, now_s)
        except InputError as error:
            self.status = replace(self.status, visit=Visit.FAILED, reason=str(error))
        return self.status

    @property
    def ended(self) -> bool:
        """Whether the run has ended."""
        return self.status.visit is not Visit.UNDER_WAY

    def abort(self, reason: str) -> None:
        """Stop the machine and end; it stays where it is."""
        if not self.ended:
            self._clicks.session.stop(reason)
            self.status = replace(self.status, visit=Visit.FAILED, reason=reason)

    def _judge(self, look: SettledFrame, now_s: float) -> None:
        tip = self._seen(look)
        miss = self._goal - tip
        self.status = replace(self.status, miss=miss)
        distance = float(np.linalg.norm(miss))
        if distance <= TOLERANCE_PX:
            self.status = replace(self.status, visit=Visit.ARRIVED)
            return
        if distance > _MOST_CORRECTION_PX:
            raise MicroscopeError(
                message(
                    "engine",
                    "the tip is {distance} px from its target, but at most {most} px are "
                    "permitted after a move; the calibration is no longer valid: calibrate "
                    "again",
                ).fill(distance=fixed(distance, 0), most=fixed(_MOST_CORRECTION_PX, 0))
            )
        if self.status.corrections >= CORRECTIONS:
            raise MicroscopeError(
                message(
                    "engine",
                    "the tip is still {distance} px off after {n} corrections; at most "
                    "{most} px are permitted: the stage drifts, or its resolution is too coarse",
                ).fill(
                    distance=fixed(distance, 2),
                    n=CORRECTIONS,
                    most=rounded(TOLERANCE_PX, 6),
                )
            )
        self._ghost = self._goal
        move = self._correction(tip)
        self._looking.check()
        self._clicks.go(move, permit=self._looking.permit)
        self.status = replace(self.status, corrections=self.status.corrections + 1)
        self._looking.begin(now_s)

    def _correction(self, tip: FloatArray) -> PlannedMove:
        """Correct with the nano stage where it is calibrated and reaches."""
        return self._clicks.plan(
            self._goal, stage=NANO if self._stage == NANO else None, tip_px=tip
        )

    def _seen(self, look: SettledFrame) -> FloatArray:
        """Find the tip about where it should be."""
        track = self._track
        middle = np.rint(self._ghost).astype(int)
        low = np.maximum(middle - 2 * _LOOKED_PX, 0)
        high = np.minimum(middle + 2 * _LOOKED_PX, look.image.shape[::-1])
        window = slice(low[1], high[1]), slice(low[0], high[0])
        part, depth = self._alone(look.image[window], window), track.depth.distance
        score, place = likeliest(part, track.pipette, (depth,), 2, _LOOKED_PX)
        fit = fit_tip(part, track.pipette, place, depth) if score > 0.0 else None
        if fit is None or not plausible(fit):
            raise MicroscopeError(
                message(
                    "engine",
                    "the tip is not visible near {column}, {row} px, where it should be; "
                    "motion has ended: check the picture",
                ).fill(column=fixed(self._ghost[0], 0), row=fixed(self._ghost[1], 0))
            )
        return np.asarray(fit.pixel + low)

    def _alone(self, part: Image, window: tuple[slice, slice]) -> Image:
        """Return the part without what was there before, if the tip was not."""
        before, track = self._before, self._track
        if before is None or before[window].shape != part.shape:
            return part
        if self._clear:
            return relative_to(part, before[window])
        corner = np.array([window[1].start, window[0].start])
        covered = track.pipette.drawn(track.pixel - corner, track.depth.distance, part.shape)[0]
        return part if covered.max() > _COVERED else relative_to(part, before[window])
