"""Failed reads of a camera: each is a lost picture, and only a row of them loses the camera."""

import logging

from rotemina.drivers.cameras.errors import CameraLostError
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed

_LOG = logging.getLogger(__name__)

MAX_FAILING_S = 1.0
RETRY_S = 0.01  # between a failed read and the next one
_ROUNDING_S = 1e-9


class FailedReads:
    """Counts the failed reads of one opening of a camera.

    Parameters
    ----------
    name : str
        Of the camera.
    clock : callable
        The host's time, s.
    """

    def __init__(self, name: str, clock: Clock) -> None:
        self._name, self._clock = name, clock
        #: Since the camera was opened.
        self.count = 0
        self._in_a_row = 0
        self._since_s = 0.0
        self._logged: set[type[Exception]] = set()

    def end_row(self) -> None:
        """Note that a read has succeeded."""
        self._in_a_row = 0

    def add(self, error: Exception, began_s: float) -> None:
        """Count a read that began at ``began_s`` and failed.

        Raises
        ------
        CameraLostError
            If nothing but failures came for :data:`MAX_FAILING_S`. One failure alone is never
            enough, however long its read took: it may have been a time-out.
        """
        self.count += 1
        if not self._in_a_row:
            self._since_s = began_s
        self._in_a_row += 1
        self._log(error)
        lasts_s = self._clock() - self._since_s
        if self._in_a_row < 2 or lasts_s < MAX_FAILING_S - _ROUNDING_S:
            return
        if isinstance(error, DriverError):
            raise CameraLostError(*error.args) from error
        raise CameraLostError(
            message(
                "engine",
                "{name}: no picture could be read for {seconds} s; the log has the cause. Check "
                "the camera and its cable, and open it again",
            ).fill(name=self._name, seconds=fixed(lasts_s, 1))
        ) from error

    def _log(self, error: Exception) -> None:
        """Log the first failure of each kind: a camera may fail thirty times a second."""
        if type(error) in self._logged:
            return
        self._logged.add(type(error))
        cause = error.__cause__ if isinstance(error, DriverError) else error
        if cause is None:
            _LOG.info("%s: a picture could not be read: %s", self._name, error)
        else:
            _LOG.warning("%s: a picture could not be read", self._name, exc_info=cause)
