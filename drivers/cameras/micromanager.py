"""Cameras of Micro-Manager, accessed with pymmcore-plus, an optional dependency.

The address of a camera is its configuration file, which Micro-Manager's wizard writes.
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

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, RawFrame, Wait
from rotemina.drivers.cameras.frame import PixelType, SensorRegion
from rotemina.drivers.cameras.settings import (
    CameraDescription,
    CameraSettings,
    CameraTrigger,
)
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.contract import (
    CameraLostError,
    CameraReadError,
    CameraRefusedError,
    CameraSettingError,
    Clock,
)
from rotemina.sim.messages import marked, message

_LOG = logging.getLogger(__name__)
_INSTALL_HINT = message("engine", "pip install 'rotemina[micromanager]', then mmcore install")
_POLL_PERIOD_S = 0.002
_EXPOSURE_RANGE_S = (1e-5, 100.0)
_GAIN_PROPERTY = "Gain"

CoreFactory = Callable[[], Any]


def make_core() -> Any:
    """Create a ``CMMCorePlus``; the first call imports pymmcore-plus."""
    try:
        return import_module("pymmcore_plus").CMMCorePlus()
    except (ImportError, OSError, RuntimeError) as error:
        _LOG.warning("Micro-Manager cannot be loaded", exc_info=error)
        raise CameraRefusedError(
            "Micro-Manager cannot be loaded; see the log for the cause. {install}",
            install=_INSTALL_HINT,
        ) from error


class MicroManagerSource(CameraSource):
    """Source of Micro-Manager's cameras; ``core`` creates a ``CMMCorePlus``."""

    name = "Micro-Manager"
    address_hint = marked("engine", "configuration file of Micro-Manager (.cfg)")

    def __init__(
        self,
        *,
        clock: Clock = time.monotonic,
        wait: Wait = time.sleep,
        core: CoreFactory = make_core,
    ) -> None:
        super().__init__(clock=clock, wait=wait)
        self.core = core

    @property
    def problem(self) -> str | None:
        """A message if pymmcore-plus is not installed; see :class:`CameraSource`."""
        if self.core is make_core and find_spec("pymmcore_plus") is None:
            return message("engine", "pymmcore-plus is not installed: {install}").fill(
                install=_INSTALL_HINT
            )
        return None

    def devices(self) -> tuple[CameraIdentity, ...]:
        """Return no camera: the operator has to enter a configuration file."""
        return ()

    def parse_address(self, address: str) -> CameraIdentity:
        """Return the camera of a configuration file; see :class:`CameraSource`."""
        path = Path(address.strip())
        if path.suffix.lower() != ".cfg":
            raise CameraRefusedError(
                "{name}: {address}: enter a {address_hint}",
                name=self.name,
                address=repr(address),
                address_hint=self.address_hint,
            )
        return CameraIdentity(f"micromanager:{path}", path.stem, "micromanager")

    def camera(self, identity: CameraIdentity) -> Camera:
        """Return a camera; see :class:`CameraSource`."""
        return MicroManagerCamera(identity, self)


