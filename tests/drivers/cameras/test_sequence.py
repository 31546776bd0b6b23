"""Folders of pictures, and files with several pages."""

import cv2
import numpy as np
import pytest

from rotemina.drivers.cameras import CameraSettings
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.contract import CameraLostError, CameraRefusedError


@pytest.fixture
def source(clock):
    return ImageSequenceSource(clock=clock, wait=clock.advance)


def open_camera(source, path):
    camera = source.camera(source.parse_address(str(path)))
    camera.open()
    return camera


@pytest.mark.parametrize("kind", ["png", "tif"])
def test_files_are_read_in_natural_order_with_sixteen_bits(source, write_sequence, kind):
    folder = write_sequence([10, 9, 1000], kind=kind)
    (folder / "notes.txt").write_text("not a picture")
    camera = open_camera(source, folder)
    frames = [camera.grab(1.0) for _ in range(4)]
    assert [int(frame.pixels[0, 0]) for frame in frames] == [9, 10, 1000, 9]
    assert {frame.bits for frame in frames} == {16}
    assert frames[0].metadata == {"file": f"9.{kind}", "page": 0}


def test_a_file_with_pages_plays_once_and_ends(source, tmp_path):
    pages = [np.full((8, 9), 4095 - page, np.uint16) for page in range(3)]
    cv2.imwritemulti(str(tmp_path / "stack.tif"), pages)
    camera = open_camera(source, tmp_path / "stack.tif")
    camera.configure(CameraSettings(repeat=False))
    assert [int(camera.grab(1.0).pixels[0, 0]) for _ in range(3)] == [4095, 4094, 4093]
    with pytest.raises(CameraLostError, match="ended after 3 pictures"):
        camera.grab(1.0)


def test_colours_are_in_rgb_order(source, tmp_path):
    (tmp_path / "s").mkdir()
    cv2.imwrite(str(tmp_path / "s" / "1.png"), np.full((4, 4, 3), (0, 0, 200), np.uint8))
    assert open_camera(source, tmp_path / "s").grab(1.0).pixels[0, 0].tolist() == [200, 0, 0]


@pytest.mark.parametrize(("size", "dtype"), [((32, 48), np.uint16), ((64, 48), np.uint8)])
def test_pictures_unlike_the_first_are_skipped(source, write_sequence, size, dtype):
    write_sequence([1, 4])
    camera = open_camera(source, write_sequence([2, 3], size, dtype))
    frames = [camera.grab(1.0) for _ in range(3)]
    assert [int(frame.pixels[0, 0]) for frame in frames] == [1, 4, 1]
    assert [frame.lost for frame in frames] == [0, 2, 2]
    write_sequence([1, 4], size, dtype)
    with pytest.raises(
        CameraLostError, match=r"32 × 48 px, expected 64|mono8, but the first one has type mono16"
    ):
        [camera.grab(1.0) for _ in range(2)]


def test_an_unreadable_first_file_is_skipped(source, write_sequence):
    folder = write_sequence([1, 2])
    (folder / "1.png").write_bytes(b"")
    assert open_camera(source, folder).grab(1.0).pixels[0, 0] == 2


def test_a_path_without_a_sequence_is_refused(source, tmp_path):
    with pytest.raises(CameraLostError, match="folder or file not found"):
        open_camera(source, tmp_path / "gone")
    with pytest.raises(CameraRefusedError, match="no TIFF or PNG"):
        open_camera(source, tmp_path)
    (tmp_path / "cut.tif").write_bytes(b"II*\0 cut off")
    with pytest.raises(CameraRefusedError, match="not a picture"):
        open_camera(source, tmp_path / "cut.tif")
    with pytest.raises(CameraRefusedError, match="no address"):
        source.parse_address("")
