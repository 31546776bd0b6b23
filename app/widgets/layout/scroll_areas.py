"""Scroll areas inside panels, the scrolling frame of a panel, and tabbed pages."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

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

from rotemina.sim.compatibility import FormerMember, serve_former_names

# At one size of the frame, scroll bars may be removed this often; afterwards they stay.
_MAX_BAR_REMOVALS = 3


class FittedScrollArea(QScrollArea):
    """Scroll area that only scrolls vertically and is as wide as its content and the scroll bar.

    ``min_width`` is its smallest width, px.
    """

    def __init__(self, min_width: int = 0) -> None:
        super().__init__()
        self._min_width = self._requested = min_width

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request the width of the content at the current text size."""
        self._requested = self._compute_min_width()
        return QSize(self._requested, super().minimumSizeHint().height())

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request no more than the minimum width."""
        return QSize(self.minimumSizeHint().width(), super().sizeHint().height())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Request a new layout only if the content needs another width."""
        if (
            event.type() == QEvent.Type.LayoutRequest
            and self._compute_min_width() != self._requested
        ):
            self.updateGeometry()
        return super().eventFilter(watched, event)

    def _compute_min_width(self) -> int:
        content = self.widget()
        if content is None:
            return self._min_width
        bar_width = self.verticalScrollBar().sizeHint().width()
        return max(content.minimumSizeHint().width() + bar_width, self._min_width)


