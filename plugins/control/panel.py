"""The Control panel: positions of all axes, and controls to move them."""

from collections.abc import Mapping, Sequence

import numpy as np
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QScrollArea, QStackedWidget, QTabBar, QVBoxLayout, QWidget

from rotemina.app.language import group_axes_by_stage, marked
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.widgets.layout import make_column, make_row, make_scroll_area
from rotemina.app.widgets.text import make_heading
from rotemina.app.workbench import Workbench
from rotemina.plugins.control import mark, tr
from rotemina.plugins.control.axes_page import AxesPage
from rotemina.plugins.control.axis_row import AxisControlRow
from rotemina.plugins.control.overview import ControlOverview
from rotemina.plugins.control.penetration_page import PenetrationPage
from rotemina.plugins.control.positions_page import PositionsPage
from rotemina.plugins.control.step_choice import StepChoice
from rotemina.plugins.control.stick_page import StickPage
from rotemina.plugins.control.tip_page import TipPage
from rotemina.plugins.control.wording import describe_compensation
from rotemina.sim.kinematics import KeepOutZone
from rotemina.sim.robot import Robot

# The controls are low, so that all six axes are visible in a window of 1280×800 pixels.
_COMPACT_STYLE = """
QPushButton, QLineEdit, QComboBox { min-height: 19px; padding: 1px 6px; }
QPushButton[jog="true"] { padding: 0; }
"""
# The tabs are narrow, so that five names fit in a dock of 330 px, also in German.
_TAB_STYLE = "QTabBar::tab { padding-left: 5px; padding-right: 5px; }"
# If the panel is at least this high, all six axes have room for four lines.
_MIN_ROOMY_HEIGHT_PX = 860
_STAGE_TITLES = {"micro": mark("Micro stage"), "nano": mark("Nano stage"), "axes": mark("Axes")}

# Step of the finite difference of the tip height, as a fraction of the range of the axis.
_DIFFERENCE_STEP_FRACTION = 1e-3
# If the step changes the tip height by less than this, the axis does not affect the height.
_MIN_RISE_M = 1e-9


def find_forbidden_stretches(
    robot: Robot, zone: KeepOutZone | None, command: Mapping[str, float]
) -> dict[str, tuple[tuple[float, float], ...]]:
    """Return the intervals of each axis in which the tip would be in the keep-out zone.

    The result maps an axis to (low, high) pairs, m or rad. Each axis is considered alone, with the
    other axes at their commands, and with the tip height linearised. The intervals are for display
    only: the guard checks every motion along its whole path.
    """
    axes = tuple(robot.axes)
    if zone is None or any(axis not in command for axis in axes):
        return {}
    commands = np.array([command[axis] for axis in axes])
    height = float(zone.tip_at(commands)[2])
    stretches = {}
    for column, axis in enumerate(axes):
        low, high = robot.axes[axis].range
        step = _DIFFERENCE_STEP_FRACTION * (high - low)
        shifted_commands = commands.copy()
        shifted_commands[column] += step
        rise = float(zone.tip_at(shifted_commands)[2]) - height
        if abs(rise) > _MIN_RISE_M:
            travel_per_rise = step / rise
            ends = [
                commands[column] + (limit - height) * travel_per_rise
                for limit in (zone.low, zone.high)
            ]
            stretches[axis] = tuple(_find_stretches_outside(ends, low, high))
    return stretches


def _find_stretches_outside(
    ends: Sequence[float], low: float, high: float
) -> list[tuple[float, float]]:
    """Return the parts of the range from low to high that are not between the two ends."""
    lower_end, upper_end = min(ends), max(ends)
    parts = [(low, min(lower_end, high)), (max(upper_end, low), high)]
    return [(start, end) for start, end in parts if end > start]


