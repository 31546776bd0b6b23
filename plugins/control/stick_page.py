"""Steering by stick: mode, law, owner, and taking over."""

from PySide6.QtWidgets import QButtonGroup, QGridLayout, QLabel, QPushButton, QWidget

from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation.scaling import STEP_PRESETS
from rotemina.app.panel import STALE_S
from rotemina.app.shell.state_words import describe_motion
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.app.widgets.layouts import in_column, in_grid, in_row
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.control import tr
from rotemina.plugins.control.wording import taken
from rotemina.plugins.teleoperation.wording import law_choices, mode_choice, reason_text, trust_text
from rotemina.sim.quantities import rounded


class HandPage(QWidget):
    """Mode, scaling law and step preset; trust, owners."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench, self._operation = workbench, workbench.operation
        steered = self._operation.teleoperator
        self.modes: dict[str, QPushButton] = {}
        self.law = SteadyChoice(tr("Scaling"), tr("Meaning of the stick's position"))
        for kind, choice in law_choices():
            self.law.addItem(choice.text, kind)
        self.law.activated.connect(
            lambda _: workbench.ask(lambda: steered.use_law(self.law.currentData()))
        )
        self.preset = SteadyChoice(
            tr("Step preset"), tr("Factor on distance, speed and force of the joystick")
        )
        for factor in STEP_PRESETS:
            self.preset.addItem(f"× {rounded(factor, 6)}", factor)
        self.preset.activated.connect(lambda _: steered.use_preset(self.preset.currentData()))
        self.trust, self.reason, self.owners = ElidedLabel(), ElidedLabel(), ElidedLabel()
        self.reason.setProperty("quiet", True)
        self.over = button(tr("Take over"), self._take_over)
        heading = QLabel(tr("Scaling"))
        scaling = in_row(heading, (self.law, 1), (self.preset, 1), spacing=6)
        owned = in_row((self.owners, 1), self.over)
        parts = self._mode_buttons(), scaling, self.trust, self.reason, owned, 1
        in_column(*parts, on=self, margins=(10, 6, 10, 4), spacing=4)

    def refresh(self, state: SessionState) -> None:
        """Show a moment of the machine."""
        view, steered = self._operation.devices.view, self._operation.teleoperator.state
        stale = self._operation.clock() - view.host_time_s > STALE_S
        self.modes[steered.mode].setChecked(True)
        for box, value in ((self.law, steered.law), (self.preset, steered.preset)):
            if not box.view().isVisible():  # somebody is choosing
                box.setCurrentIndex(box.findData(value))
        self.trust.show_text(trust_text(view))
        self.reason.show_text(steered.refused or reason_text(steered, stale=stale))
        self.owners.show_text(describe_motion(state))
        others = taken(state)
        allow(
            self.over,
            None if others else tr("no other control moves an axis"),
            tr("Take over axes that another control moves; they continue until your first command"),
        )

    def _mode_buttons(self) -> QGridLayout:
        grid = in_grid(spacing=4)
        group = QButtonGroup(self)
        steered = self._operation.teleoperator
        for number, name in enumerate(steered.modes.names):
            choice = mode_choice(name)
            one = QPushButton(choice.text)
            one.setCheckable(True)
            one.setToolTip(plain_tip(choice.tip))
            one.setAccessibleName(tr("Mode {text}").format(text=choice.text))
            one.clicked.connect(
                lambda _, name=name: self._workbench.ask(lambda: steered.use_mode(name))
            )
            group.addButton(one)
            one.setStyleSheet("padding: 3px 2px;")  # five of them in one row
            grid.addWidget(one, *divmod(number, 5))
            self.modes[name] = one
        return grid

    def _take_over(self) -> None:
        session = self._workbench.session
        axes = taken(session.snapshot())
        self._workbench.ask(lambda: session.reservations.take_over(axes, OPERATOR))
