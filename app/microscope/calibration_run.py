"""A guided calibration: small moves around the current position, a picture after each, and a fit.

The run has no thread and never waits; its owner calls :meth:`StageCalibrationRun.step`. Every move
goes through the session, which checks limits, keep-out and ownership. A refused move, a stop, a
fault or a stalled camera ends the run with the reason. After a refused move the machine returns to
its start position; after a stop or a fault nothing moves. Once the moves are evaluated, only
:meth:`StageCalibrationRun.abort` discards the calibration; a failed return does not.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from enum import StrEnum

import numpy as np

from rotemina.app.errors import MicroscopeError, RequestRefusedError
from rotemina.app.microscope.calibration_file import MICRO, NANO, StageCalibration
from rotemina.app.microscope.settled_frame import FrameSource, SettledFrame, SettledFrameGrabber
from rotemina.app.motion.session import MotionSession
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics import JOINTS, KinematicChain, compute_tip_position, solve_nano
from rotemina.sim.messages import format_fixed, format_rounded, message
from rotemina.sim.trajectory import check_target
from rotemina.sim.vision import (
    Image,
    Pipette,
    StageFit,
    TipFit,
    find_likeliest_place,
    find_tip,
    find_tip_in_any_direction,
    fit_from_depths,
    fit_stage,
    register_images,
)

CALIBRATION_OWNER = "calibration"
# Displacement of the tip along x and along y in each move, by stage.
MOVE_SIZE_M = {MICRO: 40e-6, NANO: 15e-6}
# The last move returns to the start position, where the picture shows the drift.
_MOVE_DIRECTIONS = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (0, 0))
# Largest shift between the first and the last picture, both taken at the start position.
_MAX_DRIFT_PX = 1.0
_TEMPLATE_SIZE_PX = 48
# Margin of the search window around the predicted pixel, in addition to the template's size.
_SEARCH_MARGIN_PX = 24.0
# The search evaluates one of this many columns and rows.
_SEARCH_FACTOR = 2


class StageCalibrationPhase(StrEnum):
    """The phase of a calibration run."""

    MEASURING = "looking"
    RETURNING = "returning"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, eq=False)
class ShiftObservation:
    """The displacement of the tip in one move, and the shift seen in the picture.

    Attributes
    ----------
    displacement : (2,)
        Displacement of the tip from its start position, m.
    shift : (2,)
        Shift since the first picture, px.
    covariance : (2, 2)
        Covariance of the shift, px².
    """

    displacement: FloatArray
    shift: FloatArray
    covariance: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class StageCalibrationStatus:
    """Status of a calibration run, for display.

    Attributes
    ----------
    phase : StageCalibrationPhase
    pictures_taken, pictures_total : int
        Progress: settled pictures taken so far, and the number that the run needs.
    observations : tuple of ShiftObservation
    fit : StageFit or None
        The fit with its residuals; None until the moves are evaluated.
    calibration : StageCalibration or None
        The result; None until the moves are evaluated.
    reason : str
        Why the run failed or, if it is done, why the return to the start position failed; else
        empty.
    """

    phase: StageCalibrationPhase
    pictures_taken: int
    pictures_total: int
    observations: tuple[ShiftObservation, ...] = ()
    fit: StageFit | None = None
    calibration: StageCalibration | None = None
    reason: str = ""


class StageCalibrationRun:
    """A run that calibrates one stage.

    Parameters
    ----------
    session : MotionSession
    newest_frame : callable
        Returns the camera's newest picture.
    stage : str
        ``micro`` or ``nano``.
    pipette : Pipette, optional
        Shape of the tip, which moves in front of a stationary background. If it is None, the whole
        picture must move with the stage.
    now_s : float
        Host time.
    direction_known : bool
        Whether the pipette's direction is approximately correct. If not, the search for the tip
        also finds the direction.
    read_date : callable
        Returns the date and time that is stored in the calibration file.

    Raises
    ------
    InputError
        If the robot has no kinematic chain to the tip, a move would leave the range of an axis, or
        motion is locked; then nothing has moved.
    """

    def __init__(
        self,
        session: MotionSession,
        newest_frame: FrameSource,
        stage: str,
        pipette: Pipette | None,
        *,
        now_s: float,
        direction_known: bool = True,
        read_date: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        self._session, self._stage, self._pipette = session, stage, pipette
        self._read_date = read_date
        self._search_whole_picture = find_tip if direction_known else find_tip_in_any_direction
        self._chain = KinematicChain.of(session.robot)
        state = session.snapshot()
        if state.lock_reason is not None:
            raise RequestRefusedError("motion is locked: {locked}", locked=state.lock_reason)
        self._axes = ("x", "y") if stage == MICRO else ("thx", "thy", "zn")
        self._start_command = {axis: state.command[axis] for axis in self._axes}
        joints = np.array([state.command[axis] for axis in JOINTS])
        self._planned_targets = tuple(
            self._compute_targets(joints, MOVE_SIZE_M[stage] * np.array(direction))
            for direction in _MOVE_DIRECTIONS
        )
        self._grabber = SettledFrameGrabber(session, newest_frame)
        self._grabber.begin(now_s)
        # The picture at the start position, and the tip in it.
        self._reference: tuple[SettledFrame, TipFit | None] | None = None
        self._status = StageCalibrationStatus(
            StageCalibrationPhase.MEASURING, 0, len(self._planned_targets) + 1
        )

    @property
    def status(self) -> StageCalibrationStatus:
        """Status of the run, for display."""
        return self._status

    @property
    def pipette(self) -> Pipette | None:
        """The pipette with the direction in which it was found, for tracking."""
        return self._pipette

    def step(self, now_s: float) -> StageCalibrationStatus:
        """Advance the run; a failure of a device or a camera ends the run and raises nothing."""
        phase = self._status.phase
        if phase not in (StageCalibrationPhase.MEASURING, StageCalibrationPhase.RETURNING):
            return self._status
        try:
            settled = self._grabber.step(now_s)
        except InputError as error:
            # The connection to the machine or the camera has failed, so nothing may move.
            if self._status.calibration is not None:
                self._end_without_return(error)
            else:
                self._end(StageCalibrationPhase.FAILED, self._status.reason or str(error))
            return self._status
        if settled is None:
            return self._status
        if phase is StageCalibrationPhase.RETURNING:
            self._end(
                StageCalibrationPhase.FAILED if self._status.reason else StageCalibrationPhase.DONE,
                self._status.reason,
            )
            return self._status
        try:
            self._observe(settled)
            self._continue(now_s)
        except InputError as error:
            self._start_return(str(error), now_s)
        return self._status

    @property
    def ended(self) -> bool:
        """Whether the run has ended."""
        return self._status.phase in (StageCalibrationPhase.DONE, StageCalibrationPhase.FAILED)

    def abort(self, reason: str = message("engine", "the calibration was stopped")) -> None:
        """Stop the machine, which stays where it is, and end the run."""
        if not self.ended:
            self._session.stop(reason)
            self._end(StageCalibrationPhase.FAILED, reason)

    def _compute_targets(self, joints: FloatArray, displacement_m: FloatArray) -> dict[str, float]:
        """Return checked axis targets that displace the tip by ``displacement_m`` (2,), m."""
        goal = compute_tip_position(self._chain, joints) + np.append(displacement_m, 0.0)
        if self._stage == MICRO:
            targets = {
                axis: self._start_command[axis] + displacement_m[i]
                for i, axis in enumerate(self._axes)
            }
        else:
            solution = solve_nano(self._chain, goal, joints)
            targets = {axis: float(solution[JOINTS.index(axis)]) for axis in self._axes}
        for axis, target in targets.items():
            check_target(self._session.robot, axis, float(target))
        return {axis: float(target) for axis, target in targets.items()}

    def _continue(self, now_s: float) -> None:
        """Start the next move after a picture; after the last picture, fit and return."""
        next_target = self._status.pictures_taken
        self._status = replace(self._status, pictures_taken=next_target + 1)
        if next_target < len(self._planned_targets):
            self._grabber.require_motion_permitted()
            self._session.go_to(
                self._planned_targets[next_target], CALIBRATION_OWNER, permit=self._grabber.permit
            )
            self._grabber.begin(now_s)
        else:
            self._fit_calibration()
            self._start_return("", now_s)

    def _start_return(self, reason: str, now_s: float) -> None:
        """Start the return to the start position; if that is refused, end the run at once."""
        self._status = replace(self._status, phase=StageCalibrationPhase.RETURNING, reason=reason)
        try:
            self._grabber.require_motion_permitted()
            self._session.go_to(self._start_command, CALIBRATION_OWNER, permit=self._grabber.permit)
        except InputError as error:
            self._end_without_return(error)
            return
        self._grabber.begin(now_s)

    def _end_without_return(self, error: InputError) -> None:
        """End the run because the return failed; a calibration that was found is kept."""
        if self._status.calibration is not None:
            text = message("engine", "the return to the start position failed: {error}")
            self._end(StageCalibrationPhase.DONE, text.fill(error=str(error)))
        else:
            text = message("engine", "{reason}; the return to the start position failed: {error}")
            self._end(
                StageCalibrationPhase.FAILED,
                text.fill(reason=self._status.reason, error=str(error)),
            )

    def _end(self, phase: StageCalibrationPhase, reason: str) -> None:
        self._status = replace(self._status, phase=phase, reason=reason)

    def _observe(self, settled: SettledFrame) -> None:
        if self._reference is None:
            self._reference = settled, self._find_tip(settled.image, None)
            return
        first, tip = self._reference
        if tip is not None:
            fit = self._find_tip(settled.image, self._predict_pixel(tip, settled))
            assert fit is not None
            shift, covariance = fit.pixel - tip.pixel, fit.covariance
        else:
            registration = register_images(first.image, settled.image)
            shift, covariance = registration.shift, registration.covariance
        displacement = self._compute_tip_m(settled)[:2] - self._compute_tip_m(first)[:2]
        observations = (
            *self._status.observations,
            ShiftObservation(displacement, shift, covariance),
        )
        self._status = replace(self._status, observations=observations)

    def _find_tip(self, image: Image, predicted_px: FloatArray | None) -> TipFit | None:
        """Find the tip near the predicted pixel, or in the whole picture if that is None.

        Return None if the run has no pipette.
        """
        pipette = self._pipette
        if pipette is None:
            return None
        if predicted_px is None:
            fit = self._search_whole_picture(image, pipette)
            # The search also gives the direction of the pipette, which later searches need.
            self._pipette = replace(pipette, direction=fit.direction)
            return fit
        half_width = round(_SEARCH_MARGIN_PX) + _TEMPLATE_SIZE_PX
        corner = np.maximum(np.rint(predicted_px).astype(int) - half_width, 0)
        window_image = image[
            corner[1] : corner[1] + 2 * half_width, corner[0] : corner[0] + 2 * half_width
        ]
        depth = self._reference[1].depth.distance if self._reference and self._reference[1] else 0.0
        _, offset = find_likeliest_place(
            window_image, pipette, (depth,), _SEARCH_FACTOR, _TEMPLATE_SIZE_PX
        )
        local_fit = fit_from_depths(image, pipette, offset + corner, (depth,), fit_direction=False)
        return find_tip(image, pipette, turning=False) if local_fit is None else local_fit

    def _predict_pixel(self, tip: TipFit, settled: SettledFrame) -> FloatArray | None:
        """Predict the tip's pixel from the observations so far.

        Return None while there are fewer than three, which are too few for a fit.
        """
        observations = self._status.observations
        if len(observations) < 3:
            return None
        moves = np.stack([observation.displacement for observation in observations])
        shifts = np.stack([observation.shift for observation in observations])
        matrix = np.linalg.lstsq(moves, shifts, rcond=None)[0]
        assert self._reference is not None
        displacement = (
            self._compute_tip_m(settled)[:2] - self._compute_tip_m(self._reference[0])[:2]
        )
        return np.asarray(tip.pixel + displacement @ matrix)

    def _compute_tip_m(self, settled: SettledFrame) -> FloatArray:
        """Return the tip position (3,), m.

        The measured positions are used for the axes of the calibrated stage, except zn. The
        commanded positions are used for zn and for all other axes.
        """
        axes, robot = self._session.driver.axes, self._session.robot
        positions = dict(zip(axes, settled.command.tolist(), strict=True))
        for axis, value in zip(axes, settled.measured.tolist(), strict=True):
            if axis in self._axes and axis != "zn":
                positions[axis] = value - robot.axes[axis].offset
        return compute_tip_position(self._chain, np.array([positions[axis] for axis in JOINTS]))

    def _fit_calibration(self) -> None:
        """Fit the map of the stage.

        Raises
        ------
        MicroscopeError
            If the picture drifted. The first and the last picture, both taken at the start
            position, show the drift.
        """
        assert self._reference is not None
        observations = self._status.observations
        drift = float(np.linalg.norm(observations[-1].shift))
        if drift > _MAX_DRIFT_PX:
            raise MicroscopeError(
                "the picture drifted by {drift} px during the calibration; at most "
                "{most} px are permitted: let stage and camera settle, reduce backlash, "
                "and start again",
                drift=format_fixed(drift, 1),
                most=format_rounded(_MAX_DRIFT_PX, 6),
            )
        first, tip = self._reference
        moves = np.stack([np.zeros(2), *(observation.displacement for observation in observations)])
        shifts = np.stack([np.zeros(2), *(observation.shift for observation in observations)])
        first_covariance = observations[-1].covariance if tip is None else tip.covariance
        covariances = np.stack(
            [first_covariance, *(observation.covariance for observation in observations)]
        )
        fit = fit_stage(moves, shifts, covariances)
        tip_px = np.zeros(2) if tip is None else tip.pixel + fit.offset
        self._status = replace(
            self._status,
            fit=fit,
            calibration=StageCalibration.from_fit(
                fit, self._read_date(), self._compute_tip_m(first), np.asarray(tip_px)
            ),
        )
