"""A video as a BigTIFF, one page per picture, readable while it grows.

Lossless and of 16 bits, as measurements need them; ImageJ, tifffile, libtiff and OpenCV read it.
tifffile links a page before it writes it, so that a kill within a page leaves a file that it cannot
read itself. Here a page is linked last: data, directory, and then the eight bytes that point to it.
Layout: TIFF 6.0 (Adobe 1992), with the offsets of 8 bytes of BigTIFF (version 43).
"""

import json
import struct
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from rotemina.app.cameras.snapshot import frame_facts, program
from rotemina.app.files import Opener, new_file, write_all
from rotemina.drivers.cameras.frame import Frame

_ASCII, _SHORT, _LONG, _RATIONAL, _LONG8 = 2, 3, 4, 5, 16
_HEADER = struct.pack("<2sHHHQ", b"II", 43, 8, 0, 0)
_FIRST = 8  # where the header points to the first page
_CENTIMETRE = 3


class VideoFile:
    """Appends pictures. After an ``OSError`` what was written before it is intact.

    Parameters
    ----------
    path : Path
        It must not exist.
    facts : mapping
        What holds for the whole film, as JSON can hold it; kept with the first page.
    pixel_m : float or None
        Size of a pixel in the specimen, m.
    opener : callable
        How the file is made.
    """

    def __init__(
        self,
        path: Path,
        facts: Mapping[str, object],
        pixel_m: float | None = None,
        opener: Opener = new_file,
    ) -> None:
        self.path = path
        self._facts: Mapping[str, object] = facts
        self._pixel_m = pixel_m
        self._file = opener(path)
        self._link = _FIRST  # where the next page has to be linked
        #: How many bytes it has.
        self.size = 0
        self.pages = 0
        self._put(_HEADER)

    def append(self, frame: Frame) -> None:
        """Write a picture.

        Raises
        ------
        OSError
            If the disk does not take it.
        """
        before = self.size
        try:
            data = self.size
            self._put(np.ascontiguousarray(frame.pixels).tobytes())
            start, directory, link = self._directory(frame, data)
            self._put(directory)
            self._file.seek(self._link)
            write_all(self._file, struct.pack("<Q", start))
        except OSError:
            self.size = before
            self._file.truncate(before)
            raise
        self._link = link
        self.pages += 1

    def close(self) -> None:
        """Release it; safe to call twice."""
        self._file.close()

    def _directory(self, frame: Frame, data: int) -> tuple[int, bytes, int]:
        """Return where a page's directory begins, all of it, and where the next is linked."""
        facts = {**frame_facts(frame), **({} if self.pages else self._facts)}
        text = json.dumps(facts).encode("ascii") + b"\0"
        software = program().encode("ascii") + b"\0"
        rows, columns = frame.pixels.shape[:2]
        samples = 3 if frame.colour else 1
        depth = 8 * frame.pixels.dtype.itemsize
        resolution = _ratio(self._pixel_m)
        # Texts stand before the directory, which must begin at an even place.
        texts = text + software + b"\0" * ((self.size + len(text) + len(software)) % 2)
        start = self.size + len(texts)
        tags = [
            (256, _LONG, 1, struct.pack("<I", columns)),
            (257, _LONG, 1, struct.pack("<I", rows)),
            (258, _SHORT, samples, struct.pack(f"<{samples}H", *[depth] * samples)),
            (259, _SHORT, 1, struct.pack("<H", 1)),  # no compression
            (262, _SHORT, 1, struct.pack("<H", 2 if frame.colour else 1)),
            (270, _ASCII, len(text), struct.pack("<Q", self.size)),
            (273, _LONG8, 1, struct.pack("<Q", data)),
            (277, _SHORT, 1, struct.pack("<H", samples)),
            (278, _LONG, 1, struct.pack("<I", rows)),
            (279, _LONG8, 1, struct.pack("<Q", frame.pixels.nbytes)),
            (282, _RATIONAL, 1, resolution),
            (283, _RATIONAL, 1, resolution),
            (296, _SHORT, 1, struct.pack("<H", _CENTIMETRE if self._pixel_m else 1)),
            (305, _ASCII, len(software), struct.pack("<Q", self.size + len(text))),
        ]
        entries = b"".join(
            struct.pack("<HHQ", tag, kind, count) + value.ljust(8, b"\0")
            for tag, kind, count, value in tags
        )
        head = struct.pack("<Q", len(tags)) + entries
        return start, texts + head + struct.pack("<Q", 0), start + len(head)

    def _put(self, data: bytes) -> None:
        """Write at the end."""
        self._file.seek(self.size)
        write_all(self._file, data)
        self.size += len(data)


def _ratio(pixel_m: float | None) -> bytes:
    """Return pixels per centimetre as TIFF's pair of numbers; 1 : 1 where it is not known."""
    if not pixel_m:
        return struct.pack("<II", 1, 1)
    return struct.pack("<II", round(0.01 / pixel_m), 1)
