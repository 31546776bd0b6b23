"""The examples on the pages about cameras work."""

import re
from pathlib import Path

import numpy as np
import pytest

from rotemina.drivers.cameras import CameraHub
from rotemina.drivers.contract import CameraLostError

DOCS = Path(__file__).parents[3] / "docs"


def code_blocks(page):
    return re.findall(r"```python\n(.*?)```", (DOCS / page).read_text("utf-8"), re.DOTALL)


def test_the_example_source_works(tmp_path, clock):
    names = {}
    exec(code_blocks("cameras.md")[0], names)  # noqa: S102 - the page's own code
    names["FILE"] = file = tmp_path / "picture.npy"
    hub = CameraHub({"shown": names["Shown"](clock=clock, wait=clock.advance)})
    assert hub.find_cameras() == ()
    np.save(file, np.full((6, 8), 7, np.uint8))
    camera = hub.make_camera(hub.find_cameras()[0])
    camera.open()
    assert camera.grab(1.0).pixels.tolist() == [[7] * 8] * 6
    file.unlink()
    with pytest.raises(CameraLostError, match="start the other program"):
        camera.grab(1.0)


def test_the_example_of_the_microscope_works():
    names = {}
    (example,) = (block for block in code_blocks("microscope.md") if "Renderer" in block)
    exec(example, names)  # noqa: S102 - the page's own code
    assert names["picture"].shape == (1030, 1300)
    np.testing.assert_allclose([names["u"], names["v"]], [649.5, 514.5])
