"""Panels that have received something while another tab was in front; nothing raises them."""

from collections.abc import Mapping

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabBar

from rotemina.app.widgets.tab_dots import TabDots


class PanelNews(QObject):
    """Marks the tab of a panel, and its entry in the menu, until the panel is looked at.

    A panel that raised itself would change the tabs under the mouse.
    """

    def __init__(self, window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
        super().__init__(window)
        self._window, self._docks = window, docks
        self._seen: dict[str, object] = {}  # the latest that each was marked for
        self._new: set[str] = set()
        # Qt makes tab bars anew while it lays docks out.
        self._later = QTimer(self, singleShot=True, interval=0)
        self._later.timeout.connect(self._refresh)
        for name, dock in docks.items():
            self.watch(name, dock)

    @property
    def new(self) -> frozenset[str]:
        """Names of the panels that have something that was not looked at."""
        return frozenset(self._new)

    def watch(self, name: str, dock: QDockWidget) -> None:
        """Have a panel's mark end as soon as its dock is in front."""
        dock.visibilityChanged.connect(lambda visible: self._see(name, visible=visible))

    def arrived(self, name: str, what: object) -> None:
        """Note what a panel has received; the same again, as for another model, is not new."""
        dock = self._docks.get(name)
        if dock is None or self._seen.get(name) is what:
            return
        self._seen[name] = what
        if not dock.isVisible() or dock.visibleRegion().isEmpty():
            self._new.add(name)
            self._refresh()

    def _see(self, name: str, *, visible: bool) -> None:
        if visible:
            self._new.discard(name)
        self._later.start()

    def _refresh(self) -> None:
        titles = {self._docks[name].windowTitle() for name in self._new if name in self._docks}
        for dock in self._docks.values():
            title = dock.windowTitle()
            action = dock.toggleViewAction()
            action.setText(f"{title} ●" if title in titles else title)
        only_mine = Qt.FindChildOption.FindDirectChildrenOnly
        for bar in self._window.findChildren(QTabBar, options=only_mine):
            dots = bar.findChild(TabDots)
            if dots is None and titles:
                dots = TabDots(bar, lambda index, bar=bar: self._is_new(bar, index))
            if dots is not None:
                dots.refresh()

    def _is_new(self, bar: QTabBar, index: int) -> bool:
        title = bar.tabText(index).replace("&", "")
        return any(
            self._docks[name].windowTitle() == title for name in self._new if name in self._docks
        )
