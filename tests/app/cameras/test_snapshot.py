import json

import cv2
import numpy as np
import pytest
import tifffile
from PIL import Image

from rotemina.app.cameras.snapshot import Circumstances, write_png, write_tiff
from rotemina.drivers.cameras.frame import Frame, Region
from rotemina.sim.whole_files import FileWriteError

ABOUT = Circumstances(
    taken="2026-03-04T05:06:07+01:00",
    camera="Zyla – µ",
    objective="20×",
    gain=2.0,
    pixel_m=0.335e-6,
    command={"x": 1.5e-3},
    measured={"x": 1.6e-3},
)


def frame(dtype=np.uint16, shape=(30, 40)):
    bits = 12 if dtype == np.uint16 else 8
    pixels = np.random.default_rng(1).integers(0, 1 << bits, shape).astype(dtype)
    return Frame(pixels, 12.25, 7, bits, Region(3, 5, shape[1], shape[0]), 0.01)


@pytest.mark.parametrize(
    ("dtype", "shape"), [(np.uint16, (30, 40)), (np.uint8, (30, 40)), (np.uint8, (30, 40, 3))]
)
def test_a_tiff_has_the_cameras_numbers_and_all_that_is_known(tmp_path, dtype, shape):
    taken = frame(dtype, shape)
    write_tiff(tmp_path / "a.tif", taken, ABOUT)
    with tifffile.TiffFile(tmp_path / "a.tif") as file:
        page = file.pages[0]
        np.testing.assert_array_equal(page.asarray(), taken.pixels)
        facts = json.loads(page.description)
        assert page.tags["ResolutionUnit"].value == 3  # cm
        per_cm = page.tags["XResolution"].value
    assert per_cm[0] / per_cm[1] == pytest.approx(0.01 / ABOUT.pixel_m)
    assert facts["program"].startswith("RoTeMiNa ")
    assert (facts["camera"], facts["objective"], facts["gain"]) == ("Zyla – µ", "20×", 2.0)
    assert (facts["host_time_s"], facts["number"], facts["exposure_s"]) == (12.25, 7, 0.01)
    assert facts["region_px"] == [3, 5, shape[1], shape[0]]
    assert (facts["command"], facts["measured"]) == ({"x": 1.5e-3}, {"x": 1.6e-3})
    assert facts["taken"] == ABOUT.taken
    other = cv2.imread(str(tmp_path / "a.tif"), cv2.IMREAD_UNCHANGED)
    shown = taken.pixels[..., ::-1] if taken.colour else taken.pixels
    np.testing.assert_array_equal(other, shown)


@pytest.mark.parametrize("shape", [(30, 40), (30, 40, 3)])
def test_a_png_has_what_is_seen_and_all_that_is_known(tmp_path, shape):
    shown = np.random.default_rng(2).integers(0, 256, shape).astype(np.uint8)
    write_png(tmp_path / "a.png", shown, frame(), ABOUT)
    with Image.open(tmp_path / "a.png") as image:
        np.testing.assert_array_equal(np.asarray(image), shown)
        facts = json.loads(image.text["Description"])
        assert image.info["dpi"][0] == pytest.approx(0.0254 / ABOUT.pixel_m, rel=1e-6)
    assert (facts["host_time_s"], facts["bits"]) == (12.25, 12)


def test_without_a_calibration_there_is_no_scale(tmp_path):
    write_tiff(tmp_path / "a.tif", frame(), Circumstances())
    write_png(tmp_path / "a.png", np.zeros((4, 4), np.uint8), frame(), Circumstances())
    with tifffile.TiffFile(tmp_path / "a.tif") as file:
        assert json.loads(file.pages[0].description)["pixel_m"] is None
        assert file.pages[0].tags["ResolutionUnit"].value == 1  # none
    with Image.open(tmp_path / "a.png") as image:
        assert "dpi" not in image.info


def test_whole_or_not_at_all(tmp_path):
    with pytest.raises(FileWriteError, match="cannot be written"):
        write_tiff(tmp_path / "missing" / "a.tif", frame(), ABOUT)
    bad = Circumstances(command={"x": object})  # anything in the middle of writing
    broken = Frame(np.zeros((2, 2), np.uint8), 0.0, 0, 8, Region(0, 0, 2, 2))
    object.__setattr__(broken, "pixels", np.zeros((2, 2), complex))
    with pytest.raises(Exception, match=r"."):
        write_png(tmp_path / "a.png", broken.pixels, broken, bad)
    assert list(tmp_path.iterdir()) == []
