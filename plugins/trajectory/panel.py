"""The Trajectory panel: load a trajectory, see its demands on each axis, play it."""

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

from rotemina.app.language import (
    choose_axis_scale,
    describe_error,
    get_axis_label,
    marked,
    translate_message,
)
from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.widgets.controls import enable_unless, set_property
from rotemina.app.widgets.layout import (
    keep_room_when_hidden,
    make_column,
    make_row,
)
from rotemina.app.widgets.style import OnStyleChange, grow_with_text
from rotemina.app.widgets.text import (
    LiveLabel,
    make_heading,
    make_plain_label,
)
from rotemina.app.workbench import Level, TrajectoryPlan, WaitingRequest, Workbench, describe_moved
from rotemina.plugins.trajectory import mark, tr
from rotemina.plugins.trajectory.dry_run_table import (
    BOUND_COLUMN,
    COLUMN_TITLES,
    compute_default_bound,
    format_bound,
    format_model_gap,
    make_cells,
    parse_bound,
)
from rotemina.plugins.trajectory.path_view import TipPathView
from rotemina.plugins.trajectory.playback_controls import PlaybackControls
from rotemina.plugins.trajectory.resampling import ResamplingDialog
from rotemina.plugins.trajectory.speed_limit_dialog import SpeedLimitDialog
from rotemina.plugins.trajectory.teach_view import TeachView
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record
from rotemina.sim.trajectory import MAX_REPEATS, cut_and_repeat

EMPTY_TEXT = mark(
    "No trajectory is loaded. Load one to see its demands on each axis before playing it."
)
BOUND_TIP = mark(
    "The playback pauses when readings differ from the model by more than this "
    "for 20 ms; double-click to change it, empty: no bound"
)


