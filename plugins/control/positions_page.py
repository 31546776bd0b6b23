"""Page with saved positions, homing, and the return to the previous position."""

from collections.abc import Callable, Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QPushButton, QWidget

from rotemina.app.language import choose_axis_scale, get_axis_label
from rotemina.app.motion.session import (
    HOME,
    LOAD,
    MAX_NAME_LENGTH,
    WORK,
    SavedPositions,
)
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    ChangingButton,
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Level, PendingConfirmation, Workbench
from rotemina.plugins.connection import (
    find_homing_objection,
    find_rest_objection,
    find_undo_objection,
)
from rotemina.plugins.control import tr
from rotemina.plugins.control.change_guide import LIFT_AXIS, ChangeGuide
from rotemina.plugins.control.step_choice import SpeedChoice


class PositionsPage(QWidget):
    """Page that saves positions of all axes by name and returns to them along a safe path."""

    def __init__(
        self,
        workbench: Workbench,
        speed: SpeedChoice,
        show_panel: Callable[[str], object] = lambda _: None,
    ) -> None:
        super().__init__()
        self._workbench, self._speed, self._show_panel = workbench, speed, show_panel
        self.positions = SavedPositions(workbench.settings.folder, workbench.robot)
        # The action that the second press of a button will confirm, such as "delete dish".
        self._confirmation: PendingConfirmation[str] = PendingConfirmation(workbench.session)
        self.name_choice = WheelSafeComboBox(
            tr("Saved positions"), tr("Saved positions of all axes")
        )
        self.name_choice.setPlaceholderText(tr("none saved yet"))
        self.name_choice.currentIndexChanged.connect(lambda _: self._show_chosen())
        self.name_field = QLineEdit()
        self.name_field.setPlaceholderText(tr("name of this position"))
        self.name_field.setMaxLength(MAX_NAME_LENGTH)
        self.name_field.setAccessibleName(tr("Name for the present position"))
        self.name_field.setToolTip(
            tr("Name for the present position; at most {most} characters").format(
                most=MAX_NAME_LENGTH
            )
        )
        self.name_field.textEdited.connect(lambda _: self._cancel_confirmation())
        self.go = make_button(tr("Go there"), self._go_to_chosen)
        self.delete = ChangingButton(tr("Delete"), tr("Delete?"), run=self._delete_position)
        self.save_button = ChangingButton(tr("Save"), tr("Replace?"), run=self._save_position)
        self.position_text = make_plain_label(lines=3)
        self._preset_labels = {HOME: tr("Home"), LOAD: tr("Load"), WORK: tr("Work")}
        self.place_buttons = {
            name: ChangingButton(word, tr("Set here?"), run=lambda name=name: self._go_or_set(name))
            for name, word in self._preset_labels.items()
        }
        self.change = make_button(tr("Change …"), self._open_change_guide)
        self._guide: ChangeGuide | None = None
        self.home = make_button(tr("Home all"), workbench.home)
        self.back = make_button(tr("Back"), workbench.undo)
        make_column(
            _make_centred_row((self.name_choice, 1), (self.go, 0), (self.delete, 0)),
            self.position_text,
            _make_centred_row((self.name_field, 1), (self.save_button, 0)),
            _make_centred_row(
                *((widget, 1) for widget in (*self.place_buttons.values(), self.change))
            ),
            _make_centred_row((self.home, 1), (self.back, 1)),
            1,
            on=self,
            margins=(10, 3, 10, 2),
            spacing=3,
        )
        if workbench.run_request(self.positions.read):
            self._refill_choice()

    def refresh(self, state: SessionState) -> None:
        """Enable or disable the buttons.

        Reset their texts if a stop has cancelled a pending confirmation.
        """
        if self._confirmation.item is None:
            self._cancel_confirmation()
        no_choice_reason = None if self.name_choice.currentText() else tr("no position is chosen")
        moving_reason = find_rest_objection(state)
        enable_unless(
            self.go,
            no_choice_reason or state.lock_reason or moving_reason,
            tr("Raise the tip above both positions, move across, lower it"),
        )
        enable_unless(self.delete, no_choice_reason, tr("Delete this position after confirmation"))
        unknown_reason = (
            None if state.position_known and state.command else tr("the position is not known")
        )
        no_name_reason = None if self.name_field.text().strip() else tr("type a name first")
        enable_unless(
            self.save_button,
            unknown_reason or moving_reason or no_name_reason,
            tr("Save the present target of all axes"),
        )
        for name, place_button in self.place_buttons.items():
            self._update_preset_button(name, place_button, state, unknown_reason)
        can_lift = LIFT_AXIS in self._workbench.robot.axes
        enable_unless(
            self.change,
            None if can_lift else tr("this robot has no z axis to lift the tip with"),
            tr("Change the pin or the dish, step by step"),
        )
        driver = self._workbench.session.driver
        enable_unless(
            self.home,
            find_homing_objection(state, driver),
            tr("Find the limit switches of all axes"),
        )
        enable_unless(
            self.back,
            find_undo_objection(state, undoable=self._workbench.session.can_undo),
            tr("Return to the position before the latest move: up, across, down"),
        )

    def _update_preset_button(
        self, name: str, place_button: QPushButton, state: SessionState, unknown_reason: str | None
    ) -> None:
        moving_reason = find_rest_objection(state)
        if name in self.positions.positions:
            tooltip = tr(
                "Go to position {name!r} along a safe path; to change it, save another one under "
                "this name"
            )
            enable_unless(
                place_button, state.lock_reason or moving_reason, tooltip.format(name=name)
            )
        else:
            tooltip = tr("Not set: press twice to save the present target of all axes")
            enable_unless(place_button, unknown_reason or moving_reason, tooltip)

    def _go_to_chosen(self) -> None:
        position = self.positions.positions.get(self.name_choice.currentText())
        if position is not None:
            session, speeds = self._workbench.session, self._speed.find_speed_limits(position)
            self._workbench.run_request(lambda: session.go_safely(position, speeds))

    def _go_or_set(self, name: str) -> None:
        """Go to the preset of this name or, if it is not set, save the current target there."""
        session = self._workbench.session
        position = self.positions.positions.get(name)
        if position is not None:
            speeds = self._speed.find_speed_limits(position)
            self._workbench.run_request(lambda: session.go_safely(position, speeds))
        elif self._is_confirmed(f"set {name}", self.place_buttons[name], tr("Set here?")):
            self._cancel_confirmation()
            command = session.snapshot().command
            self._change_positions(lambda: self.positions.save(name, command), name)

    def _open_change_guide(self) -> None:
        if self._guide is None:
            self._guide = ChangeGuide(
                self._workbench, lambda: self.positions.positions, self._show_panel, self
            )
        self._guide.open_at_first_step()

    def _save_position(self) -> None:
        name = self.name_field.text().strip()
        position = self._workbench.session.snapshot().command
        if name in self.positions.positions and not self._is_confirmed(
            f"replace {name}", self.save_button, tr("Replace?")
        ):
            return
        self._cancel_confirmation()
        if self._change_positions(lambda: self.positions.save(name, position), name):
            self.name_field.clear()
            self._workbench.notify(Level.GOOD, tr("Position {name!r} is saved.").format(name=name))

    def _delete_position(self) -> None:
        name = self.name_choice.currentText()
        if self._is_confirmed(f"delete {name}", self.delete, tr("Delete?")):
            self._cancel_confirmation()
            self._change_positions(lambda: self.positions.delete(name), "")

    def _change_positions(self, change: Callable[[], None], name: str) -> bool:
        """Change the saved positions, select a name, and return whether the change succeeded."""
        succeeded = self._workbench.run_request(change)
        self._refill_choice(name)
        return succeeded

    def _is_confirmed(self, action: str, pressed_button: QWidget, question: str) -> bool:
        """Return whether this press confirms an action.

        The first press shows the question on the button; the second press confirms.
        """
        if self._confirmation.item == action:
            return True
        self._cancel_confirmation()
        self._confirmation.put(action)
        pressed_button.setText(question)
        return False

    def _cancel_confirmation(self) -> None:
        self._confirmation.withdraw()
        self.save_button.setText(tr("Save"))
        self.delete.setText(tr("Delete"))
        for name, text in self._preset_labels.items():
            self.place_buttons[name].setText(text)

    def _refill_choice(self, selected: str = "") -> None:
        names = sorted(self.positions.positions, key=str.casefold)
        self.name_choice.clear()
        self.name_choice.addItems(names)
        self.name_choice.setCurrentIndex(
            names.index(selected) if selected in names else 0 if names else -1
        )

    def _show_chosen(self) -> None:
        self._cancel_confirmation()
        position = self.positions.positions.get(self.name_choice.currentText())
        text = "" if position is None else self._format_position(position)
        self.position_text.setText(text)
        self.position_text.setToolTip(make_tooltip(text) if text else "")

    def _format_position(self, position: Mapping[str, float]) -> str:
        axes = self._workbench.robot.axes
        texts = (
            f"{get_axis_label(axis)} "
            f"{choose_axis_scale(axes[axis]).format_with_unit(position[axis])}"
            for axis in axes
        )
        return ", ".join(text.replace(" ", "\u00a0") for text in texts)


def _make_centred_row(*widgets: tuple[QWidget, int]) -> QHBoxLayout:
    row = make_row(spacing=6)
    for widget, stretch in widgets:
        row.addWidget(widget, stretch, Qt.AlignmentFlag.AlignVCenter)
    return row
