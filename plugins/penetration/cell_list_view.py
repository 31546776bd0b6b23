"""List of cells to visit, skip and penetrate. Every motion needs a separate button press."""

from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from rotemina.app.language import choose_axis_scale, get_axis_label, translate_message
from rotemina.app.motion.penetration import CellOutcome, PenetrationRun, PenetrationStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.settings import write_text
from rotemina.app.shell.records import ask_save_path
from rotemina.app.widgets.controls import enable_unless, make_button
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import TextTable
from rotemina.app.workbench import Workbench
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.plan_preview import format_distance
from rotemina.plugins.penetration.words import LOCKED_PHASES

_OUTCOME_TEXTS = {
    CellOutcome.WAITING: mark("waiting"),
    CellOutcome.SKIPPED: mark("skipped"),
    CellOutcome.DONE: mark("done"),
    CellOutcome.FAILED: mark("failed"),
}
_TABLE_FILTER = mark("Tables (*.csv);;All files (*)")


class CellListView(QWidget):
    """Table of cells, with buttons for the current and the next cell.

    Signals
    -------
    penetrate_asked()
        The operator wants to arm the displayed parameters for the current cell.
    """

    penetrate_asked = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.cell_list = workbench.operation.cells
        # Number of the cell for which a penetration is armed.
        self._armed_cell_number: int | None = None
        # The latest run when the penetration was armed. A newer run belongs to the armed cell.
        self._run_before_arming: PenetrationRun | None = None
        axes = tuple(workbench.robot.axes)
        self._shown_axes = axes[:3]
        headings = (
            tr("Cell"),
            *(get_axis_label(axis) for axis in self._shown_axes),
            tr("Outcome"),
            tr("Depth"),
            tr("Why"),
        )
        self.table = TextTable(tr("Cells"), headings)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.setMinimumSize(200, 60)
        self.add = make_button(tr("Add here"), self._add)
        self.next = make_button(tr("Next"), self._go_to_next)
        self.skip = make_button(tr("Skip"), self._skip)
        self.penetrate = make_button(tr("Penetrate"), self.penetrate_asked.emit)
        self.remove = make_button(tr("Remove"), self._remove)
        self.export = make_button(tr("Export …"), self._ask_export_path)
        row = make_row(self.add, self.next, self.skip, self.penetrate, self.remove, self.export, 1)
        make_column((self.table, 1), row, on=self, margins=0, spacing=3)

    def note_armed(self, status: PenetrationStatus) -> None:
        """Remember that the penetration that was just armed belongs to the current cell."""
        current = self.cell_list.current
        self._armed_cell_number, self._run_before_arming = (
            (current.number if current is not None else None),
            status.run,
        )

    def refresh(
        self, state: SessionState, status: PenetrationStatus, arming_objection: str | None
    ) -> None:
        """Record the outcome of a finished run, and enable the actions that are possible now."""
        if self._armed_cell_number is not None and status.phase not in LOCKED_PHASES:
            if status.run is not None and status.run is not self._run_before_arming:
                self.cell_list.note_outcome(self._armed_cell_number, status.run)
                self._fill_table()
            self._armed_cell_number = None
        busy_objection = (
            tr("a penetration is armed or running") if status.phase in LOCKED_PHASES else None
        )
        lock_objection = translate_message(state.lock_reason) if state.lock_reason else None
        moving_objection = None if self._workbench.session.at_rest else tr("the machine is moving")
        motion_objection = busy_objection or lock_objection or moving_objection
        list_objection = None if self.cell_list.cells else tr("the list is empty")
        current_objection = None if self.cell_list.current is not None else tr("go to a cell first")
        next_objection = (
            None
            if self.cell_list.find_next_waiting() is not None
            else tr("no other cell is waiting")
        )
        enable_unless(
            self.add,
            None if state.position_known else tr("its position is unknown"),
            tr("Add a cell at the present position, with the tip above it"),
        )
        enable_unless(
            self.next,
            motion_objection or list_objection or next_objection,
            tr("Go to the next waiting cell: up, across, down"),
        )
        enable_unless(self.skip, busy_objection or current_objection, tr("Skip this cell"))
        enable_unless(
            self.penetrate,
            busy_objection or current_objection or arming_objection,
            tr("Arm for this cell; motion begins only with Start, above"),
        )
        enable_unless(self.remove, busy_objection or list_objection, tr("Remove the selected cell"))
        enable_unless(self.export, list_objection, tr("Export the list as CSV"))

    def export_to(self, path: Path) -> None:
        """Write the list as CSV."""
        text = self.cell_list.to_csv(self._workbench.robot)
        self._workbench.write_file("export cells", path, lambda: write_text(path, text))

    def _add(self) -> None:
        positions = self._workbench.session.snapshot().command
        if self._workbench.run_request(lambda: self.cell_list.add(positions)):
            self._fill_table()

    def _go_to_next(self) -> None:
        cell, session = self.cell_list.find_next_waiting(), self._workbench.session
        if cell is not None and self._workbench.run_request(
            lambda: session.go_safely(cell.positions)
        ):
            self.cell_list.set_current(cell)
            self._fill_table()

    def _skip(self) -> None:
        self.cell_list.skip_current()
        self._fill_table()

    def _remove(self) -> None:
        row = self.table.currentRow()
        if 0 <= row < len(self.cell_list.cells):
            self.cell_list.remove(self.cell_list.cells[row].number)
            self._fill_table()

    def _ask_export_path(self) -> None:
        title, file_filter = tr("Export cells"), tr(_TABLE_FILTER)
        ask_save_path(self, self._workbench, title, file_filter, "cells.csv", self.export_to)

    def _fill_table(self) -> None:
        scales = {
            axis: choose_axis_scale(self._workbench.robot.axes[axis]) for axis in self._shown_axes
        }
        current = self.cell_list.current.number if self.cell_list.current is not None else None
        rows = [
            (
                f"▸ {cell.number}" if cell.number == current else str(cell.number),
                *(scale.format_with_unit(cell.positions[axis]) for axis, scale in scales.items()),
                tr(_OUTCOME_TEXTS[cell.outcome]),
                "" if cell.depth is None else format_distance(cell.depth),
                translate_message(cell.reason),
            )
            for cell in self.cell_list.cells
        ]
        self.table.show_rows(rows, numeric_columns=range(1, 1 + len(scales)))
        for row, cell in enumerate(self.cell_list.cells):
            if cell.number == current:
                self.table.selectRow(row)
