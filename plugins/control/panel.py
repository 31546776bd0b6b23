"""The control menu of both stages: where each axis is, and the ways to move it."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QVBoxLayout, QWidget

from rotemina.app.display import stages
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.control.axis_row import AxisRow
from rotemina.plugins.control.step_choice import StepChoice


class ControlPanel(Panel):
    """Readouts, jog, steps and go-to for every axis, stage by stage."""

    title = "Control"
    area = Area.LEFT
    order = 10

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.rows: dict[str, AxisRow] = {}
        content = QWidget()
        column = QVBoxLayout(content)
        column.setContentsMargins(10, 8, 10, 8)
        column.setSpacing(4)
        for stage, axes in stages(workbench.robot).items():
            self._add_stage(column, stage, axes)
        column.addStretch(1)
        self._add_scroll_area(content)
        workbench.shown.connect(self._refresh)

    def _add_scroll_area(self, content: QWidget) -> None:
        scroll = QScrollArea()
        scroll.setObjectName("panelScroll")
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setWidgetResizable(True)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setWidget(content)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(scroll)
        self.setMinimumWidth(330)

    def _add_stage(self, column: QVBoxLayout, stage: str, axes: tuple[str, ...]) -> None:
        heading = QLabel(f"{stage.capitalize()} stage" if stage != "axes" else "Axes")
        heading.setProperty("heading", True)
        heading.setTextFormat(Qt.TextFormat.PlainText)
        column.addWidget(heading)
        steps = StepChoice(self.workbench.robot, axes)
        column.addWidget(steps)
        for name in axes:
            row = AxisRow(name, self.workbench, steps)
            self.rows[name] = row
            column.addWidget(row)
        column.addSpacing(6)

    def _refresh(self, state: SessionState) -> None:
        for row in self.rows.values():
            row.refresh(state)
