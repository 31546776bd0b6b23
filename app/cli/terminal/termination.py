"""Orderly termination on Ctrl-C or a termination signal."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


class TerminationInterrupt(KeyboardInterrupt):
    """Raised when a signal requests termination.

    A plain KeyboardInterrupt is not suitable. If it interrupts an ``exec``, such as the definition
    of a dataclass, Python finally ends itself with SIGINT, whatever the exit status.
    """


@contextmanager
def interrupt_on_signals() -> Iterator[list[int]]:
    """Let each termination signal interrupt the program like Ctrl-C.

    Yield the list of received signal numbers, which grows during the context.
    """
    received_signals: list[int] = []

    def interrupt(number: int, _: FrameType | None) -> None:
        received_signals.append(number)
        raise TerminationInterrupt

    with _handle_signals(interrupt):
        yield received_signals


@contextmanager
def watch_termination() -> Iterator[Callable[[], bool]]:
    """Yield a function that returns whether a termination signal was received.

    Within the context, these signals do not interrupt the program.
    """
    received_signals: list[int] = []

    def record_signal(number: int, _: FrameType | None) -> None:
        received_signals.append(number)

    with _handle_signals(record_signal):
        yield lambda: bool(received_signals)


@contextmanager
def _handle_signals(handler: Callable[[int, FrameType | None], None]) -> Iterator[None]:
    previous_handlers = {
        number: signal.signal(number, handler) for number in _find_termination_signals()
    }
    try:
        yield
    finally:
        for number, previous in previous_handlers.items():
            signal.signal(number, previous)


def _find_termination_signals() -> tuple[signal.Signals, ...]:
    """Return the termination signals that are handled.

    SIGINT is handled even if it was ignored, because shells ignore it for the background jobs of a
    script. SIGHUP stays ignored if it was ignored, because ``nohup`` does this on purpose.
    """
    if threading.current_thread() is not threading.main_thread():
        # Python accepts signal handlers only from the main thread.
        return ()
    # Windows has no SIGHUP.
    hang_up = getattr(signal, "SIGHUP", None)
    if hang_up is None or signal.getsignal(hang_up) is signal.SIG_IGN:
        return (signal.SIGINT, signal.SIGTERM)
    return (signal.SIGINT, signal.SIGTERM, hang_up)
