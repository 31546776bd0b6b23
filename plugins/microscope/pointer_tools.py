"""Actions for press, drag and release in the picture, which depend on the active mode."""

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QObject, Signal

from rotemina.app.language import translate_message
from rotemina.app.microscope import Microscope, MicroscopeStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.workbench import NoticeMessage, PendingConfirmation, Workbench
from rotemina.drivers.contract import Permit
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.feed_notice import find_aiming_objection, find_click_objection
from rotemina.plugins.microscope.overlays import describe_planned_move
from rotemina.plugins.microscope.picture_view import PictureView, PointerTool

# A shorter line counts as a click.
_MIN_LINE_PX = 2.0


class PointerController(QObject):
    """Controller of the mode and of the moves that it requests.

    The picture moves the tip only in the mode Move, or for a visit to a marked target.

    Signals
    -------
    changed() : the mode has changed.
    confirmation_requested(str) : question whether to move; empty to withdraw the question.
    """

    changed = Signal()
    confirmation_requested = Signal(str)

    def __init__(self, workbench: Workbench, microscope: Microscope, view: PictureView) -> None:
        super().__init__(view)
        self._workbench, self._microscope, self._view = workbench, microscope, view
        self.stage: str | None = None
        self._permit = workbench.session.permit()
        #: Whether a move is planned. A stop cancels it at once, before the next refresh.
        self._pending_plan: PendingConfirmation[bool] = PendingConfirmation(workbench.session)
        # The move that waits for a confirmation.
        self._move_to_confirm: Callable[..., object] = microscope.go
        self._press_pixel = (0.0, 0.0)
        view.pressed.connect(self._press)
        view.dragged.connect(self._drag)
        view.released.connect(self._release)
        view.mode_ended.connect(lambda: self.choose_tool(PointerTool.PAN))

    def choose_tool(self, tool: PointerTool) -> None:
        """Set the action of the left button. A move that was only planned is cancelled."""
        self._cancel_plan()
        if tool is not self._view.tool:
            self._view.set_tool(tool)
            self.changed.emit()

    def find_objections(
        self, status: MicroscopeStatus, state: SessionState
    ) -> dict[PointerTool, str | None]:
        """Return for each mode why it cannot be switched on now.

        The active mode has no objection, because it can always be switched off.
        """
        objection = None if status.feed.frame is not None else tr("there is no picture")
        reasons = dict.fromkeys(PointerTool, objection)
        reasons[PointerTool.MOVE] = find_click_objection(status, state)
        reasons[self._view.tool] = None
        return reasons

    def refresh(self, status: MicroscopeStatus) -> None:
        """End the mode Move after a stop, or when the picture is no longer live."""
        previous, self._permit = self._permit, self._workbench.session.permit()
        was_stopped = previous.epoch != self._permit.epoch
        is_unreliable = find_aiming_objection(status) is not None
        if was_stopped or (is_unreliable and self._pending_plan.item):
            self._cancel_plan()
        if self._view.tool is PointerTool.MOVE and (was_stopped or is_unreliable):
            self.choose_tool(PointerTool.PAN)

    def visit_next(self) -> None:
        """Go to the first unvisited target. A large move is confirmed first."""
        microscope = self._microscope
        targets = microscope.status.targets
        target = next((candidate for candidate in targets if candidate.visit is None), None)
        if target is not None and self._plan_move(target.column, target.row):
            self._make_or_confirm_move(microscope.visit_next)

    def answer(self, yes: bool) -> None:
        """Make the move that waits for a confirmation, or cancel it."""
        if yes and self._pending_plan.item and self._check_can_move():
            self._make_move(lambda permit: self._move_to_confirm(confirmed=True, permit=permit))
        else:
            self._cancel_plan()

    def _press(self, column: float, row: float) -> None:
        pixel = np.array([column, row])
        tool, ask, microscope = self._view.tool, self._workbench.run_request, self._microscope
        self._press_pixel = (column, row)
        if tool is PointerTool.MOVE:
            self._plan_move(column, row)
        elif tool is PointerTool.MARK:
            ask(lambda: microscope.mark_target(pixel))
        elif tool is PointerTool.TIP:
            ask(lambda: microscope.track(True, near=pixel))
        elif tool is PointerTool.CELL:
            ask(lambda: microscope.outline_cell(pixel))

    def _drag(self, column: float, row: float) -> None:
        if self._view.tool is PointerTool.MOVE and self._pending_plan.item:
            self._plan_move(column, row)
        elif self._view.tool is PointerTool.MEASURE:
            self._view.measure_line = (self._press_pixel, (column, row))
            self._view.update()

    def _release(self, column: float, row: float) -> None:
        microscope = self._microscope
        if self._view.tool is PointerTool.MOVE and self._pending_plan.item:
            self._make_or_confirm_move(microscope.go)
        elif self._view.tool is PointerTool.MEASURE:
            self._view.measure_line = None
            begin, end = np.array(self._press_pixel), np.array([column, row])
            if float(np.linalg.norm(end - begin)) >= _MIN_LINE_PX:
                self._workbench.run_request(lambda: microscope.measure(begin, end))
            else:
                microscope.clear_measurement()

    def _plan_move(self, column: float, row: float) -> bool:
        """Plan a move, and return whether it is possible. A refusal cancels the previous plan."""
        self.confirmation_requested.emit("")
        pixel = np.array([column, row])
        is_planned = self._check_can_move() and self._workbench.run_request(
            lambda: self._microscope.plan(pixel, stage=self.stage)
        )
        if is_planned:
            self._pending_plan.put(True)
        else:
            self._cancel_plan()
        return is_planned

    def _make_or_confirm_move(self, start_move: Callable[..., object]) -> None:
        status = self._microscope.status
        if status.planned_move is None or not self._check_can_move():
            self._cancel_plan()
        elif status.planned_move.needs_confirmation:
            self._move_to_confirm = start_move
            self.confirmation_requested.emit(
                tr("Move the tip {how}?").format(how=describe_planned_move(status))
            )
        else:
            self._make_move(lambda permit: start_move(permit=permit))

    def _make_move(self, move: Callable[[Permit], object]) -> None:
        """Make a move with the permit of its plan. A stop since then revokes that permit."""
        permit = self._pending_plan.permit
        self._pending_plan.withdraw()
        self.confirmation_requested.emit("")
        self._workbench.run_request(lambda: move(permit))
        self._microscope.cancel_plan()

    def _check_can_move(self) -> bool:
        """Return whether a move may rely on this picture; if not, report why."""
        objection = find_click_objection(
            self._microscope.status, self._workbench.session.snapshot()
        )
        if objection is not None:
            text = tr("no move: {why}").format(why=translate_message(objection))
            self._workbench.refused.emit(NoticeMessage(text, is_refusal=True))
        return objection is None

    def _cancel_plan(self) -> None:
        self.confirmation_requested.emit("")
        self._pending_plan.withdraw()
        if self._microscope.status.planned_move is not None:
            self._microscope.cancel_plan()
