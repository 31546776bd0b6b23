"""Set-up of Qt's binding: faster imports, and Qt's own messages in the program's log."""

import logging
import sys

from PySide6.QtCore import QMessageLogContext, QtMsgType, qInstallMessageHandler

logger = logging.getLogger("rotemina.qt")
LOG_LEVELS = {
    QtMsgType.QtDebugMsg: logging.DEBUG,
    QtMsgType.QtInfoMsg: logging.INFO,
    QtMsgType.QtWarningMsg: logging.WARNING,
    QtMsgType.QtCriticalMsg: logging.ERROR,
    QtMsgType.QtFatalMsg: logging.CRITICAL,
}
# The offscreen platform reports this for every window, because it has no screen.
OFFSCREEN_PREFIX = "This plugin does not support "


def log_qt_messages() -> None:
    """Send Qt's messages to the logger ``rotemina.qt``."""
    qInstallMessageHandler(_log_message)


def _log_message(kind: QtMsgType, _context: QMessageLogContext, message: str) -> None:
    level = logging.DEBUG if message.startswith(OFFSCREEN_PREFIX) else LOG_LEVELS[kind]
    logger.log(level, message)


def skip_source_search() -> None:
    """Make PySide skip its search of each module's source. Import PySide first.

    PySide searches the source for its own name, to find whether the module may switch features of
    Qt (``from __feature__ import``), and Python then keeps the text of each module. Without the
    search, every module counts as one that may switch features, which has no cost as long as none
    does. The search takes a twentieth of the start-up time, and the texts take 28 MB. A PySide
    without this search is left unchanged.
    """
    feature = sys.modules.get("shibokensupport.feature")
    if hasattr(feature, "_mod_uses_pyside"):
        feature._mod_uses_pyside = lambda _module: True
