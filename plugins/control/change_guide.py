"""Guide for changing the pin (the tool) or the dish.

After the change, no step lowers Z automatically.
"""

from collections.abc import Callable, Mapping
from math import isfinite
from typing import NamedTuple

from PySide6.QtWidgets import QDialog, QLabel, QWidget

from rotemina.app.motion.session import LOAD, WORK
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import ChangingButton, enable_unless, make_button
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.workbench import PendingConfirmation, Workbench
from rotemina.plugins.connection import find_rest_objection, find_teach_objection
from rotemina.plugins.control import tr

LIFT_AXIS = "z"
# An axis is at a position if its command differs from it by no more than this, m or rad.
_POSITION_TOLERANCE = 1e-9


class GuideStep(NamedTuple):
    """Step of the guide.

    Attributes
    ----------
    text : str
        The instruction to the operator.
    button_text : str
    run : callable
        Runs when the operator presses the button.
    find_objection : callable
        Returns why the action is unavailable in a state, or None.
    is_done : callable
        Returns whether the step is completed in a state.
    """

    text: str
    button_text: str
    run: Callable[[], object]
    find_objection: Callable[[SessionState], str | None]
    is_done: Callable[[SessionState], bool]


class ChangeGuide(QDialog):
    """Dialog that leads through the steps of the change.

    Each step takes one press of the button; teaching the floor takes two. The rest of the window
    stays usable meanwhile.

    Parameters
    ----------
    workbench : Workbench
    get_saved_positions : callable
        Returns the saved positions: name -> axis -> m or rad.
    show_panel : callable
        Shows the panel with the given name.
    parent : QWidget
    """

    def __init__(
        self,
        workbench: Workbench,
        get_saved_positions: Callable[[], Mapping[str, Mapping[str, float]]],
        show_panel: Callable[[str], object],
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Change pin or dish"))
        self._workbench, self._session = workbench, workbench.session
        self._get_saved_positions, self._show_panel = get_saved_positions, show_panel
        # True while the first press of Teach floor waits for the second one, else None.
        self._teach_confirmation: PendingConfirmation[bool] = PendingConfirmation(workbench.session)
        self._step_index, self._is_step_started = 0, False
        self._z_upper_limit = self._session.robot.axes[LIFT_AXIS].range[1]
        self.steps = self._make_steps()
        self.lines = [QLabel() for _ in self.steps]
        button_texts = [*(step.button_text for step in self.steps), tr("Teach here?")]
        # A ChangingButton ignores the second click of a double click, which would start the next
        # move after Release.
        self.action_button = ChangingButton(*button_texts, run=self._run_step)
        self.skip_button = make_button(tr("Skip"), self._go_to_next_step, tr("Skip this step"))
        make_column(*self.lines, on=self).addLayout(
            make_row((self.action_button, 1), self.skip_button)
        )
        workbench.refreshed.connect(self.refresh)

    @property
    def step_index(self) -> int:
        """The index of the current step, or ``len(steps)`` once the last one is done."""
        return self._step_index

    def open_at_first_step(self) -> None:
        """Open the guide at the first step."""
        self._step_index, self._is_step_started = 0, False
        self._show_steps(self._session.snapshot())
        self.show()
        self.raise_()

    def refresh(self, state: SessionState) -> None:
        """Go to the next step if the current one is done, and mark the current step."""
        if not self.isVisible():
            return
        if self._is_step_started and self.steps[self._step_index].is_done(state):
            self._go_to_next_step()
        self._show_steps(state)

    def _show_steps(self, state: SessionState) -> None:
        for index, (line, step) in enumerate(zip(self.lines, self.steps, strict=True)):
            symbol = "✓" if index < self._step_index else "▸" if index == self._step_index else "  "
            line.setText(f"{symbol} {index + 1}  {step.text}")
            line.setEnabled(index <= self._step_index)
        if self._step_index < len(self.steps):
            step = self.steps[self._step_index]
            waits_for_confirmation = self._teach_confirmation.item is not None
            self.action_button.show_meaning(
                tr("Teach here?") if waits_for_confirmation else step.button_text
            )
            enable_unless(self.action_button, step.find_objection(state), step.text)

    def _run_step(self) -> None:
        self._is_step_started = True
        self.steps[self._step_index].run()

    def _go_to_next_step(self) -> None:
        self._teach_confirmation.withdraw()
        self._step_index, self._is_step_started = self._step_index + 1, False
        if self._step_index == len(self.steps):
            self.close()

    def _make_steps(self) -> tuple[GuideStep, ...]:
        session = self._session
        z_upper_limit = self._z_upper_limit

        def find_move_objection(state: SessionState) -> str | None:
            return state.lock_reason or find_rest_objection(state)

        def make_move_objection_finder(name: str) -> Callable[[SessionState], str | None]:
            not_saved = tr("position {name!r} is not saved; skip the step or save the position")
            return lambda state: (
                find_move_objection(state)
                if name in self._get_saved_positions()
                else not_saved.format(name=name)
            )

        return (
            GuideStep(
                tr("Retract: move Z to its upper limit"),
                tr("Retract"),
                lambda: self._workbench.go_to({LIFT_AXIS: z_upper_limit}),
                find_move_objection,
                lambda state: _is_resting_at(state, {LIFT_AXIS: z_upper_limit}),
            ),
            GuideStep(
                tr("Go to the load position"),
                tr("Go there"),
                lambda: self._workbench.run_request(
                    lambda: session.go_safely(self._get_saved_positions()[LOAD])
                ),
                make_move_objection_finder(LOAD),
                lambda state: _is_resting_at(state, self._get_saved_positions().get(LOAD, {})),
            ),
            GuideStep(
                tr("Discard the taught floor, and stop tracking the tip in the image"),
                tr("Discard"),
                self._discard_floor_and_tip,
                find_move_objection,
                lambda _: self._find_floor() is None,
            ),
            GuideStep(
                tr("Stop and lock; then change the pin or the dish by hand"),
                tr("Stop and lock"),
                self._workbench.emergency_stop,
                lambda _: None,
                # `latch_reason` is set only by an emergency stop; `lock_reason` also has other
                # causes.
                lambda state: state.latch_reason is not None,
            ),
            GuideStep(
                tr("Pin or dish changed, hands clear: release the lock"),
                tr("Release"),
                self._workbench.release,
                lambda _: None,
                lambda state: state.latch_reason is None,
            ),
            GuideStep(
                tr("Move above the work position with Z raised"),
                tr("Go there"),
                lambda: self._workbench.run_request(
                    lambda: session.go_safely(self._find_position_above_work())
                ),
                make_move_objection_finder(WORK),
                lambda state: _is_resting_at(state, self._find_position_above_work()),
            ),
            GuideStep(
                tr("Find the tip in the microscope; lower the tip slowly with the manual controls"),
                tr("Show the microscope"),
                lambda: self._show_panel("microscope"),
                lambda _: None,
                # The step is done as soon as its button has been pressed.
                lambda _: True,
            ),
            GuideStep(
                tr("Teach the floor where the tip touches"),
                tr("Teach floor"),
                self._teach_floor,
                lambda state: find_teach_objection(state, session.bounds.keep_out),
                lambda _: self._find_floor() is not None,
            ),
        )

    def _find_position_above_work(self) -> dict[str, float]:
        """Return the work position with Z at its upper limit, because the new pin may be longer."""
        return {**self._get_saved_positions().get(WORK, {}), LIFT_AXIS: self._z_upper_limit}

    def _discard_floor_and_tip(self) -> None:
        if self._find_floor() is not None:
            self._workbench.clear_floor()
        self._workbench.run_request(lambda: self._workbench.microscope.track(False))

    def _teach_floor(self) -> None:
        """Ask for confirmation at the first press, and teach the floor at the second.

        A stop in between cancels the confirmation.
        """
        if self._teach_confirmation.take():
            self._workbench.teach_floor()
        else:
            self._teach_confirmation.put(True)

    def _find_floor(self) -> float | None:
        zone = self._session.bounds.keep_out
        return zone.floor if zone is not None and isfinite(zone.floor) else None


def _is_resting_at(state: SessionState, position: Mapping[str, float]) -> bool:
    """Return whether the machine is at rest and its commands match a position, m or rad."""
    is_at_position = all(
        axis in state.command and abs(state.command[axis] - target) <= _POSITION_TOLERANCE
        for axis, target in position.items()
    )
    return is_at_position and find_rest_objection(state) is None
