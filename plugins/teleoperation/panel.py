"""Manual steering: control, mode, and a pad for use without a joystick."""

from PySide6.QtWidgets import QVBoxLayout, QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S, Area, Panel
from rotemina.app.shell.language import marked
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.scroll_areas import least_width, scrolled
from rotemina.plugins.teleoperation.coordinates import CoordinateSection
from rotemina.plugins.teleoperation.mode_buttons import ChoiceSection
from rotemina.plugins.teleoperation.overview import OverviewSection
from rotemina.plugins.teleoperation.pad_section import PadSection
from rotemina.plugins.teleoperation.piezo_reserve import ReserveSection
from rotemina.plugins.teleoperation.scale_editor import ScaleEditor


class TeleoperationPanel(Panel):
    """Head, pad, mode and scaling, coordinates, piezo range, scales, one below the other."""

    title = marked("panels", "Teleoperation")
    area = Area.RIGHT
    order = 22
    help_page = "teleoperation.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._operation = workbench.operation
        self.head = OverviewSection()
        self.pad = PadSection(workbench)
        self.choices = ChoiceSection(workbench)
        self.coordinates = CoordinateSection(workbench)
        self.reserve = ReserveSection(workbench)
        self.editor = ScaleEditor(workbench)
        content = QWidget()
        column = QVBoxLayout(content)
        column.setContentsMargins(10, 4, 10, 8)
        column.setSpacing(4)
        # What is read at a glance stays in sight while the rest is scrolled.
        for section in (
            self.pad,
            self.choices,
            self.coordinates,
            self.reserve,
            self.editor,
        ):
            column.addWidget(section)
        column.addStretch(1)
        scroll = scrolled(content)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.setSpacing(0)
        head = QVBoxLayout()
        head.setContentsMargins(10, 4, 10, 0)
        head.addWidget(self.head)
        outer.addLayout(head)
        outer.addWidget(scroll, 1)
        self.setMinimumWidth(max(least_width(scroll), 300))
        self.follow(self._refresh)

    def _refresh(self, machine: SessionState) -> None:
        operation = self._operation
        view, state = operation.devices.view, operation.teleoperator.state
        stale = operation.clock() - view.host_time_s > STALE_S
        self.head.refresh(view, state, stale=stale)
        self.pad.refresh(view, state)
        self.choices.refresh(state, operation.intent)
        self.coordinates.refresh(state, operation.devices.arbiter, stale=stale)
        self.reserve.refresh(machine, state)
        self.editor.refresh(machine, state)
