"""The choice and time shift of another run beside the present one."""

from collections.abc import Callable

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox

from rotemina.app.motion.recent_history import LiveWindow
from rotemina.app.panel import Panel
from rotemina.app.records.entry import Entry
from rotemina.app.records.library import read
from rotemina.app.shell.record_chooser import ask_records
from rotemina.app.shell.workbench import Level, Run
from rotemina.app.widgets.controls import plain_tip
from rotemina.plugins.plots import tr
from rotemina.plugins.plots.overlay_data import OtherRun, alignment
from rotemina.sim.records.record import Record

_ALONE, _KEPT, _IN_HAND, _RECORD = "alone", "kept", "run", "record"


class RunBeside(QComboBox):
    """The choice of a run to be drawn beside the present one.

    ``other`` is that run, or None, and ``shift_s`` what is added to its times. ``shown`` returns
    what is drawn at present, and ``whole`` all that may be.

    Signals
    -------
    changed() : another run, or none, is to be drawn, or the same at other times.
    """

    changed = Signal()

    def __init__(
        self, panel: Panel, shown: Callable[[], LiveWindow], whole: Callable[[], LiveWindow]
    ) -> None:
        super().__init__()
        self.other: OtherRun | None = None
        self.shift_s = 0.0
        self._panel, self._shown, self._whole = panel, shown, whole
        self._workbench = panel.workbench
        for choice, text in (
            (_ALONE, tr("No other run")),
            (_KEPT, tr("Keep this run")),
            (_IN_HAND, tr("Latest run")),
            (_RECORD, tr("Record …")),
        ):
            self.addItem(text, choice)
        self.setAccessibleName(tr("Another run beside the present one"))
        self.setToolTip(
            plain_tip(
                tr("Keep this run: it stays visible beside the next one."),
                tr("Latest run: the record that was opened or played last."),
                tr("Record …: one of the library."),
            )
        )
        self.activated.connect(lambda _: self._choose())
        self._workbench.run_changed.connect(self._take_run)

    def align(self) -> None:
        """Move the other run in time to where its commands are those that are shown."""
        if self.other is None:
            self._workbench.notify(
                Level.WARNING,
                tr("There is no second run to align: choose one."),
                about=self._panel,
                until=lambda _: self.other is not None,
            )
            return
        window = self._whole()
        shift = alignment(window, self.other)
        if shift is None and len(window):
            self._workbench.notify(
                Level.INFO,
                tr("{name} has no motion to align by: the ends are aligned.").format(
                    name=self.other.name
                ),
            )
            shift = float(window.device_time_s[-1] - self.other.time_s[-1])
        self.shift_s = shift or 0.0
        self.changed.emit()

    def _choose(self) -> None:
        chosen = self.currentData()
        if chosen == _IN_HAND:
            self._take_run(self._workbench.run)
            return
        self.other = None
        if chosen == _RECORD:
            _ask_run(self._panel, self._use)
        if chosen == _KEPT:
            window = self._shown()
            self._workbench.ask(lambda: self._keep(window))
        self._show_choice()
        self.changed.emit()

    def _keep(self, window: LiveWindow) -> None:
        self.other = OtherRun.of_window(tr("The kept run"), window)
        self.shift_s = 0.0

    def _use(self, other: OtherRun) -> None:
        """Draw a record of the library beside the present run."""
        self.other = other
        self.setCurrentIndex(self.findData(_RECORD))
        self.align()

    def _take_run(self, run: Run | None) -> None:
        """Put the run in hand beside the present one, where that is chosen."""
        if self.currentData() != _IN_HAND:
            return
        self.other = None
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
            self.other = OtherRun.of_record(run.name, run.record, self._workbench.robot)
            self.align()

    def _show_choice(self) -> None:
        if self.other is None:
            self.setCurrentIndex(0)


def _ask_run(panel: Panel, use: Callable[[OtherRun], None]) -> None:
    """Ask for a record, read it, and hand it on."""
    bench = panel.workbench

    def done(entry: Entry, record: Record) -> None:
        use(OtherRun.of_record(entry.name, record, bench.robot))

    def take(chosen: tuple[Entry, ...]) -> None:
        entry = chosen[0]
        bench.read_file(
            "run beside",
            entry.name,
            lambda: read(entry, bench.robot),
            lambda record: done(entry, record),
        )

    def nothing_there() -> None:
        text = tr("The library has no records: play or record a motion first.")
        bench.notify(Level.WARNING, text, about=panel, until=lambda _: bool(bench.library.entries))

    ask_records(panel.main_window, bench, tr("Record beside the present run"), take, nothing_there)
