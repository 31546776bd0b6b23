"""Conversion of a click in the picture into a move of the tip.

The calibration converts a pixel into a displacement of the tip. The displacement is converted into
targets of the stage's axes: x and y of the micro stage, or thx and thy of the nano stage, with zn
to keep the height. The targets lie within the ranges of the axes. The session checks limits and
keep-out.
"""

from dataclasses import dataclass

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.calibration_file import (
    MICRO,
    NANO,
    CalibratedRegion,
    MicroscopeCalibration,
)
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras import CameraFrame
from rotemina.drivers.contract import Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.kinematics import JOINTS, KinematicChain, compute_tip_position, solve_nano
from rotemina.sim.messages import format_fixed
from rotemina.sim.trajectory import check_target
from rotemina.sim.units import format_exact

CLICK_OWNER = "click"
# The operator must confirm a move of the tip that is longer than this.
MIN_CONFIRMED_MOVE_M = 100e-6


@dataclass(frozen=True, slots=True, eq=False)
class PlannedMove:
    """The planned move for a click; nothing has moved yet.

    Attributes
    ----------
    pixel : (2,)
        The clicked pixel.
    ghost : (2,)
        The pixel at which the tip should be seen after the move.
    uncertainty_px : float
        Uncertainty of ``ghost`` due to the calibration, px.
    stage : str
        ``micro`` or ``nano``.
    targets : dict axis -> float
        Axis targets, m or rad.
    distance : float
        Distance that the tip moves, m.
    needs_confirmation : bool
        Whether the move is so large that the operator must confirm it.
    """

    pixel: FloatArray
    predicted_px: FloatArray
    uncertainty_px: float
    stage: str
    targets: dict[str, float]
    distance: float
    needs_confirmation: bool


