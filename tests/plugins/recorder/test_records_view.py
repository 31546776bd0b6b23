"""The record library in the recorder panel: searched, renamed, opened, deleted and relocated."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QLineEdit

from rotemina.app.records import LibraryEntry, RecordKind
from rotemina.app.shell.records import NAME_COLUMN, NOTE_COLUMN
from rotemina.app.shell.records.record_chooser import RecordChooser
from rotemina.app.workbench.record_library import MAX_PLAYED_KEY, RecordLibrary
from rotemina.sim.comparison import format_gap
from rotemina.sim.records import Record, Tap, write_record

PANELS = ("recorder", "comparison")
LONG_MS = 30_000


def write_playback(path, run, start_time):
    time_s = 0.01 * np.arange(100)
    command = 3e-5 + 1e-5 * np.sin(time_s)
    signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): command + 1e-6}
    metadata = {"run": run, "operator": "A. Müller", "began": start_time}
    path.parent.mkdir(parents=True, exist_ok=True)
    write_record(Record.from_signals(time_s, signals, {"zn": "m"}, metadata), path)


@pytest.fixture
def workbench(window):
    return window.workbench


@pytest.fixture
def view(qtbot, window, workbench):
    """Return the panel's view of two playbacks, the newer one first."""
    for number, run in enumerate(("left", "right")):
        name = f"2026-03-0{number + 1}_05-06-07-000000_tour.csv.gz"
        write_playback(workbench.played_folder / name, run, f"2026-03-0{number + 1}T05:06:07+01:00")
    window.bring_up("recorder")
    panel = window.panels["recorder"]
    panel.refresh_recordings()
    qtbot.waitUntil(lambda: len(list_names(panel.recordings)) == 2, timeout=LONG_MS)
    return panel.recordings


def list_names(view):
    return [entry.name for entry in view.table.entries_model.entries]


def type_in_cell(qtbot, view, column, text):
    """Type a text into the editor of a cell."""
    view.table.edit_cell(column)
    field = view.table.viewport().findChild(QLineEdit)
    field.setText(text)
    qtbot.keyClick(field, Qt.Key.Key_Return)
    cell = view.table.entries_model.index(view.table.currentIndex().row(), column)
    qtbot.waitUntil(lambda: cell.data() == text or not cell.isValid(), timeout=LONG_MS)


def find_visible(window, widget_class):
    return next(child for child in window.findChildren(widget_class) if child.isVisible())


def test_playbacks_are_searched_annotated_compared_and_played_again(
    qtbot, window, workbench, view, tmp_path, monkeypatch
):
    opened = []
    monkeypatch.setattr(
        QDesktopServices, "openUrl", lambda url: opened.append(Path(url.toLocalFile())) or True
    )
    assert list_names(view) == ["right: tour", "left: tour"]
    view.table.search.setText("müller LEFT")
    assert list_names(view) == ["left: tour"]
    view.table.selectRow(0)
    type_in_cell(qtbot, view, NOTE_COLUMN, "the dish was dry")
    type_in_cell(qtbot, view, NAME_COLUMN, "first try")
    view.table.search.setText("dry")
    assert list_names(view) == ["first try"]
    view.table.kinds.setCurrentIndex(view.table.kinds.findData(RecordKind.RECORDING))
    assert list_names(view) == []
    view.table.search.setText("")
    view.table.kinds.setCurrentIndex(0)

    view.table.selectRow(0)
    assert view.open.text() == "Compare"
    assert not view.export_button.isEnabled()
    with qtbot.waitSignal(workbench.run_changed, timeout=LONG_MS):
        qtbot.mouseClick(view.open, Qt.MouseButton.LeftButton)
    assert workbench.run.name == "right: tour"
    qtbot.waitUntil(
        lambda: view.selected_entry is not None and bool(view.selected_entry.gap), timeout=LONG_MS
    )
    report = tmp_path / "run.html"
    qtbot.mouseClick(window.panels["comparison"].report, Qt.MouseButton.LeftButton)
    find_visible(window, QFileDialog).fileSelected.emit(str(report))
    qtbot.waitUntil(lambda: opened == [report], timeout=LONG_MS)
    size = format_gap(workbench.run.gaps["zn", Tap.MEAS].rms, "m")
    assert f"Z nano, {size} (" in report.read_text("utf-8")
    find_visible(window, QFileDialog).close()
    view.table.selectRow(1)
    other_report = tmp_path / "other.html"
    view.report.trigger()
    find_visible(window, QFileDialog).fileSelected.emit(str(other_report))
    qtbot.waitUntil(lambda: opened == [report, other_report], timeout=LONG_MS)
    assert "Run report: first try" in other_report.read_text("utf-8")
    assert "the dish was dry" in other_report.read_text("utf-8")
    view.table.selectRow(0)

    with qtbot.waitSignal(workbench.plan_changed, timeout=LONG_MS):
        qtbot.mouseClick(view.trajectory_button, Qt.MouseButton.LeftButton)
    assert workbench.plan.name == "right: tour"

    window.ask_record()
    chooser = find_visible(window, RecordChooser)
    assert not chooser.open.isEnabled()
    chooser.table.selectRow(1)
    with qtbot.waitSignal(workbench.run_changed, timeout=LONG_MS):
        qtbot.mouseClick(chooser.open, Qt.MouseButton.LeftButton)
    assert workbench.run.name == "first try"
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    workbench.theme_changed.emit(workbench.theme)  # must not reach the closed chooser


def test_missing_files_are_relocated_or_deleted_and_labels_are_saved(
    qtbot, window, workbench, view, settings, tmp_path
):
    workbench.library.entries[1].path.rename(tmp_path / "moved.csv.gz")
    view.refresh_requested.emit()
    model = view.table.entries_model
    qtbot.waitUntil(lambda: model.entries[1].missing, timeout=LONG_MS)
    view.table.selectRow(1)
    assert "The file is missing" in view.open.toolTip()
    assert view.find.isEnabled()
    workbench.library.set_path(view.selected_entry, tmp_path / "moved.csv.gz")
    qtbot.waitUntil(lambda: model.entries[1].is_usable, timeout=LONG_MS)
    view.table.selectAll()
    view.delete.trigger()
    assert view.question.text.text().startswith('Delete "right: tour", "left: tour"?')
    qtbot.mouseClick(view.question.yes, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: not model.entries, timeout=LONG_MS)
    assert not list(workbench.played_folder.iterdir())
    assert not (tmp_path / "moved.csv.gz").exists()

    fields = window.panels["recorder"].recording.labels
    for field, text in ((fields.run, "series 3"), (fields.operator, " A.  Müller ")):
        field.setText(text)
        qtbot.keyClick(field, Qt.Key.Key_Return)
    assert workbench.session.labels.metadata == {"run": "series 3", "operator": "A. Müller"}
    assert fields.operator.text() == "A. Müller"
    assert settings.get("records.operator", "") == "A. Müller"


def test_too_large_playbacks_are_reported_once_and_not_deleted(settings, tmp_path):
    settings.set(MAX_PLAYED_KEY, 1)
    notices = []
    session = SimpleNamespace(labels=None)
    library = RecordLibrary(session, settings, tmp_path / "played", notices.append)
    large_entry = LibraryEntry(
        path=tmp_path / "played" / "a.csv", kind=RecordKind.PLAYBACK, size=2 * 10**9
    )
    library.library.entries = (large_entry,)
    for _ in range(2):
        library._on_done()
    assert notices == [
        "Playbacks occupy 2 GB, more than 1 GB (preference records.bound_gb). The program deletes "
        "none of them: delete unneeded ones in the panel Recorder."
    ]
