"""The pad with its deflection, its keys, and the take-over."""

from rotemina.app.display_units import label
from rotemina.app.motion.teleoperation.input_arbiter import DevicesView
from rotemina.app.motion.teleoperation.teleoperation_state import TeleoperationState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.teleoperation import mark, tr, wording
from rotemina.plugins.teleoperation.pad_area import PadArea
from rotemina.plugins.teleoperation.virtual_stick import SHARES, VirtualStick

_KEYS = mark("arrows  x y\npage ↑ ↓  z\nshift  × 10\nctrl  × 0.1\nspace  clutch")


class PadSection(Section):
    """Pointer, keys, and the button by which the pad asks to drive."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Pad"))
        self._stick = VirtualStick(workbench.operation.pad)
        self.area = PadArea(workbench, self._stick)
        self.most = SteadyChoice(
            tr("Deflection of the pad in percent"),
            tr("Deflection at the ends of the pad and for its keys"),
        )
        for share in SHARES:
            self.most.addItem(tr("stick {percent:g} %").format(percent=100 * share), share)
        self.most.setCurrentIndex(len(SHARES) - 1)
        self.most.currentIndexChanged.connect(self._use_most)
        self.take_over = button(tr("Take over"), lambda: None)
        self.take_over.pressed.connect(lambda: self._stick.take_over(True))
        self.take_over.released.connect(lambda: self._stick.take_over(False))
        kept = self.take_over.sizePolicy()
        kept.setRetainSizeWhenHidden(True)  # nothing leaps when a joystick is plugged in
        self.take_over.setSizePolicy(kept)
        self.take_over.hide()
        keys = plain_text(tr(_KEYS))
        side = in_column(self.most, keys, 1, self.take_over, spacing=4)
        self.column.addLayout(in_row(self.area, (side, 1), spacing=10))
        workbench.closing.connect(self.area.release)

    def refresh(self, view: DevicesView, state: TeleoperationState) -> None:
        """Show what the pad moves, or why it does not."""
        names = {one.source: label(one.name) for one in state.coordinates}
        self.area.show_state(wording.against_pad(view), names)
        pad = wording.pad_of(view)
        self.take_over.setVisible(wording.is_trainee(pad))
        drives = pad is not None and pad.drives
        allow(
            self.take_over,
            tr("the pad is in control; moving the other device returns control to it")
            if drives
            else None,
            tr("Control with the pad until the other device is moved"),
        )

    def _use_most(self, _: int) -> None:
        self.area.release()
        self._stick.most = self.most.currentData()
