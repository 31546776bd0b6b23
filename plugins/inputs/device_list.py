"""The connected devices, which one is in control, and their problems."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QLabel, QListWidget, QListWidgetItem, QWidget

from rotemina.app.widgets.controls import named, plain_tip
from rotemina.app.widgets.labels import plain_text, show_text
from rotemina.app.widgets.layouts import in_column
from rotemina.app.widgets.section import Section, clear
from rotemina.app.widgets.when_dressed import WhenDressed
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.words import Entry, Trouble

_MOST_ROWS = 4
_ROOM = 6


class DeviceList(Section):
    """The devices, one of which is examined."""

    def __init__(self) -> None:
        super().__init__(tr("Devices"))
        self.none = self.add_text()
        show_text(self.none, tr("No device. A device that is plugged in appears within a second."))
        self.list = named(QListWidget(), tr("Connected input devices"))
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.list.currentItemChanged.connect(lambda *_: self._pick())
        self.column.addWidget(self.list)
        self._entries: tuple[Entry, ...] = ()
        self._picked = ""  # by somebody; until then the first one is looked at
        WhenDressed(self.list, self._fit)

    @property
    def key(self) -> str:
        """The device that is examined; empty: there is none."""
        item = self.list.currentItem()
        return "" if item is None else str(item.data(Qt.ItemDataRole.UserRole))

    def show_entries(self, entries: tuple[Entry, ...]) -> None:
        """Show other devices; the one that is examined stays."""
        if entries == self._entries:
            return
        same = [one.key for one in entries] == [one.key for one in self._entries]
        self._entries = entries
        if not same:
            self._fill(entries)
        for row, entry in enumerate(entries):
            item = self.list.item(row)
            item.setText(f"{entry.name}  –  {entry.standing}\n{entry.key}")
            item.setToolTip(plain_tip(entry.name, entry.key, entry.standing, entry.problem or ""))
        self.none.setVisible(not entries)
        self.list.setVisible(bool(entries))
        self._fit()

    def _fit(self) -> None:
        rows = min(len(self._entries), _MOST_ROWS)
        self.list.setFixedHeight(rows * self.list.sizeHintForRow(0) + _ROOM)

    def _fill(self, entries: tuple[Entry, ...]) -> None:
        self.list.blockSignals(True)
        self.list.clear()
        for entry in entries:
            item = QListWidgetItem(self.list)
            item.setData(Qt.ItemDataRole.UserRole, entry.key)
        keys = [entry.key for entry in entries]
        self.list.setCurrentRow(keys.index(self._picked) if self._picked in keys else 0)
        self.list.blockSignals(False)

    def _pick(self) -> None:
        self._picked = self.key


class Troubles(QWidget):
    """Problems, each in a frame."""

    def __init__(self) -> None:
        super().__init__()
        self._column = in_column(on=self, margins=0, spacing=4)
        self._shown: tuple[Trouble, ...] = ()

    def show_troubles(self, troubles: tuple[Trouble, ...]) -> None:
        """Show the present problems."""
        if troubles == self._shown:
            return
        self._shown = troubles
        clear(self._column)
        for trouble in troubles:
            self._column.addWidget(_frame(trouble))

    @property
    def text(self) -> str:
        """All of it."""
        return "\n".join(one.text for one in self._shown)


def _frame(trouble: Trouble) -> QFrame:
    frame = QFrame()
    frame.setObjectName("question")
    column = in_column(on=frame, margins=(8, 5, 8, 6))
    for words in (trouble.text, trouble.remedy):
        if words:
            column.addWidget(_selectable(words))
    return frame


def _selectable(words: str) -> QLabel:
    text = plain_text(words, quiet=False, wrap=True)
    text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return text
