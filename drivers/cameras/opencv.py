"""Cameras read by OpenCV: USB cameras (UVC), video files, network streams."""

import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import cv2

from rotemina.drivers.cameras.camera import (
    Camera,
    CameraIdentity,
    Picture,
    Wait,
)
from rotemina.drivers.cameras.errors import (
    CameraLostError,
    CameraReadError,
    CameraRefusedError,
    CameraSettingError,
)
from rotemina.drivers.cameras.frame import Pixels
from rotemina.drivers.cameras.pace import Pace
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings, PixelType
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.clock import Clock
from rotemina.sim.messages import marked, message

_USUAL_HZ = 25.0  # of a file that does not tell
_RATES_HZ = (0.1, 1000.0)
_EXPOSURES_S, _V4L_EXPOSURE_S = (1e-4, 1.0), 1e-4  # Video4Linux counts in 100 µs
_MANUAL, _MOST_GAIN = 1.0, 1000.0
_TIMEOUT_MS = 3000
_TEXT = int.from_bytes(b"ansi", "little")  # FFmpeg makes a film of any text file
_SYSTEM = Path("/sys/class/video4linux")

# OpenCV reads it once, before its first film, and hands it to FFmpeg: AV_LOG_QUIET.
os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")

Capture = Callable[..., Any]


def plugged_in(system: Path = _SYSTEM) -> Mapping[str, str]:
    """Return the names of cameras by their number, as Linux lists them; none elsewhere."""
    found = {}
    for folder in sorted(system.glob("video*"), key=lambda path: (len(path.name), path.name)):
        try:  # a camera has further nodes, for what comes with its pictures
            if (folder / "index").read_text().strip() == "0":
                found[folder.name.removeprefix("video")] = (folder / "name").read_text().strip()
        except OSError:  # unplugged at this very moment
            continue
    return found


class OpenCvSource(CameraSource):
    """Cameras of OpenCV.

    Parameters
    ----------
    clock, wait : callable
        As of :class:`Camera`.
    listed : callable
        Returns names by number.
    capture : callable
        Makes a ``cv2.VideoCapture``.
    """

    name = marked("engine", "USB camera, video file or stream")
    address_hint = marked(
        "engine", "number of a device, path of a video file, or address such as rtsp://…"
    )

    def __init__(
        self,
        *,
        clock: Clock = time.monotonic,
        wait: Wait = time.sleep,
        listed: Callable[[], Mapping[str, str]] = plugged_in,
        capture: Capture = cv2.VideoCapture,
    ) -> None:
        super().__init__(clock=clock, wait=wait)
        self._listed, self.capture = listed, capture

    def devices(self) -> Sequence[CameraIdentity]:
        """Return the connected cameras, where the system lists them."""
        return tuple(
            CameraIdentity(f"opencv:{number}", name, "opencv")
            for number, name in self._listed().items()
        )

    def addressed(self, address: str) -> CameraIdentity:
        """Return the camera of a number, file or address; see :class:`CameraSource`."""
        address = address.strip()
        if not address:
            raise CameraRefusedError(
                message("engine", "{name}: no address; enter a {address_hint}").fill(
                    name=self.name, address_hint=self.address_hint
                )
            )
        if address.isdecimal():
            return CameraIdentity(f"opencv:{int(address)}", f"Camera {int(address)}", "opencv")
        return CameraIdentity(f"opencv:{address}", address.rstrip("/").split("/")[-1], "opencv")

    def camera(self, identity: CameraIdentity) -> Camera:
        """Return it; see :class:`CameraSource`."""
        kind = Device if identity.address.isdecimal() else Film
        return kind(identity, self)


class _OpenCvCamera(Camera):
    """What devices and films have in common."""

    def __init__(self, identity: CameraIdentity, source: OpenCvSource) -> None:
        super().__init__(identity, clock=source.clock, wait=source.wait)
        self._capture = source.capture
        self._stream: Any = None

    def _opened(self, *arguments: object) -> Any:
        """Return an open stream, or None."""
        with _silence():
            stream = self._capture(*arguments)
        if stream.isOpened():
            return stream
        stream.release()
        return None

    def _described(self, pixels: Pixels, **abilities: Any) -> CameraDescription:
        height, width = pixels.shape[:2]
        own = (PixelType.MONO8,) if pixels.ndim == 2 else (PixelType.COLOUR, PixelType.MONO8)
        return CameraDescription(width, height, own, **abilities)

    def _next(self) -> Pixels | None:
        """Return the next picture of the stream, or None if it gives none."""
        with _silence():
            there, pixels = self._stream.read()
        if not there or pixels is None:
            return None
        if pixels.ndim == 3 and pixels.size:
            pixels = cv2.cvtColor(pixels, cv2.COLOR_BGR2RGB)
        return pixels  # type: ignore[no-any-return]  # OpenCV's arrays have no types of use

    def _read(self) -> Pixels:
        """Return the next picture of the stream.

        Raises
        ------
        CameraReadError
            If it gives none.
        """
        pixels = self._next()
        if pixels is None:
            raise CameraReadError(
                message(
                    "engine",
                    "{name} gives no pictures; check whether it is connected, and open it again",
                ).fill(name=self.name)
            )
        return pixels

    def _picture(self, pixels: Pixels, lost: int = 0) -> Picture:
        return Picture(pixels, 8, self.clock(), exposure_s=self.settings.exposure_s, lost=lost)

    def _close(self) -> None:
        stream, self._stream = self._stream, None
        if stream is not None:
            stream.release()


