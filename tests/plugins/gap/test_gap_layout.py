"""Where the parts of the gap page stand, at the sizes of two screens, and what they tell."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtWidgets import QApplication

from rotemina.app.shell.theme import DARK
from rotemina.app.shell.workbench import Run
from rotemina.plugins.gap.records import Records
from rotemina.plugins.gap.unseen_motion_reduction import Proof, prove
from rotemina.sim.comparison.comparison import compare
from rotemina.sim.comparison.gap import gap_text
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
LONG_MS = 30_000


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def six(answer):
    """Return an answer about six axes; one has no gap."""
    thx, thy = answer.diagnosis.axes.values()
    axes = {axis: replace(thx, axis=axis) for axis in ("x", "y", "z", "thx", "zn")}
    units = {axis: ROBOT.unit(axis) for axis in ROBOT.axes}
    signals = {(axis, Tap.CMD): np.zeros(2) for axis in units}
    record = Record.from_signals(np.arange(2.0), signals, units)
    diagnosis = replace(answer.diagnosis, axes={**axes, "thy": thy})
    return replace(answer, diagnosis=diagnosis, records=(record,))


def within(widget, panel):
    return QRect(widget.mapTo(panel, QPoint()), widget.size())


def test_the_rail_stands_at_the_side_of_a_large_page_and_above_a_small_one(window, answered):
    cells = answered.result.cells
    cells.show_answer(answered.answer)
    window.resize(1900, 800)
    QApplication.processEvents()
    rail, page = within(answered.rail, answered), within(answered.result.headline, answered)
    assert rail.width() == 320
    assert rail.right() < page.left()
    assert page.height() >= 120
    assert page.width() <= 1400
    assert answered.rail.list.isVisible()
    window.resize(1270, 540)
    QApplication.processEvents()
    rail, page = within(answered.rail, answered), within(answered.result.headline, answered)
    assert rail.bottom() < page.top()
    assert rail.height() <= 40
    assert not answered.rail.list.isVisible()
    controls = [
        within(one, answered) for one in (answered.rail.menu, answered.robots, answered.start)
    ]
    assert all(one.right() < other.left() for one, other in pairwise(controls))


@pytest.mark.parametrize(("width", "columns"), [(1900, 6), (1270, 3)])
def test_six_cells_stand_in_one_row_or_in_two(window, answered, width, columns):
    answered.result.cells.show_answer(six(answered.answer))
    window.resize(width, 800)
    QApplication.processEvents()
    places = [within(cell, answered.result.cells) for cell in answered.result.cells.cells]
    assert len({place.left() for place in places}) == columns
    assert len({place.top() for place in places}) == 6 // columns
    assert all(place.width() >= 220 and place.height() == 96 for place in places)
    assert not any(
        one.intersects(other) for n, one in enumerate(places) for other in places[n + 1 :]
    )


def test_a_cell_draws_both_gaps_from_zero_with_the_floor_and_chooses_its_axis(qtbot, answered):
    first, second = answered.result.cells.cells
    before, after, floor = first.bars()
    assert before.left() == after.left()
    assert after.width() / before.width() == pytest.approx(7.7e-7 / 3.3e-5, rel=1e-3)
    assert (floor - before.left()) / before.width() == pytest.approx(4e-7 / 3.3e-5, rel=1e-3)
    assert first.figures == "33.0 µrad → 0.770 µrad"
    assert answered.result.cells.current == "thx"
    click(qtbot, second)
    assert answered.result.cells.current == "thy"
    assert not second.grab().toImage().isNull()


def test_records_are_ticked_in_the_list_with_the_gap_of_each(qtbot, window, panel, record):
    window.resize(1900, 800)  # a smaller one has a menu in the list's place
    bench = panel.workbench
    runs = [Run(name, compare(bench.robot, record)) for name in ("first", "second")]
    for run in runs:
        bench.run_changed.emit(run)
    rows = panel.rail.list
    assert [rows.topLevelItem(row).text(0) for row in range(2)] == ["second", "first"]
    worst = gap_text(runs[0].gaps["thx", Tap.MEAS].rms, "rad")
    qtbot.waitUntil(lambda: rows.topLevelItem(1).text(1) == f"θx {worst}", timeout=LONG_MS)
    rows.topLevelItem(1).setCheckState(0, Qt.CheckState.Checked)
    assert [one.name for one in panel.records.chosen] == ["first", "second"]
    rows.topLevelItem(0).setCheckState(0, Qt.CheckState.Unchecked)
    assert [one.name for one in panel.records.chosen] == ["first"]


def test_what_an_earlier_session_has_kept_is_read_when_it_is_ticked(qtbot, window, panel, record):
    folder = window.workbench.played_folder
    folder.mkdir(parents=True)
    write_record(record, folder / "2026-01-02_tour.csv.gz")
    records = Records(window.workbench, panel)
    window.workbench.library.refresh()
    qtbot.waitUntil(lambda: bool(records.listed), timeout=LONG_MS)
    (kept,) = records.listed
    assert not records.chosen
    records.tick(kept, ticked=True)
    qtbot.waitUntil(lambda: bool(records.chosen), timeout=LONG_MS)
    qtbot.waitUntil(lambda: kept.gap.startswith("θx"), timeout=LONG_MS)


def test_a_motion_on_which_the_model_is_worse_is_red_beside_one_on_which_it_is_better(
    answered, window
):
    run = Run("tuesday", compare(ROBOT, answered.answer.records[0]))
    good = prove(
        answered.answer.diagnosis, answered._candidate, run, window.workbench.session.memory
    )
    worse = Proof("wednesday", (replace(good.shrunk[0], times=1.0 / 1.5),))
    answered.result.proof.show_proof(good)
    answered.result.proof.show_proof(worse)
    table = answered.result.proof.table
    assert [row[0] for row in table.texts()][:2] == ["wednesday", "tuesday"]
    assert table.texts()[0][4] == "worse: 1.5 × larger"
    assert table.item(0, 4).foreground().color().name() == DARK.danger_text
    assert table.texts()[1][4].startswith("better: ")
    assert not table.selectedItems()  # a selection would hide the red
    answered.result.headline.show_answer(answered.answer, worse)
    assert answered.result.headline.sentence.text().startswith(
        "Worse on wednesday: θx 1.5 × larger"
    )
    assert answered.result.headline.property("tone") == "worse"
