"""The Faults panel: the fault history, and fault injection."""

from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QSplitter, QWidget

from rotemina.app.language import marked
from rotemina.app.motion.state import (
    ConnectionState,
    SessionEvent,
    SessionState,
)
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.settings import write_text
from rotemina.app.shell.records import ask_save_path
from rotemina.app.widgets.controls import enable_unless, make_button
from rotemina.app.widgets.layout import make_column, make_row, make_scroll_area
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.faults import tr
from rotemina.plugins.faults.fault_history import (
    FaultEntry,
    FaultHistory,
    FaultKind,
    format_entries,
)
from rotemina.plugins.faults.fault_injection import FaultInjectionView
from rotemina.plugins.faults.fault_table import FaultTable


class FaultsPanel(Panel):
    """Panel with the fault history on the left and fault injection on the right."""

    title = marked("panels", "Faults")
    area = PanelArea.BOTTOM
    order = 60
    help_page = "faults.md"
    # The panel is created with the window, so that the history contains faults during the start.
    at_once = True

    _event_received = Signal(object, object)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.history, self.table = FaultHistory(), FaultTable()
        self.injection = FaultInjectionView(workbench)
        self._shown_entries: tuple[FaultEntry, ...] = ()
        self.clear_fault = make_button(tr("Clear fault"), workbench.clear_fault)
        self.copy = make_button(tr("Copy"), self.copy_rows)
        self.save = make_button(tr("Save …"), self._ask_save)
        self.clear_rows = make_button(tr("Clear"), self._clear_history)
        self._lay_out()
        offer_in_palette(self.copy, self.save, safe_while_hidden=True)
        # Events arrive on the session's thread. The time is read there, because the window may
        # handle the events later.
        self._unsubscribe = workbench.session.subscribe(
            lambda event: self._event_received.emit(read_local_time(), event)
        )
        self._event_received.connect(self._record_event)
        self.injection.reported.connect(self._record_injection)
        workbench.refused.connect(
            lambda text: self.history.add(read_local_time(), FaultKind.REFUSED, text)
        )
        self.follow(self._refresh)
        workbench.theme_changed.connect(self.table.use_theme)
        workbench.closing.connect(self._unsubscribe)

    def copy_rows(self) -> None:
        """Copy the selected rows, or all rows if none is selected, to the clipboard."""
        entries = self.table.list_selected_entries() or self.history.entries
        QGuiApplication.clipboard().setText(format_entries(entries))

    def save_to(self, path: Path) -> None:
        """Write the whole history to a text file."""
        text = format_entries(self.history.entries)
        self.workbench.write_file("faults", path, lambda: write_text(path, text))

    def _lay_out(self) -> None:
        buttons = make_row(self.clear_fault, 1, self.copy, self.save, self.clear_rows, spacing=6)
        left = QWidget()
        make_column(buttons, (self.table, 1), on=left, margins=(0, 0, 4, 0))
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(left)
        split.addWidget(make_scroll_area(self.injection, min_width=0))
        split.setSizes([400, 520])
        split.setChildrenCollapsible(False)
        make_column(split, on=self, margins=(10, 8, 10, 8))

    def _refresh(self, state: SessionState) -> None:
        self.history.record_latch(read_local_time(), state.latch_reason)
        entries = self.history.entries
        if entries != self._shown_entries:
            self._shown_entries = entries
            with QSignalBlocker(self.table):
                self.table.show_entries(entries, self.workbench.theme)
        enable_unless(
            self.clear_fault,
            find_acknowledge_objection(state),
            tr("Acknowledge the device's fault"),
        )
        empty_reason = None if entries else tr("the list is empty")
        enable_unless(
            self.copy, empty_reason, tr("Copy the selected rows, or all rows, as text (Ctrl+C)")
        )
        enable_unless(self.save, empty_reason, tr("Write all rows to a text file"))
        enable_unless(self.clear_rows, empty_reason, tr("Clear all rows"))

    def _record_event(self, at: datetime, event: SessionEvent) -> None:
        self.history.record_event(at, event)

    def _record_injection(self, text: str, about: str, is_error: bool) -> None:
        entry_text = text.removeprefix("injected: ")
        kind = FaultKind.NOTE if entry_text == text else FaultKind.INJECTED
        self.history.add(
            read_local_time(), FaultKind.REFUSED if is_error else kind, entry_text, about
        )
        if is_error:
            message = tr(text).replace("{about}", about)
            self.workbench.notify(Level.WARNING, message, about=self)

    def _clear_history(self) -> None:
        self.history.clear()

    def _ask_save(self) -> None:
        title, file_filter = tr("Save faults"), tr("Text (*.txt)")
        ask_save_path(
            self.main_window, self.workbench, title, file_filter, "faults.txt", self.save_to
        )


def find_acknowledge_objection(state: SessionState) -> str | None:
    """Return why no fault can be acknowledged, or None."""
    if state.connection is not ConnectionState.CONNECTED:
        return tr("not connected; reconnect in the Connection panel")
    return None if state.fault is not None else tr("there is no fault")


def read_local_time() -> datetime:
    """Return the local time of this computer."""
    return datetime.now().astimezone()