class Device(_OpenCvCamera):
    """A camera that is plugged in. OpenCV waits up to some seconds for its next picture."""

    def _open(self) -> CameraDescription:
        stream = self._opened(int(self.identity.address))
        if stream is None:
            raise CameraLostError(
                message(
                    "engine",
                    "{name}: there is no camera {address}, or another program uses it, or "
                    "you have no permission (group 'video' on Linux)",
                ).fill(name=self.name, address=self.identity.address)
            )
        self._stream = stream
        stream.set(cv2.CAP_PROP_BUFFERSIZE, 1)  # the newest, never a backlog
        try:
            pixels = self.read_first(self._read)
        except CameraLostError:
            self._close()
            raise
        return self._described(
            pixels,
            exposure_s=_EXPOSURES_S if stream.getBackendName() == "V4L2" else None,
            gain=(0.0, _MOST_GAIN) if stream.get(cv2.CAP_PROP_GAIN) >= 0.0 else None,
        )

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        if settings.exposure_s is not None and settings.exposure_s != self.settings.exposure_s:
            self._set(cv2.CAP_PROP_AUTO_EXPOSURE, _MANUAL, marked("engine", "a manual exposure"))
            steps = round(settings.exposure_s / _V4L_EXPOSURE_S)
            self._set(
                cv2.CAP_PROP_EXPOSURE,
                steps,
                message("engine", "an exposure of {exposure_s} s").fill(
                    exposure_s=settings.exposure_s
                ),
            )
        if settings.gain is not None and settings.gain != self.settings.gain:
            self._set(
                cv2.CAP_PROP_GAIN,
                settings.gain,
                message("engine", "a gain of {gain}").fill(gain=settings.gain),
            )
        return settings

    def _set(self, which: int, value: float, what: str) -> None:
        if not self._stream.set(which, value):
            raise CameraSettingError(
                message("engine", "{name} does not accept {what}; leave it unchanged").fill(
                    name=self.name, what=what
                )
            )

    def _grab(self, timeout_s: float) -> Picture | None:
        return self._picture(self._read())


class Film(_OpenCvCamera):
    """A video file, at its own rate, or a stream of the network.

    No picture of a file is left out: a reader that is too slow makes it slower.
    """

    @property
    def _is_file(self) -> bool:
        return "://" not in self.identity.address

    def _open(self) -> CameraDescription:
        address = self.identity.address
        if self._is_file and not Path(address).is_file():
            raise CameraLostError(
                message("engine", "{address}: file not found; choose another one").fill(
                    address=address
                )
            )
        self._stream = self._opened_film()
        pixels = self._first()
        self._pace: Pace | None = None
        if self._is_file:
            told = self._stream.get(cv2.CAP_PROP_FPS)
            self._own_hz = told if _RATES_HZ[0] <= told <= _RATES_HZ[1] else _USUAL_HZ
            self._pace = Pace(self._own_hz, clock=self.clock, wait=self.wait)
        self._lost = 0
        return self._described(
            pixels, rate_hz=_RATES_HZ if self._is_file else None, noise_free=self._is_file
        )

    def _opened_film(self) -> Any:
        limits = [cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, _TIMEOUT_MS]
        limits += [cv2.CAP_PROP_READ_TIMEOUT_MSEC, _TIMEOUT_MS]
        stream = self._opened(self.identity.address, cv2.CAP_FFMPEG, limits)
        if stream is not None:
            return stream
        if self._is_file:
            raise CameraRefusedError(
                message(
                    "engine",
                    "{address}: not a video, or a truncated or unknown one; choose another file",
                ).fill(address=self.identity.address)
            )
        raise CameraLostError(
            message(
                "engine",
                "{address}: no video arrived within {timeout_s} s; check the address and "
                "the network",
            ).fill(address=self.identity.address, timeout_s=_TIMEOUT_MS / 1000.0)
        )

    def _first(self) -> Pixels:
        """Return the first picture, of at least two, and begin before it."""
        try:
            pixels = self.read_first(self._read)
        except CameraLostError as error:
            self._close()
            if not self._is_file:
                raise
            raise self._refused("it is no video: it has no picture") from error
        reason = ""
        if self._is_file and int(self._stream.get(cv2.CAP_PROP_FOURCC)) == _TEXT:
            reason = "it is no video but a text"
        elif self._is_file and self._next() is None:
            reason = "it is no video but one picture; open pictures as an image sequence"
        if reason:
            self._close()
            raise self._refused(reason)
        if self._is_file:
            self._stream.set(cv2.CAP_PROP_POS_FRAMES, 0)
        return pixels

    def _refused(self, reason: str) -> CameraRefusedError:
        return CameraRefusedError(
            message("engine", "{address}: {reason}; choose another file").fill(
                address=self.identity.address, reason=reason
            )
        )

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        if self._pace is not None:
            self._pace.change(1.0 / (settings.rate_hz or self._own_hz))
        return settings

    def _grab(self, timeout_s: float) -> Picture | None:
        if self._pace is not None and not self._pace.beats(timeout_s):
            return None
        return self._picture(self._of_file() if self._is_file else self._read(), self._lost)

    def _of_file(self) -> Pixels:
        """Return the next picture of a file, or its first one after the end.

        A picture that cannot be read is followed by others, the end is not.
        """
        pixels = self._next()
        if pixels is not None:
            return pixels
        pixels = self._next()
        if pixels is not None:
            self._lost += 1
            return pixels
        if not self.settings.repeat:
            raise CameraLostError(
                message("engine", "{name} has ended; open it again, or let it repeat").fill(
                    name=self.name
                )
            )
        self._stream.set(cv2.CAP_PROP_POS_FRAMES, 0)
        return self._read()


@contextmanager
def _silence() -> Iterator[None]:
    """Keep OpenCV from writing to the terminal what is told by an error."""
    before = cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    try:
        yield
    finally:
        cv2.utils.logging.setLogLevel(before)
