"""The map of the tip: the trail, places, and moving there with a click and a button."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication

from rotemina.app.motion.session import SavedPositions
from rotemina.plugins.microscope.map_section import MapSection
from rotemina.plugins.microscope.tip_map import (
    MAX_TRAIL_POINTS,
    MIN_TRAIL_STEP_M,
    PlaceKind,
    TipMap,
    TipTrail,
)
from rotemina.sim.robot_files import load_robot

LONG_MS = 20_000
ROBOT = load_robot("rotemina")


class ManualClock:
    """A clock that the test advances."""

    def __init__(self):
        self.now_s = 100.0

    def __call__(self):
        return self.now_s


def test_a_trail_ignores_tiny_moves_and_is_thinned():
    trail = TipTrail()
    assert trail.add(np.zeros(3))
    assert not trail.add(np.full(3, 0.5 * MIN_TRAIL_STEP_M))
    for number in range(1, MAX_TRAIL_POINTS + 10):
        trail.add(np.array([2.0 * MIN_TRAIL_STEP_M * number, 0.0, 0.0]))
    assert MAX_TRAIL_POINTS // 2 < len(trail.points) < MAX_TRAIL_POINTS
    assert (np.diff(trail.points[:, 0]) > 0.0).all()
    trail.clear()
    assert len(trail.points) == 0


def test_a_free_place_is_reached_by_the_tables_at_the_same_height():
    tip_map = TipMap(ROBOT)
    command = {name: sum(axis.range) / 2.0 for name, axis in ROBOT.axes.items()}
    tip_m = tip_map.compute_tip(command)
    place = tip_map.make_free_place(tip_m[0] + 2e-4, tip_m[1] - 1e-4, command)
    new_tip_m = tip_map.compute_tip({**command, **place.targets})
    np.testing.assert_allclose(new_tip_m - tip_m, [2e-4, -1e-4, 0.0], atol=1e-12)
    assert set(place.targets) == {"x", "y"}
    assert not tip_map.is_large_move(place, command)
    assert tip_map.is_large_move(
        tip_map.make_free_place(tip_m[0] + 0.02, tip_m[1], command), command
    )
    assert tip_map.compute_tip({"x": 0.0}) is None


@pytest.fixture
def workbench(window):
    return window.workbench


@pytest.fixture
def section(qtbot, workbench):
    command = workbench.session.snapshot().command
    saved_positions = SavedPositions(workbench.settings.folder, workbench.robot)
    saved_positions.save("dish", {**command, "x": command["x"] + 3e-4})
    saved_positions.save("far", {**command, "y": command["y"] + 0.02})
    workbench.operation.cells.add({**command, "x": command["x"] - 2e-4})
    section = MapSection(workbench, ManualClock())
    qtbot.addWidget(section)
    section.resize(260, 420)
    section.show()
    update_map(section)
    section.view.fit(whole_reach=False)
    return section


def update_map(section):
    section._clock.now_s += 2.0
    state = section._workbench.session.snapshot()
    section._note_tip(state)
    section.refresh(None, state)


def click_at(qtbot, section, x_m, y_m):
    position = np.array([x_m, y_m, 0.0])
    point = section.view._make_projection().to_point(position).toPoint()
    qtbot.mouseClick(section.view, Qt.MouseButton.LeftButton, pos=point)
    update_map(section)


def rests_at(session, place):
    state = session.snapshot()
    return session.at_rest and dict(state.command) == pytest.approx(dict(place), abs=1e-9)


def press_go(qtbot, section):
    update_map(section)
    qtbot.mouseClick(section.go, Qt.MouseButton.LeftButton)


def zoom_and_pan(qtbot, section):
    """Check that the wheel keeps the point under the mouse, and that a drag pans."""
    view, cursor = section.view, QPointF(60.0, 80.0)
    position, span = view._make_projection().to_position(cursor), view._span_m
    event = QWheelEvent(
        cursor,
        view.mapToGlobal(cursor),
        QPoint(),
        QPoint(0, 120),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(view, event)
    assert view._span_m < span
    assert view._make_projection().to_position(cursor) == pytest.approx(position)
    goal = section.goal
    qtbot.mousePress(view, Qt.MouseButton.LeftButton, pos=QPoint(60, 80))
    qtbot.mouseMove(view, QPoint(100, 90))
    qtbot.mouseRelease(view, Qt.MouseButton.LeftButton, pos=QPoint(100, 90))
    assert section.goal is goal
    assert view._make_projection().to_position(QPointF(100.0, 90.0)) == pytest.approx(position)


def test_a_click_chooses_a_saved_place_and_the_button_moves_there(qtbot, workbench, section):
    session = workbench.session
    start = dict(session.snapshot().command)
    assert not section.go.isEnabled()
    dish = next(place for place in section._known_places if place.name == "dish")
    click_at(qtbot, section, *dish.tip_m[:2])
    assert section.goal is dish
    assert section.status_label.text().startswith("Position dish\ntip x, y, z [mm]: ")
    assert "300 µm from here; longest move: X" in section.status_label.text()
    assert session.snapshot().command == start  # a click moves nothing
    press_go(qtbot, section)
    qtbot.waitUntil(lambda: rests_at(session, dish.targets), timeout=LONG_MS)
    update_map(section)
    assert len(section.trail.points) >= 2
    session.undo()  # undo works as for any move
    qtbot.waitUntil(lambda: rests_at(session, start), timeout=LONG_MS)


def test_cells_and_free_places_of_a_zoomed_map_are_chosen_and_other_axes_stay(
    qtbot, workbench, section
):
    cell = next(place for place in section._known_places if place.kind is PlaceKind.CELL)
    click_at(qtbot, section, *cell.tip_m[:2])
    assert section.goal == cell
    workbench.operation.cells.remove(1)
    update_map(section)
    assert section.goal is None  # the cell was removed
    command = dict(workbench.session.snapshot().command)
    tip = TipMap(ROBOT).compute_tip(command)
    zoom_and_pan(qtbot, section)
    section.view.fit(whole_reach=False)
    section.view._span_m = 1e-3
    section.view._middle = tip
    click_at(qtbot, section, tip[0] - 1e-4, tip[1] - 2e-4)
    assert section.goal.kind is PlaceKind.FREE
    press_go(qtbot, section)
    target = section.goal.targets
    qtbot.waitUntil(lambda: rests_at(workbench.session, {**command, **target}), timeout=LONG_MS)


def test_a_far_place_needs_a_confirmation_that_a_stop_cancels(qtbot, workbench, section):
    session = workbench.session
    start = dict(session.snapshot().command)
    far = next(place for place in section._known_places if place.name == "far")
    section.choose(far, 0.0, 0.0)
    press_go(qtbot, section)
    assert section.go.text() == "Far away: go there?"
    qtbot.mouseClick(section.go, Qt.MouseButton.LeftButton)  # a double click does not confirm
    assert session.snapshot().command == start
    workbench.stop()
    update_map(section)
    assert section.go.text() == "Go there"
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    press_go(qtbot, section)
    assert section.go.text() == "Far away: go there?"
    press_go(qtbot, section)
    qtbot.waitUntil(lambda: not session.at_rest, timeout=LONG_MS)
    update_map(section)
    assert not section.go.isEnabled()
    workbench.stop()
