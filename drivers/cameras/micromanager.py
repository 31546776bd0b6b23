"""Cameras of Micro-Manager, through pymmcore-plus, an optional extra.

A camera is named by the configuration file that Micro-Manager's own wizard has written for it.
"""

import logging
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Picture, Wait
from rotemina.drivers.cameras.errors import (
    CameraLostError,
    CameraReadError,
    CameraRefusedError,
    CameraSettingError,
)
from rotemina.drivers.cameras.frame import Region
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings, PixelType, Trigger
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.clock import Clock
from rotemina.sim.messages import marked, message

_LOG = logging.getLogger(__name__)
_INSTALL = message("engine", "pip install 'rotemina[micromanager]', then mmcore install")
_LOOK_S = 0.002  # between two looks into Micro-Manager's buffer
_EXPOSURES_S = (1e-5, 100.0)
_GAIN = "Gain"

Core = Callable[[], Any]


def installed_core() -> Any:
    """Return a core of its own; pymmcore-plus is imported when the first is made."""
    try:
        return import_module("pymmcore_plus").CMMCorePlus()
    except (ImportError, OSError, RuntimeError) as error:
        _LOG.warning("Micro-Manager cannot be loaded", exc_info=error)
        raise CameraRefusedError(
            message(
                "engine", "Micro-Manager cannot be loaded; the log has the cause. {install}"
            ).fill(install=_INSTALL)
        ) from error


class MicroManager(CameraSource):
    """Cameras of Micro-Manager; ``core`` makes a ``CMMCorePlus``."""

    name = "Micro-Manager"
    address_hint = marked("engine", "configuration file of Micro-Manager (.cfg)")

    def __init__(
        self,
        *,
        clock: Clock = time.monotonic,
        wait: Wait = time.sleep,
        core: Core = installed_core,
    ) -> None:
        super().__init__(clock=clock, wait=wait)
        self.core = core

    @property
    def problem(self) -> str | None:
        """Whether the extra is missing; see :class:`CameraSource`."""
        if self.core is installed_core and find_spec("pymmcore_plus") is None:
            return message("engine", "pymmcore-plus is not installed: {install}").fill(
                install=_INSTALL
            )
        return None

    def devices(self) -> tuple[CameraIdentity, ...]:
        """Return nothing: a configuration has to be named."""
        return ()

    def addressed(self, address: str) -> CameraIdentity:
        """Return the camera of a configuration file; see :class:`CameraSource`."""
        path = Path(address.strip())
        if path.suffix.lower() != ".cfg":
            raise CameraRefusedError(
                message("engine", "{name}: {address}: enter a {address_hint}").fill(
                    name=self.name, address=repr(address), address_hint=self.address_hint
                )
            )
        return CameraIdentity(f"micromanager:{path}", path.stem, "micromanager")

    def camera(self, identity: CameraIdentity) -> Camera:
        """Return it; see :class:`CameraSource`."""
        return MicroManagerCamera(identity, self)


