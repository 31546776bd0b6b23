"""What the geometry of a window must keep: stops in sight, no part cut, nothing on another part."""

from itertools import combinations

from PySide6.QtCore import QPoint, QRect
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QApplication, QPushButton, QToolButton

from rotemina.app.widgets.fitted_text import fitted_font

SMALLEST = (1024, 720)
LONG_STATE = (
    "Die Verbindung zu beiden Platinen ist seit 12 s unterbrochen; die Position ist unbekannt"
)


def settle():
    for _ in range(6):
        QApplication.processEvents()


def place(widget, window):
    return QRect(widget.mapTo(window, QPoint()), widget.size())


def show_everything(window):
    """Bring up what comes and goes, with long texts, and keep the header as it is now."""
    bar = window._bar
    window.workbench.refreshed.disconnect(window._refresh)
    window.replay_bar.show()
    window.first_steps.show()
    bar.row.fill(bar.recording, full=True)
    bar.recording.setText("● 12:34:56  123.4 GB")
    bar.model._name = "Corrected: cross coupling, backlash and hysteresis +3"
    bar.model._fit()
    bar.phase.setText("Verbindung verloren")
    bar.doing.show_text(LONG_STATE)
    bar.help.setText("Neu verbinden")
    bar.help.show()
    window.progress_line.show()


def faults_of_geometry(window):
    """Return what is wrong with the places of the parts of a window."""
    return [*_of_stops(window), *_of_header(window), *_of_parts(window)]


def _of_stops(window):
    stop, lock = window.stop_button, window.emergency_button
    for button in (stop, lock):
        at = place(button, window)
        if not window.rect().contains(at) or not button.isVisible():
            yield f"{button.text()!r} is not in the window: {at}"
        corners = (at.topLeft(), at.topRight(), at.bottomLeft(), at.bottomRight(), at.center())
        if any(window.childAt(corner) is not button for corner in corners):
            yield f"{button.text()!r} is covered"
    if abs(lock.width() - 2 * stop.width() / 3) > 1:
        yield f"stop {stop.width()} and lock {lock.width()}"
    for other in window.findChildren(QPushButton) + window.findChildren(QToolButton):
        seen = other.visibleRegion().boundingRect().size()
        if other is not stop and seen.width() * seen.height() >= stop.width() * stop.height():
            yield f"{other.text()!r} is larger than stop: {other.size()}"


def _of_header(window):
    bar = window._bar
    chips = (bar.owner, bar.model, bar.recording, bar.events, bar.row.dropped)
    parts = [bar.badge, bar.state, *chips, bar.emergency, bar.stop]
    parts = [part for part in parts if part.isVisible()]
    for part in parts:
        if not bar.row.rect().contains(part.geometry()):
            yield f"{type(part).__name__} is cut: {part.geometry()} in {bar.row.rect()}"
        if part in chips and part.width() < part.minimumSizeHint().width():
            yield f"{type(part).__name__} is too narrow: {part.width()}"
    for one, other in combinations(parts, 2):
        if one.geometry().intersects(other.geometry()):
            yield f"{type(one).__name__} on {type(other).__name__}"
    yield from _of_words(bar)
    badge = bar.badge.font()
    badge.setBold(True)
    badge.setPixelSize(10)
    if QFontMetrics(badge).horizontalAdvance("VIRTUAL BOARDS") > bar.badge.width() - 20:
        yield f"the badge is cut: {bar.badge.size()}"


def _of_words(bar):
    for words in (one for one in (bar.phase, bar.help) if one.isVisible()):
        room, text = words.contentsRect(), words.text()
        font = fitted_font(words.font(), text, room.width())
        needed = QFontMetrics(font).size(0, text)
        # A font is higher than its letters.
        if needed.width() > room.width() or 0.9 * needed.height() > words.height():
            yield f"{text!r} is cut: {needed} in {words.size()}"
        if not bar.row.rect().contains(place(words, bar.row)):
            yield f"{text!r} is outside: {place(words, bar.row)}"


def _of_parts(window):
    rect, row = window.rect(), window.layout_row
    docks = [dock for dock in window.docks.values() if not dock.visibleRegion().isEmpty()]
    for part in (window.menuBar(), window._bar, window.statusBar(), window.centralWidget(), *docks):
        if not rect.contains(part.geometry()):
            yield f"{part.objectName() or type(part).__name__} is outside: {part.geometry()}"
    last = window.menuBar().actionGeometry(window.menuBar().actions()[-1])
    if row.isVisible() and row.geometry().left() <= last.right():
        yield f"the layouts stand on the menus: {row.geometry()} from {last.right()} on"
    bars = [bar for bar in (window.replay_bar, window.first_steps) if bar.isVisible()]
    for bar in bars:
        for child in bar.findChildren(QPushButton):
            if child.isVisible() and not bar.rect().contains(place(child, bar)):
                yield f"{child.text()!r} is cut in {type(bar).__name__}: {place(child, bar)}"
