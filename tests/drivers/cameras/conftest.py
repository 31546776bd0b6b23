"""What lies below the cameras in tests: fakes of OpenCV's capture and Micro-Manager's core."""

# ruff: noqa: N802 (the names are those of OpenCV and Micro-Manager)

import cv2
import numpy as np
import pytest


class FakeCapture:
    """A USB camera as OpenCV shows it; ``there`` False: unplugged."""

    def __init__(self, shape=(48, 64, 3)):
        self.there, self.shape, self.count, self.taken = True, shape, 0, {}
        self.refuses = set()
        self.arguments = None

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
        return True, np.full(self.shape, self.count, np.uint8)

    def release(self):
        pass


class FakeCore:
    """Micro-Manager's core with one camera of 12 bits, which takes a picture at every look."""

    def __init__(self):
        self.there, self.roi, self.sequence, self.buffer = True, (0, 0, 64, 48), False, 0
        self.count, self.exposure_ms, self.properties, self.camera = 0, 10.0, {"Gain": 1.0}, "HRm"
        self.components, self.size, self.loaded = 1, 2, None

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
        return np.full((self.roi[3], self.roi[2]), self.count, np.uint16)


@pytest.fixture
def capture():
    return FakeCapture()


@pytest.fixture
def core():
    return FakeCore()


@pytest.fixture
def write_film():
    """Write grey pictures, each brighter than the one before by 20, as Motion JPEG."""

    def write(path, count=6, size=(64, 48), rate_hz=25.0):
        writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), rate_hz, size)
        for number in range(count):
            writer.write(np.full((size[1], size[0], 3), 20 * number + 20, np.uint8))
        writer.release()
        return path

    return write


@pytest.fixture
def write_sequence(tmp_path):
    """Write pictures 1.png, 2.png, … into a folder, each full of its number."""

    def write(numbers, size=(64, 48), dtype=np.uint16, kind="png"):
        folder = tmp_path / "sequence"
        folder.mkdir(exist_ok=True)
        for number in numbers:
            picture = np.full(size[::-1], number, dtype)
            assert cv2.imwrite(str(folder / f"{number}.{kind}"), picture)
        return folder

    return write
