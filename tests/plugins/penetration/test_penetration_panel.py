"""The penetration panel in the window: parameters, arming, runs, and the simulated cell."""

import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog

from rotemina.app.motion.operation import PENETRATION
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import RunLog, Verdict
from rotemina.app.motion.penetration.status import UNDER_WAY, Phase
from rotemina.app.motion.recording.arrow_tables import prepare
from rotemina.app.shell.report_files import recording_of
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.penetration.cell_view import REAL_MACHINE
from rotemina.sim.robot.model import AxisEffect

LONG_MS = 30_000
CREEP = AxisEffect(axis="x", id="microstep_error")


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def phase(panel):
    return panel.workbench.operation.penetration.status.phase


def press(qtbot, button):
    qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def type_in(qtbot, panel, key, text):
    edit = panel.form.fields[key].edit
    edit.setFocus()
    edit.selectAll()
    qtbot.keyClicks(edit, text)
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    return edit


def above_a_cell(qtbot, panel, **parameters):
    """Bring the tip up and put a cell 2 µm ahead; the membrane is soft, so the depth is met."""
    session = panel.workbench.session
    session.service.set_effects([CREEP])
    qtbot.waitUntil(lambda: session.service.effects == (CREEP,), timeout=LONG_MS)
    session.go_to({"zn": 64e-6})
    qtbot.waitUntil(lambda: session.snapshot().command["zn"] == 64e-6, timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    qtbot.waitUntil(lambda: abs(session.snapshot().measured["zn"] - 64e-6) < 1e-7, timeout=LONG_MS)
    panel.tabs.setCurrentIndex(2)
    panel.cell.ahead.setText("2")
    press(qtbot, panel.cell.put)
    qtbot.waitUntil(lambda: len(session.service.effects) == 2, timeout=LONG_MS)
    panel.tabs.setCurrentIndex(0)
    panel.form.show_parameters(PenetrationParameters(**parameters))
    panel._change()
    qtbot.waitUntil(panel.bar.arm.isEnabled, timeout=LONG_MS)


@pytest.fixture
def panel(window):
    window.docks["penetration"].raise_()
    return window.panels["penetration"]


def test_parameters_are_typed_kept_and_read_and_nothing_moves(qtbot, window, panel, tmp_path):
    session, form = window.workbench.session, panel.form
    at = session.snapshot().command
    qtbot.waitUntil(lambda: "32.5 µm of travel left" in panel.message.text())
    assert not panel.bar.arm.isEnabled()
    assert "the run needs 62 µm" in panel.bar.arm.toolTip()
    assert panel.bar.prepare.isVisibleTo(panel)
    assert not panel.bar.button.isEnabled()
    assert panel.readouts.plan.values["Travel available"].text() == "32.50 µm"

    edit = type_in(qtbot, panel, "depth", "500")
    assert edit.property("bad")
    assert "Depth: 500 µm must be 1 to 100 µm" in panel.message.text()
    panel.arm()
    assert "Depth: 500 µm must be" in notices(window)[0]
    type_in(qtbot, panel, "depth", "20")
    assert not edit.property("bad")
    assert panel.readouts.plan.values["Average speed"].text() == "222 µm/s"
    qtbot.waitUntil(panel.bar.arm.isEnabled, timeout=LONG_MS)
    assert not panel.bar.prepare.isVisibleTo(panel)
    drawn = panel.preview.curves["commanded"]
    assert drawn.way[-1] == pytest.approx(20e-6, rel=1e-3)

    form.choices["shape"].select("table")
    form.take()
    assert form.table.isVisible()
    assert not form.fields["ramp"].edit.isVisible()
    form.table.setPlainText("0, 0\nhalf, 1\n1, 1")
    assert "table, line 2: 'half, 1'" in panel.message.text()
    form.table.setPlainText("0, 0\n0.5, 0.4\n1, 1")
    assert form.parameters.table == ((0.0, 0.0), (0.5, 0.4), (1.0, 1.0))

    kept = window.workbench.settings.folder / PENETRATION
    qtbot.waitUntil(kept.exists, timeout=LONG_MS)
    panel.save_parameters(tmp_path / "mine.toml")
    qtbot.waitUntil(lambda: "Saved" in notices(window)[0], timeout=LONG_MS)
    assert PenetrationParameters.load(tmp_path / "mine.toml") == form.parameters
    (tmp_path / "bad.toml").write_text("depht = 1e-5", "utf-8")
    panel.load_parameters(tmp_path / "bad.toml")
    qtbot.waitUntil(lambda: "did you mean 'depth'?" in notices(window)[0], timeout=LONG_MS)
    (tmp_path / "other.toml").write_text("approach_speed = 2e-5", "utf-8")
    panel.load_parameters(tmp_path / "other.toml")
    qtbot.waitUntil(lambda: form.fields["approach_speed"].edit.text() == "20", timeout=LONG_MS)
    assert form.parameters == PenetrationParameters(approach_speed=2e-5)
    assert session.snapshot().command == at
    press(qtbot, panel.bar.prepare)
    qtbot.waitUntil(panel.bar.arm.isEnabled, timeout=LONG_MS)
    assert session.snapshot().command["zn"] > 62e-6
    assert panel.message.text() == (
        "Ready to arm. The simulator has no cell: place one in Simulated cell."
    )
    assert window.workbench.run is None  # a way is no run
    window.workbench.close()  # what was typed last is kept then
    assert PenetrationParameters.load(kept) == form.parameters


def test_armed_aborted_in_hold_logged_and_reported(qtbot, window, panel, tmp_path, monkeypatch):
    session = window.workbench.session
    prepare()  # a recording begins at once then
    above_a_cell(qtbot, panel, hold_s=30.0)
    assert session.service.effects[0] == CREEP
    # Before where the tip is measured, noise included.
    told = re.fullmatch(r"A cell at (\S+) µm of Z nano\.", panel.cell.where.text())
    assert told is not None
    assert float(told[1]) == pytest.approx(62.0, abs=0.5)

    press(qtbot, panel.bar.arm)
    qtbot.waitUntil(lambda: panel.bar.arm.text() == "Disarm", timeout=LONG_MS)
    assert panel.bar.phase.text().startswith("armed, ")
    assert not panel.form.fields["depth"].edit.isEnabled()
    press(qtbot, panel.bar.button)
    qtbot.waitUntil(lambda: panel.bar.button.text() == "Stop and retract", timeout=LONG_MS)
    assert not panel.bar.arm.isEnabled()
    qtbot.waitUntil(lambda: phase(panel) is Phase.HOLD, timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.bar.phase.text() == "hold", timeout=LONG_MS)
    assert panel.bar.strip[Phase.HOLD].property("tone") == "busy"
    assert panel.readouts.run.values["Distance"].text() not in ("–", "0.00 µm")
    assert "of 10 µm" in panel.readouts.load.format()
    assert panel.readouts.load.value() > 0

    qtbot.mouseDClick(panel.bar.button, Qt.MouseButton.LeftButton)  # in alarm: one press counts
    qtbot.mousePress(panel.bar.button, Qt.MouseButton.LeftButton)
    qtbot.mouseRelease(panel.bar.button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: phase(panel) not in UNDER_WAY, timeout=LONG_MS)
    assert phase(panel) is Phase.ABORTED
    qtbot.waitUntil(lambda: panel.log.table.rowCount() == 1, timeout=LONG_MS)
    assert "stopped by the button in hold. The tip is retracted." in panel.message.text()
    assert session.snapshot().command["zn"] == 64e-6
    assert "measured" in panel.preview.curves
    panel.tabs.setCurrentIndex(1)
    panel.log.table.selectRow(0)
    assert "aborted: stopped by the button in hold" in panel.log.text.toPlainText()
    assert window.workbench.operation.penetration_log.path in panel.log.file.text()
    library = window.workbench.library
    run = panel.log.list.runs[0]
    qtbot.waitUntil(lambda: recording_of(library.entries, run) is not None, timeout=LONG_MS)
    assert recording_of(library.entries, run).name == "penetration"
    assert window.workbench.operation.recording is None
    page, opened = tmp_path / "run.html", []
    monkeypatch.setattr(QFileDialog, "show", lambda dialog: dialog.fileSelected.emit(str(page)))
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: opened.append(url) or True)
    panel.log.table.selectRow(0)
    press(qtbot, panel.log.report)
    qtbot.waitUntil(lambda: bool(opened), timeout=LONG_MS)
    assert "stopped by the button in hold" in page.read_text("utf-8")
    panel.tabs.setCurrentIndex(2)
    press(qtbot, panel.cell.take)
    qtbot.waitUntil(lambda: session.service.effects == (CREEP,), timeout=LONG_MS)
    assert notices(window) == [f"Saved {page}"]


