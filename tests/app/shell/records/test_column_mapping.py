"""Naming the columns of a file without a header."""

import pytest
from PySide6.QtWidgets import QDialogButtonBox

from rotemina.app.shell.records import ask_columns
from rotemina.app.shell.records.column_mapping import ColumnMappingDialog
from rotemina.sim.records import read_preview

PANELS = ()

ROWS = "0;20,0;500\n0,01;20,1;501\n0,02;20,2;502\n"
COLUMN_NAMES = "t [s], x [mm], thx [urad]"


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "joints.txt"
    path.write_text(ROWS, "utf-8")
    return path


@pytest.fixture
def answer_dialog(monkeypatch):
    """Answer the dialog as soon as it is shown."""

    def set_answer(columns, accept=True):
        def show(dialog):
            if columns:
                dialog.set_columns(columns)
            (dialog.accept if accept else dialog.reject)()

        monkeypatch.setattr(ColumnMappingDialog, "show", show)

    return set_answer


@pytest.fixture
def ask_for_columns(qtbot, window):
    """Ask for a file's columns and return the calls of the callback."""

    def run_dialog(path):
        results = []
        ask_columns(path, window.workbench, window, lambda *args: results.append(args))
        qtbot.waitUntil(lambda: not window.workbench.busy, timeout=30_000)
        return results

    return run_dialog


def test_wrong_column_names_are_refused(qtbot, window, path):
    dialog = ColumnMappingDialog(path, read_preview(path), window.workbench.robot, window)
    ok = dialog._buttons.button(QDialogButtonBox.StandardButton.Ok)
    assert not ok.isEnabled()
    dialog.set_columns(COLUMN_NAMES)
    assert ok.isEnabled()
    assert dialog.columns == COLUMN_NAMES
    for columns in ("t [s], x [kg], thx [urad]", "t [s], x [mm], x [mm]", "t [s], x [mm], w [mm]"):
        dialog.set_columns(columns)
        assert not ok.isEnabled()
        assert dialog._complaint.text()


def test_the_names_are_remembered_for_files_of_the_same_shape(path, answer_dialog, ask_for_columns):
    answer_dialog(COLUMN_NAMES)
    assert ask_for_columns(path) == [(path, COLUMN_NAMES)]
    other = path.with_name("others.txt")
    other.write_text(ROWS.replace("20", "21"), "utf-8")
    answer_dialog(None)
    assert ask_for_columns(other) == [(other, COLUMN_NAMES)]


def test_the_named_file_is_loaded(qtbot, window, path, answer_dialog):
    answer_dialog(COLUMN_NAMES)
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=30_000):
        window.use_file_with_columns(path, window.workbench.planner.load_trajectory)
    assert window.workbench.plan.trajectory.axes == ("x", "thx")


def test_cancelling_changes_nothing(window, path, answer_dialog, ask_for_columns):
    answer_dialog(COLUMN_NAMES, accept=False)
    assert ask_for_columns(path) == []
    assert window.workbench.plan is None


def test_a_file_with_a_header_needs_no_dialog(tmp_path, ask_for_columns):
    path = tmp_path / "named.csv"
    path.write_text("t [s],x [mm]\n0,20\n", "utf-8")
    assert ask_for_columns(path) == [(path, None)]


def test_the_dialog_does_not_block_the_window(qtbot, window, path):
    ask_columns(path, window.workbench, window, lambda *_: None)
    qtbot.waitUntil(lambda: window.findChild(ColumnMappingDialog) is not None, timeout=30_000)
    dialog = window.findChild(ColumnMappingDialog)
    assert not dialog.isModal()
    dialog.close()
