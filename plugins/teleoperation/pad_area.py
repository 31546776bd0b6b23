"""The on-screen pad: a cross for x and y, a slider for z, and keys; all spring back."""

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, QTimer
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QHideEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.motion.teleoperation.axis_calibration import DEAD_ZONE
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import plain_tip
from rotemina.plugins.teleoperation import mark, tr
from rotemina.plugins.teleoperation.virtual_stick import Key, VirtualStick

RENEW_MS = 100  # well within the lease of the pad
_KEYS = {
    Qt.Key.Key_Left: Key.LEFT,
    Qt.Key.Key_Right: Key.RIGHT,
    Qt.Key.Key_Down: Key.NEAR,
    Qt.Key.Key_Up: Key.AWAY,
    Qt.Key.Key_PageDown: Key.LOWER,
    Qt.Key.Key_PageUp: Key.RAISE,
    Qt.Key.Key_Space: Key.CLUTCH,
}
_SHIFT, _CONTROL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
_SCALING = {Qt.Key.Key_Shift: _SHIFT, Qt.Key.Key_Control: _CONTROL}
_FOREIGN = Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.MetaModifier
_FOREIGN_KEYS = (Qt.Key.Key_Alt, Qt.Key.Key_AltGr, Qt.Key.Key_Meta)
# After these nobody can be sure that a release will be told.
_LEFT = (QEvent.Type.WindowDeactivate, QEvent.Type.WindowBlocked, QEvent.Type.UngrabMouse)
_SIDE, _SLIDER, _GAP, _KNOB = 124, 44, 8, 9
_CAPTION = 18
_TIP = (
    mark("Press and drag: the cross moves x and y, the slider z; both spring back when released."),
    mark(
        "Keyboard, when the pad has the focus: arrows x and y, page up and down z, "
        "shift coarse, ctrl fine, space clutch."
    ),
)


