"""Micro-Manager's cameras, over a fake of its core."""

import pytest

from rotemina.drivers.cameras.errors import CameraLostError, CameraRefusedError, CameraSettingError
from rotemina.drivers.cameras.frame import Region
from rotemina.drivers.cameras.micromanager import MicroManager
from rotemina.drivers.cameras.settings import CameraSettings


@pytest.fixture
def camera(clock, core, tmp_path):
    (tmp_path / "axiocam.cfg").write_text("")
    source = MicroManager(clock=clock, wait=clock.advance, core=lambda: core)
    return source.camera(source.addressed(str(tmp_path / "axiocam.cfg")))


def test_the_newest_picture_and_how_many_were_lost(camera, core):
    camera.open()
    core.buffer = 4
    frame = camera.grab(1.0)
    assert frame.pixels[0, 0] == 5
    assert (frame.number, frame.lost, frame.bits) == (4, 4, 12)


def test_settings_reach_the_camera(camera, core):
    camera.open()
    camera.configure(CameraSettings(exposure_s=0.025, gain=2.0, region=Region(6, 8, 20, 10)))
    assert (core.exposure_ms, core.properties["Gain"]) == (25.0, 2.0)
    frame = camera.grab(1.0)
    # Where the camera has moved the region to what it can.
    assert frame.region == camera.settings.region == Region(4, 8, 20, 10)
    assert frame.exposure_s == 0.025


def test_what_the_camera_refuses_changes_nothing(camera, core, caplog):
    camera.open()
    camera.configure(CameraSettings(gain=2.0))
    with pytest.raises(CameraSettingError, match=r"rejected the settings.*Choose other values"):
        camera.configure(CameraSettings(gain=3.0))
    assert "Gain: invalid value" in caplog.text
    assert core.properties["Gain"] == camera.settings.gain == 2.0
    assert camera.grab(1.0) is not None


def test_no_picture_in_time(camera, core, clock):
    camera.open()
    core.getRemainingImageCount = lambda: 0
    before_s = clock()
    assert camera.grab(0.05) is None
    assert clock() - before_s == pytest.approx(0.05, abs=0.003)


@pytest.mark.parametrize(
    ("change", "error", "reason"),
    [
        ({"there": False}, CameraLostError, "cannot open it; the log has the cause"),
        ({"camera": ""}, CameraRefusedError, "names no camera"),
        ({"size": 4}, CameraRefusedError, "pixels of 4 bytes"),
    ],
)
def test_what_cannot_be_opened(camera, core, change, error, reason):
    for name, value in change.items():
        setattr(core, name, value)
    with pytest.raises(error, match=reason):
        camera.open()
    assert core.loaded is None


def test_the_extra_is_missing(monkeypatch, tmp_path):
    monkeypatch.setattr("rotemina.drivers.cameras.micromanager.find_spec", lambda name: None)
    assert "pip install" in MicroManager().problem
    monkeypatch.setitem(__import__("sys").modules, "pymmcore_plus", None)
    (tmp_path / "a.cfg").write_text("")
    source = MicroManager()
    with pytest.raises(CameraRefusedError, match="pip install"):
        source.camera(source.addressed(str(tmp_path / "a.cfg"))).open()


def test_a_configuration_has_to_be_named():
    with pytest.raises(CameraRefusedError, match="configuration file"):
        MicroManager().addressed("AxioCam")
