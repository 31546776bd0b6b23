"""The faults panel: history of a real session, and a virtual board in a separate process."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog

from rotemina.drivers.contract import ConnectionLostError
from rotemina.drivers.simulator import Simulator

# Starting a virtual board brings the connection panel to the front.
PANELS = {"connection"}

LONG_MS = 30_000


class DisconnectingSimulator(Simulator):
    name = "losing"
    is_cut = False

    def _read(self):
        if self.is_cut:
            raise ConnectionLostError("losing: the <cable> is torn off")
        return super()._read()


@pytest.fixture
def panel(window):
    return window.panels["faults"]


def list_rows(panel):
    table = panel.table
    return [
        (table.item(row, 1).text(), table.item(row, 2).text()) for row in range(table.rowCount())
    ]


def wait_for_row(qtbot, panel, *row):
    qtbot.waitUntil(lambda: row in list_rows(panel), timeout=LONG_MS)


def test_rows_are_listed_newest_first_copied_written_and_cleared(
    qtbot, window, panel, tmp_path, monkeypatch
):
    wait_for_row(qtbot, panel, "recovered", "connected")
    panel.table.selectRow(0)
    window.workbench.go_to({"x": 1.0})
    window.workbench.emergency_stop()
    wait_for_row(qtbot, panel, "stop and lock", "stop and lock locked")
    window.workbench.release()
    wait_for_row(qtbot, panel, "stop and lock", "released")
    kinds = ["stop and lock", "stop and lock", "refused", "recovered"]
    assert [kind for kind, _ in list_rows(panel)] == kinds
    assert "x" in list_rows(panel)[2][1]
    assert panel.table.item(0, 0).text().count(":") == 2
    # The selected row stays selected when rows are added above it.
    assert [entry.text for entry in panel.table.list_selected_entries()] == ["connected"]

    qtbot.keyClick(panel.table, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    selected_text = QGuiApplication.clipboard().text()
    panel.table.clearSelection()
    qtbot.mouseClick(panel.copy, Qt.MouseButton.LeftButton)
    lines = QGuiApplication.clipboard().text().splitlines()
    assert [line.split("\t")[1] for line in lines] == kinds[::-1]
    assert selected_text == lines[0] + "\n"
    target = tmp_path / "faults.txt"
    monkeypatch.setattr(QFileDialog, "show", lambda dialog: dialog.fileSelected.emit(str(target)))
    qtbot.mouseClick(panel.save, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(target.exists, timeout=LONG_MS)
    assert target.read_text("utf-8").splitlines() == lines

    qtbot.mouseClick(panel.clear_rows, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: panel.table.rowCount() == 0, timeout=LONG_MS)
    qtbot.waitUntil(lambda: not panel.save.isEnabled(), timeout=LONG_MS)
    window.workbench.go_to({"x": 1.0})
    qtbot.waitUntil(lambda: panel.table.rowCount() == 1, timeout=LONG_MS)


def test_a_lost_device_is_listed_as_plain_text(qtbot, make_robot_window):
    window = make_robot_window(driver=DisconnectingSimulator)
    panel = window.panels["faults"]
    wait_for_row(qtbot, panel, "recovered", "connected")
    window.workbench.session.driver.is_cut = True
    wait_for_row(qtbot, panel, "lost", "losing: the <cable> is torn off")
    assert "&lt;cable&gt;" in panel.table.item(0, 2).toolTip()
    assert not panel.clear_fault.isEnabled()
    assert "reconnect" in panel.clear_fault.toolTip()


def test_a_virtual_board_starts_accepts_faults_and_ends_with_the_window(qtbot, window, panel):
    injection, board = panel.injection, panel.injection.board
    assert not injection.end_button.isEnabled()
    for row in injection.rows:
        assert not row.button.isEnabled()
        assert "start it first" in row.button.toolTip()
        assert all(field.accessibleName() for field in row.fields)
    qtbot.mouseClick(injection.start_button, Qt.MouseButton.LeftButton)
    assert not injection.start_button.isEnabled()
    qtbot.waitUntil(lambda: len(board.ports) == 2, timeout=LONG_MS)
    device = window.panels["connection"].device
    assert device.choice.currentText() == "mc68hc11"
    values = device.form.read_values()
    assert (values["port"], values["second_port"]) == tuple(port for port, _ in board.ports)
    assert not [row for row in list_rows(panel) if row[0] == "refused"]
    row = next(row for row in injection.rows if row.fault.title == "Cable")
    qtbot.waitUntil(row.button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(row.button, Qt.MouseButton.LeftButton)
    wait_for_row(qtbot, panel, "injected", "silence 2.0 s")
    board.inject("nonsense")
    qtbot.waitUntil(lambda: list_rows(panel)[0][0] == "refused", timeout=LONG_MS)
    assert "unknown command" in list_rows(panel)[0][1]
    assert window.close()
    assert not board.is_running


def test_a_board_that_fails_to_start_is_reported(qtbot, make_robot_window):
    window = make_robot_window("emps")
    panel = window.panels["faults"]
    panel.injection._start_board()
    qtbot.waitUntil(lambda: not panel.injection.board.is_running, timeout=LONG_MS)
    qtbot.waitUntil(lambda: any("ended: " in text for _, text in list_rows(panel)), timeout=LONG_MS)
    assert panel.injection.start_button.isEnabled()
