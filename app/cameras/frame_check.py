"""Detection of useless pictures: frozen or black."""

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from rotemina.drivers.cameras.frame import Frame

FROZEN_S = 1.0
_FROZEN_FRAMES = 4
_BLACK_SHARE = 0.03  # of the largest number: above a camera's black level, below any picture
_NOT_BLACK = 0.001  # of the pixels, at most, that may be brighter
_STRIDE = 8  # rows and columns between the pixels that are looked at
_ROWS = 4


class PictureState(StrEnum):
    """The verdict on the pictures."""

    LIVE = "live"
    FROZEN = "frozen"
    BLACK = "black"


class FrameCheck:
    """Checks every picture; a real camera's noise never repeats one."""

    def __init__(self) -> None:
        self._rows: NDArray[np.generic] | None = None
        self._same = 0
        self._since_s = 0.0

    def judge(self, frame: Frame) -> PictureState:
        """Return what the pictures up to this one show."""
        # Whole rows: an image that is still alive differs somewhere in a quarter of its pixels.
        rows = np.ascontiguousarray(frame.pixels[::_ROWS])
        if self._rows is not None and np.array_equal(rows, self._rows):
            self._same += 1
        else:
            self._rows, self._same, self._since_s = rows, 0, frame.host_time_s
        if _black(frame):
            return PictureState.BLACK
        lasts_s = frame.host_time_s - self._since_s
        if self._same >= _FROZEN_FRAMES and lasts_s >= FROZEN_S:
            return PictureState.FROZEN
        return PictureState.LIVE


def _black(frame: Frame) -> bool:
    some = frame.pixels[::_STRIDE, ::_STRIDE]
    brighter = np.count_nonzero(some >= _BLACK_SHARE * frame.largest)
    return bool(brighter <= _NOT_BLACK * some.size)
