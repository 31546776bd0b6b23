"""Slow evaluations of pictures: the outline of a cell, and the drift of the background."""

import threading
from collections.abc import Callable

import numpy as np

from rotemina.app.microscope.status import DriftStatus
from rotemina.drivers.cameras import CameraFrame
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.vision import CellOutline, Image, find_cell, measure_background_drift, to_grey

DRIFT_PERIOD_S = 2.0
# Smallest and largest distance of a cell's membrane from the clicked point.
_CELL_RADII_M = (5e-6, 40e-6)
# The same limits if the pixel size is unknown.
_DEFAULT_CELL_RADII_PX = (15.0, 120.0)
_MIN_CELL_RADIUS_PX = 4.0


class PictureJobs:
    """Executes slow picture jobs. Any thread may request them; :meth:`step` executes them.

    Parameters
    ----------
    newest_frame : callable
        Returns the newest picture, or None.
    """

    def __init__(self, newest_frame: Callable[[], CameraFrame | None]) -> None:
        self._newest_frame = newest_frame
        # Guards the requests.
        self._lock = threading.Lock()
        self._outline_request: tuple[FloatArray, tuple[float, float]] | None = None
        self._is_watching_drift = False
        self._drift_reference: Image | None = None
        self._last_drift_s = 0.0
        self.cell_outline: CellOutline | None = None
        #: Why no cell was found; empty if one was.
        self.outline_reason = ""
        self.drift = DriftStatus()

    def request_outline(self, near: FloatArray, pixel_m: float | None) -> None:
        """Request the outline of the cell around ``near`` (2,), px."""
        low, high = _DEFAULT_CELL_RADII_PX
        if pixel_m is not None:
            low, high = (radius / pixel_m for radius in _CELL_RADII_M)
        with self._lock:
            self._outline_request = (
                near,
                (max(low, _MIN_CELL_RADIUS_PX), max(high, 2.0 * _MIN_CELL_RADIUS_PX)),
            )

    def clear_outline(self) -> None:
        """Remove the outline of the cell."""
        with self._lock:
            self._outline_request = None
        self.cell_outline, self.outline_reason = None, ""

    def watch_drift(self, on: bool) -> None:
        """Turn the monitoring of background drift on or off."""
        with self._lock:
            self._is_watching_drift, self._drift_reference = on, None
        self.drift = DriftStatus(is_watched=on)

    def step(self, now_s: float) -> None:
        """Find the requested outline, and measure the drift when due."""
        with self._lock:
            outline_request, self._outline_request = self._outline_request, None
            is_watching = self._is_watching_drift
        frame = self._newest_frame()
        if frame is None:
            return
        if outline_request is not None:
            self._find_outline(frame, *outline_request)
        if is_watching and now_s - self._last_drift_s >= DRIFT_PERIOD_S:
            self._last_drift_s = now_s
            self._measure_drift(frame)

    def _find_outline(
        self, frame: CameraFrame, near: FloatArray, radii: tuple[float, float]
    ) -> None:
        try:
            half_width = np.ceil(2.0 * radii[1])
            low = np.maximum(np.rint(near - half_width), 0).astype(int)
            high = np.minimum(np.rint(near + half_width).astype(int), frame.pixels.shape[1::-1])
            window_image = to_grey(frame.pixels[low[1] : high[1], low[0] : high[0]])
            outline = find_cell(window_image, near - low, radii)
        except InputError as error:
            self.cell_outline, self.outline_reason = None, str(error)
            return
        parameters = outline.parameters.copy()
        parameters[:2] += low
        self.cell_outline = CellOutline(
            parameters, outline.covariance, outline.path + low, outline.absorption
        )
        self.outline_reason = ""

    def _measure_drift(self, frame: CameraFrame) -> None:
        reference, status = self._drift_reference, DriftStatus(is_watched=True)
        try:
            image = to_grey(frame.pixels)
            if reference is None:
                reference = image
            else:
                status = DriftStatus(
                    is_watched=True, drift=measure_background_drift(reference, image)
                )
        except InputError as error:
            status = DriftStatus(is_watched=True, reason=str(error))
        with self._lock:
            if self._is_watching_drift:
                self._drift_reference, self.drift = reference, status
