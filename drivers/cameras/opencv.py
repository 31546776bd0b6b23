"""Cameras that OpenCV reads: USB cameras (UVC), video files and network streams."""

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
    RawFrame,
    Wait,
)
from rotemina.drivers.cameras.frame import Pixels, PixelType
from rotemina.drivers.cameras.pace import FramePacer
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.contract import (
    CameraLostError,
    CameraReadError,
    CameraRefusedError,
    CameraSettingError,
    Clock,
)
from rotemina.sim.messages import (
    Message,
    marked,
    message,
)

# Rate of a video file that does not state its rate.
_DEFAULT_RATE_HZ = 25.0
_RATE_RANGE_HZ = (0.1, 1000.0)
# The unit of exposures in Video4Linux is 100 µs.
_EXPOSURE_RANGE_S, _V4L_EXPOSURE_STEP_S = (1e-4, 1.0), 1e-4
_MANUAL_EXPOSURE_MODE, _MAX_GAIN = 1.0, 1000.0
_TIMEOUT_MS = 3000
# FFmpeg opens any text file as a video with this codec.
_TEXT_FILE_FOURCC = int.from_bytes(b"ansi", "little")
_V4L_FOLDER = Path("/sys/class/video4linux")

# AV_LOG_QUIET. OpenCV reads this variable once, before the first video, and passes it to FFmpeg.
os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")

CaptureFactory = Callable[..., Any]


def list_v4l_cameras(system: Path = _V4L_FOLDER) -> Mapping[str, str]:
    """Return the names of the connected cameras by number; empty on systems other than Linux."""
    cameras = {}
    for folder in sorted(system.glob("video*"), key=lambda path: (len(path.name), path.name)):
        try:
            # Only node 0 of a camera delivers pictures; the others deliver metadata.
            if (folder / "index").read_text().strip() == "0":
                cameras[folder.name.removeprefix("video")] = (folder / "name").read_text().strip()
        except OSError:
            # The camera was unplugged in the meantime.
            continue
    return cameras


