"""Batches of samples: samples are read in every cycle, but processed at the display rate."""

from rotemina.drivers.contract import DeviceSamples

# Period at which batches are processed, one frame at 60 Hz.
_BATCH_PERIOD_S = 0.016
# Longest time that a batch waits for a cycle in which no samples were read.
_MAX_BATCH_PERIOD_S = 0.019


class SampleBatches:
    """Collects a device's samples until they are due for processing."""

    def __init__(self) -> None:
        #: Host time, s, at which the latest samples were read.
        self.received_s = float("-inf")
        self._unprocessed: list[DeviceSamples] = []
        self._latest_processing_s = float("-inf")
        self._batch_age_s = float("inf")
        self._has_new_samples = False

    def restart(self) -> None:
        """Discard unprocessed samples. The next batch is due at once."""
        self._unprocessed.clear()
        self._latest_processing_s = float("-inf")

    def add(self, samples: DeviceSamples, now_s: float) -> None:
        """Add the samples of one cycle, possibly none."""
        self._batch_age_s, self._has_new_samples = (
            now_s - self._latest_processing_s,
            len(samples) > 0,
        )
        if self._has_new_samples:
            self._unprocessed.append(samples)
            self.received_s = now_s

    @property
    def is_idle(self) -> bool:
        """Whether the cycle has read no samples, and no batch is due."""
        return not self._has_new_samples and self._batch_age_s < _BATCH_PERIOD_S

    def is_due(self, *, urgent: bool) -> bool:
        """Return whether to process the batch now; an ``urgent`` batch does not wait.

        A cycle that has just read samples leaves the processing to the next cycle, which has more
        time for it.
        """
        return urgent or self._batch_age_s >= (
            _MAX_BATCH_PERIOD_S if self._has_new_samples else _BATCH_PERIOD_S
        )

    def take(self, now_s: float, axes: int) -> DeviceSamples:
        """Return the batch, and begin the next one. ``axes`` is the number of axes."""
        self._latest_processing_s = now_s
        batch, self._unprocessed = self._unprocessed, []
        return DeviceSamples.join(batch, axes)
