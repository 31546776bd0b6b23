"""A watchdog for the window's event loop: its delays, and the calls that made it stall."""

import faulthandler
import logging
import re
import sys
import tempfile
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

from PySide6.QtCore import QObject, Qt, QTimer

from rotemina.app.shell.support.reaction_times import LatenessHistogram, LatenessSummary

logger = logging.getLogger(__name__)

BEAT_PERIOD_S = 0.02
MIN_STALL_S = 0.25
# If a beat is overdue by this much, the calls of the window's thread are sampled.
_MIN_OVERDUE_S = 0.1
_CHECK_PERIOD_S = 0.05
# A slow computer with constant stalls must not fill the log.
_MIN_LOG_INTERVAL_S = 60.0
_MAX_STALLS = 100
_MAX_CALLS = 12
_THREAD_LINE = re.compile(r"(?:Current t|T)hread 0x([0-9a-f]+) ")
_CALL_LINE = re.compile(r'  File "(.*)", line (\d+) in (.*)')
_UNKNOWN_CALLS = "cause unknown: no thread could run the interpreter"


@dataclass(frozen=True, slots=True)
class EventLoopStall:
    """A period in which the window did not react.

    Attributes
    ----------
    duration_s : float
    cpu_time_s : float
        Processor time of the window's thread during the stall. If it is much shorter than the
        stall, the thread was waiting: for a processor, for the interpreter, or for a file.
    calls : tuple of str
        Call stack of the thread, outermost call first.
    """

    duration_s: float
    cpu_time_s: float
    calls: tuple[str, ...]


class EventLoopWatch(QObject):
    """Measurement of how late events reach the window's thread.

    A timer beats on that thread. A second thread notices an overdue beat and samples which calls
    the window's thread is in. A stall is logged with these calls, at most once a minute.

    Attributes
    ----------
    stalls : deque of EventLoopStall
        The latest stalls.
    """

    def __init__(
        self,
        parent: QObject | None = None,
        clock: Callable[[], float] = time.monotonic,
        cpu_time: Callable[[], float] = time.thread_time,
    ) -> None:
        super().__init__(parent)
        self._clock, self._cpu_time = clock, cpu_time
        self._histogram = LatenessHistogram(BEAT_PERIOD_S)
        self.stalls: deque[EventLoopStall] = deque(maxlen=_MAX_STALLS)
        self._last_beat_s, self._last_cpu_time_s = clock(), cpu_time()
        self._last_log_s = float("-inf")
        # Durations of the stalls since the last log entry.
        self._unlogged_durations_s: list[float] = []
        # Time of the last beat before an overdue one, and the calls sampled while it was overdue.
        # Written by the watching thread.
        self._overdue_calls: tuple[float, tuple[str, ...]] = (0.0, ())
        self._watched_thread_id = threading.get_ident()
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None
        self._timer = QTimer(self, interval=round(1e3 * BEAT_PERIOD_S))
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self.beat)

    def start(self) -> None:
        """Start watching the thread that calls this."""
        if self._thread is None:
            self._watched_thread_id = threading.get_ident()
            self._last_beat_s, self._last_cpu_time_s = self._clock(), self._cpu_time()
            self._timer.start()
            self._thread = threading.Thread(
                target=self._watch_thread, name="loop watch", daemon=True
            )
            self._thread.start()

    def restart(self) -> None:
        """Forget all measurements, such as those of the start-up."""
        self._histogram = LatenessHistogram(BEAT_PERIOD_S)
        self.stalls.clear()

    def close(self) -> None:
        """Stop watching; safe to call twice."""
        self._timer.stop()
        self._closing.set()
        thread, self._thread = self._thread, None
        if thread is not None:
            thread.join(1.0)

    @property
    def lateness(self) -> LatenessSummary:
        """The delays measured since the last restart."""
        return self._histogram.summarise()

    def beat(self) -> None:
        """Record that the window's thread is handling events."""
        now_s = self._clock()
        previous_beat_s, self._last_beat_s = self._last_beat_s, now_s
        cpu_time_s = self._cpu_time()
        previous_cpu_time_s, self._last_cpu_time_s = self._last_cpu_time_s, cpu_time_s
        self._histogram.add(now_s - previous_beat_s)
        delay_s = now_s - previous_beat_s - BEAT_PERIOD_S
        if delay_s > MIN_STALL_S:
            sampled_beat_s, calls = self._overdue_calls
            was_sampled = sampled_beat_s == previous_beat_s and bool(calls)
            stall = EventLoopStall(
                delay_s,
                cpu_time_s - previous_cpu_time_s,
                calls if was_sampled else (_UNKNOWN_CALLS,),
            )
            self.stalls.append(stall)
            if now_s - self._last_log_s < _MIN_LOG_INTERVAL_S:
                self._unlogged_durations_s.append(stall.duration_s)
            else:
                self._log_stall(stall)
                self._last_log_s, self._unlogged_durations_s = now_s, []

    def _log_stall(self, stall: EventLoopStall) -> None:
        unlogged_text = ""
        if self._unlogged_durations_s:
            max_duration_s = max(self._unlogged_durations_s)
            unlogged_text = (
                f" (and {len(self._unlogged_durations_s)} stalls since the last report,"
                f" up to {max_duration_s:.2f} s)"
            )
        calls = "\n".join(stall.calls)
        logger.warning(
            "the window did not react for %.2f s%s and used %.2f s of processor time; calls:\n%s",
            stall.duration_s,
            unlogged_text,
            stall.cpu_time_s,
            calls,
        )

    def sample_overdue_thread(self) -> None:
        """Sample the calls of the window's thread if its beat is overdue; may run on any thread."""
        last_beat_s = self._last_beat_s
        if (
            self._overdue_calls[0] != last_beat_s
            and self._clock() - last_beat_s > BEAT_PERIOD_S + _MIN_OVERDUE_S
        ):
            self._overdue_calls = last_beat_s, find_thread_calls(self._watched_thread_id)

    def _watch_thread(self) -> None:
        while not self._closing.wait(_CHECK_PERIOD_S):
            self.sample_overdue_thread()


def find_thread_calls(thread_id: int) -> tuple[str, ...]:
    """Return the call stack of a thread, outermost call first.

    It contains only the innermost call and the calls of this program.

    The interpreter writes the stacks itself while no thread runs. A frame object held by Python
    code would keep its local variables alive: a painter that outlives its paint event, or a widget
    that is then freed on the wrong thread, would crash the program.
    """
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as file:
        faulthandler.dump_traceback(file, all_threads=True)
        file.seek(0)
        lines = iter(file.read().splitlines())
    for line in lines:
        header = _THREAD_LINE.match(line)
        if header is not None and int(header[1], 16) == thread_id:
            return _parse_calls(takewhile(str.strip, lines))
    return ()


def _parse_calls(lines: Iterable[str]) -> tuple[str, ...]:
    names = {_find_file(module): name for name, module in tuple(sys.modules.items())}
    calls: list[str] = []
    for call in filter(None, map(_CALL_LINE.match, lines)):
        path, line, function = call.groups()
        name = names.get(path) or Path(path).stem
        if not calls or name.startswith("rotemina."):
            calls.append(f"  {name}:{line} {function}")
    return tuple(calls[:_MAX_CALLS][::-1])


def _find_file(module: object) -> str | None:
    return getattr(module, "__dict__", {}).get("__file__")
