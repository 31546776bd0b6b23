"""Teleoperation panel: state, modes and scales, and a pad for use without a joystick."""

from PySide6.QtWidgets import QWidget

from rotemina.app.language import marked
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    STALE_AGE_S,
    Panel,
    PanelArea,
)
from rotemina.app.widgets.layout import make_column, make_scroll_area
from rotemina.app.workbench import Workbench
from rotemina.plugins.teleoperation.coordinates import CoordinateSection
from rotemina.plugins.teleoperation.mode_buttons import ModeSection
from rotemina.plugins.teleoperation.overview import OverviewSection
from rotemina.plugins.teleoperation.pad_section import PadSection
from rotemina.plugins.teleoperation.piezo_reserve import PiezoReserveSection
from rotemina.plugins.teleoperation.scale_editor import ScaleEditor


class TeleoperationPanel(Panel):
    """Panel with overview, pad, mode and scaling, coordinates, piezo range and scales."""

    title = marked("panels", "Teleoperation")
    area = PanelArea.RIGHT
    order = 22
    help_page = "teleoperation.md#in-the-window"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._operation = workbench.operation
        self.head = OverviewSection()
        self.pad = PadSection(workbench)
        self.choices = ModeSection(workbench)
        self.coordinates = CoordinateSection(workbench)
        self.reserve = PiezoReserveSection(workbench)
        self.editor = ScaleEditor(workbench)
        content = QWidget()
        # The overview stays visible while the sections below it are scrolled.
        sections = self.pad, self.choices, self.coordinates, self.reserve, self.editor
        make_column(*sections, 1, on=content, margins=(10, 4, 10, 8), spacing=4)
        scroll = make_scroll_area(content, min_width=300)
        head_column = make_column(self.head, margins=(10, 4, 10, 0))
        make_column(head_column, (scroll, 1), on=self, margins=0, spacing=0)
        self.follow(self._refresh)

    def _refresh(self, machine: SessionState) -> None:
        operation = self._operation
        view, state = operation.devices.view, operation.teleoperator.state
        stale = operation.clock() - view.host_time_s > STALE_AGE_S
        self.head.refresh(view, state, stale=stale)
        self.pad.refresh(view, state)
        self.choices.refresh(state, operation.intent)
        self.coordinates.refresh(state, operation.devices.arbiter, stale=stale)
        self.reserve.refresh(machine, state)
        self.editor.refresh(machine, state)