class ClickMover:
    """Plans the moves for clicks, and sends them to the session.

    Parameters
    ----------
    session : MotionSession
    calibration : MicroscopeCalibration or None
    confirm_m : float
        :meth:`go` requires a confirmation if the tip moves farther than this, m.
    """

    def __init__(
        self,
        session: MotionSession,
        calibration: MicroscopeCalibration | None,
        *,
        confirm_m: float = MIN_CONFIRMED_MOVE_M,
    ) -> None:
        self.session = session
        self.calibration = calibration
        self.confirm_m = confirm_m
        self._chain = KinematicChain.of(session.robot)

    def predict_tip_pixel(self, stage: str = MICRO) -> FloatArray:
        """Predict the tip's pixel (2,) from the calibration and the commanded position.

        Raises
        ------
        MicroscopeError
            If the stage is not calibrated, or the position is unknown.
        """
        return (
            self._require_calibration()
            .get_stage(stage)
            .predict_pixel(compute_tip_position(self._chain, self._read_joints()))
        )

    def plan(
        self,
        pixel: FloatArray,
        *,
        stage: str | None = None,
        tip_px: FloatArray | None = None,
        frame: CameraFrame | None = None,
    ) -> PlannedMove:
        """Plan the move for a click.

        Parameters
        ----------
        pixel : (2,)
            The clicked pixel, the goal of the tip.
        stage : str, optional
            ``micro`` or ``nano``; by default nano if it is calibrated and reaches the goal,
            otherwise micro.
        tip_px : (2,), optional
            Current pixel of the tip; by default the predicted one.
        frame : CameraFrame, optional
            The picture in which the user clicked; it must show the calibrated region.

        Raises
        ------
        MicroscopeError
            If nothing is calibrated, or the click is outside the calibrated field.
        OutOfLimitsError
            If an axis does not reach its target.
        """
        calibration = self._require_calibration()
        _check_click(np.asarray(pixel, dtype=np.float64), calibration.view, frame)
        if stage is not None:
            return self._plan_for_stage(np.asarray(pixel, dtype=np.float64), stage, tip_px)
        if calibration.nano is not None:
            try:
                return self._plan_for_stage(np.asarray(pixel, dtype=np.float64), NANO, tip_px)
            except OutOfLimitsError:
                if calibration.micro is None:
                    raise
        return self._plan_for_stage(np.asarray(pixel, dtype=np.float64), MICRO, tip_px)

    def go(
        self, move: PlannedMove, *, confirmed: bool = False, permit: Permit | None = None
    ) -> None:
        """Send a planned move with the permit of the run that it belongs to.

        Raises
        ------
        MicroscopeError
            If the move needs a confirmation and has none.
        OutOfLimitsError, RequestRefusedError
            If the session refuses it because of limits, keep-out, ownership or a lock.
        """
        if not confirmed:
            self.require_confirmation(move)
        self.session.go_to(move.targets, CLICK_OWNER, permit=permit)

    def require_confirmation(self, move: PlannedMove) -> None:
        """Raise MicroscopeError if the move needs a confirmation."""
        if move.needs_confirmation:
            raise MicroscopeError(
                "the tip would move {distance}, more than {confirm_m}; confirm the move first",
                distance=format_exact(move.distance, "m"),
                confirm_m=format_exact(self.confirm_m, "m"),
            )

    def _require_calibration(self) -> MicroscopeCalibration:
        if self.calibration is None:
            raise MicroscopeError(
                "the camera is not calibrated with this objective; calibrate it before clicking"
            )
        return self.calibration

    def _read_joints(self) -> FloatArray:
        command = self.session.snapshot().command
        if not command:
            raise MicroscopeError("no position is known; connect the machine first")
        return np.array([command[axis] for axis in JOINTS])

    def _plan_for_stage(
        self, pixel: FloatArray, stage: str, tip_px: FloatArray | None
    ) -> PlannedMove:
        calibration = self._require_calibration().get_stage(stage)
        joints = self._read_joints()
        tip_now_px = (
            self.predict_tip_pixel(stage)
            if tip_px is None
            else np.asarray(tip_px, dtype=np.float64)
        )
        displacement = calibration.map.displacement_of(pixel - tip_now_px)
        targets = self._compute_targets(stage, joints, displacement)
        for axis, target in targets.items():
            check_target(self.session.robot, axis, target)
        target_joints = joints.copy()
        for axis, target in targets.items():
            target_joints[JOINTS.index(axis)] = target
        tip_move_m = compute_tip_position(self._chain, target_joints) - compute_tip_position(
            self._chain, joints
        )
        distance = float(np.linalg.norm(tip_move_m))
        return PlannedMove(
            pixel=pixel,
            predicted_px=tip_now_px + calibration.map.shift_of(tip_move_m[:2]),
            uncertainty_px=calibration.map.uncertainty_px(tip_move_m[:2]),
            stage=stage,
            targets=targets,
            distance=distance,
            needs_confirmation=distance > self.confirm_m,
        )

    def _compute_targets(
        self, stage: str, joints: FloatArray, displacement: FloatArray
    ) -> dict[str, float]:
        if stage == MICRO:
            return {axis: float(joints[i] + displacement[i]) for i, axis in enumerate(("x", "y"))}
        goal = compute_tip_position(self._chain, joints) + np.append(displacement, 0.0)
        solution = solve_nano(self._chain, goal, joints)
        return {axis: float(solution[JOINTS.index(axis)]) for axis in ("thx", "thy", "zn")}


def _check_click(pixel: FloatArray, view: CalibratedRegion, frame: CameraFrame | None) -> None:
    if frame is not None and CalibratedRegion.from_region(frame.region) != view:
        region = frame.region
        raise MicroscopeError(
            "the camera shows {width} × {height} px from {left}, {top}, but the "
            "calibration is for {view_width} × {view_height} px from {view_left}, "
            "{view_top}; restore the region of the camera, or calibrate again",
            width=region.width,
            height=region.height,
            left=region.left,
            top=region.top,
            view_width=view.width,
            view_height=view.height,
            view_left=view.left,
            view_top=view.top,
        )
    if not (np.isfinite(pixel).all() and view.contains(pixel)):
        raise MicroscopeError(
            "the click at {x}, {y} px is outside the calibrated field, 0 to {width} "
            "and 0 to {height} px; click inside",
            x=format_fixed(pixel[0], 0),
            y=format_fixed(pixel[1], 0),
            width=view.width - 1,
            height=view.height - 1,
        )
