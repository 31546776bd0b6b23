"""Every kind of camera in tests, each over a fake of what lies below its driver."""

# ruff: noqa: N802 (the names are those of OpenCV and Micro-Manager)

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from itertools import cycle
from typing import Any

import cv2
import numpy as np

from rotemina.drivers.cameras.camera import Camera, CameraIdentity, Picture
from rotemina.drivers.cameras.micromanager import MicroManager
from rotemina.drivers.cameras.opencv import OpenCvSource
from rotemina.drivers.cameras.sequence import ImageSequences
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings, PixelType
from rotemina.drivers.cameras.simulated import SimulatedMicroscope
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.microscope.renderer import Renderer
from rotemina.sim.robot.file import load_robot

RAW_TEXT = "(-215:Assertion failed) !_src.empty()"


class Fault(StrEnum):
    """What a library does to one picture."""

    FAILS = "fails"  # in the library's own way, such as False
    RAISES = "raises"  # anything at all
    EMPTY = "empty"
    OTHER_SHAPE = "other shape"
    OTHER_TYPE = "other type"


class LibraryError(RuntimeError):
    """A failed read, for libraries that say so by an exception."""


class Tap:
    """What a library's pictures come through: faults, or the same few buffers again and again."""

    def __init__(self):
        self.faults: list[Fault] = []  # of the next pictures
        self.forever: Fault | None = None  # of all that follow
        self.buffers: list[Any] = []
        self.read = 0

    def __call__(self, pixels):
        self.read += 1
        if self.buffers:
            return self.buffers[self.read % len(self.buffers)].copy()
        return self._spoilt(pixels, self.faults.pop(0) if self.faults else self.forever)

    def _spoilt(self, pixels, fault):
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
        """Give noisy pictures like ``pixels`` from now on, from so many buffers."""
        top = 4096 if pixels.dtype == np.uint16 else 256
        rng = np.random.default_rng(seed)
        self.buffers = [
            rng.integers(top // 4, top // 2, pixels.shape).astype(pixels.dtype)
            for _ in range(buffers)
        ]


class FakeCapture:
    """A USB camera as OpenCV shows it; ``there`` False: unplugged."""

    def __init__(self, shape=(48, 64, 3)):
        self.there, self.shape, self.count, self.taken = True, shape, 0, {}
        self.refuses = set()
        self.arguments = None
        self.tap = Tap()

    def __call__(self, *arguments):
        self.arguments = arguments
        return self

    def isOpened(self):
        return self.there

    def getBackendName(self):
        return "V4L2"

    def get(self, which):
        return self.taken.get(which, 1.0)

    def set(self, which, value):
        self.taken[which] = value
        return which not in self.refuses

    def read(self):
        if not self.there:
            return False, None
        self.count += 1
        try:
            return True, self.tap(np.full(self.shape, self.count % 256, np.uint8))
        except LibraryError:
            return False, None

    def release(self):
        pass


class FakeCore:
    """Micro-Manager's core with one camera of 12 bits, which takes a picture at every look."""

    def __init__(self):
        self.there, self.roi, self.sequence, self.buffer = True, (0, 0, 64, 48), False, 0
        self.count, self.exposure_ms, self.properties, self.camera = 0, 10.0, {"Gain": 1.0}, "HRm"
        self.components, self.size, self.loaded = 1, 2, None
        self.tap = Tap()

    def _ask(self):
        if not self.there:
            raise RuntimeError("Device is not responding")

    def loadSystemConfiguration(self, file):
        self._ask()
        self.loaded = file

    def unloadAllDevices(self):
        self.loaded = None

    def getCameraDevice(self):
        return self.camera

    def clearROI(self):
        self._ask()
        assert not self.sequence, "Micro-Manager refuses a region while a sequence runs"
        self.roi = (0, 0, 64, 48)

    def setROI(self, *roi):
        assert not self.sequence
        self.roi = (roi[0] // 4 * 4, *roi[1:])  # columns begin at multiples of 4

    def getROI(self):
        return list(self.roi)

    def getImageWidth(self):
        return self.roi[2]

    def getImageHeight(self):
        return self.roi[3]

    def getNumberOfComponents(self):
        return self.components

    def getBytesPerPixel(self):
        return self.size

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
        self._ask()
        if value == 3.0:
            raise RuntimeError("Gain: invalid value")
        self.properties[name] = value

    def setExposure(self, ms):
        self._ask()
        self.exposure_ms = ms

    def getExposure(self):
        return self.exposure_ms

    def startContinuousSequenceAcquisition(self, interval_ms):
        self._ask()
        self.sequence = True

    def stopSequenceAcquisition(self):
        self._ask()
        self.sequence = False
        self.buffer = 0

    def isSequenceRunning(self):
        return self.sequence and self.there

    def getRemainingImageCount(self):
        self.buffer += self.there and self.sequence
        return self.buffer

    def popNextImage(self):
        assert self.buffer, "nothing is there"
        self.buffer -= 1
        return self.getImage()

    def snapImage(self):
        self._ask()
        assert not self.sequence

    def getImage(self):
        self.count += 1
        return self.tap(np.full((self.roi[3], self.roi[2]), self.count, np.uint16))


class TappedFilm:
    """OpenCV's reader of a real file."""

    def __init__(self, tap, *arguments):
        self._tap, self._stream = tap, cv2.VideoCapture(*arguments)

    def __getattr__(self, name):
        return getattr(self._stream, name)

    def read(self):
        there, pixels = self._stream.read()
        if not there:
            return there, pixels
        try:
            return True, self._tap(pixels)
        except LibraryError:
            return False, None


def write_film(path, count=6, size=(64, 48), rate_hz=25.0):
    """Write grey pictures, each brighter than the one before by 20, as Motion JPEG."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), rate_hz, size)
    for number in range(count):
        writer.write(np.full((size[1], size[0], 3), 20 * number + 20, np.uint8))
    writer.release()
    return path


def write_sequence(folder, numbers, size=(64, 48), dtype=np.uint16, kind="png"):
    """Write pictures 1.png, 2.png, … into a folder, each full of its number."""
    folder.mkdir(exist_ok=True)
    for number in numbers:
        assert cv2.imwrite(str(folder / f"{number}.{kind}"), np.full(size[::-1], number, dtype))
    return folder


class PluginSource(CameraSource):
    """A third party's source, over a library that is but a function."""

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
        return Picture(self._source.library(), 8, self.clock())


@dataclass
class Bench:
    """A camera, how it is unplugged, and what its library's pictures come through."""

    camera: Camera
    unplug: Callable[[], object]
    tap: Tap


def simulated_bench(clock, folder, monkeypatch):
    drivers = [Simulator(load_robot("rotemina"), clock=clock)]
    source = SimulatedMicroscope(lambda: drivers[0], clock=clock, wait=clock.advance)
    tap, draw = Tap(), Renderer.frame
    monkeypatch.setattr(Renderer, "frame", lambda *args, **options: tap(draw(*args, **options)))

    def unplug():
        drivers[0] = Simulator(load_robot("fsm"), clock=clock)

    return Bench(source.camera(source.devices()[0]), unplug, tap)


def device_bench(clock, folder, monkeypatch):
    capture = FakeCapture()
    source = OpenCvSource(
        clock=clock, wait=clock.advance, listed=lambda: {"0": "Cam"}, capture=capture
    )
    camera = source.camera(source.devices()[0])
    return Bench(camera, lambda: setattr(capture, "there", False), capture.tap)


def film_bench(clock, folder, monkeypatch):
    tap = Tap()
    source = OpenCvSource(
        clock=clock, wait=clock.advance, capture=lambda *arguments: TappedFilm(tap, *arguments)
    )
    camera = source.camera(source.addressed(str(write_film(folder / "v.avi"))))

    def unplug():  # a file ends
        camera.configure(CameraSettings(repeat=False))

    return Bench(camera, unplug, tap)


def sequence_bench(clock, folder, monkeypatch):
    files = write_sequence(folder / "sequence", range(1, 12))
    tap, read = Tap(), cv2.imreadmulti

    def tapped(*arguments, **options):
        there, pages = read(*arguments, **options)
        try:
            return there, [tap(page) for page in pages]
        except LibraryError:
            return False, ()

    monkeypatch.setattr(cv2, "imreadmulti", tapped)
    source = ImageSequences(clock=clock, wait=clock.advance)
    camera = source.camera(source.addressed(str(files)))
    return Bench(camera, lambda: shutil.rmtree(files), tap)


def micromanager_bench(clock, folder, monkeypatch):
    core = FakeCore()
    (folder / "axiocam.cfg").write_text("Device,HRm,AxioCam,HRm")
    source = MicroManager(clock=clock, wait=clock.advance, core=lambda: core)
    camera = source.camera(source.addressed(str(folder / "axiocam.cfg")))
    return Bench(camera, lambda: setattr(core, "there", False), core.tap)


def plugin_bench(clock, folder, monkeypatch):
    tap, number, there = Tap(), cycle(range(1, 250)), [True]

    def library():
        if not there:
            raise OSError("no such device")
        return tap(np.full((48, 64), next(number), np.uint8))

    source = PluginSource(library, clock=clock, wait=clock.advance)
    return Bench(source.camera(source.devices()[0]), there.clear, tap)


BENCHES = [
    simulated_bench,
    device_bench,
    film_bench,
    sequence_bench,
    micromanager_bench,
    plugin_bench,
]
