"""What the program told while it ran: notices and records of the log, the latest of them."""

import logging
import threading
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from datetime import datetime

from rotemina.app.shell.help_topics import page_by_name, page_for, page_of
from rotemina.app.shell.workbench import Level

MOST = 2000  # messages that are kept
LONGEST = 4000  # characters of one
_NOTICED = "rotemina.app.shell.workbench"  # logs what it tells as a notice, which is kept already
_PACKAGE = "rotemina."
_GRAVITY = {Level.INFO: 0, Level.GOOD: 0, Level.WARNING: 1, Level.ERROR: 2}


@dataclass(frozen=True, slots=True)
class Message:
    """One thing that was told, in local time."""

    time: datetime
    level: Level
    source: str
    text: str
    page: str = ""  # of the help

    @property
    def line(self) -> str:
        """The message as a line of a text file; further lines of its text are set in."""
        text = self.text.replace("\n", "\n    ")
        when = self.time.isoformat(sep=" ", timespec="milliseconds")
        return f"{when}  {self.level:<7}  {self.source}: {text}"


class MessageLog(logging.Handler):
    """Keeps the latest messages; any thread may add one.

    It is a handler of Python's log. What the window tells as a notice is added by :meth:`notice`,
    for the log does not know how it was meant.

    Parameters
    ----------
    clock : callable
        Returns the local time.
    most : int
        Messages that are kept; the oldest go first.
    """

    def __init__(self, clock: Callable[[], datetime] = datetime.now, most: int = MOST) -> None:
        super().__init__(logging.INFO)
        self._clock = clock
        self._messages: deque[Message] = deque(maxlen=most)
        self._guard = threading.Lock()
        self._count = 0

    @property
    def count(self) -> int:
        """How many were ever added; another number means that there is something new."""
        return self._count

    def messages(self) -> tuple[Message, ...]:
        """Return what is kept, oldest first."""
        with self._guard:
            return tuple(self._messages)

    def notice(self, level: Level, text: str) -> None:
        """Add what the window tells the operator."""
        self._add(level, "window", text, page_of(text))

    def emit(self, record: logging.LogRecord) -> None:
        """Add a record of the log."""
        if record.name == _NOTICED and record.exc_info is None:
            return
        level = Level.INFO
        if record.levelno >= logging.WARNING:
            level = Level.ERROR if record.levelno >= logging.ERROR else Level.WARNING
        try:
            text = self.format(record)
        except Exception:  # a badly written log call must not end what it reports on
            self.handleError(record)
            return
        error = record.exc_info[1] if record.exc_info else None
        page = (page_for(error) if error is not None else "") or page_by_name(record.name)
        self._add(level, record.name.removeprefix(_PACKAGE), text, page)

    def _add(self, level: Level, source: str, text: str, page: str) -> None:
        if len(text) > LONGEST:
            half = LONGEST // 2  # the end of a traceback says what happened
            text = f"{text[:half]} … {text[-half:]}"
        message = Message(self._clock(), level, source, text, page)
        with self._guard:
            self._messages.append(message)
            self._count += 1


def chosen(messages: Iterable[Message], least: Level, words: str) -> tuple[Message, ...]:
    """Return the messages that are at least so grave and hold all of the words somewhere."""
    wanted = words.casefold().split()
    return tuple(
        message
        for message in messages
        if _GRAVITY[message.level] >= _GRAVITY[least]
        and all(word in f"{message.source} {message.text}".casefold() for word in wanted)
    )
