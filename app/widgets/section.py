"""A headed column of widgets, the building block of most panels."""

from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QLayout, QVBoxLayout, QWidget

from rotemina.app.widgets.labels import ElidedLabel, plain_text


class Section(QFrame):
    """A heading, if it has one, over a column of widgets."""

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
        """Add widgets side by side; they share the width, or the first takes what is left."""
        row = QHBoxLayout()
        row.setSpacing(6)
        for number, widget in enumerate(widgets):
            row.addWidget(widget, 1 if equal or number == 0 else 0)
        self.column.addLayout(row)
        return row

    def add_text(self) -> QLabel:
        """Add a quiet text of several lines."""
        text = plain_text(wrap=True)
        self.column.addWidget(text)
        return text


def clear(layout: QLayout) -> None:
    """Take everything out of a layout."""
    while (item := layout.takeAt(0)) is not None:
        widget = item.widget()
        if widget is not None:
            widget.hide()
            widget.deleteLater()
