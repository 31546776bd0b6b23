import json

import cv2
import numpy as np
import pytest
import tifffile
from PIL import Image

from rotemina.app.cameras import (
    SnapshotMetadata,
    write_png,
    write_tiff,
)
from rotemina.drivers.cameras import CameraFrame, SensorRegion
from rotemina.sim.errors import FileWriteError

METADATA = SnapshotMetadata(
    taken="2026-03-04T05:06:07+01:00",
    camera="Zyla – µ",
    objective="20×",
    gain=2.0,
    pixel_m=0.335e-6,
    command={"x": 1.5e-3},
    measured={"x": 1.6e-3},
)


def make_frame(dtype=np.uint16, shape=(30, 40)):
    bits = 12 if dtype == np.uint16 else 8
    pixels = np.random.default_rng(1).integers(0, 1 << bits, shape).astype(dtype)
    return CameraFrame(pixels, 12.25, 7, bits, SensorRegion(3, 5, shape[1], shape[0]), 0.01)


@pytest.mark.parametrize(
    ("dtype", "shape"), [(np.uint16, (30, 40)), (np.uint8, (30, 40)), (np.uint8, (30, 40, 3))]
)
def test_tiff_has_the_raw_pixels_and_all_metadata(tmp_path, dtype, shape):
    frame = make_frame(dtype, shape)
    write_tiff(tmp_path / "a.tif", frame, METADATA)
    with tifffile.TiffFile(tmp_path / "a.tif") as file:
        page = file.pages[0]
        np.testing.assert_array_equal(page.asarray(), frame.pixels)
        description = json.loads(page.description)
        assert page.tags["ResolutionUnit"].value == 3  # cm
        per_cm = page.tags["XResolution"].value
    assert per_cm[0] / per_cm[1] == pytest.approx(0.01 / METADATA.pixel_m)
    assert description["program"].startswith("RoTeMiNa ")
    assert (description["camera"], description["objective"], description["gain"]) == (
        "Zyla – µ",
        "20×",
        2.0,
    )
    assert (description["host_time_s"], description["number"], description["exposure_s"]) == (
        12.25,
        7,
        0.01,
    )
    assert description["region_px"] == [3, 5, shape[1], shape[0]]
    assert (description["command"], description["measured"]) == ({"x": 1.5e-3}, {"x": 1.6e-3})
    assert description["taken"] == METADATA.taken
    opencv_pixels = cv2.imread(str(tmp_path / "a.tif"), cv2.IMREAD_UNCHANGED)
    expected_pixels = frame.pixels[..., ::-1] if frame.is_colour else frame.pixels
    np.testing.assert_array_equal(opencv_pixels, expected_pixels)


@pytest.mark.parametrize("shape", [(30, 40), (30, 40, 3)])
def test_png_has_the_displayed_pixels_and_all_metadata(tmp_path, shape):
    pixels = np.random.default_rng(2).integers(0, 256, shape).astype(np.uint8)
    write_png(tmp_path / "a.png", pixels, make_frame(), METADATA)
    with Image.open(tmp_path / "a.png") as image:
        np.testing.assert_array_equal(np.asarray(image), pixels)
        description = json.loads(image.text["Description"])
        assert image.info["dpi"][0] == pytest.approx(0.0254 / METADATA.pixel_m, rel=1e-6)
    assert (description["host_time_s"], description["bits"]) == (12.25, 12)


def test_no_scale_without_calibration(tmp_path):
    write_tiff(tmp_path / "a.tif", make_frame(), SnapshotMetadata())
    write_png(tmp_path / "a.png", np.zeros((4, 4), np.uint8), make_frame(), SnapshotMetadata())
    with tifffile.TiffFile(tmp_path / "a.tif") as file:
        assert json.loads(file.pages[0].description)["pixel_m"] is None
        assert file.pages[0].tags["ResolutionUnit"].value == 1  # none
    with Image.open(tmp_path / "a.png") as image:
        assert "dpi" not in image.info


def test_failed_write_leaves_no_file(tmp_path):
    with pytest.raises(FileWriteError, match="cannot be written"):
        write_tiff(tmp_path / "missing" / "a.tif", make_frame(), METADATA)
    bad_metadata = SnapshotMetadata(command={"x": object})  # fails in the middle of writing
    bad_frame = CameraFrame(np.zeros((2, 2), np.uint8), 0.0, 0, 8, SensorRegion(0, 0, 2, 2))
    object.__setattr__(bad_frame, "pixels", np.zeros((2, 2), complex))
    with pytest.raises(Exception, match=r"."):
        write_png(tmp_path / "a.png", bad_frame.pixels, bad_frame, bad_metadata)
    assert list(tmp_path.iterdir()) == []
