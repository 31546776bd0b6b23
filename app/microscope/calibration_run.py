"""A guided calibration: small moves around the present position, a picture after each, a fit.

Somebody calls :meth:`CalibrationRun.step`; it has no thread and never waits. Every move goes
through the session, which knows limits, keep-out and owners; a refusal, a stop, a fault or a
camera that stands still ends the run with the reason. After a refusal it goes back to where it
began; after a stop or a fault nothing moves.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from enum import StrEnum

import numpy as np

from rotemina.app.microscope.calibration_file import MICRO, NANO, StageCalibration
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.settled_frame import Newest, SettledFrame, SettledFrameGrabber
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.session import MotionSession
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.inverse import solve_nano
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed, rounded
from rotemina.sim.trajectory.axis_limits import check_target
from rotemina.sim.vision.calibration import StageFit, fit_stage
from rotemina.sim.vision.image import Image
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.registration import register
from rotemina.sim.vision.tip import find_body, find_tip, fit_depths, likeliest
from rotemina.sim.vision.tip_fit import TipFit

OWNER = "calibration"
EXTENT_M = {MICRO: 40e-6, NANO: 15e-6}  # of the tip, each way from where it is
_RING = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (0, 0))
_MOST_DRIFT_PX = 1.0  # between the first and the last picture, both from the same place
_SEARCHED_PX = 24.0  # about where the tip should be, once that is known


class Phase(StrEnum):
    """Where a calibration is."""

    LOOKING = "looking"
    RETURNING = "returning"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """One move: the tip's displacement (2,), m, the image's (2,), px, and its covariance."""

    displacement: FloatArray
    shift: FloatArray
    covariance: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class CalibrationStatus:
    """Status for display.

    Attributes
    ----------
    phase : Phase
    done, moves : int
        Looks taken, and how many it takes.
    observations : tuple of Observation
    fit : StageFit or None
        With the residuals, once it was fitted; also where it was refused.
    calibration : StageCalibration or None
        The result.
    reason : str
        Why it failed.
    """

    phase: Phase
    done: int
    moves: int
    observations: tuple[Observation, ...] = ()
    fit: StageFit | None = None
    calibration: StageCalibration | None = None
    reason: str = ""


class CalibrationRun:
    """Calibrates one stage.

    Parameters
    ----------
    session : MotionSession
    newest : callable
        The camera's newest picture.
    stage : str
        ``micro`` or ``nano``.
    pipette : Pipette, optional
        What the tip looks like: the background stands and the tip moves. Without one the whole
        picture must move with the stage.
    now_s : float
        The host's time.
    direction_known : bool
        Whether the pipette's direction is roughly right; else it is found along with the tip.
    today : callable
        Return date and time, for the file.

    Raises
    ------
    InputError
        If the robot has no such chain, a move would leave an axis' range, or motion is locked;
        then nothing has moved.
    """

    def __init__(
        self,
        session: MotionSession,
        newest: Newest,
        stage: str,
        pipette: Pipette | None,
        *,
        now_s: float,
        direction_known: bool = True,
        today: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        self._session, self._stage, self._pipette = session, stage, pipette
        self._today = today
        self._find = find_tip if direction_known else find_body
        self._chain = Chain.of(session.robot)
        state = session.snapshot()
        if state.locked is not None:
            raise RefusedError(
                message("engine", "motion is locked: {locked}").fill(locked=state.locked)
            )
        self._axes = ("x", "y") if stage == MICRO else ("thx", "thy", "zn")
        self._begin = {axis: state.command[axis] for axis in self._axes}
        joints = np.array([state.command[axis] for axis in JOINTS])
        self._plan = tuple(self._targets(joints, EXTENT_M[stage] * np.array(way)) for way in _RING)
        self._looking = SettledFrameGrabber(session, newest)
        self._looking.begin(now_s)
        self._first: tuple[SettledFrame, TipFit | None] | None = None
        self._status = CalibrationStatus(Phase.LOOKING, 0, len(self._plan) + 1)

    @property
    def status(self) -> CalibrationStatus:
        """Status for display."""
        return self._status

    @property
    def pipette(self) -> Pipette | None:
        """The pipette with the direction in which it was found; what to track it by."""
        return self._pipette

    def step(self, now_s: float) -> CalibrationStatus:
        """Advance; never raises for what a device or a camera does."""
        phase = self._status.phase
        if phase not in (Phase.LOOKING, Phase.RETURNING):
            return self._status
        try:
            look = self._looking.step(now_s)
        except InputError as error:
            # What stands between machine and program, or camera and program: nothing is moved.
            self._end(Phase.FAILED, self._status.reason or str(error))
            return self._status
        if look is None:
            return self._status
        if phase is Phase.RETURNING:
            self._end(Phase.FAILED if self._status.reason else Phase.DONE, self._status.reason)
            return self._status
        try:
            self._observe(look)
            self._go_on(now_s)
        except InputError as error:
            self._go_back(str(error), now_s)
        return self._status

    @property
    def ended(self) -> bool:
        """Whether the run has ended."""
        return self._status.phase in (Phase.DONE, Phase.FAILED)

    def abort(self, reason: str = message("engine", "the calibration was stopped")) -> None:
        """Stop the machine and end; it stays where it is."""
        if not self.ended:
            self._session.stop(reason)
            self._end(Phase.FAILED, reason)

    # --- the moves --------------------------------------------------------------------------------

    def _targets(self, joints: FloatArray, away_m: FloatArray) -> dict[str, float]:
        """Return axis targets that displace the tip by ``away_m`` (2,), m; checked."""
        goal = tip_position(self._chain, joints) + np.append(away_m, 0.0)
        if self._stage == MICRO:
            targets = {axis: self._begin[axis] + away_m[i] for i, axis in enumerate(self._axes)}
        else:
            solved = solve_nano(self._chain, goal, joints)
            targets = {axis: float(solved[JOINTS.index(axis)]) for axis in self._axes}
        for axis, target in targets.items():
            check_target(self._session.robot, axis, float(target))
        return {axis: float(target) for axis, target in targets.items()}

    def _go_on(self, now_s: float) -> None:
        done = self._status.done
        if done <= len(self._plan) - 1:
            self._looking.check()
            self._session.go_to(self._plan[done], OWNER, permit=self._looking.permit)
        else:
            self._finish()
            self._go_back("", now_s)
            return
        self._status = replace(self._status, done=done + 1)
        self._looking.begin(now_s)

    def _go_back(self, reason: str, now_s: float) -> None:
        """Return to where it began; a refusal of that ends it where it is."""
        self._status = replace(self._status, phase=Phase.RETURNING, reason=reason)
        try:
            self._looking.check()
            self._session.go_to(self._begin, OWNER, permit=self._looking.permit)
        except InputError as error:
            self._end(
                Phase.FAILED,
                message("engine", "{reason}; the return failed: {error}").fill(
                    reason=reason or "calibrated", error=str(error)
                ),
            )
            return
        self._looking.begin(now_s)

    def _end(self, phase: Phase, reason: str) -> None:
        self._status = replace(self._status, phase=phase, reason=reason)

    # --- what is seen -----------------------------------------------------------------------------

    def _observe(self, look: SettledFrame) -> None:
        if self._first is None:
            self._first = look, self._tip(look.image, None)
            return
        first, tip = self._first
        if tip is not None:
            fit = self._tip(look.image, self._expected(tip, look))
            assert fit is not None
            shift, spread = fit.pixel - tip.pixel, fit.covariance
        else:
            found = register(first.image, look.image)
            shift, spread = found.shift, found.covariance
        displacement = self._tip_m(look)[:2] - self._tip_m(first)[:2]
        seen = (*self._status.observations, Observation(displacement, shift, spread))
        self._status = replace(self._status, observations=seen)

    def _tip(self, image: Image, expected: FloatArray | None) -> TipFit | None:
        """Find the tip, in the whole picture or about where it should be; None without one."""
        pipette = self._pipette
        if pipette is None:
            return None
        if expected is None:
            fit = self._find(image, pipette)
            # Its direction is found with it, and kept.
            self._pipette = replace(pipette, direction=fit.direction)
            return fit
        half = round(_SEARCHED_PX) + 48
        low = np.maximum(np.rint(expected).astype(int) - half, 0)
        part = image[low[1] : low[1] + 2 * half, low[0] : low[0] + 2 * half]
        depth = self._first[1].depth.distance if self._first and self._first[1] else 0.0
        _, place = likeliest(part, pipette, (depth,), 2, 48)
        found = fit_depths(image, pipette, place + low, (depth,), turning=False)
        return find_tip(image, pipette, turning=False) if found is None else found

    def _expected(self, tip: TipFit, look: SettledFrame) -> FloatArray | None:
        """Return where the tip should be by what was seen so far; None before that tells."""
        seen = self._status.observations
        if len(seen) < 3:
            return None
        moves = np.stack([one.displacement for one in seen])
        shifts = np.stack([one.shift for one in seen])
        matrix = np.linalg.lstsq(moves, shifts, rcond=None)[0]
        assert self._first is not None
        moved = self._tip_m(look)[:2] - self._tip_m(self._first[0])[:2]
        return np.asarray(tip.pixel + moved @ matrix)

    def _tip_m(self, look: SettledFrame) -> FloatArray:
        """Return the tip (3,), m, by what the moved stage's sensors say, else by command."""
        axes, robot = self._session.driver.axes, self._session.robot
        places = dict(zip(axes, look.command.tolist(), strict=True))
        for axis, value in zip(axes, look.measured.tolist(), strict=True):
            if axis in self._axes and axis != "zn":
                places[axis] = value - robot.axes[axis].offset
        return tip_position(self._chain, np.array([places[axis] for axis in JOINTS]))

    def _finish(self) -> None:
        """Fit; the last look is from where the first one was, and shows what drifted."""
        assert self._first is not None
        seen = self._status.observations
        drift = float(np.linalg.norm(seen[-1].shift))
        if drift > _MOST_DRIFT_PX:
            raise MicroscopeError(
                message(
                    "engine",
                    "the picture drifted by {drift} px during the calibration; at most "
                    "{most} px are permitted: let stage and camera settle, reduce backlash, "
                    "and start again",
                ).fill(drift=fixed(drift, 1), most=rounded(_MOST_DRIFT_PX, 6))
            )
        first, tip = self._first
        moves = np.stack([np.zeros(2), *(one.displacement for one in seen)])
        shifts = np.stack([np.zeros(2), *(one.shift for one in seen)])
        own = seen[-1].covariance if tip is None else tip.covariance
        spreads = np.stack([own, *(one.covariance for one in seen)])
        fit = fit_stage(moves, shifts, spreads)
        at_px = np.zeros(2) if tip is None else tip.pixel + fit.offset
        self._status = replace(
            self._status,
            fit=fit,
            calibration=StageCalibration.of(
                fit, self._today(), self._tip_m(first), np.asarray(at_px)
            ),
        )
