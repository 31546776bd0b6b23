"""A watch over the window's thread: how late it is, and what it did when it stood still."""

import logging
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from types import FrameType

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
_UNSEEN = "what it was cannot be told: the interpreter was held"


@dataclass(frozen=True, slots=True)
class Stall:
    """A moment in which the window did not react: for how long, s, and in which calls it was."""

    lasted_s: float
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
        self, parent: QObject | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        super().__init__(parent)
        self._clock = clock
        self._measured = Latenesses(PERIOD_S)
        self.stalls: deque[Stall] = deque(maxlen=_MOST_STALLS)
        self._last_s = clock()
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
            self._watched, self._last_s = threading.get_ident(), self._clock()
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
        self._measured.add(now_s - before_s)
        late_s = now_s - before_s - PERIOD_S
        if late_s > STALL_S:
            overdue_s, calls = self._seen
            stall = Stall(late_s, calls if overdue_s == before_s else (_UNSEEN,))
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
            "the window did not react for %.2f s%s; it was in\n%s", stall.lasted_s, more, calls
        )

    def look(self) -> None:
        """See, from any thread, what the window's thread does if its beat is overdue."""
        overdue_s = self._last_s
        if self._seen[0] != overdue_s and self._clock() - overdue_s > PERIOD_S + _OVERDUE_S:
            frame = sys._current_frames().get(self._watched)
            if frame is not None:
                self._seen = overdue_s, _calls(frame)

    def _look_on(self) -> None:
        while not self._closing.wait(_LOOKS_S):
            self.look()


def _calls(frame: FrameType) -> tuple[str, ...]:
    """Return the program's own calls of a stack, and the innermost of all; outermost first."""
    found: list[str] = []
    walked: FrameType | None = frame
    while walked is not None:
        name = str(walked.f_globals.get("__name__", "?"))
        if walked is frame or name.startswith("rotemina."):
            found.append(f"  {name}:{walked.f_lineno} {walked.f_code.co_qualname}")
        walked = walked.f_back
    return tuple(found[:_DEPTH][::-1])
