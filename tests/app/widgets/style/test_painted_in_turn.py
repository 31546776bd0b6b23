"""Plots that are shown or resized together are painted once each, one after another."""

from itertools import pairwise

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QObject
from PySide6.QtWidgets import QLabel, QTabWidget, QWidget

from rotemina.app.widgets.drawing import (
    SignalPlot,
    drop_spare_plots,
    make_spare_plot,
    plot as plot_module,
)
from rotemina.app.widgets.layout import make_column
from rotemina.app.widgets.style import THEMES


class PaintCounter(QObject):
    """Counts the paint events that draw plots, not only their background."""

    def __init__(self, plots):
        super().__init__()
        self.counts = dict.fromkeys(plots, 0)
        for plot in plots:
            plot.viewport().installEventFilter(self)

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        plot = watched.parent()
        if event.type() == QEvent.Type.Paint and not plot._staggering.is_held:
            self.counts[plot] += 1
        return False


def process_events():
    for _ in range(8):
        QCoreApplication.processEvents()


def show_tabs(qtbot, *pages):
    tabs = QTabWidget()
    qtbot.addWidget(tabs)
    for page in pages:
        tabs.addTab(page, "page")
    with qtbot.waitActive(tabs):
        tabs.show()
        tabs.activateWindow()
    return tabs


def make_page_with_plots():
    page = QWidget()
    plots = [SignalPlot(THEMES["dark"]) for _ in range(3)]
    make_column(*plots, on=page)
    return page, plots


def test_shown_plots_are_painted_once_each_in_turn(qtbot):
    page, plots = make_page_with_plots()
    tabs = show_tabs(qtbot, page, QLabel())
    tabs.setCurrentIndex(1)
    process_events()
    counter = PaintCounter(plots)
    tabs.setCurrentIndex(0)
    totals = []
    for _ in range(8):
        QCoreApplication.processEvents()
        totals.append(sum(counter.counts.values()))
    assert totals[-1] == 3
    assert max(after - before for before, after in pairwise([0, *totals])) == 1
    assert list(counter.counts.values()) == [1, 1, 1]
    for plot in plots:
        plot.viewport().update()
    process_events()
    assert list(counter.counts.values()) == [2, 2, 2]


def test_a_plot_resized_several_times_fits_its_axes_once(qtbot):
    page, (plot, *_) = make_page_with_plots()
    tabs = show_tabs(qtbot, page)
    process_events()
    fitted_widths = []
    plot.sigDeviceRangeChanged.connect(lambda *_: fitted_widths.append(plot.width()))
    for width in (500, 600, 700):
        tabs.resize(width, 500)
    assert not fitted_widths
    process_events()
    assert set(fitted_widths) == {plot.width()}
    assert plot.getPlotItem().boundingRect().width() == pytest.approx(plot.width(), abs=2.0)


def test_a_waiting_plot_can_be_grabbed(qtbot):
    page, (plot, *_) = make_page_with_plots()
    tabs = show_tabs(qtbot, page)
    process_events()
    tabs.resize(700, 500)
    counter = PaintCounter([plot])
    plot.paint_now()
    plot.grab()
    assert counter.counts[plot] == 1


def test_spare_plots_are_used_first_and_dropped_at_the_end(qtbot):
    while not make_spare_plot():
        pass
    spare_items = list(plot_module._spare_items)
    first = SignalPlot(THEMES["dark"])
    qtbot.addWidget(first)
    assert first.getPlotItem() is spare_items[-1]
    drop_spare_plots()
    second = SignalPlot(THEMES["dark"])
    qtbot.addWidget(second)
    assert second.getPlotItem() not in spare_items
