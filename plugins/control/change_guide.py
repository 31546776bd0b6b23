"""Guided change of pin or dish; nothing descends by itself with the new one."""

from collections.abc import Callable, Mapping
from math import isfinite
from typing import NamedTuple

from PySide6.QtWidgets import QDialog, QLabel, QWidget

from rotemina.app.motion.saved_positions import LOAD, WORK
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.pending_confirmations import Pending
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.connection.unavailable_reasons import against_teaching, in_motion
from rotemina.plugins.control import tr

LIFT = "z"
_THERE = 1e-9  # m or rad


class Step(NamedTuple):
    """A step: its action, its button, why it is unavailable, and whether it is done."""

    text: str
    word: str
    run: Callable[[], object]
    against: Callable[[SessionState], str | None]
    done: Callable[[SessionState], bool]


class ChangeGuide(QDialog):
    """One step after the other, each by a press of its own; the window can be used beside it.

    Parameters
    ----------
    workbench : Workbench
    places : mapping of str to (mapping axis -> float)
        Saved positions, m or rad.
    show_panel : callable
        Brings a panel up by its name.
    parent : QWidget
    """

    def __init__(
        self,
        workbench: Workbench,
        places: Callable[[], Mapping[str, Mapping[str, float]]],
        show_panel: Callable[[str], object],
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Change pin or dish"))
        self._bench, self._session = workbench, workbench.session
        self._places, self._show_panel = places, show_panel
        self._teaching: Pending[bool] = Pending(workbench.session)
        self._at, self._begun = 0, False
        self._top = self._session.robot.axes[LIFT].range[1]
        self.steps = self._listed()
        self.lines = [QLabel() for _ in self.steps]
        words = [*(step.word for step in self.steps), tr("Teach here?")]
        self.do = ChangingButton(*words, run=self._do)  # a double click on Release must not move
        self.skip = button(tr("Skip"), self._next, tr("Skip this step"))
        in_column(*self.lines, on=self).addLayout(in_row((self.do, 1), self.skip))
        workbench.refreshed.connect(self.refresh)

    @property
    def at(self) -> int:
        """Which step is next; their number after the last one."""
        return self._at

    def begin(self) -> None:
        """Begin with the first step."""
        self._at, self._begun = 0, False
        self.refresh(self._session.snapshot())
        self.show()
        self.raise_()

    def refresh(self, state: SessionState) -> None:
        """Continue where a step is done, and say which one is next."""
        if not self.isVisible():
            return
        if self._begun and self.steps[self._at].done(state):
            self._next()
        for number, (line, step) in enumerate(zip(self.lines, self.steps, strict=True)):
            sign = "✓" if number < self._at else "▸" if number == self._at else "  "
            line.setText(f"{sign} {number + 1}  {step.text}")
            line.setEnabled(number <= self._at)
        if self._at < len(self.steps):
            step = self.steps[self._at]
            asked = self._teaching.what is not None
            self.do.show_meaning(tr("Teach here?") if asked else step.word)
            allow(self.do, step.against(state), step.text)

    def _do(self) -> None:
        self._begun = True
        self.steps[self._at].run()

    def _next(self) -> None:
        self._teaching.withdraw()
        self._at, self._begun = self._at + 1, False
        if self._at == len(self.steps):
            self.close()

    # --- steps ------------------------------------------------------------------------------------

    def _listed(self) -> tuple[Step, ...]:
        session = self._session
        top = self._top

        def to_move(state: SessionState) -> str | None:
            return state.locked or in_motion(state)

        def to_place(name: str) -> Callable[[SessionState], str | None]:
            none = tr("position {name!r} is not saved; skip the step or save the position")
            return lambda state: (
                to_move(state) if name in self._places() else none.format(name=name)
            )

        return (
            Step(
                tr("Retract: Z to its upper end"),
                tr("Retract"),
                lambda: self._bench.go_to({LIFT: top}),
                to_move,
                lambda state: _rests_at(state, {LIFT: top}),
            ),
            Step(
                tr("Go to the load position"),
                tr("Go there"),
                lambda: self._bench.ask(lambda: session.go_safely(self._places()[LOAD])),
                to_place(LOAD),
                lambda state: _rests_at(state, self._places().get(LOAD, {})),
            ),
            Step(
                tr("Discard the floor and the tip in the picture"),
                tr("Discard"),
                self._forget,
                to_move,
                lambda _: self._floor() is None,
            ),
            Step(
                tr("Lock; then change the pin or the dish by hand"),
                tr("Stop and lock"),
                self._bench.emergency_stop,
                lambda _: None,
                lambda state: state.latched is not None,
            ),
            Step(
                tr("Pin or dish changed, hands clear: release the lock"),
                tr("Release"),
                self._bench.release,
                lambda _: None,
                lambda state: state.latched is None,
            ),
            Step(
                tr("Move above the work position with Z raised"),
                tr("Go there"),
                lambda: self._bench.ask(lambda: session.go_safely(self._above_work())),
                to_place(WORK),
                lambda state: _rests_at(state, self._above_work()),
            ),
            Step(
                tr("Find the tip in the microscope; lower it slowly by hand"),
                tr("Show the microscope"),
                lambda: self._show_panel("microscope"),
                lambda _: None,
                lambda _: True,
            ),
            Step(
                tr("Teach the floor where the tip touches"),
                tr("Teach floor"),
                self._teach,
                lambda state: against_teaching(state, session.bounds.keep_out),
                lambda _: self._floor() is not None,
            ),
        )

    def _above_work(self) -> dict[str, float]:
        """Return the work position with Z at its upper end: the new pin may be longer."""
        return {**self._places().get(WORK, {}), LIFT: self._top}

    def _forget(self) -> None:
        if self._floor() is not None:
            self._bench.clear_floor()
        self._bench.ask(lambda: self._bench.microscope.track(False))

    def _teach(self) -> None:
        """Ask again; a stop withdraws the question."""
        if self._teaching.take():
            self._bench.teach_floor()
        else:
            self._teaching.put(True)

    def _floor(self) -> float | None:
        zone = self._session.bounds.keep_out
        return zone.floor if zone is not None and isfinite(zone.floor) else None


def _rests_at(state: SessionState, place: Mapping[str, float]) -> bool:
    """Whether the machine rests there, as commanded."""
    there = all(abs(state.command.get(axis, at + 1.0) - at) <= _THERE for axis, at in place.items())
    return there and in_motion(state) is None