class PadArea(QWidget):
    """Where the pointer and the keys of the pad act; only with the focus, and only in sight."""

    def __init__(self, workbench: Workbench, stick: VirtualStick) -> None:
        super().__init__()
        self._workbench, self._stick = workbench, stick
        self._why_not: str | None = None
        self._names: Mapping[str, str] = {}
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Pad for x, y and z"))
        self._renewing = QTimer(self, interval=RENEW_MS)
        self._renewing.timeout.connect(self._renew)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size of cross, slider, frame and captions."""
        return QSize(_SIDE + _GAP + _SLIDER + 4, _SIDE + _CAPTION + 4)

    def show_state(self, why_not: str | None, names: Mapping[str, str]) -> None:
        """Act, or say why not; ``names`` says what x, y and z of the pad move."""
        if (why_not, names) != (self._why_not, self._names):
            self._why_not, self._names = why_not, names
            self.setToolTip(
                plain_tip(
                    *(tr(line) for line in _TIP),
                    tr("Not now: {why_not}").format(why_not=why_not) if why_not else "",
                )
            )
            self.update()
            if why_not is not None:
                self.release()
        if self._stick.busy and not self._in_sight():
            self.release()

    def release(self) -> None:
        """Release everything."""
        self._renewing.stop()
        self._stick.release_all()
        self.update()

    # --- keys -------------------------------------------------------------------------------------

    def event(self, event: QEvent) -> bool:
        """Keep the pad's keys from being shortcuts; let go when the window is left."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            if event.key() in _KEYS:
                event.accept()
                return True
        elif event.type() in _LEFT and self._stick.busy:
            self.release()
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Hold a key; its repetitions are none."""
        key = event.key()
        if key in _FOREIGN_KEYS:
            self.release()
        elif key in _SCALING:
            self._scale(event.modifiers() | _SCALING[key])
        elif key not in _KEYS or event.modifiers() & _FOREIGN:
            super().keyPressEvent(event)
        elif not event.isAutoRepeat():
            self._scale(event.modifiers())
            if self._acts():
                self._stick.press(_KEYS[key])
        self._follow()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Release a key."""
        key = event.key()
        if key in _SCALING:
            self._scale(event.modifiers() & ~_SCALING[key])
        elif key not in _KEYS:
            super().keyReleaseEvent(event)
        elif not event.isAutoRepeat():
            self._stick.release(_KEYS[key])
        self._follow()

    # --- pointer ----------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Take the cross or the slider."""
        if event.button() is not Qt.MouseButton.LeftButton:
            return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        self._scale(event.modifiers())
        self._in_cross = event.position().x() <= _SIDE + 0.5 * _GAP
        self._drag(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Move what was taken; what was released meanwhile has to be taken again."""
        if event.buttons() & Qt.MouseButton.LeftButton and self._stick.dragging:
            self._drag(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Spring back."""
        if event.button() is Qt.MouseButton.LeftButton:
            self._stick.drop()
            self._follow()

    def _drag(self, place: QPointF) -> None:
        if not self._acts():
            return
        half = 0.5 * _SIDE
        ways = {"x": (place.x() - half - 2) / half, "y": (half + 2 - place.y()) / half}
        if not self._in_cross:
            ways = {"z": ways["y"]}
        self._stick.drag(
            **{axis: 0.0 if abs(way) < DEAD_ZONE else way for axis, way in ways.items()}
        )
        self._follow()

    # --- letting go -------------------------------------------------------------------------------

    def focusInEvent(self, event: QFocusEvent) -> None:  # noqa: N802 (Qt's name)
        """Show that keys act now."""
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:  # noqa: N802 (Qt's name)
        """Release everything, whatever took the focus."""
        self.release()
        super().focusOutEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """Release everything."""
        self.release()
        super().hideEvent(event)

    def _scale(self, modifiers: Qt.KeyboardModifier) -> None:
        self._stick.modify(fine=bool(modifiers & _CONTROL), coarse=bool(modifiers & _SHIFT))

    def _acts(self) -> bool:
        return self._why_not is None and self.hasFocus() and self._in_sight()

    def _in_sight(self) -> bool:
        # A dock behind another one is not hidden for Qt, only moved away.
        return not self.visibleRegion().isEmpty()

    def _follow(self) -> None:
        """Say from time to time that what is held still is, and draw it."""
        if not self._stick.busy:
            self._renewing.stop()
        elif not self._renewing.isActive():
            self._renewing.start()
        self.update()

    def _renew(self) -> None:
        self._stick.renew()
        self._follow()

    # --- picture ----------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the cross and the slider with their knobs."""
        theme = self._workbench.theme
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QPen(QColor(theme.accent if self.hasFocus() else theme.line))
        frame.setWidthF(2.0 if self.hasFocus() else 1.0)
        found = self._stick.deflections
        cross = QRectF(2, 2, _SIDE, _SIDE)
        slider = QRectF(2 + _SIDE + _GAP, 2, _SLIDER, _SIDE)
        for area in (cross, slider):
            painter.setPen(frame)
            painter.setBrush(QColor(theme.raised))
            painter.drawRoundedRect(area, 4, 4)
            painter.setPen(QColor(theme.line))
            middle = area.center()
            painter.drawLine(QPointF(area.left(), middle.y()), QPointF(area.right(), middle.y()))
            painter.drawLine(QPointF(middle.x(), area.top()), QPointF(middle.x(), area.bottom()))
        self._name(painter, cross, slider)
        self._knob(painter, cross, found["x"], found["y"])
        self._knob(painter, slider, 0.0, found["z"])
        painter.end()

    def _name(self, painter: QPainter, cross: QRectF, slider: QRectF) -> None:
        """Write under cross and slider what they move."""
        painter.setPen(QColor(self._workbench.theme.quiet))
        x, y, z = (self._names.get(axis, axis) for axis in ("x", "y", "z"))
        below = QRectF(cross.left(), cross.bottom() + 2, slider.right() - cross.left(), _CAPTION)
        middle = Qt.AlignmentFlag.AlignVCenter
        painter.drawText(below, int(middle | Qt.AlignmentFlag.AlignLeft), f"→ {x}   ↑ {y}")
        painter.drawText(below, int(middle | Qt.AlignmentFlag.AlignRight), f"↑ {z}")

    def _knob(self, painter: QPainter, area: QRectF, x: float, y: float) -> None:
        theme = self._workbench.theme
        held = x != 0.0 or y != 0.0
        painter.setPen(Qt.PenStyle.NoPen)
        colour = theme.quiet if self._why_not is not None or not held else theme.accent
        painter.setBrush(QColor(colour))
        reach = 0.5 * area.height() - _KNOB
        at = area.center() + QPointF(x * min(reach, 0.5 * area.width() - 2), -y * reach)
        painter.drawEllipse(at, _KNOB, _KNOB)
