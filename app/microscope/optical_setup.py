"""The camera and objective in use, with calibration, pipette and scale."""

import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from rotemina.app.microscope.calibration_file import (
    FocusCalibration,
    MicroscopeCalibration,
    StageCalibration,
    View,
    load,
    save,
)
from rotemina.app.microscope.camera_in_use import SIMULATED
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.optics import as_simulated, nominal_pixel_m, objective_of, pipette_of
from rotemina.app.microscope.status import ScaleSource
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras.camera import Camera
from rotemina.drivers.cameras.frame import Region
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import JOINTS, Chain, ChainError
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot
from rotemina.sim.vision.pipette import Pipette

_EDGE = 9  # places along each side of the nano stage's field


class OpticalSetup:
    """Reads and keeps calibrations; one for each camera behind each objective.

    Parameters
    ----------
    session : MotionSession
    folder : Path
    camera : callable
        Return the camera in use, or None.
    """

    def __init__(
        self, session: MotionSession, folder: Path, camera: Callable[[], Camera | None]
    ) -> None:
        self._session, self._folder, self._camera = session, folder, camera
        self._lock = threading.Lock()  # guards what follows, for what changes it
        self._of: tuple[str, str] | None = None
        self._directions: dict[str, float] = {}
        self.objective = objective_of(as_simulated(session.robot))
        self.objectives: tuple[str, ...] = (self.objective,)
        self.calibration: MicroscopeCalibration | None = None
        #: Why what is kept cannot be used.
        self.problem = ""
        try:
            self.chain: Chain | None = Chain.of(session.robot)
        except ChainError:
            self.chain = None

    # --- what a view asks -------------------------------------------------------------------------

    @property
    def key(self) -> str:
        """By which calibrations know the camera; empty without one."""
        camera = self._camera()
        return "" if camera is None else camera.identity.key

    @property
    def _robot(self) -> Robot:
        """What is known of microscope and tool; of the simulated one, all."""
        camera, robot = self._camera(), self._session.robot
        simulated = camera is not None and camera.identity.source == SIMULATED
        return as_simulated(robot) if simulated else robot

    @property
    def scale(self) -> tuple[float | None, ScaleSource]:
        """The size of a pixel, m, and its source."""
        known = self.calibration
        stage = None if known is None else known.micro or known.nano
        if stage is not None:
            return float(np.mean(stage.map.geometry.pixel_size)), ScaleSource.CALIBRATION
        try:
            nominal = nominal_pixel_m(self._robot, self.objective)
        except MicroscopeError:
            return None, ScaleSource.NONE
        return nominal, ScaleSource.ROBOT_FILE

    @property
    def pixel_m(self) -> float | None:
        """The size of a pixel, m."""
        return self.scale[0]

    def pipette(self) -> tuple[Pipette, bool]:
        """Return what the tip looks like, and whether its direction is known.

        Raises
        ------
        InputError
            If the robot file does not tell enough, or it cannot be seen from there.
        """
        direction = self._directions.get(self.key)
        pixel_m = self.pixel_m
        if pixel_m is None:
            nominal_pixel_m(self._robot, self.objective)  # says what is missing
        return pipette_of(self._robot, direction or 0.0, pixel_m), direction is not None

    def expected(self) -> FloatArray | None:
        """Return where the tip should be by commands and calibration, px (2,), or None."""
        known, joints = self.calibration, self._joints()
        stage = None if known is None else known.micro or known.nano
        if stage is None or joints is None or self.chain is None:
            return None
        return stage.pixel_of(tip_position(self.chain, joints))

    def nano_limits(self, tip_px: FloatArray | None) -> FloatArray | None:
        """Return the closed polygon (n, 2), px, of where thx and thy can bring the tip."""
        known, joints, chain = self.calibration, self._joints(), self.chain
        stage = None if known is None else known.nano or known.micro
        if stage is None or joints is None or chain is None:
            return None
        (x_low, y_low), (x_high, y_high) = chain.lower[3:5], chain.upper[3:5]
        up, even = np.linspace(0.0, 1.0, _EDGE), np.zeros(_EDGE)
        thx = np.concatenate([up, even + 1.0, up[::-1], even])
        thy = np.concatenate([even, up, even + 1.0, up[::-1]])
        places = np.tile(joints, (len(thx), 1))
        places[:, 3] = x_low + thx * (x_high - x_low)
        places[:, 4] = y_low + thy * (y_high - y_low)
        here = tip_position(chain, joints)
        moved = (tip_position(chain, places) - here)[:, :2]
        middle = stage.pixel_of(here) if tip_px is None else tip_px
        return np.asarray(middle + stage.map.pixels(moved))

    # --- what changes it --------------------------------------------------------------------------

    def step(self) -> None:
        """Load the calibration of camera and objective if they have changed."""
        of = self.key, self.objective
        with self._lock:
            if of == self._of:
                return
            self._of = of
        calibration, problem = None, ""
        if of[0]:
            try:
                calibration = load(self._folder, *of)
            except MicroscopeError as error:
                problem = str(error)
        with self._lock:
            if self._of == of:
                self.calibration, self.problem = calibration, problem

    def choose_objective(self, name: str) -> None:
        """Set the objective; raises MicroscopeError without a name."""
        name = name.strip()
        if not name:
            raise MicroscopeError(
                message("engine", 'objective: the name is empty; enter one, such as "20x"')
            )
        with self._lock:
            if name != self.objective:
                self.calibration, self._of, self.objective = None, None, name
            if name not in self.objectives:
                self.objectives = (*self.objectives, name)

    def learn_direction(self, direction: float) -> None:
        """Keep in which direction the pipette was found, rad, for the next search."""
        self._directions[self.key] = direction

    def keep_stage(self, name: str, stage: StageCalibration, region: Region) -> None:
        """Keep the calibration of a stage; raises FileWriteError if no file can be written."""
        self._keep(lambda known: known.with_stage(name, stage), region)

    def keep_focus(self, focus: FocusCalibration, region: Region) -> None:
        """Store the sharpest position; raises as :meth:`keep_stage`."""
        self._keep(lambda known: replace(known, focus=focus), region)

    def _keep(
        self, change: Callable[[MicroscopeCalibration], MicroscopeCalibration], region: Region
    ) -> None:
        """Change what is known; of another part of the sensor nothing else holds any more."""
        view = View.of(region)
        with self._lock:
            known = self.calibration
            if known is None or known.view != view:
                known = MicroscopeCalibration(camera=self.key, objective=self.objective, view=view)
            self.calibration = known = change(known)
            self.problem = ""
        save(self._folder, known)

    def _joints(self) -> FloatArray | None:
        command = self._session.reported.command
        if not all(axis in command for axis in JOINTS):
            return None
        return np.array([command[axis] for axis in JOINTS])
