"""Widgets that draw the readings of a device: axis bars, button lamps and a response curve."""

from PySide6.QtCore import QEvent, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QHelpEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from rotemina.app.motion.inputs import InputAxisCalibration
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.style import Theme
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.words import format_control_name

_BAR_HEIGHT_PX = 18
_LAMP_HEIGHT_PX, _LAMP_GAP_PX = 20, 4
_CURVE_HEIGHT_PX = 96


class AxisBar(QWidget):
    """Bars of one axis from −1 to 1, thin for the raw reading and thick for the deflection."""

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        self._theme = theme
        self._raw: float | None = None
        self._deflection = 0.0
        self._trusted = False
        self._calibration = InputAxisCalibration()
        self.setFixedHeight(_BAR_HEIGHT_PX)
        self.setMinimumWidth(60)
        self.setAccessibleName(tr("Axis {name}").format(name=name))
        self.setToolTip(
            make_tooltip(
                tr(
                    "{name}: raw value of the device (thin) and calibrated deflection (thick), "
                    "−100 % to 100 %; the dead zone is shaded"
                ).format(name=name)
            )
        )

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.update()

    def show_axis(
        self, raw: float | None, deflection: float, trusted: bool, calibration: InputAxisCalibration
    ) -> None:
        """Show the raw reading and the deflection of an axis, both −1 to 1.

        The deflection is hatched unless it is ``trusted``.
        """
        new_values = (raw, deflection, trusted, calibration)
        if new_values != (self._raw, self._deflection, self._trusted, self._calibration):
            self._raw, self._deflection, self._trusted, self._calibration = new_values
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the dead zone and both bars."""
        theme, painter = self._theme, QPainter(self)
        frame = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.setPen(QColor(theme.line))
        painter.setBrush(QColor(theme.raised))
        painter.drawRoundedRect(frame, 3, 3)
        painter.setPen(Qt.PenStyle.NoPen)
        axis = self._calibration
        painter.setBrush(QColor(theme.line))
        painter.drawRect(
            self._make_bar(axis.centre - axis.dead_zone, axis.centre + axis.dead_zone, 2, 5)
        )
        if self._raw is not None:
            painter.setBrush(QColor(theme.quiet))
            painter.drawRect(self._make_bar(axis.centre, self._raw, 2, 5))
        colour = theme.accent if self._trusted else theme.command
        pattern = Qt.BrushStyle.SolidPattern if self._trusted else Qt.BrushStyle.BDiagPattern
        painter.setBrush(QColor(colour))
        brush = painter.brush()
        brush.setStyle(pattern)
        painter.setBrush(brush)
        painter.drawRect(self._make_bar(0.0, self._deflection, 8, 8))
        painter.setPen(QColor(theme.text))
        zero_x = self._to_x(0.0)
        painter.drawLine(QPointF(zero_x, 1.5), QPointF(zero_x, self.height() - 1.5))
        painter.end()

    def _to_x(self, deflection: float) -> float:
        inner_width = self.width() - 4.0
        return 2.0 + 0.5 * inner_width * (1.0 + min(max(deflection, -1.0), 1.0))

    def _make_bar(self, start: float, end: float, top: float, height: float) -> QRectF:
        left, right = sorted((self._to_x(start), self._to_x(end)))
        return QRectF(left, top, right - left, height)


class ButtonLamps(QWidget):
    """Lamps for the buttons of a device, lit while the buttons are pressed."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._names: tuple[str, ...] = ()
        self._pressed: frozenset[str] = frozenset()
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setAccessibleName(tr("Buttons"))

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.update()

    def show_buttons(self, names: tuple[str, ...], pressed: frozenset[str]) -> None:
        """Show a lamp for each button, and light the lamps of the pressed buttons."""
        if names != self._names:
            self._names = names
            self.updateGeometry()
        if pressed != self._pressed:
            self._pressed = pressed
            pressed_names = ", ".join(
                format_control_name(name) for name in names if name in pressed
            )
            self.setAccessibleDescription(
                tr("Pressed: {held}").format(held=pressed_names or tr("none"))
            )
        self.update()

    def heightForWidth(self, width: int) -> int:  # noqa: N802 (Qt's name)
        """Return the height of the rows of lamps at a width, both in pixels."""
        lamp_rects = self._compute_lamp_rects(width)
        return max((rect.bottom() + 1 for rect in lamp_rects), default=0)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size at the current width."""
        width = max(self.width(), 200)
        return QSize(width, self.heightForWidth(width))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the width of one lamp, and the height at the current width."""
        return QSize(60, self.heightForWidth(max(self.width(), 60)))

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw a lamp for each button."""
        theme, painter = self._theme, QPainter(self)
        for name, rect in zip(self._names, self._compute_lamp_rects(self.width()), strict=True):
            is_lit = name in self._pressed
            painter.setPen(QColor(theme.accent if is_lit else theme.line))
            painter.setBrush(QColor(theme.accent if is_lit else theme.raised))
            painter.drawRoundedRect(QRectF(rect).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
            painter.setPen(QColor(theme.on_accent if is_lit else theme.quiet))
            painter.drawText(rect, int(Qt.AlignmentFlag.AlignCenter), _shorten_name(name))
        painter.end()

    def event(self, event: QEvent) -> bool:
        """Show the name of the button whose lamp is under the mouse."""
        if event.type() is QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            for name, rect in zip(self._names, self._compute_lamp_rects(self.width()), strict=True):
                if rect.contains(event.pos()):
                    QToolTip.showText(event.globalPos(), make_tooltip(name), self)
                    return True
            QToolTip.hideText()
            return True
        return super().event(event)

    def _compute_lamp_rects(self, width: int) -> list[QRect]:
        rects, left, top = [], 0, 0
        for name in self._names:
            lamp_width = max(self.fontMetrics().horizontalAdvance(_shorten_name(name)) + 12, 24)
            lamp_width = min(lamp_width, width)
            if left and left + lamp_width > width:
                left, top = 0, top + _LAMP_HEIGHT_PX + _LAMP_GAP_PX
            rects.append(QRect(left, top, lamp_width, _LAMP_HEIGHT_PX))
            left += lamp_width + _LAMP_GAP_PX
        return rects


class ResponseCurveView(QWidget):
    """Plot of the response curve: deflection against raw reading, both −1 to 1."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._calibration = InputAxisCalibration()
        self._raw: float | None = None
        self.setFixedHeight(_CURVE_HEIGHT_PX)
        self.setAccessibleName(tr("Response curve"))
        self.setToolTip(
            tr("Horizontal: raw value of the device; vertical: the resulting deflection")
        )

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.update()

    def show_curve(self, calibration: InputAxisCalibration, raw: float | None) -> None:
        """Show the curve of an axis, and a dot at its current reading."""
        if (calibration, raw) != (self._calibration, self._raw):
            self._calibration, self._raw = calibration, raw
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the frame, the axes, the curve and the dot."""
        theme, painter = self._theme, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QColor(theme.line))
        painter.setBrush(QColor(theme.raised))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 3, 3)
        painter.drawLine(self._to_point(-1.0, 0.0), self._to_point(1.0, 0.0))
        painter.drawLine(self._to_point(0.0, -1.0), self._to_point(0.0, 1.0))
        point_count = max(self.width(), 2)
        raw_values = [-1.0 + 2.0 * index / (point_count - 1) for index in range(point_count)]
        points = [
            self._to_point(raw, self._calibration.compute_deflection(raw)) for raw in raw_values
        ]
        painter.setPen(QPen(QColor(theme.accent), 2.0))
        painter.drawPolyline(QPolygonF(points))
        if self._raw is not None and abs(self._raw) <= 1.0:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(theme.real))
            dot = self._to_point(self._raw, self._calibration.compute_deflection(self._raw))
            painter.drawEllipse(dot, 4.0, 4.0)
        painter.end()

    def _to_point(self, raw: float, deflection: float) -> QPointF:
        width, height = self.width() - 14.0, self.height() - 14.0
        return QPointF(7.0 + 0.5 * width * (1.0 + raw), 7.0 + 0.5 * height * (1.0 - deflection))


def _shorten_name(name: str) -> str:
    return format_control_name(name).removeprefix("Button ").replace("_", " ")
