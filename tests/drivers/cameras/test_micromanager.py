"""Micro-Manager's cameras, with a fake of its core."""

import pytest

from rotemina.drivers.cameras import CameraSettings, SensorRegion
from rotemina.drivers.cameras.micromanager import MicroManagerSource
from rotemina.drivers.contract import CameraLostError, CameraRefusedError, CameraSettingError


@pytest.fixture
def camera(clock, core, tmp_path):
    (tmp_path / "axiocam.cfg").write_text("")
    source = MicroManagerSource(clock=clock, wait=clock.advance, core=lambda: core)
    return source.camera(source.parse_address(str(tmp_path / "axiocam.cfg")))


def test_grab_returns_the_newest_picture_and_counts_the_lost_ones(camera, core):
    camera.open()
    core.buffer = 4
    frame = camera.grab(1.0)
    assert frame.pixels[0, 0] == 5
    assert (frame.number, frame.lost, frame.bits) == (4, 4, 12)


def test_settings_reach_the_camera(camera, core):
    camera.open()
    camera.configure(CameraSettings(exposure_s=0.025, gain=2.0, region=SensorRegion(6, 8, 20, 10)))
    assert (core.exposure_ms, core.properties["Gain"]) == (25.0, 2.0)
    frame = camera.grab(1.0)
    # The camera has moved the region to a column that it supports.
    assert frame.region == camera.settings.region == SensorRegion(4, 8, 20, 10)
    assert frame.exposure_s == 0.025


def test_settings_that_the_camera_rejects_change_nothing(camera, core, caplog):
    camera.open()
    camera.configure(CameraSettings(gain=2.0))
    with pytest.raises(CameraSettingError, match=r"rejected the settings.*Choose other values"):
        camera.configure(CameraSettings(gain=3.0))
    assert "Gain: invalid value" in caplog.text
    assert core.properties["Gain"] == camera.settings.gain == 2.0
    assert camera.grab(1.0) is not None


def test_grab_returns_none_after_its_timeout(camera, core, clock):
    camera.open()
    core.getRemainingImageCount = lambda: 0
    before_s = clock()
    assert camera.grab(0.05) is None
    assert clock() - before_s == pytest.approx(0.05, abs=0.003)


@pytest.mark.parametrize(
    ("change", "error", "reason"),
    [
        ({"is_connected": False}, CameraLostError, "cannot open it; see the log for the cause"),
        ({"camera": ""}, CameraRefusedError, "names no camera"),
        ({"bytes_per_pixel": 4}, CameraRefusedError, "pixels of 4 bytes"),
    ],
)
def test_a_camera_that_cannot_be_opened_says_why(camera, core, change, error, reason):
    for name, value in change.items():
        setattr(core, name, value)
    with pytest.raises(error, match=reason):
        camera.open()
    assert core.loaded is None


def test_a_missing_micromanager_package_is_reported(monkeypatch, tmp_path):
    monkeypatch.setattr("rotemina.drivers.cameras.micromanager.find_spec", lambda name: None)
    assert "pip install" in MicroManagerSource().problem
    monkeypatch.setitem(__import__("sys").modules, "pymmcore_plus", None)
    (tmp_path / "a.cfg").write_text("")
    source = MicroManagerSource()
    with pytest.raises(CameraRefusedError, match="pip install"):
        source.camera(source.parse_address(str(tmp_path / "a.cfg"))).open()


def test_an_address_must_name_a_configuration_file():
    with pytest.raises(CameraRefusedError, match="configuration file"):
        MicroManagerSource().parse_address("AxioCam")
