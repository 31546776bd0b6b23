"""Events: the operator's log, the newest first."""

import time

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QAbstractItemView, QListWidget, QListWidgetItem, QPushButton

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.language import marked
from rotemina.app.shell.model_chip import model_name
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import named, plain_tip
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.events import tr
from rotemina.plugins.events.journal import Entry, Journal, Moment

MOST_SHOWN = 100
# A sign beside the colour, for eyes that do not tell it.
_SIGNS = {Level.INFO: "·", Level.GOOD: "✓", Level.WARNING: "△", Level.ERROR: "✕"}
_ROLES = {Level.WARNING: "warning", Level.ERROR: "danger_text", Level.GOOD: "good"}


class EventsPanel(Panel):
    """What happened at the machine and what was told: each move, stop, lock, refusal and run."""

    title = marked("panels", "Events")
    area = Area.RIGHT
    order = 6
    help_page = "window.md#events"
    at_once = True  # it keeps what happens

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.journal = Journal(workbench.robot)
        self._shown = self._shown_repeats = 0
        self.list = named(QListWidget(), tr("Events, newest first"))
        self.list.setWordWrap(True)
        self.list.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.show_log = QPushButton(tr("Show log"))
        self.show_log.setToolTip(tr("All messages of the program, with filter and copy (Ctrl+L)"))
        self.show_log.clicked.connect(lambda: self.main_window.show_log())
        self._lay_out()
        offer_in_palette(self.show_log, safe_while_hidden=True)
        self.follow_frames(self._look)
        workbench.noticed.connect(self.journal.tell_notice)
        workbench.theme_changed.connect(self._colour)

    def _lay_out(self) -> None:
        foot = in_row(1, self.show_log)
        in_column((self.list, 1), foot, on=self, margins=(8, 6, 8, 6), spacing=4)

    def _look(self, state: SessionState) -> None:
        bench = self.workbench
        recorder = bench.operation.recording
        self.journal.look(
            Moment(
                state,
                bench.playback.state,
                bench.operation.penetration.status,
                bench.plan.name if bench.plan is not None else "",
                bench.session.driver.name,
                recorder.writer.path.name if recorder is not None else "",
                model_name(bench.session.model),
                time.monotonic(),
            )
        )
        shown = self._shown, self._shown_repeats
        if shown != (self.journal.count, self.journal.repeats) and self.isVisible():
            self._show_new()

    def _show_new(self) -> None:
        new = min(self.journal.count - self._shown, len(self.journal.entries), MOST_SHOWN)
        self._shown, self._shown_repeats = self.journal.count, self.journal.repeats
        if self.list.count() and new < len(self.journal.entries):
            self.list.takeItem(0)  # it may have been repeated
            new += 1
        for entry in list(self.journal.entries)[len(self.journal.entries) - new :]:
            self.list.insertItem(0, self._item(entry))
        while self.list.count() > MOST_SHOWN:
            self.list.takeItem(self.list.count() - 1)

    def _item(self, entry: Entry) -> QListWidgetItem:
        first_line = entry.text.partition("\n")[0]
        tally = f"  × {entry.count}" if entry.count > 1 else ""
        item = QListWidgetItem(f"{entry.time:%H:%M:%S} {_SIGNS[entry.level]} {first_line}{tally}")
        item.setData(Qt.ItemDataRole.UserRole, entry.level)
        item.setToolTip(plain_tip(f"{entry.time:%Y-%m-%d %H:%M:%S}", *entry.text.splitlines()))
        self._colour_item(item, self.workbench.theme)
        return item

    def _colour(self, theme: Theme) -> None:
        for row in range(self.list.count()):
            self._colour_item(self.list.item(row), theme)

    def _colour_item(self, item: QListWidgetItem, theme: Theme) -> None:
        level = Level(item.data(Qt.ItemDataRole.UserRole))
        item.setForeground(QColor(getattr(theme, _ROLES.get(level, "text"))))
