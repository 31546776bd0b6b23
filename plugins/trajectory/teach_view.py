"""View in which the operator teaches points and makes a trajectory from them."""

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from rotemina.app.language import choose_axis_scale, get_axis_label
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    enable_unless,
    make_button,
    name_widget,
)
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import grow_with_text
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.trajectory import tr
from rotemina.plugins.trajectory.taught_trajectory import (
    MAX_PAUSE_S,
    TaughtPoint,
    make_taught_trajectory,
)
from rotemina.sim.messages import format_rounded, parse_number
from rotemina.sim.records import Record


class TeachView(QWidget):
    """Table of the taught points: position of each axis, speed of the move to it, and pause.

    Nothing here moves the machine. The trajectory is planned like one from a file.

    Signals
    -------
    used()
        Emitted when the planning of a trajectory from the points begins.
    """

    used = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.points: list[TaughtPoint] = []
        self._axes = tuple(workbench.robot.axes)
        self._scales = [choose_axis_scale(axis) for axis in workbench.robot.axes.values()]
        titles = [
            f"{get_axis_label(axis)} [{scale.symbol}]"
            for axis, scale in zip(self._axes, self._scales, strict=True)
        ]
        titles += [tr("speed [%]"), tr("pause [s]")]
        self.table = name_widget(QTableWidget(0, len(titles)), tr("Taught points"))
        self.table.setHorizontalHeaderLabels(titles)
        triggers = QAbstractItemView.EditTrigger
        self.table.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        grow_with_text(header, header.setFixedHeight, 23)
        row_header = self.table.verticalHeader()
        grow_with_text(row_header, row_header.setDefaultSectionSize, 21)
        self.table.itemChanged.connect(self._on_item_edited)
        self.add_button = make_button(tr("Add point"), self._add_point)
        self.replace_button = make_button(tr("Replace"), self._replace_point)
        self.remove_button = make_button(tr("Remove"), self._remove_point)
        self.use_button = make_button(tr("Make trajectory"), self._make_trajectory)
        buttons = make_column(
            self.add_button, self.replace_button, self.remove_button, self.use_button, 1
        )
        make_row((self.table, 1), buttons, on=self, margins=0)

    def refresh(self, state: SessionState) -> None:
        """Enable the buttons that are available in this state."""
        position_objection = None if state.position_known else tr("the position is unknown")
        selection_objection = None if self.table.currentRow() >= 0 else tr("select a point first")
        count_objection = None if len(self.points) > 1 else tr("add two points or more")
        enable_unless(
            self.add_button,
            position_objection,
            tr("Add the present target of the machine after the selected point"),
        )
        enable_unless(
            self.replace_button,
            position_objection or selection_objection,
            tr("Replace the selected point with the present target of the machine"),
        )
        enable_unless(self.remove_button, selection_objection, tr("Remove the selected point"))
        enable_unless(
            self.use_button,
            count_objection,
            tr("Make a trajectory from the points and check it in a dry run"),
        )

    def _add_point(self) -> None:
        row = self.table.currentRow()
        index = row + 1 if row >= 0 else len(self.points)
        point = TaughtPoint(dict(self._workbench.session.snapshot().command))
        if point.place:
            self.points.insert(index, point)
            self._fill_table(index)

    def _replace_point(self) -> None:
        row, command = self.table.currentRow(), self._workbench.session.snapshot().command
        if 0 <= row < len(self.points) and command:
            self.points[row] = replace(self.points[row], place=dict(command))
            self._fill_table(row)

    def _remove_point(self) -> None:
        row = self.table.currentRow()
        if 0 <= row < len(self.points):
            del self.points[row]
            self._fill_table(min(row, len(self.points) - 1))

    def _make_trajectory(self) -> None:
        name = tr("{n} taught points").format(n=len(self.points))
        trajectories: list[Record] = []
        points, robot = tuple(self.points), self._workbench.robot
        if self._workbench.run_request(
            lambda: trajectories.append(make_taught_trajectory(robot, points, name))
        ):
            self._workbench.plan_trajectory(name, trajectories[0])
            self.used.emit()

    def _on_item_edited(self, item: QTableWidgetItem) -> None:
        """Use an edited value. If it is invalid, restore the previous one and report the bounds."""
        row, column = item.row(), item.column()
        value, point = parse_number(item.text()), self.points[row]
        changed_point = None if value is None else self._with_number(point, column, value)
        if changed_point is None:
            self._workbench.notify(
                Level.WARNING, self._explain_bound(row, column, item.text()), about=self
            )
        else:
            self.points[row] = changed_point
        self._fill_table(row)

    def _with_number(self, point: TaughtPoint, column: int, value: float) -> TaughtPoint | None:
        axis_count = len(self._axes)
        if column < axis_count:
            axis = self._axes[column]
            low, high = self._workbench.session.ranges.find_range(axis)
            position = value / self._scales[column].per_si
            tolerance = 1e-9 * (high - low)
            is_inside = low - tolerance <= position <= high + tolerance
            return replace(point, place={**point.place, axis: position}) if is_inside else None
        if column == axis_count:
            return replace(point, speed=0.01 * value) if 0.0 < value <= 100.0 else None
        return replace(point, pause_s=value) if 0.0 <= value <= MAX_PAUSE_S else None

    def _explain_bound(self, row: int, column: int, text: str) -> str:
        axis_count = len(self._axes)
        if column < axis_count:
            scale = self._scales[column]
            low, high = self._workbench.session.ranges.find_range(self._axes[column])
            bound = tr("must be {low} to {high}").format(
                low=scale.format_with_unit(low), high=scale.format_with_unit(high)
            )
        elif column == axis_count:
            bound = tr("must be above 0 and at most 100 %")
        else:
            bound = tr("must be 0 to {most} s").format(most=format_rounded(MAX_PAUSE_S))
        title = self.table.horizontalHeaderItem(column).text()
        return tr("Point {number}, {column}: {text!r}: {bound}").format(
            number=row + 1, column=title, text=text, bound=bound
        )

    def _fill_table(self, selected_row: int) -> None:
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(self.points))
            for row, point in enumerate(self.points):
                texts = [
                    scale.format_value(point.place[axis])
                    for axis, scale in zip(self._axes, self._scales, strict=True)
                ]
                texts += [format_rounded(100.0 * point.speed), format_rounded(point.pause_s)]
                for column, text in enumerate(texts):
                    self.table.setItem(row, column, QTableWidgetItem(text))
        if selected_row >= 0:
            self.table.selectRow(selected_row)
