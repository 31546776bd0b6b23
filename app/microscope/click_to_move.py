"""A click in the picture made into a move of the tip, and the look whether it got there.

A pixel becomes a displacement of the tip through the calibration, and that becomes targets of the
stage's axes: the tables' x and y, or thx, thy (and zn, which keeps the height) within their range.
Limits and keep-out are the session's.
"""

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from rotemina.app.microscope.calibration_file import MICRO, NANO, MicroscopeCalibration, View
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.look import Look, Looking, Newest
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras.frame import Frame
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.inverse import solve_nano
from rotemina.sim.trajectory.limits import OutOfLimitsError, check_target
from rotemina.sim.trajectory.wording import readable
from rotemina.sim.vision.image import Image, over
from rotemina.sim.vision.tip import fit_tip, likeliest, plausible
from rotemina.sim.vision.tracking import TipTrack

OWNER = "click"
CONFIRM_M = 100e-6  # moves of the tip beyond this are confirmed first
TOLERANCE_PX = 0.3
CORRECTIONS = 4
_MOST_CORRECTION_PX = 30.0  # farther off than this is no matter of refinement
_LOOKED_PX = 48
_COVERED = 0.02  # share of a pixel that a pipette may still shade


@dataclass(frozen=True, slots=True, eq=False)
class PlannedMove:
    """A click thought through; nothing has moved.

    Attributes
    ----------
    pixel : (2,)
        Where it was clicked.
    ghost : (2,)
        Where the tip would be seen, px.
    uncertainty_px : float
        By how much the calibration alone may miss.
    stage : str
    targets : dict axis -> float
        m or rad.
    distance : float
        Of the tip's way, m.
    confirm : bool
        Whether the move is so large that it must be confirmed.
    """

    pixel: FloatArray
    ghost: FloatArray
    uncertainty_px: float
    stage: str
    targets: dict[str, float]
    distance: float
    confirm: bool


class ClickToMove:
    """Plans moves and sends them.

    Parameters
    ----------
    session : MotionSession
    calibration : MicroscopeCalibration or None
    confirm_m : float
        The tip's way beyond which :meth:`go` wants a confirmation.
    """

    def __init__(
        self,
        session: MotionSession,
        calibration: MicroscopeCalibration | None,
        *,
        confirm_m: float = CONFIRM_M,
    ) -> None:
        self.session = session
        self.calibration = calibration
        self.confirm_m = confirm_m
        self._chain = Chain.of(session.robot)

    def tip_pixel(self, stage: str = MICRO) -> FloatArray:
        """Return where the tip should be seen now by calibration and commands, px.

        Raises
        ------
        MicroscopeError
            If the stage is not calibrated, or no position is known.
        """
        return self._calibrated().stage(stage).pixel_of(tip_position(self._chain, self._joints()))

    def plan(
        self,
        pixel: FloatArray,
        *,
        stage: str | None = None,
        tip_px: FloatArray | None = None,
        frame: Frame | None = None,
    ) -> PlannedMove:
        """Think a click through.

        Parameters
        ----------
        pixel : (2,)
            Where the tip is to go.
        stage : str, optional
            ``micro`` or ``nano``; by default nano where it is calibrated and reaches, else micro.
        tip_px : (2,), optional
            Where the tip is seen now; by default where it should be.
        frame : Frame, optional
            The picture that was clicked in: it must show what was calibrated.

        Raises
        ------
        MicroscopeError
            If nothing is calibrated, or the click is outside the calibrated field.
        OutOfLimitsError
            If an axis does not reach.
        """
        calibration = self._calibrated()
        _check_click(np.asarray(pixel, dtype=np.float64), calibration.view, frame)
        if stage is not None:
            return self._planned(np.asarray(pixel, dtype=np.float64), stage, tip_px)
        if calibration.nano is not None:
            try:
                return self._planned(np.asarray(pixel, dtype=np.float64), NANO, tip_px)
            except OutOfLimitsError:
                if calibration.micro is None:
                    raise
        return self._planned(np.asarray(pixel, dtype=np.float64), MICRO, tip_px)

    def go(self, move: PlannedMove, *, confirmed: bool = False) -> None:
        """Send a planned move.

        Raises
        ------
        MicroscopeError
            If it must be confirmed and was not.
        OutOfLimitsError, RefusedError
            What the session says: keep-out, owners, locks.
        """
        if move.confirm and not confirmed:
            raise MicroscopeError(
                f"the tip would go {readable(move.distance, 'm')}, more than "
                f"{readable(self.confirm_m, 'm')}; confirm the move first"
            )
        self.session.go_to(move.targets, OWNER)

    def go_back(self) -> None:
        """Return to where the machine rested before its latest move; raises as ``undo``."""
        self.session.undo()

    def _calibrated(self) -> MicroscopeCalibration:
        if self.calibration is None:
            raise MicroscopeError(
                "the camera is not calibrated with this objective; calibrate it before clicking"
            )
        return self.calibration

    def _joints(self) -> FloatArray:
        command = self.session.snapshot().command
        if not command:
            raise MicroscopeError("no position is known; connect the machine first")
        return np.array([command[axis] for axis in JOINTS])

    def _planned(self, pixel: FloatArray, stage: str, tip_px: FloatArray | None) -> PlannedMove:
        known = self._calibrated().stage(stage)
        joints = self._joints()
        here = self.tip_pixel(stage) if tip_px is None else np.asarray(tip_px, dtype=np.float64)
        moved = known.map.displacement(pixel - here)
        targets = self._targets(stage, joints, moved)
        for axis, target in targets.items():
            check_target(self.session.robot, axis, target)
        there = joints.copy()
        for axis, target in targets.items():
            there[JOINTS.index(axis)] = target
        tips = (tip_position(self._chain, places) for places in (there, joints))
        way = next(tips) - next(tips)
        distance = float(np.linalg.norm(way))
        return PlannedMove(
            pixel=pixel,
            ghost=here + known.map.pixels(way[:2]),
            uncertainty_px=known.map.uncertainty_px(way[:2]),
            stage=stage,
            targets=targets,
            distance=distance,
            confirm=distance > self.confirm_m,
        )

    def _targets(self, stage: str, joints: FloatArray, moved: FloatArray) -> dict[str, float]:
        if stage == MICRO:
            return {axis: float(joints[i] + moved[i]) for i, axis in enumerate(("x", "y"))}
        goal = tip_position(self._chain, joints) + np.append(moved, 0.0)
        solved = solve_nano(self._chain, goal, joints)
        return {axis: float(solved[JOINTS.index(axis)]) for axis in ("thx", "thy", "zn")}


