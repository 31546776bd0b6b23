"""Page with the position of the tip, its limits, and its height above the floor."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.plugins.control import tr
from rotemina.plugins.control.wording import (
    compute_height_above_floor,
    describe_bounds,
    describe_tip,
)
from rotemina.sim.kinematics import SLOW_ZONE_HEIGHT_M
from rotemina.sim.messages import format_fixed

# The height above the floor at the upper end of the gauge.
_GAUGE_RANGE_M = 4.0 * SLOW_ZONE_HEIGHT_M


class HeightGauge(QWidget):
    """Vertical gauge of the height of the tip above the floor. The slow zone is hatched."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self._height_above_floor: float | None = None
        self.setFixedWidth(46)
        self.setMinimumHeight(80)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(tr("Height of the tip above its floor"))
        self.setToolTip(tr("0 to 2 mm above the floor; hatched: the slow zone"))

    def show_height(self, height_above_floor: float | None) -> None:
        """Show a height above the floor, m, or None if it is unknown."""
        if height_above_floor != self._height_above_floor:
            self._height_above_floor = height_above_floor
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the floor, the slow zone and the tip."""
        theme = self._workbench.theme
        painter = QPainter(self)
        width, height = self.width(), self.height()
        floor_y = height - 5
        painter.fillRect(QRectF(0, 0, width, height), QColor(theme.raised))
        if self._height_above_floor is not None:
            slow_zone_height = (floor_y - 6) * SLOW_ZONE_HEIGHT_M / _GAUGE_RANGE_M
            hatch = QBrush(QColor(theme.warning), Qt.BrushStyle.BDiagPattern)
            painter.fillRect(QRectF(0, floor_y - slow_zone_height, width, slow_zone_height), hatch)
            fraction = min(max(self._height_above_floor / _GAUGE_RANGE_M, 0.0), 1.0)
            tip_y = floor_y - (floor_y - 6) * fraction
            is_slow = self._height_above_floor < SLOW_ZONE_HEIGHT_M
            painter.fillRect(
                QRectF(width / 2 - 2, 0, 4, tip_y), QColor(theme.warning if is_slow else theme.real)
            )
            painter.fillRect(QRectF(width / 2 - 9, tip_y - 1, 18, 3), QColor(theme.text))
            painter.fillRect(QRectF(0, floor_y, width, 5), QColor(theme.quiet))
        painter.end()


class TipPage(QWidget):
    """Page with the gauge, the position and the limits of the tip."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.gauge = HeightGauge(workbench)
        self.height_text, self.place, self.bounds = (make_plain_label(lines=n) for n in (2, 2, 3))
        column = make_column(self.height_text, self.place, self.bounds, 1, spacing=4)
        make_row(self.gauge, (column, 1), on=self, margins=(10, 6, 10, 4), spacing=10)

    def refresh(self, state: SessionState) -> None:
        """Show the tip in this state."""
        zone = self._workbench.session.bounds.keep_out
        self.gauge.show_height(compute_height_above_floor(state, zone))
        tip = state.tip if state.position_known else None
        place = (
            ""
            if tip is None
            else " · ".join(format_fixed(1e3 * coordinate, 4) for coordinate in tip)
        )
        texts = (
            (self.height_text, describe_tip(state, zone)),
            (self.place, tr("x, y, z [mm]: {place}").format(place=place) if place else ""),
            (self.bounds, describe_bounds(zone)),
        )
        for text_label, text in texts:
            if text != text_label.text():
                text_label.setText(text)
