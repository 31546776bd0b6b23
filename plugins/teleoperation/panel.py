"""Manual steering: control, mode, and a pad for use without a joystick."""

from PySide6.QtWidgets import QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S, Area, Panel
from rotemina.app.shell.language import marked
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.layouts import in_column
from rotemina.app.widgets.scroll_areas import scrolled
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
        # What is read at a glance stays in sight while the rest is scrolled.
        sections = self.pad, self.choices, self.coordinates, self.reserve, self.editor
        in_column(*sections, 1, on=content, margins=(10, 4, 10, 8), spacing=4)
        scroll = scrolled(content, least=300)
        head = in_column(self.head, margins=(10, 4, 10, 0))
        in_column(head, (scroll, 1), on=self, margins=0, spacing=0)
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
