"""Rules that every kind of camera follows. Only the library below the driver is faked."""

import numpy as np
import pytest

from rotemina.drivers.cameras import Camera, CameraSettings, CameraTrigger, PixelType, SensorRegion
from rotemina.drivers.contract import CameraLostError, CameraSettingError, StateError

TIMEOUT_S = 1.0


def grab_frame(camera):
    frame = camera.grab(TIMEOUT_S)
    assert frame is not None
    return frame


def grab_frames(camera):
    for _ in range(20):
        camera.grab(TIMEOUT_S)


def test_a_new_camera_rejects_access_until_it_is_opened(bench):
    for access in (
        lambda: bench.camera.description,
        lambda: bench.camera.grab(0.0),
        lambda: bench.camera.configure(CameraSettings()),
        bench.camera.trigger,
    ):
        with pytest.raises(StateError):
            access()
    bench.camera.close()


def test_frames_match_the_description_and_a_grab_keeps_its_timeout(camera, clock):
    description = camera.description
    for number in range(3):
        before_s = clock()
        frame = grab_frame(camera)
        assert frame.pixels.shape[:2] == (description.height, description.width)
        assert frame.region == description.full_region
        assert before_s <= frame.host_time_s <= clock()
        assert frame.number == number + frame.lost
        assert frame.pixels.max() <= frame.saturation_value
        with pytest.raises(ValueError, match="read-only"):
            frame.pixels[0, 0] = 0
    kinds = {
        PixelType.MONO8: (2, np.uint8),
        PixelType.MONO16: (2, np.uint16),
        PixelType.COLOUR: (3, np.uint8),
    }
    assert (frame.pixels.ndim, frame.pixels.dtype) == kinds[description.pixel_types[0]]
    before_s = clock()
    camera.grab(0.001)
    assert clock() - before_s <= 0.0015


def test_every_pixel_type_can_be_converted_to_mono8(camera):
    native = grab_frame(camera)
    camera.configure(CameraSettings(pixel_type=PixelType.MONO8))
    frame = grab_frame(camera)
    assert (frame.pixels.ndim, frame.pixels.dtype, frame.bits) == (2, np.uint8, 8)
    # The simulated scene stands still, so that its pictures can be compared.
    if native.bits > 8 and native.pixels.std() > 0.0:
        np.testing.assert_allclose(frame.pixels.mean(), native.pixels.mean() / 16.0 - 0.5, atol=0.5)


def test_a_region_is_cropped(camera):
    region = SensorRegion(8, 4, 20, 10)
    camera.configure(CameraSettings(region=region))
    frame = grab_frame(camera)
    assert frame.region == region
    assert frame.pixels.shape[:2] == (10, 20)
    camera.configure(CameraSettings())
    assert grab_frame(camera).region == camera.description.full_region


def test_a_bad_setting_changes_nothing(camera):
    settings_before = camera.settings
    for settings in (
        CameraSettings(region=SensorRegion(0, 0, 5000, 10)),
        CameraSettings(region=SensorRegion(-1, 0, 10, 10)),
        CameraSettings(region=SensorRegion(0, 0, 0, 10)),
        CameraSettings(exposure_s=float("nan")),
        CameraSettings(exposure_s=-1.0),
        CameraSettings(gain=1e9),
        CameraSettings(rate_hz=0.0),
    ):
        with pytest.raises(CameraSettingError, match=camera.name):
            camera.configure(settings)
        assert camera.settings == settings_before
    grab_frame(camera)


def test_a_software_trigger_takes_one_picture(camera):
    if CameraTrigger.SOFTWARE not in camera.description.triggers:
        with pytest.raises(CameraSettingError, match="free-running"):
            camera.configure(CameraSettings(trigger=CameraTrigger.SOFTWARE))
        return
    with pytest.raises(StateError, match="is free-running"):
        camera.trigger()
    camera.configure(CameraSettings(trigger=CameraTrigger.SOFTWARE))
    assert camera.grab(0.5) is None
    camera.trigger()
    grab_frame(camera)
    assert camera.grab(0.5) is None


def test_an_unplugged_camera_is_reported_as_lost(bench, camera):
    grab_frame(camera)
    bench.unplug()
    with pytest.raises(CameraLostError, match=r"(?i)open it again|or missing"):
        grab_frames(camera)
    camera.close()
    camera.close()


def test_a_reopened_camera_counts_from_zero_with_default_settings(camera):
    grab_frame(camera)
    grab_frame(camera)
    with pytest.raises(StateError, match="already open"):
        camera.open()
    camera.configure(CameraSettings(pixel_type=PixelType.MONO8))
    camera.close()
    camera.open()
    assert camera.settings == CameraSettings()
    assert grab_frame(camera).number == 0


def test_final_methods_cannot_be_overridden():
    with pytest.raises(TypeError, match="final in Camera; implement _grab"):
        type("Bad", (Camera,), {"grab": lambda self, timeout_s: None})
