"""Image sequences: a folder of TIFF and PNG files, or a multi-page TIFF."""

import re
from pathlib import Path

import cv2
import numpy as np

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Picture
from rotemina.drivers.cameras.errors import CameraLostError, CameraReadError, CameraRefusedError
from rotemina.drivers.cameras.frame import Pixels
from rotemina.drivers.cameras.pace import Pace
from rotemina.drivers.cameras.pixels import pixel_type_of
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings, PixelType, Trigger
from rotemina.drivers.cameras.source import CameraSource
from rotemina.sim.input_files import open_file
from rotemina.sim.messages import marked, message

_KINDS = (".tif", ".tiff", ".png")
_MOST_BYTES = 4_000_000_000
_USUAL_HZ, _RATES_HZ = 10.0, (0.1, 1000.0)
_DIGITS = re.compile(r"(\d+)")


class ImageSequences(CameraSource):
    """Folders and files that are named."""

    name = marked("engine", "Image sequence")
    address_hint = marked("engine", "folder of TIFF or PNG files, or TIFF file with several pages")

    def devices(self) -> tuple[CameraIdentity, ...]:
        """Return nothing: a sequence has to be named."""
        return ()

    def addressed(self, address: str) -> CameraIdentity:
        """Return the sequence in a folder or file; see :class:`CameraSource`."""
        if not address.strip():
            raise CameraRefusedError(
                message("engine", "{name}: no address; enter a {address_hint}").fill(
                    name=self.name, address_hint=self.address_hint
                )
            )
        path = Path(address.strip())
        return CameraIdentity(f"sequence:{path}", path.name or str(path), "sequence")

    def camera(self, identity: CameraIdentity) -> Camera:
        """Return it; see :class:`CameraSource`."""
        return ImageSequence(identity, clock=self.clock, wait=self.wait)


class ImageSequence(Camera):
    """Pictures in the natural order of their names: 9 comes before 10. None is left out.

    Pictures of 16 bits count as such: a file does not tell how many of them its camera had.
    """

    def _open(self) -> CameraDescription:
        path = Path(self.identity.address)
        self._pages = _pages(path)
        self._at = 0
        self._pace = Pace(_USUAL_HZ, clock=self.clock, wait=self.wait)
        pixels = self.read_first(lambda: _read(*self._next_page()))
        self._at -= 1
        own = pixel_type_of(pixels)
        types = (own, PixelType.MONO8) if own is not PixelType.MONO8 else (own,)
        return CameraDescription(
            pixels.shape[1],
            pixels.shape[0],
            types,
            (Trigger.FREE, Trigger.SOFTWARE),
            rate_hz=_RATES_HZ,
            noise_free=True,
        )

    def _close(self) -> None:
        self._pages = ()

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        self._pace.change(1.0 / (settings.rate_hz or _USUAL_HZ))
        return settings

    def _grab(self, timeout_s: float) -> Picture | None:
        if self.settings.trigger is Trigger.FREE and not self._pace.beats(timeout_s):
            return None
        if self._at == len(self._pages) and not self.settings.repeat:
            raise CameraLostError(
                message(
                    "engine",
                    "{name} has ended after {count} pictures; open it again, or let it repeat",
                ).fill(name=self.name, count=len(self._pages))
            )
        file, page = self._next_page()
        pixels = _read(file, page)
        if pixel_type_of(pixels) is not self.description.pixel_types[0]:
            raise CameraReadError(
                message(
                    "engine",
                    "{file}: a picture of type {pixel_type_of}, but the first has "
                    "{pixel_types}; convert it",
                ).fill(
                    file=file,
                    pixel_type_of=pixel_type_of(pixels),
                    pixel_types=self.description.pixel_types[0],
                )
            )
        bits = 16 if pixels.dtype == np.uint16 else 8
        return Picture(pixels, bits, self.clock(), metadata={"file": file.name, "page": page})

    def _next_page(self) -> tuple[Path, int]:
        """Go on to the next page, whether it can be read or not; the first follows the last."""
        at = self._at % len(self._pages)
        self._at = at + 1
        return self._pages[at]


def _pages(path: Path) -> tuple[tuple[Path, int], ...]:
    """Return the files, with the page of each, that belong to a folder or file."""
    if path.is_dir():
        files = [
            file for file in path.iterdir() if file.suffix.lower() in _KINDS and file.is_file()
        ]
        if not files:
            raise CameraRefusedError(
                message(
                    "engine",
                    "{path}: there is no TIFF or PNG file in this folder; choose another one",
                ).fill(path=path)
            )
        return tuple((file, 0) for file in sorted(files, key=_natural))
    if not path.is_file():
        raise CameraLostError(
            message("engine", "{path}: folder or file not found; choose another one").fill(
                path=path
            )
        )
    count = cv2.imcount(str(path), cv2.IMREAD_UNCHANGED)
    if count < 1:
        raise CameraRefusedError(
            message("engine", "{path}: not a picture; choose a TIFF or PNG file").fill(path=path)
        )
    return tuple((path, page) for page in range(count))


def _natural(path: Path) -> list[tuple[bool, int, str]]:
    """Return what to sort by: runs of digits count as numbers."""
    parts = _DIGITS.split(path.name.lower())
    return [(part.isdecimal(), int(part) if part.isdecimal() else 0, part) for part in parts]


def _read(file: Path, page: int) -> Pixels:
    open_file(
        file,
        CameraReadError,
        most_bytes=_MOST_BYTES,
        advice=marked("engine", "the file is truncated or missing"),
    ).close()
    unreadable = CameraReadError(
        message(
            "engine", "{file}: page {page} cannot be read; the file is truncated or missing"
        ).fill(file=file, page=page + 1)
    )
    try:
        there, pages = cv2.imreadmulti(str(file), page, 1, flags=cv2.IMREAD_UNCHANGED)
    except cv2.error as error:
        raise unreadable from error
    if not there or not pages or not pages[0].size:
        raise unreadable
    pixels = pages[0]
    if pixels.ndim == 3 and pixels.dtype == np.uint8:
        code = cv2.COLOR_BGRA2RGB if pixels.shape[2] == 4 else cv2.COLOR_BGR2RGB
        return np.asarray(cv2.cvtColor(pixels, code), dtype=np.uint8)
    if pixels.ndim != 2 or pixels.dtype not in (np.uint8, np.uint16):
        raise CameraReadError(
            message(
                "engine",
                "{file}: pixels of type {dtype} with {ndim} dimensions: must be grey of 8 or 16 "
                "bits, or colour of 8; convert it",
            ).fill(file=file, dtype=str(pixels.dtype), ndim=pixels.ndim)
        )
    return pixels  # type: ignore[return-value]  # its type was looked at
