"""Drawings of a device's readings: axis bars, button lamps, a response curve."""

from PySide6.QtCore import QEvent, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QHelpEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from rotemina.app.motion.teleoperation.axis_calibration import AxisCalibration
from rotemina.app.shell.theme import Theme
from rotemina.app.widgets.controls import plain_tip
from rotemina.plugins.inputs import tr
from rotemina.plugins.inputs.words import control_name

_BAR_HEIGHT = 18
_LAMP_HEIGHT, _LAMP_GAP = 20, 4
_CURVE_HEIGHT = 96


class AxisBar(QWidget):
    """One axis from −1 to 1: reading (thin) and deflection (thick)."""

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        self._theme = theme
        self._raw: float | None = None
        self._deflection = 0.0
        self._trusted = False
        self._calibration = AxisCalibration()
        self.setFixedHeight(_BAR_HEIGHT)
        self.setMinimumWidth(60)
        self.setAccessibleName(tr("Axis {name}").format(name=name))
        self.setToolTip(
            plain_tip(
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
        self, raw: float | None, deflection: float, trusted: bool, calibration: AxisCalibration
    ) -> None:
        """Show reading and deflection of an axis."""
        shown = (raw, deflection, trusted, calibration)
        if shown != (self._raw, self._deflection, self._trusted, self._calibration):
            self._raw, self._deflection, self._trusted, self._calibration = shown
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw both bars from the middle."""
        theme, painter = self._theme, QPainter(self)
        frame = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.setPen(QColor(theme.line))
        painter.setBrush(QColor(theme.raised))
        painter.drawRoundedRect(frame, 3, 3)
        painter.setPen(Qt.PenStyle.NoPen)
        one = self._calibration
        painter.setBrush(QColor(theme.line))
        painter.drawRect(self._span(one.centre - one.dead_zone, one.centre + one.dead_zone, 2, 5))
        if self._raw is not None:
            painter.setBrush(QColor(theme.quiet))
            painter.drawRect(self._span(one.centre, self._raw, 2, 5))
        colour = theme.accent if self._trusted else theme.command
        pattern = Qt.BrushStyle.SolidPattern if self._trusted else Qt.BrushStyle.BDiagPattern
        painter.setBrush(QColor(colour))
        brush = painter.brush()
        brush.setStyle(pattern)
        painter.setBrush(brush)
        painter.drawRect(self._span(0.0, self._deflection, 8, 8))
        painter.setPen(QColor(theme.text))
        middle = self._place(0.0)
        painter.drawLine(QPointF(middle, 1.5), QPointF(middle, self.height() - 1.5))
        painter.end()

    def _place(self, share: float) -> float:
        room = self.width() - 4.0
        return 2.0 + 0.5 * room * (1.0 + min(max(share, -1.0), 1.0))

    def _span(self, start: float, end: float, top: float, height: float) -> QRectF:
        left, right = sorted((self._place(start), self._place(end)))
        return QRectF(left, top, right - left, height)


class Lamps(QWidget):
    """The buttons of a device, lit while they are down."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._names: tuple[str, ...] = ()
        self._lit: frozenset[str] = frozenset()
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setAccessibleName(tr("Buttons"))

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.update()

    def show_buttons(self, names: tuple[str, ...], lit: frozenset[str]) -> None:
        """Show which buttons there are, and which are down."""
        if names != self._names:
            self._names = names
            self.updateGeometry()
        if lit != self._lit:
            self._lit = lit
            held = ", ".join(control_name(name) for name in names if name in lit)
            self.setAccessibleDescription(tr("Pressed: {held}").format(held=held or tr("none")))
        self.update()

    def heightForWidth(self, width: int) -> int:  # noqa: N802 (Qt's name)
        """Return what the rows of lamps need."""
        places = self._places(width)
        return max((place.bottom() + 1 for place in places), default=0)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return a size for the present width."""
        width = max(self.width(), 200)
        return QSize(width, self.heightForWidth(width))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for one lamp's width."""
        return QSize(60, self.heightForWidth(max(self.width(), 60)))

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw a lamp for each button."""
        theme, painter = self._theme, QPainter(self)
        for name, place in zip(self._names, self._places(self.width()), strict=True):
            lit = name in self._lit
            painter.setPen(QColor(theme.accent if lit else theme.line))
            painter.setBrush(QColor(theme.accent if lit else theme.raised))
            painter.drawRoundedRect(QRectF(place).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
            painter.setPen(QColor(theme.on_accent if lit else theme.quiet))
            painter.drawText(place, int(Qt.AlignmentFlag.AlignCenter), _short(name))
        painter.end()

    def event(self, event: QEvent) -> bool:
        """Show the name of the lamp under the mouse."""
        if event.type() is QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            for name, place in zip(self._names, self._places(self.width()), strict=True):
                if place.contains(event.pos()):
                    QToolTip.showText(event.globalPos(), plain_tip(name), self)
                    return True
            QToolTip.hideText()
            return True
        return super().event(event)

    def _places(self, width: int) -> list[QRect]:
        places, left, top = [], 0, 0
        for name in self._names:
            wide = max(self.fontMetrics().horizontalAdvance(_short(name)) + 12, 24)
            wide = min(wide, width)
            if left and left + wide > width:
                left, top = 0, top + _LAMP_HEIGHT + _LAMP_GAP
            places.append(QRect(left, top, wide, _LAMP_HEIGHT))
            left += wide + _LAMP_GAP
        return places


class Curve(QWidget):
    """The response curve from reading to deflection, both −1 to 1, with the present point."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._calibration = AxisCalibration()
        self._raw: float | None = None
        self.setFixedHeight(_CURVE_HEIGHT)
        self.setAccessibleName(tr("Response curve"))
        self.setToolTip(
            tr("Horizontal: raw value of the device; vertical: the resulting deflection")
        )

    def set_theme(self, theme: Theme) -> None:
        """Change the colours."""
        self._theme = theme
        self.update()

    def show_curve(self, calibration: AxisCalibration, raw: float | None) -> None:
        """Show the curve of an axis, and a dot at what it says now."""
        if (calibration, raw) != (self._calibration, self._raw):
            self._calibration, self._raw = calibration, raw
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw frame, axes, curve and dot."""
        theme, painter = self._theme, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QColor(theme.line))
        painter.setBrush(QColor(theme.raised))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 3, 3)
        painter.drawLine(self._point(-1.0, 0.0), self._point(1.0, 0.0))
        painter.drawLine(self._point(0.0, -1.0), self._point(0.0, 1.0))
        steps = max(self.width(), 2)
        raws = [-1.0 + 2.0 * step / (steps - 1) for step in range(steps)]
        line = [self._point(raw, self._calibration.deflection(raw)) for raw in raws]
        painter.setPen(QPen(QColor(theme.accent), 2.0))
        painter.drawPolyline(QPolygonF(line))
        if self._raw is not None and abs(self._raw) <= 1.0:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(theme.real))
            dot = self._point(self._raw, self._calibration.deflection(self._raw))
            painter.drawEllipse(dot, 4.0, 4.0)
        painter.end()

    def _point(self, raw: float, deflection: float) -> QPointF:
        wide, high = self.width() - 14.0, self.height() - 14.0
        return QPointF(7.0 + 0.5 * wide * (1.0 + raw), 7.0 + 0.5 * high * (1.0 - deflection))


def _short(name: str) -> str:
    """Return a button's name without what all of them begin with."""
    return control_name(name).removeprefix("Button ").replace("_", " ")
