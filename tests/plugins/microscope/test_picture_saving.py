"""Snapshots and films of a microscope that gives what the test says."""

import json
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import tifffile
from PIL import Image

from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.motion.state import SessionState
from rotemina.plugins.microscope.contrast import Contrast, Table
from rotemina.plugins.microscope.picture_saving import (
    VideoCapture,
    circumstances,
    progress,
    summary,
    write_pictures,
)

NOW = datetime(2026, 3, 4, 5, 6, 7, 890000, tzinfo=UTC)
STATE = SessionState(command={"x": 0.01}, measured={"x": 0.0101})


@pytest.fixture
def filming(microscope, tmp_path):
    made = VideoCapture(microscope, tmp_path / "videos", lambda _: None, now=lambda: NOW)
    yield made
    if made.video is not None:
        made.end().close()


def recorder(name="session"):
    notes = []
    writer = SimpleNamespace(path=Path(f"/recordings/{name}.arrows"), began_s=2.5)
    return SimpleNamespace(writer=writer, note=notes.append, notes=notes)


def test_a_snapshot_is_what_the_camera_gave_and_what_was_seen(microscope, tmp_path):
    frame = microscope.status.feed.frame
    about = circumstances(microscope.status, STATE, NOW, "a.arrows")
    contrast = Contrast(auto=False, table=Table.INVERTED)
    tiff, png = write_pictures(tmp_path / "pictures", frame, contrast, about, "one")
    with tifffile.TiffFile(tiff) as file:
        np.testing.assert_array_equal(file.pages[0].asarray(), frame.pixels)
        facts = json.loads(file.pages[0].description)
    assert facts["taken"] == "2026-03-04T05:06:07.890+00:00"
    assert (facts["camera"], facts["objective"]) == ("Fake (fake:0)", "20x")
    assert facts["pixel_m"] == microscope.status.pixel_m
    assert (facts["command"], facts["measured"]) == ({"x": 0.01}, {"x": 0.0101})
    assert facts["recording"] == "a.arrows"
    with Image.open(png) as image:
        seen = np.asarray(image)
    expected = 255 - np.rint(255.0 * frame.pixels / 4095)
    np.testing.assert_array_equal(seen[..., 1], expected)
    (tmp_path / "pictures" / "taken").write_text("")
    with pytest.raises(MicroscopeError, match="cannot be created"):
        write_pictures(tmp_path / "pictures" / "taken", frame, contrast, about, "one")


def test_a_film_has_every_picture_that_is_told_until_it_ends(microscope, filming, frame_of):
    path = filming.begin(microscope.status, STATE, None)
    assert path.name == "2026-03-04_05-06-07-890000.tif"
    with pytest.raises(MicroscopeError, match="end it first"):
        filming.begin(microscope.status, STATE, None)
    (tell,) = microscope.listeners
    for number in range(5):
        tell(frame_of(number))
    status = filming.end().close()
    assert microscope.listeners == []
    assert (status.pictures, filming.status) == (5, None)
    assert summary(path, status) == f"Saved {path}: 5 pictures of 0.4 s"
    assert progress(status).startswith("5 pictures, 0 s, 0 MB")
    with tifffile.TiffFile(path) as file:
        facts = [json.loads(page.description) for page in file.pages]
    assert [one["number"] for one in facts] == list(range(5))
    assert facts[0]["objective"] == "20x"
    with pytest.raises(MicroscopeError, match="no video"):
        filming.end()
    microscope.feed(frame=None)
    with pytest.raises(MicroscopeError, match="no picture"):
        filming.begin(microscope.status, STATE, None)


def test_a_film_of_a_recording_says_so_and_so_does_the_recording(microscope, filming):
    running = recorder()
    path = filming.begin(microscope.status, STATE, running)
    assert path.name == "session.tif"
    assert running.notes == ["video session.tif"]
    microscope.listeners[0](microscope.status.feed.frame)
    filming.end().close()
    with tifffile.TiffFile(path) as file:
        facts = json.loads(file.pages[0].description)
    assert (facts["recording"], facts["recording_began_s"]) == ("session.arrows", 2.5)
    assert filming.begin(microscope.status, STATE, running).name == "session_2.tif"


def test_films_follow_recordings_where_that_is_wanted(microscope, filming):
    first, second = recorder("one"), recorder("two")
    assert filming.due(first) is None  # nobody wants it
    filming.follows = True
    assert filming.due(first) is True
    filming.begin(microscope.status, STATE, first)
    assert filming.due(first) is None
    assert filming.due(None) is False
    filming.end().close()
    assert filming.due(None) is None
    filming.begin(microscope.status, STATE, None)  # by hand: it goes on beside a recording
    assert filming.due(second) is None
    assert filming.due(second) is None
    assert filming.due(None) is None
