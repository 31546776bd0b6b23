"""Data that arrives unasked raises no panel; the tab is marked until the panel is shown."""

import numpy as np
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


def show_recorder(qtbot, window):
    """Bring the recorder in front of trajectory and comparison."""
    window.bring_up("recorder")
    qtbot.waitUntil(lambda: "recorder" in get_front_names(window), timeout=LONG_MS)
    assert not {"trajectory", "comparison"} & get_front_names(window)


def test_arriving_data_marks_the_tab_until_the_panel_is_shown(qtbot, window):
    show_recorder(qtbot, window)
    bench, before, dock = window.workbench, get_front_names(window), window.docks["trajectory"]
    bar, index = find_tab(window, "trajectory")
    rects = [bar.tabRect(number) for number in range(bar.count())]
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("move", MOVE)
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        bench.play()
    bench.offer_ports([("/dev/pts/7", "a board")])
    assert get_front_names(window) == before
    assert window.news.unseen_names >= {"trajectory", "comparison"}
    assert [bar.tabRect(number) for number in range(bar.count())] == rects
    assert bar.accessibleTabName(index) == "Trajectory, has something new"
    assert dock.toggleViewAction().text() == "Trajectory ●"
    dock.raise_()
    qtbot.waitUntil(lambda: "trajectory" not in window.news.unseen_names, timeout=LONG_MS)
    qtbot.waitUntil(lambda: bar.accessibleTabName(index) == "Trajectory", timeout=LONG_MS)
    assert dock.toggleViewAction().text() == "Trajectory"
    show_recorder(qtbot, window)
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.planner.plan_again(bench.plan)  # the same trajectory on another model
    assert "trajectory" not in window.news.unseen_names


def test_dots_are_drawn_only_on_marked_tabs_and_ignore_the_mouse(qtbot, window):
    show_recorder(qtbot, window)
    bar, index = find_tab(window, "comparison")
    window.workbench.arrived.emit("comparison", object())
    dots = bar.findChild(TabDots)
    picture = dots.grab().toImage()
    ratio = picture.devicePixelRatio()
    colour = dots.palette().highlight().color()

    def is_marked(number):
        tab = bar.tabRect(number)
        place = (tab.right() - 6) * ratio, (tab.top() + 6) * ratio
        return picture.pixelColor(*map(round, place)) == colour

    assert [number for number in range(bar.count()) if is_marked(number)] == [index]
    assert bar.childAt(bar.tabRect(index).center()) is None


def test_a_file_opened_through_the_menu_brings_its_panel_up_at_once(qtbot, window, tmp_path):
    show_recorder(qtbot, window)
    path = tmp_path / "move.csv"
    write_record(MOVE, path)
    window.load_trajectory(path, show=False)  # as a panel's own button does
    assert "recorder" in get_front_names(window)
    window.load_trajectory(path)
    assert "trajectory" in get_front_names(window)
    window.open_record(path)
    assert "comparison" in get_front_names(window)
    window.bring_up("no_such_panel")
    assert "Panel 'no_such_panel' is missing" in window.notices.notices()[0].text
