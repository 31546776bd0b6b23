"""Devices, video files and streams through OpenCV."""

import cv2
import numpy as np
import pytest

from rotemina.drivers.cameras import CameraSettings
from rotemina.drivers.cameras.opencv import OpenCvSource, list_v4l_cameras
from rotemina.drivers.contract import CameraLostError, CameraRefusedError, CameraSettingError
from rotemina.sim.messages import Message


@pytest.fixture
def source(clock):
    return OpenCvSource(clock=clock, wait=clock.advance)


@pytest.fixture
def device(clock, capture):
    source = OpenCvSource(clock=clock, wait=clock.advance, capture=capture)
    camera = source.camera(source.parse_address("2"))
    camera.open()
    return camera


def open_video(source, path):
    camera = source.camera(source.parse_address(str(path)))
    camera.open()
    return camera


def test_a_video_plays_in_order_at_its_rate_and_repeats(source, write_video, tmp_path, clock):
    camera = open_video(source, write_video(tmp_path / "v.avi", count=5, rate_hz=20.0))
    began_s = clock()
    frames = [camera.grab(1.0) for _ in range(7)]
    assert [round(int(frame.pixels[0, 0, 0]) / 20.0) for frame in frames] == [1, 2, 3, 4, 5, 1, 2]
    assert clock() - began_s == pytest.approx(6 / 20.0)
    camera.configure(CameraSettings(rate_hz=2.0))
    camera.grab(1.0)
    before_s = clock()
    camera.grab(1.0)
    assert clock() - before_s == pytest.approx(0.5)
    camera.close()


def test_a_slow_reader_gets_every_picture_of_a_video(source, write_video, tmp_path, clock):
    camera = open_video(source, write_video(tmp_path / "v.avi", count=5))
    frames = []
    for _ in range(4):
        frames.append(camera.grab(1.0))
        clock.advance(1.0)
    assert [round(int(frame.pixels[0, 0, 0]) / 20.0) for frame in frames] == [1, 2, 3, 4]
    camera.close()


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("notes.txt", b"no film\n" * 300, "a text file, not a video"),
        ("broken.avi", b"RIFF garbage" * 100, "not a video"),
    ],
)
def test_a_file_that_is_no_video_is_refused(source, tmp_path, capfd, name, content, reason):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(CameraRefusedError, match=f"{name}.*{reason}.*choose another file"):
        open_video(source, path)
    assert capfd.readouterr() == ("", "")


def test_a_single_picture_is_refused(source, tmp_path):
    path = tmp_path / "one.png"
    cv2.imwrite(str(path), np.zeros((8, 8), np.uint8))
    with pytest.raises(CameraRefusedError, match="image sequence") as refusal:
        open_video(source, path)
    assert isinstance(dict(refusal.value.args[0].fields)["reason"], Message)


def test_a_missing_file_is_reported(source, tmp_path):
    with pytest.raises(CameraLostError, match="file not found"):
        open_video(source, tmp_path / "gone.avi")


def test_a_missing_device_is_reported(clock, capture, capfd):
    capture.is_connected = False
    source = OpenCvSource(clock=clock, wait=clock.advance, capture=capture)
    with pytest.raises(CameraLostError, match="no camera 3"):
        source.camera(source.parse_address(" 3 ")).open()
    assert capture.arguments == (3,)


def test_a_device_has_a_short_buffer_and_a_manual_exposure(device, capture):
    assert capture.properties[cv2.CAP_PROP_BUFFERSIZE] == 1
    device.configure(CameraSettings(exposure_s=0.02, gain=4.0))
    # OpenCV's unit of exposure is 100 µs.
    assert capture.properties[cv2.CAP_PROP_EXPOSURE] == 200
    assert capture.properties[cv2.CAP_PROP_GAIN] == 4.0
    assert device.grab(1.0).exposure_s == 0.02


def test_a_device_that_rejects_an_exposure_keeps_its_settings(device, capture):
    capture.rejected_properties.add(cv2.CAP_PROP_EXPOSURE)
    with pytest.raises(CameraSettingError, match=r"exposure of 0\.02 s"):
        device.configure(CameraSettings(exposure_s=0.02))
    assert device.settings == CameraSettings()


def test_a_change_of_resolution_loses_the_camera(device, capture):
    capture.shape = (24, 64, 3)
    with pytest.raises(CameraLostError, match="64 × 24 px, expected 64 × 48"):
        device.grab(1.0)


def test_colours_are_converted_from_bgr_to_rgb(device, capture):
    capture.tap.buffers = [np.full(capture.shape, (0, 0, 255), np.uint8)]
    assert device.grab(1.0).pixels[0, 0].tolist() == [255, 0, 0]


def test_a_device_that_reports_no_exposure_and_no_gain_has_none(clock, capture):
    capture.get, capture.getBackendName = lambda _: -1.0, lambda: "DSHOW"
    source = OpenCvSource(clock=clock, wait=clock.advance, capture=capture)
    camera = source.camera(source.parse_address("0"))
    camera.open()
    assert (camera.description.exposure_s, camera.description.gain) == (None, None)


def test_v4l_cameras_are_listed_in_order_without_their_metadata_nodes(tmp_path):
    for number, index, name in ((10, 0, "Late"), (2, 0, "Cam"), (3, 1, "Cam: what comes with it")):
        folder = tmp_path / f"video{number}"
        folder.mkdir()
        (folder / "index").write_text(f"{index}\n")
        (folder / "name").write_text(f"{name}\n")
    (tmp_path / "video4").mkdir()
    assert list(list_v4l_cameras(tmp_path).items()) == [("2", "Cam"), ("10", "Late")]


def test_an_empty_address_is_refused(source):
    with pytest.raises(CameraRefusedError, match="no address"):
        source.parse_address("  ")
