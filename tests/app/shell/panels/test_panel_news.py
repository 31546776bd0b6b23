"""Data that arrives unasked raises no panel; the tab is marked until the panel is shown."""

import numpy as np
import pytest
from PySide6.QtWidgets import QTabBar

from rotemina.app.widgets.controls import TabDots
from rotemina.sim.records import Record, Tap, write_record

PANELS = ("trajectory", "comparison", "connection", "recorder")
LONG_MS = 30_000
TIME_S = np.arange(201) / 500.0
MOVE = Record.from_signals(
    TIME_S, {("thx", Tap.CMD): 5.8e-4 + 2e-4 * np.sin(np.pi * TIME_S / 0.4) ** 2}, {"thx": "rad"}
)


def get_front_names(window):
    """Return the names of the docks that are in front."""
    return {name for name, dock in window.docks.items() if not dock.visibleRegion().isEmpty()}


def find_tab(window, name):
    """Return the tab bar of a dock, and its index there."""
    title = window.docks[name].windowTitle()
    for bar in window.findChildren(QTabBar):
        titles = [bar.tabText(index).replace("&", "") for index in range(bar.count())]
        if title in titles:
            return bar, titles.index(title)
    raise AssertionError(name)


@pytest.fixture
def window_with_hidden_tabs(qtbot, window):
    """A window in which the recorder is in front of trajectory and comparison."""
    window.bring_up("recorder")
    qtbot.waitUntil(lambda: "recorder" in get_front_names(window), timeout=LONG_MS)
    assert not {"trajectory", "comparison"} & get_front_names(window)
    return window


def test_an_arriving_trajectory_or_run_raises_no_tab(qtbot, window_with_hidden_tabs):
    bench, before = window_with_hidden_tabs.workbench, get_front_names(window_with_hidden_tabs)
    bar, index = find_tab(window_with_hidden_tabs, "trajectory")
    rects = [bar.tabRect(number) for number in range(bar.count())]
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("move", MOVE)
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        bench.play()
    bench.offer_ports([("/dev/pts/7", "a board")])
    assert get_front_names(window_with_hidden_tabs) == before
    assert window_with_hidden_tabs.news.unseen_names >= {"trajectory", "comparison"}
    assert [bar.tabRect(number) for number in range(bar.count())] == rects
    assert bar.accessibleTabName(index) == "Trajectory, has something new"
    assert window_with_hidden_tabs.docks["trajectory"].toggleViewAction().text() == "Trajectory ●"


def test_the_mark_goes_when_the_panel_is_shown(qtbot, window_with_hidden_tabs):
    bench = window_with_hidden_tabs.workbench
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("move", MOVE)
    bar, index = find_tab(window_with_hidden_tabs, "trajectory")
    window_with_hidden_tabs.docks["trajectory"].raise_()
    qtbot.waitUntil(
        lambda: "trajectory" not in window_with_hidden_tabs.news.unseen_names, timeout=LONG_MS
    )
    qtbot.waitUntil(lambda: bar.accessibleTabName(index) == "Trajectory", timeout=LONG_MS)
    assert window_with_hidden_tabs.docks["trajectory"].toggleViewAction().text() == "Trajectory"
    window_with_hidden_tabs.bring_up("recorder")
    qtbot.waitUntil(lambda: "recorder" in get_front_names(window_with_hidden_tabs), timeout=LONG_MS)
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.planner.plan_again(bench.plan)  # the same trajectory on another model
    assert "trajectory" not in window_with_hidden_tabs.news.unseen_names


def test_a_file_opened_through_the_menu_brings_its_panel_up_at_once(
    window_with_hidden_tabs, tmp_path
):
    path = tmp_path / "move.csv"
    write_record(MOVE, path)
    window_with_hidden_tabs.load_trajectory(path, show=False)  # as a panel's own button does
    assert "recorder" in get_front_names(window_with_hidden_tabs)
    window_with_hidden_tabs.load_trajectory(path)
    assert "trajectory" in get_front_names(window_with_hidden_tabs)
    window_with_hidden_tabs.open_record(path)
    assert "comparison" in get_front_names(window_with_hidden_tabs)


def test_asking_for_a_missing_panel_names_it(window):
    window.bring_up("no_such_panel")
    assert "Panel 'no_such_panel' is missing" in window.notices.notices()[0].text


def test_dots_are_drawn_only_on_marked_tabs_and_ignore_the_mouse(qtbot, window_with_hidden_tabs):
    bar, index = find_tab(window_with_hidden_tabs, "comparison")
    window_with_hidden_tabs.workbench.arrived.emit("comparison", object())
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
