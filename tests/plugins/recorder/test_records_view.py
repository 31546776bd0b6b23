"""The library in the recorder's panel: searched, called otherwise, opened, deleted, found again."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QLineEdit

from rotemina.app.records.entry import Entry, Kind
from rotemina.app.shell.record_chooser import RecordChooser
from rotemina.app.shell.record_library import BOUND_GB, RecordLibrary
from rotemina.app.shell.record_words import NAME, NOTE
from rotemina.sim.comparison.gap import gap_text
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record

PANELS = ("recorder", "comparison")
LONG_MS = 30_000


def made(path, run, began):
    time_s = 0.01 * np.arange(100)
    command = 3e-5 + 1e-5 * np.sin(time_s)
    signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): command + 1e-6}
    said = {"run": run, "operator": "A. Müller", "began": began}
    path.parent.mkdir(parents=True, exist_ok=True)
    write_record(Record.from_signals(time_s, signals, {"zn": "m"}, said), path)


@pytest.fixture
def bench(window):
    return window.workbench


@pytest.fixture
def view(qtbot, window, bench):
    """The panel's view of two playbacks, the newer first."""
    for number, run in enumerate(("left", "right")):
        name = f"2026-03-0{number + 1}_05-06-07-000000_tour.csv.gz"
        made(bench.played_folder / name, run, f"2026-03-0{number + 1}T05:06:07+01:00")
    window.bring_up("recorder")
    panel = window.panels["recorder"]
    panel.look()
    qtbot.waitUntil(lambda: len(names(panel.recordings)) == 2, timeout=LONG_MS)
    return panel.recordings


def names(view):
    return [one.name for one in view.table.entries_model.entries]


def typed(qtbot, view, column, text):
    """Change a cell by its editor, as keys do."""
    view.table.rename(column)
    field = view.table.viewport().findChild(QLineEdit)
    field.setText(text)
    qtbot.keyClick(field, Qt.Key.Key_Return)
    cell = view.table.entries_model.index(view.table.currentIndex().row(), column)
    qtbot.waitUntil(lambda: cell.data() == text or not cell.isValid(), timeout=LONG_MS)


def of_kind(window, kind):
    return next(each for each in window.findChildren(kind) if each.isVisible())


def test_playbacks_are_searched_annotated_compared_reported_and_played_again(
    qtbot, window, bench, view, tmp_path, monkeypatch
):
    opened = []
    monkeypatch.setattr(
        QDesktopServices, "openUrl", lambda url: opened.append(Path(url.toLocalFile())) or True
    )
    assert names(view) == ["right: tour", "left: tour"]
    view.table.search.setText("müller LEFT")
    assert names(view) == ["left: tour"]
    view.table.selectRow(0)
    typed(qtbot, view, NOTE, "the dish was dry")
    typed(qtbot, view, NAME, "first try")
    view.table.search.setText("dry")
    assert names(view) == ["first try"]
    view.table.kinds.setCurrentIndex(view.table.kinds.findData(Kind.RECORDING))
    assert names(view) == []
    view.table.search.setText("")
    view.table.kinds.setCurrentIndex(0)

    view.table.selectRow(0)
    assert view.open.text() == "Compare"
    assert not view.to_record.isEnabled()
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        qtbot.mouseClick(view.open, Qt.MouseButton.LeftButton)
    assert bench.run.name == "right: tour"
    qtbot.waitUntil(lambda: view.chosen is not None and bool(view.chosen.gap), timeout=LONG_MS)
    report = tmp_path / "run.html"
    qtbot.mouseClick(window.panels["comparison"].report, Qt.MouseButton.LeftButton)
    of_kind(window, QFileDialog).fileSelected.emit(str(report))
    qtbot.waitUntil(lambda: opened == [report], timeout=LONG_MS)
    size = gap_text(bench.run.gaps["zn", Tap.MEAS].rms, "m")
    assert f"Z nano, {size} (" in report.read_text("utf-8")
    of_kind(window, QFileDialog).close()
    view.table.selectRow(1)
    other = tmp_path / "other.html"
    view.report.trigger()
    of_kind(window, QFileDialog).fileSelected.emit(str(other))
    qtbot.waitUntil(lambda: opened == [report, other], timeout=LONG_MS)
    assert "Run report: first try" in other.read_text("utf-8")
    assert "the dish was dry" in other.read_text("utf-8")
    view.table.selectRow(0)

    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        qtbot.mouseClick(view.to_trajectory, Qt.MouseButton.LeftButton)
    assert bench.plan.name == "right: tour"

    window.ask_record()
    chooser = of_kind(window, RecordChooser)
    assert not chooser.open.isEnabled()
    chooser.table.selectRow(1)
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        qtbot.mouseClick(chooser.open, Qt.MouseButton.LeftButton)
    assert bench.run.name == "first try"
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    bench.theme_changed.emit(bench.theme)  # nothing of a chooser that is closed hears it


def test_what_is_gone_is_found_or_deleted_and_labels_are_kept(
    qtbot, window, bench, view, settings, tmp_path
):
    bench.library.entries[1].path.rename(tmp_path / "moved.csv.gz")
    view.looked_for.emit()
    shown = view.table.entries_model
    qtbot.waitUntil(lambda: shown.entries[1].missing, timeout=LONG_MS)
    view.table.selectRow(1)
    assert "The file is missing" in view.open.toolTip()
    assert view.find.isEnabled()
    bench.library.found_at(view.chosen, tmp_path / "moved.csv.gz")
    qtbot.waitUntil(lambda: shown.entries[1].usable, timeout=LONG_MS)
    view.table.selectAll()
    view.delete.trigger()
    assert view.question.text.text().startswith('Delete "right: tour", "left: tour"?')
    qtbot.mouseClick(view.question.yes, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: not shown.entries, timeout=LONG_MS)
    assert not list(bench.played_folder.iterdir())
    assert not (tmp_path / "moved.csv.gz").exists()

    fields = window.panels["recorder"].recording.labels
    for field, text in ((fields.run, "series 3"), (fields.operator, " A.  Müller ")):
        field.setText(text)
        qtbot.keyClick(field, Qt.Key.Key_Return)
    assert bench.session.labels.metadata == {"run": "series 3", "operator": "A. Müller"}
    assert fields.operator.text() == "A. Müller"
    assert settings.get("records.operator", "") == "A. Müller"


def test_too_much_room_is_told_once_and_nothing_is_deleted(settings, tmp_path):
    settings.set(BOUND_GB, 1)
    told = []
    session = SimpleNamespace(labels=None)
    library = RecordLibrary(session, settings, tmp_path / "played", told.append)
    big = Entry(path=tmp_path / "played" / "a.csv", kind=Kind.PLAYBACK, size=2 * 10**9)
    library.library.entries = (big,)
    for _ in range(2):
        library._done()
    assert told == [
        "Playbacks occupy 2 GB, more than 1 GB (preference records.bound_gb). The program deletes "
        "none of them: delete unneeded ones in the panel Recorder."
    ]
