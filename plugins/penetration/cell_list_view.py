"""The list of cells: next, skip, penetrate; each motion needs its own press."""

from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from rotemina.app.display_units import axis_scale, label
from rotemina.app.files import write_text
from rotemina.app.motion.penetration.cell_list import Outcome
from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.motion.penetration.status import PenetrationStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.file_dialog import ask_where
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.table import Table
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.plan_preview import way_text
from rotemina.plugins.penetration.words import FIXED

_OUTCOMES = {
    Outcome.WAITING: mark("waiting"),
    Outcome.SKIPPED: mark("skipped"),
    Outcome.DONE: mark("done"),
    Outcome.FAILED: mark("failed"),
}
_TABLES = mark("Tables (*.csv);;All files (*)")


class CellListView(QWidget):
    """A table of cells above its buttons.

    Signals
    -------
    penetrate_asked()
        The parameters shown are to be armed for the cell that it is at.
    """

    penetrate_asked = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.list = workbench.operation.cells
        self._armed: int | None = None  # the cell for which a penetration is armed
        self._run: PenetrationRun | None = None  # the latest when it was
        axes = tuple(workbench.robot.axes)
        self._shown_axes = axes[: min(len(axes), 3)]
        heads = (
            tr("Cell"),
            *(label(axis) for axis in self._shown_axes),
            tr("Outcome"),
            tr("Depth"),
            tr("Why"),
        )
        self.table = Table(tr("Cells"), heads)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.setMinimumSize(200, 60)
        self.add = button(tr("Add here"), self._add)
        self.next = button(tr("Next"), self._next)
        self.skip = button(tr("Skip"), self._skip)
        self.penetrate = button(tr("Penetrate"), self.penetrate_asked.emit)
        self.remove = button(tr("Remove"), self._remove)
        self.export = button(tr("Export …"), self._ask_where)
        row = in_row(self.add, self.next, self.skip, self.penetrate, self.remove, self.export, 1)
        in_column((self.table, 1), row, on=self, margins=0, spacing=3)

    def armed(self, status: PenetrationStatus) -> None:
        """Note that a penetration was armed: its run is that of the cell that it is at."""
        current = self.list.current
        self._armed, self._run = (current.number if current is not None else None), status.run

    def refresh(self, state: SessionState, status: PenetrationStatus, why_not: str | None) -> None:
        """Take a run that has ended, and allow what can be done now."""
        if self._armed is not None and status.phase not in FIXED:
            if status.run is not None and status.run is not self._run:
                self.list.take(self._armed, status.run)
                self._fill()
            self._armed = None
        busy = tr("a penetration is armed or running") if status.phase in FIXED else None
        locked = spoken(state.locked) if state.locked else None
        moves = None if self._workbench.session.at_rest else tr("the machine is moving")
        still = busy or locked or moves
        none = None if self.list.cells else tr("the list is empty")
        at = None if self.list.current is not None else tr("go to a cell first")
        more = None if self.list.following() is not None else tr("no other cell is waiting")
        allow(
            self.add,
            None if state.position_known else tr("its position is unknown"),
            tr("Add a cell at the present position, with the tip above it"),
        )
        allow(self.next, still or none or more, tr("Go to the next waiting cell: up, across, down"))
        allow(self.skip, busy or at, tr("Skip this cell"))
        allow(
            self.penetrate,
            busy or at or why_not,
            tr("Arm for this cell; motion begins only with Start, above"),
        )
        allow(self.remove, busy or none, tr("Remove the selected cell"))
        allow(self.export, none, tr("Export the list as CSV"))

    def export_to(self, path: Path) -> None:
        """Write the list."""
        text = self.list.as_csv(self._workbench.robot)
        self._workbench.write_file("export cells", path, lambda: write_text(path, text))

    # --- what the operator does -------------------------------------------------------------------

    def _add(self) -> None:
        place = self._workbench.session.snapshot().command
        if self._workbench.ask(lambda: self.list.add(place)):
            self._fill()

    def _next(self) -> None:
        cell, session = self.list.following(), self._workbench.session
        if cell is not None and self._workbench.ask(lambda: session.go_safely(cell.place)):
            self.list.go_on(cell)
            self._fill()

    def _skip(self) -> None:
        self.list.skip()
        self._fill()

    def _remove(self) -> None:
        row = self.table.currentRow()
        if 0 <= row < len(self.list.cells):
            self.list.remove(self.list.cells[row].number)
            self._fill()

    def _ask_where(self) -> None:
        title, kinds = tr("Export cells"), tr(_TABLES)
        ask_where(self, self._workbench, title, kinds, "cells.csv", self.export_to)

    # --- what is shown ----------------------------------------------------------------------------

    def _fill(self) -> None:
        scales = {axis: axis_scale(self._workbench.robot.axes[axis]) for axis in self._shown_axes}
        current = self.list.current.number if self.list.current is not None else None
        rows = [
            (
                f"▸ {cell.number}" if cell.number == current else str(cell.number),
                *(scale.text(cell.place[axis]) for axis, scale in scales.items()),
                tr(_OUTCOMES[cell.outcome]),
                "" if cell.depth is None else way_text(cell.depth),
                spoken(cell.reason),
            )
            for cell in self.list.cells
        ]
        self.table.show_rows(rows, numbers=range(1, 1 + len(scales)))
        for row, cell in enumerate(self.list.cells):
            if cell.number == current:
                self.table.selectRow(row)
