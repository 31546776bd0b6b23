"""Section with the pad, its deflection, its keys and the take-over button."""

from rotemina.app.language import get_axis_label
from rotemina.app.motion.inputs import InputDisplayState
from rotemina.app.motion.teleoperation import TeleoperationState
from rotemina.app.widgets.controls import WheelSafeComboBox, enable_unless, make_button
from rotemina.app.widgets.layout import Section, make_column, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.plugins.teleoperation import mark, tr, wording
from rotemina.plugins.teleoperation.pad_area import PadArea
from rotemina.plugins.teleoperation.virtual_stick import MAX_DEFLECTION_CHOICES, VirtualStick

_KEY_HELP = mark("arrows  x y\npage ↑ ↓  z\nshift  × 10\nctrl  × 0.1\nspace  clutch")


class PadSection(Section):
    """Section with the pad, and a button with which the pad takes control."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Pad"))
        self._stick = VirtualStick(workbench.operation.pad)
        self.area = PadArea(workbench, self._stick)
        self.deflection_choice = WheelSafeComboBox(
            tr("Deflection of the pad in percent"),
            tr("Deflection at the ends of the pad and for its keys"),
        )
        for deflection in MAX_DEFLECTION_CHOICES:
            self.deflection_choice.addItem(
                tr("stick {percent:g} %").format(percent=100 * deflection), deflection
            )
        self.deflection_choice.setCurrentIndex(len(MAX_DEFLECTION_CHOICES) - 1)
        self.deflection_choice.currentIndexChanged.connect(self._use_deflection)
        self.take_over = make_button(tr("Take over"), lambda: None)
        self.take_over.pressed.connect(lambda: self._stick.take_over(True))
        self.take_over.released.connect(lambda: self._stick.take_over(False))
        size_policy = self.take_over.sizePolicy()
        # Its space is reserved, so that nothing moves when a joystick makes the button appear.
        size_policy.setRetainSizeWhenHidden(True)
        self.take_over.setSizePolicy(size_policy)
        self.take_over.hide()
        keys = make_plain_label(tr(_KEY_HELP))
        side = make_column(self.deflection_choice, keys, 1, self.take_over, spacing=4)
        self.column.addLayout(make_row(self.area, (side, 1), spacing=10))
        workbench.closing.connect(self.area.release)

    def refresh(self, view: InputDisplayState, state: TeleoperationState) -> None:
        """Show what the pad moves, or why it does not act."""
        names = {
            coordinate.source: get_axis_label(coordinate.name) for coordinate in state.coordinates
        }
        self.area.show_state(wording.find_pad_objection(view), names)
        pad = wording.find_pad(view)
        self.take_over.setVisible(wording.is_trainee(pad))
        is_driving = pad is not None and pad.is_driving
        enable_unless(
            self.take_over,
            tr("the pad is in control; moving the other device returns control to it")
            if is_driving
            else None,
            tr("Control with the pad until the other device is moved"),
        )

    def _use_deflection(self, _: int) -> None:
        self.area.release()
        self._stick.max_deflection = self.deflection_choice.currentData()
