"""Measurement of the turns of the event loop: time on the window's thread, and its calls."""

import threading
import time
from collections import Counter
from dataclasses import dataclass, field

from PySide6.QtCore import QAbstractEventDispatcher, QObject

from rotemina.app.shell.support.event_loop_watch import find_thread_calls

# Period at which the calls of the window's thread are sampled.
SAMPLE_PERIOD_S = 0.005
# Shorter turns are not listed.
MIN_TURN_S = 0.005


@dataclass(frozen=True, slots=True)
class Turn:
    """Cost of one turn of the event loop.

    Attributes
    ----------
    label : str
        The latest step of the operator.
    busy_s : float
        Processor time of the window's thread, s.
    lasted_s : float
        Elapsed time, s; longer than ``busy_s`` if the thread waited.
    calls : tuple of (str, int)
        Stacks of the program's calls, and how often each was sampled; most frequent first.
    """

    label: str
    busy_s: float
    lasted_s: float
    calls: tuple[tuple[str, int], ...] = field(default=())


class LoopMeter(QObject):
    """Measures every turn of the event loop of the thread that creates the meter.

    The dispatcher signals when it starts and when it stops waiting. The time between two such
    signals is one turn, also in nested loops.

    Attributes
    ----------
    turns : list of Turn
        Turns that took longer than `MIN_TURN_S`.
    label : str
        The current step of the operator.
    """

    def __init__(self) -> None:
        super().__init__()
        self.turns: list[Turn] = []
        self.label = ""
        self._thread_id = threading.get_ident()
        self._number = 0
        self._samples: Counter[str] = Counter()
        self._begin_s = time.thread_time(), time.perf_counter()
        self._ended = threading.Event()
        dispatcher = QAbstractEventDispatcher.instance()
        dispatcher.awake.connect(self._end_turn)
        dispatcher.aboutToBlock.connect(self._end_turn)
        threading.Thread(target=self._sample_calls, name="loop meter", daemon=True).start()

    def close(self) -> None:
        """End the measurement; the turns remain available."""
        self._ended.set()
        QAbstractEventDispatcher.instance().disconnect(self)

    def _end_turn(self) -> None:
        now_s = time.thread_time(), time.perf_counter()
        busy_s, lasted_s = now_s[0] - self._begin_s[0], now_s[1] - self._begin_s[1]
        if busy_s > MIN_TURN_S:
            samples = self._samples
            self.turns.append(Turn(self.label, busy_s, lasted_s, tuple(samples.most_common(8))))
        self._number += 1
        self._samples = Counter()
        self._begin_s = time.thread_time(), time.perf_counter()

    def _sample_calls(self) -> None:
        number = -1
        while not self._ended.wait(SAMPLE_PERIOD_S):
            previous_number, number = number, self._number
            if number != previous_number:
                # The turn has just begun.
                continue
            samples = self._samples
            samples[" > ".join(map(str.strip, find_thread_calls(self._thread_id)))] += 1
