"""Conversion of a click in the picture into a move of the tip.

A pixel becomes a displacement of the tip through the calibration, and that becomes targets of the
stage's axes: the tables' x and y, or thx, thy (and zn, which keeps the height) within their range.
Limits and keep-out are the session's.
"""

from dataclasses import dataclass

import numpy as np

from rotemina.app.microscope.calibration_file import MICRO, NANO, MicroscopeCalibration, View
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras.frame import Frame
from rotemina.drivers.gate import Permit
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.inverse import solve_nano
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, fixed
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError, check_target

OWNER = "click"
CONFIRM_M = 100e-6  # moves of the tip beyond this are confirmed first


@dataclass(frozen=True, slots=True, eq=False)
class PlannedMove:
    """The planned move for a click; nothing has moved.

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
        """Plan the move for a click.

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

    def go(
        self, move: PlannedMove, *, confirmed: bool = False, permit: Permit | None = None
    ) -> None:
        """Send a planned move, with the permit of the plan that it is a part of.

        Raises
        ------
        MicroscopeError
            If it must be confirmed and was not.
        OutOfLimitsError, RefusedError
            What the session says: keep-out, owners, locks.
        """
        if not confirmed:
            self.check(move)
        self.session.go_to(move.targets, OWNER, permit=permit)

    def check(self, move: PlannedMove) -> None:
        """Refuse a move that must be confirmed, with MicroscopeError."""
        if move.confirm:
            raise MicroscopeError(
                message(
                    "engine",
                    "the tip would move {distance}, more than {confirm_m}; confirm the move first",
                ).fill(distance=exact(move.distance, "m"), confirm_m=exact(self.confirm_m, "m"))
            )

    def _calibrated(self) -> MicroscopeCalibration:
        if self.calibration is None:
            raise MicroscopeError(
                message(
                    "engine",
                    "the camera is not calibrated with this objective; calibrate it before "
                    "clicking",
                )
            )
        return self.calibration

    def _joints(self) -> FloatArray:
        command = self.session.snapshot().command
        if not command:
            raise MicroscopeError(
                message("engine", "no position is known; connect the machine first")
            )
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


def _check_click(pixel: FloatArray, view: View, frame: Frame | None) -> None:
    if frame is not None and View.of(frame.region) != view:
        shown = frame.region
        raise MicroscopeError(
            message(
                "engine",
                "the camera shows {width} × {height} px from {left}, {top}, but the "
                "calibration is for {view_width} × {view_height} px from {view_left}, "
                "{view_top}; restore the region of the camera, or calibrate again",
            ).fill(
                width=shown.width,
                height=shown.height,
                left=shown.left,
                top=shown.top,
                view_width=view.width,
                view_height=view.height,
                view_left=view.left,
                view_top=view.top,
            )
        )
    if not (np.isfinite(pixel).all() and view.holds(pixel)):
        raise MicroscopeError(
            message(
                "engine",
                "the click at {x}, {y} px is outside the calibrated field, 0 to {width} "
                "and 0 to {height} px; click inside",
            ).fill(
                x=fixed(pixel[0], 0),
                y=fixed(pixel[1], 0),
                width=view.width - 1,
                height=view.height - 1,
            )
        )
