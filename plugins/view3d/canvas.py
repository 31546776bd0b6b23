"""Canvas that draws the robot without a GPU: drag to rotate, turn the wheel to zoom."""

import time
from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, Qt, QTimer
from PySide6.QtGui import (
    QBrush,
    QColor,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPolygonF,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.scene import ProjectedPicture, ProjectedSolid, SceneCamera, SceneCommandStore
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.style import Theme
from rotemina.plugins.view3d import tr

_MIN_FRAME_INTERVAL_S = 0.04
# The picture is not drawn again if no corner has moved farther than this.
_MIN_VISIBLE_MOTION_PX = 0.2
_ROTATION_RAD_PER_PX = 0.008
# Zoom factor of one notch of the wheel.
_WHEEL_FACTOR = 1.2
_SHADE_COUNT = 24
# Brightness of the edges of a solid, relative to its colour.
_EDGE_BRIGHTNESS = 0.35
_MARGIN_PX = 8


class SceneCanvas(QWidget):
    """Canvas for a scene, drawn only while visible and at most 25 times a second."""

    def __init__(self, scene: SceneCommandStore, theme: Theme) -> None:
        super().__init__()
        self.picture = ProjectedPicture()
        self.paint_count = 0
        self._scene, self._theme = scene, theme
        self._revision = 0
        self._projection_key: tuple[int, SceneCamera | None, QSize] | None = None
        self._newest_parts: list[ProjectedSolid] = []
        self._painted_parts: list[ProjectedSolid] = []
        self._drag_point: QPointF | None = None
        self._last_paint_s = 0.0
        self._brushes: dict[tuple[str, int, float], QBrush] = {}
        self._redraw_timer = QTimer(self, singleShot=True, timerType=Qt.TimerType.PreciseTimer)
        self._redraw_timer.timeout.connect(self.update)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(200, 120)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAccessibleName(tr("The robot in three dimensions"))
        self.setToolTip(
            make_tooltip(
                tr(
                    "Drag to rotate, drag with the right button to shift, use the wheel to zoom, "
                    "double-click to reset."
                )
            )
        )

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Return the preferred size."""
        return QSize(480, 300)

    @property
    def is_in_sight(self) -> bool:
        """Whether any part can be seen. Qt considers even a dock behind another one visible."""
        return self.isVisible() and not self.visibleRegion().isEmpty()

    def set_theme(self, theme: Theme) -> None:
        """Use the text colours of a theme. The colours of the solids are part of the scene."""
        self._theme = theme
        self.redraw()

    def redraw_if_changed(self) -> None:
        """Draw again if the picture has changed visibly and the canvas can be seen."""
        if not self.is_in_sight:
            return
        previous_parts, previous_state = (
            self._painted_parts,
            (self.picture.note, self.picture.camera),
        )
        newest_parts = self._update_newest_parts()
        if previous_state != (self.picture.note, self.picture.camera) or _has_visibly_moved(
            previous_parts, newest_parts
        ):
            self.redraw()

    def redraw(self) -> None:
        """Draw now, or as soon as the minimum interval has passed."""
        if self._redraw_timer.isActive():
            return
        wait_s = self._last_paint_s + _MIN_FRAME_INTERVAL_S - time.monotonic()
        if wait_s <= 0:
            self.update()
        else:
            self._redraw_timer.start(round(1e3 * wait_s) + 1)

    def _update_newest_parts(self) -> list[ProjectedSolid]:
        """Return the parts to paint. Project them again if scene, camera or size have changed."""
        scene_changes = self._scene.get_changes(self._revision)
        for command in scene_changes.commands:
            self.picture.apply_command(command)
        self._revision = scene_changes.revision
        key = (self._revision, self.picture.camera, self.size())
        if key != self._projection_key:
            self._projection_key = key
            self._newest_parts = self.picture.project_solids(self.width(), self.height())
        return self._newest_parts

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Begin to drag the picture."""
        self._drag_point = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Rotate the picture, or shift it with the right button."""
        if self._drag_point is None:
            return
        offset, self._drag_point = event.position() - self._drag_point, event.position()
        if event.buttons() & Qt.MouseButton.RightButton:
            self._change_camera(lambda camera: camera.pan(-offset.x(), offset.y(), self.height()))
        else:
            right, up = -_ROTATION_RAD_PER_PX * offset.x(), _ROTATION_RAD_PER_PX * offset.y()
            self._change_camera(lambda camera: camera.orbit(right, up))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """End the drag."""
        self._drag_point = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's name)
        """Return to the view of the button that was pressed last."""
        self.picture.camera = self.picture.home_camera
        self.redraw()

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 (Qt's name)
        """Zoom."""
        factor = _WHEEL_FACTOR ** (event.angleDelta().y() / 120)
        self._change_camera(lambda camera: camera.zoom(factor))

    def _change_camera(self, change: Callable[[SceneCamera], SceneCamera]) -> None:
        if self.picture.camera is not None:
            self.picture.camera = change(self.picture.camera)
            self.redraw()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the newest picture of the scene."""
        self._painted_parts = self._update_newest_parts()
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor.fromRgbF(*self.picture.background))
        for part in self._painted_parts:
            self._paint_part(painter, part)
        self._draw_texts(painter)
        painter.end()
        self.paint_count += 1
        self._last_paint_s = time.monotonic()

    def _paint_part(self, painter: QPainter, part: ProjectedSolid) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        # Antialiasing would make seams visible between the faces.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        faces = [QPolygonF([QPointF(x, y) for x, y in face]) for face in part.faces]
        if part.is_veil:
            # One path for all faces is faster.
            path = QPainterPath()
            for face in faces:
                path.addPolygon(face)
            painter.fillPath(path, self._find_brush(part.colour, 0.8, 0.5 * part.opacity))
        else:
            for face, shade in zip(faces, part.shades, strict=True):
                painter.setBrush(self._find_brush(part.colour, shade, 1.0))
                painter.drawConvexPolygon(face)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        edge_brush = self._find_brush(
            part.colour, 1.0 if part.is_veil else _EDGE_BRIGHTNESS, 0.8 if part.is_veil else 1.0
        )
        painter.setPen(QPen(edge_brush, 1.0))
        painter.drawLines([QLineF(*line) for line in part.lines.tolist()])

    def _find_brush(self, colour: str, shade: float, opacity: float) -> QBrush:
        colour_key = f"grey {colour}" if self.picture.note["old"] else colour
        key = (colour_key, round(_SHADE_COUNT * shade), opacity)
        if key not in self._brushes:
            full_colour = QColor(colour)
            red, green, blue = full_colour.redF(), full_colour.greenF(), full_colour.blueF()
            if self.picture.note["old"]:
                red = green = blue = 0.3 * red + 0.59 * green + 0.11 * blue
            brightness = key[1] / _SHADE_COUNT
            self._brushes[key] = QBrush(
                QColor.fromRgbF(brightness * red, brightness * green, brightness * blue, opacity)
            )
        return self._brushes[key]

    def _draw_texts(self, painter: QPainter) -> None:
        note, line_height = self.picture.note, painter.fontMetrics().lineSpacing()
        y = float(_MARGIN_PX)
        for ghost in note["shown"]:
            painter.setPen(QColor(note["colours"][ghost]))
            painter.drawText(QPointF(_MARGIN_PX, y + painter.fontMetrics().ascent()), "■")
            painter.setPen(QColor(self._theme.text))
            left = _MARGIN_PX + painter.fontMetrics().horizontalAdvance("■ ")
            text = note["words"][ghost]
            painter.drawText(QPointF(left, y + painter.fontMetrics().ascent()), text)
            y += line_height
        text_area = QRectF(self.rect()).adjusted(_MARGIN_PX, y + 4, -_MARGIN_PX, -_MARGIN_PX)
        painter.setPen(QColor(self._theme.warning))
        flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap
        painter.drawText(text_area, int(flags), "\n".join(note["warnings"]))


def _has_visibly_moved(
    previous_parts: list[ProjectedSolid], newest_parts: list[ProjectedSolid]
) -> bool:
    if len(previous_parts) != len(newest_parts):
        return True
    for previous, newest in zip(previous_parts, newest_parts, strict=True):
        if (previous.path, previous.colour, previous.lines.shape) != (
            newest.path,
            newest.colour,
            newest.lines.shape,
        ):
            return True
        if (
            len(previous.lines)
            and np.abs(previous.lines - newest.lines).max() > _MIN_VISIBLE_MOTION_PX
        ):
            return True
    return False