@pytest.mark.slow
def test_done_then_held_by_an_emergency_stop_and_brought_back(qtbot, make_robot_window):
    window = make_robot_window()
    window.docks["penetration"].raise_()
    panel, bench = window.panels["penetration"], window.workbench
    above_a_cell(qtbot, panel, inject_s=0.3, hold_s=0.2, hold_after_s=0.2)
    lit, tool = [], set()
    press(qtbot, panel.bar.arm)
    press(qtbot, panel.bar.button)

    def seen():
        tones = {str(one): chip.property("tone") for one, chip in panel.bar.strip.items()}
        lit.extend(name for name, tone in tones.items() if tone == "busy" and name not in lit)
        tool.add((panel.bar.phase.text(), panel.readouts.tool.isChecked()))
        return phase(panel) is Phase.DONE

    qtbot.waitUntil(seen, timeout=LONG_MS)
    assert lit == ["approach", "contact", "thrust", "hold", "inject", "retract"]
    assert ("inject", True) in tool
    assert ("hold", True) not in tool
    qtbot.waitUntil(lambda: "Done: depth 45." in panel.message.text(), timeout=LONG_MS)

    panel.form.show_parameters(PenetrationParameters(hold_s=30.0))
    panel._change()
    assert "measured" not in panel.preview.curves  # that was by others
    press(qtbot, panel.bar.arm)
    press(qtbot, panel.bar.button)
    qtbot.waitUntil(lambda: phase(panel) is Phase.HOLD, timeout=LONG_MS)
    bench.emergency_stop()
    qtbot.waitUntil(lambda: panel.bar.button.text() == "Retract", timeout=LONG_MS)
    assert not panel.bar.button.isEnabled()
    assert "release it first" in panel.bar.button.toolTip()
    assert panel.bar.arm.text() == "Free the axes"
    assert panel.message.text().startswith("Held: ")
    assert panel.bar.strip[Phase.HOLD].property("tone") == "warning"
    at = bench.session.snapshot().command["zn"]
    assert at < 30e-6
    bench.release()
    qtbot.wait(600)
    assert bench.session.snapshot().command["zn"] == at  # nothing goes back by itself
    press(qtbot, panel.bar.button)
    qtbot.waitUntil(lambda: phase(panel) is Phase.ABORTED, timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.log.table.rowCount() == 3, timeout=LONG_MS)
    verdicts = [panel.log.table.item(row, 1).text() for row in range(3)]
    assert verdicts == ["aborted", "held", "done"]
    runs, problems = RunLog(bench.operation.penetration_log.path).read()
    assert [str(run.verdict) for run in runs] == verdicts[::-1]
    assert problems == ()


