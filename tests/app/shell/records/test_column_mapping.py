"""Naming the columns of a file without a header."""

import pytest
from PySide6.QtWidgets import QDialogButtonBox

from rotemina.app.shell.records import ask_columns
from rotemina.app.shell.records.column_mapping import ColumnMappingDialog

PANELS = ()

ROWS = "0;20,0;500\n0,01;20,1;501\n0,02;20,2;502\n"
COLUMN_NAMES = "t [s], x [mm], thx [urad]"
LONG_MS = 30_000


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


def test_the_dialog_refuses_wrong_column_names_and_does_not_block_the_window(qtbot, window, path):
    ask_columns(path, window.workbench, window, lambda *_: None)
    qtbot.waitUntil(lambda: window.findChild(ColumnMappingDialog) is not None, timeout=LONG_MS)
    dialog = window.findChild(ColumnMappingDialog)
    assert not dialog.isModal()
    ok = dialog._buttons.button(QDialogButtonBox.StandardButton.Ok)
    assert not ok.isEnabled()
    dialog.set_columns(COLUMN_NAMES)
    assert ok.isEnabled()
    assert dialog.columns == COLUMN_NAMES
    for columns in ("t [s], x [kg], thx [urad]", "t [s], x [mm], x [mm]", "t [s], x [mm], w [mm]"):
        dialog.set_columns(columns)
        assert not ok.isEnabled()
        assert dialog._complaint.text()
    dialog.close()


def test_the_names_are_asked_once_for_files_of_the_same_shape(qtbot, window, path, answer_dialog):
    def ask(asked_path):
        answers = []
        ask_columns(asked_path, window.workbench, window, lambda *args: answers.append(args))
        qtbot.waitUntil(lambda: not window.workbench.busy, timeout=LONG_MS)
        return answers

    answer_dialog(COLUMN_NAMES, accept=False)
    assert ask(path) == []
    assert window.workbench.plan is None
    answer_dialog(COLUMN_NAMES)
    assert ask(path) == [(path, COLUMN_NAMES)]
    other, named = path.with_name("others.txt"), path.with_name("named.csv")
    other.write_text(ROWS.replace("20", "21"), "utf-8")
    named.write_text("t [s],x [mm]\n0,20\n", "utf-8")
    answer_dialog(None)
    assert ask(other) == [(other, COLUMN_NAMES)]
    assert ask(named) == [(named, None)]  # it has a header
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.use_file_with_columns(path, window.workbench.planner.load_trajectory)
    assert window.workbench.plan.trajectory.axes == ("x", "thx")
