"""List of cells to penetrate in turn, with the outcome of each."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration.run_log import PenetrationRun, PenetrationVerdict
from rotemina.sim.robot import Robot

MAX_CELL_COUNT = 999


class CellOutcome(StrEnum):
    """Outcome of a cell."""

    WAITING = "waiting"
    SKIPPED = "skipped"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class ListedCell:
    """One cell of the list.

    Attributes
    ----------
    number : int
        Counts from 1. It never changes, and is not reused after the cell is removed.
    positions : mapping of str to float
        Positions of all axes at the cell, m or rad.
    outcome : CellOutcome
    depth : float or None
        Measured depth of the thrust, m.
    started, reason : str
        Start time and reason of its penetration run.
    """

    number: int
    positions: Mapping[str, float]
    outcome: CellOutcome = CellOutcome.WAITING
    depth: float | None = None
    started: str = ""
    reason: str = ""


class CellList:
    """Cells in the order in which they were added, and the current cell.

    The list itself moves nothing. The panel that shows the list asks the operator for consent and
    requests the motion from the session.
    """

    def __init__(self) -> None:
        self.cells: tuple[ListedCell, ...] = ()
        self.current: ListedCell | None = None
        self._last_number = 0

    def add(self, positions: Mapping[str, float]) -> ListedCell:
        """Add a cell at the current positions of all axes.

        Raises
        ------
        PenetrationError
            If the positions of the axes are unknown, or the list is full.
        """
        if not positions:
            raise PenetrationError(
                "cells: the positions of the axes are unknown; home them, or reconnect"
            )
        if len(self.cells) >= MAX_CELL_COUNT:
            raise PenetrationError(
                "cells: the list is full ({most} cells); remove one", most=MAX_CELL_COUNT
            )
        self._last_number += 1
        cell = ListedCell(self._last_number, dict(positions))
        self.cells = (*self.cells, cell)
        return cell

    def remove(self, number: int) -> None:
        """Remove a cell from the list; the others keep their numbers."""
        self.cells = tuple(cell for cell in self.cells if cell.number != number)
        if self.current is not None and self.current.number == number:
            self.current = None

    def find_next_waiting(self) -> ListedCell | None:
        """Return the next waiting cell.

        The search starts after the current cell and continues from the beginning of the list. None
        means that no other cell is waiting.
        """
        current_number = self.current.number if self.current is not None else 0
        waiting_cells = [
            cell
            for cell in self.cells
            if cell.outcome is CellOutcome.WAITING and cell.number != current_number
        ]
        return next(
            (cell for cell in waiting_cells if cell.number > current_number),
            waiting_cells[0] if waiting_cells else None,
        )

    def set_current(self, cell: ListedCell) -> None:
        """Make a cell the current one."""
        self.current = cell

    def skip_current(self) -> None:
        """Mark the current cell as skipped."""
        self._set_outcome(CellOutcome.SKIPPED)

    def note_outcome(self, number: int, run: PenetrationRun) -> None:
        """Set the outcome of a cell from its run."""
        is_done = run.verdict is PenetrationVerdict.DONE
        depth = run.thrust.depth if run.thrust is not None else None
        outcome = CellOutcome.DONE if is_done else CellOutcome.FAILED
        self._set_outcome(outcome, number, depth=depth, started=run.started, reason=run.reason)

    def to_csv(self, robot: Robot) -> str:
        """Return the list as CSV: SI units, a decimal point, one line for each cell."""
        buffer = io.StringIO()
        writer = csv.writer(buffer, lineterminator="\n")
        columns = [f"{axis} [{robot.unit(axis)}]" for axis in robot.axes]
        writer.writerow(["cell", *columns, "outcome", "depth [m]", "started", "reason"])
        for cell in self.cells:
            positions = [repr(cell.positions[axis]) for axis in robot.axes]
            depth = "" if cell.depth is None else repr(cell.depth)
            result = [str(cell.outcome), depth, cell.started, cell.reason]
            writer.writerow([cell.number, *positions, *result])
        return buffer.getvalue()

    def _set_outcome(
        self,
        outcome: CellOutcome,
        number: int | None = None,
        *,
        depth: float | None = None,
        started: str = "",
        reason: str = "",
    ) -> None:
        if number is None:
            number = self.current.number if self.current is not None else 0
        self.cells = tuple(
            replace(cell, outcome=outcome, depth=depth, started=started, reason=reason)
            if cell.number == number
            else cell
            for cell in self.cells
        )
        if self.current is not None and self.current.number == number:
            self.current = next(cell for cell in self.cells if cell.number == number)
