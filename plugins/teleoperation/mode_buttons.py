"""Buttons for mode and scaling, and the step preset."""

from collections.abc import Callable, Iterable
from typing import Generic, TypeVar

from PySide6.QtWidgets import QButtonGroup, QLabel, QPushButton, QWidget

from rotemina.app.motion.inputs import Intent
from rotemina.app.motion.teleoperation import STEP_PRESETS, TeleoperationState
from rotemina.app.widgets.controls import WheelSafeComboBox, make_tooltip, name_widget
from rotemina.app.widgets.layout import Section, make_grid, make_row
from rotemina.app.widgets.text import make_heading, make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.plugins.teleoperation import tr, wording
from rotemina.plugins.teleoperation.wording import ButtonTexts
from rotemina.sim.messages import format_rounded

T = TypeVar("T")


class ChoiceButtons(QWidget, Generic[T]):
    """Buttons for several choices, exactly one of which is active."""

    def __init__(
        self,
        name: str,
        choices: Iterable[tuple[T, ButtonTexts]],
        columns: int,
        on_chosen: Callable[[T], None],
    ) -> None:
        super().__init__()
        grid = make_grid(on=self, margins=0, spacing=6)
        self.buttons: dict[T, QPushButton] = {}
        group = QButtonGroup(self)
        for index, (value, texts) in enumerate(choices):
            choice_button = name_widget(
                QPushButton(texts.text), f"{name} {texts.text}", make_tooltip(texts.tip)
            )
            choice_button.setCheckable(True)
            choice_button.clicked.connect(lambda _, value=value: on_chosen(value))
            group.addButton(choice_button)
            grid.addWidget(choice_button, *divmod(index, columns))
            self.buttons[value] = choice_button

    def show_choice(self, value: T) -> None:
        """Show which choice is active."""
        self.buttons[value].setChecked(True)


class ModeSection(Section):
    """Section to choose how the stick moves the robot."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Mode"))
        teleoperator = workbench.operation.teleoperator
        self.modes = ChoiceButtons(
            tr("Mode"),
            [(name, wording.make_mode_texts(name)) for name in teleoperator.modes.names],
            3,
            lambda name: workbench.run_request(lambda: teleoperator.use_mode(name)),
        )
        self.laws = ChoiceButtons(
            tr("Scaling"),
            wording.list_law_texts(),
            3,
            lambda kind: workbench.run_request(lambda: teleoperator.use_law(kind)),
        )
        self.preset = WheelSafeComboBox(
            tr("Step preset"), tr("Factor on distance, speed and force of every coordinate")
        )
        for factor in STEP_PRESETS:
            self.preset.addItem(f"× {format_rounded(factor, 6)}", factor)
        self.preset.activated.connect(lambda _: teleoperator.use_preset(self.preset.currentData()))
        self.factor = name_widget(make_plain_label(), tr("Present factor"))
        self.clutch = make_plain_label(lines=2)
        self.column.addWidget(self.modes)
        self.column.addWidget(make_heading(tr("Scaling")))
        self.column.addWidget(self.laws)
        row = make_row(QLabel(tr("Step")), self.preset, (self.factor, 1), spacing=8)
        self.column.addLayout(row)
        self.column.addWidget(self.clutch)

    def refresh(self, state: TeleoperationState, intent: Intent) -> None:
        """Show the active choices."""
        self.modes.show_choice(state.mode)
        self.laws.show_choice(state.law)
        # The list must not change while the operator is choosing from it.
        if not self.preset.view().isVisible():
            self.preset.select(state.preset)
        self.factor.setText(wording.format_factor(state.factor, intent.held))
        self.clutch.setText(wording.describe_clutch(state.law, intent.held))
