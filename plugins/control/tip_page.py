"""The keep-out of the tip: its position, its bounds, and the distance to the floor."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.control import tr
from rotemina.plugins.control.wording import above_floor, bounds_text, tip_text
from rotemina.sim.kinematics.keep_out import SLOW_HEIGHT
from rotemina.sim.quantities import fixed

_TOP = 4.0 * SLOW_HEIGHT  # what the gauge shows above the floor


class HeightGauge(QWidget):
    """The tip above its floor, upright; the slow zone is hatched."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self._above: float | None = None
        self.setFixedWidth(46)
        self.setMinimumHeight(80)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(tr("Height of the tip above its floor"))
        self.setToolTip(tr("0 to 2 mm above the floor; hatched: the slow zone"))

    def show_height(self, above: float | None) -> None:
        """Show another height, m; None: it is not known."""
        if above != self._above:
            self._above = above
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw floor, slow zone and tip."""
        theme = self._workbench.theme
        painter = QPainter(self)
        width, height = self.width(), self.height()
        floor = height - 5
        painter.fillRect(QRectF(0, 0, width, height), QColor(theme.raised))
        if self._above is not None:
            slow = (floor - 6) * SLOW_HEIGHT / _TOP
            hatch = QBrush(QColor(theme.warning), Qt.BrushStyle.BDiagPattern)
            painter.fillRect(QRectF(0, floor - slow, width, slow), hatch)
            share = min(max(self._above / _TOP, 0.0), 1.0)
            at = floor - (floor - 6) * share
            near = self._above < SLOW_HEIGHT
            painter.fillRect(
                QRectF(width / 2 - 2, 0, 4, at), QColor(theme.warning if near else theme.real)
            )
            painter.fillRect(QRectF(width / 2 - 9, at - 1, 18, 3), QColor(theme.text))
            painter.fillRect(QRectF(0, floor, width, 5), QColor(theme.quiet))
        painter.end()


class TipPage(QWidget):
    """Gauge and words."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.gauge = HeightGauge(workbench)
        self.height_text, self.place, self.bounds = (plain_text(lines=n) for n in (2, 2, 3))
        column = in_column(self.height_text, self.place, self.bounds, 1, spacing=4)
        in_row(self.gauge, (column, 1), on=self, margins=(10, 6, 10, 4), spacing=10)

    def refresh(self, state: SessionState) -> None:
        """Show a moment of the machine."""
        zone = self._workbench.session.bounds.keep_out
        self.gauge.show_height(above_floor(state, zone))
        tip = state.tip if state.position_known else None
        place = "" if tip is None else " · ".join(fixed(1e3 * at, 4) for at in tip)
        texts = (
            (self.height_text, tip_text(state, zone)),
            (self.place, tr("x, y, z [mm]: {place}").format(place=place) if place else ""),
            (self.bounds, bounds_text(zone)),
        )
        for text_shown, text in texts:
            if text != text_shown.text():
                text_shown.setText(text)
