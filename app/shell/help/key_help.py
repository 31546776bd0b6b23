"""The list of all keyboard shortcuts, taken from the actions that have them."""

from collections.abc import Iterable
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QDialog, QLabel, QScrollArea, QVBoxLayout, QWidget

from rotemina.app.language import marked, translate

#: Keys that have no ``QAction``, because they work wherever the focus is.
GLOBAL_KEYS = (
    ("Esc", marked("shell", "Stop all axes and hold their positions; a software stop")),
    (
        "Shift+Esc",
        marked("shell", "Stop and lock: nothing moves until release; a software stop"),
    ),
)


def list_shortcuts(actions: Iterable[QAction]) -> list[tuple[str, str]]:
    """Return each shortcut in readable form with its description, the stop keys first."""
    rows = [(key, translate("shell", description)) for key, description in GLOBAL_KEYS]
    for action in actions:
        description = action.text().replace("&", "").removesuffix(" …")
        if action.statusTip():
            description = f"{description} ({action.statusTip()})"
        for shortcut in action.shortcuts():
            rows.append((shortcut.toString(QKeySequence.SequenceFormat.NativeText), description))
    return rows


class ShortcutsDialog(QDialog):
    """Window that lists the shortcuts."""

    def __init__(self, rows: Iterable[tuple[str, str]], parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(translate("shell", "Keys"))
        self.table = QLabel(_make_table(rows))
        self.table.setTextFormat(Qt.TextFormat.RichText)
        self.table.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.table.setContentsMargins(12, 8, 12, 8)
        self.table.setWordWrap(True)
        self.table.setAlignment(Qt.AlignmentFlag.AlignTop)
        area = QScrollArea()
        area.setObjectName("panelScroll")
        area.setWidgetResizable(True)
        area.setWidget(self.table)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(area)
        self.resize(600, 520)


def _make_table(rows: Iterable[tuple[str, str]]) -> str:
    lines = (
        f"<tr><td style='padding: 2px 18px 2px 0'><b>{escape(key)}</b></td>"
        f"<td style='padding: 2px 0'>{escape(description)}</td></tr>"
        for key, description in rows
    )
    return f"<table>{''.join(lines)}</table>"
