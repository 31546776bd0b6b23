"""Lists of the connected devices with their status, and of their problems."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QLabel, QListWidget, QListWidgetItem, QWidget

from rotemina.app.widgets.controls import make_tooltip, name_widget
from rotemina.app.widgets.layout import Section, clear_layout, make_column
from rotemina.app.widgets.style import OnStyleChange
from rotemina.app.widgets.text import make_plain_label, show_or_hide_text
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.words import DeviceEntry, InputProblem

_MAX_VISIBLE_ROWS = 4
# The total height of the frame above and below the rows.
_FRAME_HEIGHT_PX = 6


class DeviceList(Section):
    """Section with the list of devices. The panel shows the details of the selected device."""

    def __init__(self) -> None:
        super().__init__(tr("Devices"))
        self.empty_text = self.add_text()
        show_or_hide_text(
            self.empty_text, tr("No device. A device that is plugged in appears within a second.")
        )
        self.list = name_widget(QListWidget(), tr("Connected input devices"))
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.list.currentItemChanged.connect(lambda *_: self._on_selected())
        self.column.addWidget(self.list)
        self._entries: tuple[DeviceEntry, ...] = ()
        # The key of the device that the operator has selected. Until then, the first device is
        # selected.
        self._selected_key = ""
        OnStyleChange(self.list, self._fit_height)

    @property
    def device_key(self) -> str:
        """The key of the selected device, or "" if there is none."""
        item = self.list.currentItem()
        return "" if item is None else str(item.data(Qt.ItemDataRole.UserRole))

    def show_entries(self, entries: tuple[DeviceEntry, ...]) -> None:
        """Show the devices. The selected device stays selected."""
        if entries == self._entries:
            return
        has_same_keys = [entry.key for entry in entries] == [entry.key for entry in self._entries]
        self._entries = entries
        if not has_same_keys:
            self._fill_list(entries)
        for row, entry in enumerate(entries):
            item = self.list.item(row)
            item.setText(f"{entry.name}  –  {entry.status}\n{entry.key}")
            item.setToolTip(make_tooltip(entry.name, entry.key, entry.status, entry.problem or ""))
        self.empty_text.setVisible(not entries)
        self.list.setVisible(bool(entries))
        self._fit_height()

    def _fit_height(self) -> None:
        rows = min(len(self._entries), _MAX_VISIBLE_ROWS)
        self.list.setFixedHeight(rows * self.list.sizeHintForRow(0) + _FRAME_HEIGHT_PX)

    def _fill_list(self, entries: tuple[DeviceEntry, ...]) -> None:
        self.list.blockSignals(True)
        self.list.clear()
        for entry in entries:
            item = QListWidgetItem(self.list)
            item.setData(Qt.ItemDataRole.UserRole, entry.key)
        keys = [entry.key for entry in entries]
        self.list.setCurrentRow(keys.index(self._selected_key) if self._selected_key in keys else 0)
        self.list.blockSignals(False)

    def _on_selected(self) -> None:
        self._selected_key = self.device_key


class ProblemList(QWidget):
    """List of problems, each in a frame."""

    def __init__(self) -> None:
        super().__init__()
        self._column = make_column(on=self, margins=0, spacing=4)
        self._problems: tuple[InputProblem, ...] = ()

    def show_problems(self, problems: tuple[InputProblem, ...]) -> None:
        """Show the current problems."""
        if problems == self._problems:
            return
        self._problems = problems
        clear_layout(self._column)
        for problem in problems:
            self._column.addWidget(_make_frame(problem))

    @property
    def text(self) -> str:
        """The texts of all problems, one per line."""
        return "\n".join(problem.text for problem in self._problems)


def _make_frame(problem: InputProblem) -> QFrame:
    frame = QFrame()
    frame.setObjectName("question")
    column = make_column(on=frame, margins=(8, 5, 8, 6))
    for text in (problem.text, problem.remedy):
        if text:
            column.addWidget(_make_selectable_label(text))
    return frame


def _make_selectable_label(text: str) -> QLabel:
    label = make_plain_label(text, quiet=False, wrap=True)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label
