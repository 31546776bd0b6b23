"""Press, drag and release in the picture, by the active mode."""

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QObject, Signal

from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.help_topics import Explained
from rotemina.app.shell.pending_confirmations import Pending
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.gate import Permit
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.feed_notice import against_aiming, against_clicking
from rotemina.plugins.microscope.overlays import ghost_text
from rotemina.plugins.microscope.picture_view import PictureView, PointerTool

_LEAST_LINE = 2.0  # px; shorter is no line but a click


class PointerTools(QObject):
    """The mode, and the moves that it asks for: nothing moves unless the mode is Move.

    Signals
    -------
    changed() : another mode.
    asks(str) : a move that has to be confirmed; empty: none any more.
    """

    changed = Signal()
    asks = Signal(str)

    def __init__(self, workbench: Workbench, microscope: Microscope, view: PictureView) -> None:
        super().__init__(view)
        self._workbench, self._microscope, self._view = workbench, microscope, view
        self.stage: str | None = None
        self._permit = workbench.session.permit()
        #: Whether a move is planned; a stop ends that at once, before it is told of.
        self._planned: Pending[bool] = Pending(workbench.session)
        self._asked: Callable[..., object] = microscope.go  # what waits for a yes
        self._begin = (0.0, 0.0)
        view.pressed.connect(self._press)
        view.dragged.connect(self._drag)
        view.released.connect(self._release)
        view.left.connect(lambda: self.choose(PointerTool.PAN))

    def choose(self, tool: PointerTool) -> None:
        """Have the left button do something else; a move that was only planned is forgotten."""
        self._forget()
        if tool is not self._view.tool:
            self._view.set_tool(tool)
            self.changed.emit()

    def against(
        self, status: MicroscopeStatus, state: SessionState
    ) -> dict[PointerTool, str | None]:
        """Return why a mode cannot be switched on now; one that is on can be switched off."""
        none = None if status.feed.frame is not None else tr("there is no picture")
        reasons = dict.fromkeys(PointerTool, none)
        reasons[PointerTool.MOVE] = against_clicking(status, state)
        reasons[self._view.tool] = None
        return reasons

    def refresh(self, status: MicroscopeStatus) -> None:
        """End the mode Move where someone has stopped, or the picture is not live any more."""
        before, self._permit = self._permit, self._workbench.session.permit()
        stopped = before.epoch != self._permit.epoch
        doubtful = against_aiming(status) is not None
        if stopped or (doubtful and self._planned.what):
            self._forget()
        if self._view.tool is PointerTool.MOVE and (stopped or doubtful):
            self.choose(PointerTool.PAN)

    def visit_next(self) -> None:
        """Go to the first target that was not visited; a large move is asked about first."""
        microscope = self._microscope
        targets = microscope.status.targets
        target = next((one for one in targets if one.visit is None), None)
        if target is not None and self._plan(target.column, target.row):
            self._go(microscope.visit_next)

    def answer(self, yes: bool) -> None:
        """Make the move that was asked about, or forget it."""
        if yes and self._planned.what and self._may_move():
            self._make(lambda permit: self._asked(confirmed=True, permit=permit))
        else:
            self._forget()

    # --- the mouse --------------------------------------------------------------------------------

    def _press(self, column: float, row: float) -> None:
        place = np.array([column, row])
        tool, ask, microscope = self._view.tool, self._workbench.ask, self._microscope
        self._begin = (column, row)
        if tool is PointerTool.MOVE:
            self._plan(column, row)
        elif tool is PointerTool.MARK:
            ask(lambda: microscope.mark_target(place))
        elif tool is PointerTool.TIP:
            ask(lambda: microscope.track(True, near=place))
        elif tool is PointerTool.CELL:
            ask(lambda: microscope.outline_cell(place))

    def _drag(self, column: float, row: float) -> None:
        if self._view.tool is PointerTool.MOVE and self._planned.what:
            self._plan(column, row)
        elif self._view.tool is PointerTool.MEASURE:
            self._view.line = (self._begin, (column, row))
            self._view.update()

    def _release(self, column: float, row: float) -> None:
        microscope = self._microscope
        if self._view.tool is PointerTool.MOVE and self._planned.what:
            self._go(microscope.go)
        elif self._view.tool is PointerTool.MEASURE:
            self._view.line = None
            begin, end = np.array(self._begin), np.array([column, row])
            if float(np.linalg.norm(end - begin)) >= _LEAST_LINE:
                self._workbench.ask(lambda: microscope.measure(begin, end))
            else:
                microscope.forget_measure()

    def _plan(self, column: float, row: float) -> bool:
        """Think a move through; one that is refused leaves none to be made."""
        self.asks.emit("")
        place = np.array([column, row])
        planned = self._may_move() and self._workbench.ask(
            lambda: self._microscope.plan(place, stage=self.stage)
        )
        if planned:
            self._planned.put(True)
        else:
            self._forget()
        return planned

    def _go(self, go: Callable[..., object]) -> None:
        """Make the planned move, or ask first."""
        status = self._microscope.status
        if status.planned is None or not self._may_move():
            self._forget()
        elif status.planned.confirm:
            self._asked = go
            self.asks.emit(tr("Move the tip {how}?").format(how=ghost_text(status)))
        else:
            self._make(lambda permit: go(permit=permit))

    def _make(self, move: Callable[[Permit], object]) -> None:
        """Make a move with the permit of the plan: no stop that came since lets it pass."""
        permit = self._planned.permit
        self._planned.withdraw()
        self.asks.emit("")
        self._workbench.ask(lambda: move(permit))
        self._microscope.cancel_plan()

    def _may_move(self) -> bool:
        """Return whether the machine may move by this picture, and say why not."""
        why = against_clicking(self._microscope.status, self._workbench.session.snapshot())
        if why is not None:
            text = tr("no move: {why}").format(why=spoken(why))
            self._workbench.refused.emit(Explained(text, is_refusal=True))
        return why is None

    def _forget(self) -> None:
        self.asks.emit("")
        self._planned.withdraw()
        if self._microscope.status.planned is not None:
            self._microscope.cancel_plan()
