"""A fake microscope whose status is set by the test, and which notes all calls."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.cameras import FeedState, FeedView
from rotemina.app.microscope import MicroscopeStatus, ScaleSource, StageCalibration
from rotemina.app.microscope.calibration_file import CalibratedRegion, MicroscopeCalibration
from rotemina.app.microscope.click_target import PlannedMove
from rotemina.drivers.cameras import (
    CameraDescription,
    CameraFrame,
    CameraIdentity,
    CameraSettings,
    CameraTrigger,
    PixelType,
    SensorRegion,
)
from rotemina.drivers.contract import Permit

PIXEL_M = 0.335e-6


def make_frame(number=0, pixels=None, bits=12, host_time_s=5.0):
    if pixels is None:
        rng = np.random.default_rng(number)
        pixels = rng.integers(100, 4000, (103, 130)).astype(np.uint16)
    rows, columns = pixels.shape[:2]
    return CameraFrame(pixels, host_time_s, number, bits, SensorRegion(0, 0, columns, rows), 0.01)


def make_calibration():
    stage = StageCalibration(
        date="2026-03-04T05:06:07+00:00",
        matrix=((1.0 / PIXEL_M, 0.0), (0.0, 1.0 / PIXEL_M)),
        covariance=tuple(tuple(1.0 if i == j else 0.0 for j in range(4)) for i in range(4)),
        tip_m=(0.0275, 0.0275, -0.02),
        tip_px=(65.0, 51.0),
        residual_px=0.07,
    )
    view = CalibratedRegion(left=0, top=0, width=130, height=103)
    return MicroscopeCalibration(camera="fake:0", objective="20x", view=view, micro=stage)


def make_live_status():
    identity = CameraIdentity("fake:0", "Fake", "fake")
    description = CameraDescription(
        130,
        103,
        (PixelType.MONO16,),
        (CameraTrigger.FREE, CameraTrigger.SOFTWARE),
        exposure_s=(1e-4, 1.0),
    )
    feed = FeedView(
        FeedState.LIVE,
        frame=make_frame(),
        age_s=0.012,
        rate_hz=30.0,
        settings=CameraSettings(exposure_s=0.01),
        description=description,
    )
    return MicroscopeStatus(
        cameras=(identity,),
        camera=identity,
        feed=feed,
        objective="20x",
        objectives=("20x",),
        calibration=make_calibration(),
        pixel_m=PIXEL_M,
        scale_source=ScaleSource.CALIBRATION,
    )


class FakeMicroscope:
    """Fake of the microscope; ``calls`` contains the names and arguments of all calls."""

    def __init__(self):
        self.status = make_live_status()
        self.calls = []
        self.listeners = []
        self.refusal = None
        self.confirm = False

    def change(self, **changes):
        self.status = replace(self.status, **changes)

    def feed(self, **changes):
        self.change(feed=replace(self.status.feed, **changes))

    @property
    def camera(self):
        return self

    def listen(self, listener):
        self.listeners.append(listener)
        return lambda: self.listeners.remove(listener)

    def plan(self, pixel, *, stage=None):
        self._note_call("plan", tuple(pixel), stage)
        ghost = np.asarray(pixel)
        self.change(
            planned_move=PlannedMove(ghost, ghost, 0.5, "micro", {"x": 0.0275}, 2e-5, self.confirm)
        )

    def cancel_plan(self):
        self._note_call("cancel_plan")
        self.change(planned_move=None)

    def go(self, *, permit, confirmed=False):
        assert isinstance(permit, Permit)
        self._note_call("go", confirmed)
        self.change(planned_move=None)

    def visit_next(self, *, permit, confirmed=False):
        assert isinstance(permit, Permit)
        self._note_call("visit_next", confirmed)

    def _note_call(self, name, *arguments):
        self.calls.append((name, *arguments))
        if self.refusal is not None:
            raise self.refusal

    def __getattr__(self, name):
        def record_call(*arguments, **options):
            self._note_call(
                name,
                *(
                    tuple(argument) if isinstance(argument, np.ndarray) else argument
                    for argument in arguments
                ),
                *options.values(),
            )

        return record_call


@pytest.fixture
def microscope():
    return FakeMicroscope()


@pytest.fixture
def make_numbered_frame():
    return lambda number: make_frame(number, host_time_s=5.0 + 0.1 * number)
