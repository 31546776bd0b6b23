"""Coordinates of the present mode: stick, reference, and meaning of full deflection."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QSizePolicy, QWidget

from rotemina.app.display_units import Scale
from rotemina.app.motion.teleoperation.impedance import Impedance
from rotemina.app.motion.teleoperation.input_arbiter import InputArbiter
from rotemina.app.motion.teleoperation.teleoperation_state import CoordinateView, TeleoperationState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import named, set_property
from rotemina.app.widgets.labels import heading, keep_lines, plain_text
from rotemina.app.widgets.layouts import in_grid
from rotemina.app.widgets.section import Section
from rotemina.plugins.teleoperation import tr, wording


class CentreBar(QWidget):
    """A value of −1 to 1, drawn from the middle; none is drawn as a dashed line.

    Parameters
    ----------
    workbench : Workbench
        For its colours.
    colour : str
        The theme's role of the filled part.
    """

    def __init__(self, workbench: Workbench, colour: str = "accent") -> None:
        super().__init__()
        self.value: float | None = None
        self._stale = False
        self._workbench, self._colour = workbench, colour
        self.setFixedHeight(10)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_value(self, value: float | None, *, stale: bool = False) -> None:
        """Draw another value."""
        if (value, stale) != (self.value, self._stale):
            self.value, self._stale = value, stale
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the line, the value, and the middle."""
        theme = self._workbench.theme
        painter = QPainter(self)
        width, middle = self.width(), self.height() / 2
        if self.value is None:
            painter.setPen(QPen(QColor(theme.quiet), 1, Qt.PenStyle.DashLine))
            painter.drawLine(0, round(middle), width, round(middle))
        else:
            painter.fillRect(QRectF(0, middle - 2, width, 4), theme.line)
            share = 0.5 * width * min(max(self.value, -1.0), 1.0)
            filled = QRectF(0.5 * width, middle - 3, share, 6).normalized()
            painter.fillRect(filled, theme.quiet if self._stale else getattr(theme, self._colour))
        painter.fillRect(QRectF(0.5 * width - 1, 0, 2, self.height()), theme.text)
        painter.end()


class CoordinateRow(QFrame):
    """One coordinate: its stick's deflection, its reference, its law in plain units."""

    def __init__(self, workbench: Workbench, name: str, scale: Scale, source: str) -> None:
        super().__init__()
        self.setObjectName("axisRow")
        self._name, self._scale = name, scale
        title = heading(name)
        title.setToolTip(tr("Moved by {source} of the stick").format(source=source))
        self.position = plain_text(quiet=False)
        self.position.setAccessibleName(
            tr("{name} reference in {unit}").format(name=name, unit=scale.symbol)
        )
        self.position.setToolTip(tr("Reference that the stick commands and the axes follow"))
        self.bar = CentreBar(workbench)
        self.bar.setAccessibleName(tr("{name} deflection of the stick").format(name=name))
        self.bar.setToolTip(tr("Deflection of the stick, −100 % to 100 %; dashed: none is active"))
        self.law = named(plain_text(lines=1), tr("{name} scaling").format(name=name))
        self.felt_title = plain_text(tr("Force"))
        self.felt = CentreBar(workbench, "warning")
        self.felt.setAccessibleName(tr("{name} contact force at the stick").format(name=name))
        self.felt.setToolTip(tr("Force of a contact at the stick, −100 % to 100 % of its maximum"))
        grid = in_grid(on=self, margins=(0, 2, 0, 5), spacing=(-1, 2), stretched=1)
        grid.addWidget(title, 0, 0)
        grid.addWidget(self.position, 0, 1, Qt.AlignmentFlag.AlignRight)
        grid.addWidget(self.bar, 1, 0, 1, 2)
        grid.addWidget(self.law, 2, 0, 1, 2)
        grid.addWidget(self.felt_title, 3, 0)
        grid.addWidget(self.felt, 3, 1)

    def show_view(self, view: CoordinateView, travel_m: float | None, *, stale: bool) -> None:
        """Show a moment."""
        self.position.setText(self._scale.text(view.position))
        set_property(self.position, "stale", stale)
        self.bar.show_value(view.deflection, stale=stale)
        what = tr("tip") if view.unit == "m" else self._name
        scaling = wording.law_text(view, what, travel_m)
        self.law.setText(tr(wording.WAITING) if view.waiting else scaling)
        set_property(self.law, "bad", view.waiting)
        set_property(self.law, "quiet", not view.waiting)
        felt = isinstance(view.law, Impedance)
        keep_lines(self.law, 2 if felt else 1)
        self.felt_title.setVisible(felt)
        self.felt.setVisible(felt)
        self.felt.show_value(view.felt, stale=stale)


class CoordinateSection(Section):
    """A row for each coordinate of the mode; the last ones stay, grey, while there are none."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Coordinates"))
        self._workbench = workbench
        self._shown: tuple[str, ...] = ()
        self.rows: dict[str, CoordinateRow] = {}
        self.none = plain_text(lines=2)
        self.none.setText(
            tr("Available when the positions of the axes are known and a device is connected.")
        )
        self.column.addWidget(self.none)

    def refresh(self, state: TeleoperationState, arbiter: InputArbiter, *, stale: bool) -> None:
        """Show a moment."""
        views = state.coordinates
        if not views:
            same = bool(self._shown) and self._shown[0] == state.mode
            self._fade(same)
            return
        shown = (state.mode, *(view.name for view in views))
        if shown != self._shown:
            self._arrange(state.mode, views)
            self._shown = shown
        for view in views:
            travel_m = arbiter.travel_m(view.name) or arbiter.travel_m(view.source)
            self.rows[view.name].show_view(view, travel_m, stale=stale)

    def _fade(self, same: bool) -> None:
        """Have no coordinates: grey those of the mode, take away those of another."""
        if not same:
            self._clear()
        for row in self.rows.values():
            row.bar.show_value(None)
            set_property(row.position, "stale", True)

    def _arrange(self, mode: str, views: tuple[CoordinateView, ...]) -> None:
        self._clear()
        self.none.hide()
        robot = self._workbench.robot
        for view in views:
            name = wording.coordinate_name(mode, view.name, view.unit)
            scale = wording.coordinate_scale(robot, mode, view.name, view.unit)
            row = CoordinateRow(self._workbench, name, scale, view.source)
            self.rows[view.name] = row
            self.column.addWidget(row)

    def _clear(self) -> None:
        for row in self.rows.values():
            self.column.removeWidget(row)
            row.hide()
            row.deleteLater()
        self.rows, self._shown = {}, ()
        self.none.show()
