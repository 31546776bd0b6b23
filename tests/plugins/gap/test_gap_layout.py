"""Layout of the gap page at two screen sizes, and the content of its parts."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtWidgets import QApplication

from rotemina.app.widgets.style.theme import DARK
from rotemina.app.workbench import ComparedRun
from rotemina.plugins.gap.answer import UnseenMotionResult
from rotemina.plugins.gap.answer.unseen_motion_reduction import measure_reductions
from rotemina.plugins.gap.diagnosing import RecordSelection
from rotemina.sim.comparison import compare, format_gap
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
LONG_MS = 30_000


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def make_six_axis_answer(answer):
    """Return an answer about six axes, one of them without a gap."""
    thx, thy = answer.diagnosis.axes.values()
    axes = {axis: replace(thx, axis=axis) for axis in ("x", "y", "z", "thx", "zn")}
    units = {axis: ROBOT.unit(axis) for axis in ROBOT.axes}
    signals = {(axis, Tap.CMD): np.zeros(2) for axis in units}
    record = Record.from_signals(np.arange(2.0), signals, units)
    diagnosis = replace(answer.diagnosis, axes={**axes, "thy": thy})
    return replace(answer, diagnosis=diagnosis, records=(record,))


def find_rectangle(widget, panel):
    return QRect(widget.mapTo(panel, QPoint()), widget.size())


def test_six_cells_fill_one_or_two_rows(window, panel_with_answer):
    cells = panel_with_answer.result.cells
    cells.show_answer(make_six_axis_answer(panel_with_answer.answer))
    for width, columns in ((1900, 6), (1270, 3)):
        window.resize(width, 800)
        QApplication.processEvents()
        rectangles = [find_rectangle(cell, cells) for cell in cells.cards]
        assert len({rectangle.left() for rectangle in rectangles}) == columns
        assert len({rectangle.top() for rectangle in rectangles}) == 6 // columns
        assert not any(first.intersects(second) for first, second in combinations(rectangles, 2))


def test_a_cell_draws_both_gaps_and_the_floor_and_selects_its_axis(qtbot, panel_with_answer):
    first, second = panel_with_answer.result.cells.cards
    before, after, floor = first.compute_bars()
    assert before.left() == after.left()
    assert after.width() / before.width() == pytest.approx(7.7e-7 / 3.3e-5, rel=1e-3)
    assert (floor - before.left()) / before.width() == pytest.approx(4e-7 / 3.3e-5, rel=1e-3)
    assert first.figures == "33.0 µrad → 0.770 µrad"
    assert panel_with_answer.result.cells.current == "thx"
    click(qtbot, second)
    assert panel_with_answer.result.cells.current == "thy"
    assert not second.grab().toImage().isNull()


def test_records_are_ticked_in_a_list_that_shows_their_gaps(qtbot, window, panel, record):
    window.resize(1900, 800)  # a smaller window has a menu instead of the list
    workbench = panel.workbench
    runs = [ComparedRun(name, compare(workbench.robot, record)) for name in ("first", "second")]
    for run in runs:
        workbench.run_changed.emit(run)
    record_list = panel.rail.list
    assert [record_list.topLevelItem(row).text(0) for row in range(2)] == ["second", "first"]
    largest_gap = format_gap(runs[0].gaps["thx", Tap.MEAS].rms, "rad")
    qtbot.waitUntil(
        lambda: record_list.topLevelItem(1).text(1) == f"θx {largest_gap}", timeout=LONG_MS
    )
    record_list.topLevelItem(1).setCheckState(0, Qt.CheckState.Checked)
    assert [run.name for run in panel.records.chosen] == ["first", "second"]
    record_list.topLevelItem(0).setCheckState(0, Qt.CheckState.Unchecked)
    assert [run.name for run in panel.records.chosen] == ["first"]


def test_a_record_of_an_earlier_session_is_read_when_it_is_ticked(qtbot, window, panel, record):
    folder = window.workbench.played_folder
    folder.mkdir(parents=True)
    write_record(record, folder / "2026-01-02_tour.csv.gz")
    records = RecordSelection(window.workbench, panel)
    window.workbench.library.refresh()
    qtbot.waitUntil(lambda: bool(records.listed), timeout=LONG_MS)
    (listed_record,) = records.listed
    assert not records.chosen
    records.tick(listed_record, ticked=True)
    qtbot.waitUntil(lambda: bool(records.chosen), timeout=LONG_MS)
    qtbot.waitUntil(lambda: listed_record.gap.startswith("θx"), timeout=LONG_MS)


def test_only_motions_with_a_worse_model_are_marked_red(panel_with_answer, window):
    run = ComparedRun("tuesday", compare(ROBOT, panel_with_answer.answer.records[0]))
    better = measure_reductions(
        panel_with_answer.answer.diagnosis,
        panel_with_answer._candidate,
        run,
        window.workbench.session.memory,
    )
    worse = UnseenMotionResult("wednesday", (replace(better.reductions[0], factor=1.0 / 1.5),))
    panel_with_answer.result.unseen_motion.show_result(better)
    panel_with_answer.result.unseen_motion.show_result(worse)
    table = panel_with_answer.result.unseen_motion.table
    assert [row[0] for row in table.read_texts()][:2] == ["wednesday", "tuesday"]
    assert table.read_texts()[0][4] == "worse: 1.5 × larger"
    assert table.item(0, 4).foreground().color().name() == DARK.danger_text
    assert table.read_texts()[1][4].startswith("better: ")
    assert not table.selectedItems()  # a selection would hide the colour
    panel_with_answer.result.headline.show_answer(panel_with_answer.answer, worse)
    assert panel_with_answer.result.headline.sentence.text().startswith(
        "Worse on wednesday: θx 1.5 × larger"
    )
    assert panel_with_answer.result.headline.property("tone") == "worse"
