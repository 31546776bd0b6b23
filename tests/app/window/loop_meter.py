"""Measures what each turn of the event loop costs the window's thread, and what it was doing."""

import threading
import time
from collections import Counter
from dataclasses import dataclass, field

from PySide6.QtCore import QAbstractEventDispatcher, QObject

from rotemina.app.shell.event_loop_watch import thread_calls

LOOKS_S = 0.005  # between two looks at the window's thread
KEPT_S = 0.005  # a turn that takes less is not listed


@dataclass(frozen=True, slots=True)
class Turn:
    """What one turn of the event loop cost.

    Attributes
    ----------
    label : what the operator had done before
    busy_s : processor time of the window's thread, s
    lasted_s : s; longer where the thread had to wait for the processor, or for another thread
    calls : stacks of the program's own calls with how often each was seen, the most frequent first
    """

    label: str
    busy_s: float
    lasted_s: float
    calls: tuple[tuple[str, int], ...] = field(default=())


class LoopMeter(QObject):
    """Measures every turn of the loop of the thread that makes it.

    The dispatcher says when it begins to wait and when it goes on; what lies between two such
    signals is one turn, in nested loops as well.

    Attributes
    ----------
    turns : list of Turn
        Those that cost more than `KEPT_S`.
    label : str
        What the operator does now.
    """

    def __init__(self) -> None:
        super().__init__()
        self.turns: list[Turn] = []
        self.label = ""
        self._watched = threading.get_ident()
        self._number = 0
        self._seen: Counter[str] = Counter()
        self._begin_s = time.thread_time(), time.perf_counter()
        self._ended = threading.Event()
        dispatcher = QAbstractEventDispatcher.instance()
        dispatcher.awake.connect(self._turn)
        dispatcher.aboutToBlock.connect(self._turn)
        threading.Thread(target=self._look_on, name="loop meter", daemon=True).start()

    def close(self) -> None:
        """End; what is measured stays."""
        self._ended.set()
        QAbstractEventDispatcher.instance().disconnect(self)

    def _turn(self) -> None:
        now_s = time.thread_time(), time.perf_counter()
        busy_s, lasted_s = now_s[0] - self._begin_s[0], now_s[1] - self._begin_s[1]
        if busy_s > KEPT_S:
            seen = self._seen
            self.turns.append(Turn(self.label, busy_s, lasted_s, tuple(seen.most_common(8))))
        self._number += 1
        self._seen = Counter()
        self._begin_s = time.thread_time(), time.perf_counter()

    def _look_on(self) -> None:
        number = -1
        while not self._ended.wait(LOOKS_S):
            before, number = number, self._number
            if number != before:
                continue  # it has just begun
            seen = self._seen
            seen[" > ".join(map(str.strip, thread_calls(self._watched)))] += 1
