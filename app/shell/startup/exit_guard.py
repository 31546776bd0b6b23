"""Requests to end the program: signals, and calls that are refused while the window is open.

If a slot or paint event raises SystemExit, Qt's binding ends the process without calling any Python
hook. Therefore ``sys.exit``, ``exit`` and ``quit`` raise another error here, which the hooks do
receive. A bare ``raise SystemExit`` and ``os._exit`` cannot be caught: the process ends, and the
machine is stopped by the registered exit functions and by the watchdog process.
"""

import builtins
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager

#: Signals that ask the program to end. Windows has no SIGHUP.
TERMINATION_SIGNALS = tuple(
    number for number in signal.Signals if number.name in ("SIGINT", "SIGTERM", "SIGHUP")
)
_EXIT_FUNCTIONS = ((sys, "exit"), (builtins, "exit"), (builtins, "quit"))


class ExitRefusedError(Exception):
    """Code tried to end the program while its window is open."""


@contextmanager
def refuse_exits() -> Iterator[None]:
    """Make ``sys.exit``, ``exit`` and ``quit`` raise :class:`ExitRefusedError` in this context."""

    def refuse(status: object = None) -> None:
        raise ExitRefusedError(f"it called exit({status!r}); only the window ends the program")

    original_functions = [
        (module, name, getattr(module, name, None)) for module, name in _EXIT_FUNCTIONS
    ]
    for module, name in _EXIT_FUNCTIONS:
        setattr(module, name, refuse)
    try:
        yield
    finally:
        for module, name, function in original_functions:
            # Without the site module, Python has no builtins ``exit`` and ``quit``.
            if function is None:
                delattr(module, name)
            else:
                setattr(module, name, function)
