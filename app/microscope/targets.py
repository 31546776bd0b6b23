"""Targets marked in the picture, and their visit in order."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rotemina.app.microscope.click_corrections import ClickRun, Visit
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message


@dataclass(frozen=True, slots=True)
class Target:
    """A marked point, px, and its outcome."""

    column: float
    row: float
    visit: Visit | None = None
    note: str = ""

    @property
    def pixel(self) -> FloatArray:
        """Column and row (2,)."""
        return np.array([self.column, self.row])


@dataclass(slots=True)
class TargetSequence:
    """Targets in the order in which they were marked.

    ``begin`` makes the run that goes to a pixel; the next target is gone to when someone calls
    :meth:`next`, so that there is time for what is to be done at each.
    """

    begin: Callable[[FloatArray], ClickRun]
    targets: list[Target] = field(default_factory=list)
    _present: int | None = None
    _run: ClickRun | None = None

    def mark(self, pixel: FloatArray) -> None:
        """Add a target behind the others."""
        self.targets.append(Target(float(pixel[0]), float(pixel[1])))

    def clear(self) -> None:
        """Forget all targets.

        Raises
        ------
        MicroscopeError
            On the way to one.
        """
        self._refuse_under_way()
        self.targets.clear()
        self._present = self._run = None

    def next(self) -> Target:
        """Go to the first unvisited target.

        Raises
        ------
        MicroscopeError
            If there is none, or the tip is on its way to another.
        InputError
            If the move is refused; the target stays to be visited.
        """
        self._refuse_under_way()
        for index, target in enumerate(self.targets):
            if target.visit is None:
                self._run = self.begin(target.pixel)
                self._present = index
                self._note()
                return self.targets[index]
        raise MicroscopeError(message("engine", "every target has been visited; mark further ones"))

    @property
    def ended(self) -> bool:
        """Whether the visit has ended."""
        return self._run is None or self._run.ended

    def remove(self, index: int) -> None:
        """Forget one target.

        Raises
        ------
        MicroscopeError
            If there is no such one, or on the way to one.
        """
        self._refuse_under_way()
        if not 0 <= index < len(self.targets):
            raise MicroscopeError(
                message("engine", "there is no target {index}; there are {count}").fill(
                    index=index + 1, count=len(self.targets)
                )
            )
        del self.targets[index]
        self._present = self._run = None

    def abort(self, reason: str) -> None:
        """Stop the machine and end the present visit."""
        if self._run is not None:
            self._run.abort(reason)
            self._note()

    def step(self, now_s: float) -> Target | None:
        """Continue with the present visit; return its target, or None before the first."""
        if self._run is None or self._present is None:
            return None
        self._run.step(now_s)
        self._note()
        return self.targets[self._present]

    def _note(self) -> None:
        assert self._run is not None
        assert self._present is not None
        target, status = self.targets[self._present], self._run.status
        self.targets[self._present] = Target(target.column, target.row, status.visit, status.reason)

    def _refuse_under_way(self) -> None:
        if not self.ended:
            raise MicroscopeError(
                message("engine", "the tip is moving to a target; wait, or stop it first")
            )
