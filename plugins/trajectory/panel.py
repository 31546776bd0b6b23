"""Trajectories: load one, see what it asks of each axis, play it."""

from collections.abc import Callable
from math import floor

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDoubleSpinBox,
    QHeaderView,
    QPushButton,
    QSpinBox,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.engine_words import error_text, spoken
from rotemina.app.shell.language import marked
from rotemina.app.shell.loaded_trajectory import Plan
from rotemina.app.shell.requests_at_rest import WaitingRequest
from rotemina.app.shell.state_words import describe_moved
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, set_property
from rotemina.app.widgets.labels import LiveLabel, heading, plain_text
from rotemina.app.widgets.layouts import in_column, in_row, keep_room
from rotemina.app.widgets.when_dressed import WhenDressed, grow_with_text
from rotemina.plugins.trajectory import mark, tr
from rotemina.plugins.trajectory.dry_run_table import (
    BOUND,
    COLUMNS,
    bound_text,
    cells,
    gap_text,
    preset_bound,
    read_bound,
)
from rotemina.plugins.trajectory.path_view import PathView
from rotemina.plugins.trajectory.playback_controls import Transport
from rotemina.plugins.trajectory.resampling import ResamplingDialog
from rotemina.plugins.trajectory.speed_limit_dialog import SpeedLimitDialog
from rotemina.plugins.trajectory.teach_view import TeachView
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.section_and_repeat import MOST_TIMES, part

EMPTY = mark("No trajectory is loaded. Load one to see its demands on each axis before playing it.")
BOUND_TIP = mark(
    "The playback pauses when readings differ from the model by more than this "
    "for 20 ms; double-click to change it, empty: no bound"
)


