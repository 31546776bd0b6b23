"""The control menu of both stages: where each axis is, and the ways to move it."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QStackedWidget,
    QTabBar,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.display import stages
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.control.axis_row import AxisRow
from rotemina.plugins.control.hand_page import HandPage
from rotemina.plugins.control.head import Head
from rotemina.plugins.control.penetration_page import PenetrationPage
from rotemina.plugins.control.positions_page import PositionsPage
from rotemina.plugins.control.step_choice import StepChoice
from rotemina.plugins.control.tip_page import TipPage

# All six axes are in sight in a window of 1280×800.
_CLOSE = """
QPushButton, QLineEdit, QComboBox { min-height: 19px; padding: 1px 6px; }
QPushButton[jog="true"] { padding: 0; }
"""
_STAGES = {
    "micro": marked("control", "Micro stage"),
    "nano": marked("control", "Nano stage"),
    "axes": marked("control", "Axes"),
}


class ControlPanel(Panel):
    """Head, every axis stage by stage, and below them one page of four."""

    title = marked("panels", "Control")
    area = Area.LEFT
    order = 10
    help_page = "control.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.rows: dict[str, AxisRow] = {}
        self.steps: dict[str, StepChoice] = {}
        self.head = Head(workbench)
        self.hand, self.tip = HandPage(workbench), TipPage(workbench)
        self.positions = PositionsPage(workbench, self.head.speed)
        self.penetration = PenetrationPage(workbench)
        self.tabs, self.pages = QTabBar(), QStackedWidget()
        self.tabs.setExpanding(False)
        self.tabs.setUsesScrollButtons(False)
        for name, page in self._pages():
            self.tabs.addTab(name)
            self.pages.addWidget(page)
        self.tabs.currentChanged.connect(self._turn_to)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.setSpacing(0)
        outer.addWidget(self.head)
        outer.addWidget(self._scrolled_axes(), 1)
        outer.addWidget(self.tabs)
        outer.addWidget(self.pages)
        workbench.shown.connect(self._show)
        self.follow(self._refresh)

    def _pages(self) -> tuple[tuple[str, QWidget], ...]:
        return (
            (translate("control", "Hand"), self.hand),
            (translate("control", "Positions"), self.positions),
            (translate("control", "Tip"), self.tip),
            (translate("control", "Penetration"), self.penetration),
        )

    def _scrolled_axes(self) -> QScrollArea:
        content = QWidget()
        column = QVBoxLayout(content)
        column.setContentsMargins(10, 0, 8, 0)
        column.setSpacing(1)
        for stage, axes in stages(self.workbench.robot).items():
            self._add_stage(column, stage, axes)
        column.addStretch(1)
        content.setStyleSheet(_CLOSE)
        scroll = QScrollArea()
        scroll.setObjectName("panelScroll")
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setWidgetResizable(True)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setWidget(content)
        bar = scroll.verticalScrollBar().sizeHint().width()
        self.setMinimumWidth(max(content.minimumSizeHint().width() + bar, 330))
        return scroll

    def _add_stage(self, column: QVBoxLayout, stage: str, axes: tuple[str, ...]) -> None:
        heading = QLabel(
            translate("control", _STAGES[stage])
            if stage in _STAGES
            else translate("control", "{name} stage").format(name=stage.capitalize())
        )
        heading.setProperty("heading", True)
        heading.setTextFormat(Qt.TextFormat.PlainText)
        steps = StepChoice(self.workbench.robot, axes)
        self.steps[stage] = steps
        line = QHBoxLayout()
        line.addWidget(heading, 1)
        line.addWidget(steps)
        column.addLayout(line)
        for name in axes:
            row = AxisRow(name, self.workbench, steps, self.head.speed)
            self.rows[name] = row
            column.addWidget(row)

    def _show(self, state: SessionState) -> None:
        """Show what is shown: the machine, or a replay."""
        for row in self.rows.values():
            row.refresh(state)

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
