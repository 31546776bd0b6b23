"""Snapshots and videos of a fake microscope."""

import json
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import tifffile
from PIL import Image

from rotemina.app.errors import MicroscopeError
from rotemina.app.motion.state import SessionState
from rotemina.plugins.microscope.contrast import ColourTable, ContrastSettings
from rotemina.plugins.microscope.picture_saving import (
    VideoCapture,
    describe_video,
    format_progress,
    make_circumstances,
    write_pictures,
)

NOW = datetime(2026, 3, 4, 5, 6, 7, 890000, tzinfo=UTC)
STATE = SessionState(command={"x": 0.01}, measured={"x": 0.0101})


@pytest.fixture
def video_capture(microscope, tmp_path):
    capture = VideoCapture(microscope, tmp_path / "videos", lambda _: None, now=lambda: NOW)
    yield capture
    if capture.video is not None:
        capture.end().close()


def make_recorder(name="session"):
    notes = []
    writer = SimpleNamespace(path=Path(f"/recordings/{name}.arrows"), began_s=2.5)
    return SimpleNamespace(writer=writer, record_note=notes.append, notes=notes)


def test_a_snapshot_has_the_raw_and_the_displayed_picture(microscope, tmp_path):
    frame, folder = microscope.status.feed.frame, tmp_path / "pictures"
    circumstances = make_circumstances(microscope.status, STATE, NOW, "a.arrows")
    contrast = ContrastSettings(auto=False, table=ColourTable.INVERTED)
    tiff, png = write_pictures(folder, frame, contrast, circumstances, "one")
    with tifffile.TiffFile(tiff) as file:
        np.testing.assert_array_equal(file.pages[0].asarray(), frame.pixels)
        metadata = json.loads(file.pages[0].description)
    expected = {
        "taken": "2026-03-04T05:06:07.890+00:00",
        "camera": "Fake (fake:0)",
        "objective": "20x",
        "pixel_m": microscope.status.pixel_m,
        "command": {"x": 0.01},
        "measured": {"x": 0.0101},
        "recording": "a.arrows",
    }
    assert {key: metadata[key] for key in expected} == expected
    with Image.open(png) as image:
        displayed = np.asarray(image)
    np.testing.assert_array_equal(displayed[..., 1], 255 - np.rint(255.0 * frame.pixels / 4095))
    (folder / "taken").write_text("")
    with pytest.raises(MicroscopeError, match="cannot be created"):
        write_pictures(folder / "taken", frame, contrast, circumstances, "one")


def test_a_video_has_every_picture_until_it_ends(microscope, video_capture, make_numbered_frame):
    path = video_capture.begin(microscope.status, STATE, None)
    assert path.name == "2026-03-04_05-06-07-890000.tif"
    with pytest.raises(MicroscopeError, match="end it first"):
        video_capture.begin(microscope.status, STATE, None)
    (listener,) = microscope.listeners
    for number in range(5):
        listener(make_numbered_frame(number))
    status = video_capture.end().close()
    assert microscope.listeners == []
    assert (status.pictures, video_capture.status) == (5, None)
    assert describe_video(path, status) == f"Saved {path}: 5 pictures of 0.4 s"
    assert format_progress(status).startswith("5 pictures, 0 s, 0 MB")
    with tifffile.TiffFile(path) as file:
        metadata = [json.loads(page.description) for page in file.pages]
    assert [entry["number"] for entry in metadata] == list(range(5))
    assert metadata[0]["objective"] == "20x"
    with pytest.raises(MicroscopeError, match="no video"):
        video_capture.end()
    microscope.feed(frame=None)
    with pytest.raises(MicroscopeError, match="no picture"):
        video_capture.begin(microscope.status, STATE, None)


def test_a_video_and_its_recording_name_each_other(microscope, video_capture):
    recorder = make_recorder()
    path = video_capture.begin(microscope.status, STATE, recorder)
    assert path.name == "session.tif"
    assert recorder.notes == ["video session.tif"]
    microscope.listeners[0](microscope.status.feed.frame)
    video_capture.end().close()
    with tifffile.TiffFile(path) as file:
        metadata = json.loads(file.pages[0].description)
    assert (metadata["recording"], metadata["recording_began_s"]) == ("session.arrows", 2.5)
    assert video_capture.begin(microscope.status, STATE, recorder).name == "session_2.tif"


def test_videos_follow_recordings_if_chosen(microscope, video_capture):
    first, second = make_recorder("one"), make_recorder("two")
    assert video_capture.follow_recording(first) is None  # not chosen yet
    video_capture.follows_recordings = True
    assert video_capture.follow_recording(first) is True
    video_capture.begin(microscope.status, STATE, first)
    assert video_capture.follow_recording(first) is None
    assert video_capture.follow_recording(None) is False
    video_capture.end().close()
    assert video_capture.follow_recording(None) is None
    # A video started by hand is independent of recordings.
    video_capture.begin(microscope.status, STATE, None)
    assert video_capture.follow_recording(second) is None
    assert video_capture.follow_recording(second) is None
    assert video_capture.follow_recording(None) is None
