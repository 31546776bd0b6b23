"""Remaining piezo range, rotation of the tool, and re-centring."""

from PySide6.QtWidgets import QLabel, QProgressBar

from rotemina.app.display_units import label
from rotemina.app.motion.operation import has_tip
from rotemina.app.motion.state import SessionState
from rotemina.app.motion.teleoperation.teleoperation_state import TeleoperationState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button, fill
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_grid, in_row
from rotemina.app.widgets.section import Section
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.teleoperation import tr, wording
from rotemina.sim.kinematics.chain import JOINTS, NANO


class ReserveSection(Section):
    """Piezo range, tilt, re-centring; there is none of it for a robot without a tip."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Piezo range"))
        operation = workbench.operation
        nano = JOINTS[NANO]
        self.bar = QProgressBar()
        self.bar.setRange(0, 100)
        self.bar.setTextVisible(False)
        self.bar.setAccessibleName(tr("Remaining piezo range in percent"))
        self.bar.setToolTip(tr("100 %: the piezo is in the middle of its range; 0 %: at an end"))
        self.left = plain_text(quiet=False)
        self.tilt = plain_text(quiet=False)
        self.tilt.setAccessibleName(tr("Tilt of the tool since the mode began"))
        self.tilt.setToolTip(tr("Rotation of the tool since the mode began"))
        grid = in_grid(spacing=(12, -1), stretched=1)
        for row, (title, widget) in enumerate(
            ((tr("Remaining"), self.left), (tr("Tilt"), self.tilt))
        ):
            name = QLabel(title)
            name.setProperty("quiet", True)
            grid.addWidget(name, row, 0)
            grid.addWidget(widget, row, 1)
        self.column.addWidget(self.bar)
        self.column.addLayout(grid)
        self.one = button(
            tr("Re-centre {axis}").format(axis=label(nano[-1])),
            lambda: workbench.ask(operation.recentre),
        )
        self.all = button(
            tr("Re-centre all"), lambda: workbench.ask(lambda: operation.recentre(nano))
        )
        self.column.addLayout(in_row((self.one, 1), (self.all, 1), spacing=6))
        if not has_tip(workbench.session):
            self.hide()

    def refresh(self, machine: SessionState, state: TeleoperationState) -> None:
        """Show a moment, and lock what cannot be done now."""
        left = state.reserve
        fill(self.bar, 0 if left is None else round(100 * left))
        self.bar.setEnabled(left is not None)
        self.left.setText(wording.reserve_text(state))
        self.tilt.setText(wording.tilt_shown(state))
        why = against_recentring(machine)
        stays = tr("to mid-range while the tables hold the tip in place")
        allow(self.one, why, tr("Bring zn {stays}").format(stays=stays))
        allow(
            self.all,
            why,
            tr("Bring both tilts and zn {stays}; this takes longer").format(stays=stays),
        )


def against_recentring(machine: SessionState) -> str | None:
    """Why not re-centre now."""
    if machine.locked is not None:
        return machine.locked
    if machine.activity is not DeviceState.IDLE or machine.queued:
        return tr("the machine is still moving; release the stick first")
    return None
