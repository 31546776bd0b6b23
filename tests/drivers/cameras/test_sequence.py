"""Folders of pictures, and files of many pages."""

import cv2
import numpy as np
import pytest

from rotemina.drivers.cameras.errors import CameraLostError, CameraRefusedError
from rotemina.drivers.cameras.sequence import ImageSequences
from rotemina.drivers.cameras.settings import CameraSettings


@pytest.fixture
def source(clock):
    return ImageSequences(clock=clock, wait=clock.advance)


def opened(source, path):
    camera = source.camera(source.addressed(str(path)))
    camera.open()
    return camera


@pytest.mark.parametrize("kind", ["png", "tif"])
def test_natural_order_and_sixteen_bits(source, write_sequence, kind):
    folder = write_sequence([10, 9, 1000], kind=kind)
    (folder / "notes.txt").write_text("not a picture")
    camera = opened(source, folder)
    shown = [camera.grab(1.0) for _ in range(4)]
    assert [int(frame.pixels[0, 0]) for frame in shown] == [9, 10, 1000, 9]
    assert {frame.bits for frame in shown} == {16}
    assert shown[0].metadata == {"file": f"9.{kind}", "page": 0}


def test_pages_of_one_file_and_its_end(source, tmp_path):
    pages = [np.full((8, 9), 4095 - page, np.uint16) for page in range(3)]
    cv2.imwritemulti(str(tmp_path / "stack.tif"), pages)
    camera = opened(source, tmp_path / "stack.tif")
    camera.configure(CameraSettings(repeat=False))
    assert [int(camera.grab(1.0).pixels[0, 0]) for _ in range(3)] == [4095, 4094, 4093]
    with pytest.raises(CameraLostError, match="ended after 3 pictures"):
        camera.grab(1.0)


def test_colour_is_red_green_blue(source, tmp_path):
    (tmp_path / "s").mkdir()
    cv2.imwrite(str(tmp_path / "s" / "1.png"), np.full((4, 4, 3), (0, 0, 200), np.uint8))
    assert opened(source, tmp_path / "s").grab(1.0).pixels[0, 0].tolist() == [200, 0, 0]


@pytest.mark.parametrize(("size", "dtype"), [((32, 48), np.uint16), ((64, 48), np.uint8)])
def test_pictures_unlike_the_first_are_passed_over(source, write_sequence, size, dtype):
    write_sequence([1, 4])
    camera = opened(source, write_sequence([2, 3], size, dtype))
    frames = [camera.grab(1.0) for _ in range(3)]
    assert [int(frame.pixels[0, 0]) for frame in frames] == [1, 4, 1]
    assert [frame.lost for frame in frames] == [0, 2, 2]
    write_sequence([1, 4], size, dtype)
    with pytest.raises(
        CameraLostError, match=r"32 × 48 px, expected 64|mono8, but the first has mono16"
    ):
        [camera.grab(1.0) for _ in range(2)]


def test_a_first_file_that_cannot_be_read_is_passed_over(source, write_sequence):
    folder = write_sequence([1, 2])
    (folder / "1.png").write_bytes(b"")
    assert opened(source, folder).grab(1.0).pixels[0, 0] == 2


def test_what_is_no_sequence(source, tmp_path):
    with pytest.raises(CameraLostError, match="folder or file not found"):
        opened(source, tmp_path / "gone")
    with pytest.raises(CameraRefusedError, match="no TIFF or PNG"):
        opened(source, tmp_path)
    (tmp_path / "cut.tif").write_bytes(b"II*\0 cut off")
    with pytest.raises(CameraRefusedError, match="not a picture"):
        opened(source, tmp_path / "cut.tif")
    with pytest.raises(CameraRefusedError, match="no address"):
        source.addressed("")
