"""Detection of frozen and black pictures."""

from collections import deque
from enum import StrEnum

import numpy as np

from rotemina.drivers.cameras import CameraFrame

# A camera counts as frozen once it has only repeated pictures for this long and this often.
MIN_FROZEN_S = 1.0
_MIN_FROZEN_COUNT = 4
# Fraction of the largest pixel value: above the black level of a camera, below any real picture.
_BLACK_LEVEL_RATIO = 0.03
# A condition on all pixels counts as met if at most this fraction of them violates it.
_MAX_OUTLIER_RATIO = 0.001
# Brightness and noise are checked in one of this many rows and columns.
_PIXEL_STRIDE = 8
# Pictures are compared in one of this many rows.
_ROW_STRIDE = 4
# Must exceed the number of buffers through which a driver cycles.
_REMEMBERED_FRAME_COUNT = 64


class PictureState(StrEnum):
    """Verdict on the latest pictures of a camera."""

    LIVE = "live"
    FROZEN = "frozen"
    BLACK = "black"


class FrameCheck:
    """Checks every picture of a camera.

    Because of the sensor's noise, a camera never produces the same picture twice. A picture that
    equals an earlier one is therefore not new: it comes from a buffer that is no longer filled. The
    driver may cycle through many such buffers. Equal pictures prove nothing if they have no noise:
    if they were computed or come from files (:attr:`CameraFrame.noise_free`), or if every pixel is
    at an end of its range.
    """

    def __init__(self) -> None:
        self._earlier_hashes: deque[int] = deque(maxlen=_REMEMBERED_FRAME_COUNT)
        self._repeat_count = 0
        self._last_new_s = 0.0

    @property
    def is_repeated(self) -> bool:
        """Whether the latest picture repeats an earlier one, and so is not new."""
        return self._repeat_count > 0

    def classify(self, frame: CameraFrame) -> PictureState:
        """Return the verdict on the pictures up to this one."""
        # A quarter of the rows is enough, because noise changes every part of a live picture.
        digest = hash((frame.pixels.shape, frame.pixels[::_ROW_STRIDE].tobytes()))
        if digest in self._earlier_hashes and _has_noise(frame):
            self._repeat_count += 1
        else:
            self._earlier_hashes.append(digest)
            self._repeat_count, self._last_new_s = 0, frame.host_time_s
        if _is_black(frame):
            return PictureState.BLACK
        repeated_s = frame.host_time_s - self._last_new_s
        if self._repeat_count >= _MIN_FROZEN_COUNT and repeated_s >= MIN_FROZEN_S:
            return PictureState.FROZEN
        return PictureState.LIVE


def _has_noise(frame: CameraFrame) -> bool:
    if frame.noise_free:
        return False
    pixels = frame.pixels[::_PIXEL_STRIDE, ::_PIXEL_STRIDE]
    unclipped_pixel_count = np.count_nonzero((pixels > 0) & (pixels < frame.saturation_value))
    return bool(unclipped_pixel_count > _MAX_OUTLIER_RATIO * pixels.size)


def _is_black(frame: CameraFrame) -> bool:
    pixels = frame.pixels[::_PIXEL_STRIDE, ::_PIXEL_STRIDE]
    bright_pixel_count = np.count_nonzero(pixels >= _BLACK_LEVEL_RATIO * frame.saturation_value)
    return bool(bright_pixel_count <= _MAX_OUTLIER_RATIO * pixels.size)
