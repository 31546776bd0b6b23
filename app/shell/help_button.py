"""The "?" of a panel: in the title bar of its dock, or beside the tabs of the central panels."""

from collections.abc import Callable, Mapping

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QAbstractButton, QDockWidget, QTabWidget, QToolButton, QWidget

from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import plain_tip

_GAP = 2  # px between the buttons of a title bar
_MOVING = (QEvent.Type.Resize, QEvent.Type.Show, QEvent.Type.LayoutRequest)
_OWN_BUTTONS = ("qt_dockwidget_floatbutton", "qt_dockwidget_closebutton")


class HelpButton(QToolButton):
    """Opens the page of a panel."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setText("?")
        self.setObjectName("help")
        self.setAutoRaise(True)

    def tell(self, title: str) -> None:
        """Say whose page it opens."""
        self.setToolTip(plain_tip(translate("shell", "Help on {title} (F1)").format(title=title)))
        self.setAccessibleName(translate("shell", "Help on {title}").format(title=title))


class DockHelp(QObject):
    """Keeps a "?" in the title bar of a dock, left of the bar's own buttons.

    A dock that floats in a frame of the system's has no title bar of its own: there the "?" takes a
    strip above the panel.
    """

    def __init__(self, dock: QDockWidget, show: Callable[[], object]) -> None:
        super().__init__(dock)
        self._dock = dock
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self.place)
        self.button = HelpButton(dock)
        self.button.tell(dock.windowTitle())
        self.button.clicked.connect(lambda _=False: show())
        dock.installEventFilter(self)
        dock.topLevelChanged.connect(lambda _: self.place())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Follow the title bar, once for all that another layout changes of it."""
        if event.type() in _MOVING:
            self._soon.start()
        return False

    def place(self) -> None:
        """Put the button where there is room for it."""
        dock, button = self._dock, self.button
        found = [dock.findChild(QAbstractButton, name) for name in _OWN_BUTTONS]
        own = [one for one in found if one is not None and not one.isHidden()]
        size = button.sizeHint()
        strip = 0 if own else size.height()
        if dock.contentsMargins().top() != strip:
            dock.setContentsMargins(0, strip, 0, 0)
        if own:
            left = min(one.x() for one in own)
            middle = own[0].geometry().center().y()
            button.resize(size.width(), min(size.height(), 2 * middle))
            button.move(left - button.width() - _GAP, middle - button.height() // 2)
        else:
            button.resize(size)
            button.move(dock.width() - size.width() - _GAP, 0)
        button.raise_()


class TabHelp(QObject):
    """Keeps a "?" beside tabs, for the panel in front."""

    def __init__(
        self, tabs: QTabWidget, pages: Mapping[int, str], show: Callable[[str], object]
    ) -> None:
        super().__init__(tabs)
        self._tabs, self._pages = tabs, pages
        self.button = HelpButton(tabs)
        self.button.clicked.connect(lambda _=False: show(pages[tabs.currentIndex()]))
        tabs.setCornerWidget(self.button)
        tabs.currentChanged.connect(lambda _: self._tell())
        self._tell()

    def _tell(self) -> None:
        self.button.setVisible(bool(self._pages.get(self._tabs.currentIndex())))
        self.button.tell(self._tabs.tabText(self._tabs.currentIndex()))