class TrajectoryPanel(Panel):
    """Panel to load a trajectory, check it in a dry run, and play it."""

    title = marked("panels", "Trajectory")
    area = PanelArea.BOTTOM
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
        self._update_resample_button(tr("no trajectory is loaded"))
        self.resample.clicked.connect(self._open_resampling_dialog)
        self.teach = QPushButton(tr("Teach"))
        self.teach.setToolTip(tr("Make a trajectory from taught points"))
        self.teach.setCheckable(True)
        self.teach.toggled.connect(self._show_points)
        self.points = TeachView(workbench)
        self.points.hide()
        self.points.used.connect(lambda: self.teach.setChecked(False))
        self.transport = PlaybackControls(workbench)
        self.name = make_heading("")
        self.verdict = make_plain_label(tr(EMPTY_TEXT), quiet=False, wrap=True)
        self.gaps = LiveLabel(quiet=True)
        self.gaps.setWordWrap(True)
        self.start_field, self.passes_field = QDoubleSpinBox(), QDoubleSpinBox()
        self._make_part_fields()
        self.table = _make_table()
        self.path = TipPathView(workbench.theme)
        self.path.hide()
        self._shown_trajectory: Record | None = None
        # Name and trajectory, as they were loaded.
        self._loaded: tuple[str, Record] | None = None
        # The planned trajectory: the loaded one, a part of it, or several passes of it.
        self._planned_part: Record | None = None
        self.table.itemChanged.connect(self._on_bound_edited)
        self._lay_out()
        offer_in_palette(self.load, self.resample, self.transport.end, safe_while_hidden=True)
        workbench.plan_changed.connect(self._show_plan)
        workbench.plan_checked.connect(self._show_verdict)
        workbench.speed_limit_asked.connect(self._ask_speed_limit)
        workbench.theme_changed.connect(self.path.set_theme)
        self.follow(self._refresh)

    def _lay_out(self) -> None:
        buttons = make_row(self.load, self.resample, self.teach, (self.transport, 1))
        heading = make_row(self.name, (self.verdict, 1), spacing=12)
        # The fields are aligned at the top, so that a verdict of several lines does not move them.
        for field in (self.start_field, self.passes_field):
            heading.addWidget(field, 0, Qt.AlignmentFlag.AlignTop)
        self.dry_run_view = QWidget()
        make_row((self.table, 1), self.path, on=self.dry_run_view, margins=0)
        parts = buttons, heading, (self.dry_run_view, 1), (self.points, 1), self.gaps
        make_column(*parts, on=self, margins=(10, 8, 10, 8))
        keep_room_when_hidden(self.start_field, self.passes_field)
        self.name.hide()
        self.gaps.hide()

    def _show_points(self, shown: bool) -> None:
        """Show either the taught points or the dry run."""
        self.points.setVisible(shown)
        self.dry_run_view.setVisible(not shown)

    def _show_plan(self, plan: TrajectoryPlan) -> None:
        run = plan.dry_run
        self.name.setText(
            tr("{name} – {seconds:.3f} s, {rows} rows").format(
                name=plan.name, seconds=run.duration_s, rows=run.rows
            )
        )
        self.name.show()
        self._update_resample_button(None)
        self._show_verdict(plan)
        if (
            plan.trajectory is not self._planned_part
            and plan.trajectory is not self._shown_trajectory
        ):
            self._loaded = plan.name, plan.trajectory
            self._reset_part_fields(plan.trajectory)
        is_new_trajectory = self._shown_trajectory is not plan.trajectory
        self._shown_trajectory = plan.trajectory
        if is_new_trajectory:
            self.transport.reset_pace()
            self.workbench.bounds = {
                name: compute_default_bound(axis) for name, axis in run.axes.items()
            }
        self._fill_table(plan)

    def _show_verdict(self, plan: TrajectoryPlan) -> None:
        run = plan.dry_run
        if plan.refusal:
            self.verdict.setText(
                tr("Not playable from here: {why}").format(why=translate_message(plan.refusal))
            )
        elif run.allowed and run.axes_without_limit:
            text = tr("Dry run: {verdict}. The tip stays inside its bounds.")
            self.verdict.setText(text.format(verdict=translate_message(run.verdict)))
        elif run.allowed:
            self.verdict.setText(tr("Dry run: within all limits of the axes and of the tip."))
        else:
            more_text = (
                tr(" (and {n} more)").format(n=len(run.objections) - 1)
                if len(run.objections) > 1
                else ""
            )
            self.verdict.setText(
                tr("Not playable: {objection}{more}").format(
                    objection=translate_message(run.objections[0]), more=more_text
                )
            )
        set_property(self.verdict, "bad", bool(plan.refusal) or not run.allowed)
        self.path.show_path(plan.path)

    def _make_part_fields(self) -> None:
        """Make the fields for the start and the number of passes.

        Typing takes effect only when the field is left.
        """
        self.start_field.setDecimals(3)
        self.start_field.setPrefix(tr("from "))
        self.start_field.setSuffix(" s")
        self.start_field.setAccessibleName(tr("Start of the playback in seconds"))
        self._limit_start(0.0)
        self.passes_field.setDecimals(0)
        self.passes_field.setRange(1, MAX_REPEATS)
        self.passes_field.setSuffix(" ×")
        self.passes_field.setAccessibleName(tr("Passes"))
        self.passes_field.setToolTip(
            tr("Number of passes, 1 to {most}; the trajectory must end where it starts").format(
                most=MAX_REPEATS
            )
        )
        for field in (self.start_field, self.passes_field):
            field.setKeyboardTracking(False)
            OnStyleChange(field, lambda field=field: _limit_width(field))
            field.valueChanged.connect(lambda _: self._plan_part())
            field.hide()

    def _limit_start(self, last_s: float) -> None:
        self.start_field.setRange(0.0, last_s)
        self.start_field.setToolTip(
            tr("Start of the first pass, 0 to {last:.7g} s, before the last row").format(
                last=last_s
            )
        )

    def _plan_part(self) -> None:
        """Plan the requested part. If that is impossible, notify and plan the whole trajectory."""
        if self._loaded is None:
            return
        name, trajectory = self._loaded
        start_s, passes = self.start_field.value(), round(self.passes_field.value())
        try:
            self._planned_part = cut_and_repeat(trajectory, begin_s=start_s, times=passes)
        except InputError as error:
            self.workbench.notify(Level.WARNING, str(error), about=error)
            self._planned_part = trajectory
            self._reset_part_fields(trajectory)
        if self._planned_part is not trajectory:
            start_text = tr("from {begin:.6g} s").format(begin=start_s)
            name = ", ".join(
                [name, *([start_text] * (start_s > 0.0)), *([f"{passes} ×"] * (passes > 1))]
            )
        self.workbench.plan_trajectory(name, self._planned_part)

    def _reset_part_fields(self, trajectory: Record) -> None:
        last_s = float(trajectory.time_s[max(len(trajectory.time_s) - 2, 0)] - trajectory.time_s[0])
        with QSignalBlocker(self.start_field), QSignalBlocker(self.passes_field):
            self._limit_start(floor(1e3 * last_s) / 1e3)
            self.start_field.setValue(0.0)
            self.passes_field.setValue(1)
        for field in (self.start_field, self.passes_field):
            field.show()

    def _update_resample_button(self, objection: str | None) -> None:
        tooltip = tr("Resample the loaded trajectory to another rate, in Hz")
        enable_unless(self.resample, objection, tooltip)

    def _open_resampling_dialog(self) -> None:
        plan = self.workbench.plan
        assert plan is not None, (
            "the button is enabled only with a plan, and a plan is never removed"
        )
        dialog = ResamplingDialog(plan.trajectory, self)

        def use_resampled() -> None:
            if dialog.resampled is not None:
                self.workbench.plan_trajectory(
                    tr("{name}, resampled").format(name=plan.name), dialog.resampled
                )

        dialog.accepted.connect(use_resampled)
        dialog.show()

    def _ask_speed_limit(
        self, plan: TrajectoryPlan, play: Callable[[], object], request: WaitingRequest
    ) -> None:
        # A new request replaces the dialog of an earlier request.
        for old_dialog in self.window().findChildren(SpeedLimitDialog):
            if old_dialog.isVisible():
                old_dialog.reject()
        workbench, run = self.workbench, plan.dry_run
        checked_trajectory = run.require()
        unlimited_axes = workbench.playback.axes_without_speed_limit(checked_trajectory)
        dialog = SpeedLimitDialog(unlimited_axes, run.axes, request, self.window())

        def limit_and_play(speeds: dict[str, float]) -> None:
            workbench.playback.limit_speeds(checked_trajectory, speeds)
            play()

        dialog.speeds_entered.connect(limit_and_play)
        workbench.stopped.connect(dialog.close_if_stopped)
        workbench.plan_changed.connect(dialog.close_for_another)
        dialog.show()

    def _fill_table(self, plan: TrajectoryPlan) -> None:
        figures = plan.dry_run.axes
        bounds = self.workbench.bounds
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(figures))
            for row, (name, axis) in enumerate(figures.items()):
                scale = choose_axis_scale(self.workbench.robot.axes[name])
                self.table.setVerticalHeaderItem(row, QTableWidgetItem(get_axis_label(name)))
                for column, cell in enumerate(make_cells(axis, scale)):
                    item = QTableWidgetItem(cell.text)
                    item.setToolTip(cell.tip)
                    item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
                    self.table.setItem(row, column, item)
                item = QTableWidgetItem(format_bound(bounds.get(name), axis.unit))
                item.setToolTip(tr(BOUND_TIP))
                self.table.setItem(row, BOUND_COLUMN, item)

    def _on_bound_edited(self, item: QTableWidgetItem) -> None:
        plan = self.workbench.plan
        if plan is None or item.column() != BOUND_COLUMN:
            return
        name = list(plan.dry_run.axes)[item.row()]
        unit = plan.dry_run.axes[name].unit
        bounds = dict(self.workbench.bounds)
        try:
            bound = parse_bound(item.text(), unit)
        except InputError as error:
            text = f"{get_axis_label(name)}: {describe_error(error)}"
            self.workbench.notify(Level.WARNING, text, about=error)
            bound = bounds.get(name)
        if bound is None:
            bounds.pop(name, None)
        else:
            bounds[name] = bound
        self.workbench.bounds = bounds
        with QSignalBlocker(self.table):
            item.setText(format_bound(bound, unit))

    def _refresh(self, state: SessionState) -> None:
        self.transport.refresh(state)
        self.points.refresh(state)
        playback, plan = self.workbench.playback.state, self.workbench.plan
        gaps, moved_text = playback.gaps, describe_moved(self.workbench.robot, playback)
        # Only a new playback begins with an approach to the first row.
        self.path.show_tip(state.tip, has_approach=playback.phase is PlaybackPhase.IDLE)
        self.gaps.setVisible(bool(gaps or moved_text))
        set_property(self.gaps, "bad", bool(moved_text))
        if moved_text:
            self.gaps.setText(tr("{moved}: Resume asks how to go on.").format(moved=moved_text))
        elif gaps and plan is not None:
            parts = [
                f"{get_axis_label(name)} {format_model_gap(gaps[name], axis.unit)}"
                for name, axis in plan.dry_run.axes.items()
                if name in gaps
            ]
            self.gaps.setText(
                tr("Distance between model and machine: {parts}").format(parts=" · ".join(parts))
            )


def _make_table() -> QTableWidget:
    table = QTableWidget(0, len(COLUMN_TITLES))
    table.setHorizontalHeaderLabels([tr(title) for title in COLUMN_TITLES])
    triggers = QAbstractItemView.EditTrigger
    table.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed)
    table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
    table.setCornerButtonEnabled(False)
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().setStretchLastSection(True)
    header, row_header = table.horizontalHeader(), table.verticalHeader()
    grow_with_text(header, header.setFixedHeight, 23)
    # The rows are low, so that six axes are visible in a window of 1280 × 800.
    grow_with_text(row_header, row_header.setDefaultSectionSize, 21)
    return table


def _limit_width(field: QSpinBox | QDoubleSpinBox) -> None:
    text = field.prefix() + "99999 ×"
    field.setMaximumWidth(field.fontMetrics().horizontalAdvance(text) + 28)
