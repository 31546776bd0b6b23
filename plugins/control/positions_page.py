"""Saved positions, homing, and the way back."""

from collections.abc import Callable, Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QPushButton, QWidget

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.saved_positions import HOME, LOAD, LONGEST_NAME, WORK, SavedPositions
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.pending_confirmations import Pending
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.changing_button import ChangingButton
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.connection.unavailable_reasons import (
    against_going_back,
    against_homing,
    in_motion,
)
from rotemina.plugins.control import tr
from rotemina.plugins.control.change_guide import LIFT, ChangeGuide
from rotemina.plugins.control.step_choice import SpeedChoice


class PositionsPage(QWidget):
    """Keep where the robot is under a name; go there again by a safe way."""

    def __init__(
        self,
        workbench: Workbench,
        speed: SpeedChoice,
        show_panel: Callable[[str], object] = lambda _: None,
    ) -> None:
        super().__init__()
        self._workbench, self._speed, self._show_panel = workbench, speed, show_panel
        self.positions = SavedPositions(workbench.settings.folder, workbench.robot)
        #: What the next press replaces or deletes.
        self._again: Pending[str] = Pending(workbench.session)
        self.names = SteadyChoice(tr("Saved positions"), tr("Saved positions of all axes"))
        self.names.setPlaceholderText(tr("none saved yet"))
        self.names.currentIndexChanged.connect(lambda _: self._choose())
        self.name = QLineEdit()
        self.name.setPlaceholderText(tr("name of this position"))
        self.name.setMaxLength(LONGEST_NAME)
        self.name.setAccessibleName(tr("Name for the present position"))
        self.name.setToolTip(
            tr("Name for the present position; at most {most} letters").format(most=LONGEST_NAME)
        )
        self.name.textEdited.connect(lambda _: self._forget())
        self.go = button(tr("Go there"), self._go)
        self.delete = ChangingButton(tr("Delete"), tr("Delete?"), run=self._delete)
        self.keep = ChangingButton(tr("Save"), tr("Replace?"), run=self._keep)
        self.place = plain_text(lines=3)
        self._words = {HOME: tr("Home"), LOAD: tr("Load"), WORK: tr("Work")}
        self.places = {
            name: ChangingButton(word, tr("Set here?"), run=lambda name=name: self._go_or_set(name))
            for name, word in self._words.items()
        }
        self.change = button(tr("Change …"), self._change)
        self._guide: ChangeGuide | None = None
        self.home = button(tr("Home all"), workbench.home)
        self.back = button(tr("Back"), workbench.undo)
        in_column(
            _row((self.names, 1), (self.go, 0), (self.delete, 0)),
            self.place,
            _row((self.name, 1), (self.keep, 0)),
            _row(*((one, 1) for one in (*self.places.values(), self.change))),
            _row((self.home, 1), (self.back, 1)),
            1,
            on=self,
            margins=(10, 3, 10, 2),
            spacing=3,
        )
        if workbench.ask(self.positions.read):
            self._list()

    def refresh(self, state: SessionState) -> None:
        """Lock what cannot be done now, and ask nothing that a stop has withdrawn."""
        if self._again.what is None:
            self._forget()
        none = None if self.names.currentText() else tr("no position is chosen")
        moving = in_motion(state)
        allow(
            self.go,
            none or state.locked or moving,
            tr("Raise the tip above both positions, move across, lower it"),
        )
        allow(self.delete, none, tr("Delete this position after confirmation"))
        known = None if state.position_known and state.command else tr("the position is not known")
        nameless = None if self.name.text().strip() else tr("type a name first")
        allow(self.keep, known or moving or nameless, tr("Save the present target of all axes"))
        for place, one in self.places.items():
            self._allow_place(place, one, state, known)
        lift = LIFT in self._workbench.robot.axes
        allow(
            self.change,
            None if lift else tr("this robot has no axis z to lift the tip"),
            tr("Change the pin or the dish, step by step"),
        )
        driver = self._workbench.session.driver
        allow(self.home, against_homing(state, driver), tr("Find the limit switches of all axes"))
        allow(
            self.back,
            against_going_back(state, undoable=self._workbench.session.undoable),
            tr("Return to the position before the latest move: up, across, down"),
        )

    def _allow_place(
        self, name: str, one: QPushButton, state: SessionState, unknown: str | None
    ) -> None:
        moving = in_motion(state)
        if name in self.positions.kept:
            tip = tr(
                "Go to position {name!r} along a safe path; save a new one by this name to move it"
            )
            allow(one, state.locked or moving, tip.format(name=name))
        else:
            tip = tr("Not set: press twice to save the present target of all axes")
            allow(one, unknown or moving, tip)

    # --- what buttons do --------------------------------------------------------------------------

    def _go(self) -> None:
        place = self.positions.kept.get(self.names.currentText())
        if place is not None:
            session, speeds = self._workbench.session, self._speed.speeds(place)
            self._workbench.ask(lambda: session.go_safely(place, speeds))

    def _go_or_set(self, name: str) -> None:
        """Go to a place that has a button of its own; where it is none yet, keep it."""
        session = self._workbench.session
        place = self.positions.kept.get(name)
        if place is not None:
            speeds = self._speed.speeds(place)
            self._workbench.ask(lambda: session.go_safely(place, speeds))
        elif self._sure(f"set {name}", self.places[name], tr("Set here?")):
            self._forget()
            now = session.snapshot().command
            self._do(lambda: self.positions.keep(name, now), name)

    def _change(self) -> None:
        if self._guide is None:
            self._guide = ChangeGuide(
                self._workbench, lambda: self.positions.kept, self._show_panel, self
            )
        self._guide.begin()

    def _keep(self) -> None:
        name, place = self.name.text().strip(), self._workbench.session.snapshot().command
        if name in self.positions.kept and not self._sure(
            f"keep {name}", self.keep, tr("Replace?")
        ):
            return
        self._forget()
        if self._do(lambda: self.positions.keep(name, place), name):
            self.name.clear()
            self._workbench.notify(Level.GOOD, tr("Position {name!r} is saved.").format(name=name))

    def _delete(self) -> None:
        name = self.names.currentText()
        if self._sure(f"delete {name}", self.delete, tr("Delete?")):
            self._forget()
            self._do(lambda: self.positions.delete(name), "")

    def _do(self, change: Callable[[], None], name: str) -> bool:
        done = self._workbench.ask(change)
        self._list(name)
        return done

    def _sure(self, what: str, asked: QWidget, word: str) -> bool:
        """Whether this is the second press for the same; the first one changes the button."""
        if self._again.what == what:
            return True
        self._forget()
        self._again.put(what)
        asked.setText(word)
        return False

    def _forget(self) -> None:
        self._again.withdraw()
        self.keep.setText(tr("Save"))
        self.delete.setText(tr("Delete"))
        for name, word in self._words.items():
            self.places[name].setText(word)

    # --- what is shown ----------------------------------------------------------------------------

    def _list(self, name: str = "") -> None:
        names = sorted(self.positions.kept, key=str.casefold)
        self.names.clear()
        self.names.addItems(names)
        self.names.setCurrentIndex(names.index(name) if name in names else min(0, len(names) - 1))

    def _choose(self) -> None:
        self._forget()
        place = self.positions.kept.get(self.names.currentText())
        text = "" if place is None else self._text(place)
        self.place.setText(text)
        self.place.setToolTip(plain_tip(text) if text else "")

    def _text(self, place: Mapping[str, float]) -> str:
        axes = self._workbench.robot.axes
        return ", ".join(
            f"{label(axis)} {axis_scale(axes[axis]).text(place[axis])}".replace(" ", "\u00a0")
            for axis in axes
        )


def _row(*widgets: tuple[QWidget, int]) -> QHBoxLayout:
    row = in_row(spacing=6)
    for widget, stretch in widgets:
        row.addWidget(widget, stretch, Qt.AlignmentFlag.AlignVCenter)
    return row
