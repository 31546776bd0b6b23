"""A video as a BigTIFF, one page per picture, readable while it grows.

The pictures are lossless and keep all 16 bits, which measurements need. ImageJ, tifffile, libtiff
and OpenCV can read the file. tifffile is not used for writing: it links a page before it writes the
page, so a program that is killed in between leaves an unreadable file. This module writes the data
of a page, then its directory, and last the eight bytes that point to the directory. Layout: TIFF
6.0 (Adobe 1992), with the 8-byte offsets of BigTIFF (version 43).
"""

import json
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from rotemina.app.cameras.snapshot import format_program_version, make_frame_metadata
from rotemina.app.settings import (
    FileOpener,
    open_new_file,
    write_all,
)
from rotemina.drivers.cameras import CameraFrame

# Field types of TIFF 6.0 and BigTIFF.
_ASCII, _SHORT, _LONG, _RATIONAL, _LONG8 = 2, 3, 4, 5, 16
_HEADER = struct.pack("<2sHHHQ", b"II", 43, 8, 0, 0)
# Offset in the header of the pointer to the first page.
_FIRST_LINK_OFFSET = 8
# Value of the tag ResolutionUnit.
_UNIT_CENTIMETRE = 3


class _PageDirectory(NamedTuple):
    """The directory of a page with the texts before it, and offsets in the file.

    ``next_link_offset`` is the offset of the pointer to the next page.
    """

    directory: bytes
    directory_offset: int
    next_link_offset: int


class VideoFile:
    """Appends pictures to a file. After an ``OSError`` the pictures written before are intact.

    Parameters
    ----------
    path : Path
        It must not exist.
    metadata : mapping
        Metadata of the whole video, stored with the first page; must be convertible to JSON.
    pixel_m : float or None
        Size of a pixel in the specimen, m.
    opener : callable
        Creates the file.
    """

    def __init__(
        self,
        path: Path,
        metadata: Mapping[str, object],
        pixel_m: float | None = None,
        opener: FileOpener = open_new_file,
    ) -> None:
        self.path = path
        self._metadata: Mapping[str, object] = metadata
        self._pixel_m = pixel_m
        self._file = opener(path)
        # Offset of the pointer to the next page.
        self._link_offset = _FIRST_LINK_OFFSET
        #: Size of the file in bytes.
        self.size = 0
        self.pages = 0
        self._write_at_end(_HEADER)

    def append(self, frame: CameraFrame) -> None:
        """Append a picture.

        Raises
        ------
        OSError
            If it cannot be written to the disk.
        """
        previous_size = self.size
        try:
            data_offset = self.size
            self._write_at_end(np.ascontiguousarray(frame.pixels).tobytes())
            page = self._make_page_directory(frame, data_offset)
            self._write_at_end(page.directory)
            self._file.seek(self._link_offset)
            write_all(self._file, struct.pack("<Q", page.directory_offset))
        except OSError:
            self.size = previous_size
            # Remove the incomplete page; no link points to it yet.
            self._file.truncate(previous_size)
            raise
        self._link_offset = page.next_link_offset
        self.pages += 1

    def close(self) -> None:
        """Close the file; safe to call twice."""
        self._file.close()

    def _make_page_directory(self, frame: CameraFrame, data_offset: int) -> _PageDirectory:
        metadata = {**make_frame_metadata(frame), **({} if self.pages else self._metadata)}
        text = json.dumps(metadata).encode("ascii") + b"\0"
        software = format_program_version().encode("ascii") + b"\0"
        rows, columns = frame.pixels.shape[:2]
        samples = 3 if frame.is_colour else 1
        bits = 8 * frame.pixels.dtype.itemsize
        resolution = _pack_resolution(self._pixel_m)
        # The texts precede the directory, which must begin at an even offset.
        texts = text + software + b"\0" * ((self.size + len(text) + len(software)) % 2)
        directory_offset = self.size + len(texts)
        tags = [
            (256, _LONG, 1, struct.pack("<I", columns)),
            (257, _LONG, 1, struct.pack("<I", rows)),
            (258, _SHORT, samples, struct.pack(f"<{samples}H", *[bits] * samples)),
            (259, _SHORT, 1, struct.pack("<H", 1)),  # no compression
            (262, _SHORT, 1, struct.pack("<H", 2 if frame.is_colour else 1)),
            (270, _ASCII, len(text), struct.pack("<Q", self.size)),
            (273, _LONG8, 1, struct.pack("<Q", data_offset)),
            (277, _SHORT, 1, struct.pack("<H", samples)),
            (278, _LONG, 1, struct.pack("<I", rows)),
            (279, _LONG8, 1, struct.pack("<Q", frame.pixels.nbytes)),
            (282, _RATIONAL, 1, resolution),
            (283, _RATIONAL, 1, resolution),
            (296, _SHORT, 1, struct.pack("<H", _UNIT_CENTIMETRE if self._pixel_m else 1)),
            (305, _ASCII, len(software), struct.pack("<Q", self.size + len(text))),
        ]
        entries = b"".join(
            struct.pack("<HHQ", tag, field_type, count) + value.ljust(8, b"\0")
            for tag, field_type, count, value in tags
        )
        entry_table = struct.pack("<Q", len(tags)) + entries
        no_next_page = struct.pack("<Q", 0)
        return _PageDirectory(
            directory=texts + entry_table + no_next_page,
            directory_offset=directory_offset,
            next_link_offset=directory_offset + len(entry_table),
        )

    def _write_at_end(self, data: bytes) -> None:
        self._file.seek(self.size)
        write_all(self._file, data)
        self.size += len(data)


def _pack_resolution(pixel_m: float | None) -> bytes:
    """Return the pixels per centimetre as a TIFF rational, or 1 : 1 if unknown."""
    if not pixel_m:
        return struct.pack("<II", 1, 1)
    return struct.pack("<II", round(0.01 / pixel_m), 1)
