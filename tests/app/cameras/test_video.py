import errno
import json
import os
import signal
import subprocess
import sys
import threading
from contextlib import closing
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import pytest
import tifffile

from rotemina.app.cameras import VideoRecorder
from rotemina.app.cameras.video_file import VideoFile
from rotemina.app.errors import VideoError
from rotemina.app.settings import open_new_file
from rotemina.drivers.cameras import CameraFrame, SensorRegion

PATIENCE_S = 20.0
LINK_BYTES = 8  # length of the link to a page


def make_frame(number, shape=(30, 40), dtype=np.uint16):
    bits = 12 if dtype == np.uint16 else 8
    pixels = np.random.default_rng(number).integers(0, 1 << bits, shape).astype(dtype)
    return CameraFrame(
        pixels, 5.0 + number / 30.0, number, bits, SensorRegion(0, 0, shape[1], shape[0]), 0.01
    )


def read_pages(path):
    with tifffile.TiffFile(path) as file:
        return [(page.asarray(), json.loads(page.description)) for page in file.pages]


@pytest.mark.parametrize(
    ("shape", "dtype"), [((30, 40), np.uint16), ((31, 41), np.uint8), ((30, 40, 3), np.uint8)]
)
def test_video_has_every_picture_with_its_time_and_opens_in_other_tools(tmp_path, shape, dtype):
    path = tmp_path / "videos" / "a.tif"
    video = VideoRecorder(path, {"camera": "µ-scope", "recording": "b.arrows"}, pixel_m=0.335e-6)
    video.start()
    frames = [make_frame(number, shape, dtype) for number in range(6)]
    for frame in frames:
        video.queue_frame(frame)
    status = video.close()
    assert (status.pictures, status.dropped, status.failure) == (6, 0, "")
    assert status.duration_s == pytest.approx(5.0 / 30.0)
    assert status.bytes_written == path.stat().st_size
    pages = read_pages(path)
    assert len(pages) == 6
    for (pixels, description), frame in zip(pages, frames, strict=True):
        np.testing.assert_array_equal(pixels, frame.pixels)
        assert (description["host_time_s"], description["number"]) == (
            frame.host_time_s,
            frame.number,
        )
    assert pages[0][1]["recording"] == "b.arrows"
    with tifffile.TiffFile(path) as file:
        assert file.is_bigtiff
        per_cm, _ = file.pages[0].tags["XResolution"].value
        assert per_cm == round(0.01 / 0.335e-6)
    is_readable, opencv_pages = cv2.imreadmulti(str(path), flags=cv2.IMREAD_UNCHANGED)
    assert is_readable
    assert len(opencv_pages) == 6
    expected_pixels = frames[5].pixels[..., ::-1] if frames[5].is_colour else frames[5].pixels
    np.testing.assert_array_equal(opencv_pages[5], expected_pixels)


class LimitedDisk:
    """A file that accepts a number of bytes and then raises an error."""

    def __init__(self, path, capacity, error=None):
        self._file = open_new_file(path)
        self._capacity = capacity
        self._error = error or OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def write(self, data):
        if len(data) > self._capacity:
            if len(data) > LINK_BYTES:  # a shorter write is atomic
                self._file.write(data[: self._capacity])
            self._capacity = 0
            raise self._error
        self._capacity -= len(data)
        return self._file.write(data)

    def __getattr__(self, name):
        return getattr(self._file, name)


def append_frames(file, end_positions=None):
    for number in range(3):
        file.append(make_frame(number, (4, 6)))
        if end_positions is not None:
            end_positions.append(file.size)


def test_video_is_readable_after_a_kill_at_any_byte(tmp_path):
    with closing(VideoFile(tmp_path / "whole.tif", {"camera": "c"})) as file:
        end_positions = [file.size]
        append_frames(file, end_positions)
    # From the end of the first page to the end of the last one, plus their links.
    first, last = end_positions[1] + LINK_BYTES, end_positions[3] + 2 * LINK_BYTES
    for capacity in range(first, last, 7):
        path = tmp_path / f"{capacity}.tif"
        open_disk = partial(LimitedDisk, capacity=capacity, error=KeyboardInterrupt())
        with (
            closing(VideoFile(path, {"camera": "c"}, opener=open_disk)) as file,
            pytest.raises(KeyboardInterrupt),
        ):
            append_frames(file)
        page_count = 1 if capacity < end_positions[2] + 2 * LINK_BYTES else 2
        assert [description["number"] for _, description in read_pages(path)] == list(
            range(page_count)
        )


