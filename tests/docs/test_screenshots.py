"""Every picture of the documentation can be made again, keeps its size, and is not empty."""

import os
import subprocess
import sys
from collections import Counter

import pytest
from PIL import Image

# Fonts of another machine make panels a little wider or higher. Windows have the requested size.
MAX_SIZE_DEVIATION = 0.1
# Text with smooth edges alone has this number of colours.
MIN_COLOURS = 200
# An empty panel consists of background only.
MAX_SHARE_OF_ONE_COLOUR = 0.97

# On one worker, so that the pictures are made only once.
pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("screenshots")]


@pytest.fixture(scope="module")
def new_pictures_folder(tmp_path_factory):
    """The folder of newly made pictures."""
    folder = tmp_path_factory.mktemp("screenshots")
    process = subprocess.run(
        [sys.executable, "-m", "rotemina.app.shell.startup.screenshots", str(folder)],
        capture_output=True, text=True, check=False, timeout=900,
        env={**os.environ, "XDG_CONFIG_HOME": str(folder / "nobody")},
    )  # fmt: skip
    assert process.returncode == 0, process.stderr
    return folder


def find_pictures(folder):
    pictures = {path.name: path for path in folder.glob("*.png")}
    assert pictures
    return pictures


def test_every_new_picture_has_the_size_of_the_stored_one(new_pictures_folder, root):
    stored, new = find_pictures(root / "docs" / "screenshots"), find_pictures(new_pictures_folder)
    assert sorted(new) == sorted(stored)  # Repair: `make screenshots`.
    deviations = []
    for name, path in new.items():
        with Image.open(path) as new_picture, Image.open(stored[name]) as stored_picture:
            max_deviation = 0.0 if name.startswith("window-") else MAX_SIZE_DEVIATION
            pairs = zip(new_picture.size, stored_picture.size, strict=True)
            if any(
                abs(new_length - stored_length) > max_deviation * stored_length
                for new_length, stored_length in pairs
            ):
                deviations.append(f"{name}: {new_picture.size}, stored {stored_picture.size}")
    assert deviations == []


def test_no_new_picture_is_empty(new_pictures_folder):
    for name, path in find_pictures(new_pictures_folder).items():
        with Image.open(path) as picture:
            counts = Counter(dict(count_colours(picture)))
        assert len(counts) >= MIN_COLOURS, name
        assert counts.most_common(1)[0][1] < MAX_SHARE_OF_ONE_COLOUR * counts.total(), name


def count_colours(picture):
    area = picture.width * picture.height
    return [(colour, count) for count, colour in picture.convert("RGB").getcolors(area)]
