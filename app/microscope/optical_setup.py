"""The camera and objective in use, with calibration, pipette and scale."""

import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.calibration_file import (
    CalibratedRegion,
    FocusCalibration,
    MicroscopeCalibration,
    StageCalibration,
    load_calibration,
    save_calibration,
)
from rotemina.app.microscope.camera_in_use import SIMULATED_SOURCE
from rotemina.app.microscope.optics import (
    compute_nominal_pixel_size_m,
    make_objective_name,
    make_pipette,
    with_simulated_optics,
)
from rotemina.app.microscope.status import ScaleSource
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras import Camera, SensorRegion
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ChainError
from rotemina.sim.kinematics import JOINTS, KinematicChain, compute_tip_position
from rotemina.sim.robot import Robot
from rotemina.sim.vision import Pipette

# Number of points along each side of the nano stage's field.
_POINTS_PER_SIDE = 9


class OpticalSetup:
    """The calibration of the camera and objective in use, with everything derived from it.

    There is one calibration file for each camera behind each objective.

    Parameters
    ----------
    session : MotionSession
    folder : Path
        Folder of the calibration files.
    camera : callable
        Returns the camera in use, or None.
    """

    def __init__(
        self, session: MotionSession, folder: Path, camera: Callable[[], Camera | None]
    ) -> None:
        self._session, self._folder, self._get_camera = session, folder, camera
        # Guards changes of the attributes below.
        self._lock = threading.Lock()
        # Camera key and objective of the loaded calibration.
        self._loaded_for: tuple[str, str] | None = None
        # Direction of the pipette in the picture, rad, by camera key.
        self._directions: dict[str, float] = {}
        self.objective = make_objective_name(with_simulated_optics(session.robot))
        self.objectives: tuple[str, ...] = (self.objective,)
        self.calibration: MicroscopeCalibration | None = None
        #: Why the stored calibration cannot be used.
        self.problem = ""
        try:
            self.chain: KinematicChain | None = KinematicChain.of(session.robot)
        except ChainError:
            self.chain = None

    @property
    def camera_key(self) -> str:
        """The key that identifies the camera in calibrations; empty without a camera."""
        camera = self._get_camera()
        return "" if camera is None else camera.identity.key

    @property
    def _robot(self) -> Robot:
        """The robot, completed with simulated optics and tool if the simulated camera is in use."""
        camera, robot = self._get_camera(), self._session.robot
        is_simulated = camera is not None and camera.identity.source == SIMULATED_SOURCE
        return with_simulated_optics(robot) if is_simulated else robot

    @property
    def scale(self) -> tuple[float | None, ScaleSource]:
        """The size of a pixel, m, and its source."""
        calibration = self.calibration
        stage = None if calibration is None else calibration.micro or calibration.nano
        if stage is not None:
            return float(np.mean(stage.map.geometry.pixel_size)), ScaleSource.CALIBRATION
        try:
            nominal_m = compute_nominal_pixel_size_m(self._robot, self.objective)
        except MicroscopeError:
            return None, ScaleSource.NONE
        return nominal_m, ScaleSource.ROBOT_FILE

    @property
    def pixel_m(self) -> float | None:
        """The size of a pixel, m."""
        return self.scale[0]

    def make_pipette(self) -> tuple[Pipette, bool]:
        """Return the shape of the tip in the picture, and whether its direction is known.

        Raises
        ------
        InputError
            If the robot file lacks data for the shape, or the microscope looks along the pipette.
        """
        direction = self._directions.get(self.camera_key)
        pixel_m = self.pixel_m
        if pixel_m is None:
            # Raises an error that names the missing entries of the robot file.
            compute_nominal_pixel_size_m(self._robot, self.objective)
        return make_pipette(self._robot, direction or 0.0, pixel_m), direction is not None

    def predict_tip_pixel(self) -> FloatArray | None:
        """Predict the tip's pixel (2,) from command and calibration; None if one is unknown."""
        calibration, joints = self.calibration, self._read_joints()
        stage = None if calibration is None else calibration.micro or calibration.nano
        if stage is None or joints is None or self.chain is None:
            return None
        return stage.predict_pixel(compute_tip_position(self.chain, joints))

    def compute_nano_limits(self, tip_px: FloatArray | None) -> FloatArray | None:
        """Return the closed polygon (n, 2), px, around all pixels that thx and thy can reach.

        ``tip_px`` (2,) is the current pixel of the tip; None means the predicted one. Return None
        if calibration or position is unknown.
        """
        calibration, joints, chain = self.calibration, self._read_joints(), self.chain
        stage = None if calibration is None else calibration.nano or calibration.micro
        if stage is None or joints is None or chain is None:
            return None
        (thx_low, thy_low), (thx_high, thy_high) = chain.lower[3:5], chain.upper[3:5]
        # The outline of the range in thx and thy, as fractions of the range.
        ramp, zeros = np.linspace(0.0, 1.0, _POINTS_PER_SIDE), np.zeros(_POINTS_PER_SIDE)
        thx_fractions = np.concatenate([ramp, zeros + 1.0, ramp[::-1], zeros])
        thy_fractions = np.concatenate([zeros, ramp, zeros + 1.0, ramp[::-1]])
        positions = np.tile(joints, (len(thx_fractions), 1))
        positions[:, 3] = thx_low + thx_fractions * (thx_high - thx_low)
        positions[:, 4] = thy_low + thy_fractions * (thy_high - thy_low)
        tip_m = compute_tip_position(chain, joints)
        displacement = (compute_tip_position(chain, positions) - tip_m)[:, :2]
        current_px = stage.predict_pixel(tip_m) if tip_px is None else tip_px
        return np.asarray(current_px + stage.map.shift_of(displacement))

    def step(self) -> None:
        """Load the calibration of camera and objective if one of them has changed."""
        camera_and_objective = self.camera_key, self.objective
        with self._lock:
            if camera_and_objective == self._loaded_for:
                return
            self._loaded_for = camera_and_objective
        calibration, problem = None, ""
        if camera_and_objective[0]:
            try:
                calibration = load_calibration(self._folder, *camera_and_objective)
            except MicroscopeError as error:
                problem = str(error)
        with self._lock:
            if self._loaded_for == camera_and_objective:
                self.calibration, self.problem = calibration, problem

    def choose_objective(self, name: str) -> None:
        """Set the objective; raises MicroscopeError if the name is empty."""
        name = name.strip()
        if not name:
            raise MicroscopeError('objective: the name is empty; enter one, such as "20x"')
        with self._lock:
            if name != self.objective:
                self.calibration, self._loaded_for, self.objective = None, None, name
            if name not in self.objectives:
                self.objectives = (*self.objectives, name)

    def store_direction(self, direction: float) -> None:
        """Store the direction of the pipette, rad, for the next search."""
        self._directions[self.camera_key] = direction

    def store_stage(self, name: str, stage: StageCalibration, region: SensorRegion) -> None:
        """Store the calibration of a stage.

        Raises
        ------
        FileWriteError
            If the file cannot be written.
        """
        self._store(lambda calibration: calibration.with_stage(name, stage), region)

    def store_focus(self, focus: FocusCalibration, region: SensorRegion) -> None:
        """Store the position of best focus; raises as :meth:`store_stage`."""
        self._store(lambda calibration: replace(calibration, focus=focus), region)

    def _store(
        self, change: Callable[[MicroscopeCalibration], MicroscopeCalibration], region: SensorRegion
    ) -> None:
        """Change the calibration and save it.

        If it belongs to another region of the sensor, a new calibration replaces it.
        """
        view = CalibratedRegion.from_region(region)
        with self._lock:
            calibration = self.calibration
            if calibration is None or calibration.view != view:
                calibration = MicroscopeCalibration(
                    camera=self.camera_key, objective=self.objective, view=view
                )
            self.calibration = calibration = change(calibration)
            self.problem = ""
        save_calibration(self._folder, calibration)

    def _read_joints(self) -> FloatArray | None:
        command = self._session.reported.command
        if not all(axis in command for axis in JOINTS):
            return None
        return np.array([command[axis] for axis in JOINTS])
