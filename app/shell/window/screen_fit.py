"""Placement of a window, with its frame, within the screen that it is on."""

from PySide6.QtCore import QObject, QPoint, QSize, Qt, QTimer
from PySide6.QtGui import QScreen
from PySide6.QtWidgets import QStyle, QWidget

#: The smallest size of the window. Its contents must fit into it and never enlarge it.
MIN_WINDOW_SIZE = QSize(800, 600)
WHOLE_SCREEN_STATES = Qt.WindowState.WindowMaximized | Qt.WindowState.WindowFullScreen


def fit_on_screen(window: QWidget, *, move: bool = True) -> None:
    """Limit a window to the free area of its screen, and move it there.

    A window that fills the whole screen is not changed.
    """
    free_area = window.screen().availableGeometry()
    frame_size = _find_frame_size(window)
    max_size = free_area.size() - frame_size
    window.setMinimumSize(MIN_WINDOW_SIZE.boundedTo(max_size))
    if window.windowState() & WHOLE_SCREEN_STATES:
        return
    size = window.size().boundedTo(max_size)
    if size != window.size():
        window.resize(size)
    spare_size = max_size - size
    position = window.pos() - free_area.topLeft()
    target = QPoint(
        max(min(position.x(), spare_size.width()), 0),
        max(min(position.y(), spare_size.height()), 0),
    )
    if move and target != position:
        window.move(target + free_area.topLeft())


def _find_frame_size(window: QWidget) -> QSize:
    """Return the size of the window's frame, or of a title bar while there is no frame yet."""
    frame_size = window.frameGeometry().size() - window.size()
    if frame_size.isNull() and not window.isVisible():
        return QSize(0, window.style().pixelMetric(QStyle.PixelMetric.PM_TitleBarHeight))
    return frame_size


class ScreenFitter(QObject):
    """Fitter that keeps a window within its screen.

    It acts when the window is shown or moves to another screen, and when the screen changes.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._screen: QScreen | None = None
        # Delayed, because the desktop adds the window's frame a little later.
        self._fit_timer = QTimer(self, singleShot=True, interval=0)
        self._fit_timer.timeout.connect(lambda: fit_on_screen(window))

    def fit_soon(self) -> None:
        """Fit the window, which was just shown or no longer fills the screen."""
        handle = self._window.windowHandle()
        if handle is not None and self._screen is None:
            handle.screenChanged.connect(self._use_screen)
            self._use_screen(handle.screen())
        self._fit_timer.start()

    def _use_screen(self, screen: QScreen) -> None:
        """Fit only the size to another screen, because the user may be dragging the window."""
        if self._screen is not None:
            self._screen.availableGeometryChanged.disconnect(self._fit_timer.start)
        screen.availableGeometryChanged.connect(self._fit_timer.start)
        self._screen = screen
        fit_on_screen(self._window, move=False)
