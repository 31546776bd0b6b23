"""The queue of entries to be written, filled by any thread and emptied by the writer."""

import threading
from dataclasses import dataclass

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray

_ROW_BYTES = 400  # what an event or a row of a channel takes, about


@dataclass(frozen=True, slots=True, eq=False)
class Block:
    """Samples of one connection with their host times (n,) and the model's answers (n, axes)."""

    connection: int
    host_time_s: FloatArray
    samples: Samples
    model: FloatArray

    @property
    def size(self) -> int:
        """Bytes that it takes."""
        return 8 * (3 * len(self.samples) + 4 * self.model.size)


@dataclass(frozen=True, slots=True)
class RecordedEvent:
    """Something that happened at a host time.

    Attributes
    ----------
    kind : str
        ``connection``, ``state``, ``fault``, ``refused``, ``stop``, ``playback_begin``,
        ``playback_end``, ``action``, ``note``, ``log`` or ``recorder``.
    text : str
        For people.
    details : str
        For programs: a JSON object.
    """

    host_time_s: float
    kind: str
    text: str
    details: str = "{}"


@dataclass(frozen=True, slots=True)
class Row:
    """Named values of one channel at a host time."""

    channel: str
    host_time_s: float
    values: dict[str, float]


Entry = Block | RecordedEvent | Row


@dataclass(frozen=True, slots=True)
class Lost:
    """What found no room: samples, other entries, and since which host time."""

    samples: int = 0
    others: int = 0
    since_s: float = float(np.inf)


class Backlog:
    """A bounded queue that never blocks; it counts items without room."""

    def __init__(self, capacity_bytes: int) -> None:
        self._capacity = capacity_bytes
        self._entries: list[Entry] = []
        self._size = 0
        self._lost = Lost()
        self._lock = threading.Lock()

    def add(self, entry: Entry) -> None:
        """Queue an entry, or count it as lost."""
        size = entry.size if isinstance(entry, Block) else _ROW_BYTES
        with self._lock:
            if self._size + size > self._capacity:
                self._lost = _more(self._lost, entry)
                return
            self._entries.append(entry)
            self._size += size

    def take(self) -> list[Entry]:
        """Return everything that waits, oldest first; the room is free again."""
        with self._lock:
            entries, self._entries, self._size = self._entries, [], 0
        return entries

    def take_lost(self) -> Lost:
        """Return the losses since the last call."""
        with self._lock:
            lost, self._lost = self._lost, Lost()
        return lost


def _more(lost: Lost, entry: Entry) -> Lost:
    if not isinstance(entry, Block):
        return Lost(lost.samples, lost.others + 1, min(lost.since_s, entry.host_time_s))
    since_s = min(lost.since_s, float(entry.host_time_s[0]))
    return Lost(lost.samples + len(entry.samples), lost.others, since_s)
