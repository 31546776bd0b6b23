"""Names and values in two columns."""

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from rotemina.app.widgets.controls import make_tooltip, set_property
from rotemina.app.widgets.style import reserve_width


class ValueGrid(QWidget):
    """Grid of names and values.

    ``names`` maps each visible name to a sentence that explains it, or to "". Each value has
    space for the text ``widest``. ``spacing`` between rows is in px.
    """

    def __init__(self, names: Mapping[str, str], *, widest: str = "", spacing: int = 3) -> None:
        super().__init__()
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(10)
        grid.setVerticalSpacing(spacing)
        grid.setColumnStretch(1, 1)
        self.values: dict[str, QLabel] = {}
        for row, (name, about) in enumerate(names.items()):
            title, value = QLabel(name), QLabel("–")
            title.setProperty("quiet", True)
            value.setTextFormat(Qt.TextFormat.PlainText)
            value.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            value.setAccessibleName(name)
            if about:
                for widget in (title, value):
                    widget.setToolTip(make_tooltip(about))
            grid.addWidget(title, row, 0)
            grid.addWidget(value, row, 1)
            self.values[name] = value
            reserve_width(value, widest)

    def show_values(self, *texts: str) -> None:
        """Show texts in the order of the names."""
        for value, text in zip(self.values.values(), texts, strict=True):
            value.setText(text)

    def set_stale(self, stale: bool) -> None:
        """Draw the values in grey if they are out of date."""
        for value in self.values.values():
            set_property(value, "stale", stale)
