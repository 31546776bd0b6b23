"""What arrives by itself raises no panel: its tab is marked until it is looked at."""

import numpy as np
import pytest
from PySide6.QtWidgets import QTabBar

from rotemina.app.widgets.tab_dots import TabDots
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record

PANELS = ("trajectory", "comparison", "connection", "recorder")
LONG_MS = 30_000
TIME_S = np.arange(201) / 500.0
MOVE = Record.from_signals(
    TIME_S, {("thx", Tap.CMD): 5.8e-4 + 2e-4 * np.sin(np.pi * TIME_S / 0.4) ** 2}, {"thx": "rad"}
)


def front(window):
    """Return the names of the docks that are in front."""
    return {name for name, dock in window.docks.items() if not dock.visibleRegion().isEmpty()}


def bar_of(window, name):
    """Return the tab bar of a dock, and its index there."""
    title = window.docks[name].windowTitle()
    for bar in window.findChildren(QTabBar):
        titles = [bar.tabText(index).replace("&", "") for index in range(bar.count())]
        if title in titles:
            return bar, titles.index(title)
    raise AssertionError(name)


@pytest.fixture
def behind(qtbot, window):
    """A window in which the recorder is in front of trajectory and comparison."""
    window.bring_up("recorder")
    qtbot.waitUntil(lambda: "recorder" in front(window), timeout=LONG_MS)
    assert not {"trajectory", "comparison"} & front(window)
    return window


def test_a_trajectory_and_a_run_that_arrive_change_no_tab(qtbot, behind):
    bench, before = behind.workbench, front(behind)
    bar, index = bar_of(behind, "trajectory")
    rects = [bar.tabRect(number) for number in range(bar.count())]
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("move", MOVE)
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        bench.play()
    bench.offer_ports([("/dev/pts/7", "a board")])
    assert front(behind) == before
    assert behind.news.new >= {"trajectory", "comparison"}
    assert [bar.tabRect(number) for number in range(bar.count())] == rects
    assert bar.accessibleTabName(index) == "Trajectory, has something new"
    assert behind.docks["trajectory"].toggleViewAction().text() == "Trajectory ●"


def test_the_mark_ends_when_the_panel_is_looked_at_and_does_not_come_back(qtbot, behind):
    bench = behind.workbench
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("move", MOVE)
    bar, index = bar_of(behind, "trajectory")
    behind.docks["trajectory"].raise_()
    qtbot.waitUntil(lambda: "trajectory" not in behind.news.new, timeout=LONG_MS)
    qtbot.waitUntil(lambda: bar.accessibleTabName(index) == "Trajectory", timeout=LONG_MS)
    assert behind.docks["trajectory"].toggleViewAction().text() == "Trajectory"
    behind.bring_up("recorder")
    qtbot.waitUntil(lambda: "recorder" in front(behind), timeout=LONG_MS)
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_again(bench.plan)  # the same trajectory on another model
    assert "trajectory" not in behind.news.new


def test_a_file_opened_through_the_menu_brings_its_panel_up_at_once(behind, tmp_path):
    path = tmp_path / "move.csv"
    write_record(MOVE, path)
    behind.load_trajectory(path, show=False)  # as a panel's own button does
    assert "recorder" in front(behind)
    behind.load_trajectory(path)
    assert "trajectory" in front(behind)
    behind.open_record(path)
    assert "comparison" in front(behind)


def test_a_panel_that_is_missing_is_named_where_it_is_asked_for(window):
    window.bring_up("no_such_panel")
    assert "Panel 'no_such_panel' is missing" in window.notices.notices()[0].text


def test_dots_are_drawn_only_on_marked_tabs_and_let_the_mouse_through(qtbot, behind):
    bar, index = bar_of(behind, "comparison")
    behind.workbench.arrived.emit("comparison", object())
    dots = bar.findChild(TabDots)
    picture = dots.grab().toImage()
    ratio = picture.devicePixelRatio()
    colour = dots.palette().highlight().color()

    def is_marked(number):
        tab = bar.tabRect(number)
        place = (tab.right() - 6) * ratio, (tab.top() + 6) * ratio
        return picture.pixelColor(*map(round, place)) == colour

    marked = [number for number in range(bar.count()) if is_marked(number)]
    assert marked == [index]
    assert bar.childAt(bar.tabRect(index).center()) is None
