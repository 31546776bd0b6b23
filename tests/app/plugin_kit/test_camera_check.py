"""The camera check detects every fault of a source."""

import numpy as np
import pytest

from rotemina.app.plugin_kit import check_cameras
from rotemina.drivers.cameras import (
    Camera,
    CameraDescription,
    CameraIdentity,
    CameraSource,
    CameraTrigger,
    PixelType,
    RawFrame,
)

IDENTITY = CameraIdentity("good:1", "Good camera", "good")
PIXELS = np.zeros((4, 6), np.uint8)


class GoodCamera(Camera):
    triggers = (CameraTrigger.FREE, CameraTrigger.SOFTWARE)

    def _open(self):
        return CameraDescription(6, 4, (PixelType.MONO8,), self.triggers)

    def _close(self):
        pass

    def _grab(self, timeout_s):
        self.wait(0.01)
        return RawFrame(PIXELS, 8, self.clock())


class GoodSource(CameraSource):
    camera_class = GoodCamera
    identities = (IDENTITY,)

    def devices(self):
        return self.identities

    def camera(self, identity):
        return self.camera_class(identity, clock=self.clock, wait=self.wait)


def get_verdicts(**replacements):
    """Check a good source after replacing members of its camera, or its ``identities``."""
    identities = replacements.pop("identities", (IDENTITY,))
    camera_class = type("ReplacedCamera", (GoodCamera,), replacements)
    results = check_cameras(
        type("Source", (GoodSource,), {"camera_class": camera_class, "identities": identities})
    )
    return {result.name: (str(result.verdict), result.note) for result in results}


def test_good_source_passes():
    assert {verdict for verdict, _ in get_verdicts().values()} == {"passed"}


@pytest.mark.parametrize(
    ("grab", "message"),
    [
        (lambda self, _: None, "no picture in 4 s"),
        (lambda self, _: RawFrame(PIXELS.T, 8, self.clock()), "a picture of 4 × 6 px"),
        (lambda self, _: RawFrame(PIXELS, 8, self.clock() + 1.0), "no time in the future"),
        (lambda self, _: RawFrame(PIXELS, 8, -self._frame_count), "in order"),
        (lambda self, _: 1 / 0, "it raised ZeroDivisionError"),
    ],
)
def test_bad_pictures_are_detected(grab, message):
    verdict, note = get_verdicts(_grab=grab)["pictures"]
    assert verdict == "failed"
    assert message in note


def test_other_faults_are_detected():
    faulty_identities = (
        (IDENTITY, IDENTITY),
        (CameraIdentity("1", "No source", "good"),),
        ("good:1",),
    )
    messages = "no key twice", "the source, a colon and the address", "each a CameraIdentity"
    for identities, expected in zip(faulty_identities, messages, strict=True):
        assert expected in get_verdicts(identities=identities)["listed"][1]
    closes_once = {"_close": lambda self: setattr(self, "_open", None)}
    assert get_verdicts(**closes_once)["closed"][0] == "failed"


def test_checks_that_do_not_apply_are_skipped():
    assert get_verdicts(triggers=(CameraTrigger.FREE,))["triggered"][0] == "skipped"
    assert get_verdicts(identities=())["pictures"] == ("skipped", "there is no camera")
