"""Scroll areas within a panel, and stacked pages."""

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QScrollArea,
    QStackedWidget,
    QTabBar,
    QVBoxLayout,
    QWidget,
)


def scrolled(content: QWidget, *, sideways: bool = False) -> QScrollArea:
    """Return an area in which a content is scrolled, ``sideways`` as well or only up and down."""
    area = QScrollArea()
    area.setObjectName("panelScroll")
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setWidgetResizable(True)
    if not sideways:
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(content)
    return area


def least_width(area: QScrollArea) -> int:
    """Return how wide an area must be for its content and the bar beside it."""
    return area.widget().minimumSizeHint().width() + area.verticalScrollBar().sizeHint().width()


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
    scroll = scrolled(controls)
    scroll.setFixedWidth(max(least_width(scroll), width))
    right = QVBoxLayout()
    right.setSpacing(4)
    right.addWidget(tabs)
    right.addWidget(views, 1)
    row = QHBoxLayout(panel)
    row.setContentsMargins(10, 6, 10, 6)
    row.addWidget(scroll)
    row.addLayout(right, 1)
