"""Buttons for mode, law and step preset, with the active ones."""

from collections.abc import Callable, Iterable
from typing import Generic, TypeVar

from PySide6.QtWidgets import QButtonGroup, QLabel, QPushButton, QWidget

from rotemina.app.motion.teleoperation.intent import Intent
from rotemina.app.motion.teleoperation.scaling import STEP_PRESETS
from rotemina.app.motion.teleoperation.teleoperation_state import TeleoperationState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import named, plain_tip
from rotemina.app.widgets.labels import heading, plain_text
from rotemina.app.widgets.layouts import in_grid, in_row
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.teleoperation import tr, wording
from rotemina.plugins.teleoperation.wording import Choice
from rotemina.sim.quantities import rounded

T = TypeVar("T")


class Buttons(QWidget, Generic[T]):
    """One button for each of several choices, of which one is taken."""

    def __init__(
        self, what: str, choices: Iterable[tuple[T, Choice]], columns: int, use: Callable[[T], None]
    ) -> None:
        super().__init__()
        grid = in_grid(on=self, margins=0, spacing=6)
        self.buttons: dict[T, QPushButton] = {}
        group = QButtonGroup(self)
        for number, (value, choice) in enumerate(choices):
            one = named(QPushButton(choice.text), f"{what} {choice.text}", plain_tip(choice.tip))
            one.setCheckable(True)
            one.clicked.connect(lambda _, value=value: use(value))
            group.addButton(one)
            grid.addWidget(one, *divmod(number, columns))
            self.buttons[value] = one

    def show_choice(self, value: T) -> None:
        """Show which one is taken."""
        self.buttons[value].setChecked(True)


class ChoiceSection(Section):
    """How the stick moves the robot."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Mode"))
        steered = workbench.operation.teleoperator
        self.modes = Buttons(
            tr("Mode"),
            [(name, wording.mode_choice(name)) for name in steered.modes.names],
            3,
            lambda name: workbench.ask(lambda: steered.use_mode(name)),
        )
        self.laws = Buttons(
            tr("Scaling"),
            wording.law_choices(),
            3,
            lambda kind: workbench.ask(lambda: steered.use_law(kind)),
        )
        self.preset = SteadyChoice(
            tr("Step preset"), tr("Factor on distance, speed and force of every coordinate")
        )
        for factor in STEP_PRESETS:
            self.preset.addItem(f"× {rounded(factor, 6)}", factor)
        self.preset.activated.connect(lambda _: steered.use_preset(self.preset.currentData()))
        self.factor = named(plain_text(), tr("Present factor"))
        self.clutch = plain_text(lines=2)
        self.column.addWidget(self.modes)
        self.column.addWidget(heading(tr("Scaling")))
        self.column.addWidget(self.laws)
        row = in_row(QLabel(tr("Step")), self.preset, (self.factor, 1), spacing=8)
        self.column.addLayout(row)
        self.column.addWidget(self.clutch)

    def refresh(self, state: TeleoperationState, intent: Intent) -> None:
        """Show what acts now."""
        self.modes.show_choice(state.mode)
        self.laws.show_choice(state.law)
        if not self.preset.view().isVisible():  # somebody is choosing
            self.preset.select(state.preset)
        self.factor.setText(wording.factor_text(state.factor, intent.held))
        self.clutch.setText(wording.clutch_text(state.law, intent.held))