@pytest.mark.slow
def test_runs_of_the_file_are_shown_and_a_robot_without_zn_says_so(
    qtbot, make_robot_window, monkeypatch
):
    first = make_robot_window()
    log = first.workbench.operation.penetration_log
    bench_panel = first.panels["penetration"]
    above_a_cell(qtbot, bench_panel, approach_distance=1e-6)
    press(qtbot, bench_panel.bar.arm)
    press(qtbot, bench_panel.bar.button)
    qtbot.waitUntil(lambda: phase(bench_panel) is Phase.FAILED, timeout=LONG_MS)
    qtbot.waitUntil(lambda: bench_panel.log.table.rowCount() == 1, timeout=LONG_MS)
    kept = Path(log.path)
    kept.write_text(kept.read_text("utf-8") + "{cut off\n", "utf-8")
    other = make_robot_window("picma")
    panel = other.panels["penetration"]
    qtbot.waitUntil(lambda: panel.log.table.rowCount() == 1, timeout=LONG_MS)
    assert "no contact within 1 µm" in panel.log.table.item(0, 7).text()
    qtbot.waitUntil(lambda: any("line 2" in text for text in notices(other)), timeout=LONG_MS)
    assert "has no axis 'zn' to penetrate with" in panel.message.text()
    assert not panel.bar.arm.isEnabled()
    assert not panel.cell.put.isEnabled()
    monkeypatch.setattr(type(other.workbench.session.service), "effects", property(lambda _: None))
    panel.tabs.setCurrentIndex(2)
    qtbot.waitUntil(lambda: panel.cell.about.text() == REAL_MACHINE, timeout=LONG_MS)
    assert not panel.cell.controls.isVisibleTo(panel)


