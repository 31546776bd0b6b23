"""Plots that are shown or resized together are painted once each, one after another."""

from itertools import pairwise

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QObject
from PySide6.QtWidgets import QLabel, QTabWidget, QWidget

from rotemina.app.shell import plot as plot_module
from rotemina.app.shell.plot import SignalPlot, drop_plots_ahead, make_plot_ahead
from rotemina.app.shell.theme import THEMES
from rotemina.app.widgets.layouts import in_column


class Paints(QObject):
    """Counts how often plots are painted, apart from their ground."""

    def __init__(self, plots):
        super().__init__()
        self.counts = dict.fromkeys(plots, 0)
        for plot in plots:
            plot.viewport().installEventFilter(self)

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        plot = watched.parent()
        if event.type() == QEvent.Type.Paint and not plot._turn.is_held:
            self.counts[plot] += 1
        return False


def all_painted():
    for _ in range(8):
        QCoreApplication.processEvents()


def shown_tabs(qtbot, *pages):
    tabs = QTabWidget()
    qtbot.addWidget(tabs)
    for page in pages:
        tabs.addTab(page, "page")
    with qtbot.waitActive(tabs):
        tabs.show()
        tabs.activateWindow()
    return tabs


def page_with_plots():
    page = QWidget()
    plots = [SignalPlot(THEMES["dark"]) for _ in range(3)]
    in_column(*plots, on=page)
    return page, plots


def test_plots_are_painted_once_each_in_its_turn_when_they_are_shown(qtbot):
    page, plots = page_with_plots()
    tabs = shown_tabs(qtbot, page, QLabel())
    tabs.setCurrentIndex(1)
    all_painted()
    paints = Paints(plots)
    tabs.setCurrentIndex(0)
    seen = []
    for _ in range(8):
        QCoreApplication.processEvents()
        seen.append(sum(paints.counts.values()))
    assert seen[-1] == 3
    assert max(after - before for before, after in pairwise([0, *seen])) == 1
    assert list(paints.counts.values()) == [1, 1, 1]
    for plot in plots:
        plot.viewport().update()
    all_painted()
    assert list(paints.counts.values()) == [2, 2, 2]


def test_a_plot_that_is_resized_several_times_fits_its_axes_once(qtbot):
    page, (plot, *_) = page_with_plots()
    tabs = shown_tabs(qtbot, page)
    all_painted()
    fitted = []
    plot.sigDeviceRangeChanged.connect(lambda *_: fitted.append(plot.width()))
    for width in (500, 600, 700):
        tabs.resize(width, 500)
    assert not fitted
    all_painted()
    assert set(fitted) == {plot.width()}
    assert plot.getPlotItem().boundingRect().width() == pytest.approx(plot.width(), abs=2.0)


def test_a_picture_can_be_taken_of_a_plot_that_waits_for_its_turn(qtbot):
    page, (plot, *_) = page_with_plots()
    tabs = shown_tabs(qtbot, page)
    all_painted()
    tabs.resize(700, 500)
    paints = Paints([plot])
    plot.settle()
    plot.grab()
    assert paints.counts[plot] == 1


def test_plots_made_ahead_are_used_first_and_dropped_at_the_end(qtbot):
    while not make_plot_ahead():
        pass
    ahead = list(plot_module._made_ahead)
    used = SignalPlot(THEMES["dark"])
    qtbot.addWidget(used)
    assert used.getPlotItem() is ahead[-1]
    drop_plots_ahead()
    another = SignalPlot(THEMES["dark"])
    qtbot.addWidget(another)
    assert another.getPlotItem() not in ahead
