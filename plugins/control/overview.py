"""Overview at the top of the panel: joystick state, tip height, and speed of moves."""

from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_AGE_S
from rotemina.app.widgets.controls import (
    name_widget,
    set_property,
    show_tooltip,
)
from rotemina.app.widgets.layout import make_grid, make_row
from rotemina.app.widgets.text import ElidedLabel
from rotemina.app.workbench import StateTone, Workbench, set_tone
from rotemina.plugins.control import tr
from rotemina.plugins.control.step_choice import SpeedChoice
from rotemina.plugins.control.wording import (
    compute_height_above_floor,
    describe_steering,
    describe_tip,
    describe_tip_briefly,
)
from rotemina.plugins.teleoperation import (
    describe_state,
    describe_trust,
    name_driving_devices,
)
from rotemina.sim.kinematics import SLOW_ZONE_HEIGHT_M

_SPEED_KEY = "control.speed"


class ControlOverview(QWidget):
    """Two lines at the top of the panel, which stay visible when the axes are scrolled."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench, self._operation = workbench, workbench.operation
        self.speed = SpeedChoice(workbench.robot)
        self.speed.choose_fraction(workbench.settings.get(_SPEED_KEY, 1.0))
        self.speed.activated.connect(
            lambda _: workbench.settings.set(_SPEED_KEY, self.speed.fraction)
        )
        self.stick = name_widget(QLabel("–"), tr("State of the joystick"))
        self.stick.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self.stick, StateTone.QUIET)
        self.device, self.tip = ElidedLabel(), ElidedLabel()
        self.device.setAccessibleName(tr("Device, mode and scaling"))
        self.tip.setAccessibleName(tr("Height of the tip"))
        stick_row = make_row(self.stick, (self.device, 1), spacing=8)
        grid = make_grid(on=self, margins=(10, 4, 10, 2), spacing=(-1, 3), stretched=0)
        grid.addLayout(stick_row, 0, 0, 1, 3)
        grid.addWidget(self.tip, 1, 0)
        grid.addWidget(QLabel(tr("Speed")), 1, 1)
        grid.addWidget(self.speed, 1, 2)

    def refresh(self, state: SessionState) -> None:
        """Show the state of the machine."""
        device_view = self._operation.devices.view
        teleoperation_state = self._operation.teleoperator.state
        is_stale = self._operation.clock() - device_view.host_time_s > STALE_AGE_S
        text, tone = describe_state(device_view, teleoperation_state, stale=is_stale)
        if text != self.stick.text():
            self.stick.setText(text)
        set_tone(self.stick, tone)
        show_tooltip(self.stick, describe_trust(device_view))
        self.device.show_text(
            describe_steering(teleoperation_state, name_driving_devices(device_view))
        )
        zone = self._workbench.session.bounds.keep_out
        self.tip.show_text(describe_tip_briefly(state, zone))
        show_tooltip(self.tip, describe_tip(state, zone))
        height_above_floor = compute_height_above_floor(state, zone)
        is_in_slow_zone = height_above_floor is not None and height_above_floor < SLOW_ZONE_HEIGHT_M
        set_property(self.tip, "bad", is_in_slow_zone)