def test_cells_are_gone_to_one_after_the_other_and_a_run_is_noted_with_the_armed_one(
    qtbot, window, panel, tmp_path
):
    session, view = window.workbench.session, panel.cells
    panel.tabs.setCurrentIndex(3)
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    here = session.snapshot().command
    press(qtbot, view.add)
    session.go_to({"x": here["x"] + 1e-4, "zn": 64e-6})
    qtbot.waitUntil(lambda: session.snapshot().command["x"] == here["x"] + 1e-4, timeout=LONG_MS)
    press(qtbot, view.add)
    assert not view.skip.isEnabled()  # it is at none yet
    press(qtbot, view.next)
    assert view.table.item(0, 0).text() == "▸ 1"
    qtbot.waitUntil(lambda: session.snapshot().command["x"] == here["x"], timeout=LONG_MS)
    press(qtbot, view.skip)
    press(qtbot, view.next)
    at_the_second = lambda: session.snapshot().command == view.list.cells[1].place  # noqa: E731
    qtbot.waitUntil(lambda: session.at_rest and at_the_second(), timeout=LONG_MS)
    press(qtbot, view.penetrate)
    assert phase(panel) is Phase.ARMED
    qtbot.waitUntil(lambda: "armed or running" in view.next.toolTip(), timeout=LONG_MS)
    status = panel.workbench.operation.penetration.status
    failed = SimpleNamespace(verdict=Verdict.FAILED, thrust=None, started="now", reason="too soft")
    view.refresh(session.snapshot(), replace(status, phase=Phase.FAILED, run=failed), None)
    shown = [view.table.item(1, column).text() for column in (0, 4, 5, 6)]
    assert shown == ["▸ 2", "failed", "", "too soft"]
    assert view.table.item(0, 4).text() == "skipped"
    view.export_to(tmp_path / "cells.csv")
    qtbot.waitUntil((tmp_path / "cells.csv").exists, timeout=LONG_MS)
    assert ",failed,,now,too soft" in (tmp_path / "cells.csv").read_text()
    panel.workbench.operation.penetration.disarm()


def test_a_press_on_a_button_that_the_penetration_has_overtaken_is_reported(window, panel):
    panel.bar._shown = Phase.ARMED  # as it was labelled in the frame before
    panel.bar._press()
    panel.bar._arm()
    assert phase(panel) is Phase.DISARMED
    told = "Nothing was done: the penetration went on just before the press."
    assert notices(window)[0].startswith(told)
