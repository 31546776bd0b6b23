"""The map of the tip: the trail, places, and the way there by a click and a button."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication

from rotemina.app.motion.saved_positions import SavedPositions
from rotemina.plugins.microscope.map_section import MapSection
from rotemina.plugins.microscope.tip_map import LEAST_M, MOST_POINTS, PlaceKind, TipMap, Trail
from rotemina.sim.robot.file import load_robot

LONG_MS = 20_000
ROBOT = load_robot("rotemina")


class Clock:
    """Goes on as the test says."""

    def __init__(self):
        self.now_s = 100.0

    def __call__(self):
        return self.now_s


def test_a_trail_keeps_what_moves_and_thins_itself():
    trail = Trail()
    assert trail.add(np.zeros(3))
    assert not trail.add(np.full(3, 0.5 * LEAST_M))
    for number in range(1, MOST_POINTS + 10):
        trail.add(np.array([2.0 * LEAST_M * number, 0.0, 0.0]))
    assert MOST_POINTS // 2 < len(trail.points) < MOST_POINTS
    assert (np.diff(trail.points[:, 0]) > 0.0).all()
    trail.clear()
    assert len(trail.points) == 0


def test_a_free_place_is_met_by_the_tables_and_keeps_the_height():
    tip_map = TipMap(ROBOT)
    command = {axis: sum(one.range) / 2.0 for axis, one in ROBOT.axes.items()}
    now = tip_map.tip(command)
    place = tip_map.free(now[0] + 2e-4, now[1] - 1e-4, command)
    there = tip_map.tip({**command, **place.targets})
    np.testing.assert_allclose(there - now, [2e-4, -1e-4, 0.0], atol=1e-12)
    assert set(place.targets) == {"x", "y"}
    assert not tip_map.large(place, command)
    assert tip_map.large(tip_map.free(now[0] + 0.02, now[1], command), command)
    assert tip_map.tip({"x": 0.0}) is None


@pytest.fixture
def bench(window):
    return window.workbench


@pytest.fixture
def section(qtbot, bench):
    command = bench.session.snapshot().command
    kept = SavedPositions(bench.settings.folder, bench.robot)
    kept.keep("dish", {**command, "x": command["x"] + 3e-4})
    kept.keep("far", {**command, "y": command["y"] + 0.02})
    bench.operation.cells.add({**command, "x": command["x"] - 2e-4})
    section = MapSection(bench, Clock())
    qtbot.addWidget(section)
    section.resize(260, 420)
    section.show()
    look(section)
    section.view.fit(whole=False)
    return section


def look(section):
    section._clock.now_s += 2.0
    state = section._bench.session.snapshot()
    section._note(state)
    section.refresh(None, state)


def click(qtbot, section, x_m, y_m):
    place = np.array([x_m, y_m, 0.0])
    at = section.view._frame().point(place).toPoint()
    qtbot.mouseClick(section.view, Qt.MouseButton.LeftButton, pos=at)
    look(section)


def stands_at(session, place):
    now = session.snapshot()
    return session.at_rest and dict(now.command) == pytest.approx(dict(place), abs=1e-9)


def press(qtbot, section):
    look(section)
    qtbot.mouseClick(section.go, Qt.MouseButton.LeftButton)


def test_a_click_chooses_a_saved_place_and_the_button_goes_there(qtbot, bench, section):
    session = bench.session
    before = dict(session.snapshot().command)
    assert not section.go.isEnabled()
    dish = next(one for one in section._known if one.name == "dish")
    click(qtbot, section, *dish.tip_m[:2])
    assert section.goal is dish
    assert section.said.text().startswith("Position dish\ntip x, y, z [mm]: ")
    assert "300 µm from here; farthest: X" in section.said.text()
    assert session.snapshot().command == before  # a click moves nothing
    press(qtbot, section)
    qtbot.waitUntil(lambda: stands_at(session, dish.targets), timeout=LONG_MS)
    look(section)
    assert len(section.trail.points) >= 2
    session.undo()  # the way back is that of any move
    qtbot.waitUntil(lambda: stands_at(session, before), timeout=LONG_MS)


def test_a_cell_is_chosen_and_a_free_place_keeps_what_is_above_it(qtbot, bench, section):
    cell = next(one for one in section._known if one.kind is PlaceKind.CELL)
    click(qtbot, section, *cell.tip_m[:2])
    assert section.goal == cell
    bench.operation.cells.remove(1)
    look(section)
    assert section.goal is None  # it is gone
    command = dict(bench.session.snapshot().command)
    tip = TipMap(ROBOT).tip(command)
    section.view.fit(whole=False)
    section.view._span_m = 1e-3
    section.view._middle = tip
    click(qtbot, section, tip[0] - 1e-4, tip[1] - 2e-4)
    assert section.goal.kind is PlaceKind.FREE
    press(qtbot, section)
    target = section.goal.targets
    qtbot.waitUntil(lambda: stands_at(bench.session, {**command, **target}), timeout=LONG_MS)


def test_a_far_way_is_asked_about_and_a_stop_withdraws_it(qtbot, bench, section):
    session = bench.session
    before = dict(session.snapshot().command)
    far = next(one for one in section._known if one.name == "far")
    section.choose(far, 0.0, 0.0)
    press(qtbot, section)
    assert section.go.text() == "Far away: go there?"
    qtbot.mouseClick(section.go, Qt.MouseButton.LeftButton)  # a double click is no answer
    assert session.snapshot().command == before
    bench.stop()
    look(section)
    assert section.go.text() == "Go there"
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    press(qtbot, section)
    assert section.go.text() == "Far away: go there?"
    press(qtbot, section)
    qtbot.waitUntil(lambda: not session.at_rest, timeout=LONG_MS)
    look(section)
    assert not section.go.isEnabled()
    bench.stop()


def test_the_wheel_keeps_what_is_under_the_mouse_and_a_drag_moves_the_map(qtbot, section):
    view, at = section.view, QPointF(60.0, 80.0)
    before, span = view._frame().place(at), view._span_m
    none = Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase
    away = QPoint(0, 120)
    event = QWheelEvent(
        at, view.mapToGlobal(at), QPoint(), away, Qt.MouseButton.NoButton, *none, False
    )
    QApplication.sendEvent(view, event)
    assert view._span_m < span
    assert view._frame().place(at) == pytest.approx(before)
    goal = section.goal
    qtbot.mousePress(view, Qt.MouseButton.LeftButton, pos=QPoint(60, 80))
    qtbot.mouseMove(view, QPoint(100, 90))
    qtbot.mouseRelease(view, Qt.MouseButton.LeftButton, pos=QPoint(100, 90))
    assert section.goal is goal
    assert view._frame().place(QPointF(100.0, 90.0)) == pytest.approx(before)
