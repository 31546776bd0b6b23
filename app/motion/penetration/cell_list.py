"""A list of cells to penetrate in turn, with the outcome of each."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

from rotemina.app.motion.penetration.parameters import PenetrationError
from rotemina.app.motion.penetration.run_log import PenetrationRun, Verdict
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

MOST_CELLS = 999


class Outcome(StrEnum):
    """The outcome of a cell."""

    WAITING = "waiting"
    SKIPPED = "skipped"
    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class ListedCell:
    """One cell; ``number`` from 1 stays its own, ``place`` is of all axes, m and rad.

    ``depth`` is how far the thrust went, m; ``started`` and ``reason`` are its run's.
    """

    number: int
    place: Mapping[str, float]
    outcome: Outcome = Outcome.WAITING
    depth: float | None = None
    started: str = ""
    reason: str = ""


class CellList:
    """The cells in the order in which they were added, and the one that it is at.

    It moves nothing: who shows it asks for consent, and the session for motion.
    """

    def __init__(self) -> None:
        self.cells: tuple[ListedCell, ...] = ()
        self.current: ListedCell | None = None
        self._last = 0

    def add(self, place: Mapping[str, float]) -> ListedCell:
        """Add a cell at the present position of all axes.

        Raises
        ------
        PenetrationError
            If nobody knows where the axes are, or the list is full.
        """
        if not place:
            raise PenetrationError(
                message(
                    "engine",
                    "cells: the positions of the axes are unknown; home them, or reconnect",
                )
            )
        if len(self.cells) >= MOST_CELLS:
            raise PenetrationError(
                message("engine", "cells: the list has {most}; remove one").fill(most=MOST_CELLS)
            )
        self._last += 1
        cell = ListedCell(self._last, dict(place))
        self.cells = (*self.cells, cell)
        return cell

    def remove(self, number: int) -> None:
        """Take a cell from the list; the others keep their numbers."""
        self.cells = tuple(one for one in self.cells if one.number != number)
        if self.current is not None and self.current.number == number:
            self.current = None

    def following(self) -> ListedCell | None:
        """Return the first cell that waits behind the present one, or before it; None: no more."""
        at = self.current.number if self.current is not None else 0
        waiting = [one for one in self.cells if one.outcome is Outcome.WAITING and one.number != at]
        return next((one for one in waiting if one.number > at), waiting[0] if waiting else None)

    def go_on(self, cell: ListedCell) -> None:
        """Be at a cell."""
        self.current = cell

    def skip(self) -> None:
        """Leave the present cell out."""
        self._become(Outcome.SKIPPED)

    def take(self, number: int, run: PenetrationRun) -> None:
        """Note the outcome of a cell."""
        done = run.verdict is Verdict.DONE
        depth = run.thrust.depth if run.thrust is not None else None
        outcome = Outcome.DONE if done else Outcome.FAILED
        self._become(outcome, number, depth=depth, started=run.started, reason=run.reason)

    def as_csv(self, robot: Robot) -> str:
        """Return the list as CSV: SI units, a decimal point, one line for each cell."""
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        places = [f"{axis} [{robot.unit(axis)}]" for axis in robot.axes]
        writer.writerow(["cell", *places, "outcome", "depth [m]", "started", "reason"])
        for cell in self.cells:
            place = [repr(cell.place[axis]) for axis in robot.axes]
            depth = "" if cell.depth is None else repr(cell.depth)
            told = [str(cell.outcome), depth, cell.started, cell.reason]
            writer.writerow([cell.number, *place, *told])
        return out.getvalue()

    def _become(
        self,
        outcome: Outcome,
        number: int | None = None,
        *,
        depth: float | None = None,
        started: str = "",
        reason: str = "",
    ) -> None:
        if number is None:
            number = self.current.number if self.current is not None else 0
        self.cells = tuple(
            replace(one, outcome=outcome, depth=depth, started=started, reason=reason)
            if one.number == number
            else one
            for one in self.cells
        )
        if self.current is not None and self.current.number == number:
            self.current = next(one for one in self.cells if one.number == number)
