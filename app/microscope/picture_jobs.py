"""Slow evaluations of pictures: the outline of a cell, the drift of the background."""

import threading
from collections.abc import Callable

import numpy as np

from rotemina.app.microscope.status import DriftSeen
from rotemina.drivers.cameras.frame import Frame
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.vision.background_drift import background_drift
from rotemina.sim.vision.cell import CellOutline, find_cell
from rotemina.sim.vision.image import Image, grey

DRIFT_S = 2.0
_RADII_M = (5e-6, 40e-6)  # between which a cell's membrane is from its inside
_RADII_PX = (15.0, 120.0)  # without a scale
_LEAST_PX = 4.0


class PictureJobs:
    """Jobs executed in turn by the stepping thread, requested from any.

    Parameters
    ----------
    newest : callable
        Return the newest picture, or None.
    """

    def __init__(self, newest: Callable[[], Frame | None]) -> None:
        self._newest = newest
        self._lock = threading.Lock()  # guards what is asked for
        self._wanted: tuple[FloatArray, tuple[float, float]] | None = None
        self._watching = False
        self._reference: Image | None = None
        self._drift_s = 0.0
        self.cell: CellOutline | None = None
        #: Why no cell was found.
        self.reason = ""
        self.drift = DriftSeen()

    def outline(self, near: FloatArray, pixel_m: float | None) -> None:
        """Look for a cell about ``near`` (2,), px."""
        low, high = _RADII_PX
        if pixel_m is not None:
            low, high = (radius / pixel_m for radius in _RADII_M)
        with self._lock:
            self._wanted = near, (max(low, _LEAST_PX), max(high, 2.0 * _LEAST_PX))

    def forget(self) -> None:
        """Remove the outline of the cell."""
        with self._lock:
            self._wanted = None
        self.cell, self.reason = None, ""

    def watch_drift(self, on: bool) -> None:
        """Turn the monitoring of background drift on or off."""
        with self._lock:
            self._watching, self._reference = on, None
        self.drift = DriftSeen(watched=on)

    def step(self, now_s: float) -> None:
        """Execute the requested job."""
        with self._lock:
            wanted, self._wanted = self._wanted, None
            watching = self._watching
        frame = self._newest()
        if frame is None:
            return
        if wanted is not None:
            self._outline(frame, *wanted)
        if watching and now_s - self._drift_s >= DRIFT_S:
            self._drift_s = now_s
            self._look_for_drift(frame)

    def _outline(self, frame: Frame, near: FloatArray, radii: tuple[float, float]) -> None:
        try:
            half = np.ceil(2.0 * radii[1])
            low = np.maximum(np.rint(near - half), 0).astype(int)
            high = np.minimum(np.rint(near + half).astype(int), frame.pixels.shape[1::-1])
            part = grey(frame.pixels[low[1] : high[1], low[0] : high[0]])
            found = find_cell(part, near - low, radii)
        except InputError as error:
            self.cell, self.reason = None, str(error)
            return
        figures = found.figures.copy()
        figures[:2] += low
        self.cell = CellOutline(figures, found.covariance, found.path + low, found.darker)
        self.reason = ""

    def _look_for_drift(self, frame: Frame) -> None:
        reference, seen = self._reference, DriftSeen(watched=True)
        try:
            image = grey(frame.pixels)
            if reference is None:
                reference = image
            else:
                seen = DriftSeen(watched=True, drift=background_drift(reference, image))
        except InputError as error:
            seen = DriftSeen(watched=True, reason=str(error))
        with self._lock:
            if self._watching:
                self._reference, self.drift = reference, seen
