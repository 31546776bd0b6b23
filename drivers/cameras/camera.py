"""The camera contract: a source creates a camera, which is then opened, configured and read.

Creating a camera does not access the device. One thread then opens, configures, reads and closes
the camera, and may wait for it. All other threads get the newest picture from
:class:`rotemina.app.cameras.CameraFeed` and never wait.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import ceil
from types import MappingProxyType
from typing import TYPE_CHECKING, final

from rotemina.drivers.cameras.failed_reads import RETRY_DELAY_S, FailedReadCounter
from rotemina.drivers.cameras.frame import (
    CameraFrame,
    MetadataValue,
    Pixels,
    PixelType,
    SensorRegion,
    convert_to_mono8,
    find_pixel_type,
    is_pixel_array,
)
from rotemina.drivers.cameras.settings import (
    CameraDescription,
    CameraSettings,
    CameraTrigger,
    check_settings,
)
from rotemina.drivers.contract import CameraLostError, CameraReadError, Clock, StateError
from rotemina.sim.compatibility import serve_former_names

#: Waits for a number of seconds.
Wait = Callable[[float], None]


@dataclass(frozen=True, slots=True)
class CameraIdentity:
    """Identity of a camera. The ``key`` stays the same when the camera is restarted or replugged.

    Attributes
    ----------
    key : str
        The source, a colon, and the address within the source, such as ``opencv:0``.
    name : str
        Name for display.
    source : str
        Name of the source's entry point.
    """

    key: str
    name: str
    source: str

    @property
    def address(self) -> str:
        """The address by which the source finds the camera."""
        return self.key.partition(":")[2]


@dataclass(frozen=True, slots=True, eq=False)
class RawFrame:
    """A picture from a driver, before it is cropped and converted.

    The fields have the meaning of those of :class:`CameraFrame`. ``region`` is None if the picture
    shows the whole sensor. ``lost`` is the number of pictures lost since the camera was opened.
    """

    pixels: Pixels
    bits: int
    host_time_s: float
    region: SensorRegion | None = None
    exposure_s: float | None = None
    lost: int = 0
    metadata: Mapping[str, MetadataValue] = field(default_factory=lambda: MappingProxyType({}))


class Camera(ABC):
    """Base class of cameras. The constructor does no I/O.

    Parameters
    ----------
    identity : CameraIdentity
    clock : callable
        Returns the host's time, s, for the time stamps of frames.
    wait : callable
        Waits for a number of seconds; in tests it advances the clock.
    """

    def __init__(
        self, identity: CameraIdentity, *, clock: Clock = time.monotonic, wait: Wait = time.sleep
    ) -> None:
        self.identity = identity
        self.clock = clock
        self.wait = wait
        self._description: CameraDescription | None = None
        self._settings = CameraSettings()
        self._frame_count = 0
        self._is_trigger_pending = False
        self._failed_reads = FailedReadCounter(identity.name, clock)

    def __init_subclass__(cls) -> None:
        """Refuse a subclass that overrides a final method instead of the hook that it calls."""
        super().__init_subclass__()
        for name, member in vars(Camera).items():
            if getattr(member, "__final__", False) and getattr(cls, name) is not member:
                advice = f"; implement _{name} instead" if hasattr(Camera, f"_{name}") else ""
                raise TypeError(f"{cls.__name__}.{name}: final in Camera{advice}")

    @property
    def name(self) -> str:
        """The name of the camera in messages."""
        return self.identity.name

    @property
    def description(self) -> CameraDescription:
        """The camera's capabilities.

        Raises
        ------
        StateError
            If the camera is closed, so that its capabilities are unknown.
        """
        if self._description is None:
            raise StateError("{name} is closed; open it first", name=self.name)
        return self._description

    @property
    def settings(self) -> CameraSettings:
        """The current settings, as the camera has adjusted the requested ones."""
        return self._settings

    @final
    def open(self) -> None:
        """Connect to the camera without changing its settings.

        Raises
        ------
        StateError
            If it is already open.
        CameraLostError
            If it is not connected.
        CameraRefusedError
            If the device is not a camera or cannot be opened, for example for lack of permission or
            because another program uses it.
        """
        if self._description is not None:
            raise StateError("{name} is already open; close it first", name=self.name)
        self._frame_count = 0
        self._is_trigger_pending = False
        self._failed_reads = FailedReadCounter(self.name, self.clock)
        self._settings = CameraSettings()
        self._description = self._open()

    @final
    def close(self) -> None:
        """Release the camera; safe to call twice."""
        if self._description is not None:
            self._description = None
            self._close()

    @final
    def configure(self, settings: CameraSettings) -> None:
        """Apply settings, which take effect with the next picture.

        Raises
        ------
        CameraSettingError
            If the camera does not support them; then all settings remain unchanged.
        StateError
            If it is closed.
        CameraLostError
            If it is no longer connected.
        """
        check_settings(self.name, self.description, settings)
        self._is_trigger_pending = False
        self._settings = self._configure(settings)

    @final
    def trigger(self) -> None:
        """Make the next :meth:`grab` take one picture.

        Raises
        ------
        StateError
            If the camera is closed or free-running.
        """
        # Reading the description raises StateError if the camera is closed.
        if self.description and self._settings.trigger is not CameraTrigger.SOFTWARE:
            raise StateError(
                "{name} is free-running; configure a software trigger first", name=self.name
            )
        self._is_trigger_pending = True

    @final
    def grab(self, timeout_s: float) -> CameraFrame | None:
        """Return the newest picture that was not returned before; None if none arrives in time.

        A failed read counts as a lost picture, and the read is retried until the time-out.

        Raises
        ------
        StateError
            If the camera is closed.
        CameraLostError
            If the camera is no longer connected, its video file has ended, or every read failed for
            1 s. The caller must then close the camera.
        """
        description = self.description
        if self._settings.trigger is CameraTrigger.SOFTWARE and not self._is_trigger_pending:
            self.wait(timeout_s)
            return None
        deadline_s = self.clock() + timeout_s
        for _ in range(1 + ceil(timeout_s / RETRY_DELAY_S)):
            start_s = self.clock()
            try:
                raw_frame = self._grab(max(deadline_s - start_s, 0.0))
                frame = None if raw_frame is None else self._make_frame(raw_frame, description)
            except CameraLostError:
                raise
            # A library or a plugin may raise any exception for a single picture.
            except Exception as error:
                self._failed_reads.add(error, start_s)
            else:
                if frame is not None:
                    self._failed_reads.end_streak()
                    self._is_trigger_pending = False
                    self._frame_count += 1
                return frame
            self.wait(min(RETRY_DELAY_S, max(deadline_s - self.clock(), 0.0)))
            if self.clock() > deadline_s:
                break
        return None

    @final
    def read_first(self, read: Callable[[], Pixels]) -> Pixels:
        """Return the first picture, for an ``_open`` that derives the capabilities from it.

        A failed read is retried, as in :meth:`grab`.

        Raises
        ------
        CameraLostError
            If ``read`` raises it, or every read failed for 1 s.
        """
        while True:
            start_s = self.clock()
            try:
                pixels = read()
                self._check_pixels(pixels)
            except CameraLostError:
                raise
            # As in grab, a library may raise any exception.
            except Exception as error:
                self._failed_reads.add(error, start_s)
            else:
                self._failed_reads.end_streak()
                return pixels
            self.wait(RETRY_DELAY_S)

    def _make_frame(self, raw_frame: RawFrame, description: CameraDescription) -> CameraFrame:
        """Check a picture, crop it to the selected region, and convert it to the pixel type."""
        raw_region = raw_frame.region or description.full_region
        self._check_frame(raw_frame, raw_region, description)
        pixels, bits = raw_frame.pixels, raw_frame.bits
        region = self._settings.region or raw_region
        if region != raw_region:
            left, top = region.left - raw_region.left, region.top - raw_region.top
            pixels = pixels[top : top + region.height, left : left + region.width]
        if (
            self._settings.pixel_type is PixelType.MONO8
            and find_pixel_type(pixels) is not PixelType.MONO8
        ):
            pixels, bits = convert_to_mono8(pixels, bits), 8
        lost = raw_frame.lost + self._failed_reads.count
        return CameraFrame(
            pixels,
            raw_frame.host_time_s,
            self._frame_count + lost,
            bits,
            region,
            raw_frame.exposure_s,
            lost,
            MappingProxyType(dict(raw_frame.metadata)),
            description.noise_free,
        )

    def _check_frame(
        self, raw_frame: RawFrame, raw_region: SensorRegion, description: CameraDescription
    ) -> None:
        """Raise if a picture no longer matches the description made when the camera was opened."""
        self._check_pixels(raw_frame.pixels)
        rows, columns = raw_frame.pixels.shape[:2]
        if (columns, rows) != (raw_region.width, raw_region.height):
            raise CameraReadError(
                "{name}: a picture of {columns} × {rows} px, expected {width} × {height}. The "
                "resolution has changed: close the camera, open it again, and repeat the "
                "calibration",
                name=self.name,
                columns=columns,
                rows=rows,
                width=raw_region.width,
                height=raw_region.height,
            )
        expected_type = self._settings.pixel_type or description.pixel_types[0]
        actual_type = find_pixel_type(raw_frame.pixels)
        # MONO8 may be requested although the camera delivers another type. The pictures are then
        # converted by _make_frame.
        if actual_type is not expected_type and (expected_type, actual_type) != (
            PixelType.MONO8,
            description.pixel_types[0],
        ):
            raise CameraReadError(
                "{name}: a picture of type {found}, expected {expected}. The pixel type has "
                "changed: close the camera and open it again",
                name=self.name,
                found=actual_type,
                expected=expected_type,
            )

    def _check_pixels(self, pixels: object) -> None:
        if not is_pixel_array(pixels):
            dtype, shape = getattr(pixels, "dtype", "none"), getattr(pixels, "shape", ())
            raise CameraReadError(
                "{name} gives empty or unusable pictures (pixels: {dtype}, size: {size}); "
                "check the camera and its cable, and open it again",
                name=self.name,
                dtype=str(dtype),
                size=" × ".join(map(str, shape)) or "0",
            )

    @abstractmethod
    def _open(self) -> CameraDescription:
        """Connect and return the camera's capabilities; on failure leave nothing open.

        If the capabilities depend on a picture, read it with :meth:`read_first`.
        """

    @abstractmethod
    def _close(self) -> None:
        """Disconnect; never raise if the camera is already gone."""

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        """Apply the settings to the device, and return the settings that are then in effect.

        A driver may leave ``region`` to :meth:`grab`, which crops the pictures to the returned one.
        """
        return settings

    @abstractmethod
    def _grab(self, timeout_s: float) -> RawFrame | None:
        """Wait for the newest picture; with a software trigger, take one.

        If only this picture cannot be read, raise :class:`CameraReadError`, or let the exception of
        the library pass. Raise :class:`CameraLostError` only if no other picture can follow.
        """


class FocusDrive(Camera, ABC):
    """A camera whose microscope has a motorised focus."""

    @property
    @abstractmethod
    def focus_m(self) -> float:
        """Position of the focal plane along the optical axis, from the drive's zero, m."""

    @property
    @abstractmethod
    def focus_range_m(self) -> tuple[float, float]:
        """Lowest and highest position of the focal plane, m."""

    @abstractmethod
    def move_focus(self, focus_m: float) -> None:
        """Move the focal plane; may be called from any thread.

        Raises
        ------
        CameraSettingError
            If the position is out of range; then the focal plane does not move.
        """


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Picture="RawFrame",
    )
