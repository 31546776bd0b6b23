"""The command palette: everything that can be done, found by a few letters, without a mouse."""

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

from rotemina.app.shell.fuzzy_match import score
from rotemina.app.shell.header_row import bottom_of_header
from rotemina.app.shell.language import translate
from rotemina.app.shell.palette_entries import Entry
from rotemina.app.widgets.controls import native_keys

_WIDTH, _HEIGHT = 560, 380
_TO_THE_LIST = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)
_UNABLE = 0.7  # what cannot be done now comes after what fits about as well


class Palette(QDialog):
    """A field and the list of what fits it; Enter does the marked.

    First come panels whose title fits, then what has just this name, then the rest.

    What cannot be done now is listed too, with the reason; Enter on it does nothing.

    Parameters
    ----------
    entries : callable
        Returns all that can be done, again whenever the palette is opened.
    parent : QWidget
    """

    def __init__(self, entries: Callable[[], Iterable[Entry]], parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(translate("shell", "Find a command"))
        self._ask = entries
        self._entries: tuple[Entry, ...] = ()
        self._shown: tuple[Entry, ...] = ()
        self.field, self.list = QLineEdit(), QListWidget()
        self.field.setPlaceholderText(translate("shell", "type part of a command"))
        self.field.setAccessibleName(translate("shell", "Part of a command's name"))
        self.field.textChanged.connect(self._show_fitting)
        self.field.installEventFilter(self)
        self.list.setAccessibleName(translate("shell", "Commands"))
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.list.itemClicked.connect(lambda _: self.do())
        self.list.currentRowChanged.connect(self._explain)
        self.reason = QLabel()
        self.reason.setTextFormat(Qt.TextFormat.PlainText)
        self.reason.setWordWrap(True)
        self.reason.setProperty("quiet", True)
        column = QVBoxLayout(self)
        for widget in (self.field, self.list, self.reason):
            column.addWidget(widget)

    def open_anew(self) -> None:
        """Open it with all that can be done now, and nothing typed."""
        self._entries = tuple(self._ask())
        self.field.clear()
        self._show_fitting("")
        self.resize(_WIDTH, _HEIGHT)
        parent = self.parentWidget()
        corner = parent.mapToGlobal(QPoint(0, bottom_of_header(parent)))  # the stops stay free
        self.move(corner.x() + (parent.width() - self.width()) // 2, corner.y())
        self.show()
        self.raise_()
        self.activateWindow()
        self.field.setFocus()

    def do(self) -> None:
        """Close, and do what is marked; what cannot be done leaves it open with the reason."""
        row = self.list.currentRow()
        if row < 0 or self._shown[row].why_not is not None:
            return
        entry = self._shown[row]
        self.hide()
        entry.run()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Hand the keys that walk through the list on to it."""
        if watched is self.field and isinstance(event, QKeyEvent):
            down = event.type() == QEvent.Type.KeyPress
            if down and event.key() in _TO_THE_LIST:
                self.list.event(event)
                return True
            if down and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self.do()
                return True
        return super().eventFilter(watched, event)

    def _show_fitting(self, typed: str) -> None:
        found = []
        for number, entry in enumerate(self._entries):
            fits = score(typed, entry.text)
            if fits is not None:
                worth = fits if entry.why_not is None else _UNABLE * fits
                named = typed.strip().casefold() == entry.what.casefold()
                titled = entry.is_panel and score(typed, entry.what) is not None
                rank = (not titled, not named, -worth, entry.why_not is not None, number)
                found.append((rank, entry))
        found.sort(key=lambda each: each[0])
        self._shown = tuple(entry for _, entry in found)
        self.list.clear()
        for entry in self._shown:
            self.list.addItem(_item(entry))
        self.list.setCurrentRow(0 if self._shown else -1)
        self._explain(self.list.currentRow())

    def _explain(self, row: int) -> None:
        if not 0 <= row < len(self._shown):
            self.reason.setText(
                "" if self._shown else translate("shell", "No command contains these letters.")
            )
            return
        entry = self._shown[row]
        if entry.why_not:
            text = translate("shell", "Not now: {reason}.").format(reason=entry.why_not)
        elif entry.opens:
            text = translate(
                "shell",
                "Press Enter to open {panel}. This may move or switch something, and runs only"
                " while {panel} is visible.",
            ).format(panel=entry.opens)
        else:
            text = translate("shell", "Press Enter to run it.")
        self.reason.setText(text)


def _item(entry: Entry) -> QListWidgetItem:
    keys = f"   [{native_keys(entry.shortcut)}]" if entry.shortcut else ""
    why = (
        translate("shell", "   – not now: {why_not}").format(why_not=entry.why_not)
        if entry.why_not
        else ""
    )
    item = QListWidgetItem(f"{entry.text}{keys}{why}")
    item.setToolTip("")
    if entry.why_not is not None:
        font = item.font()
        font.setItalic(True)
        item.setFont(font)
    return item
