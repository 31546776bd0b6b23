"""The penetration panel in the window: parameters, arming, runs, and the simulated cell."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog

from rotemina.app.motion.penetration import (
    RUNNING_PHASES,
    PenetrationParameters,
    PenetrationPhase,
    PenetrationRun,
    PenetrationVerdict,
    RunLog,
)
from rotemina.app.motion.recording import load_arrow
from rotemina.app.operation.operation import PENETRATION_FILE
from rotemina.app.shell.records import find_recording
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.penetration.cell_view import REAL_MACHINE_TEXT
from rotemina.sim.robot import AxisEffect

LONG_MS = 30_000
MICROSTEP_ERROR = AxisEffect(axis="x", id="microstep_error")
FAILED_RUN = PenetrationRun(
    started="2026-11-21T10:00:00+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters={},
    verdict=PenetrationVerdict.FAILED,
    reason="too soft",
    phases=(),
)


def list_notices(window):
    return [notice.text for notice in window.notices.notices()]


def get_phase(panel):
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


def move_above_cell(qtbot, panel, **parameters):
    """Retract the tip and place a soft cell 2 µm ahead, so that the full depth is reached."""
    session = panel.workbench.session
    session.service.set_effects([MICROSTEP_ERROR])
    qtbot.waitUntil(lambda: session.service.effects == (MICROSTEP_ERROR,), timeout=LONG_MS)
    session.go_to({"zn": 64e-6})
    qtbot.waitUntil(lambda: session.snapshot().command["zn"] == 64e-6, timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    qtbot.waitUntil(lambda: abs(session.snapshot().measured["zn"] - 64e-6) < 1e-7, timeout=LONG_MS)
    panel.tabs.setCurrentIndex(2)
    panel.simulated_cell.ahead.setText("2")
    press(qtbot, panel.simulated_cell.place_button)
    qtbot.waitUntil(lambda: len(session.service.effects) == 2, timeout=LONG_MS)
    panel.tabs.setCurrentIndex(0)
    panel.form.show_parameters(PenetrationParameters(**parameters))
    panel._on_form_changed()
    qtbot.waitUntil(panel.bar.arm.isEnabled, timeout=LONG_MS)


@pytest.fixture
def panel(window):
    window.docks["penetration"].raise_()
    return window.panels["penetration"]


def test_parameters_are_typed_saved_and_loaded_without_motion(qtbot, window, panel, tmp_path):
    session, form = window.workbench.session, panel.form
    start_command = session.snapshot().command
    qtbot.waitUntil(lambda: "32.5 µm of travel left" in panel.message.text())
    assert not panel.bar.arm.isEnabled()
    assert "the run needs 62 µm" in panel.bar.arm.toolTip()
    assert panel.bar.prepare.isVisibleTo(panel)
    assert not panel.bar.main_button.isEnabled()
    assert panel.readouts.plan.values["Travel available"].text() == "32.50 µm"

    edit = type_in(qtbot, panel, "depth", "500")
    assert edit.property("bad")
    assert "Depth: 500 µm must be 1 to 100 µm" in panel.message.text()
    panel.arm()
    assert "Depth: 500 µm must be" in list_notices(window)[0]
    type_in(qtbot, panel, "depth", "20")
    assert not edit.property("bad")
    assert panel.readouts.plan.values["Average speed"].text() == "222 µm/s"
    qtbot.waitUntil(panel.bar.arm.isEnabled, timeout=LONG_MS)
    assert not panel.bar.prepare.isVisibleTo(panel)
    commanded_curve = panel.thrust_view.curves["commanded"]
    assert commanded_curve.depth[-1] == pytest.approx(20e-6, rel=1e-3)

    form.choices["shape"].select("table")
    form.read_fields()
    assert form.table.isVisible()
    assert not form.fields["ramp"].edit.isVisible()
    form.table.setPlainText("0, 0\nhalf, 1\n1, 1")
    assert "table, line 2: 'half, 1'" in panel.message.text()
    form.table.setPlainText("0, 0\n0.5, 0.4\n1, 1")
    assert form.parameters.table == ((0.0, 0.0), (0.5, 0.4), (1.0, 1.0))

    settings_file = window.workbench.settings.folder / PENETRATION_FILE
    qtbot.waitUntil(settings_file.exists, timeout=LONG_MS)
    panel.save_parameters(tmp_path / "mine.toml")
    qtbot.waitUntil(lambda: "Saved" in list_notices(window)[0], timeout=LONG_MS)
    assert PenetrationParameters.load(tmp_path / "mine.toml") == form.parameters
    (tmp_path / "bad.toml").write_text("depht = 1e-5", "utf-8")
    panel.load_parameters(tmp_path / "bad.toml")
    qtbot.waitUntil(lambda: "did you mean 'depth'?" in list_notices(window)[0], timeout=LONG_MS)
    (tmp_path / "other.toml").write_text("approach_speed = 2e-5", "utf-8")
    panel.load_parameters(tmp_path / "other.toml")
    qtbot.waitUntil(lambda: form.fields["approach_speed"].edit.text() == "20", timeout=LONG_MS)
    assert form.parameters == PenetrationParameters(approach_speed=2e-5)
    assert session.snapshot().command == start_command
    press(qtbot, panel.bar.prepare)
    qtbot.waitUntil(panel.bar.arm.isEnabled, timeout=LONG_MS)
    assert session.snapshot().command["zn"] > 62e-6
    assert panel.message.text() == (
        "Ready to arm. The simulator has no cell: place one in Simulated cell."
    )
    assert window.workbench.run is None  # moving to the start position is not a run
    window.workbench.close()  # closing saves the last parameters
    assert PenetrationParameters.load(settings_file) == form.parameters


def test_a_run_is_armed_aborted_in_hold_logged_and_reported(
    qtbot, window, panel, tmp_path, monkeypatch
):
    session = window.workbench.session
    load_arrow()  # so that the recording starts without delay
    move_above_cell(qtbot, panel, hold_s=30.0)
    assert session.service.effects[0] == MICROSTEP_ERROR
    # The cell is placed relative to the measured tip, whose position includes noise.
    cell_text = re.fullmatch(
        r"A cell at (\S+) µm of Z nano\.", panel.simulated_cell.place_label.text()
    )
    assert cell_text is not None
    assert float(cell_text[1]) == pytest.approx(62.0, abs=0.5)

    press(qtbot, panel.bar.arm)
    qtbot.waitUntil(lambda: panel.bar.arm.text() == "Disarm", timeout=LONG_MS)
    assert panel.bar.phase.text().startswith("armed, ")
    assert not panel.form.fields["depth"].edit.isEnabled()
    press(qtbot, panel.bar.main_button)
    qtbot.waitUntil(lambda: panel.bar.main_button.text() == "Stop and retract", timeout=LONG_MS)
    assert not panel.bar.arm.isEnabled()
    qtbot.waitUntil(lambda: get_phase(panel) is PenetrationPhase.HOLD, timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.bar.phase.text() == "hold", timeout=LONG_MS)
    assert panel.bar.strip[PenetrationPhase.HOLD].property("tone") == "busy"
    assert panel.readouts.run.values["Distance"].text() not in ("–", "0.00 µm")
    assert "of 10 µm" in panel.readouts.load.format()
    assert panel.readouts.load.value() > 0

    # An alarmed operator may press several times. This counts as one press.
    qtbot.mouseDClick(panel.bar.main_button, Qt.MouseButton.LeftButton)
    qtbot.mousePress(panel.bar.main_button, Qt.MouseButton.LeftButton)
    qtbot.mouseRelease(panel.bar.main_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: get_phase(panel) not in RUNNING_PHASES, timeout=LONG_MS)
    assert get_phase(panel) is PenetrationPhase.ABORTED
    qtbot.waitUntil(lambda: panel.log.table.rowCount() == 1, timeout=LONG_MS)
    assert "stopped by the button in hold. The tip is retracted." in panel.message.text()
    assert session.snapshot().command["zn"] == 64e-6
    assert "measured" in panel.thrust_view.curves
    panel.tabs.setCurrentIndex(1)
    panel.log.table.selectRow(0)
    assert "aborted: stopped by the button in hold" in panel.log.text.toPlainText()
    assert window.workbench.operation.penetration_log.path in panel.log.file_label.text()
    library = window.workbench.library
    run = panel.log.run_list.runs[0]
    qtbot.waitUntil(lambda: find_recording(library.entries, run) is not None, timeout=LONG_MS)
    assert find_recording(library.entries, run).name == "penetration"
    assert window.workbench.operation.recording is None
    report_file, opened = tmp_path / "run.html", []
    monkeypatch.setattr(
        QFileDialog, "show", lambda dialog: dialog.fileSelected.emit(str(report_file))
    )
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: opened.append(url) or True)
    panel.log.table.selectRow(0)
    press(qtbot, panel.log.report)
    qtbot.waitUntil(lambda: bool(opened), timeout=LONG_MS)
    assert "stopped by the button in hold" in report_file.read_text("utf-8")
    panel.tabs.setCurrentIndex(2)
    press(qtbot, panel.simulated_cell.remove_button)
    qtbot.waitUntil(lambda: session.service.effects == (MICROSTEP_ERROR,), timeout=LONG_MS)
    assert list_notices(window) == [f"Saved {report_file}"]


@pytest.mark.slow
def test_a_run_is_done_and_the_next_is_held_by_an_emergency_stop_and_retracted(
    qtbot, make_robot_window
):
    window = make_robot_window()
    window.docks["penetration"].raise_()
    panel, workbench = window.panels["penetration"], window.workbench
    move_above_cell(qtbot, panel, inject_s=0.3, hold_s=0.2, hold_after_s=0.2)
    lit_phases, tool_states = [], set()
    press(qtbot, panel.bar.arm)
    press(qtbot, panel.bar.main_button)

    def is_done():
        tones = {
            str(lamp_phase): chip.property("tone") for lamp_phase, chip in panel.bar.strip.items()
        }
        lit_phases.extend(
            name for name, tone in tones.items() if tone == "busy" and name not in lit_phases
        )
        tool_states.add((panel.bar.phase.text(), panel.readouts.tool.isChecked()))
        return get_phase(panel) is PenetrationPhase.DONE

    qtbot.waitUntil(is_done, timeout=LONG_MS)
    assert lit_phases == ["approach", "contact", "thrust", "hold", "inject", "retract"]
    assert ("inject", True) in tool_states
    assert ("hold", True) not in tool_states
    qtbot.waitUntil(lambda: "Done: depth 45." in panel.message.text(), timeout=LONG_MS)

    panel.form.show_parameters(PenetrationParameters(hold_s=30.0))
    panel._on_form_changed()
    assert "measured" not in panel.thrust_view.curves  # it was measured with other parameters
    press(qtbot, panel.bar.arm)
    press(qtbot, panel.bar.main_button)
    qtbot.waitUntil(lambda: get_phase(panel) is PenetrationPhase.HOLD, timeout=LONG_MS)
    workbench.emergency_stop()
    qtbot.waitUntil(lambda: panel.bar.main_button.text() == "Retract", timeout=LONG_MS)
    assert not panel.bar.main_button.isEnabled()
    assert "release it first" in panel.bar.main_button.toolTip()
    assert panel.bar.arm.text() == "Free the axes"
    assert panel.message.text().startswith("Held: ")
    assert panel.bar.strip[PenetrationPhase.HOLD].property("tone") == "warning"
    held_position_m = workbench.session.snapshot().command["zn"]
    assert held_position_m < 30e-6
    workbench.release()
    qtbot.wait(600)
    # The tip never retracts automatically.
    assert workbench.session.snapshot().command["zn"] == held_position_m
    press(qtbot, panel.bar.main_button)
    qtbot.waitUntil(lambda: get_phase(panel) is PenetrationPhase.ABORTED, timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.log.table.rowCount() == 3, timeout=LONG_MS)
    verdicts = [panel.log.table.item(row, 1).text() for row in range(3)]
    assert verdicts == ["aborted", "held", "done"]
    runs, problems = RunLog(workbench.operation.penetration_log.path).read()
    assert [str(run.verdict) for run in runs] == verdicts[::-1]
    assert problems == ()


def test_logged_runs_are_shown_and_a_robot_without_zn_is_reported(
    qtbot, make_robot_window, monkeypatch, tmp_path
):
    log = RunLog(tmp_path / "penetrations.jsonl")
    log.append(FAILED_RUN)
    with Path(log.path).open("a", encoding="utf-8") as file:
        file.write("{cut off\n")
    window = make_robot_window("picma")
    panel = window.panels["penetration"]
    window.docks["penetration"].raise_()
    assert window.workbench.operation.penetration_log.path == log.path
    qtbot.waitUntil(lambda: panel.log.table.rowCount() == 1, timeout=LONG_MS)
    assert panel.log.table.item(0, 7).text() == FAILED_RUN.reason
    qtbot.waitUntil(lambda: any("line 2" in text for text in list_notices(window)), timeout=LONG_MS)
    assert "has no axis 'zn' to penetrate with" in panel.message.text()
    assert not panel.bar.arm.isEnabled()
    assert not panel.simulated_cell.place_button.isEnabled()
    monkeypatch.setattr(type(window.workbench.session.service), "effects", property(lambda _: None))
    panel.tabs.setCurrentIndex(2)
    qtbot.waitUntil(
        lambda: panel.simulated_cell.hint_label.text() == REAL_MACHINE_TEXT, timeout=LONG_MS
    )
    assert not panel.simulated_cell.controls.isVisibleTo(panel)


def press_outdated_buttons(window, panel):
    """Check that a press on a button whose label belongs to an earlier phase does nothing."""
    panel.bar._shown_phase = PenetrationPhase.ARMED  # the label of the previous frame
    panel.bar._on_main_pressed()
    panel.bar._on_arm_pressed()
    assert get_phase(panel) is PenetrationPhase.DISARMED
    notice = "Nothing was done: the penetration entered another phase just before you pressed."
    assert list_notices(window)[0].startswith(notice)


def test_cells_are_visited_in_order_and_a_run_is_noted_with_its_cell(
    qtbot, window, panel, tmp_path
):
    press_outdated_buttons(window, panel)
    session, view = window.workbench.session, panel.cell_list
    panel.tabs.setCurrentIndex(3)
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    start = session.snapshot().command
    press(qtbot, view.add)
    session.go_to({"x": start["x"] + 1e-4, "zn": 64e-6})
    qtbot.waitUntil(lambda: session.snapshot().command["x"] == start["x"] + 1e-4, timeout=LONG_MS)
    press(qtbot, view.add)
    assert not view.skip.isEnabled()  # no cell was visited yet
    press(qtbot, view.next)
    assert view.table.item(0, 0).text() == "▸ 1"
    qtbot.waitUntil(lambda: session.snapshot().command["x"] == start["x"], timeout=LONG_MS)
    press(qtbot, view.skip)
    press(qtbot, view.next)

    def rests_at_second_cell():
        positions = view.cell_list.cells[1].positions
        return session.at_rest and session.snapshot().command == positions

    qtbot.waitUntil(rests_at_second_cell, timeout=LONG_MS)
    press(qtbot, view.penetrate)
    assert get_phase(panel) is PenetrationPhase.ARMED
    qtbot.waitUntil(lambda: "armed or running" in view.next.toolTip(), timeout=LONG_MS)
    status = panel.workbench.operation.penetration.status
    view.refresh(
        session.snapshot(), replace(status, phase=PenetrationPhase.FAILED, run=FAILED_RUN), None
    )
    cell_row = [view.table.item(1, column).text() for column in (0, 4, 5, 6)]
    assert cell_row == ["▸ 2", "failed", "", "too soft"]
    assert view.table.item(0, 4).text() == "skipped"
    view.export_to(tmp_path / "cells.csv")
    qtbot.waitUntil((tmp_path / "cells.csv").exists, timeout=LONG_MS)
    assert f",failed,,{FAILED_RUN.started},too soft" in (tmp_path / "cells.csv").read_text()
    panel.workbench.operation.penetration.disarm()
