"""The camera contract: made by a source, opened, configured and read.

A camera is made without touching anything; then it is opened, configured, grabbed from and closed
by one thread, which may wait. Nobody else waits for it:
:class:`rotemina.app.cameras.feed.CameraFeed` hands its newest picture to everybody.
"""

import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import final

from rotemina.drivers.cameras.errors import CameraLostError
from rotemina.drivers.cameras.frame import Frame, Pixels, Region, Remark
from rotemina.drivers.cameras.pixels import as_mono8, pixel_type_of
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

        Raises
        ------
        StateError
            If it is closed.
        CameraLostError
            If it has gone, has ended, or gives pictures of another size; it is then to be closed.
        """
        can = self.description
        if self._settings.trigger is Trigger.SOFTWARE and not self._triggered:
            self.wait(timeout_s)
            return None
        picture = self._grab(timeout_s)
        if picture is None:
            return None
        self._triggered = False
        shown = picture.region or can.whole
        rows, columns = picture.pixels.shape[:2]
        if (columns, rows) != (shown.width, shown.height):
            raise CameraLostError(
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
        self._count += 1
        return self._frame(picture, shown)

    def _frame(self, picture: Picture, shown: Region) -> Frame:
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
        return Frame(
            pixels,
            picture.host_time_s,
            self._count - 1 + picture.lost,
            bits,
            wanted,
            picture.exposure_s,
            picture.lost,
            MappingProxyType(dict(picture.metadata)),
        )

    @abstractmethod
    def _open(self) -> CameraDescription:
        """Connect and tell what it can do; on failure leave nothing open behind."""

    @abstractmethod
    def _close(self) -> None:
        """Disconnect; never raise for a camera that has gone."""

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        """Set what is possible and return what is in force; regions are cut out by the base."""
        return settings

    @abstractmethod
    def _grab(self, timeout_s: float) -> Picture | None:
        """Wait for the newest picture; with a software trigger, take one."""


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
