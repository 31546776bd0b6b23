"""Coordinates of the current mode: deflection, reference, and effect of full deflection."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QSizePolicy, QWidget

from rotemina.app.motion.inputs import InputArbiter
from rotemina.app.motion.teleoperation import CoordinateView, ImpedanceLaw, TeleoperationState
from rotemina.app.widgets.controls import name_widget, set_property
from rotemina.app.widgets.layout import Section, make_grid
from rotemina.app.widgets.text import (
    make_heading,
    make_plain_label,
    reserve_lines,
)
from rotemina.app.workbench import Workbench
from rotemina.plugins.teleoperation import tr, wording
from rotemina.sim.units import DisplayScale


class CentreBar(QWidget):
    """Bar for a value from −1 to 1, drawn from the centre. It is dashed if there is no value.

    Parameters
    ----------
    workbench : Workbench
        Provides the theme.
    colour : str
        Colour role of the filled part in the theme.
    """

    def __init__(self, workbench: Workbench, colour: str = "accent") -> None:
        super().__init__()
        self.value: float | None = None
        self._stale = False
        self._workbench, self._colour = workbench, colour
        self.setFixedHeight(10)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_value(self, value: float | None, *, stale: bool = False) -> None:
        """Show a value, or that there is none. A stale value is grey."""
        if (value, stale) != (self.value, self._stale):
            self.value, self._stale = value, stale
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the line, the value and the centre."""
        theme = self._workbench.theme
        painter = QPainter(self)
        width, middle = self.width(), self.height() / 2
        if self.value is None:
            painter.setPen(QPen(QColor(theme.quiet), 1, Qt.PenStyle.DashLine))
            painter.drawLine(0, round(middle), width, round(middle))
        else:
            painter.fillRect(QRectF(0, middle - 2, width, 4), theme.line)
            length = 0.5 * width * min(max(self.value, -1.0), 1.0)
            filled = QRectF(0.5 * width, middle - 3, length, 6).normalized()
            painter.fillRect(filled, theme.quiet if self._stale else getattr(theme, self._colour))
        painter.fillRect(QRectF(0.5 * width - 1, 0, 2, self.height()), theme.text)
        painter.end()


class CoordinateRow(QFrame):
    """Row for a coordinate: deflection of the stick, reference, and scaling in plain units."""

    def __init__(self, workbench: Workbench, name: str, scale: DisplayScale, source: str) -> None:
        super().__init__()
        self.setObjectName("axisRow")
        self._name, self._scale = name, scale
        title = make_heading(name)
        title.setToolTip(tr("Moved by {source} of the stick").format(source=source))
        self.position = make_plain_label(quiet=False)
        self.position.setAccessibleName(
            tr("{name} reference in {unit}").format(name=name, unit=scale.symbol)
        )
        self.position.setToolTip(tr("Reference that the stick commands and the axes follow"))
        self.bar = CentreBar(workbench)
        self.bar.setAccessibleName(tr("{name} deflection of the stick").format(name=name))
        self.bar.setToolTip(tr("Deflection of the stick, −100 % to 100 %; dashed: none is active"))
        self.law = name_widget(make_plain_label(lines=1), tr("{name} scaling").format(name=name))
        self.force_title = make_plain_label(tr("Force"))
        self.force_bar = CentreBar(workbench, "warning")
        self.force_bar.setAccessibleName(tr("{name} contact force at the stick").format(name=name))
        self.force_bar.setToolTip(
            tr("Force of a contact at the stick, −100 % to 100 % of its maximum")
        )
        grid = make_grid(on=self, margins=(0, 2, 0, 5), spacing=(-1, 2), stretched=1)
        grid.addWidget(title, 0, 0)
        grid.addWidget(self.position, 0, 1, Qt.AlignmentFlag.AlignRight)
        grid.addWidget(self.bar, 1, 0, 1, 2)
        grid.addWidget(self.law, 2, 0, 1, 2)
        grid.addWidget(self.force_title, 3, 0)
        grid.addWidget(self.force_bar, 3, 1)

    def show_view(self, view: CoordinateView, travel_m: float | None, *, stale: bool) -> None:
        """Show the current state. ``travel_m`` is the travel of the stick, if known."""
        self.position.setText(self._scale.format_with_unit(view.position))
        set_property(self.position, "stale", stale)
        self.bar.show_value(view.deflection, stale=stale)
        moving_part = tr("tip") if view.unit == "m" else self._name
        scaling = wording.describe_law(view, moving_part, travel_m)
        self.law.setText(tr(wording.WAITING_TEXT) if view.is_waiting else scaling)
        set_property(self.law, "bad", view.is_waiting)
        set_property(self.law, "quiet", not view.is_waiting)
        has_force = isinstance(view.law, ImpedanceLaw)
        reserve_lines(self.law, 2 if has_force else 1)
        self.force_title.setVisible(has_force)
        self.force_bar.setVisible(has_force)
        self.force_bar.show_value(view.contact_force_ratio, stale=stale)


class CoordinateSection(Section):
    """Section with a row for each coordinate of the mode.

    While there are no coordinates, the last rows of the same mode remain, greyed out.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Coordinates"))
        self._workbench = workbench
        self._shown_coordinates: tuple[str, ...] = ()
        self.rows: dict[str, CoordinateRow] = {}
        self.empty_label = make_plain_label(lines=2)
        self.empty_label.setText(
            tr("Available when the positions of the axes are known and a device is connected.")
        )
        self.column.addWidget(self.empty_label)

    def refresh(self, state: TeleoperationState, arbiter: InputArbiter, *, stale: bool) -> None:
        """Show the current state."""
        views = state.coordinates
        if not views:
            is_same_mode = (
                bool(self._shown_coordinates) and self._shown_coordinates[0] == state.mode
            )
            self._grey_out_rows(is_same_mode)
            return
        shown_coordinates = (state.mode, *(view.name for view in views))
        if shown_coordinates != self._shown_coordinates:
            self._make_rows(state.mode, views)
            self._shown_coordinates = shown_coordinates
        for view in views:
            travel_m = arbiter.find_travel_m(view.name) or arbiter.find_travel_m(view.source)
            self.rows[view.name].show_view(view, travel_m, stale=stale)

    def _grey_out_rows(self, is_same_mode: bool) -> None:
        """Grey out the rows, or remove them if they belong to another mode."""
        if not is_same_mode:
            self._clear()
        for row in self.rows.values():
            row.bar.show_value(None)
            set_property(row.position, "stale", True)

    def _make_rows(self, mode: str, views: tuple[CoordinateView, ...]) -> None:
        self._clear()
        self.empty_label.hide()
        robot = self._workbench.robot
        for view in views:
            name = wording.name_coordinate(mode, view.name, view.unit)
            scale = wording.find_coordinate_scale(robot, mode, view.name, view.unit)
            row = CoordinateRow(self._workbench, name, scale, view.source)
            self.rows[view.name] = row
            self.column.addWidget(row)

    def _clear(self) -> None:
        for row in self.rows.values():
            self.column.removeWidget(row)
            row.hide()
            row.deleteLater()
        self.rows, self._shown_coordinates = {}, ()
        self.empty_label.show()
