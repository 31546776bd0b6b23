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

from rotemina.app.cameras.video import Video, VideoError
from rotemina.app.cameras.video_file import VideoFile
from rotemina.app.files import new_file
from rotemina.drivers.cameras.frame import Frame, Region

PATIENCE_S = 20.0
LINK = 8  # bytes that link a page


def frame(number, shape=(30, 40), dtype=np.uint16):
    bits = 12 if dtype == np.uint16 else 8
    pixels = np.random.default_rng(number).integers(0, 1 << bits, shape).astype(dtype)
    return Frame(pixels, 5.0 + number / 30.0, number, bits, Region(0, 0, shape[1], shape[0]), 0.01)


def pages(path):
    with tifffile.TiffFile(path) as file:
        return [(page.asarray(), json.loads(page.description)) for page in file.pages]


@pytest.mark.parametrize(
    ("shape", "dtype"), [((30, 40), np.uint16), ((31, 41), np.uint8), ((30, 40, 3), np.uint8)]
)
def test_every_picture_with_its_time_in_a_file_that_other_tools_open(tmp_path, shape, dtype):
    path = tmp_path / "videos" / "a.tif"
    video = Video(path, {"camera": "µ-scope", "recording": "b.arrows"}, pixel_m=0.335e-6)
    video.start()
    taken = [frame(number, shape, dtype) for number in range(6)]
    for one in taken:
        video.take(one)
    status = video.close()
    assert (status.pictures, status.dropped, status.failure) == (6, 0, "")
    assert status.lasts_s == pytest.approx(5.0 / 30.0)
    assert status.bytes_written == path.stat().st_size
    found = pages(path)
    assert len(found) == 6
    for (pixels, facts), one in zip(found, taken, strict=True):
        np.testing.assert_array_equal(pixels, one.pixels)
        assert (facts["host_time_s"], facts["number"]) == (one.host_time_s, one.number)
    assert found[0][1]["recording"] == "b.arrows"
    with tifffile.TiffFile(path) as file:
        assert file.is_bigtiff
        per_cm, _ = file.pages[0].tags["XResolution"].value
        assert per_cm == round(0.01 / 0.335e-6)
    read, others = cv2.imreadmulti(str(path), flags=cv2.IMREAD_UNCHANGED)
    assert read
    assert len(others) == 6
    shown = taken[5].pixels[..., ::-1] if taken[5].colour else taken[5].pixels
    np.testing.assert_array_equal(others[5], shown)


class Disk:
    """A file that takes so many bytes, and then says why it takes no more."""

    def __init__(self, path, room, end=None):
        self._file = new_file(path)
        self._room = room
        self._end = end or OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def write(self, data):
        if len(data) > self._room:
            if len(data) > LINK:  # so short a write is done as a whole, or not
                self._file.write(data[: self._room])
            self._room = 0
            raise self._end
        self._room -= len(data)
        return self._file.write(data)

    def __getattr__(self, name):
        return getattr(self._file, name)


def append(file, ends=None):
    for number in range(3):
        file.append(frame(number, (4, 6)))
        if ends is not None:
            ends.append(file.size)


def test_at_whatever_byte_it_is_killed_it_can_be_read(tmp_path):
    with closing(VideoFile(tmp_path / "whole.tif", {"camera": "c"})) as file:
        ends = [file.size]
        append(file, ends)
    for room in range(ends[1] + LINK, ends[3] + 2 * LINK, 7):  # beside the pages, their links
        path = tmp_path / f"{room}.tif"
        disk = partial(Disk, room=room, end=KeyboardInterrupt())
        with (
            closing(VideoFile(path, {"camera": "c"}, opener=disk)) as file,
            pytest.raises(KeyboardInterrupt),
        ):
            append(file)
        kept = 1 if room < ends[2] + 2 * LINK else 2
        assert [facts["number"] for _, facts in pages(path)] == list(range(kept))


def test_a_full_disk_is_told_and_what_is_there_stays(tmp_path):
    told = []
    path = tmp_path / "a.tif"
    video = Video(path, tell=told.append, opener=lambda path: Disk(path, 9000))
    video.start()
    for number in range(6):
        video.take(frame(number))
    status = video.close()
    assert status.pictures == 3
    assert "No space left" in status.failure
    assert "3 pictures are kept" in status.failure
    assert told == [status.failure]
    assert [facts["number"] for _, facts in pages(path)] == [0, 1, 2]
    assert status.bytes_written == path.stat().st_size


