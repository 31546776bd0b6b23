"""A machine under a simulated microscope with unknown mounting and a virtual clock.

``CameraBench`` has a session and a camera. ``MicroscopeRig`` adds the microscope service.
"""

from types import MappingProxyType

import numpy as np
import pytest

from rotemina.app.cameras import FeedState, FeedView, FrameCheck, PictureState
from rotemina.app.microscope import (
    MICRO,
    NANO,
    Microscope,
    StageCalibration,
    StageCalibrationPhase,
    TipState,
)
from rotemina.app.microscope.calibration_file import CalibratedRegion, MicroscopeCalibration
from rotemina.app.microscope.calibration_run import StageCalibrationRun
from rotemina.app.motion.recording import SessionRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras import CameraHub, SimulatedMicroscope
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.kinematics import KinematicChain, compute_tip_position
from rotemina.sim.robot_files import load_robot
from rotemina.sim.vision import Pipette, StageMap, begin_track, to_grey

HIDDEN_MOUNTING = MappingProxyType(
    {
        "width": 650,
        "height": 520,
        "rotation_rad": 0.4,
        "mirrored": True,
        "skew_rad": 0.02,
        "pixel_m": 0.33e-6,
        "offset_px": (30.0, -20.0),
    }
)


def make_stage_calibration(optics, tip_m):
    """Make a calibration from the true mounting, without moves."""
    return StageCalibration(
        date="2026-11-21T10:00:00+00:00",
        matrix=tuple(map(tuple, optics.mapping[:, :2].tolist())),
        covariance=tuple(map(tuple, (1e4 * np.eye(4)).tolist())),
        tip_m=tuple(tip_m.tolist()),
        tip_px=tuple(optics.pixel_of(tip_m).tolist()),
        residual_px=0.05,
    )


class CameraBench:
    """A session and a camera. A test can set ``transform_frame`` to change frames."""

    def __init__(self, mounting=HIDDEN_MOUNTING, effects=()):
        self.clock = VirtualClock(5.0)
        self.robot = load_robot("rotemina")
        self.driver = Simulator(self.robot, clock=self.clock)
        self.session = MotionSession(self.driver)
        self.session.connect()
        self.session.run_once()
        if effects:
            self.session.service.set_effects(list(effects))
            self.session.run_once()
        source = SimulatedMicroscope(
            lambda: self.driver,
            clock=self.clock,
            wait=self.clock.advance,
            mounting=mounting,
        )
        self.camera = source.camera(source.devices()[0])
        self.camera.open()
        self.chain = KinematicChain.of(self.robot)
        self.transform_frame = lambda frame: frame
        self.frame = self.learned_pipette = None
        self.step(5)

    def step(self, times=1, seconds=0.08):
        for _ in range(times):
            self.clock.advance(seconds)
            self.session.run_once()
            frame = self.camera.grab(0.0)
            if frame is not None:
                self.frame = self.transform_frame(frame)

    def settle(self):
        """Let the machine come to rest without taking frames."""
        for _ in range(400):
            self.clock.advance(0.02)
            self.session.run_once()
        assert self.session.snapshot().activity is DeviceState.IDLE

    def get_newest_frame(self):
        return self.frame

    @property
    def optics(self):
        return self.camera.scene.optics

    @property
    def pipette(self):
        """The pipette as an operator would roughly set it up, with the pixel size in the file."""
        body = self.optics.mapping @ np.array([1.0, 0.0, 0.0])
        return Pipette.from_optics(
            float(np.arctan2(body[1], body[0])) + 0.04,
            0.335e-6,
            approach=self.camera.scene.pin.approach_rad,
            aperture=self.optics.aperture,
        )

    def make_offset_pixel(self, columns, rows):
        """Return the pixel at this offset from the tip."""
        return self.true_pixel() + np.array([columns, rows])

    def true_tip(self):
        return compute_tip_position(self.chain, np.array(self.driver.true_positions))

    def true_pixel(self):
        return self.optics.pixel_of(self.true_tip())

    def start_calibration(self, stage=MICRO, pipette=True, **options):
        return StageCalibrationRun(
            self.session,
            self.get_newest_frame,
            stage,
            self.pipette if pipette else None,
            now_s=self.clock(),
            **options,
        )

    def run_until(self, run, condition, max_steps=1500):
        """Step a run of the microscope until a condition of its status holds; return the status."""
        for _ in range(max_steps):
            self.step()
            run.step(self.clock())
            if condition(run.status):
                return run.status
        raise AssertionError(f"still {run.status}")

    def run_until_finished(self, run):
        return self.run_until(run, lambda _: run.ended)

    def calibrate_stages(self, *stages):
        """Calibrate stages and return the calibration."""
        calibration = self.make_empty_calibration()
        self.track_tip()
        for stage in stages:
            status = self.run_until_finished(self.start_calibration(stage))
            assert status.phase is StageCalibrationPhase.DONE, status.reason
            calibration = calibration.with_stage(stage, status.calibration)
        return calibration

    def make_empty_calibration(self):
        return MicroscopeCalibration(
            camera="simulated:microscope",
            objective="20x",
            view=CalibratedRegion.from_region(self.frame.region),
        )

    def make_true_calibration(self):
        stage = make_stage_calibration(self.optics, self.true_tip())
        return self.make_empty_calibration().with_stage(MICRO, stage).with_stage(NANO, stage)

    def make_grey_image(self):
        return to_grey(self.frame.pixels)

    def track_tip(self):
        """Find the tip. The first call also learns its direction."""
        if self.learned_pipette is None:
            self.learned_pipette = begin_track(self.make_grey_image(), self.pipette).pipette
        return begin_track(self.make_grey_image(), self.learned_pipette, turning=False)

    def true_map(self):
        return StageMap(self.optics.mapping[:, :2], np.zeros((4, 4)))


