"""Every kind of camera, each with a fake of the library that its driver calls."""

# ruff: noqa: N802 (the names are those of OpenCV and Micro-Manager)

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from itertools import cycle
from typing import Any

import cv2
import numpy as np

from rotemina.drivers.cameras import (
    Camera,
    CameraDescription,
    CameraIdentity,
    CameraSettings,
    CameraSource,
    PixelType,
    RawFrame,
    SimulatedMicroscope,
)
from rotemina.drivers.cameras.micromanager import MicroManagerSource
from rotemina.drivers.cameras.opencv import OpenCvSource
from rotemina.drivers.cameras.sequence import ImageSequenceSource
from rotemina.drivers.simulator import Simulator
from rotemina.sim.microscope import SceneRenderer
from rotemina.sim.robot_files import load_robot

RAW_TEXT = "(-215:Assertion failed) !_src.empty()"


class Fault(StrEnum):
    """A fault of a library in one picture."""

    # The library reports the failure as usual, for example by False.
    FAILS = "fails"
    # The library raises an unexpected exception.
    RAISES = "raises"
    EMPTY = "empty"
    OTHER_SHAPE = "other shape"
    OTHER_TYPE = "other type"


class LibraryError(RuntimeError):
    """A failed read, for libraries that report it by an exception."""


