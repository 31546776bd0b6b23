"""Report files: ask for the path, write the report in the background, and open it."""

from collections.abc import Callable, Iterable
from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QWidget

from rotemina.app.language import WindowWording, marked, translate
from rotemina.app.motion.penetration import PenetrationRun
from rotemina.app.motion.playback import compare_with_model
from rotemina.app.motion.recording import RECORDING_SUFFIX, Recording
from rotemina.app.records import LibraryEntry, RecordKind, read_entry
from rotemina.app.settings import write_text
from rotemina.app.shell.records.file_dialog import ask_save_path
from rotemina.app.workbench import Level, Workbench

PAGE_FILTER = marked("shell", "Pages (*.html)")
RUN_REPORT_LABEL = marked("shell", "Run report …")
RUN_REPORT_TIP = marked(
    "shell",
    "Write a page with date, machine, model, plots, gap, events and note of the run, and open it",
)


def find_recording(entries: Iterable[LibraryEntry], run: PenetrationRun) -> LibraryEntry | None:
    """Return the recording of a penetration, or None."""
    recordings = (
        entry for entry in entries if entry.kind is RecordKind.RECORDING and not entry.missing
    )
    for entry in recordings:
        if entry.began is not None and run.overlaps(entry.began, entry.duration_s or 0.0):
            return entry
    return None


def save_report(bench: Workbench, path: Path, write: Callable[[], None], about: QWidget) -> None:
    """Call ``write`` in the background, which writes a page to ``path``, and open the page."""

    def show() -> None:
        if not QDesktopServices.openUrl(QUrl.fromLocalFile(str(path))):
            text = translate(
                "shell", "{path}: no program is set up to open it; open it in a browser"
            )
            bench.notify(Level.WARNING, text.format(path=path), about=about)

    bench.write_file(f"report {path}", path, write, show)


def ask_run_report(parent: QWidget, bench: Workbench, entry: LibraryEntry | None = None) -> None:
    """Ask for a path and write the report of a library record, or of the loaded run."""
    stem = (bench.run.name if bench.run else "run") if entry is None else entry.path.name
    stem = Path(stem.removesuffix(".gz")).stem.replace("/", "-")
    ask_save_path(
        parent.window(),
        bench,
        translate("shell", "Run report"),
        translate("shell", PAGE_FILTER),
        f"{stem}-report.html",
        lambda path: save_run_report(parent, bench, path, entry),
    )


def save_run_report(
    parent: QWidget, bench: Workbench, path: Path, entry: LibraryEntry | None = None
) -> None:
    """Write the report of a library record, or of the loaded run.

    The report of the loaded run has the numbers of the panel Comparison. In the report of a
    recording, the numbers refer to the model that was in use then; for any other record, they refer
    to the model in use now.
    """
    is_loaded = entry is None or entry.path == bench.records.run_path
    run = bench.run if is_loaded else None
    if entry is None:
        entry = next(
            (listed for listed in bench.library.entries if listed.path == bench.records.run_path),
            None,
        )
    model, robot, log = bench.session.model, bench.robot, bench.operation.penetration_log

    def write() -> None:
        # Imported here, because the import of the drawing library is slow.
        from rotemina.app.records import run_report

        penetrations = log.read()[0] if Path(log.path).exists() else ()
        report = None if run is None else run_report.RunReport.from_run(run, robot, entry)
        if entry is not None and entry.path.suffix == RECORDING_SUFFIX:
            report = (
                run_report.RunReport.from_recording(entry.path, entry, penetrations)
                if report is None
                else report.with_events(Recording.open(entry.path), penetrations)
            )
        elif entry is not None and report is None:
            library_run = compare_with_model(model, entry.name, read_entry(entry, robot))
            report = run_report.RunReport.from_run(library_run, robot, entry)
        if report is not None:
            write_text(path, run_report.render_report(report, WindowWording()))

    save_report(bench, path, write, parent)
