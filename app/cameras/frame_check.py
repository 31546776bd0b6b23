"""Detection of useless pictures: frozen or black."""

from collections import deque
from enum import StrEnum

import numpy as np

from rotemina.drivers.cameras.frame import Frame

FROZEN_S = 1.0
_FROZEN_FRAMES = 4
_BLACK_SHARE = 0.03  # of the largest number: above a camera's black level, below any picture
_SHARE_OF_FEW = 0.001  # of the pixels: no more than this may be otherwise
_STRIDE = 8  # rows and columns between the pixels that are looked at
_ROWS = 4
_REMEMBERED = 64  # pictures: more than the buffers through which any driver cycles


class PictureState(StrEnum):
    """The verdict on the pictures."""

    LIVE = "live"
    FROZEN = "frozen"
    BLACK = "black"


class FrameCheck:
    """Checks every picture of a camera.

    The noise of a sensor never gives a picture twice. A picture that is equal to an earlier one is
    therefore not new: it comes from a buffer that is no longer filled. It does not matter how many
    such buffers the driver cycles through. Equal pictures prove nothing where there is no noise:
    in pictures that are drawn or come from files (:attr:`Frame.noise_free`), and where every pixel
    is at an end of its range.
    """

    def __init__(self) -> None:
        self._known: deque[int] = deque(maxlen=_REMEMBERED)
        self._repeated = 0
        self._since_s = 0.0

    @property
    def is_repeated(self) -> bool:
        """Whether the latest picture is an earlier one, and not new."""
        return self._repeated > 0

    def judge(self, frame: Frame) -> PictureState:
        """Return what the pictures up to this one show."""
        # Whole rows: an image that is still alive differs somewhere in a quarter of its pixels.
        picture = hash((frame.pixels.shape, frame.pixels[::_ROWS].tobytes()))
        if picture in self._known and _has_noise(frame):
            self._repeated += 1
        else:
            self._known.append(picture)
            self._repeated, self._since_s = 0, frame.host_time_s
        if _is_black(frame):
            return PictureState.BLACK
        lasts_s = frame.host_time_s - self._since_s
        if self._repeated >= _FROZEN_FRAMES and lasts_s >= FROZEN_S:
            return PictureState.FROZEN
        return PictureState.LIVE


def _has_noise(frame: Frame) -> bool:
    if frame.noise_free:
        return False
    some = frame.pixels[::_STRIDE, ::_STRIDE]
    free = np.count_nonzero((some > 0) & (some < frame.largest))
    return bool(free > _SHARE_OF_FEW * some.size)


def _is_black(frame: Frame) -> bool:
    some = frame.pixels[::_STRIDE, ::_STRIDE]
    brighter = np.count_nonzero(some >= _BLACK_SHARE * frame.largest)
    return bool(brighter <= _SHARE_OF_FEW * some.size)