class Tap:
    """Filter for the pictures of a library: adds faults, or repeats a few buffers."""

    def __init__(self):
        # Faults of the next pictures, then of all further ones.
        self.faults: list[Fault] = []
        self.forever: Fault | None = None
        self.buffers: list[Any] = []
        self.read = 0

    def __call__(self, pixels):
        self.read += 1
        if self.buffers:
            return self.buffers[self.read % len(self.buffers)].copy()
        return self._apply_fault(pixels, self.faults.pop(0) if self.faults else self.forever)

    def _apply_fault(self, pixels, fault):
        match fault:
            case Fault.FAILS:
                raise LibraryError("buffer read failed")
            case Fault.RAISES:
                raise cv2.error(RAW_TEXT)
            case Fault.EMPTY:
                return pixels[:0]
            case Fault.OTHER_SHAPE:
                return pixels[:-2].copy()
            case Fault.OTHER_TYPE:
                return pixels[..., 0].copy() if pixels.ndim == 3 else pixels.astype(np.float32)
        return pixels

    def freeze(self, pixels, buffers, seed=0):
        """Return only noise from now on: ``buffers`` pictures like ``pixels``, in turns."""
        full_scale = 4096 if pixels.dtype == np.uint16 else 256
        rng = np.random.default_rng(seed)
        self.buffers = [
            rng.integers(full_scale // 4, full_scale // 2, pixels.shape).astype(pixels.dtype)
            for _ in range(buffers)
        ]


class FakeCapture:
    """A USB camera as seen through OpenCV. ``is_connected`` is False when it is unplugged."""

    def __init__(self, shape=(48, 64, 3)):
        self.is_connected, self.shape, self.count, self.properties = True, shape, 0, {}
        self.rejected_properties = set()
        self.arguments = None
        self.tap = Tap()

    def __call__(self, *arguments):
        self.arguments = arguments
        return self

    def isOpened(self):
        return self.is_connected

    def getBackendName(self):
        return "V4L2"

    def get(self, property_id):
        return self.properties.get(property_id, 1.0)

    def set(self, property_id, value):
        self.properties[property_id] = value
        return property_id not in self.rejected_properties

    def read(self):
        if not self.is_connected:
            return False, None
        self.count += 1
        try:
            return True, self.tap(np.full(self.shape, self.count % 256, np.uint8))
        except LibraryError:
            return False, None

    def release(self):
        pass


class FakeCore:
    """The core of Micro-Manager with a 12-bit camera, which takes a picture at every query."""

    def __init__(self):
        self.is_connected, self.roi, self.sequence, self.buffer = True, (0, 0, 64, 48), False, 0
        self.count, self.exposure_ms, self.properties, self.camera = 0, 10.0, {"Gain": 1.0}, "HRm"
        self.components, self.bytes_per_pixel, self.loaded = 1, 2, None
        self.tap = Tap()

    def _check_connection(self):
        if not self.is_connected:
            raise RuntimeError("Device is not responding")

    def loadSystemConfiguration(self, file):
        self._check_connection()
        self.loaded = file

    def unloadAllDevices(self):
        self.loaded = None

    def getCameraDevice(self):
        return self.camera

    def clearROI(self):
        self._check_connection()
        assert not self.sequence, "Micro-Manager refuses a region while a sequence runs"
        self.roi = (0, 0, 64, 48)

    def setROI(self, *roi):
        assert not self.sequence
        # The first column is a multiple of 4.
        self.roi = (roi[0] // 4 * 4, *roi[1:])

    def getROI(self):
        return list(self.roi)

    def getImageWidth(self):
        return self.roi[2]

    def getImageHeight(self):
        return self.roi[3]

    def getNumberOfComponents(self):
        return self.components

    def getBytesPerPixel(self):
        return self.bytes_per_pixel

    def getImageBitDepth(self):
        return 12

    def hasProperty(self, label, name):
        return label == self.camera and name in self.properties

    def hasPropertyLimits(self, label, name):
        return True

    def getPropertyLowerLimit(self, label, name):
        return 1.0

    def getPropertyUpperLimit(self, label, name):
        return 8.0

    def setProperty(self, label, name, value):
        self._check_connection()
        if value == 3.0:
            raise RuntimeError("Gain: invalid value")
        self.properties[name] = value

    def setExposure(self, ms):
        self._check_connection()
        self.exposure_ms = ms

    def getExposure(self):
        return self.exposure_ms

    def startContinuousSequenceAcquisition(self, interval_ms):
        self._check_connection()
        self.sequence = True

    def stopSequenceAcquisition(self):
        self._check_connection()
        self.sequence = False
        self.buffer = 0

    def isSequenceRunning(self):
        return self.sequence and self.is_connected

    def getRemainingImageCount(self):
        self.buffer += self.is_connected and self.sequence
        return self.buffer

    def popNextImage(self):
        assert self.buffer, "the buffer is empty"
        self.buffer -= 1
        return self.getImage()

    def snapImage(self):
        self._check_connection()
        assert not self.sequence

    def getImage(self):
        self.count += 1
        return self.tap(np.full((self.roi[3], self.roi[2]), self.count, np.uint16))


class TappedVideo:
    """The video file reader of OpenCV, with a tap on its pictures."""

    def __init__(self, tap, *arguments):
        self._tap, self._stream = tap, cv2.VideoCapture(*arguments)

    def __getattr__(self, name):
        return getattr(self._stream, name)

    def read(self):
        is_read, pixels = self._stream.read()
        if not is_read:
            return is_read, pixels
        try:
            return True, self._tap(pixels)
        except LibraryError:
            return False, None


def write_video(path, count=6, size=(64, 48), rate_hz=25.0):
    """Write grey pictures, each brighter by 20 than the previous one, as Motion JPEG."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), rate_hz, size)
    for number in range(count):
        writer.write(np.full((size[1], size[0], 3), 20 * number + 20, np.uint8))
    writer.release()
    return path


def write_sequence(folder, numbers, size=(64, 48), dtype=np.uint16, kind="png"):
    """Write pictures such as 1.png and 2.png into a folder; all pixels are the number."""
    folder.mkdir(exist_ok=True)
    for number in numbers:
        assert cv2.imwrite(str(folder / f"{number}.{kind}"), np.full(size[::-1], number, dtype))
    return folder


class PluginSource(CameraSource):
    """A third-party source, whose library is a function."""

    def __init__(self, library, *, noise_free=False, **host):
        super().__init__(**host)
        self.library, self.noise_free = library, noise_free

    def devices(self):
        return (CameraIdentity("plugin:1", "Plugin", "plugin"),)

    def camera(self, identity):
        return PluginCamera(identity, self)


class PluginCamera(Camera):
    def __init__(self, identity, source):
        super().__init__(identity, clock=source.clock, wait=source.wait)
        self._source = source

    def _open(self):
        height, width = self.read_first(self._source.library).shape
        return CameraDescription(
            width, height, (PixelType.MONO8,), noise_free=self._source.noise_free
        )

    def _close(self):
        pass

    def _grab(self, timeout_s):
        self.wait(min(timeout_s, 0.04))
        return RawFrame(self._source.library(), 8, self.clock())


@dataclass
class Bench:
    """A camera, a function that unplugs it, and the tap for its pictures."""

    camera: Camera
    unplug: Callable[[], object]
    tap: Tap


def simulated_bench(clock, folder, monkeypatch):
    drivers = [Simulator(load_robot("rotemina"), clock=clock)]
    source = SimulatedMicroscope(lambda: drivers[0], clock=clock, wait=clock.advance)
    tap, render_frame = Tap(), SceneRenderer.render_frame
    monkeypatch.setattr(
        SceneRenderer, "render_frame", lambda *args, **options: tap(render_frame(*args, **options))
    )

    def unplug():
        drivers[0] = Simulator(load_robot("fsm"), clock=clock)

    return Bench(source.camera(source.devices()[0]), unplug, tap)


def device_bench(clock, folder, monkeypatch):
    capture = FakeCapture()
    source = OpenCvSource(
        clock=clock, wait=clock.advance, list_cameras=lambda: {"0": "Cam"}, capture=capture
    )
    camera = source.camera(source.devices()[0])
    return Bench(camera, lambda: setattr(capture, "is_connected", False), capture.tap)


def film_bench(clock, folder, monkeypatch):
    tap = Tap()
    source = OpenCvSource(
        clock=clock, wait=clock.advance, capture=lambda *arguments: TappedVideo(tap, *arguments)
    )
    camera = source.camera(source.parse_address(str(write_video(folder / "v.avi"))))

    def unplug():
        # A file cannot be unplugged, but it ends.
        camera.configure(CameraSettings(repeat=False))

    return Bench(camera, unplug, tap)


def sequence_bench(clock, folder, monkeypatch):
    files = write_sequence(folder / "sequence", range(1, 12))
    tap, read = Tap(), cv2.imreadmulti

    def read_through_tap(*arguments, **options):
        is_read, pages = read(*arguments, **options)
        try:
            return is_read, [tap(page) for page in pages]
        except LibraryError:
            return False, ()

    monkeypatch.setattr(cv2, "imreadmulti", read_through_tap)
    source = ImageSequenceSource(clock=clock, wait=clock.advance)
    camera = source.camera(source.parse_address(str(files)))
    return Bench(camera, lambda: shutil.rmtree(files), tap)


def micromanager_bench(clock, folder, monkeypatch):
    core = FakeCore()
    (folder / "axiocam.cfg").write_text("Device,HRm,AxioCam,HRm")
    source = MicroManagerSource(clock=clock, wait=clock.advance, core=lambda: core)
    camera = source.camera(source.parse_address(str(folder / "axiocam.cfg")))
    return Bench(camera, lambda: setattr(core, "is_connected", False), core.tap)


def plugin_bench(clock, folder, monkeypatch):
    tap, number, connected = Tap(), cycle(range(1, 250)), [True]

    def library():
        if not connected:
            raise OSError("no such device")
        return tap(np.full((48, 64), next(number), np.uint8))

    source = PluginSource(library, clock=clock, wait=clock.advance)
    return Bench(source.camera(source.devices()[0]), connected.clear, tap)


BENCHES = [
    simulated_bench,
    device_bench,
    film_bench,
    sequence_bench,
    micromanager_bench,
    plugin_bench,
]
