"""Targets marked in the picture, which the tip visits in order."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.click_corrections import VisitRun, VisitState
from rotemina.sim.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class MarkedTarget:
    """A marked point, px, and the state of the visit to it; ``visit`` is None before it."""

    column: float
    row: float
    visit: VisitState | None = None
    reason: str = ""

    @property
    def pixel(self) -> FloatArray:
        """Column and row (2,)."""
        return np.array([self.column, self.row])


@dataclass(slots=True)
class TargetSequence:
    """Targets in the order in which they were marked.

    ``begin_visit`` starts a run that moves the tip to a pixel, and returns it. The tip moves to the
    next target only when :meth:`visit_next` is called. This leaves time to work at each target.
    """

    begin_visit: Callable[[FloatArray], VisitRun]
    targets: list[MarkedTarget] = field(default_factory=list)
    _current_index: int | None = None
    _run: VisitRun | None = None

    def mark(self, pixel: FloatArray) -> None:
        """Add a target at the end of the list."""
        self.targets.append(MarkedTarget(float(pixel[0]), float(pixel[1])))

    def clear(self) -> None:
        """Remove all targets.

        Raises
        ------
        MicroscopeError
            If the tip is on its way to a target.
        """
        self._refuse_during_visit()
        self.targets.clear()
        self._current_index = self._run = None

    def visit_next(self) -> MarkedTarget:
        """Start the move to the first unvisited target.

        Raises
        ------
        MicroscopeError
            If no target is left, or the tip is on its way to another one.
        InputError
            If the move is refused; the target stays unvisited.
        """
        self._refuse_during_visit()
        for index, target in enumerate(self.targets):
            if target.visit is None:
                self._run = self.begin_visit(target.pixel)
                self._current_index = index
                self._update_target()
                return self.targets[index]
        raise MicroscopeError("every target has been visited; mark more targets")

    @property
    def ended(self) -> bool:
        """Whether the visit has ended."""
        return self._run is None or self._run.ended

    def remove(self, index: int) -> None:
        """Remove one target.

        Raises
        ------
        MicroscopeError
            If there is no target with this index, or the tip is on its way to a target.
        """
        self._refuse_during_visit()
        if not 0 <= index < len(self.targets):
            raise MicroscopeError(
                "there is no target {index}; there are {count}",
                index=index + 1,
                count=len(self.targets),
            )
        del self.targets[index]
        self._current_index = self._run = None

    def abort(self, reason: str) -> None:
        """Stop the machine and end the current visit."""
        if self._run is not None:
            self._run.abort(reason)
            self._update_target()

    def step(self, now_s: float) -> MarkedTarget | None:
        """Advance the current visit; return its target, or None before the first visit."""
        if self._run is None or self._current_index is None:
            return None
        self._run.step(now_s)
        self._update_target()
        return self.targets[self._current_index]

    def _update_target(self) -> None:
        assert self._run is not None
        assert self._current_index is not None
        target, status = self.targets[self._current_index], self._run.status
        self.targets[self._current_index] = MarkedTarget(
            target.column, target.row, status.state, status.reason
        )

    def _refuse_during_visit(self) -> None:
        if not self.ended:
            raise MicroscopeError("the tip is moving to a target; wait, or stop it first")
