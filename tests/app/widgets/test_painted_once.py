"""A widget with plots that comes into sight is painted once, and goes on being painted."""

from PySide6.QtCore import QCoreApplication, QEvent, QObject
from PySide6.QtWidgets import QLabel, QTabWidget, QWidget

from rotemina.app.shell.plot import SignalPlot
from rotemina.app.shell.theme import THEMES
from rotemina.app.widgets.layouts import in_column
from rotemina.app.widgets.painted_once import PaintedOnce


class Paints(QObject):
    """Counts how often widgets are painted."""

    def __init__(self, widgets):
        super().__init__()
        self.counts = dict.fromkeys(widgets, 0)
        for widget in widgets:
            widget.installEventFilter(self)

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        if event.type() == QEvent.Type.Paint:
            self.counts[watched] += 1
        return False


def all_painted():
    for _ in range(4):
        QCoreApplication.processEvents()


def test_plots_are_painted_once_where_they_come_into_sight(qtbot):
    page = QWidget()
    PaintedOnce(page)
    plots = [SignalPlot(THEMES["dark"]) for _ in range(3)]
    in_column(*plots, on=page)
    tabs = QTabWidget()
    qtbot.addWidget(tabs)
    tabs.addTab(page, "plots")
    tabs.addTab(QLabel(), "other")
    with qtbot.waitActive(tabs):
        tabs.show()
        tabs.activateWindow()
    tabs.setCurrentIndex(1)
    all_painted()
    paints = Paints([plot.viewport() for plot in plots])
    tabs.setCurrentIndex(0)
    all_painted()
    assert list(paints.counts.values()) == [1, 1, 1]
    for plot in plots:
        plot.viewport().update()
    all_painted()
    assert list(paints.counts.values()) == [2, 2, 2]
