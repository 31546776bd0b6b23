"""The latest messages of the program: notices and log records."""

import logging
import threading
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from datetime import datetime

from rotemina.app.workbench import (
    Level,
    find_help_page,
    find_module_page,
    get_message_page,
)

MAX_MESSAGES = 2000
# In characters. Longer messages are shortened in the middle.
MAX_MESSAGE_LENGTH = 4000
# The workbench also logs its notices, which this log receives directly.
_WORKBENCH_PREFIX = "rotemina.app.workbench."
_PACKAGE_PREFIX = "rotemina."
_SEVERITY = {Level.INFO: 0, Level.GOOD: 0, Level.WARNING: 1, Level.ERROR: 2}


@dataclass(frozen=True, slots=True)
class LogMessage:
    """One notice or log record, in local time."""

    time: datetime
    level: Level
    source: str
    text: str
    # The help page, or "".
    page: str = ""

    @property
    def line(self) -> str:
        """The message as an entry of a log file; all lines after the first are indented."""
        text = self.text.replace("\n", "\n    ")
        time_text = self.time.isoformat(sep=" ", timespec="milliseconds")
        return f"{time_text}  {self.level:<7}  {self.source}: {text}"


class MessageLog(logging.Handler):
    """Handler of Python's logging that keeps the latest messages; any thread may add one.

    Notices of the window are added by :meth:`add_notice`, because a log record does not contain
    their level.

    Parameters
    ----------
    clock : callable
        Returns the local time.
    max_count : int
        Number of messages to keep; the oldest are dropped.
    """

    def __init__(
        self, clock: Callable[[], datetime] = datetime.now, max_count: int = MAX_MESSAGES
    ) -> None:
        super().__init__(logging.INFO)
        self._clock = clock
        self._messages: deque[LogMessage] = deque(maxlen=max_count)
        self._lock = threading.Lock()
        self._count = 0

    @property
    def count(self) -> int:
        """Number of messages added so far, including dropped ones; it changes with each new one."""
        return self._count

    def messages(self) -> tuple[LogMessage, ...]:
        """Return the messages, oldest first."""
        with self._lock:
            return tuple(self._messages)

    def add_notice(self, level: Level, text: str) -> None:
        """Add a notice that the window shows to the operator."""
        self._add(level, "window", text, get_message_page(text))

    def emit(self, record: logging.LogRecord) -> None:
        """Add a log record."""
        if record.name.startswith(_WORKBENCH_PREFIX) and record.exc_info is None:
            return
        level = Level.INFO
        if record.levelno >= logging.WARNING:
            level = Level.ERROR if record.levelno >= logging.ERROR else Level.WARNING
        try:
            text = self.format(record)
        # A faulty log call must not break the code that makes it.
        except Exception:
            self.handleError(record)
            return
        error = record.exc_info[1] if record.exc_info else None
        page = (find_help_page(error) if error is not None else "") or find_module_page(record.name)
        self._add(level, record.name.removeprefix(_PACKAGE_PREFIX), text, page)

    def _add(self, level: Level, source: str, text: str, page: str) -> None:
        if len(text) > MAX_MESSAGE_LENGTH:
            # Both ends are kept, because the end of a traceback names the error.
            half = MAX_MESSAGE_LENGTH // 2
            text = f"{text[:half]} … {text[-half:]}"
        message = LogMessage(self._clock(), level, source, text, page)
        with self._lock:
            self._messages.append(message)
            self._count += 1


def filter_messages(
    messages: Iterable[LogMessage], min_level: Level, words: str
) -> tuple[LogMessage, ...]:
    """Return the messages of this level or above that contain all given words."""
    search_words = words.casefold().split()
    return tuple(
        message
        for message in messages
        if _SEVERITY[message.level] >= _SEVERITY[min_level]
        and all(word in f"{message.source} {message.text}".casefold() for word in search_words)
    )