class OpenCvSource(CameraSource):
    """Source of the cameras that OpenCV reads.

    Parameters
    ----------
    clock, wait : callable
        See :class:`Camera`.
    list_cameras : callable
        Returns the names of connected cameras by their number.
    capture : callable
        Creates a ``cv2.VideoCapture``.
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
        list_cameras: Callable[[], Mapping[str, str]] = list_v4l_cameras,
        capture: CaptureFactory = cv2.VideoCapture,
    ) -> None:
        super().__init__(clock=clock, wait=wait)
        self._list_cameras, self.capture = list_cameras, capture

    def devices(self) -> Sequence[CameraIdentity]:
        """Return the connected cameras, if the system lists them."""
        return tuple(
            CameraIdentity(f"opencv:{number}", name, "opencv")
            for number, name in self._list_cameras().items()
        )

    def parse_address(self, address: str) -> CameraIdentity:
        """Return the identity for a number, file or URL; see :class:`CameraSource`."""
        address = address.strip()
        if not address:
            raise CameraRefusedError(
                "{name}: no address; enter a {address_hint}",
                name=self.name,
                address_hint=self.address_hint,
            )
        if address.isdecimal():
            return CameraIdentity(f"opencv:{int(address)}", f"Camera {int(address)}", "opencv")
        return CameraIdentity(f"opencv:{address}", address.rstrip("/").split("/")[-1], "opencv")

    def camera(self, identity: CameraIdentity) -> Camera:
        """Return a camera; see :class:`CameraSource`."""
        camera_class = UsbCamera if identity.address.isdecimal() else VideoStreamCamera
        return camera_class(identity, self)


class _OpenCvCamera(Camera):
    def __init__(self, identity: CameraIdentity, source: OpenCvSource) -> None:
        super().__init__(identity, clock=source.clock, wait=source.wait)
        self._make_capture = source.capture
        self._stream: Any = None

    def _open_stream(self, *arguments: object) -> Any:
        """Return an open stream, or None if it cannot be opened."""
        with _silence_opencv():
            stream = self._make_capture(*arguments)
        if stream.isOpened():
            return stream
        stream.release()
        return None

    def _describe(self, pixels: Pixels, **abilities: Any) -> CameraDescription:
        height, width = pixels.shape[:2]
        pixel_types = (
            (PixelType.MONO8,) if pixels.ndim == 2 else (PixelType.COLOUR, PixelType.MONO8)
        )
        return CameraDescription(width, height, pixel_types, **abilities)

    def _read_or_none(self) -> Pixels | None:
        with _silence_opencv():
            success, pixels = self._stream.read()
        if not success or pixels is None:
            return None
        if pixels.ndim == 3 and pixels.size:
            pixels = cv2.cvtColor(pixels, cv2.COLOR_BGR2RGB)
        return pixels  # type: ignore[no-any-return]  # OpenCV's arrays have no useful types

    def _read(self) -> Pixels:
        """Return the next picture of the stream.

        Raises
        ------
        CameraReadError
            If there is none.
        """
        pixels = self._read_or_none()
        if pixels is None:
            raise CameraReadError(
                "{name} delivers no pictures; check that it is connected, and open it again",
                name=self.name,
            )
        return pixels

    def _make_raw_frame(self, pixels: Pixels, lost: int = 0) -> RawFrame:
        return RawFrame(pixels, 8, self.clock(), exposure_s=self.settings.exposure_s, lost=lost)

    def _close(self) -> None:
        stream, self._stream = self._stream, None
        if stream is not None:
            stream.release()


class UsbCamera(_OpenCvCamera):
    """A connected camera. A read may block in OpenCV for several seconds."""

    def _open(self) -> CameraDescription:
        stream = self._open_stream(int(self.identity.address))
        if stream is None:
            raise CameraLostError(
                "{name}: there is no camera {address}, or another program uses it, or "
                "you have no permission (group 'video' on Linux)",
                name=self.name,
                address=self.identity.address,
            )
        self._stream = stream
        # With a buffer of one, a read returns the newest picture and never a backlog.
        stream.set(cv2.CAP_PROP_BUFFERSIZE, 1)
        try:
            pixels = self.read_first(self._read)
        except CameraLostError:
            self._close()
            raise
        return self._describe(
            pixels,
            exposure_s=_EXPOSURE_RANGE_S if stream.getBackendName() == "V4L2" else None,
            gain=(0.0, _MAX_GAIN) if stream.get(cv2.CAP_PROP_GAIN) >= 0.0 else None,
        )

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        if settings.exposure_s is not None and settings.exposure_s != self.settings.exposure_s:
            self._set_property(
                cv2.CAP_PROP_AUTO_EXPOSURE,
                _MANUAL_EXPOSURE_MODE,
                marked("engine", "a manual exposure"),
            )
            steps = round(settings.exposure_s / _V4L_EXPOSURE_STEP_S)
            self._set_property(
                cv2.CAP_PROP_EXPOSURE,
                steps,
                message("engine", "an exposure of {exposure_s} s").fill(
                    exposure_s=settings.exposure_s
                ),
            )
        if settings.gain is not None and settings.gain != self.settings.gain:
            self._set_property(
                cv2.CAP_PROP_GAIN,
                settings.gain,
                message("engine", "a gain of {gain}").fill(gain=settings.gain),
            )
        return settings

    def _set_property(self, property_id: int, value: float, description: str) -> None:
        if not self._stream.set(property_id, value):
            raise CameraSettingError(
                "{name} does not accept {what}; leave it unchanged",
                name=self.name,
                what=description,
            )

    def _grab(self, timeout_s: float) -> RawFrame | None:
        return self._make_raw_frame(self._read())


class VideoStreamCamera(_OpenCvCamera):
    """A video file, played at its own rate, or a network stream.

    No picture of a file is skipped. If the reader is slow, the video plays more slowly.
    """

    @property
    def _is_file(self) -> bool:
        return "://" not in self.identity.address

    def _open(self) -> CameraDescription:
        address = self.identity.address
        if self._is_file and not Path(address).is_file():
            raise CameraLostError("{address}: file not found; choose another one", address=address)
        self._stream = self._open_video()
        pixels = self._read_first_picture()
        self._pacer: FramePacer | None = None
        if self._is_file:
            declared_hz = self._stream.get(cv2.CAP_PROP_FPS)
            self._file_rate_hz = (
                declared_hz
                if _RATE_RANGE_HZ[0] <= declared_hz <= _RATE_RANGE_HZ[1]
                else _DEFAULT_RATE_HZ
            )
            self._pacer = FramePacer(self._file_rate_hz, clock=self.clock, wait=self.wait)
        self._lost_count = 0
        return self._describe(
            pixels, rate_hz=_RATE_RANGE_HZ if self._is_file else None, noise_free=self._is_file
        )

    def _open_video(self) -> Any:
        limits = [cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, _TIMEOUT_MS]
        limits += [cv2.CAP_PROP_READ_TIMEOUT_MSEC, _TIMEOUT_MS]
        stream = self._open_stream(self.identity.address, cv2.CAP_FFMPEG, limits)
        if stream is not None:
            return stream
        if self._is_file:
            raise CameraRefusedError(
                "{address}: not a video, or a truncated one, or an unknown format; choose "
                "another file",
                address=self.identity.address,
            )
        raise CameraLostError(
            "{address}: no video arrived within {timeout_s} s; check the address and the network",
            address=self.identity.address,
            timeout_s=_TIMEOUT_MS / 1000.0,
        )

    def _read_first_picture(self) -> Pixels:
        """Return the first picture and rewind; refuse a file with fewer than two pictures."""
        try:
            pixels = self.read_first(self._read)
        except CameraLostError as error:
            self._close()
            if not self._is_file:
                raise
            raise self._make_refusal(
                message("engine", "it is not a video: it has no pictures")
            ) from error
        reason: Message | None = None
        if self._is_file and int(self._stream.get(cv2.CAP_PROP_FOURCC)) == _TEXT_FILE_FOURCC:
            reason = message("engine", "it is a text file, not a video")
        elif self._is_file and self._read_or_none() is None:
            reason = message(
                "engine", "it is a single picture, not a video; open pictures as an image sequence"
            )
        if reason is not None:
            self._close()
            raise self._make_refusal(reason)
        if self._is_file:
            self._stream.set(cv2.CAP_PROP_POS_FRAMES, 0)
        return pixels

    def _make_refusal(self, reason: Message) -> CameraRefusedError:
        return CameraRefusedError(
            "{address}: {reason}; choose another file", address=self.identity.address, reason=reason
        )

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        if self._pacer is not None:
            self._pacer.set_period(1.0 / (settings.rate_hz or self._file_rate_hz))
        return settings

    def _grab(self, timeout_s: float) -> RawFrame | None:
        if self._pacer is not None and not self._pacer.wait_for_frame(timeout_s):
            return None
        return self._make_raw_frame(
            self._read_from_file() if self._is_file else self._read(), self._lost_count
        )

    def _read_from_file(self) -> Pixels:
        """Return the next picture of a file; after the last one, the first one again.

        A failed read is repeated once. The second read succeeds if only one picture is damaged, and
        fails at the end of the file.
        """
        pixels = self._read_or_none()
        if pixels is not None:
            return pixels
        pixels = self._read_or_none()
        if pixels is not None:
            self._lost_count += 1
            return pixels
        if not self.settings.repeat:
            raise CameraLostError(
                "{name} has ended; open it again, or let it repeat", name=self.name
            )
        self._stream.set(cv2.CAP_PROP_POS_FRAMES, 0)
        return self._read()


@contextmanager
def _silence_opencv() -> Iterator[None]:
    """Keep OpenCV from writing to the terminal; errors are reported as exceptions."""
    previous_level = cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    try:
        yield
    finally:
        cv2.utils.logging.setLogLevel(previous_level)
