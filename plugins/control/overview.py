"""Overview above the axes: steering, the tip, and the speed of moves."""

from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S
from rotemina.app.shell.state_tone import Tone, set_tone
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import named, set_property, show_tip
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.app.widgets.layouts import in_grid, in_row
from rotemina.plugins.control import tr
from rotemina.plugins.control.step_choice import SpeedChoice
from rotemina.plugins.control.wording import above_floor, steering_text, tip_short, tip_text
from rotemina.plugins.teleoperation.wording import driver_text, standing, trust_text
from rotemina.sim.kinematics.keep_out import SLOW_HEIGHT

_SPEED_KEY = "control.speed"


class Overview(QWidget):
    """Two lines; they stay in sight while the axes are scrolled."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench, self._operation = workbench, workbench.operation
        self.speed = SpeedChoice(workbench.robot)
        self.speed.choose(workbench.settings.get(_SPEED_KEY, 1.0))
        self.speed.activated.connect(lambda _: workbench.settings.set(_SPEED_KEY, self.speed.share))
        self.stick = named(QLabel("–"), tr("State of the joystick"))
        self.stick.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self.stick, Tone.QUIET)
        self.device, self.tip = ElidedLabel(), ElidedLabel()
        self.device.setAccessibleName(tr("Device, mode and scaling"))
        self.tip.setAccessibleName(tr("Height of the tip"))
        first = in_row(self.stick, (self.device, 1), spacing=8)
        grid = in_grid(on=self, margins=(10, 4, 10, 2), spacing=(-1, 3), stretched=0)
        grid.addLayout(first, 0, 0, 1, 3)
        grid.addWidget(self.tip, 1, 0)
        grid.addWidget(QLabel(tr("Speed")), 1, 1)
        grid.addWidget(self.speed, 1, 2)

    def refresh(self, state: SessionState) -> None:
        """Show a moment of the machine."""
        view, steered = self._operation.devices.view, self._operation.teleoperator.state
        stale = self._operation.clock() - view.host_time_s > STALE_S
        word, tone = standing(view, steered, stale=stale)
        if word != self.stick.text():
            self.stick.setText(word)
        set_tone(self.stick, tone)
        show_tip(self.stick, trust_text(view))
        self.device.show_text(steering_text(steered, driver_text(view)))
        zone = self._workbench.session.bounds.keep_out
        self.tip.show_text(tip_short(state, zone))
        show_tip(self.tip, tip_text(state, zone))
        above = above_floor(state, zone)
        set_property(self.tip, "bad", above is not None and above < SLOW_HEIGHT)
