"""Trajectories: load one, see what it asks of each axis, play it."""

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
)

from rotemina.app.display import axis_scale, label
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.workbench import Level, Plan, Workbench
from rotemina.plugins.trajectory.resampling import ResamplingDialog
from rotemina.plugins.trajectory.table import (
    BOUND,
    COLUMNS,
    bound_text,
    cells,
    gap_text,
    preset_bound,
    read_bound,
)
from rotemina.plugins.trajectory.transport import Transport
from rotemina.sim.errors import InputError

EMPTY = marked(
    "trajectory",
    "No trajectory is loaded. Load one to see what it asks of each axis before it is played.",
)
BOUND_TIP = marked(
    "trajectory",
    "The playback pauses when readings are farther from the model than this for 20 ms; "
    "double-click to change it, empty it for no bound",
)


class TrajectoryPanel(Panel):
    """Load → dry run (limits, speed, duration) → play."""

    title = marked("panels", "Trajectory")
    area = Area.BOTTOM
    order = 10
    help_page = "trajectory.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.load = QPushButton(translate("trajectory", "Load …"))
        self.load.setToolTip(
            translate(
                "trajectory", "Take a trajectory from a text file, and try it on the model (Ctrl+T)"
            )
        )
        self.load.clicked.connect(lambda: self.main_window.ask_trajectory())
        self.resample = QPushButton(translate("trajectory", "Resample …"))
        self.resample.setToolTip(
            translate("trajectory", "Another rate, in Hz, for the trajectory in hand")
        )
        self.resample.setEnabled(False)
        self.resample.clicked.connect(self._resample)
        self.transport = Transport(workbench)
        self.name = QLabel("")
        self.name.setProperty("heading", True)
        self.verdict = QLabel(translate("trajectory", EMPTY))
        self.verdict.setWordWrap(True)
        self.name.setTextFormat(Qt.TextFormat.PlainText)
        self.verdict.setTextFormat(Qt.TextFormat.PlainText)
        self.gaps = QLabel("")
        self.gaps.setProperty("quiet", True)
        self.gaps.setTextFormat(Qt.TextFormat.PlainText)
        self.gaps.setWordWrap(True)
        self.table = _table()
        self.table.itemChanged.connect(self._bound_typed)
        self._lay_out()
        workbench.plan_changed.connect(self._show_plan)
        self.follow(self._refresh)

    def _lay_out(self) -> None:
        buttons = QHBoxLayout()
        buttons.addWidget(self.load)
        buttons.addWidget(self.resample)
        buttons.addWidget(self.transport, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(10, 8, 10, 8)
        column.addLayout(buttons)
        column.addWidget(self.name)
        column.addWidget(self.verdict)
        column.addWidget(self.gaps)
        column.addWidget(self.table, 1)
        self.name.hide()
        self.gaps.hide()

    def _show_plan(self, plan: Plan) -> None:
        run = plan.dry_run
        self.name.setText(
            translate("trajectory", "{name} – {seconds:.3f} s, {rows} rows").format(
                name=plan.name, seconds=run.duration_s, rows=run.rows
            )
        )
        self.name.show()
        self.resample.setEnabled(True)
        if run.allowed:
            self.verdict.setText(
                translate(
                    "trajectory",
                    "Dry run: inside all limits of range, speed and acceleration. "
                    "Play first moves the axes to the first row, within the same limits.",
                )
            )
        else:
            more = (
                translate("trajectory", " (and {n} more)").format(n=len(run.objections) - 1)
                if len(run.objections) > 1
                else ""
            )
            self.verdict.setText(
                translate("trajectory", "Not playable: {objection}{more}").format(
                    objection=run.objections[0], more=more
                )
            )
        self.verdict.setProperty("bad", not run.allowed)
        self.verdict.style().polish(self.verdict)
        self.transport.show_plan()
        self._fill(plan)

    def _resample(self) -> None:
        plan = self.workbench.plan
        if plan is None:
            return
        dialog = ResamplingDialog(plan.trajectory, self)

        def use() -> None:
            if dialog.resampled is not None:
                self.workbench.plan_trajectory(
                    translate("trajectory", "{name}, resampled").format(name=plan.name),
                    dialog.resampled,
                )

        dialog.accepted.connect(use)
        dialog.show()

    def _fill(self, plan: Plan) -> None:
        figures = plan.dry_run.axes
        bounds = {name: preset_bound(axis) for name, axis in figures.items()}
        self.workbench.bounds = bounds
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(figures))
            for row, (name, axis) in enumerate(figures.items()):
                scale = axis_scale(self.workbench.robot.axes[name])
                self.table.setVerticalHeaderItem(row, QTableWidgetItem(label(name)))
                for column, cell in enumerate(cells(axis, scale)):
                    item = QTableWidgetItem(cell.text)
                    item.setToolTip(cell.tip)
                    item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
                    self.table.setItem(row, column, item)
                item = QTableWidgetItem(bound_text(bounds[name], axis.unit))
                item.setToolTip(translate("trajectory", BOUND_TIP))
                self.table.setItem(row, BOUND, item)

    def _bound_typed(self, item: QTableWidgetItem) -> None:
        """Use the bounds as they are in the table now, or put back what was no bound."""
        plan = self.workbench.plan
        if plan is None or item.column() != BOUND:
            return
        name = list(plan.dry_run.axes)[item.row()]
        unit = plan.dry_run.axes[name].unit
        bounds = dict(self.workbench.bounds)
        try:
            bound = read_bound(item.text(), unit)
        except InputError as error:
            self.workbench.notify(Level.WARNING, f"{label(name)}: {error}", about=self)
            bound = bounds.get(name)
        if bound is None:
            bounds.pop(name, None)
        else:
            bounds[name] = bound
        self.workbench.bounds = bounds
        with QSignalBlocker(self.table):
            item.setText(bound_text(bound, unit))

    def _refresh(self, state: SessionState) -> None:
        self.transport.refresh(state)
        gaps = self.workbench.playback.state.gaps
        self.gaps.setVisible(bool(gaps))
        plan = self.workbench.plan
        if gaps and plan is not None:
            parts = [
                f"{label(name)} {gap_text(gaps[name], axis.unit)}"
                for name, axis in plan.dry_run.axes.items()
                if name in gaps
            ]
            self.gaps.setText(
                translate("trajectory", "Model and real apart: {parts}").format(
                    parts=" · ".join(parts)
                )
            )


def _table() -> QTableWidget:
    table = QTableWidget(0, len(COLUMNS))
    table.setHorizontalHeaderLabels([translate("trajectory", one) for one in COLUMNS])
    triggers = QAbstractItemView.EditTrigger
    table.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed)
    table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
    table.verticalHeader().setDefaultSectionSize(24)
    return table