class Visit(StrEnum):
    """How a visit to a clicked place goes on."""

    UNDER_WAY = "under way"
    ARRIVED = "arrived"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, eq=False)
class VisitStatus:
    """What is to be shown: the latest miss (2,), px, seen after so many corrections."""

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
    tolerance_px : float
    corrections : int
        At most.
    confirmed : bool

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
        tolerance_px: float = TOLERANCE_PX,
        corrections: int = CORRECTIONS,
        confirmed: bool = False,
    ) -> None:
        self._clicks, self._goal, self._stage = clicks, move.pixel, move.stage
        self._track, self._ghost, self._before = track, move.ghost, before
        self._tolerance_px, self._corrections = tolerance_px, corrections
        self._looking = Looking(clicks.session, newest)
        clicks.go(move, confirmed=confirmed)
        self._looking.begin(now_s)
        self.status = VisitStatus(Visit.UNDER_WAY)

    def step(self, now_s: float) -> VisitStatus:
        """Go on; never raises for what a device or a camera does."""
        if self.status.visit is not Visit.UNDER_WAY:
            return self.status
        try:
            look = self._looking.step(now_s)
            if look is not None:
                self._judge(look, now_s)
        except InputError as error:
            self.status = replace(self.status, visit=Visit.FAILED, reason=str(error))
        return self.status

    def _judge(self, look: Look, now_s: float) -> None:
        tip = self._seen(look)
        miss = self._goal - tip
        self.status = replace(self.status, miss=miss)
        distance = float(np.linalg.norm(miss))
        if distance <= self._tolerance_px:
            self.status = replace(self.status, visit=Visit.ARRIVED)
            return
        if distance > _MOST_CORRECTION_PX:
            raise MicroscopeError(
                f"the tip is {distance:.0f} px from where it should be, must be at most "
                f"{_MOST_CORRECTION_PX:.0f} px after a move; the calibration does not hold: "
                "calibrate anew"
            )
        if self.status.corrections >= self._corrections:
            raise MicroscopeError(
                f"the tip is still {distance:.2f} px off after {self._corrections} corrections, "
                f"must be at most {self._tolerance_px:g} px; the stage resolves no finer, or drifts"
            )
        self._ghost = self._goal
        move = self._correction(tip)
        self._clicks.go(move)
        self.status = replace(self.status, corrections=self.status.corrections + 1)
        self._looking.begin(now_s)

    def _correction(self, tip: FloatArray) -> PlannedMove:
        """Correct with the nano stage where it is calibrated and reaches."""
        return self._clicks.plan(
            self._goal, stage=NANO if self._stage == NANO else None, tip_px=tip
        )

    def _seen(self, look: Look) -> FloatArray:
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
                f"the tip is not seen near {self._ghost[0]:.0f}, {self._ghost[1]:.0f} px, where it "
                "should be; nothing more is moved: look at the picture"
            )
        return np.asarray(fit.pixel + low)

    def _alone(self, part: Image, window: tuple[slice, slice]) -> Image:
        """Return the part without what was there before, if the tip was not."""
        before, track = self._before, self._track
        if before is None or before[window].shape != part.shape:
            return part
        corner = np.array([window[1].start, window[0].start])
        covered = track.pipette.drawn(track.pixel - corner, track.depth.distance, part.shape)[0]
        return part if covered.max() > _COVERED else over(part, before[window])


def _check_click(pixel: FloatArray, view: View, frame: Frame | None) -> None:
    if frame is not None and View.of(frame.region) != view:
        shown = frame.region
        raise MicroscopeError(
            f"the camera shows {shown.width} × {shown.height} px from {shown.left}, {shown.top}, "
            f"calibrated is {view.width} × {view.height} px from {view.left}, {view.top}; set the "
            "camera back, or calibrate anew"
        )
    if not (np.isfinite(pixel).all() and view.holds(pixel)):
        raise MicroscopeError(
            f"the click at {pixel[0]:.0f}, {pixel[1]:.0f} px is outside the calibrated field, "
            f"0 to {view.width - 1} and 0 to {view.height - 1} px; click inside"
        )