class MicroManagerCamera(Camera):
    """The camera of a Micro-Manager configuration."""

    def __init__(self, identity: CameraIdentity, source: MicroManagerSource) -> None:
        super().__init__(identity, clock=source.clock, wait=source.wait)
        self._make_core = source.core
        self._core: Any = None

    def _open(self) -> CameraDescription:
        path = Path(self.identity.address)
        if not path.is_file():
            raise CameraLostError("{path}: file not found; choose another configuration", path=path)
        self._core = self._make_core()
        self._lost_count = 0
        try:
            self._core.loadSystemConfiguration(str(path))
            if not self._core.getCameraDevice():
                raise CameraRefusedError(
                    "{path} names no camera; add one with Micro-Manager's wizard", path=path
                )
            self._core.clearROI()
            description = self._describe()
            self._core.startContinuousSequenceAcquisition(0)
        except (RuntimeError, OSError) as error:
            self._close()
            _LOG.warning("%s: Micro-Manager cannot open it", path, exc_info=error)
            raise CameraLostError(
                "{path}: Micro-Manager cannot open it; see the log for the cause. Check the "
                "configuration with Micro-Manager's wizard, and that the camera is switched on "
                "and connected",
                path=path,
            ) from error
        except CameraRefusedError:
            self._close()
            raise
        return description

    def _describe(self) -> CameraDescription:
        core = self._core
        if core.getNumberOfComponents() > 1:
            pixel_types: tuple[PixelType, ...] = (PixelType.COLOUR, PixelType.MONO8)
        elif core.getBytesPerPixel() == 1:
            pixel_types = (PixelType.MONO8,)
        elif core.getBytesPerPixel() == 2:
            pixel_types = (PixelType.MONO16, PixelType.MONO8)
        else:
            raise CameraRefusedError(
                "{name}: pixels of {getbytesperpixel} bytes: must be 8-bit or 16-bit grey, or "
                "colour; set the camera's pixel type in its configuration",
                name=self.name,
                getbytesperpixel=core.getBytesPerPixel(),
            )
        return CameraDescription(
            core.getImageWidth(),
            core.getImageHeight(),
            pixel_types,
            (CameraTrigger.FREE, CameraTrigger.SOFTWARE),
            _EXPOSURE_RANGE_S,
            self._read_gain_range(),
        )

    def _read_gain_range(self) -> tuple[float, float] | None:
        core, label = self._core, self._core.getCameraDevice()
        if not (
            core.hasProperty(label, _GAIN_PROPERTY)
            and core.hasPropertyLimits(label, _GAIN_PROPERTY)
        ):
            return None
        low = core.getPropertyLowerLimit(label, _GAIN_PROPERTY)
        return low, core.getPropertyUpperLimit(label, _GAIN_PROPERTY)

    def _close(self) -> None:
        core, self._core = self._core, None
        # The camera may be gone, but closing must not fail.
        with suppress(RuntimeError):
            core.stopSequenceAcquisition()
        with suppress(RuntimeError):
            core.unloadAllDevices()

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        with self._translate_errors():
            if self._core.isSequenceRunning():
                self._core.stopSequenceAcquisition()
        try:
            self._apply_settings(settings)
        except RuntimeError as error:
            with self._translate_errors():
                self._apply_settings(self.settings)
                self._start_acquisition(self.settings)
            _LOG.warning("%s rejected %s", self.name, settings, exc_info=error)
            raise CameraSettingError(
                "{name} rejected the settings and keeps its previous ones; see the log for the "
                "cause. Choose other values",
                name=self.name,
            ) from error
        with self._translate_errors():
            self._start_acquisition(settings)
            # Some cameras adjust the region to what their sensor supports.
            if settings.region is not None:
                settings = replace(settings, region=SensorRegion(*self._core.getROI()))
        return settings

    def _apply_settings(self, settings: CameraSettings) -> None:
        core = self._core
        if settings.exposure_s is not None:
            core.setExposure(settings.exposure_s * 1e3)
        if settings.gain is not None:
            core.setProperty(core.getCameraDevice(), _GAIN_PROPERTY, settings.gain)
        region = settings.region
        if region is None:
            core.clearROI()
        else:
            core.setROI(region.left, region.top, region.width, region.height)

    def _start_acquisition(self, settings: CameraSettings) -> None:
        if settings.trigger is CameraTrigger.FREE:
            self._core.startContinuousSequenceAcquisition(0)

    def _grab(self, timeout_s: float) -> RawFrame | None:
        core = self._core
        if self.settings.trigger is CameraTrigger.SOFTWARE:
            core.snapImage()
            pixels = core.getImage()
        else:
            buffered_count = self._wait_for_pictures(timeout_s)
            if not buffered_count:
                return None
            # Skip to the last picture in the buffer, which is the newest.
            for _ in range(buffered_count - 1):
                core.popNextImage()
                self._lost_count += 1
            pixels = core.popNextImage()
        return RawFrame(
            pixels,
            8 if pixels.ndim == 3 else int(core.getImageBitDepth()),
            self.clock(),
            SensorRegion(*core.getROI()),
            core.getExposure() / 1e3,
            self._lost_count,
        )

    def _wait_for_pictures(self, timeout_s: float) -> int:
        """Wait for a picture; return the number in the buffer, or 0 after the time-out."""
        core, deadline_s = self._core, self.clock() + timeout_s
        while not (count := int(core.getRemainingImageCount())):
            if not core.isSequenceRunning():
                raise CameraReadError(
                    "{name} no longer takes pictures; check that it is plugged in, and open "
                    "it again",
                    name=self.name,
                )
            if self.clock() >= deadline_s:
                return 0
            self.wait(_POLL_PERIOD_S)
        return count

    @contextmanager
    def _translate_errors(self) -> Iterator[None]:
        """Convert an error of Micro-Manager into :class:`CameraLostError`."""
        try:
            yield
        except RuntimeError as error:
            _LOG.warning("%s: Micro-Manager has lost the camera", self.name, exc_info=error)
            raise CameraLostError(
                "{name}: Micro-Manager has lost the camera; see the log for the cause. Check "
                "that it is switched on and connected, and open it again",
                name=self.name,
            ) from error
