"""The "?" button of a panel: in the title bar of its dock, or next to the central tabs."""

from collections.abc import Callable, Mapping

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QAbstractButton, QDockWidget, QTabWidget, QToolButton, QWidget

from rotemina.app.language import translate
from rotemina.app.widgets.controls import make_tooltip

_GAP_PX = 2
_PLACING_EVENTS = (QEvent.Type.Resize, QEvent.Type.Show, QEvent.Type.LayoutRequest)
_TITLE_BAR_BUTTONS = ("qt_dockwidget_floatbutton", "qt_dockwidget_closebutton")


class HelpButton(QToolButton):
    """Button that opens the help page of a panel."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setText("?")
        self.setObjectName("help")
        self.setAutoRaise(True)

    def set_panel_title(self, title: str) -> None:
        """Set the title of the panel whose page is opened."""
        self.setToolTip(
            make_tooltip(translate("shell", "Help on {title} (F1)").format(title=title))
        )
        self.setAccessibleName(translate("shell", "Help on {title}").format(title=title))


class DockHelpButton(QObject):
    """The "?" button in the title bar of a dock, left of the bar's own buttons.

    A floating dock in a frame of the window system has no title bar drawn by Qt; its "?" is placed
    in a strip above the panel.
    """

    def __init__(self, dock: QDockWidget, show: Callable[[], object]) -> None:
        super().__init__(dock)
        self._dock = dock
        self._placing_timer = QTimer(self, singleShot=True, interval=0)
        self._placing_timer.timeout.connect(self.place_button)
        self.button = HelpButton(dock)
        self.button.set_panel_title(dock.windowTitle())
        self.button.clicked.connect(lambda _=False: show())
        dock.installEventFilter(self)
        dock.topLevelChanged.connect(lambda _: self.place_button())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Follow the title bar; several changes cause one placement."""
        if event.type() in _PLACING_EVENTS:
            self._placing_timer.start()
        return False

    def place_button(self) -> None:
        """Place the button in the title bar, or in the strip above the panel."""
        dock, button = self._dock, self.button
        title_bar_buttons = [dock.findChild(QAbstractButton, name) for name in _TITLE_BAR_BUTTONS]
        visible_buttons = [
            candidate
            for candidate in title_bar_buttons
            if candidate is not None and not candidate.isHidden()
        ]
        size = button.sizeHint()
        strip_height = 0 if visible_buttons else size.height()
        if dock.contentsMargins().top() != strip_height:
            dock.setContentsMargins(0, strip_height, 0, 0)
        if visible_buttons:
            left = min(candidate.x() for candidate in visible_buttons)
            middle = visible_buttons[0].geometry().center().y()
            button.resize(size.width(), min(size.height(), 2 * middle))
            button.move(left - button.width() - _GAP_PX, middle - button.height() // 2)
        else:
            button.resize(size)
            button.move(dock.width() - size.width() - _GAP_PX, 0)
        button.raise_()


class TabHelpButton(QObject):
    """The "?" button next to tabs, for the panel in front."""

    def __init__(
        self, tabs: QTabWidget, pages: Mapping[int, str], show: Callable[[str], object]
    ) -> None:
        super().__init__(tabs)
        self._tabs, self._pages = tabs, pages
        self.button = HelpButton(tabs)
        self.button.clicked.connect(lambda _=False: show(pages[tabs.currentIndex()]))
        tabs.setCornerWidget(self.button)
        tabs.currentChanged.connect(lambda _: self._update_button())
        self._update_button()

    def _update_button(self) -> None:
        self.button.setVisible(bool(self._pages.get(self._tabs.currentIndex())))
        self.button.set_panel_title(self._tabs.tabText(self._tabs.currentIndex()))
