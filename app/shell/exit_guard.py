"""What asks the program to end: signals, and calls, which are refused while the window is open.

In a slot or a paint event, Qt's binding ends the process for a SystemExit without asking any hook
of Python's. So what code usually raises one by raises another error, which the hooks hear of. A
bare ``raise SystemExit`` and ``os._exit`` are beyond that: the process ends, and whoever registered
to be called at its end, and the watchdog beside it, stop the machine.
"""

import builtins
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager

#: Signals that ask the program to end; Windows lacks the last.
TERMINATION_SIGNALS = tuple(
    number for number in signal.Signals if number.name in ("SIGINT", "SIGTERM", "SIGHUP")
)
_PLACES = ((sys, "exit"), (builtins, "exit"), (builtins, "quit"))


class ExitRefusedError(Exception):
    """Somebody tried to end the program while its window is open."""


@contextmanager
def exits_refused() -> Iterator[None]:
    """Let ``sys.exit``, ``exit`` and ``quit`` raise :class:`ExitRefusedError` while this lasts."""

    def refuse(status: object = None) -> None:
        raise ExitRefusedError(f"it called exit({status!r}); only the window ends the program")

    before = [(place, name, getattr(place, name, None)) for place, name in _PLACES]
    for place, name in _PLACES:
        setattr(place, name, refuse)
    try:
        yield
    finally:
        for place, name, call in before:
            if call is None:  # Python was started without them
                delattr(place, name)
            else:
                setattr(place, name, call)