class PanelFrame(QScrollArea):
    """Frame that scrolls its panel if space is short, so that no panel can enlarge the window."""

    def __init__(self, panel: QWidget, room: QSize) -> None:
        super().__init__()
        self._room = room
        self._requested = self._fitted_size = QSize()
        self._has_horizontal_bar = self._has_vertical_bar = False
        # How often a scroll bar was removed at the current size.
        self._removal_count = 0
        self.setObjectName("panelScroll")
        self.setFrameShape(QFrame.Shape.NoFrame)
        # The keyboard focus belongs to the panel itself.
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWidget(panel)

    def bar_width_px(self) -> int:
        """Return the thickness of a scroll bar, px."""
        return self.verticalScrollBar().sizeHint().width()

    def set_room(self, room: QSize) -> None:
        """Set the largest size that the frame requests, px."""
        self._room = room
        self._update_size_hint()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request what the panel needs, up to the available space."""
        self._requested = self._compute_min_size().boundedTo(self._room)
        return self._requested

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request what the panel prefers, up to the available space."""
        panel = self.widget()
        preferred = QSize(0, 0) if panel is None else panel.sizeHint()
        return preferred.expandedTo(self._compute_min_size()).boundedTo(self._room)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the panel into the frame."""
        super().resizeEvent(event)
        # The event also occurs when only a scroll bar has changed the viewport.
        if self.size() != self._fitted_size:
            self._fitted_size, self._removal_count = self.size(), 0
            self._fit_panel()

    def event(self, event: QEvent) -> bool:
        """Request a new layout only if the panel needs another size."""
        was_handled = super().event(event)
        # The event comes from the panel, because the frame contains nothing else.
        if event.type() == QEvent.Type.LayoutRequest:
            self._update_size_hint()
            self._fit_panel()
        return was_handled

    def _update_size_hint(self) -> None:
        if self._compute_min_size().boundedTo(self._room) != self._requested:
            self.updateGeometry()

    def _compute_min_size(self) -> QSize:
        panel = self.widget()
        if panel is None:
            return QSize(0, 0)
        hint, set_size = panel.minimumSizeHint().expandedTo(QSize(0, 0)), panel.minimumSize()
        # As everywhere in Qt, a size that was set explicitly replaces the computed one.
        return QSize(set_size.width() or hint.width(), set_size.height() or hint.height())

    def _fit_panel(self) -> None:
        panel, frame_size, needed_size = (
            self.widget(),
            self.contentsRect().size(),
            self._compute_min_size(),
        )
        if panel is None:
            return
        bar_width = self.bar_width_px()
        needs_vertical = needed_size.height() > frame_size.height()
        needs_horizontal = needed_size.width() > frame_size.width() - bar_width * needs_vertical
        needs_vertical = needed_size.height() > frame_size.height() - bar_width * needs_horizontal
        if (self._has_horizontal_bar and not needs_horizontal) or (
            self._has_vertical_bar and not needs_vertical
        ):
            # Otherwise the bars of a panel that needs less space when they are shown would appear
            # and disappear forever.
            self._removal_count += 1
            if self._removal_count > _MAX_BAR_REMOVALS:
                needs_horizontal, needs_vertical = (
                    needs_horizontal or self._has_horizontal_bar,
                    needs_vertical or self._has_vertical_bar,
                )
        self._has_horizontal_bar, self._has_vertical_bar = needs_horizontal, needs_vertical
        shown, hidden = Qt.ScrollBarPolicy.ScrollBarAlwaysOn, Qt.ScrollBarPolicy.ScrollBarAlwaysOff
        self.setHorizontalScrollBarPolicy(shown if needs_horizontal else hidden)
        self.setVerticalScrollBarPolicy(shown if needs_vertical else hidden)
        view_size = frame_size - QSize(bar_width * needs_vertical, bar_width * needs_horizontal)
        panel.resize(view_size.expandedTo(needed_size))

    # Former names, which work for one more release.
    bar_width = FormerMember("bar_width_px")
    give_room = FormerMember("set_room")


def find_frame(panel: QWidget) -> QWidget:
    """Return the frame that contains a panel, or the panel itself if it is in none."""
    widget: QWidget | None = panel
    while widget is not None and not isinstance(widget, PanelFrame):
        widget = widget.parentWidget()
    return widget or panel


def make_scroll_area(
    content: QWidget, *, sideways: bool = False, min_width: int | None = None
) -> QScrollArea:
    """Return a scroll area that scrolls vertically, and with ``sideways`` also horizontally.

    With ``min_width``, px, it is as wide as the content needs, but not narrower than that.
    """
    area = QScrollArea() if min_width is None else FittedScrollArea(min_width)
    area.setObjectName("panelScroll")
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setWidgetResizable(True)
    if not sideways:
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(content)
    return area


def fix_width(widget: QWidget) -> QWidget:
    """Fix the width of a widget to the width that it requests, and return the widget."""
    widget.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
    return widget


def make_tabs(name: str, pages: Mapping[str, QWidget]) -> tuple[QTabBar, QStackedWidget]:
    """Return a tab bar with the titles of pages, and a stack that shows the selected page."""
    tabs, views = QTabBar(), QStackedWidget()
    tabs.setAccessibleName(name)
    tabs.setExpanding(False)
    tabs.setDrawBase(False)
    for title, page in pages.items():
        tabs.addTab(title)
        views.addWidget(page)
    tabs.currentChanged.connect(views.setCurrentIndex)
    return tabs, views


def lay_out_with_controls(
    panel: QWidget, controls: QWidget, width: int, tabs: QTabBar, views: QStackedWidget
) -> None:
    """Lay out a panel: scrolled controls at the left, and tabs with views at the right.

    The controls are at least ``width`` px wide.
    """
    right = QVBoxLayout()
    right.setSpacing(4)
    right.addWidget(tabs)
    right.addWidget(views, 1)
    row = QHBoxLayout(panel)
    row.setContentsMargins(10, 6, 10, 6)
    row.addWidget(fix_width(make_scroll_area(controls, min_width=width)))
    row.addLayout(right, 1)


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        FittedScroll="FittedScrollArea",
        frame_of="find_frame",
        keeping_width="fix_width",
        lay_beside="lay_out_with_controls",
        scrolled="make_scroll_area",
        tabbed="make_tabs",
    )
