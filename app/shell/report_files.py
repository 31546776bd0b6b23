"""Reports as files: where to, written in the background, opened when done."""

from collections.abc import Callable, Iterable
from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QWidget

from rotemina.app.files import write_text
from rotemina.app.motion.compared_run import compared
from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import SUFFIX
from rotemina.app.records.entry import Entry, Kind
from rotemina.app.records.library import read
from rotemina.app.shell.engine_words import WindowWording
from rotemina.app.shell.file_dialog import ask_where
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Level, Workbench

PAGES = marked("shell", "Pages (*.html)")
RUN_REPORT = marked("shell", "Run report …")
RUN_REPORT_TIP = marked(
    "shell",
    "Write a page with date, machine, model, plots, gap, events and note of the run, and open it",
)


def recording_of(entries: Iterable[Entry], run: PenetrationRun) -> Entry | None:
    """Return the recording of a penetration, None where there is none."""
    recordings = (one for one in entries if one.kind is Kind.RECORDING and not one.missing)
    for one in recordings:
        if one.began is not None and run.during(one.began, one.duration_s or 0.0):
            return one
    return None


def save_report(bench: Workbench, path: Path, write: Callable[[], None], about: QWidget) -> None:
    """Write a page to ``path`` by ``write`` in the background, and open it."""

    def show() -> None:
        if not QDesktopServices.openUrl(QUrl.fromLocalFile(str(path))):
            text = translate("shell", "{path}: nothing here opens it; open it in a browser")
            bench.notify(Level.WARNING, text.format(path=path), about=about)

    bench.write_file(f"report {path}", path, write, show)


def ask_run_report(parent: QWidget, bench: Workbench, entry: Entry | None = None) -> None:
    """Ask where to, and write the report of a record of the library, or of the run in hand."""
    stem = (bench.run.name if bench.run else "run") if entry is None else entry.path.name
    stem = Path(stem.removesuffix(".gz")).stem.replace("/", "-")
    ask_where(
        parent.window(),
        bench,
        translate("shell", "Run report"),
        translate("shell", PAGES),
        f"{stem}-report.html",
        lambda path: save_run_report(parent, bench, path, entry),
    )


def save_run_report(
    parent: QWidget, bench: Workbench, path: Path, entry: Entry | None = None
) -> None:
    """Write the report of a record of the library, or of the run in hand.

    The figures of the run in hand are those of Comparison. A recording has those of the model
    that was in use; another record those of the model in use now.
    """
    in_hand = entry is None or entry.path == bench.run_path
    run = bench.run if in_hand else None
    if entry is None:
        entry = next((one for one in bench.library.entries if one.path == bench.run_path), None)
    model, robot, log = bench.session.model, bench.robot, bench.operation.penetration_log

    def write() -> None:
        from rotemina.app.records import run_report  # drawing takes its time to import

        penetrations = log.read()[0] if Path(log.path).exists() else ()
        report = None if run is None else run_report.RunReport.of_run(run, robot, entry)
        if entry is not None and entry.path.suffix == SUFFIX:
            report = (
                run_report.RunReport.of_recording(entry.path, entry, penetrations)
                if report is None
                else report.with_events(Recording.open(entry.path), penetrations)
            )
        elif entry is not None and report is None:
            beside = compared(model, entry.name, read(entry, robot))
            report = run_report.RunReport.of_run(beside, robot, entry)
        if report is not None:
            write_text(path, run_report.report_text(report, WindowWording()))

    save_report(bench, path, write, parent)