class SlowDisk(Disk):
    """One that takes nothing until it may."""

    def __init__(self, path, may):
        super().__init__(path, 1 << 30)
        self._may = may

    def write(self, data):
        assert self._may.wait(PATIENCE_S)
        return super().write(data)


def test_a_slow_disk_drops_pictures_counts_them_and_keeps_nobody_waiting(tmp_path):
    told, may = [], threading.Event()
    may.set()
    size = frame(0).pixels.nbytes
    video = Video(
        tmp_path / "a.tif",
        tell=told.append,
        capacity_bytes=3 * size,
        opener=lambda path: SlowDisk(path, may),
    )
    may.clear()
    video.start()
    for number in range(20):
        video.take(frame(number))  # would hang here
    status = video.status
    assert status.pictures == 0
    assert 16 <= status.dropped <= 17  # three wait, and one may be on its way
    with pytest.raises(VideoError, match="the last pictures could not be written"):
        video.close(timeout_s=0.0)
    may.set()
    status = video.close(PATIENCE_S)
    assert status.pictures + status.dropped == 20
    assert len(pages(tmp_path / "a.tif")) == status.pictures
    assert len(told) == 1
    assert "pictures are missing in the video" in told[0]


def test_a_picture_of_another_size_is_left_out(tmp_path):
    video = Video(tmp_path / "a.tif")
    video.start()
    for one in (frame(0), frame(1, (10, 12)), frame(2, dtype=np.uint8), frame(3)):
        video.take(one)
    status = video.close()
    assert (status.pictures, status.dropped) == (2, 2)
    video.take(frame(4))  # after the end
    assert video.status == status


def test_a_file_is_never_overwritten(tmp_path):
    (tmp_path / "a.tif").write_text("mine")
    with pytest.raises(VideoError, match="already exists"):
        Video(tmp_path / "a.tif")
    with pytest.raises(VideoError, match="cannot be written"):
        Video(tmp_path / "a.tif" / "b.tif")
    assert (tmp_path / "a.tif").read_text() == "mine"


KILLED = """
import sys, numpy as np
from pathlib import Path
from rotemina.app.cameras.video import Video
from rotemina.drivers.cameras.frame import Frame, Region
video = Video(Path(sys.argv[1]))
video.start()
told = False
for number in range(1000000):
    pixels = np.full((200, 300), number, np.uint16)
    video.take(Frame(pixels, number / 30.0, number, 16, Region(0, 0, 300, 200)))
    if not told and video.status.pictures > 10:  # the disk has some of them
        told = True
        print("go", flush=True)
"""


@pytest.mark.slow
def test_killed_in_the_middle(tmp_path):
    path = tmp_path / "a.tif"
    with subprocess.Popen(
        [sys.executable, "-c", KILLED, str(path)], stdout=subprocess.PIPE
    ) as process:
        process.stdout.readline()
        process.send_signal(signal.SIGKILL)
    found = pages(path)
    assert found
    for pixels, facts in found:
        assert (pixels == facts["number"]).all()


def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="counts memory as Linux does")
def test_several_thousand_pictures_need_no_more_memory_than_a_hundred(tmp_path, capsys):
    video = Video(tmp_path / "a.tif", capacity_bytes=8_000_000)
    video.start()
    pixels = np.random.default_rng(0).integers(0, 4096, (412, 520)).astype(np.uint16)
    after = {}
    for number in range(4000):
        while video.status.pictures + video.status.dropped < number - 8:
            threading.Event().wait(0.001)
        video.take(Frame(pixels.copy(), number / 30.0, number, 12, Region(0, 0, 520, 412)))
        if number in (200, 3999):
            after[number] = resident()
    status = video.close(60.0)
    grown = after[3999] - after[200]
    with capsys.disabled():
        print(f"\n{status.pictures} pictures, {status.bytes_written / 1e6:.0f} MB: {grown} bytes")
    assert (status.pictures, status.dropped) == (4000, 0)
    assert grown < 4_000_000
    with tifffile.TiffFile(tmp_path / "a.tif") as file:
        assert len(file.pages) == 4000
        assert json.loads(file.pages[3999].description)["number"] == 3999
    (tmp_path / "a.tif").unlink()