class MicroManagerCamera(Camera):
    """The camera that a configuration names."""

    def __init__(self, identity: CameraIdentity, source: MicroManager) -> None:
        super().__init__(identity, clock=source.clock, wait=source.wait)
        self._make = source.core
        self._core: Any = None

    def _open(self) -> CameraDescription:
        path = Path(self.identity.address)
        if not path.is_file():
            raise CameraLostError(
                message("engine", "{path}: file not found; choose another configuration").fill(
                    path=path
                )
            )
        self._core = self._make()
        self._lost = 0
        try:
            self._core.loadSystemConfiguration(str(path))
            if not self._core.getCameraDevice():
                raise CameraRefusedError(
                    message(
                        "engine", "{path} names no camera; add one with Micro-Manager's wizard"
                    ).fill(path=path)
                )
            self._core.clearROI()
            described = self._described()
            self._core.startContinuousSequenceAcquisition(0)
        except (RuntimeError, OSError) as error:
            self._close()
            _LOG.warning("%s: Micro-Manager cannot open it", path, exc_info=error)
            raise CameraLostError(
                message(
                    "engine",
                    "{path}: Micro-Manager cannot open it; the log has the cause. Check the "
                    "configuration with Micro-Manager's wizard, and whether the camera is on and "
                    "connected",
                ).fill(path=path)
            ) from error
        except CameraRefusedError:
            self._close()
            raise
        return described

    def _described(self) -> CameraDescription:
        core = self._core
        if core.getNumberOfComponents() > 1:
            types: tuple[PixelType, ...] = (PixelType.COLOUR, PixelType.MONO8)
        elif core.getBytesPerPixel() == 1:
            types = (PixelType.MONO8,)
        elif core.getBytesPerPixel() == 2:
            types = (PixelType.MONO16, PixelType.MONO8)
        else:
            raise CameraRefusedError(
                message(
                    "engine",
                    "{name}: pixels of {getbytesperpixel} bytes: must be grey of 8 or 16 bits, or "
                    "colour; set the camera's pixel type in its configuration",
                ).fill(name=self.name, getbytesperpixel=core.getBytesPerPixel())
            )
        return CameraDescription(
            core.getImageWidth(),
            core.getImageHeight(),
            types,
            (Trigger.FREE, Trigger.SOFTWARE),
            _EXPOSURES_S,
            self._gains(),
        )

    def _gains(self) -> tuple[float, float] | None:
        core, label = self._core, self._core.getCameraDevice()
        if not (core.hasProperty(label, _GAIN) and core.hasPropertyLimits(label, _GAIN)):
            return None
        low = core.getPropertyLowerLimit(label, _GAIN)
        return low, core.getPropertyUpperLimit(label, _GAIN)

    def _close(self) -> None:
        core, self._core = self._core, None
        with suppress(RuntimeError):  # it may have gone
            core.stopSequenceAcquisition()
        with suppress(RuntimeError):
            core.unloadAllDevices()

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        with self._translated():
            if self._core.isSequenceRunning():
                self._core.stopSequenceAcquisition()
        try:
            self._set(settings)
        except RuntimeError as error:
            with self._translated():
                self._set(self.settings)
                self._run(self.settings)
            _LOG.warning("%s rejected %s", self.name, settings, exc_info=error)
            raise CameraSettingError(
                message(
                    "engine",
                    "{name} rejected the settings, and keeps those it had; the log has the cause. "
                    "Choose other values",
                ).fill(name=self.name)
            ) from error
        with self._translated():
            self._run(settings)
            if settings.region is not None:  # some cameras move it to where they can
                settings = replace(settings, region=Region(*self._core.getROI()))
        return settings

    def _set(self, settings: CameraSettings) -> None:
        core = self._core
        if settings.exposure_s is not None:
            core.setExposure(settings.exposure_s * 1e3)
        if settings.gain is not None:
            core.setProperty(core.getCameraDevice(), _GAIN, settings.gain)
        region = settings.region
        if region is None:
            core.clearROI()
        else:
            core.setROI(region.left, region.top, region.width, region.height)

    def _run(self, settings: CameraSettings) -> None:
        if settings.trigger is Trigger.FREE:
            self._core.startContinuousSequenceAcquisition(0)

    def _grab(self, timeout_s: float) -> Picture | None:
        core = self._core
        if self.settings.trigger is Trigger.SOFTWARE:
            core.snapImage()
            pixels = core.getImage()
        else:
            count = self._arrived(timeout_s)
            if not count:
                return None
            for _ in range(count - 1):  # the last one is the newest
                core.popNextImage()
                self._lost += 1
            pixels = core.popNextImage()
        return Picture(
            pixels,
            8 if pixels.ndim == 3 else int(core.getImageBitDepth()),
            self.clock(),
            Region(*core.getROI()),
            core.getExposure() / 1e3,
            self._lost,
        )

    def _arrived(self, timeout_s: float) -> int:
        """Return how many pictures wait, after waiting for the first."""
        core, until_s = self._core, self.clock() + timeout_s
        while not (count := int(core.getRemainingImageCount())):
            if not core.isSequenceRunning():
                raise CameraReadError(
                    message(
                        "engine",
                        "{name} no longer takes pictures; check whether it is plugged in, "
                        "and open it again",
                    ).fill(name=self.name)
                )
            if self.clock() >= until_s:
                return 0
            self.wait(_LOOK_S)
        return count

    @contextmanager
    def _translated(self) -> Iterator[None]:
        """Make the errors of Micro-Manager ours."""
        try:
            yield
        except RuntimeError as error:
            _LOG.warning("%s: Micro-Manager has lost the camera", self.name, exc_info=error)
            raise CameraLostError(
                message(
                    "engine",
                    "{name}: Micro-Manager has lost the camera; the log has the cause. Check "
                    "whether it is on and connected, and open it again",
                ).fill(name=self.name)
            ) from error
