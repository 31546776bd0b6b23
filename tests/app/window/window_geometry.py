"""Checks of a window's geometry: stop buttons visible, no part cut, no overlaps."""

from itertools import combinations

from PySide6.QtCore import QPoint, QRect
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QApplication, QPushButton, QToolButton

from rotemina.app.widgets.text.fitted_text import fit_font

SMALLEST_SIZE = (1024, 720)
LONG_STATE_TEXT = (
    "Die Verbindung zu beiden Platinen ist seit 12 s unterbrochen; die Position ist unbekannt"
)


def settle():
    for _ in range(6):
        QApplication.processEvents()


def get_rectangle(widget, window):
    return QRect(widget.mapTo(window, QPoint()), widget.size())


def show_everything(window):
    """Show all optional parts with long texts, and stop updates of the header."""
    bar = window._bar
    window.workbench.refreshed.disconnect(window._refresh)
    window.replay_bar.show()
    window.first_steps.show()
    bar.row.set_chip_wanted(bar.recording, wanted=True)
    bar.recording.setText("● 12:34:56  123.4 GB")
    bar.model._name = "Corrected: cross coupling, backlash and hysteresis +3"
    bar.model._fit()
    bar.phase.setText("Verbindung verloren")
    bar.reason_label.show_text(LONG_STATE_TEXT)
    bar.remedy_button.setText("Neu verbinden")
    bar.remedy_button.show()
    window.progress_line.show()


def find_geometry_faults(window):
    """Return all faults in the layout of a window."""
    return [*_find_stop_faults(window), *_find_header_faults(window), *_find_part_faults(window)]


def _find_stop_faults(window):
    stop, lock = window.stop_button, window.emergency_button
    for button in (stop, lock):
        rectangle = get_rectangle(button, window)
        if not window.rect().contains(rectangle) or not button.isVisible():
            yield f"{button.text()!r} is not in the window: {rectangle}"
        corners = (
            rectangle.topLeft(),
            rectangle.topRight(),
            rectangle.bottomLeft(),
            rectangle.bottomRight(),
            rectangle.center(),
        )
        if any(window.childAt(corner) is not button for corner in corners):
            yield f"{button.text()!r} is covered"
    if abs(lock.width() - 2 * stop.width() / 3) > 1:
        yield f"stop {stop.width()} and lock {lock.width()}"
    for other in window.findChildren(QPushButton) + window.findChildren(QToolButton):
        visible_size = other.visibleRegion().boundingRect().size()
        if (
            other is not stop
            and visible_size.width() * visible_size.height() >= stop.width() * stop.height()
        ):
            yield f"{other.text()!r} is larger than stop: {other.size()}"


def _find_header_faults(window):
    bar = window._bar
    chips = (bar.owner, bar.model, bar.recording, bar.events, bar.row.overflow_button)
    parts = [bar.badge, bar.state, *chips, bar.emergency, bar.stop]
    parts = [part for part in parts if part.isVisible()]
    for part in parts:
        if not bar.row.rect().contains(part.geometry()):
            yield f"{type(part).__name__} is cut: {part.geometry()} in {bar.row.rect()}"
        if part in chips and part.width() < part.minimumSizeHint().width():
            yield f"{type(part).__name__} is too narrow: {part.width()}"
    for first, second in combinations(parts, 2):
        if first.geometry().intersects(second.geometry()):
            yield f"{type(first).__name__} on {type(second).__name__}"
    yield from _find_text_faults(bar)
    badge = bar.badge.font()
    badge.setBold(True)
    badge.setPixelSize(10)
    if QFontMetrics(badge).horizontalAdvance("VIRTUAL BOARDS") > bar.badge.width() - 20:
        yield f"the badge is cut: {bar.badge.size()}"


def _find_text_faults(bar):
    for widget in (label for label in (bar.phase, bar.remedy_button) if label.isVisible()):
        room, text = widget.contentsRect(), widget.text()
        font = fit_font(widget.font(), text, room.width())
        needed = QFontMetrics(font).size(0, text)
        # The height of a font is larger than that of its letters.
        if needed.width() > room.width() or 0.9 * needed.height() > widget.height():
            yield f"{text!r} is cut: {needed} in {widget.size()}"
        if not bar.row.rect().contains(get_rectangle(widget, bar.row)):
            yield f"{text!r} is outside: {get_rectangle(widget, bar.row)}"


def _find_part_faults(window):
    rect, row = window.rect(), window.layout_row
    docks = [dock for dock in window.docks.values() if not dock.visibleRegion().isEmpty()]
    for part in (window.menuBar(), window._bar, window.statusBar(), window.centralWidget(), *docks):
        if not rect.contains(part.geometry()):
            yield f"{part.objectName() or type(part).__name__} is outside: {part.geometry()}"
    last_menu = window.menuBar().actionGeometry(window.menuBar().actions()[-1])
    if row.isVisible() and row.geometry().left() <= last_menu.right():
        yield f"the layout buttons overlap the menus: {row.geometry()} from {last_menu.right()} on"
    bars = [bar for bar in (window.replay_bar, window.first_steps) if bar.isVisible()]
    for bar in bars:
        for child in bar.findChildren(QPushButton):
            if child.isVisible() and not bar.rect().contains(get_rectangle(child, bar)):
                rectangle = get_rectangle(child, bar)
                yield f"{child.text()!r} is cut in {type(bar).__name__}: {rectangle}"
