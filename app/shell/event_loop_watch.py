"""A watch over the window's thread: how late it is, and what it did when it stood still."""

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

from rotemina.app.shell.reaction_times import Lateness, Latenesses

logger = logging.getLogger(__name__)

PERIOD_S = 0.02
STALL_S = 0.25
_OVERDUE_S = 0.1  # from which on it is looked at what the thread does
_LOOKS_S = 0.05  # between two looks at whether a beat is overdue
_TOLD_EVERY_S = 60.0  # a machine that is always late must not fill the log
_MOST_STALLS = 100  # that are remembered
_DEPTH = 12  # calls that are named
_THREAD = re.compile(r"(?:Current t|T)hread 0x([0-9a-f]+) ")
_CALL = re.compile(r'  File "(.*)", line (\d+) in (.*)')
_UNSEEN = "what it was cannot be told: the interpreter was held"


@dataclass(frozen=True, slots=True)
class Stall:
    """A moment in which the window did not react.

    Attributes
    ----------
    lasted_s : float
    worked_s : float
        Processor time of the window's thread meanwhile. Where it is much less, the thread waited:
        for a processor that others used, for the interpreter, or for a file.
    calls : tuple of str
        That the thread was in, outermost first.
    """

    lasted_s: float
    worked_s: float
    calls: tuple[str, ...]


class LoopWatch(QObject):
    """Measures how late events reach the window's thread.

    A timer beats on that thread; a thread of its own sees when a beat is overdue, and looks which
    calls the window's thread is in. Stalls are logged with these, one a minute at most.

    Attributes
    ----------
    stalls : deque of Stall
        The latest.
    """

    def __init__(
        self,
        parent: QObject | None = None,
        clock: Callable[[], float] = time.monotonic,
        worked: Callable[[], float] = time.thread_time,
    ) -> None:
        super().__init__(parent)
        self._clock, self._worked = clock, worked
        self._measured = Latenesses(PERIOD_S)
        self.stalls: deque[Stall] = deque(maxlen=_MOST_STALLS)
        self._last_s, self._worked_s = clock(), worked()
        self._told_s = float("-inf")
        self._untold: list[float] = []  # how long stalls lasted that are not in the log, s
        # The beat that is overdue, and the calls that were seen then; written by the other thread.
        self._seen: tuple[float, tuple[str, ...]] = (0.0, ())
        self._watched = threading.get_ident()
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None
        self._timer = QTimer(self, interval=round(1e3 * PERIOD_S))
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self.beat)

    def start(self) -> None:
        """Begin, on the thread that is to be watched."""
        if self._thread is None:
            self._watched = threading.get_ident()
            self._last_s, self._worked_s = self._clock(), self._worked()
            self._timer.start()
            self._thread = threading.Thread(target=self._look_on, name="loop watch", daemon=True)
            self._thread.start()

    def restart(self) -> None:
        """Forget what was measured so far, such as a start."""
        self._measured = Latenesses(PERIOD_S)
        self.stalls.clear()

    def close(self) -> None:
        """End; safe to call twice."""
        self._timer.stop()
        self._closing.set()
        thread, self._thread = self._thread, None
        if thread is not None:
            thread.join(1.0)

    @property
    def lateness(self) -> Lateness:
        """What was measured since the start."""
        return self._measured.summary()

    def beat(self) -> None:
        """Note that the window's thread is at work on its events."""
        now_s = self._clock()
        before_s, self._last_s = self._last_s, now_s
        worked_s = self._worked()
        worked_before_s, self._worked_s = self._worked_s, worked_s
        self._measured.add(now_s - before_s)
        late_s = now_s - before_s - PERIOD_S
        if late_s > STALL_S:
            overdue_s, calls = self._seen
            known = overdue_s == before_s and bool(calls)
            stall = Stall(late_s, worked_s - worked_before_s, calls if known else (_UNSEEN,))
            self.stalls.append(stall)
            if now_s - self._told_s < _TOLD_EVERY_S:
                self._untold.append(stall.lasted_s)
            else:
                self._tell(stall)
                self._told_s, self._untold = now_s, []

    def _tell(self, stall: Stall) -> None:
        more = ""
        if self._untold:
            most = max(self._untold)
            more = f" (and {len(self._untold)} times since the last word, up to {most:.2f} s)"
        calls = "\n".join(stall.calls)
        logger.warning(
            "the window did not react for %.2f s%s, and worked %.2f s of that; it was in\n%s",
            stall.lasted_s,
            more,
            stall.worked_s,
            calls,
        )

    def look(self) -> None:
        """See, from any thread, what the window's thread does if its beat is overdue."""
        overdue_s = self._last_s
        if self._seen[0] != overdue_s and self._clock() - overdue_s > PERIOD_S + _OVERDUE_S:
            self._seen = overdue_s, thread_calls(self._watched)

    def _look_on(self) -> None:
        while not self._closing.wait(_LOOKS_S):
            self.look()


def thread_calls(thread: int) -> tuple[str, ...]:
    """Return the program's own calls of any thread, and its innermost call; outermost first.

    The interpreter writes the stacks itself, while no thread runs. A frame that Python code holds
    would keep its local variables alive: a painter that outlives its paint event, or a widget that
    is then freed on this thread, ends the program.
    """
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as file:
        faulthandler.dump_traceback(file, all_threads=True)
        file.seek(0)
        lines = iter(file.read().splitlines())
    for line in lines:
        head = _THREAD.match(line)
        if head is not None and int(head[1], 16) == thread:
            return _own_calls(takewhile(str.strip, lines))
    return ()


def _own_calls(lines: Iterable[str]) -> tuple[str, ...]:
    """Return calls from the lines of a stack, the innermost first."""
    names = {_file_of(module): name for name, module in tuple(sys.modules.items())}
    calls: list[str] = []
    for call in filter(None, map(_CALL.match, lines)):
        path, line, function = call.groups()
        name = names.get(path) or Path(path).stem
        if not calls or name.startswith("rotemina."):
            calls.append(f"  {name}:{line} {function}")
    return tuple(calls[:_DEPTH][::-1])


def _file_of(module: object) -> str | None:
    return getattr(module, "__dict__", {}).get("__file__")
