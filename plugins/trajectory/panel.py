"""Trajectories: load one, see what it asks of each axis, play it."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QProgressBar,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
)

from rotemina.app.display import axis_scale, label
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.workbench import Plan, Workbench
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.trajectory.resampling import ResamplingDialog
from rotemina.plugins.trajectory.table import COLUMNS, cells

EMPTY = "No trajectory is loaded. Load one to see what it asks of each axis before it is played."


class TrajectoryPanel(Panel):
    """Load → dry run (limits, speed, duration) → play."""

    title = "Trajectory"
    area = Area.BOTTOM
    order = 10

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.load = QPushButton("Load …")
        self.load.clicked.connect(lambda: self.main_window.ask_trajectory())
        self.resample = QPushButton("Resample …")
        self.resample.setEnabled(False)
        self.resample.clicked.connect(self._resample)
        self.play = QPushButton("Play")
        self.play.setProperty("primary", True)
        self.play.clicked.connect(workbench.play)
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setFormat("")
        self.name = QLabel("")
        self.name.setProperty("heading", True)
        self.verdict = QLabel(EMPTY)
        self.verdict.setWordWrap(True)
        self.name.setTextFormat(Qt.TextFormat.PlainText)
        self.verdict.setTextFormat(Qt.TextFormat.PlainText)
        self.table = _table()
        self._lay_out()
        workbench.plan_changed.connect(self._show_plan)
        workbench.refreshed.connect(self._refresh)
        self.play.setEnabled(False)

    def _lay_out(self) -> None:
        buttons = QHBoxLayout()
        buttons.addWidget(self.load)
        buttons.addWidget(self.resample)
        buttons.addWidget(self.play)
        buttons.addWidget(self.progress, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(10, 8, 10, 8)
        column.addLayout(buttons)
        column.addWidget(self.name)
        column.addWidget(self.verdict)
        column.addWidget(self.table, 1)
        self.name.hide()

    def _show_plan(self, plan: Plan) -> None:
        run = plan.dry_run
        self.name.setText(f"{plan.name} – {run.duration_s:.3f} s, {run.rows} rows")
        self.name.show()
        self.resample.setEnabled(True)
        if run.allowed:
            self.verdict.setText(
                "Dry run: inside all limits of range, speed and acceleration. "
                "Play first moves the axes to the first row, within the same limits."
            )
        else:
            more = f" (and {len(run.objections) - 1} more)" if len(run.objections) > 1 else ""
            self.verdict.setText(f"Not playable: {run.objections[0]}{more}")
        self.verdict.setProperty("bad", not run.allowed)
        self.verdict.style().polish(self.verdict)
        self._fill(plan)

    def _resample(self) -> None:
        plan = self.workbench.plan
        if plan is None:
            return
        dialog = ResamplingDialog(plan.trajectory, self)

        def use() -> None:
            if dialog.resampled is not None:
                self.workbench.plan_trajectory(f"{plan.name}, resampled", dialog.resampled)

        dialog.accepted.connect(use)
        dialog.show()

    def _fill(self, plan: Plan) -> None:
        figures = plan.dry_run.axes
        self.table.setRowCount(len(figures))
        for row, (name, axis) in enumerate(figures.items()):
            scale = axis_scale(self.workbench.robot.axes[name])
            self.table.setVerticalHeaderItem(row, QTableWidgetItem(label(name)))
            for column, cell in enumerate(cells(axis, scale)):
                item = QTableWidgetItem(cell.text)
                item.setToolTip(cell.tip)
                self.table.setItem(row, column, item)

    def _refresh(self, state: SessionState) -> None:
        plan = self.workbench.plan
        playing = state.activity is DeviceState.PLAYING
        ready = plan is not None and plan.dry_run.allowed
        self.play.setEnabled(ready and state.locked is None and not playing)
        self.progress.setValue(round(1000 * state.progress) if playing else 0)
        if playing and plan is not None:
            left = (1.0 - state.progress) * plan.dry_run.duration_s
            self.progress.setFormat(f"{left:.1f} s left")
        else:
            self.progress.setFormat("")


def _table() -> QTableWidget:
    table = QTableWidget(0, len(COLUMNS))
    table.setHorizontalHeaderLabels(list(COLUMNS))
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
    table.verticalHeader().setDefaultSectionSize(24)
    return table
