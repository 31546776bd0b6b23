"""Failed reads of a camera: each counts as a lost picture, and a long streak as a lost camera."""

import logging

from rotemina.drivers.contract import CameraLostError, Clock, DriverError
from rotemina.sim.messages import format_fixed

_LOG = logging.getLogger(__name__)

MAX_FAILING_S = 1.0
RETRY_DELAY_S = 0.01
_ROUNDING_S = 1e-9


class FailedReadCounter:
    """Counts the failed reads since a camera was opened.

    Parameters
    ----------
    name : str
        Name of the camera.
    clock : callable
        Returns the host's time, s.
    """

    def __init__(self, name: str, clock: Clock) -> None:
        self._name, self._clock = name, clock
        #: Number of failed reads since the camera was opened.
        self.count = 0
        self._streak_count = 0
        self._streak_start_s = 0.0
        self._logged_types: set[type[Exception]] = set()

    def end_streak(self) -> None:
        """End the streak of failures, because a read has succeeded."""
        self._streak_count = 0

    def add(self, error: Exception, began_s: float) -> None:
        """Count a failed read that began at host time ``began_s``.

        Raises
        ------
        CameraLostError
            If all reads have failed for :data:`MAX_FAILING_S`. A single failure is not enough, even
            if the read took that long, because it may have been a time-out.
        """
        self.count += 1
        if not self._streak_count:
            self._streak_start_s = began_s
        self._streak_count += 1
        self._log(error)
        duration_s = self._clock() - self._streak_start_s
        if self._streak_count < 2 or duration_s < MAX_FAILING_S - _ROUNDING_S:
            return
        if isinstance(error, DriverError):
            raise CameraLostError(*error.args) from error
        raise CameraLostError(
            "{name}: no picture could be read for {seconds} s; see the log for the cause. "
            "Check the camera and its cable, and open it again",
            name=self._name,
            seconds=format_fixed(duration_s, 1),
        ) from error

    def _log(self, error: Exception) -> None:
        """Log only the first failure of each type, because a camera may fail at its frame rate."""
        if type(error) in self._logged_types:
            return
        self._logged_types.add(type(error))
        cause = error.__cause__ if isinstance(error, DriverError) else error
        if cause is None:
            _LOG.info("%s: a picture could not be read: %s", self._name, error)
        else:
            _LOG.warning("%s: a picture could not be read", self._name, exc_info=cause)
