"""Every picture of the documentation can be made anew, has its size, and shows something."""

import os
import subprocess
import sys
from collections import Counter

import pytest
from PIL import Image

# Fonts of another machine make panels a little wider or higher; windows have the size asked for.
SLACK = 0.1
LEAST_COLOURS = 200  # of text with smooth edges alone
MOST_OF_ONE = 0.97  # of the area; an empty panel is all ground

# On one worker: the pictures are made once.
pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("screenshots")]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The folder of the pictures as they are now."""
    folder = tmp_path_factory.mktemp("screenshots")
    done = subprocess.run(
        [sys.executable, "-m", "rotemina.app.shell.screenshots", str(folder)],
        capture_output=True, text=True, check=False, timeout=900,
        env={**os.environ, "XDG_CONFIG_HOME": str(folder / "nobody")},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return folder


def pictures_in(folder):
    found = {path.name: path for path in folder.glob("*.png")}
    assert found
    return found


def test_every_picture_is_made_anew_in_its_size(made, root):
    kept, new = pictures_in(root / "docs" / "screenshots"), pictures_in(made)
    assert sorted(new) == sorted(kept)  # `make screenshots`
    odd = []
    for name, path in new.items():
        with Image.open(path) as one, Image.open(kept[name]) as other:
            slack = 0.0 if name.startswith("window-") else SLACK
            pairs = zip(one.size, other.size, strict=True)
            if any(abs(now - then) > slack * then for now, then in pairs):
                odd.append(f"{name}: {one.size}, kept {other.size}")
    assert odd == []


def test_no_picture_is_empty(made, root):
    for folder in (made, root / "docs" / "screenshots"):
        for name, path in pictures_in(folder).items():
            with Image.open(path) as picture:
                counted = Counter(dict(colours_of(picture)))
            assert len(counted) >= LEAST_COLOURS, name
            assert counted.most_common(1)[0][1] < MOST_OF_ONE * counted.total(), name


def colours_of(picture):
    area = picture.width * picture.height
    return [(colour, count) for count, colour in picture.convert("RGB").getcolors(area)]
