"""The check of cameras finds each thing that a source can do wrong."""

import numpy as np
import pytest

from rotemina.app.plugin_kit.camera_check import check_cameras
from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Picture
from rotemina.drivers.cameras.settings import CameraDescription, PixelType, Trigger
from rotemina.drivers.cameras.source import CameraSource

HERE = CameraIdentity("good:1", "Good camera", "good")
PIXELS = np.zeros((4, 6), np.uint8)


class GoodCamera(Camera):
    triggers = (Trigger.FREE, Trigger.SOFTWARE)

    def _open(self):
        return CameraDescription(6, 4, (PixelType.MONO8,), self.triggers)

    def _close(self):
        pass

    def _grab(self, timeout_s):
        self.wait(0.01)
        return Picture(PIXELS, 8, self.clock())


class GoodSource(CameraSource):
    made = GoodCamera
    there = (HERE,)

    def devices(self):
        return self.there

    def camera(self, identity):
        return self.made(identity, clock=self.clock, wait=self.wait)


def verdicts(**bad):
    """Check a source that is good but for a camera with these members, or these devices."""
    there = bad.pop("there", (HERE,))
    made = type("Made", (GoodCamera,), bad)
    results = check_cameras(type("Source", (GoodSource,), {"made": made, "there": there}))
    return {result.name: (str(result.verdict), result.note) for result in results}


def test_a_good_source_passes():
    assert {verdict for verdict, _ in verdicts().values()} == {"passed"}


@pytest.mark.parametrize(
    ("grab", "said"),
    [
        (lambda self, _: None, "no picture in 4 s"),
        (lambda self, _: Picture(PIXELS.T, 8, self.clock()), "a picture of 4 × 6 px"),
        (lambda self, _: Picture(PIXELS, 8, self.clock() + 1.0), "no time to come"),
        (lambda self, _: Picture(PIXELS, 8, -self._count), "in order"),
        (lambda self, _: 1 / 0, "it raised ZeroDivisionError"),
    ],
)
def test_bad_pictures_are_found(grab, said):
    verdict, note = verdicts(_grab=grab)["pictures"]
    assert verdict == "failed"
    assert said in note


def test_other_faults_are_found():
    strange = (HERE, HERE), (CameraIdentity("1", "No source", "good"),), ("good:1",)
    said = "no key twice", "the source, a colon and the address", "each a CameraIdentity"
    for there, expected in zip(strange, said, strict=True):
        assert expected in verdicts(there=there)["listed"][1]
    once = {"_close": lambda self: setattr(self, "_open", None)}
    assert verdicts(**once)["closed"][0] == "failed"


def test_what_does_not_apply_is_skipped():
    assert verdicts(triggers=(Trigger.FREE,))["triggered"][0] == "skipped"
    assert verdicts(there=())["pictures"] == ("skipped", "there is no camera")
