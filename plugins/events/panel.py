"""The Events panel: the operator's log, newest entry first."""

import time

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QListWidget, QListWidgetItem, QPushButton

from rotemina.app.language import marked
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.shell.window import describe_model
from rotemina.app.widgets.controls import make_tooltip, name_widget
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.events import tr
from rotemina.plugins.events.journal import EventJournal, JournalEntry, MachineSnapshot

MAX_SHOWN_ENTRIES = 100
# A symbol in addition to the colour, for operators who cannot tell the colours apart.
_LEVEL_SYMBOLS = {Level.INFO: "·", Level.GOOD: "✓", Level.WARNING: "△", Level.ERROR: "✕"}
_LEVEL_COLOURS = {Level.WARNING: "warning", Level.ERROR: "danger_text", Level.GOOD: "good"}


class EventsPanel(Panel):
    """Panel with a list of all moves, stops, locks, refusals, runs and notices."""

    title = marked("panels", "Events")
    area = PanelArea.RIGHT
    order = 6
    help_page = "window.md#events"
    # The panel is created with the window, so that it records from the beginning.
    at_once = True

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.journal = EventJournal(workbench.robot)
        self._shown_count = self._shown_repeats = 0
        self.entry_list = name_widget(QListWidget(), tr("Events, newest first"))
        self.entry_list.setWordWrap(True)
        self.entry_list.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.entry_list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.entry_list.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.show_log = QPushButton(tr("Show log"))
        self.show_log.setToolTip(tr("All messages of the program, with filter and copy (Ctrl+L)"))
        self.show_log.clicked.connect(lambda: self.main_window.show_log())
        self._lay_out()
        offer_in_palette(self.show_log, safe_while_hidden=True)
        self.follow_frames(self._update_journal)
        workbench.notice_posted.connect(self.journal.add_notice)
        workbench.theme_changed.connect(self._colour_items)

    def _lay_out(self) -> None:
        footer = make_row(1, self.show_log)
        make_column((self.entry_list, 1), footer, on=self, margins=(8, 6, 8, 6), spacing=4)

    def _update_journal(self, state: SessionState) -> None:
        workbench = self.workbench
        recorder = workbench.operation.recording
        self.journal.record_changes(
            MachineSnapshot(
                state,
                workbench.playback.state,
                workbench.operation.penetration.status,
                workbench.plan.name if workbench.plan is not None else "",
                workbench.session.driver.name,
                recorder.writer.path.name if recorder is not None else "",
                describe_model(workbench.session.model),
                time.monotonic(),
            )
        )
        shown_counts = self._shown_count, self._shown_repeats
        if shown_counts != (self.journal.count, self.journal.repeats) and self.isVisible():
            self._show_new_entries()

    def _show_new_entries(self) -> None:
        new_count = min(
            self.journal.count - self._shown_count, len(self.journal.entries), MAX_SHOWN_ENTRIES
        )
        self._shown_count, self._shown_repeats = self.journal.count, self.journal.repeats
        if self.entry_list.count() and new_count < len(self.journal.entries):
            # Replace the newest item as well, because its count may have changed.
            self.entry_list.takeItem(0)
            new_count += 1
        for entry in list(self.journal.entries)[len(self.journal.entries) - new_count :]:
            self.entry_list.insertItem(0, self._make_item(entry))
        while self.entry_list.count() > MAX_SHOWN_ENTRIES:
            self.entry_list.takeItem(self.entry_list.count() - 1)

    def _make_item(self, entry: JournalEntry) -> QListWidgetItem:
        first_line = entry.text.partition("\n")[0]
        count_text = f"  × {entry.count}" if entry.count > 1 else ""
        item = QListWidgetItem(
            f"{entry.time:%H:%M:%S} {_LEVEL_SYMBOLS[entry.level]} {first_line}{count_text}"
        )
        item.setData(Qt.ItemDataRole.UserRole, entry.level)
        item.setToolTip(make_tooltip(f"{entry.time:%Y-%m-%d %H:%M:%S}", *entry.text.splitlines()))
        self._colour_item(item, self.workbench.theme)
        return item

    def _colour_items(self, theme: Theme) -> None:
        for row in range(self.entry_list.count()):
            self._colour_item(self.entry_list.item(row), theme)

    def _colour_item(self, item: QListWidgetItem, theme: Theme) -> None:
        level = Level(item.data(Qt.ItemDataRole.UserRole))
        item.setForeground(QColor(getattr(theme, _LEVEL_COLOURS.get(level, "text"))))
