"""Queue of entries to be written; any thread adds entries, and the writer takes them."""

import threading
from dataclasses import dataclass

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import FloatArray

# Approximate memory of an event or of a channel's row.
_ENTRY_BYTES = 400


@dataclass(frozen=True, slots=True, eq=False)
class SampleBlock:
    """Samples of one connection, their host times (n,) and the model outputs (n, axes)."""

    connection: int
    host_time_s: FloatArray
    samples: DeviceSamples
    model: FloatArray

    @property
    def size(self) -> int:
        """Memory of the samples, bytes."""
        return 8 * (3 * len(self.samples) + 4 * self.model.size)


@dataclass(frozen=True, slots=True)
class RecordedEvent:
    """An event at a host time.

    Attributes
    ----------
    kind : str
        ``connection``, ``state``, ``fault``, ``refused``, ``stop``, ``playback_begin``,
        ``playback_end``, ``action``, ``note``, ``log`` or ``recorder``.
    text : str
        Message for display.
    details : str
        JSON object for evaluation by programs.
    """

    host_time_s: float
    kind: str
    text: str
    details: str = "{}"


@dataclass(frozen=True, slots=True)
class ChannelRow:
    """Named values of one channel at a host time."""

    channel: str
    host_time_s: float
    values: dict[str, float]


BacklogEntry = SampleBlock | RecordedEvent | ChannelRow


@dataclass(frozen=True, slots=True)
class BacklogLoss:
    """Numbers of samples and other entries lost for lack of room, and host time of the first."""

    samples: int = 0
    others: int = 0
    since_s: float = float(np.inf)


class RecordingBacklog:
    """Bounded queue that never blocks; entries that find no room are lost and counted."""

    def __init__(self, capacity_bytes: int) -> None:
        self._capacity_bytes = capacity_bytes
        self._entries: list[BacklogEntry] = []
        self._size_bytes = 0
        self._loss = BacklogLoss()
        self._lock = threading.Lock()

    def add(self, entry: BacklogEntry) -> None:
        """Queue an entry, or count it as lost."""
        size = entry.size if isinstance(entry, SampleBlock) else _ENTRY_BYTES
        with self._lock:
            if self._size_bytes + size > self._capacity_bytes:
                self._loss = _add_loss(self._loss, entry)
                return
            self._entries.append(entry)
            self._size_bytes += size

    def take_entries(self) -> list[BacklogEntry]:
        """Return all waiting entries, oldest first, and free their room."""
        with self._lock:
            entries, self._entries, self._size_bytes = self._entries, [], 0
        return entries

    def take_lost(self) -> BacklogLoss:
        """Return the losses since the last call."""
        with self._lock:
            loss, self._loss = self._loss, BacklogLoss()
        return loss


def _add_loss(loss: BacklogLoss, entry: BacklogEntry) -> BacklogLoss:
    if not isinstance(entry, SampleBlock):
        return BacklogLoss(loss.samples, loss.others + 1, min(loss.since_s, entry.host_time_s))
    since_s = min(loss.since_s, float(entry.host_time_s[0]))
    return BacklogLoss(loss.samples + len(entry.samples), loss.others, since_s)
