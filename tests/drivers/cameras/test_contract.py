"""One suite over every kind of camera; what is faked lies below the driver."""

import numpy as np
import pytest

from rotemina.drivers.cameras.camera import Camera
from rotemina.drivers.cameras.errors import CameraLostError, CameraSettingError
from rotemina.drivers.cameras.frame import Region
from rotemina.drivers.cameras.settings import CameraSettings, PixelType, Trigger
from rotemina.drivers.errors import StateError

LONG_S = 1.0


def grabbed(camera):
    frame = camera.grab(LONG_S)
    assert frame is not None
    return frame


def grab_often(camera):
    for _ in range(20):
        camera.grab(LONG_S)


def test_a_camera_is_made_without_touching_it(bench):
    for ask in (
        lambda: bench.camera.description,
        lambda: bench.camera.grab(0.0),
        lambda: bench.camera.configure(CameraSettings()),
        bench.camera.trigger,
    ):
        with pytest.raises(StateError):
            ask()
    bench.camera.close()


def test_frames_are_as_described(camera, clock):
    can = camera.description
    for number in range(3):
        before_s = clock()
        frame = grabbed(camera)
        assert frame.pixels.shape[:2] == (can.height, can.width)
        assert frame.region == can.whole
        assert before_s <= frame.host_time_s <= clock()
        assert frame.number == number + frame.lost
        assert frame.pixels.max() <= frame.largest
        with pytest.raises(ValueError, match="read-only"):
            frame.pixels[0, 0] = 0
    kinds = {
        PixelType.MONO8: (2, np.uint8),
        PixelType.MONO16: (2, np.uint16),
        PixelType.COLOUR: (3, np.uint8),
    }
    assert (frame.pixels.ndim, frame.pixels.dtype) == kinds[can.pixel_types[0]]


def test_mono8_is_made_of_every_type(camera):
    own = grabbed(camera)
    camera.configure(CameraSettings(pixel_type=PixelType.MONO8))
    frame = grabbed(camera)
    assert (frame.pixels.ndim, frame.pixels.dtype, frame.bits) == (2, np.uint8, 8)
    if own.bits > 8 and own.pixels.std() > 0.0:  # the simulated scene stands still
        np.testing.assert_allclose(frame.pixels.mean(), own.pixels.mean() / 16.0 - 0.5, atol=0.5)


def test_a_region_is_cut_out(camera):
    region = Region(8, 4, 20, 10)
    camera.configure(CameraSettings(region=region))
    frame = grabbed(camera)
    assert frame.region == region
    assert frame.pixels.shape[:2] == (10, 20)
    camera.configure(CameraSettings())
    assert grabbed(camera).region == camera.description.whole


@pytest.mark.parametrize(
    "settings",
    [
        CameraSettings(region=Region(0, 0, 5000, 10)),
        CameraSettings(region=Region(-1, 0, 10, 10)),
        CameraSettings(region=Region(0, 0, 0, 10)),
        CameraSettings(exposure_s=float("nan")),
        CameraSettings(exposure_s=-1.0),
        CameraSettings(gain=1e9),
        CameraSettings(rate_hz=0.0),
    ],
)
def test_a_bad_setting_changes_nothing(camera, settings):
    before = camera.settings
    with pytest.raises(CameraSettingError, match=camera.name):
        camera.configure(settings)
    assert camera.settings == before
    grabbed(camera)


def test_a_software_trigger_takes_one_picture(camera):
    if Trigger.SOFTWARE not in camera.description.triggers:
        with pytest.raises(CameraSettingError, match="free-running"):
            camera.configure(CameraSettings(trigger=Trigger.SOFTWARE))
        return
    with pytest.raises(StateError, match="is free-running"):
        camera.trigger()
    camera.configure(CameraSettings(trigger=Trigger.SOFTWARE))
    assert camera.grab(0.5) is None
    camera.trigger()
    grabbed(camera)
    assert camera.grab(0.5) is None


def test_unplugged_while_live(bench, camera):
    grabbed(camera)
    bench.unplug()
    with pytest.raises(CameraLostError, match=r"(?i)open it again|or missing"):
        grab_often(camera)
    camera.close()
    camera.close()


def test_it_opens_again_and_counts_anew(camera):
    grabbed(camera)
    grabbed(camera)
    with pytest.raises(StateError, match="already open"):
        camera.open()
    camera.configure(CameraSettings(pixel_type=PixelType.MONO8))
    camera.close()
    camera.open()
    assert camera.settings == CameraSettings()
    assert grabbed(camera).number == 0


def test_it_waits_no_longer_than_told(camera, clock):
    grabbed(camera)
    before_s = clock()
    camera.grab(0.001)
    assert clock() - before_s <= 0.0015


def test_rules_cannot_be_overridden():
    with pytest.raises(TypeError, match="final in Camera; fill _grab"):
        type("Bad", (Camera,), {"grab": lambda self, timeout_s: None})
