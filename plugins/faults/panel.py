"""Past faults, and fault injection."""

from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QSplitter, QWidget

from rotemina.app.files import write_text
from rotemina.app.motion.state import Connection, Event, SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.file_dialog import ask_where
from rotemina.app.shell.language import marked
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.scroll_areas import scrolled
from rotemina.plugins.faults import tr
from rotemina.plugins.faults.fault_history import Entry, History, Kind, as_text
from rotemina.plugins.faults.fault_injection import Injection
from rotemina.plugins.faults.fault_table import HistoryTable


class FaultsPanel(Panel):
    """The history beside the faults that can be injected."""

    title = marked("panels", "Faults")
    area = Area.BOTTOM
    order = 60
    help_page = "faults.md"
    at_once = True  # what goes wrong while the window opens belongs to the history

    _happened = Signal(object, object)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.history, self.table = History(), HistoryTable()
        self.injection = Injection(workbench)
        self._shown: tuple[Entry, ...] = ()
        self.clear_fault = button(tr("Clear fault"), workbench.clear_fault)
        self.copy = button(tr("Copy"), self.copy_all)
        self.save = button(tr("Save …"), self._ask_save)
        self.empty = button(tr("Clear"), self._empty)
        self._lay_out()
        offer_in_palette(self.copy, self.save, safe_while_hidden=True)
        # Told on the session's thread: the time is taken there, not when this window has time.
        self._unsubscribe = workbench.session.subscribe(
            lambda event: self._happened.emit(now(), event)
        )
        self._happened.connect(self._note)
        self.injection.told.connect(self._note_injection)
        workbench.refused.connect(lambda text: self.history.add(now(), Kind.REFUSED, text))
        self.follow(self._refresh)
        workbench.theme_changed.connect(self.table.use_theme)
        workbench.closing.connect(self._unsubscribe)

    def copy_all(self) -> None:
        """Put the chosen rows, or all where none is chosen, on the clipboard."""
        chosen = self.table.chosen() or self.history.entries
        QGuiApplication.clipboard().setText(as_text(chosen))

    def save_to(self, path: Path) -> None:
        """Write the whole history into a text file."""
        text = as_text(self.history.entries)
        self.workbench.write_file("faults", path, lambda: write_text(path, text))

    def _lay_out(self) -> None:
        buttons = in_row(self.clear_fault, 1, self.copy, self.save, self.empty, spacing=6)
        left = QWidget()
        in_column(buttons, (self.table, 1), on=left, margins=(0, 0, 4, 0))
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(left)
        split.addWidget(scrolled(self.injection, least=0))
        split.setSizes([400, 520])
        split.setChildrenCollapsible(False)
        in_column(split, on=self, margins=(10, 8, 10, 8))

    def _refresh(self, state: SessionState) -> None:
        self.history.note_latch(now(), state.latched)
        entries = self.history.entries
        if entries != self._shown:
            self._shown = entries
            with QSignalBlocker(self.table):
                self.table.show_entries(entries, self.workbench.theme)
        allow(self.clear_fault, against_clearing(state), tr("Acknowledge the device's fault"))
        none = None if entries else tr("the list is empty")
        allow(self.copy, none, tr("Copy the selected rows, or all rows, as text (Ctrl+C)"))
        allow(self.save, none, tr("Write all rows into a text file"))
        allow(self.empty, none, tr("Clear all rows"))

    def _note(self, at: datetime, event: Event) -> None:
        self.history.note_event(at, event)

    def _note_injection(self, text: str, about: str, complaint: bool) -> None:
        injected = text.removeprefix("injected: ")
        kind = Kind.NOTE if injected == text else Kind.INJECTED
        self.history.add(now(), Kind.REFUSED if complaint else kind, injected, about)
        if complaint:
            shown = tr(text).replace("{about}", about)
            self.workbench.notify(Level.WARNING, shown, about=self)

    def _empty(self) -> None:
        self.history.clear()

    def _ask_save(self) -> None:
        title, kinds = tr("Save faults"), tr("Text (*.txt)")
        ask_where(self.main_window, self.workbench, title, kinds, "faults.txt", self.save_to)


def against_clearing(state: SessionState) -> str | None:
    """Why no fault can be acknowledged."""
    if state.connection is not Connection.CONNECTED:
        return tr("not connected; reconnect in the panel Connection")
    return None if state.fault is not None else tr("there is no fault")


def now() -> datetime:
    """Return the host's clock as local time."""
    return datetime.now().astimezone()
