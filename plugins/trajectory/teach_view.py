"""Teach points: where the machine is becomes a point; points become a trajectory."""

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button, named
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.when_dressed import grow_with_text
from rotemina.plugins.trajectory import tr
from rotemina.plugins.trajectory.taught_trajectory import LONGEST_PAUSE_S, TaughtPoint, taught
from rotemina.sim.quantities import parsed, rounded
from rotemina.sim.records.record import Record


class TeachView(QWidget):
    """The points in a table: a place of each axis, the speed of the way there, a pause.

    Nothing here moves the machine: the trajectory is planned as one of a file is.

    Signals
    -------
    used() : a trajectory of the points is being planned.
    """

    used = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.points: list[TaughtPoint] = []
        self._axes = tuple(workbench.robot.axes)
        self._scales = [axis_scale(axis) for axis in workbench.robot.axes.values()]
        heads = [
            f"{label(axis)} [{scale.symbol}]"
            for axis, scale in zip(self._axes, self._scales, strict=True)
        ]
        heads += [tr("speed [%]"), tr("pause [s]")]
        self.table = named(QTableWidget(0, len(heads)), tr("Taught points"))
        self.table.setHorizontalHeaderLabels(heads)
        triggers = QAbstractItemView.EditTrigger
        self.table.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        grow_with_text(header, header.setFixedHeight, 23)
        down = self.table.verticalHeader()
        grow_with_text(down, down.setDefaultSectionSize, 21)
        self.table.itemChanged.connect(self._typed)
        self.take = button(tr("Add point"), self._take)
        self.again = button(tr("Replace"), self._again)
        self.remove = button(tr("Remove"), self._remove)
        self.use = button(tr("Make trajectory"), self._use)
        buttons = in_column(self.take, self.again, self.remove, self.use, 1)
        in_row((self.table, 1), buttons, on=self, margins=0)

    def refresh(self, state: SessionState) -> None:
        """Allow what can be done now."""
        known = None if state.position_known else tr("the position is unknown")
        chosen = None if self.table.currentRow() >= 0 else tr("select a point first")
        few = None if len(self.points) > 1 else tr("add two points or more")
        allow(
            self.take, known, tr("Add the present target of the machine after the selected point")
        )
        allow(
            self.again,
            known or chosen,
            tr("Replace the selected point by the present target of the machine"),
        )
        allow(self.remove, chosen, tr("Remove the selected point"))
        allow(self.use, few, tr("Make a trajectory from the points and check it in a dry run"))

    def _take(self) -> None:
        row = self.table.currentRow()
        at = row + 1 if row >= 0 else len(self.points)
        point = TaughtPoint(dict(self._workbench.session.snapshot().command))
        if point.place:
            self.points.insert(at, point)
            self._fill(at)

    def _again(self) -> None:
        row, place = self.table.currentRow(), self._workbench.session.snapshot().command
        if 0 <= row < len(self.points) and place:
            self.points[row] = replace(self.points[row], place=dict(place))
            self._fill(row)

    def _remove(self) -> None:
        row = self.table.currentRow()
        if 0 <= row < len(self.points):
            del self.points[row]
            self._fill(min(row, len(self.points) - 1))

    def _use(self) -> None:
        name = tr("{n} taught points").format(n=len(self.points))
        found: list[Record] = []
        points, robot = tuple(self.points), self._workbench.robot
        if self._workbench.ask(lambda: found.append(taught(robot, points, name))):
            self._workbench.plan_trajectory(name, found[0])
            self.used.emit()

    def _typed(self, item: QTableWidgetItem) -> None:
        """Take what was typed, or put back what was there and say what may stand there."""
        row, column = item.row(), item.column()
        value, point = parsed(item.text()), self.points[row]
        after = None if value is None else self._changed(point, column, value)
        if after is None:
            self._workbench.notify(Level.WARNING, self._bound(row, column, item.text()), about=self)
        else:
            self.points[row] = after
        self._fill(row)

    def _changed(self, point: TaughtPoint, column: int, value: float) -> TaughtPoint | None:
        """Return a point with another number in a column; None where that may not be."""
        count = len(self._axes)
        if column < count:
            axis = self._axes[column]
            low, high = self._workbench.session.ranges.of(axis)
            place = value / self._scales[column].per_si
            slack = 1e-9 * (high - low)
            inside = low - slack <= place <= high + slack
            return replace(point, place={**point.place, axis: place}) if inside else None
        if column == count:
            return replace(point, speed=0.01 * value) if 0.0 < value <= 100.0 else None
        return replace(point, pause_s=value) if 0.0 <= value <= LONGEST_PAUSE_S else None

    def _bound(self, row: int, column: int, text: str) -> str:
        count = len(self._axes)
        if column < count:
            scale = self._scales[column]
            low, high = self._workbench.session.ranges.of(self._axes[column])
            bound = tr("must be {low} to {high}").format(low=scale.text(low), high=scale.text(high))
        elif column == count:
            bound = tr("must be above 0 and at most 100 %")
        else:
            bound = tr("must be 0 to {most} s").format(most=rounded(LONGEST_PAUSE_S))
        head = self.table.horizontalHeaderItem(column).text()
        return tr("Point {number}, {column}: {text!r}: {bound}").format(
            number=row + 1, column=head, text=text, bound=bound
        )

    def _fill(self, chosen: int) -> None:
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(self.points))
            for row, point in enumerate(self.points):
                texts = [
                    scale.number(point.place[axis])
                    for axis, scale in zip(self._axes, self._scales, strict=True)
                ]
                texts += [rounded(100.0 * point.speed), rounded(point.pause_s)]
                for column, text in enumerate(texts):
                    self.table.setItem(row, column, QTableWidgetItem(text))
        if chosen >= 0:
            self.table.selectRow(chosen)
