"""Exceptions that a panel leaks into Qt, and Qt's own complaints."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType

from PySide6.QtCore import QMessageLogContext, QtMsgType, qInstallMessageHandler

from rotemina.app.shell.qt_messages import OFFSCREEN

_COMPLAINTS = (QtMsgType.QtWarningMsg, QtMsgType.QtCriticalMsg)


@contextmanager
def escaped() -> Iterator[list[str]]:
    """Gather what escapes while this lasts: a line each.

    An exception in a slot, a timer or a paint event does not reach whoever caused the event: Qt
    stands in between, and Python's hook is told instead.
    """
    told: list[str] = []

    def on_exception(
        kind: type[BaseException], error: BaseException, _trace: TracebackType | None
    ) -> None:
        told.append(f"{kind.__name__}: {error}")

    def on_message(kind: QtMsgType, _context: QMessageLogContext, message: str) -> None:
        if kind in _COMPLAINTS and not message.startswith(OFFSCREEN):
            told.append(message)

    hook, sys.excepthook = sys.excepthook, on_exception
    handler = qInstallMessageHandler(on_message)
    try:
        yield told
    finally:
        qInstallMessageHandler(handler)
        sys.excepthook = hook