class TrajectoryPanel(Panel):
    """Load → dry run (limits, speed, duration) → play."""

    title = marked("panels", "Trajectory")
    area = Area.BOTTOM
    order = 10
    help_page = "trajectory.md"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.load = QPushButton(tr("Load …"))
        self.load.setToolTip(
            tr("Load a trajectory from a text file and check it on the model (Ctrl+T)")
        )
        self.load.clicked.connect(lambda: self.main_window.ask_trajectory(show=False))
        self.resample = QPushButton(tr("Resample …"))
        self._allow_resampling(tr("no trajectory is loaded"))
        self.resample.clicked.connect(self._resample)
        self.teach = QPushButton(tr("Teach"))
        self.teach.setToolTip(tr("Make a trajectory from taught points"))
        self.teach.setCheckable(True)
        self.teach.toggled.connect(self._show_points)
        self.points = TeachView(workbench)
        self.points.hide()
        self.points.used.connect(lambda: self.teach.setChecked(False))
        self.transport = Transport(workbench)
        self.name = heading("")
        self.verdict = plain_text(tr(EMPTY), quiet=False, wrap=True)
        self.gaps = LiveLabel(quiet=True)
        self.gaps.setWordWrap(True)
        self.begin, self.times = QDoubleSpinBox(), QDoubleSpinBox()
        self._make_parts()
        self.table = _table()
        self.path = PathView(workbench.theme)
        self.path.hide()
        self._shown: Record | None = None
        self._whole: tuple[str, Record] | None = None  # what was loaded
        self._part: Record | None = None  # what was made of that
        self.table.itemChanged.connect(self._bound_typed)
        self._lay_out()
        offer_in_palette(self.load, self.resample, self.transport.end, safe_while_hidden=True)
        workbench.plan_changed.connect(self._show_plan)
        workbench.plan_checked.connect(self._show_verdict)
        workbench.speed_limit_asked.connect(self._ask_speed_limit)
        workbench.theme_changed.connect(self.path.set_theme)
        self.follow(self._refresh)

    def _lay_out(self) -> None:
        buttons = in_row(self.load, self.resample, self.teach, (self.transport, 1))
        heading = in_row(self.name, (self.verdict, 1), spacing=12)
        for field in (self.begin, self.times):  # where they stay, however long the verdict is
            heading.addWidget(field, 0, Qt.AlignmentFlag.AlignTop)
        self.tried = QWidget()
        in_row((self.table, 1), self.path, on=self.tried, margins=0)
        parts = buttons, heading, (self.tried, 1), (self.points, 1), self.gaps
        in_column(*parts, on=self, margins=(10, 8, 10, 8))
        keep_room(self.begin, self.times)
        self.name.hide()
        self.gaps.hide()

    def _show_points(self, shown: bool) -> None:
        """Show the points that were taught, or what the dry run found."""
        self.points.setVisible(shown)
        self.tried.setVisible(not shown)

    def _show_plan(self, plan: Plan) -> None:
        run = plan.dry_run
        self.name.setText(
            tr("{name} – {seconds:.3f} s, {rows} rows").format(
                name=plan.name, seconds=run.duration_s, rows=run.rows
            )
        )
        self.name.show()
        self._allow_resampling(None)
        self._show_verdict(plan)
        if plan.trajectory is not self._part and plan.trajectory is not self._shown:
            self._whole = plan.name, plan.trajectory
            self._show_part(plan.trajectory)
        anew, self._shown = self._shown is not plan.trajectory, plan.trajectory
        if anew:
            self.transport.show_plan()
            self.workbench.bounds = {name: preset_bound(one) for name, one in run.axes.items()}
        self._fill(plan)

    def _show_verdict(self, plan: Plan) -> None:
        """Say whether it may be played, and draw where the tip would go."""
        run = plan.dry_run
        if plan.refusal:
            self.verdict.setText(
                tr("Not playable from here: {why}").format(why=spoken(plan.refusal))
            )
        elif run.allowed and run.axes_without_limit:
            text = tr("Dry run: {verdict}. The tip stays inside its bounds.")
            self.verdict.setText(text.format(verdict=spoken(run.verdict)))
        elif run.allowed:
            self.verdict.setText(tr("Dry run: within all limits of the axes and of the tip."))
        else:
            more = (
                tr(" (and {n} more)").format(n=len(run.objections) - 1)
                if len(run.objections) > 1
                else ""
            )
            self.verdict.setText(
                tr("Not playable: {objection}{more}").format(
                    objection=spoken(run.objections[0]), more=more
                )
            )
        set_property(self.verdict, "bad", bool(plan.refusal) or not run.allowed)
        self.path.show_path(plan.path)

    def _make_parts(self) -> None:
        """Offer where it begins, and how often it is played; a key alone changes nothing yet."""
        self.begin.setDecimals(3)
        self.begin.setPrefix(tr("from "))
        self.begin.setSuffix(" s")
        self.begin.setAccessibleName(tr("Start of the playback in seconds"))
        self._bound_begin(0.0)
        self.times.setDecimals(0)
        self.times.setRange(1, MOST_TIMES)
        self.times.setSuffix(" ×")
        self.times.setAccessibleName(tr("Passes"))
        self.times.setToolTip(
            tr("Number of passes, 1 to {most}; the trajectory must end where it starts").format(
                most=MOST_TIMES
            )
        )
        for field in (self.begin, self.times):
            field.setKeyboardTracking(False)
            WhenDressed(field, lambda field=field: _narrow(field))
            field.valueChanged.connect(lambda _: self._take_part())
            field.hide()

    def _bound_begin(self, last_s: float) -> None:
        self.begin.setRange(0.0, last_s)
        self.begin.setToolTip(
            tr("Start of the first pass, 0 to {last:.7g} s, before the last row").format(
                last=last_s
            )
        )

    def _take_part(self) -> None:
        """Plan the part that is requested; what cannot be is told, and all of it is back."""
        if self._whole is None:
            return
        name, whole = self._whole
        begin_s, times = self.begin.value(), round(self.times.value())
        try:
            self._part = part(whole, begin_s=begin_s, times=times)
        except InputError as error:
            self.workbench.notify(Level.WARNING, str(error), about=error)
            self._part = whole
            self._show_part(whole)
        if self._part is not whole:
            begun = tr("from {begin:.6g} s").format(begin=begin_s)
            name = ", ".join([name, *([begun] * (begin_s > 0.0)), *([f"{times} ×"] * (times > 1))])
        self.workbench.plan_trajectory(name, self._part)

    def _show_part(self, whole: Record) -> None:
        """Offer all of a trajectory, once."""
        last_s = float(whole.time_s[max(len(whole.time_s) - 2, 0)] - whole.time_s[0])
        with QSignalBlocker(self.begin), QSignalBlocker(self.times):
            self._bound_begin(floor(1e3 * last_s) / 1e3)
            self.begin.setValue(0.0)
            self.times.setValue(1)
        for field in (self.begin, self.times):
            field.show()

    def _allow_resampling(self, why_not: str | None) -> None:
        tip = tr("Resample the loaded trajectory to another rate, in Hz")
        allow(self.resample, why_not, tip)

    def _resample(self) -> None:
        plan = self.workbench.plan
        assert plan is not None, "it is allowed with a plan only, and a plan stays"
        dialog = ResamplingDialog(plan.trajectory, self)

        def use() -> None:
            if dialog.resampled is not None:
                self.workbench.plan_trajectory(
                    tr("{name}, resampled").format(name=plan.name), dialog.resampled
                )

        dialog.accepted.connect(use)
        dialog.show()

    def _ask_speed_limit(
        self, plan: Plan, play: Callable[[], object], request: WaitingRequest
    ) -> None:
        """Ask how fast the axes without a speed limit may move, then play."""
        for asked in self.window().findChildren(SpeedLimitDialog):
            if asked.isVisible():  # it was asked for twice: the latest counts
                asked.reject()
        bench, run = self.workbench, plan.dry_run
        checked = run.require()
        missing = bench.playback.axes_without_speed_limit(checked)
        dialog = SpeedLimitDialog(missing, run.axes, request, self.window())

        def limit_and_play(speeds: dict[str, float]) -> None:
            bench.playback.limit_speeds(checked, speeds)
            play()

        dialog.limited.connect(limit_and_play)
        bench.stopped.connect(dialog.close_if_stopped)
        bench.plan_changed.connect(dialog.close_for_another)
        dialog.show()

    def _fill(self, plan: Plan) -> None:
        figures = plan.dry_run.axes
        bounds = self.workbench.bounds
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
                item = QTableWidgetItem(bound_text(bounds.get(name), axis.unit))
                item.setToolTip(tr(BOUND_TIP))
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
            text = f"{label(name)}: {error_text(error)}"
            self.workbench.notify(Level.WARNING, text, about=error)
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
        self.points.refresh(state)
        playback, plan = self.workbench.playback.state, self.workbench.plan
        gaps, moved = playback.gaps, describe_moved(self.workbench.robot, playback)
        # Only from rest does the next motion begin with the way to the first row.
        self.path.show_tip(state.tip, approaches=playback.phase is PlaybackPhase.IDLE)
        self.gaps.setVisible(bool(gaps or moved))
        set_property(self.gaps, "bad", bool(moved))
        if moved:
            self.gaps.setText(tr("{moved}: Resume asks how to go on.").format(moved=moved))
        elif gaps and plan is not None:
            parts = [
                f"{label(name)} {gap_text(gaps[name], axis.unit)}"
                for name, axis in plan.dry_run.axes.items()
                if name in gaps
            ]
            self.gaps.setText(
                tr("Distance between model and machine: {parts}").format(parts=" · ".join(parts))
            )


def _table() -> QTableWidget:
    table = QTableWidget(0, len(COLUMNS))
    table.setHorizontalHeaderLabels([tr(one) for one in COLUMNS])
    triggers = QAbstractItemView.EditTrigger
    table.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed)
    table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
    table.setCornerButtonEnabled(False)  # it would select all
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().setStretchLastSection(True)
    across, down = table.horizontalHeader(), table.verticalHeader()
    grow_with_text(across, across.setFixedHeight, 23)
    grow_with_text(down, down.setDefaultSectionSize, 21)  # six axes at 1280 × 800
    return table


def _narrow(field: QSpinBox | QDoubleSpinBox) -> None:
    text = field.prefix() + "99999 ×"
    field.setMaximumWidth(field.fontMetrics().horizontalAdvance(text) + 28)
