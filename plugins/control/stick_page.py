"""Page for moving axes by joystick: mode, scaling law, owners of the axes, and taking over."""

from PySide6.QtWidgets import QButtonGroup, QGridLayout, QLabel, QPushButton, QWidget

from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation import STEP_PRESETS
from rotemina.app.panel import STALE_AGE_S
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import (
    make_column,
    make_grid,
    make_row,
)
from rotemina.app.widgets.text import ElidedLabel
from rotemina.app.workbench import Workbench, describe_motion
from rotemina.plugins.control import tr
from rotemina.plugins.control.wording import find_takeable_axes
from rotemina.plugins.teleoperation import (
    describe_trust,
    explain_no_motion,
    list_law_texts,
    make_mode_texts,
)
from rotemina.sim.messages import format_rounded


class StickPage(QWidget):
    """Page with the mode, the scaling law and the step preset of the joystick, and its state."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench, self._operation = workbench, workbench.operation
        teleoperator = self._operation.teleoperator
        self.modes: dict[str, QPushButton] = {}
        self.law = WheelSafeComboBox(tr("Scaling"), tr("Meaning of the stick's position"))
        for kind, choice in list_law_texts():
            self.law.addItem(choice.text, kind)
        self.law.activated.connect(
            lambda _: workbench.run_request(lambda: teleoperator.use_law(self.law.currentData()))
        )
        self.preset = WheelSafeComboBox(
            tr("Step preset"), tr("Factor on distance, speed and force of the joystick")
        )
        for factor in STEP_PRESETS:
            self.preset.addItem(f"× {format_rounded(factor, 6)}", factor)
        self.preset.activated.connect(lambda _: teleoperator.use_preset(self.preset.currentData()))
        self.trust, self.reason, self.owners = ElidedLabel(), ElidedLabel(), ElidedLabel()
        self.reason.setProperty("quiet", True)
        self.take_over = make_button(tr("Take over"), self._take_over)
        heading = QLabel(tr("Scaling"))
        scaling = make_row(heading, (self.law, 1), (self.preset, 1), spacing=6)
        owner_row = make_row((self.owners, 1), self.take_over)
        parts = self._make_mode_buttons(), scaling, self.trust, self.reason, owner_row, 1
        make_column(*parts, on=self, margins=(10, 6, 10, 4), spacing=4)

    def refresh(self, state: SessionState) -> None:
        """Show the state of the joystick and of the machine."""
        device_view = self._operation.devices.view
        teleoperation = self._operation.teleoperator.state
        is_stale = self._operation.clock() - device_view.host_time_s > STALE_AGE_S
        self.modes[teleoperation.mode].setChecked(True)
        for box, value in ((self.law, teleoperation.law), (self.preset, teleoperation.preset)):
            # An open list is not changed, because the operator is choosing from it.
            if not box.view().isVisible():
                box.setCurrentIndex(box.findData(value))
        self.trust.show_text(describe_trust(device_view))
        self.reason.show_text(
            teleoperation.refusal_reason or explain_no_motion(teleoperation, stale=is_stale)
        )
        self.owners.show_text(describe_motion(state))
        takeable_axes = find_takeable_axes(state)
        enable_unless(
            self.take_over,
            None if takeable_axes else tr("no other control moves an axis"),
            tr("Take over axes that another control moves; they continue until your first command"),
        )

    def _make_mode_buttons(self) -> QGridLayout:
        grid = make_grid(spacing=4)
        group = QButtonGroup(self)
        teleoperator = self._operation.teleoperator
        for index, name in enumerate(teleoperator.modes.names):
            choice = make_mode_texts(name)
            mode_button = QPushButton(choice.text)
            mode_button.setCheckable(True)
            mode_button.setToolTip(make_tooltip(choice.tip))
            mode_button.setAccessibleName(tr("Mode {text}").format(text=choice.text))
            mode_button.clicked.connect(
                lambda _, name=name: self._workbench.run_request(
                    lambda: teleoperator.use_mode(name)
                )
            )
            group.addButton(mode_button)
            # The padding is small, so that five buttons fit in one row.
            mode_button.setStyleSheet("padding: 3px 2px;")
            grid.addWidget(mode_button, *divmod(index, 5))
            self.modes[name] = mode_button
        return grid

    def _take_over(self) -> None:
        session = self._workbench.session
        axes = find_takeable_axes(session.snapshot())
        self._workbench.run_request(lambda: session.reservations.take_over(axes, OPERATOR))
