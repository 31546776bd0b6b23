"""The command palette: all commands, found by a few letters and without a mouse."""

from collections.abc import Callable, Iterable

from PySide6.QtCore import QEvent, QObject, QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QDialog,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.language import translate
from rotemina.app.shell.notices import find_header_bottom
from rotemina.app.shell.window.palette_entries import PaletteEntry
from rotemina.app.shell.window.palette_search import find_entries
from rotemina.app.widgets.controls import format_shortcut

_WIDTH_PX, _HEIGHT_PX = 560, 380
_LIST_KEYS = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)


class CommandPalette(QDialog):
    """Field with a list of the matching entries; Enter runs the selected one.

    Panels with a matching title come first, then entries whose title is exactly the typed text,
    then the others. Entries that cannot run now are listed with the reason; Enter has no effect on
    them.

    Parameters
    ----------
    entries : callable
        Returns all entries; called whenever the palette is opened.
    parent : QWidget
    """

    def __init__(self, entries: Callable[[], Iterable[PaletteEntry]], parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Find a command"))
        self._make_entries = entries
        self._entries: tuple[PaletteEntry, ...] = ()
        self._shown: tuple[PaletteEntry, ...] = ()
        self.field, self.list = QLineEdit(), QListWidget()
        self.field.setPlaceholderText(translate("shell", "type part of a command"))
        self.field.setAccessibleName(translate("shell", "Part of a command's name"))
        self.field.textChanged.connect(self._show_matches)
        self.field.installEventFilter(self)
        self.list.setAccessibleName(translate("shell", "Commands"))
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.list.itemClicked.connect(lambda _: self.run_selected())
        self.list.currentRowChanged.connect(self._show_hint)
        self.reason = QLabel()
        self.reason.setTextFormat(Qt.TextFormat.PlainText)
        self.reason.setWordWrap(True)
        self.reason.setProperty("quiet", True)
        column = QVBoxLayout(self)
        for widget in (self.field, self.list, self.reason):
            column.addWidget(widget)

    def open_cleared(self) -> None:
        """Open the palette with the current entries and an empty field."""
        self._entries = tuple(self._make_entries())
        self.field.clear()
        self._show_matches("")
        self.resize(_WIDTH_PX, _HEIGHT_PX)
        parent = self.parentWidget()
        # The palette is placed below the header, so that the stop buttons stay visible.
        corner = parent.mapToGlobal(QPoint(0, find_header_bottom(parent)))
        self.move(corner.x() + (parent.width() - self.width()) // 2, corner.y())
        self.show()
        self.raise_()
        self.activateWindow()
        self.field.setFocus()

    def run_selected(self) -> None:
        """Close the palette and run the selected entry; do nothing if it cannot run now."""
        row = self.list.currentRow()
        if row < 0 or self._shown[row].objection is not None:
            return
        entry = self._shown[row]
        self.hide()
        entry.run()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Run the selected entry on Enter; pass the keys that move the selection to the list."""
        if watched is self.field and isinstance(event, QKeyEvent):
            is_press = event.type() == QEvent.Type.KeyPress
            if is_press and event.key() in _LIST_KEYS:
                self.list.event(event)
                return True
            if is_press and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self.run_selected()
                return True
        return super().eventFilter(watched, event)

    def _show_matches(self, search_text: str) -> None:
        self._shown = find_entries(search_text, self._entries)
        self.list.clear()
        for entry in self._shown:
            self.list.addItem(_make_item(entry))
        self.list.setCurrentRow(0 if self._shown else -1)
        self._show_hint(self.list.currentRow())

    def _show_hint(self, row: int) -> None:
        if not 0 <= row < len(self._shown):
            self.reason.setText(
                "" if self._shown else translate("shell", "No command contains these letters.")
            )
            return
        entry = self._shown[row]
        if entry.objection:
            text = translate("shell", "Not now: {reason}.").format(reason=entry.objection)
        elif entry.opens:
            text = translate(
                "shell",
                "Press Enter to open {panel}. This may move or switch something, and runs only"
                " while {panel} is visible.",
            ).format(panel=entry.opens)
        else:
            text = translate("shell", "Press Enter to run it.")
        self.reason.setText(text)


def _make_item(entry: PaletteEntry) -> QListWidgetItem:
    keys = f"   [{format_shortcut(entry.shortcut)}]" if entry.shortcut else ""
    reason = (
        translate("shell", "   – not now: {why_not}").format(why_not=entry.objection)
        if entry.objection
        else ""
    )
    item = QListWidgetItem(f"{entry.text}{keys}{reason}")
    item.setToolTip("")
    if entry.objection is not None:
        font = item.font()
        font.setItalic(True)
        item.setFont(font)
    return item
