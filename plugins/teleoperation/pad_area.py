"""On-screen pad: a cross for x and y, a slider for z, and keys. All spring back."""

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

from rotemina.app.motion.inputs import DEFAULT_DEAD_ZONE
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.workbench import Workbench
from rotemina.plugins.teleoperation import mark, tr
from rotemina.plugins.teleoperation.virtual_stick import PadKey, VirtualStick

#: When its lease expires, the pad releases everything. Renewals are therefore much more frequent.
RENEWAL_INTERVAL_MS = 100
_PAD_KEYS = {
    Qt.Key.Key_Left: PadKey.LEFT,
    Qt.Key.Key_Right: PadKey.RIGHT,
    Qt.Key.Key_Down: PadKey.NEAR,
    Qt.Key.Key_Up: PadKey.AWAY,
    Qt.Key.Key_PageDown: PadKey.LOWER,
    Qt.Key.Key_PageUp: PadKey.RAISE,
    Qt.Key.Key_Space: PadKey.CLUTCH,
}
_COARSE_MODIFIER, _FINE_MODIFIER = (
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
)
_SCALING_KEYS = {Qt.Key.Key_Shift: _COARSE_MODIFIER, Qt.Key.Key_Control: _FINE_MODIFIER}
_FOREIGN_MODIFIERS = Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.MetaModifier
_FOREIGN_KEYS = (Qt.Key.Key_Alt, Qt.Key.Key_AltGr, Qt.Key.Key_Meta)
# After these events Qt may not report the release of a key or button.
_RELEASING_EVENTS = (
    QEvent.Type.WindowDeactivate,
    QEvent.Type.WindowBlocked,
    QEvent.Type.UngrabMouse,
)
# Side of the cross, width of the slider, gap between them, and radius of a knob.
_CROSS_SIDE_PX, _SLIDER_WIDTH_PX, _GAP_PX, _KNOB_RADIUS_PX = 124, 44, 8, 9
_CAPTION_HEIGHT_PX = 18
_TOOLTIP_LINES = (
    mark("Press and drag: the cross moves x and y, the slider z; both spring back when released."),
    mark(
        "Keyboard, when the pad has the focus: arrows x and y, page up and down z, "
        "shift coarse, ctrl fine, space clutch."
    ),
)