class ControlPanel(Panel):
    """Panel with an overview, a row for each axis grouped by stage, and five pages below them."""

    title = marked("panels", "Control")
    area = PanelArea.LEFT
    order = 10
    help_page = "control.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.rows: dict[str, AxisControlRow] = {}
        # The keep-out zone and the commands for which `_forbidden` was computed.
        self._forbidden_inputs: tuple[KeepOutZone | None, dict[str, float]] | None = None
        self._forbidden: dict[str, tuple[tuple[float, float], ...]] = {}
        self.steps: dict[str, StepChoice] = {}
        self.overview = ControlOverview(workbench)
        self.hand, self.tip = StickPage(workbench), TipPage(workbench)
        self.positions = PositionsPage(
            workbench, self.overview.speed, lambda name: self.main_window.bring_up(name)
        )
        self.penetration, self.axes = PenetrationPage(workbench), AxesPage(workbench)
        self.tabs, self.pages = QTabBar(), QStackedWidget()
        # The axes determine the width of the panel, and not the pages.
        self.pages.setMinimumWidth(1)
        self.tabs.setExpanding(False)
        self.tabs.setUsesScrollButtons(False)
        self.tabs.setStyleSheet(_TAB_STYLE)
        for name, page in self._list_pages():
            self.tabs.addTab(name)
            self.pages.addWidget(page)
        self.tabs.currentChanged.connect(self._show_page)
        parts = self.overview, (self._make_axis_area(), 1), self.tabs, self.pages
        make_column(*parts, on=self, margins=0, spacing=0)
        self.follow(self._refresh)
        self.follow_frames(self._show_axes, shown=True)
        offer_in_palette(self.positions.change, self.axes.narrow, self.axes.restore)

    def _list_pages(self) -> tuple[tuple[str, QWidget], ...]:
        return (
            (tr("Hand"), self.hand),
            (tr("Positions"), self.positions),
            (tr("Tip"), self.tip),
            (tr("Penetration"), self.penetration),
            (tr("Axes"), self.axes),
        )

    def _make_axis_area(self) -> QScrollArea:
        content = QWidget()
        column = make_column(on=content, margins=(10, 0, 8, 0), spacing=1)
        for stage, axes in group_axes_by_stage(self.workbench.robot).items():
            self._add_stage(column, stage, axes)
        column.addStretch(1)
        content.setStyleSheet(_COMPACT_STYLE)
        return make_scroll_area(content, min_width=330)

    def _add_stage(self, column: QVBoxLayout, stage: str, axes: tuple[str, ...]) -> None:
        title = make_heading(
            tr(_STAGE_TITLES[stage])
            if stage in _STAGE_TITLES
            else tr("{name} stage").format(name=stage.capitalize())
        )
        steps = StepChoice(self.workbench.robot, axes)
        self.steps[stage] = steps
        column.addLayout(make_row((title, 1), steps))
        for name in axes:
            row = AxisControlRow(name, self.workbench, steps, self.overview.speed)
            self.rows[name] = row
            column.addWidget(row)

    def _show_axes(self, state: SessionState) -> None:
        session = self.workbench.session
        zone_and_command = session.bounds.keep_out, dict(state.command)
        if zone_and_command != self._forbidden_inputs and self.workbench.turns.is_due(0):
            self._forbidden_inputs = zone_and_command
            self._forbidden = find_forbidden_stretches(self.workbench.robot, *zone_and_command)
        inverses, approaches = session.inverses.applied, session.backlash.applied
        for index, (axis, row) in enumerate(self.rows.items()):
            if not self.workbench.turns.is_due(index):
                continue
            row.refresh(state)
            row.show_range(session.ranges.find_range(axis), self._forbidden.get(axis, ()))
            taken_up = axis in approaches and session.backlash.is_taken_up(axis)
            row.show_compensation(
                *describe_compensation(inverses.get(axis), approaches.get(axis), taken_up=taken_up)
            )

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Give each axis four lines with large digits if there is room for all six axes."""
        super().resizeEvent(event)
        for row in self.rows.values():
            row.set_roomy(roomy=self.height() >= _MIN_ROOMY_HEIGHT_PX)

    def _show_page(self, page: int) -> None:
        self.pages.setCurrentIndex(page)
        self._refresh(self.workbench.session.snapshot())

    def _refresh(self, state: SessionState) -> None:
        """Show the state of the machine, even during a replay, because the controls act on it."""
        self.overview.refresh(state)
        current_page = self.pages.currentWidget()
        for _, page in self._list_pages():
            if page is current_page:
                page.refresh(state)
