"""Scroll areas within a panel, and stacked pages."""

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QScrollArea,
    QSizePolicy,
    QStackedWidget,
    QTabBar,
    QVBoxLayout,
    QWidget,
)

_MOST_FREED = 3  # times that a scroll bar goes before the frame has another size


class FittedScroll(QScrollArea):
    """An area that is scrolled up and down alone: as wide as its content and the bar beside it.

    ``least`` is its least width, px.
    """

    def __init__(self, least: int = 0) -> None:
        super().__init__()
        self._least = self._told = least

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for the width of the content, in the size of text of now."""
        self._told = self._needed()
        return QSize(self._told, super().minimumSizeHint().height())

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for no more width than that."""
        return QSize(self.minimumSizeHint().width(), super().sizeHint().height())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Be laid out anew where the content needs another width, not at each change in it."""
        if event.type() == QEvent.Type.LayoutRequest and self._needed() != self._told:
            self.updateGeometry()
        return super().eventFilter(watched, event)

    def _needed(self) -> int:
        content = self.widget()
        if content is None:
            return self._least
        bar = self.verticalScrollBar().sizeHint().width()
        return max(content.minimumSizeHint().width() + bar, self._least)


class PanelFrame(QScrollArea):
    """The frame of a panel, as large as the panel needs unless the window has less room for it.

    Then the panel is scrolled: no panel makes the window larger, however much room it asks for.
    """

    def __init__(self, panel: QWidget, room: QSize) -> None:
        super().__init__()
        self._room = room
        self._told = self._fitted = QSize()
        self._across = self._down = False  # which scroll bars are needed
        self._freed = 0  # times that they were not needed any more, at the present size
        self.setObjectName("panelScroll")
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the keyboard goes to the panel itself
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWidget(panel)

    def bar_width(self) -> int:
        """Return the thickness of a scroll bar, px."""
        return self.verticalScrollBar().sizeHint().width()

    def give_room(self, room: QSize) -> None:
        """Ask for no more than this from now on, px."""
        self._room = room
        self._tell()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for what the panel needs, if there is so much room."""
        self._told = self._needed().boundedTo(self._room)
        return self._told

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for what the panel would like, if there is so much room."""
        panel = self.widget()
        wanted = QSize(0, 0) if panel is None else panel.sizeHint()
        return wanted.expandedTo(self._needed()).boundedTo(self._room)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the panel into the frame."""
        super().resizeEvent(event)
        if self.size() != self._fitted:  # not only the view of the panel, because of a bar
            self._fitted, self._freed = self.size(), 0
            self._fit()

    def event(self, event: QEvent) -> bool:
        """Be laid out anew where the panel needs another size, not at each change in it."""
        done = super().event(event)
        if event.type() == QEvent.Type.LayoutRequest:  # of the panel: it has no other receiver
            self._tell()
            self._fit()
        return done

    def _tell(self) -> None:
        if self._needed().boundedTo(self._room) != self._told:
            self.updateGeometry()

    def _needed(self) -> QSize:
        panel = self.widget()
        if panel is None:
            return QSize(0, 0)
        least, fixed = panel.minimumSizeHint().expandedTo(QSize(0, 0)), panel.minimumSize()
        # As everywhere in Qt, a size that was set takes the place of the one that is computed.
        return QSize(fixed.width() or least.width(), fixed.height() or least.height())

    def _fit(self) -> None:
        """Give the panel the size of the frame, or what it needs, and show the bars for that."""
        panel, whole, needed = self.widget(), self.contentsRect().size(), self._needed()
        if panel is None:
            return
        thick = self.bar_width()
        down = needed.height() > whole.height()
        across = needed.width() > whole.width() - thick * down
        down = needed.height() > whole.height() - thick * across
        if (self._across and not across) or (self._down and not down):
            # A panel that asks for less because of a bar would make it come and go for ever.
            self._freed += 1
            if self._freed > _MOST_FREED:
                across, down = across or self._across, down or self._down
        self._across, self._down = across, down
        on, off = Qt.ScrollBarPolicy.ScrollBarAlwaysOn, Qt.ScrollBarPolicy.ScrollBarAlwaysOff
        self.setHorizontalScrollBarPolicy(on if across else off)
        self.setVerticalScrollBarPolicy(on if down else off)
        view = whole - QSize(thick * down, thick * across)
        panel.resize(view.expandedTo(needed))


def frame_of(panel: QWidget) -> QWidget:
    """Return the frame that a panel is in; the panel itself where it is in none."""
    widget: QWidget | None = panel
    while widget is not None and not isinstance(widget, PanelFrame):
        widget = widget.parentWidget()
    return widget or panel


def scrolled(content: QWidget, *, sideways: bool = False, least: int | None = None) -> QScrollArea:
    """Return an area in which a content is scrolled, ``sideways`` as well or only up and down.

    With ``least`` it is as wide as the content needs, and that many px at least.
    """
    area = QScrollArea() if least is None else FittedScroll(least)
    area.setObjectName("panelScroll")
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setWidgetResizable(True)
    if not sideways:
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(content)
    return area


def keeping_width(widget: QWidget) -> QWidget:
    """Return a widget that stays as wide as it asks for, however much room there is."""
    widget.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
    return widget


def tabbed(name: str, pages: Mapping[str, QWidget]) -> tuple[QTabBar, QStackedWidget]:
    """Return tabs by the titles of pages, and the pages, of which the chosen one is seen."""
    tabs, views = QTabBar(), QStackedWidget()
    tabs.setAccessibleName(name)
    tabs.setExpanding(False)
    tabs.setDrawBase(False)
    for title, page in pages.items():
        tabs.addTab(title)
        views.addWidget(page)
    tabs.currentChanged.connect(views.setCurrentIndex)
    return tabs, views


def lay_beside(
    panel: QWidget, controls: QWidget, width: int, tabs: QTabBar, views: QStackedWidget
) -> None:
    """Lay a panel out: controls at the left, scrolled, at least ``width`` px wide; views beside."""
    right = QVBoxLayout()
    right.setSpacing(4)
    right.addWidget(tabs)
    right.addWidget(views, 1)
    row = QHBoxLayout(panel)
    row.setContentsMargins(10, 6, 10, 6)
    row.addWidget(keeping_width(scrolled(controls, least=width)))
    row.addLayout(right, 1)
