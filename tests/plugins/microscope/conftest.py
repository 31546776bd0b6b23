"""A microscope that shows what the test says, and notes what it is asked for."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.cameras.feed import FeedState, FeedView
from rotemina.app.microscope.calibration_file import (
    MicroscopeCalibration,
    StageCalibration,
    View,
)
from rotemina.app.microscope.click_target import PlannedMove
from rotemina.app.microscope.status import MicroscopeStatus, ScaleSource
from rotemina.drivers.cameras.camera import CameraIdentity
from rotemina.drivers.cameras.frame import Frame, Region
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings, PixelType, Trigger
from rotemina.drivers.gate import Permit

PIXEL_M = 0.335e-6


def make_frame(number=0, pixels=None, bits=12, host_time_s=5.0):
    if pixels is None:
        rng = np.random.default_rng(number)
        pixels = rng.integers(100, 4000, (103, 130)).astype(np.uint16)
    rows, columns = pixels.shape[:2]
    return Frame(pixels, host_time_s, number, bits, Region(0, 0, columns, rows), 0.01)


def calibrated():
    stage = StageCalibration(
        date="2026-03-04T05:06:07+00:00",
        matrix=((1.0 / PIXEL_M, 0.0), (0.0, 1.0 / PIXEL_M)),
        covariance=tuple(tuple(1.0 if i == j else 0.0 for j in range(4)) for i in range(4)),
        tip_m=(0.0275, 0.0275, -0.02),
        tip_px=(65.0, 51.0),
        residual_px=0.07,
    )
    view = View(left=0, top=0, width=130, height=103)
    return MicroscopeCalibration(camera="fake:0", objective="20x", view=view, micro=stage)


def live_sight():
    identity = CameraIdentity("fake:0", "Fake", "fake")
    can = CameraDescription(
        130,
        103,
        (PixelType.MONO16,),
        (Trigger.FREE, Trigger.SOFTWARE),
        exposure_s=(1e-4, 1.0),
    )
    feed = FeedView(
        FeedState.LIVE,
        frame=make_frame(),
        age_s=0.012,
        rate_hz=30.0,
        settings=CameraSettings(exposure_s=0.01),
        description=can,
    )
    return MicroscopeStatus(
        cameras=(identity,),
        camera=identity,
        feed=feed,
        objective="20x",
        objectives=("20x",),
        calibration=calibrated(),
        pixel_m=PIXEL_M,
        scale_source=ScaleSource.CALIBRATION,
    )


class FakeMicroscope:
    """Has the methods that the panel calls; ``asked`` has their names and arguments."""

    def __init__(self):
        self.status = live_sight()
        self.asked = []
        self.listeners = []
        self.refuses = None
        self.confirm = False

    def change(self, **changes):
        self.status = replace(self.status, **changes)

    def feed(self, **changes):
        self.change(feed=replace(self.status.feed, **changes))

    @property
    def camera(self):
        return self

    def listen(self, tell):
        self.listeners.append(tell)
        return lambda: self.listeners.remove(tell)

    def plan(self, pixel, *, stage=None):
        self._ask("plan", tuple(pixel), stage)
        ghost = np.asarray(pixel)
        self.change(
            planned=PlannedMove(ghost, ghost, 0.5, "micro", {"x": 0.0275}, 2e-5, self.confirm)
        )

    def cancel_plan(self):
        self._ask("cancel_plan")
        self.change(planned=None)

    def go(self, *, permit, confirmed=False):
        assert isinstance(permit, Permit)
        self._ask("go", confirmed)
        self.change(planned=None)

    def visit_next(self, *, permit, confirmed=False):
        assert isinstance(permit, Permit)
        self._ask("visit_next", confirmed)

    def _ask(self, name, *given):
        self.asked.append((name, *given))
        if self.refuses is not None:
            raise self.refuses

    def __getattr__(self, name):
        def asked(*given, **named):
            self._ask(
                name,
                *(tuple(g) if isinstance(g, np.ndarray) else g for g in given),
                *named.values(),
            )

        return asked


@pytest.fixture
def microscope():
    return FakeMicroscope()


@pytest.fixture
def frame_of():
    return lambda number: make_frame(number, host_time_s=5.0 + 0.1 * number)
