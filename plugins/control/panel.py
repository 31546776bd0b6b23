"""The control menu of both stages: positions of the axes, and ways to move them."""

from collections.abc import Mapping, Sequence

import numpy as np
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QScrollArea, QStackedWidget, QTabBar, QVBoxLayout, QWidget

from rotemina.app.display_units import stages
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.language import marked
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.labels import heading
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.scroll_areas import scrolled
from rotemina.plugins.control import mark, tr
from rotemina.plugins.control.axes_page import AxesPage
from rotemina.plugins.control.axis_row import AxisRow
from rotemina.plugins.control.overview import Overview
from rotemina.plugins.control.penetration_page import PenetrationPage
from rotemina.plugins.control.positions_page import PositionsPage
from rotemina.plugins.control.step_choice import StepChoice
from rotemina.plugins.control.stick_page import HandPage
from rotemina.plugins.control.tip_page import TipPage
from rotemina.plugins.control.wording import aids
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.robot.model import Robot

# All six axes are in sight in a window of 1280×800.
_CLOSE = """
QPushButton, QLineEdit, QComboBox { min-height: 19px; padding: 1px 6px; }
QPushButton[jog="true"] { padding: 0; }
"""
# Five names side by side have room in a dock of 330 px, in German too.
_FIVE_TABS = "QTabBar::tab { padding-left: 5px; padding-right: 5px; }"
_ROOMY_FROM = 860  # px of height
_STAGES = {"micro": mark("Micro stage"), "nano": mark("Nano stage"), "axes": mark("Axes")}


_STEP = 1e-3  # of the range, over which the tip's height is differentiated
_FLAT = 1e-9  # m over that step, below which an axis does not lift the tip


def forbidden(
    robot: Robot, zone: KeepOutZone | None, command: Mapping[str, float]
) -> dict[str, tuple[tuple[float, float], ...]]:
    """Return stretches by axis, m or rad; the tip's height is taken as linear in each axis.

    It only shows what is there: what may be gone to is checked along the whole path by the guard.
    """
    axes = tuple(robot.axes)
    if zone is None or any(axis not in command for axis in axes):
        return {}
    here = np.array([command[axis] for axis in axes])
    height = float(zone.tip(here)[2])
    found = {}
    for column, axis in enumerate(axes):
        low, high = robot.axes[axis].range
        step = _STEP * (high - low)
        moved = here.copy()
        moved[column] += step
        rise = float(zone.tip(moved)[2]) - height
        if abs(rise) > _FLAT:
            way = step / rise
            ends = [here[column] + (bound - height) * way for bound in (zone.low, zone.high)]
            found[axis] = tuple(_outside(ends, low, high))
    return found


def _outside(free: Sequence[float], low: float, high: float) -> list[tuple[float, float]]:
    """Return what of a range lies outside of a free stretch."""
    first, last = min(free), max(free)
    parts = [(low, min(first, high)), (max(last, low), high)]
    return [(start, end) for start, end in parts if end > start]


class ControlPanel(Panel):
    """Head, every axis stage by stage, and below them one page of five."""

    title = marked("panels", "Control")
    area = Area.LEFT
    order = 10
    help_page = "control.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.rows: dict[str, AxisRow] = {}
        self._bounds: tuple[KeepOutZone | None, dict[str, float]] | None = None
        self._forbidden: dict[str, tuple[tuple[float, float], ...]] = {}
        self.steps: dict[str, StepChoice] = {}
        self.head = Overview(workbench)
        self.hand, self.tip = HandPage(workbench), TipPage(workbench)
        self.positions = PositionsPage(
            workbench, self.head.speed, lambda name: self.main_window.bring_up(name)
        )
        self.penetration, self.axes = PenetrationPage(workbench), AxesPage(workbench)
        self.tabs, self.pages = QTabBar(), QStackedWidget()
        self.pages.setMinimumWidth(1)  # the axes say how wide the panel is
        self.tabs.setExpanding(False)
        self.tabs.setUsesScrollButtons(False)
        self.tabs.setStyleSheet(_FIVE_TABS)
        for name, page in self._pages():
            self.tabs.addTab(name)
            self.pages.addWidget(page)
        self.tabs.currentChanged.connect(self._turn_to)
        parts = self.head, (self._scrolled_axes(), 1), self.tabs, self.pages
        in_column(*parts, on=self, margins=0, spacing=0)
        self.follow(self._refresh)
        self.follow_frames(self._show, shown=True)
        offer_in_palette(self.positions.change, self.axes.narrow, self.axes.whole)

    def _pages(self) -> tuple[tuple[str, QWidget], ...]:
        return (
            (tr("Hand"), self.hand),
            (tr("Positions"), self.positions),
            (tr("Tip"), self.tip),
            (tr("Penetration"), self.penetration),
            (tr("Axes"), self.axes),
        )

    def _scrolled_axes(self) -> QScrollArea:
        content = QWidget()
        column = in_column(on=content, margins=(10, 0, 8, 0), spacing=1)
        for stage, axes in stages(self.workbench.robot).items():
            self._add_stage(column, stage, axes)
        column.addStretch(1)
        content.setStyleSheet(_CLOSE)
        return scrolled(content, least=330)

    def _add_stage(self, column: QVBoxLayout, stage: str, axes: tuple[str, ...]) -> None:
        title = heading(
            tr(_STAGES[stage])
            if stage in _STAGES
            else tr("{name} stage").format(name=stage.capitalize())
        )
        steps = StepChoice(self.workbench.robot, axes)
        self.steps[stage] = steps
        column.addLayout(in_row((title, 1), steps))
        for name in axes:
            row = AxisRow(name, self.workbench, steps, self.head.speed)
            self.rows[name] = row
            column.addWidget(row)

    def _show(self, state: SessionState) -> None:
        """Show what is shown: the machine, or a replay."""
        session = self.workbench.session
        bounds = session.bounds.keep_out, dict(state.command)
        if bounds != self._bounds and self.workbench.turns.due(0):
            self._bounds = bounds
            self._forbidden = forbidden(self.workbench.robot, *bounds)
        inverses, approaches = session.inverses.applied, session.backlash.applied
        for number, (axis, row) in enumerate(self.rows.items()):
            if not self.workbench.turns.due(number):
                continue
            row.refresh(state)
            row.show_range(session.ranges.of(axis), self._forbidden.get(axis, ()))
            taken_up = axis in approaches and session.backlash.taken_up(axis)
            row.show_aids(*aids(inverses.get(axis), approaches.get(axis), taken_up=taken_up))

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Give the axes four lines with large digits where all six of them have room."""
        super().resizeEvent(event)
        for row in self.rows.values():
            row.give_room(roomy=self.height() >= _ROOMY_FROM)

    def _turn_to(self, page: int) -> None:
        self.pages.setCurrentIndex(page)
        self._refresh(self.workbench.session.snapshot())

    def _refresh(self, state: SessionState) -> None:
        """Show the machine, on which everything here acts."""
        self.head.refresh(state)
        page = self.pages.currentWidget()
        for _, one in self._pages():
            if one is page:
                one.refresh(state)
