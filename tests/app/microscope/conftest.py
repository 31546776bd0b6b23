"""A machine under a simulated microscope whose mounting nobody tells, on a clock set by hand.

``Bench`` has session and camera beside each other; ``Workplace`` the whole microscope over them.
"""

from types import MappingProxyType

import numpy as np
import pytest

from rotemina.app.cameras.feed import FeedState, FeedView
from rotemina.app.cameras.frame_check import FrameCheck, PictureState
from rotemina.app.microscope.calibration_file import (
    MICRO,
    NANO,
    MicroscopeCalibration,
    StageCalibration,
    View,
)
from rotemina.app.microscope.calibration_run import CalibrationRun, Phase
from rotemina.app.microscope.click_corrections import Visit
from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import TipState
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.cameras.hub import CameraHub
from rotemina.drivers.cameras.simulated import SimulatedMicroscope
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.robot.file import load_robot
from rotemina.sim.vision.calibration import StageMap
from rotemina.sim.vision.image import grey
from rotemina.sim.vision.pipette import Pipette
from rotemina.sim.vision.tracking import begin_track

HIDDEN = MappingProxyType(
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


class Bench:
    """A session and a camera beside each other; frames may be spoilt by ``spoil``."""

    def __init__(self, mounting=HIDDEN, effects=()):
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
        self.chain = Chain.of(self.robot)
        self.spoil = lambda frame: frame
        self.frame = self.found = None
        self.step(5)

    def step(self, times=1, seconds=0.08):
        for _ in range(times):
            self.clock.advance(seconds)
            self.session.run_once()
            frame = self.camera.grab(0.0)
            if frame is not None:
                self.frame = self.spoil(frame)

    def rest(self):
        """Let the machine come to rest unseen."""
        for _ in range(400):
            self.clock.advance(0.02)
            self.session.run_once()
        assert self.session.snapshot().activity is DeviceState.IDLE

    def newest(self):
        return self.frame

    @property
    def optics(self):
        return self.camera.scene.optics

    @property
    def pipette(self):
        """The pipette as an operator would set it up: by the robot file's pixel size, roughly."""
        body = self.optics.mapping @ np.array([1.0, 0.0, 0.0])
        return Pipette.seen(
            float(np.arctan2(body[1], body[0])) + 0.04,
            0.335e-6,
            approach=self.camera.scene.pin.approach_rad,
            aperture=self.optics.aperture,
        )

    def beside(self, columns, rows):
        """Return a pixel so far from the tip."""
        return self.true_pixel() + np.array([columns, rows])

    def true_pixel(self):
        return self.optics.pixel_of(tip_position(self.chain, np.array(self.driver.true_positions)))

    def begin(self, stage=MICRO, pipette=True, **options):
        return CalibrationRun(
            self.session,
            self.newest,
            stage,
            self.pipette if pipette else None,
            now_s=self.clock(),
            **options,
        )

    def run(self, run, most=1500):
        for _ in range(most):
            self.step()
            status = run.step(self.clock())
            if getattr(status, "phase", None) in (Phase.DONE, Phase.FAILED):
                return status
            if getattr(status, "visit", None) in (Visit.ARRIVED, Visit.FAILED):
                return status
        raise AssertionError(f"still {status}")

    def calibrated(self, *stages):
        """Calibrate stages, and return what is kept."""
        known = self.empty()
        self.track()
        for stage in stages:
            status = self.run(self.begin(stage))
            assert status.phase is Phase.DONE, status.reason
            known = known.with_stage(stage, status.calibration)
        return known

    def empty(self):
        return MicroscopeCalibration(
            camera="simulated:microscope", objective="20x", view=View.of(self.frame.region)
        )

    def known(self):
        """Return a calibration as good as the truth, without the moves."""
        matrix = self.optics.mapping[:, :2]
        tip_m = tip_position(self.chain, np.array(self.driver.true_positions))
        stage = StageCalibration(
            date="2026-11-21T10:00:00+00:00",
            matrix=tuple(map(tuple, matrix.tolist())),
            covariance=tuple(map(tuple, (1e4 * np.eye(4)).tolist())),
            tip_m=tuple(tip_m.tolist()),
            tip_px=tuple(self.true_pixel().tolist()),
            residual_px=0.05,
        )
        return self.empty().with_stage(MICRO, stage).with_stage(NANO, stage)

    def image(self):
        return grey(self.frame.pixels)

    def track(self):
        """Find the tip; where it is found first, in a clear place, its direction is learnt."""
        if self.found is None:
            self.found = begin_track(self.image(), self.pipette).pipette
        return begin_track(self.image(), self.found, turning=False)

    def true_map(self):
        return StageMap(self.optics.mapping[:, :2], np.zeros((4, 4)))


class SteppedFeed:
    """A camera feed without a thread."""

    def __init__(self, camera):
        self.camera = camera
        self.view = FeedView()
        self._listeners = []
        self._watch = FrameCheck()
        self.spoil = lambda frame: frame

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

    def listen(self, tell):
        self._listeners.append(tell)
        return lambda: self._listeners.remove(tell)

    def lose(self, reason):
        self.view = FeedView(FeedState.LOST, reason, self.view.frame)

    def grab(self):
        if self.view.state in (FeedState.LOST, FeedState.CLOSED):
            return
        frame = self.camera.grab(0.0)
        if frame is None:
            return
        frame = self.spoil(frame)
        showing = self._watch.judge(frame)
        state = {PictureState.FROZEN: FeedState.FROZEN, PictureState.BLACK: FeedState.BLACK}
        if self._watch.is_repeated:
            frame = self.view.frame
        self.view = FeedView(state.get(showing, FeedState.LIVE), f"it is {showing}", frame)
        if self._watch.is_repeated:
            return
        for tell in self._listeners:
            tell(frame)


class Workplace:
    """Session, camera and microscope; ``step`` lets all of them go on."""

    def __init__(self, folder, mounting=HIDDEN, seconds=0.08, **options):
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
        self.feed = None
        self.microscope = Microscope(
            self.session,
            folder,
            hub=CameraHub({"simulated": source}),
            clock=self.clock,
            feed_of=self._feed_of,
            **options,
        )
        self.chain = Chain.of(self.robot)

    def _feed_of(self, camera):
        self.feed = SteppedFeed(camera)
        return self.feed

    def step(self, times=1):
        for _ in range(times):
            self.clock.advance(self.seconds)
            self.session.run_once()
            if self.feed is not None:
                self.feed.grab()
            self.microscope.step(self.clock())

    def look(self):
        """Have somebody look at the picture from now on."""
        assert not self.microscope.status.cameras
        self.step(3)

    def until(self, done, most=2000):
        for _ in range(most):
            self.step()
            if done(self.microscope.status):
                return self.microscope.status
        raise AssertionError(f"still {self.microscope.status}")

    @property
    def optics(self):
        return self.feed.camera.scene.optics

    def true_tip(self):
        return tip_position(self.chain, np.array(self.driver.true_positions))

    def true_pixel(self):
        return self.optics.pixel_of(self.true_tip())

    def calibrate_by_truth(self):
        """Keep calibrations as good as the truth, without the moves."""
        tip_m = self.true_tip()
        stage = StageCalibration(
            date="2026-11-21T10:00:00+00:00",
            matrix=tuple(map(tuple, self.optics.mapping[:, :2].tolist())),
            covariance=tuple(map(tuple, (1e4 * np.eye(4)).tolist())),
            tip_m=tuple(tip_m.tolist()),
            tip_px=tuple(self.true_pixel().tolist()),
            residual_px=0.05,
        )
        for name in (MICRO, NANO):
            self.microscope.setup.keep_stage(name, stage, self.feed.newest.region)

    def tracking(self):
        """Track the tip, whose direction is roughly known."""
        body = self.optics.mapping @ np.array([1.0, 0.0, 0.0])
        self.microscope.setup.learn_direction(float(np.arctan2(body[1], body[0])) + 0.03)
        self.microscope.track(True)
        self.step(2)
        assert self.microscope.status.tip.state is TipState.TRACKED
        return self


@pytest.fixture
def make_work():
    return Workplace


@pytest.fixture
def work(tmp_path):
    """A workplace at whose picture somebody looks, calibrated by the truth."""
    made = Workplace(tmp_path)
    made.look()
    made.calibrate_by_truth()
    made.step()
    return made


@pytest.fixture
def bench():
    return Bench()


@pytest.fixture(scope="module")
def still():
    """Return a bench that nobody moves; a module shares it."""
    return Bench()


@pytest.fixture
def make_bench():
    return Bench