class PadArea(QWidget):
    """Area of the pad for pointer and keys. It acts only while it is visible and has the focus."""

    def __init__(self, workbench: Workbench, stick: VirtualStick) -> None:
        super().__init__()
        self._workbench, self._stick = workbench, stick
        self._objection: str | None = None
        self._coordinate_names: Mapping[str, str] = {}
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Pad for x, y and z"))
        self._renewal_timer = QTimer(self, interval=RENEWAL_INTERVAL_MS)
        self._renewal_timer.timeout.connect(self._renew)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the size of cross, slider, frames and captions."""
        return QSize(
            _CROSS_SIDE_PX + _GAP_PX + _SLIDER_WIDTH_PX + 4, _CROSS_SIDE_PX + _CAPTION_HEIGHT_PX + 4
        )

    def show_state(self, objection: str | None, names: Mapping[str, str]) -> None:
        """Enable the pad, or disable it if there is an objection.

        ``names`` are the names of the coordinates that x, y and z of the pad move.
        """
        if (objection, names) != (self._objection, self._coordinate_names):
            self._objection, self._coordinate_names = objection, names
            self.setToolTip(
                make_tooltip(
                    *(tr(line) for line in _TOOLTIP_LINES),
                    tr("Not now: {why_not}").format(why_not=objection) if objection else "",
                )
            )
            self.update()
            if objection is not None:
                self.release()
        if self._stick.busy and not self._is_exposed():
            self.release()

    def release(self) -> None:
        """Release all keys and the pointer."""
        self._renewal_timer.stop()
        self._stick.release_all()
        self.update()

    def event(self, event: QEvent) -> bool:
        """Keep the pad keys from acting as shortcuts. Release all keys when the window is left."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            if event.key() in _PAD_KEYS:
                event.accept()
                return True
        elif event.type() in _RELEASING_EVENTS and self._stick.busy:
            self.release()
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Hold a key. Automatic repetitions are ignored."""
        key = event.key()
        if key in _FOREIGN_KEYS:
            self.release()
        elif key in _SCALING_KEYS:
            self._update_scaling(event.modifiers() | _SCALING_KEYS[key])
        elif key not in _PAD_KEYS or event.modifiers() & _FOREIGN_MODIFIERS:
            super().keyPressEvent(event)
        elif not event.isAutoRepeat():
            self._update_scaling(event.modifiers())
            if self._can_act():
                self._stick.press(_PAD_KEYS[key])
        self._update_renewal()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Release a key."""
        key = event.key()
        if key in _SCALING_KEYS:
            self._update_scaling(event.modifiers() & ~_SCALING_KEYS[key])
        elif key not in _PAD_KEYS:
            super().keyReleaseEvent(event)
        elif not event.isAutoRepeat():
            self._stick.release(_PAD_KEYS[key])
        self._update_renewal()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin to drag the cross or the slider."""
        if event.button() is not Qt.MouseButton.LeftButton:
            return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        self._update_scaling(event.modifiers())
        self._is_cross_pressed = event.position().x() <= _CROSS_SIDE_PX + 0.5 * _GAP_PX
        self._drag(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Continue a drag. If it was released meanwhile, a new press is required."""
        if event.buttons() & Qt.MouseButton.LeftButton and self._stick.dragging:
            self._drag(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """End the drag. Cross and slider spring back."""
        if event.button() is Qt.MouseButton.LeftButton:
            self._stick.release_pointer()
            self._update_renewal()

    def _drag(self, position: QPointF) -> None:
        if not self._can_act():
            return
        half_side = 0.5 * _CROSS_SIDE_PX
        deflections = {
            "x": (position.x() - half_side - 2) / half_side,
            "y": (half_side + 2 - position.y()) / half_side,
        }
        if not self._is_cross_pressed:
            deflections = {"z": deflections["y"]}
        self._stick.drag(
            **{
                axis: 0.0 if abs(deflection) < DEFAULT_DEAD_ZONE else deflection
                for axis, deflection in deflections.items()
            }
        )
        self._update_renewal()

    def focusInEvent(self, event: QFocusEvent) -> None:  # noqa: N802 (Qt's name)
        """Show that the keys act now."""
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:  # noqa: N802 (Qt's name)
        """Release everything when another widget takes the focus."""
        self.release()
        super().focusOutEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """Release everything when the pad is hidden."""
        self.release()
        super().hideEvent(event)

    def _update_scaling(self, modifiers: Qt.KeyboardModifier) -> None:
        self._stick.set_scaling(
            fine=bool(modifiers & _FINE_MODIFIER), coarse=bool(modifiers & _COARSE_MODIFIER)
        )

    def _can_act(self) -> bool:
        return self._objection is None and self.hasFocus() and self._is_exposed()

    def _is_exposed(self) -> bool:
        # Qt considers a dock behind another one visible, so the visible region is checked.
        return not self.visibleRegion().isEmpty()

    def _update_renewal(self) -> None:
        """Renew the lease periodically while the pointer or a key is held, and redraw."""
        if not self._stick.busy:
            self._renewal_timer.stop()
        elif not self._renewal_timer.isActive():
            self._renewal_timer.start()
        self.update()

    def _renew(self) -> None:
        self._stick.renew()
        self._update_renewal()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw cross and slider with captions and knobs."""
        theme = self._workbench.theme
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QPen(QColor(theme.accent if self.hasFocus() else theme.line))
        frame.setWidthF(2.0 if self.hasFocus() else 1.0)
        deflections = self._stick.deflections
        cross = QRectF(2, 2, _CROSS_SIDE_PX, _CROSS_SIDE_PX)
        slider = QRectF(2 + _CROSS_SIDE_PX + _GAP_PX, 2, _SLIDER_WIDTH_PX, _CROSS_SIDE_PX)
        for area in (cross, slider):
            painter.setPen(frame)
            painter.setBrush(QColor(theme.raised))
            painter.drawRoundedRect(area, 4, 4)
            painter.setPen(QColor(theme.line))
            middle = area.center()
            painter.drawLine(QPointF(area.left(), middle.y()), QPointF(area.right(), middle.y()))
            painter.drawLine(QPointF(middle.x(), area.top()), QPointF(middle.x(), area.bottom()))
        self._draw_captions(painter, cross, slider)
        self._draw_knob(painter, cross, deflections["x"], deflections["y"])
        self._draw_knob(painter, slider, 0.0, deflections["z"])
        painter.end()

    def _draw_captions(self, painter: QPainter, cross: QRectF, slider: QRectF) -> None:
        painter.setPen(QColor(self._workbench.theme.quiet))
        x, y, z = (self._coordinate_names.get(axis, axis) for axis in ("x", "y", "z"))
        caption_area = QRectF(
            cross.left(), cross.bottom() + 2, slider.right() - cross.left(), _CAPTION_HEIGHT_PX
        )
        alignment = Qt.AlignmentFlag.AlignVCenter
        painter.drawText(
            caption_area, int(alignment | Qt.AlignmentFlag.AlignLeft), f"→ {x}   ↑ {y}"
        )
        painter.drawText(caption_area, int(alignment | Qt.AlignmentFlag.AlignRight), f"↑ {z}")

    def _draw_knob(self, painter: QPainter, area: QRectF, x: float, y: float) -> None:
        theme = self._workbench.theme
        is_deflected = x != 0.0 or y != 0.0
        painter.setPen(Qt.PenStyle.NoPen)
        colour = theme.quiet if self._objection is not None or not is_deflected else theme.accent
        painter.setBrush(QColor(colour))
        reach = 0.5 * area.height() - _KNOB_RADIUS_PX
        centre = area.center() + QPointF(x * min(reach, 0.5 * area.width() - 2), -y * reach)
        painter.drawEllipse(centre, _KNOB_RADIUS_PX, _KNOB_RADIUS_PX)
