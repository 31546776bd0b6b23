"""A column of widgets with a heading, the building block of most panels."""

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QLayout, QVBoxLayout, QWidget

from rotemina.app.widgets.text import ElidedLabel, make_plain_label
from rotemina.sim.compatibility import serve_former_names


class Section(QFrame):
    """Column of widgets, with a heading if it has a title."""

    def __init__(self, title: str = "") -> None:
        super().__init__()
        self.setObjectName("section")
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(0, 4, 0, 8)
        self.column.setSpacing(6)
        self.heading = ElidedLabel()
        self.heading.setProperty("heading", True)
        self.heading.show_text(title)
        if title:
            self.column.addWidget(self.heading)

    def add_row(self, *widgets: QWidget, equal: bool = True) -> QHBoxLayout:
        """Add widgets side by side, of equal width or with the first one taking the rest."""
        row = QHBoxLayout()
        row.setSpacing(6)
        for number, widget in enumerate(widgets):
            row.addWidget(widget, 1 if equal or number == 0 else 0)
        self.column.addLayout(row)
        return row

    def add_text(self) -> QLabel:
        """Add a quiet text of several lines."""
        text = make_plain_label(wrap=True)
        self.column.addWidget(text)
        return text


def clear_layout(layout: QLayout) -> None:
    """Remove and delete all widgets of a layout."""
    while (item := layout.takeAt(0)) is not None:
        widget = item.widget()
        if widget is not None:
            widget.hide()
            widget.deleteLater()


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        clear="clear_layout",
    )
