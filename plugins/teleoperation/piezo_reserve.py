"""Remaining piezo range, tilt of the tool, and re-centring."""

from PySide6.QtWidgets import QLabel, QProgressBar

from rotemina.app.language import get_axis_label
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation import TeleoperationState
from rotemina.app.operation import has_tip
from rotemina.app.widgets.controls import (
    enable_unless,
    make_button,
    set_bar_value,
)
from rotemina.app.widgets.layout import Section, make_grid, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.teleoperation import tr, wording
from rotemina.sim.kinematics import JOINTS, NANO


class PiezoReserveSection(Section):
    """Section with piezo range, tilt and re-centring. It is hidden for a robot without a tip."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Piezo range"))
        operation = workbench.operation
        nano = JOINTS[NANO]
        self.bar = QProgressBar()
        self.bar.setRange(0, 100)
        self.bar.setTextVisible(False)
        self.bar.setAccessibleName(tr("Remaining piezo range in percent"))
        self.bar.setToolTip(tr("100 %: the piezo is in the middle of its range; 0 %: at an end"))
        self.remaining_label = make_plain_label(quiet=False)
        self.tilt_label = make_plain_label(quiet=False)
        self.tilt_label.setAccessibleName(tr("Tilt of the tool since the mode began"))
        self.tilt_label.setToolTip(tr("Rotation of the tool since the mode began"))
        grid = make_grid(spacing=(12, -1), stretched=1)
        for row, (title, widget) in enumerate(
            ((tr("Remaining"), self.remaining_label), (tr("Tilt"), self.tilt_label))
        ):
            title_label = QLabel(title)
            title_label.setProperty("quiet", True)
            grid.addWidget(title_label, row, 0)
            grid.addWidget(widget, row, 1)
        self.column.addWidget(self.bar)
        self.column.addLayout(grid)
        self.recentre_z_button = make_button(
            tr("Re-centre {axis}").format(axis=get_axis_label(nano[-1])),
            lambda: workbench.run_request(operation.recentre),
        )
        self.all = make_button(
            tr("Re-centre all"), lambda: workbench.run_request(lambda: operation.recentre(nano))
        )
        self.column.addLayout(make_row((self.recentre_z_button, 1), (self.all, 1), spacing=6))
        if not has_tip(workbench.session):
            self.hide()

    def refresh(self, machine: SessionState, state: TeleoperationState) -> None:
        """Show the current state, and enable the actions that are possible now."""
        reserve = state.reserve
        set_bar_value(self.bar, 0 if reserve is None else round(100 * reserve))
        self.bar.setEnabled(reserve is not None)
        self.remaining_label.setText(wording.format_reserve(state))
        self.tilt_label.setText(wording.describe_tilt(state))
        objection = find_recentring_objection(machine)
        stays_text = tr("to mid-range while the tables hold the tip in place")
        enable_unless(
            self.recentre_z_button, objection, tr("Bring zn {stays}").format(stays=stays_text)
        )
        enable_unless(
            self.all,
            objection,
            tr("Bring both tilts and zn {stays}; this takes longer").format(stays=stays_text),
        )


def find_recentring_objection(machine: SessionState) -> str | None:
    """Return why re-centring is impossible now, or None if it is possible."""
    if machine.lock_reason is not None:
        return machine.lock_reason
    if machine.activity is not DeviceState.IDLE or machine.queued:
        return tr("the machine is still moving; release the stick first")
    return None
