"""A process of its own that shows one address by Qt WebEngine: ``python -m …web_window <title>``.

It has the address from its standard input, not from its arguments, which other users may list, and
ends when that input is closed. On its standard output it says ``window <number>`` once there is
one, ``loaded`` or ``failed``, and ``stop`` or ``latch`` when Esc or Shift+Esc was pressed in it.
"""

import ctypes
import sys
import threading

from PySide6.QtCore import QEvent, QObject, Qt, QUrl, Signal
from PySide6.QtGui import QGuiApplication, QKeyEvent
from PySide6.QtWebEngineCore import QWebEnginePage, QWebEngineProfile
from PySide6.QtWebEngineWidgets import QWebEngineView
from PySide6.QtWidgets import QApplication

FRAMELESS = "--frameless"
_EVENT_MASK = 1 << 11  # XCB_CW_EVENT_MASK
# Of X11's events: buttons, enter and leave, motion, exposure, structure, properties; not keys, not
# focus.
_WANTED = sum(1 << bit for bit in (2, 3, 4, 5, 6, 15, 17, 22))


class Page(QWebEnginePage):
    """A page that goes nowhere, opens nothing and prints nothing."""

    def __init__(self, profile: QWebEngineProfile, home: QUrl) -> None:
        super().__init__(profile)
        self._home = home

    def acceptNavigationRequest(  # noqa: N802 (Qt's name)
        self, url: QUrl, kind: QWebEnginePage.NavigationType, main: bool
    ) -> bool:
        """Go nowhere but home."""
        return url == self._home

    def javaScriptConsoleMessage(  # noqa: N802 (Qt's name)
        self, level: QWebEnginePage.JavaScriptConsoleMessageLevel, text: str, line: int, source: str
    ) -> None:
        """Keep quiet: Qt would print the address with its secret."""


class _Input(QObject):
    """Tells when whoever started this process has gone."""

    closed = Signal()

    def watch(self) -> None:
        """Read on, on a thread, until there is no more."""
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        sys.stdin.read()
        self.closed.emit()


class EscapeWatch(QObject):
    """Passes Esc on, which stops the machine, before the page can have it.

    It watches one window, since no shortcut works in a window that was never activated, as one in
    another process' window is not; and not the whole application, which Qt WebEngine cannot bear.
    """

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Say it, and let the event pass."""
        pressed = isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress
        if pressed and event.key() == Qt.Key.Key_Escape:
            latched = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            say("latch" if latched else "stop")
        return False


def leave_keys(window: int) -> None:
    """Have X11 give keys to the window around this one, also while the pointer is in here.

    Otherwise whoever moves the pointer here with a jog key held takes its release away from the
    program, which then does not hear of it.
    """
    interface = QGuiApplication.instance().nativeInterface()
    connection = ctypes.c_void_p(interface.connection())
    xcb = ctypes.CDLL("libxcb.so.1")
    mask = ctypes.c_uint32(_WANTED)
    xcb.xcb_change_window_attributes(
        connection, ctypes.c_uint32(window), ctypes.c_uint32(_EVENT_MASK), ctypes.byref(mask)
    )
    xcb.xcb_flush(connection)


def say(text: str) -> None:
    """Tell the program that started this one."""
    print(text, flush=True)


def main() -> int:
    """Show the address until the input ends; return the exit status."""
    url = QUrl(sys.stdin.readline().strip())
    application = QApplication(sys.argv)
    title = sys.argv[1]
    application.setApplicationName(title)
    profile = QWebEngineProfile()  # without a name nothing is kept on disk
    page = Page(profile, url)
    view = QWebEngineView()
    view.setWindowTitle(title)
    view.setContextMenuPolicy(Qt.ContextMenuPolicy.NoContextMenu)
    view.setWindowFlag(Qt.WindowType.WindowDoesNotAcceptFocus)  # keys belong to the other window
    view.setWindowFlag(Qt.WindowType.FramelessWindowHint, FRAMELESS in sys.argv)
    view.resize(900, 600)
    view.setPage(page)
    page.loadFinished.connect(lambda done: say("loaded" if done else "failed"))
    page.renderProcessTerminated.connect(lambda *_: application.exit(1))
    source = _Input()
    source.closed.connect(application.quit)
    source.watch()
    page.load(url)
    view.show()
    watch = EscapeWatch()
    view.windowHandle().installEventFilter(watch)
    number = int(view.winId())
    if FRAMELESS in sys.argv and application.platformName() == "xcb":
        leave_keys(number)
    say(f"window {number}")
    status = application.exec()
    view.setPage(None)
    del page, profile  # in this order, or Qt complains
    return status


if __name__ == "__main__":
    sys.exit(main())
