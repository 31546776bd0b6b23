"""Marks on panels that received something while they were behind another tab."""

from collections.abc import Mapping

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabBar

from rotemina.app.widgets.controls import TabDots


class PanelNews(QObject):
    """Marks on the tab and menu entry of a panel with new content, until it is in front.

    Panels do not come to the front by themselves, because the tabs would move under the mouse.
    """

    def __init__(self, window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
        super().__init__(window)
        self._window, self._docks = window, docks
        # The object that each panel received last.
        self._latest_contents: dict[str, object] = {}
        self._marked_names: set[str] = set()
        # Qt replaces tab bars while it lays out docks, so the marks are updated afterwards.
        self._refresh_timer = QTimer(self, singleShot=True, interval=0)
        self._refresh_timer.timeout.connect(self._refresh)
        for name, dock in docks.items():
            self.watch(name, dock)

    @property
    def unseen_names(self) -> frozenset[str]:
        """Names of the panels with content that was not seen yet."""
        return frozenset(self._marked_names)

    def watch(self, name: str, dock: QDockWidget) -> None:
        """Remove the mark of a panel as soon as its dock is in front."""
        dock.visibilityChanged.connect(
            lambda visible: self._on_visibility_changed(name, visible=visible)
        )

    def note_arrival(self, name: str, content: object) -> None:
        """Mark a panel that has received new content, unless it is the same object as last time."""
        dock = self._docks.get(name)
        if dock is None or self._latest_contents.get(name) is content:
            return
        self._latest_contents[name] = content
        if not dock.isVisible() or dock.visibleRegion().isEmpty():
            self._marked_names.add(name)
            self._refresh()

    def _on_visibility_changed(self, name: str, *, visible: bool) -> None:
        if visible:
            self._marked_names.discard(name)
        self._refresh_timer.start()

    def _refresh(self) -> None:
        titles = {
            self._docks[name].windowTitle() for name in self._marked_names if name in self._docks
        }
        for dock in self._docks.values():
            title = dock.windowTitle()
            action = dock.toggleViewAction()
            action.setText(f"{title} ●" if title in titles else title)
        direct_children = Qt.FindChildOption.FindDirectChildrenOnly
        for bar in self._window.findChildren(QTabBar, options=direct_children):
            dots = bar.findChild(TabDots)
            if dots is None and titles:
                dots = TabDots(bar, lambda index, bar=bar: self._has_news(bar, index))
            if dots is not None:
                dots.refresh()

    def _has_news(self, bar: QTabBar, index: int) -> bool:
        title = bar.tabText(index).replace("&", "")
        return any(
            self._docks[name].windowTitle() == title
            for name in self._marked_names
            if name in self._docks
        )
