"""Orderly termination on Ctrl-C or a signal of the system."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


class SignalInterrupt(KeyboardInterrupt):
    """A signal asks for an end.

    Not KeyboardInterrupt itself: of that, Python remembers one that interrupts an ``exec``, such as
    that of a dataclass being defined, and at its end dies by SIGINT whatever the exit status is.
    """


@contextmanager
def interrupted_by_signals() -> Iterator[list[int]]:
    """Let each signal that asks for an end interrupt the program as Ctrl-C does.

    Return the numbers of the signals received, which grow while this lasts.
    """
    received: list[int] = []

    def interrupt(number: int, _: FrameType | None) -> None:
        received.append(number)
        raise SignalInterrupt

    with _handled_by(interrupt):
        yield received


@contextmanager
def termination_requested() -> Iterator[Callable[[], bool]]:
    """Return whether a signal has asked for an end; work is not interrupted."""
    received: list[int] = []

    def note(number: int, _: FrameType | None) -> None:
        received.append(number)

    with _handled_by(note):
        yield lambda: bool(received)


@contextmanager
def _handled_by(handler: Callable[[int, FrameType | None], None]) -> Iterator[None]:
    before = {number: signal.signal(number, handler) for number in _termination_signals()}
    try:
        yield
    finally:
        for number, previous in before.items():
            signal.signal(number, previous)


def _termination_signals() -> tuple[signal.Signals, ...]:
    """Return the signals that ask this program to end.

    A script starts its background jobs with SIGINT ignored, which nobody has asked for. ``nohup``
    ignores SIGHUP on request.
    """
    if threading.current_thread() is not threading.main_thread():
        return ()  # Python accepts handlers from the main thread only
    hang_up = getattr(signal, "SIGHUP", None)  # Windows has none
    if hang_up is None or signal.getsignal(hang_up) is signal.SIG_IGN:
        return (signal.SIGINT, signal.SIGTERM)
    return (signal.SIGINT, signal.SIGTERM, hang_up)
