"""The camera contract: made by a source, opened, configured and read.

A camera is made without touching anything; then it is opened, configured, grabbed from and closed
by one thread, which may wait. Nobody else waits for it:
:class:`rotemina.app.cameras.feed.CameraFeed` hands its newest picture to everybody.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import ceil
from types import MappingProxyType
from typing import final

from rotemina.drivers.cameras.errors import CameraLostError, CameraReadError
from rotemina.drivers.cameras.failed_reads import RETRY_S, FailedReads
from rotemina.drivers.cameras.frame import Frame, Pixels, Region, Remark
from rotemina.drivers.cameras.pixels import are_pixels, as_mono8, pixel_type_of
from rotemina.drivers.cameras.settings import (
    CameraDescription,
    CameraSettings,
    PixelType,
    Trigger,
    check,
)
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import StateError
from rotemina.sim.messages import message

#: Waits for so many seconds.
Wait = Callable[[float], None]


@dataclass(frozen=True, slots=True)
class CameraIdentity:
    """Which camera it is: ``key`` stays the same over restarts and replugging.

    Attributes
    ----------
    key : str
        The source, a colon, and what the source finds it by: ``opencv:0``.
    name : str
        For screens.
    source : str
        The entry point of its source.
    """

    key: str
    name: str
    source: str

    @property
    def address(self) -> str:
        """What the source finds it by."""
        return self.key.partition(":")[2]


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """What a driver grabs, before it is cut and converted; fields as in :class:`Frame`.

    ``region`` None: it shows the whole sensor. ``lost`` counts since the camera was opened.
    """

    pixels: Pixels
    bits: int
    host_time_s: float
    region: Region | None = None
    exposure_s: float | None = None
    lost: int = 0
    metadata: Mapping[str, Remark] = field(default_factory=lambda: MappingProxyType({}))


class Camera(ABC):
    """One camera. The constructor does no I/O.

    Parameters
    ----------
    identity : CameraIdentity
    clock : callable
        The host's time, s: what frames are stamped with.
    wait : callable
        Waits for so many seconds; tests move their clock on.
    """

    def __init__(
        self, identity: CameraIdentity, *, clock: Clock = time.monotonic, wait: Wait = time.sleep
    ) -> None:
        self.identity = identity
        self.clock = clock
        self.wait = wait
        self._description: CameraDescription | None = None
        self._settings = CameraSettings()
        self._count = 0
        self._triggered = False
        self._failed_reads = FailedReads(identity.name, clock)

    def __init_subclass__(cls) -> None:
        """Refuse a subclass that overrides a rule of the contract instead of a hook."""
        super().__init_subclass__()
        for name, member in vars(Camera).items():
            if getattr(member, "__final__", False) and getattr(cls, name) is not member:
                raise TypeError(f"{cls.__name__}.{name}: final in Camera; fill _{name}")

    @property
    def name(self) -> str:
        """How messages call it."""
        return self.identity.name

    @property
    def description(self) -> CameraDescription:
        """The camera's capabilities.

        Raises
        ------
        StateError
            If it is closed: it has not been asked.
        """
        if self._description is None:
            raise StateError(
                message("engine", "{name} is closed; open it first").fill(name=self.name)
            )
        return self._description

    @property
    def settings(self) -> CameraSettings:
        """The settings in force: as requested, or as adjusted by the camera."""
        return self._settings

    @final
    def open(self) -> None:
        """Connect, with the settings that the camera has.

        Raises
        ------
        StateError
            If it is open already.
        CameraLostError
            If it is not there.
        CameraRefusedError
            If it is none, or cannot be opened: permission, used by another program, no video.
        """
        if self._description is not None:
            raise StateError(
                message("engine", "{name} is already open; close it first").fill(name=self.name)
            )
        self._count = 0
        self._triggered = False
        self._failed_reads = FailedReads(self.name, self.clock)
        self._settings = CameraSettings()
        self._description = self._open()

    @final
    def close(self) -> None:
        """Release it; safe to call twice."""
        if self._description is not None:
            self._description = None
            self._close()

    @final
    def configure(self, settings: CameraSettings) -> None:
        """Set it; the next picture is taken with that.

        Raises
        ------
        CameraSettingError
            If it cannot do that; then everything stays as it was.
        StateError
            If it is closed.
        CameraLostError
            If it has gone.
        """
        check(self.name, self.description, settings)
        self._triggered = False
        self._settings = self._configure(settings)

    @final
    def trigger(self) -> None:
        """Have the next :meth:`grab` take one picture.

        Raises
        ------
        StateError
            If it is closed, or runs freely.
        """
        if self.description and self._settings.trigger is not Trigger.SOFTWARE:
            raise StateError(
                message(
                    "engine", "{name} is free-running; configure a software trigger first"
                ).fill(name=self.name)
            )
        self._triggered = True

    @final
    def grab(self, timeout_s: float) -> Frame | None:
        """Return the newest picture that was not returned before; None if none comes in time.

        A read that fails is counted as a lost picture, and repeated while there is time.

        Raises
        ------
        StateError
            If it is closed.
        CameraLostError
            If it has gone or has ended, or if every read failed for 1 s; it is then to be closed.
        """
        can = self.description
        if self._settings.trigger is Trigger.SOFTWARE and not self._triggered:
            self.wait(timeout_s)
            return None
        until_s = self.clock() + timeout_s
        for _ in range(1 + ceil(timeout_s / RETRY_S)):
            began_s = self.clock()
            try:
                picture = self._grab(max(until_s - began_s, 0.0))
                frame = None if picture is None else self._frame(picture, can)
            except CameraLostError:
                raise
            except Exception as error:  # what a library or a plugin raises for one picture
                self._failed_reads.add(error, began_s)
            else:
                if frame is not None:
                    self._failed_reads.end_row()
                    self._triggered = False
                    self._count += 1
                return frame
            self.wait(min(RETRY_S, max(until_s - self.clock(), 0.0)))
            if self.clock() > until_s:
                break
        return None

    @final
    def read_first(self, read: Callable[[], Pixels]) -> Pixels:
        """Return the first picture, for an ``_open`` that learns from it what the camera is.

        A read that fails is repeated, as in :meth:`grab`.

        Raises
        ------
        CameraLostError
            If ``read`` raises it, or every read failed for 1 s.
        """
        while True:
            began_s = self.clock()
            try:
                pixels = read()
                self._check_pixels(pixels)
            except CameraLostError:
                raise
            except Exception as error:  # as in grab
                self._failed_reads.add(error, began_s)
            else:
                self._failed_reads.end_row()
                return pixels
            self.wait(RETRY_S)

    def _frame(self, picture: Picture, can: CameraDescription) -> Frame:
        shown = picture.region or can.whole
        self._check(picture, shown, can)
        pixels, bits = picture.pixels, picture.bits
        wanted = self._settings.region or shown
        if wanted != shown:
            left, top = wanted.left - shown.left, wanted.top - shown.top
            pixels = pixels[top : top + wanted.height, left : left + wanted.width]
        if (
            self._settings.pixel_type is PixelType.MONO8
            and pixel_type_of(pixels) is not PixelType.MONO8
        ):
            pixels, bits = as_mono8(pixels, bits), 8
        lost = picture.lost + self._failed_reads.count
        return Frame(
            pixels,
            picture.host_time_s,
            self._count + lost,
            bits,
            wanted,
            picture.exposure_s,
            lost,
            MappingProxyType(dict(picture.metadata)),
            can.noise_free,
        )

    def _check(self, picture: Picture, shown: Region, can: CameraDescription) -> None:
        """Refuse a picture that is not as the camera was described when it was opened."""
        self._check_pixels(picture.pixels)
        rows, columns = picture.pixels.shape[:2]
        if (columns, rows) != (shown.width, shown.height):
            raise CameraReadError(
                message(
                    "engine",
                    "{name}: a picture of {columns} × {rows} px, expected {width} × {height}: its "
                    "resolution has changed; close it and open it again, and calibrate anew",
                ).fill(
                    name=self.name,
                    columns=columns,
                    rows=rows,
                    width=shown.width,
                    height=shown.height,
                )
            )
        expected = self._settings.pixel_type or can.pixel_types[0]
        found = pixel_type_of(picture.pixels)
        # MONO8 is made of the camera's own type where the camera does not have it.
        if found is not expected and (expected, found) != (PixelType.MONO8, can.pixel_types[0]):
            raise CameraReadError(
                message(
                    "engine",
                    "{name}: a picture of type {found}, expected {expected}: its pixel type has "
                    "changed; close it and open it again",
                ).fill(name=self.name, found=found, expected=expected)
            )

    def _check_pixels(self, pixels: object) -> None:
        """Refuse what is no picture at all."""
        if not are_pixels(pixels):
            dtype, shape = getattr(pixels, "dtype", "none"), getattr(pixels, "shape", ())
            raise CameraReadError(
                message(
                    "engine",
                    "{name} gives empty or unusable pictures (pixels: {dtype}, size: {size}); "
                    "check the camera and its cable, and open it again",
                ).fill(name=self.name, dtype=str(dtype), size=" × ".join(map(str, shape)) or "0")
            )

    @abstractmethod
    def _open(self) -> CameraDescription:
        """Connect and return what it can do; on failure leave nothing open behind.

        Where that takes a picture, it comes from :meth:`read_first`.
        """

    @abstractmethod
    def _close(self) -> None:
        """Disconnect; never raise for a camera that has gone."""

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        """Set what is possible and return what is in force; regions are cut out by the base."""
        return settings

    @abstractmethod
    def _grab(self, timeout_s: float) -> Picture | None:
        """Wait for the newest picture; with a software trigger, take one.

        It raises :class:`CameraReadError`, or what a library raises, if this one picture could not
        be read, and :class:`CameraLostError` only if no other will follow.
        """


class FocusDrive(Camera, ABC):
    """A camera whose microscope has a motor at its focus."""

    @property
    @abstractmethod
    def focus_m(self) -> float:
        """Where the focal plane is, along the view, from the drive's zero, m."""

    @property
    @abstractmethod
    def focus_range_m(self) -> tuple[float, float]:
        """How far it goes."""

    @abstractmethod
    def move_focus(self, focus_m: float) -> None:
        """Move the focal plane; may be called from any thread.

        Raises
        ------
        CameraSettingError
            If it is out of range; then it stays.
        """