class SteppedFeed:
    """A camera feed without a thread."""

    def __init__(self, camera):
        self.camera = camera
        self.view = FeedView()
        self._listeners = []
        self._frame_check = FrameCheck()
        self.transform_frame = lambda frame: frame

    @property
    def newest(self):
        return self.view.frame

    def start(self, settings=None):
        self.camera.open()
        if settings is not None:
            self.camera.configure(settings)
        self.view = FeedView(FeedState.LIVE, description=self.camera.description)

    def close(self, timeout_s=2.0):
        self.camera.close()
        self.view = FeedView()
        return True

    def configure(self, settings):
        self.camera.configure(settings)

    def listen(self, listener):
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def lose(self, reason):
        self.view = FeedView(FeedState.LOST, reason, self.view.frame)

    def grab(self):
        if self.view.state in (FeedState.LOST, FeedState.CLOSED):
            return
        frame = self.camera.grab(0.0)
        if frame is None:
            return
        frame = self.transform_frame(frame)
        picture_state = self._frame_check.classify(frame)
        feed_states = {PictureState.FROZEN: FeedState.FROZEN, PictureState.BLACK: FeedState.BLACK}
        if self._frame_check.is_repeated:
            frame = self.view.frame
        self.view = FeedView(
            feed_states.get(picture_state, FeedState.LIVE), f"it is {picture_state}", frame
        )
        if self._frame_check.is_repeated:
            return
        for listener in self._listeners:
            listener(frame)


class MicroscopeRig:
    """Session, camera and microscope. ``step`` advances all of them."""

    def __init__(self, folder, mounting=HIDDEN_MOUNTING, seconds=0.08, **options):
        self.clock, self.seconds = VirtualClock(5.0), seconds
        self.robot = load_robot("rotemina")
        self.driver = Simulator(self.robot, clock=self.clock)
        self.session = MotionSession(self.driver, clock=self.clock)
        self.session.connect()
        self.session.run_once()
        source = SimulatedMicroscope(
            lambda: self.session.driver,
            clock=self.clock,
            wait=self.clock.advance,
            mounting=mounting,
        )
        self.feed = self.recorder = None
        self.microscope = Microscope(
            self.session,
            folder,
            hub=CameraHub({"simulated": source}),
            clock=self.clock,
            make_feed=self._make_feed,
            get_recorder=lambda: self.recorder,
            **options,
        )
        self.chain = KinematicChain.of(self.robot)

    def _make_feed(self, camera):
        self.feed = SteppedFeed(camera)
        return self.feed

    def step(self, times=1):
        for _ in range(times):
            self.clock.advance(self.seconds)
            self.session.run_once()
            if self.feed is not None:
                self.feed.grab()
            self.microscope.step(self.clock())

    def find_cameras(self):
        """Read the status as a view does, which starts the search for cameras."""
        assert not self.microscope.status.cameras
        self.step(3)

    def step_until(self, condition, max_steps=2000):
        for _ in range(max_steps):
            self.step()
            if condition(self.microscope.status):
                return self.microscope.status
        raise AssertionError(f"still {self.microscope.status}")

    @property
    def optics(self):
        return self.feed.camera.scene.optics

    def true_tip(self):
        return compute_tip_position(self.chain, np.array(self.driver.true_positions))

    def true_pixel(self):
        return self.optics.pixel_of(self.true_tip())

    def store_true_calibration(self):
        stage = make_stage_calibration(self.optics, self.true_tip())
        for name in (MICRO, NANO):
            self.microscope.setup.store_stage(name, stage, self.feed.newest.region)

    def start_recording(self, path):
        self.recorder = SessionRecorder(self.session, path, clock=self.clock)
        self.recorder.start(thread=False)
        return self.recorder

    def start_tracking(self):
        """Start to track the tip, whose direction is roughly known."""
        body = self.optics.mapping @ np.array([1.0, 0.0, 0.0])
        self.microscope.setup.store_direction(float(np.arctan2(body[1], body[0])) + 0.03)
        self.microscope.track(True)
        self.step(2)
        assert self.microscope.status.tip.state is TipState.TRACKED
        return self


@pytest.fixture
def make_rig():
    return MicroscopeRig


@pytest.fixture
def rig(tmp_path):
    """A microscope with an open view, calibrated with the true mounting."""
    microscope_rig = MicroscopeRig(tmp_path)
    microscope_rig.find_cameras()
    microscope_rig.store_true_calibration()
    microscope_rig.step()
    return microscope_rig


@pytest.fixture
def bench():
    return CameraBench()


@pytest.fixture(scope="module")
def shared_bench():
    """A bench shared by a module. Tests must not move it."""
    return CameraBench()


@pytest.fixture
def make_bench():
    return CameraBench