def test_full_disk_is_reported_and_written_pictures_stay(tmp_path):
    messages = []
    path = tmp_path / "a.tif"
    video = VideoRecorder(path, notify=messages.append, opener=lambda path: LimitedDisk(path, 9000))
    video.start()
    for number in range(6):
        video.queue_frame(make_frame(number))
    status = video.close()
    assert status.pictures == 3
    assert "No space left" in status.failure
    assert "3 pictures are kept" in status.failure
    assert messages == [status.failure]
    assert [description["number"] for _, description in read_pages(path)] == [0, 1, 2]
    assert status.bytes_written == path.stat().st_size


class SlowDisk(LimitedDisk):
    """A disk that blocks every write until an event is set."""

    def __init__(self, path, writable):
        super().__init__(path, 1 << 30)
        self._writable = writable

    def write(self, data):
        assert self._writable.wait(PATIENCE_S)
        return super().write(data)


def test_slow_disk_drops_and_counts_pictures_without_blocking(tmp_path):
    messages, writable = [], threading.Event()
    writable.set()
    size = make_frame(0).pixels.nbytes
    video = VideoRecorder(
        tmp_path / "a.tif",
        notify=messages.append,
        capacity_bytes=3 * size,
        opener=lambda path: SlowDisk(path, writable),
    )
    writable.clear()
    video.start()
    for number in range(20):
        video.queue_frame(make_frame(number))  # would hang here
    status = video.status
    assert status.pictures == 0
    assert 16 <= status.dropped <= 17  # three are queued, and one may be being written
    with pytest.raises(VideoError, match="the last pictures could not be written"):
        video.close(timeout_s=0.0)
    writable.set()
    status = video.close(PATIENCE_S)
    assert status.pictures + status.dropped == 20
    assert len(read_pages(tmp_path / "a.tif")) == status.pictures
    assert len(messages) == 1
    assert "pictures are missing in the video" in messages[0]


def test_picture_of_another_size_is_dropped(tmp_path):
    video = VideoRecorder(tmp_path / "a.tif")
    video.start()
    for frame in (
        make_frame(0),
        make_frame(1, (10, 12)),
        make_frame(2, dtype=np.uint8),
        make_frame(3),
    ):
        video.queue_frame(frame)
    status = video.close()
    assert (status.pictures, status.dropped) == (2, 2)
    video.queue_frame(make_frame(4))  # after the end
    assert video.status == status


def test_existing_file_is_not_overwritten(tmp_path):
    (tmp_path / "a.tif").write_text("mine")
    with pytest.raises(VideoError, match="already exists"):
        VideoRecorder(tmp_path / "a.tif")
    with pytest.raises(VideoError, match="cannot be written"):
        VideoRecorder(tmp_path / "a.tif" / "b.tif")
    assert (tmp_path / "a.tif").read_text() == "mine"


ENDLESS_RECORDING = """
import sys, numpy as np
from pathlib import Path
from rotemina.app.cameras import VideoRecorder
from rotemina.drivers.cameras import CameraFrame, SensorRegion
video = VideoRecorder(Path(sys.argv[1]))
video.start()
announced = False
for number in range(1000000):
    pixels = np.full((200, 300), number, np.uint16)
    video.queue_frame(CameraFrame(pixels, number / 30.0, number, 16, SensorRegion(0, 0, 300, 200)))
    if not announced and video.status.pictures > 10:  # the disk has some of them
        announced = True
        print("go", flush=True)
"""


def test_video_of_a_killed_process_is_readable(tmp_path):
    path = tmp_path / "a.tif"
    with subprocess.Popen(
        [sys.executable, "-c", ENDLESS_RECORDING, str(path)], stdout=subprocess.PIPE
    ) as process:
        process.stdout.readline()
        process.send_signal(signal.SIGKILL)
    pages = read_pages(path)
    assert pages
    for pixels, description in pages:
        assert (pixels == description["number"]).all()


def read_resident_bytes():
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(
    not Path("/proc/self/statm").exists(), reason="reads memory use from Linux /proc"
)
@pytest.mark.slow
def test_memory_does_not_grow_with_the_number_of_pictures(tmp_path):
    """The pictures are small: if all of them stayed in memory, these would be 54 MB."""
    video = VideoRecorder(tmp_path / "a.tif", capacity_bytes=500_000)
    video.start()
    resident_bytes = {}
    for number in range(4000):
        while video.status.pictures + video.status.dropped < number - 8:
            threading.Event().wait(0.001)
        video.queue_frame(make_frame(number, (75, 90)))
        if number in (200, 3999):
            resident_bytes[number] = read_resident_bytes()
    status = video.close(60.0)
    assert (status.pictures, status.dropped) == (4000, 0)
    assert resident_bytes[3999] - resident_bytes[200] < 4_000_000
    with tifffile.TiffFile(tmp_path / "a.tif") as file:
        assert len(file.pages) == 4000
        assert json.loads(file.pages[3999].description)["number"] == 3999
