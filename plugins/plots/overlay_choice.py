"""Choice and time shift of a second run that is drawn together with the current one."""

from collections.abc import Callable

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox

from rotemina.app.motion.device import HistoryWindow
from rotemina.app.panel import Panel
from rotemina.app.records import LibraryEntry, read_entry
from rotemina.app.shell.records import ask_records
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.workbench import ComparedRun, Level
from rotemina.plugins.plots import tr
from rotemina.plugins.plots.overlay_data import OverlayRun, find_time_shift
from rotemina.sim.records import Record

_NO_OVERLAY, _KEPT_RUN, _LATEST_RUN, _LIBRARY_RECORD = "alone", "kept", "run", "record"


class OverlayChoice(QComboBox):
    """Choice of a second run that is drawn together with the current one.

    ``overlay`` is the chosen run or None. ``shift_s`` is added to its times.

    Parameters
    ----------
    panel : Panel
    shown_window : callable
        Returns the samples that the plots show.
    whole_window : callable
        Returns all samples that the plots can show.

    Signals
    -------
    changed()
        Emitted when the second run or its time shift has changed.
    """

    changed = Signal()

    def __init__(
        self,
        panel: Panel,
        shown_window: Callable[[], HistoryWindow],
        whole_window: Callable[[], HistoryWindow],
    ) -> None:
        super().__init__()
        self.overlay: OverlayRun | None = None
        self.shift_s = 0.0
        self._panel, self._read_shown_window, self._read_whole_window = (
            panel,
            shown_window,
            whole_window,
        )
        self._workbench = panel.workbench
        for choice, text in (
            (_NO_OVERLAY, tr("No other run")),
            (_KEPT_RUN, tr("Keep this run")),
            (_LATEST_RUN, tr("Latest run")),
            (_LIBRARY_RECORD, tr("Record …")),
        ):
            self.addItem(text, choice)
        self.setAccessibleName(tr("Second run, drawn together with the present one"))
        self.setToolTip(
            make_tooltip(
                tr("Keep this run: it stays visible together with the next one."),
                tr("Latest run: the record that was opened or played last."),
                tr("Record …: one of the library."),
            )
        )
        self.activated.connect(lambda _: self._on_chosen())
        self._workbench.run_changed.connect(self._use_latest_run)

    def align(self) -> None:
        """Shift the second run in time so that its commands best match those shown."""
        if self.overlay is None:
            self._workbench.notify(
                Level.WARNING,
                tr("There is no second run to align: choose one."),
                about=self._panel,
                until=lambda _: self.overlay is not None,
            )
            return
        window = self._read_whole_window()
        shift = find_time_shift(window, self.overlay)
        if shift is None and len(window):
            self._workbench.notify(
                Level.INFO,
                tr("{name} has no motion to align by: the ends are aligned.").format(
                    name=self.overlay.name
                ),
            )
            shift = float(window.device_time_s[-1] - self.overlay.time_s[-1])
        self.shift_s = shift or 0.0
        self.changed.emit()

    def _on_chosen(self) -> None:
        choice = self.currentData()
        if choice == _LATEST_RUN:
            self._use_latest_run(self._workbench.run)
            return
        self.overlay = None
        if choice == _LIBRARY_RECORD:
            _ask_record(self._panel, self._use_record)
        if choice == _KEPT_RUN:
            window = self._read_shown_window()
            self._workbench.run_request(lambda: self._keep_run(window))
        self._show_choice()
        self.changed.emit()

    def _keep_run(self, window: HistoryWindow) -> None:
        self.overlay = OverlayRun.from_window(tr("The kept run"), window)
        self.shift_s = 0.0

    def _use_record(self, other: OverlayRun) -> None:
        self.overlay = other
        self.setCurrentIndex(self.findData(_LIBRARY_RECORD))
        self.align()

    def _use_latest_run(self, run: ComparedRun | None) -> None:
        """Use the latest run as the second run, if the operator has chosen that."""
        if self.currentData() != _LATEST_RUN:
            return
        self.overlay = None
        if run is None:
            self._workbench.notify(
                Level.WARNING,
                tr("There is no latest run: open or play one."),
                about=self._panel,
                until=lambda _: self._workbench.run is not None,
            )
            self._show_choice()
            self.changed.emit()
        else:
            self.overlay = OverlayRun.from_record(run.name, run.record, self._workbench.robot)
            self.align()

    def _show_choice(self) -> None:
        if self.overlay is None:
            self.setCurrentIndex(0)


def _ask_record(panel: Panel, use_run: Callable[[OverlayRun], None]) -> None:
    workbench = panel.workbench

    def on_read(entry: LibraryEntry, record: Record) -> None:
        use_run(OverlayRun.from_record(entry.name, record, workbench.robot))

    def read_chosen(entries: tuple[LibraryEntry, ...]) -> None:
        entry = entries[0]
        workbench.read_file(
            "overlay run",
            entry.name,
            lambda: read_entry(entry, workbench.robot),
            lambda record: on_read(entry, record),
        )

    def report_empty_library() -> None:
        text = tr("The library has no records: play or record a motion first.")
        workbench.notify(
            Level.WARNING, text, about=panel, until=lambda _: bool(workbench.library.entries)
        )

    ask_records(
        panel.main_window,
        workbench,
        tr("Record as the second run"),
        read_chosen,
        report_empty_library,
    )
