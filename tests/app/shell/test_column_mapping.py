"""Naming the columns of a file without a header."""

import pytest
from PySide6.QtWidgets import QDialogButtonBox

from rotemina.app.shell.column_mapping import ColumnMappingDialog, ask_columns
from rotemina.sim.records.preview import preview

PANELS = ()

ROWS = "0;20,0;500\n0,01;20,1;501\n0,02;20,2;502\n"
NAMED = "t [s], x [mm], thx [urad]"


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "joints.txt"
    path.write_text(ROWS, "utf-8")
    return path


@pytest.fixture
def answer(monkeypatch):
    """Answer the dialog as a person would, as soon as it is shown."""

    def give(columns, accept=True):
        def show(dialog):
            if columns:
                dialog.set_columns(columns)
            (dialog.accept if accept else dialog.reject)()

        monkeypatch.setattr(ColumnMappingDialog, "show", show)

    return give


@pytest.fixture
def asked(qtbot, window):
    """Ask for a file's columns, and return what came of it."""

    def ask(path):
        used = []
        ask_columns(path, window.workbench, window, lambda *given: used.append(given))
        qtbot.waitUntil(lambda: not window.workbench.busy, timeout=30_000)
        return used

    return ask


def test_the_first_rows_are_shown_and_wrong_names_are_refused(qtbot, window, path):
    dialog = ColumnMappingDialog(path, preview(path), window.workbench.robot, window)
    ok = dialog._buttons.button(QDialogButtonBox.StandardButton.Ok)
    assert not ok.isEnabled()
    dialog.set_columns(NAMED)
    assert ok.isEnabled()
    assert dialog.columns == NAMED
    for wrong in ("t [s], x [kg], thx [urad]", "t [s], x [mm], x [mm]", "t [s], x [mm], w [mm]"):
        dialog.set_columns(wrong)
        assert not ok.isEnabled()
        assert dialog._complaint.text()


def test_the_names_are_remembered_for_files_of_the_same_shape(path, answer, asked):
    answer(NAMED)
    assert asked(path) == [(path, NAMED)]
    other = path.with_name("others.txt")
    other.write_text(ROWS.replace("20", "21"), "utf-8")
    answer(None)
    assert asked(other) == [(other, NAMED)]


def test_the_named_file_is_loaded(qtbot, window, path, answer):
    answer(NAMED)
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=30_000):
        window.use_file(path, window.workbench.load_trajectory)
    assert window.workbench.plan.trajectory.axes == ("x", "thx")


def test_cancelling_changes_nothing(window, path, answer, asked):
    answer(NAMED, accept=False)
    assert asked(path) == []
    assert window.workbench.plan is None


def test_a_file_with_a_header_needs_no_dialog(tmp_path, asked):
    path = tmp_path / "named.csv"
    path.write_text("t [s],x [mm]\n0,20\n", "utf-8")
    assert asked(path) == [(path, None)]


def test_the_window_can_be_used_beside_the_dialog(qtbot, window, path):
    ask_columns(path, window.workbench, window, lambda *_: None)
    qtbot.waitUntil(lambda: window.findChild(ColumnMappingDialog) is not None, timeout=30_000)
    dialog = window.findChild(ColumnMappingDialog)
    assert not dialog.isModal()
    dialog.close()
