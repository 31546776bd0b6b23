"""Image sequences: a folder of TIFF and PNG files, or a multi-page TIFF."""

import re
from pathlib import Path

import cv2
import numpy as np

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, RawFrame
from rotemina.drivers.cameras.frame import Pixels, PixelType, find_pixel_type
from rotemina.drivers.cameras.pace import FramePacer
from rotemina.drivers.cameras.settings import (
    CameraDescription,
    CameraSettings,
    CameraTrigger,
)
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.contract import CameraLostError, CameraReadError, CameraRefusedError
from rotemina.sim.files import open_file
from rotemina.sim.messages import marked

_SUFFIXES = (".tif", ".tiff", ".png")
_MAX_FILE_BYTES = 4_000_000_000
_DEFAULT_RATE_HZ, _RATE_RANGE_HZ = 10.0, (0.1, 1000.0)
_DIGITS_PATTERN = re.compile(r"(\d+)")


class ImageSequenceSource(CameraSource):
    """Source of image sequences in folders and files."""

    name = marked("engine", "Image sequence")
    address_hint = marked("engine", "folder of TIFF or PNG files, or TIFF file with several pages")

    def devices(self) -> tuple[CameraIdentity, ...]:
        """Return no camera: the operator has to enter a folder or file."""
        return ()

    def parse_address(self, address: str) -> CameraIdentity:
        """Return the identity for a folder or file; see :class:`CameraSource`."""
        if not address.strip():
            raise CameraRefusedError(
                "{name}: no address; enter a {address_hint}",
                name=self.name,
                address_hint=self.address_hint,
            )
        path = Path(address.strip())
        return CameraIdentity(f"sequence:{path}", path.name or str(path), "sequence")

    def camera(self, identity: CameraIdentity) -> Camera:
        """Return a sequence; see :class:`CameraSource`."""
        return ImageSequence(identity, clock=self.clock, wait=self.wait)


class ImageSequence(Camera):
    """A camera that shows pictures in the natural order of their names, in which 9 precedes 10.

    No picture is skipped. All 16 bits of a 16-bit picture count as significant, because the file
    does not state how many bits the camera had.
    """

    def _open(self) -> CameraDescription:
        path = Path(self.identity.address)
        self._pages = _list_pages(path)
        self._page_index = 0
        self._pacer = FramePacer(_DEFAULT_RATE_HZ, clock=self.clock, wait=self.wait)
        pixels = self.read_first(lambda: _read_page(*self._next_page()))
        self._page_index -= 1
        file_type = find_pixel_type(pixels)
        pixel_types = (
            (file_type, PixelType.MONO8) if file_type is not PixelType.MONO8 else (file_type,)
        )
        return CameraDescription(
            pixels.shape[1],
            pixels.shape[0],
            pixel_types,
            (CameraTrigger.FREE, CameraTrigger.SOFTWARE),
            rate_hz=_RATE_RANGE_HZ,
            noise_free=True,
        )

    def _close(self) -> None:
        self._pages = ()

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        self._pacer.set_period(1.0 / (settings.rate_hz or _DEFAULT_RATE_HZ))
        return settings

    def _grab(self, timeout_s: float) -> RawFrame | None:
        if self.settings.trigger is CameraTrigger.FREE and not self._pacer.wait_for_frame(
            timeout_s
        ):
            return None
        if self._page_index == len(self._pages) and not self.settings.repeat:
            raise CameraLostError(
                "{name} has ended after {count} pictures; open it again, or let it repeat",
                name=self.name,
                count=len(self._pages),
            )
        file, page = self._next_page()
        pixels = _read_page(file, page)
        if find_pixel_type(pixels) is not self.description.pixel_types[0]:
            raise CameraReadError(
                "{file}: a picture of type {pixel_type_of}, but the first one has type "
                "{pixel_types}; convert it",
                file=file,
                pixel_type_of=find_pixel_type(pixels),
                pixel_types=self.description.pixel_types[0],
            )
        bits = 16 if pixels.dtype == np.uint16 else 8
        return RawFrame(pixels, bits, self.clock(), metadata={"file": file.name, "page": page})

    def _next_page(self) -> tuple[Path, int]:
        """Return the next page; after the last page, the first one.

        The index advances even if the page is unreadable.
        """
        index = self._page_index % len(self._pages)
        self._page_index = index + 1
        return self._pages[index]


def _list_pages(path: Path) -> tuple[tuple[Path, int], ...]:
    if path.is_dir():
        files = [
            file for file in path.iterdir() if file.suffix.lower() in _SUFFIXES and file.is_file()
        ]
        if not files:
            raise CameraRefusedError(
                "{path}: there is no TIFF or PNG file in this folder; choose another one", path=path
            )
        return tuple((file, 0) for file in sorted(files, key=_make_natural_sort_key))
    if not path.is_file():
        raise CameraLostError("{path}: folder or file not found; choose another one", path=path)
    page_count = cv2.imcount(str(path), cv2.IMREAD_UNCHANGED)
    if page_count < 1:
        raise CameraRefusedError("{path}: not a picture; choose a TIFF or PNG file", path=path)
    return tuple((path, page) for page in range(page_count))


def _make_natural_sort_key(path: Path) -> list[tuple[bool, int, str]]:
    parts = _DIGITS_PATTERN.split(path.name.lower())
    return [(part.isdecimal(), int(part) if part.isdecimal() else 0, part) for part in parts]


def _read_page(file: Path, page: int) -> Pixels:
    open_file(
        file,
        CameraReadError,
        max_bytes=_MAX_FILE_BYTES,
        advice=marked("engine", "the file is truncated or missing"),
    ).close()
    read_error = CameraReadError(
        "{file}: page {page} cannot be read; the file is truncated or missing",
        file=file,
        page=page + 1,
    )
    try:
        success, pages = cv2.imreadmulti(str(file), page, 1, flags=cv2.IMREAD_UNCHANGED)
    except cv2.error as error:
        raise read_error from error
    if not success or not pages or not pages[0].size:
        raise read_error
    pixels = pages[0]
    if pixels.ndim == 3 and pixels.dtype == np.uint8:
        code = cv2.COLOR_BGRA2RGB if pixels.shape[2] == 4 else cv2.COLOR_BGR2RGB
        return np.asarray(cv2.cvtColor(pixels, code), dtype=np.uint8)
    if pixels.ndim != 2 or pixels.dtype not in (np.uint8, np.uint16):
        raise CameraReadError(
            "{file}: pixels of type {dtype} with {ndim} dimensions: must be 8-bit or 16-bit "
            "grey, or 8-bit colour; convert it",
            file=file,
            dtype=str(pixels.dtype),
            ndim=pixels.ndim,
        )
    return pixels  # type: ignore[return-value]  # the type was checked above
