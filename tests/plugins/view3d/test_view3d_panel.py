"""The 3-D panel: it draws when seen, follows what is shown and the mouse; browsers are extra."""

import threading
import time
from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QDesktopServices, QGuiApplication, QWheelEvent

from rotemina.app.scene.views import View
from rotemina.app.shell.theme import DARK, LIGHT
from rotemina.plugins.view3d.panel import scene_of
from rotemina.sim.robot.file import load_robot

PANELS = ("comparison",)

LONG_MS = 30_000
LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton


@pytest.fixture
def panel(qtbot, window):
    panel = window.panels["view3d"]
    window.docks["view3d"].raise_()
    qtbot.waitUntil(lambda: panel.canvas.painted > 0, timeout=LONG_MS)
    return panel


def newest(panel, kind):
    return [c for c in panel.robot_scene.scene.changes().commands if c["type"] == kind]


def pose(panel, path):
    (command,) = (c for c in newest(panel, "set_transform") if c["path"] == path)
    return command["matrix"]


def serving_threads():
    return [thread for thread in threading.enumerate() if thread.name == "3-D view"]


def drag(qtbot, canvas, button=LEFT):
    middle = canvas.rect().center()
    qtbot.mousePress(canvas, button, pos=middle)
    qtbot.mouseMove(canvas, middle + QPoint(40, 0))
    qtbot.mouseRelease(canvas, button, pos=middle + QPoint(40, 0))


def test_it_follows_what_is_shown_and_its_controls_unless_out_of_sight(qtbot, window, panel):
    canvas = panel.canvas
    qtbot.waitUntil(lambda: len(newest(panel, "set_transform")) == 10, timeout=LONG_MS)
    window.workbench.session.go_to({"x": 0.0285})
    for ghost in ("real", "model"):
        path = f"/robot/{ghost}/x"
        qtbot.waitUntil(lambda p=path: abs(pose(panel, p)[12] - 0.0285) < 1e-6, timeout=LONG_MS)
    assert newest(panel, "alive") == []  # for browsers alone

    window.docks["comparison"].raise_()
    qtbot.waitUntil(lambda: not canvas.in_sight, timeout=LONG_MS)
    revision, painted = panel.robot_scene.scene.changes().revision, canvas.painted
    panel.refresh(window.workbench.session.snapshot())
    assert panel.robot_scene.scene.changes().revision == revision
    panel.factor.setCurrentIndex(1)
    qtbot.wait(60)
    assert canvas.painted == painted
    window.docks["view3d"].raise_()
    qtbot.waitUntil(lambda: canvas.in_sight, timeout=LONG_MS)

    panel.views[View.BELOW].click()
    assert newest(panel, "view")[0]["eye"][2] < 0
    qtbot.waitUntil(lambda: canvas.picture.camera.offset[2] < 0, timeout=LONG_MS)
    panel.factor.setCurrentIndex(2)
    assert "50 ×" in newest(panel, "note")[0]["warnings"][0]
    panel.ghosts.setCurrentText("Model")
    assert newest(panel, "note")[0]["shown"] == ["model"]
    window.workbench.theme_changed.emit(LIGHT)  # without the style sheet, which takes seconds
    assert newest(panel, "note")[0]["colours"]["model"] == LIGHT.model
    qtbot.waitUntil(lambda: window.workbench.session.at_rest, timeout=LONG_MS)
    window.workbench.teach_floor()
    path = "/robot/bounds/floor"
    qtbot.waitUntil(
        lambda: any(c["path"] == path for c in newest(panel, "set_object")), timeout=LONG_MS
    )


def test_the_mouse_turns_shifts_zooms_and_resets(qtbot, panel):
    canvas = panel.canvas
    home = canvas.picture.camera
    drag(qtbot, canvas)
    turned = canvas.picture.camera
    assert turned.offset[:2].tolist() != pytest.approx(home.offset[:2].tolist())
    assert turned.offset[2] == pytest.approx(home.offset[2])
    drag(qtbot, canvas, RIGHT)
    shifted = canvas.picture.camera
    assert shifted.target.tolist() != pytest.approx(home.target.tolist())
    middle = QPointF(canvas.rect().center())
    wheel = QWheelEvent(
        middle, canvas.mapToGlobal(middle), QPoint(), QPoint(0, 120), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QGuiApplication.sendEvent(canvas, wheel)
    assert abs(canvas.picture.camera.offset).max() < abs(shifted.offset).max()
    qtbot.mouseDClick(canvas, LEFT, pos=canvas.rect().center())
    assert canvas.picture.camera is home
    qtbot.mouseRelease(canvas, LEFT)


def test_a_moved_axis_moves_pixels_and_a_standing_one_draws_nothing(window, panel, monkeypatch):
    canvas, asked = panel.canvas, []
    window.workbench.shown.disconnect(panel.refresh)
    state = window.workbench.session.snapshot()
    panel.refresh(state)
    before = canvas.grab().toImage()
    monkeypatch.setattr(canvas, "redraw", lambda: asked.append(1))
    panel.refresh(state)
    nanometre = state.measured | {"x": state.measured["x"] + 1e-9}
    panel.refresh(replace(state, measured=nanometre))
    assert asked == []
    millimetre = state.measured | {"x": state.measured["x"] + 1e-3}
    panel.refresh(replace(state, measured=millimetre))
    assert asked == [1]
    assert canvas.grab().toImage() != before


def test_many_changes_are_drawn_at_most_25_times_a_second(qtbot, panel):
    canvas = panel.canvas
    for _ in range(20):  # what the window itself asked for when it was opened
        QGuiApplication.processEvents()
    painted, began_s = canvas.painted, time.monotonic()
    while time.monotonic() - began_s < 0.2:
        canvas.redraw()
        QGuiApplication.processEvents()
    assert 1 <= canvas.painted - painted <= 1 + 25 * (time.monotonic() - began_s)


def test_nothing_is_served_unasked_and_the_browser_gets_the_address(
    qtbot, window, panel, monkeypatch, caplog
):
    assert panel.serving.server is None
    assert serving_threads() == []
    opened = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: bool(opened.append(url)))
    panel.browser.click()
    assert "opened" in panel.browser.toolTip()
    qtbot.waitUntil(lambda: opened != [], timeout=LONG_MS)
    server = panel.serving.server
    assert opened[0].toString() == server.url
    # None could be opened: the address is a secret, and stays out of notices and the log.
    assert QGuiApplication.clipboard().text() == server.url
    notices = " ".join(notice.text for notice in window.notices.notices())
    assert "clipboard" in notices
    for text in (notices, caplog.text):
        assert server.url not in text
    # Browsers are told also while the panel is out of sight.
    window.docks["comparison"].raise_()
    qtbot.waitUntil(lambda: not panel.canvas.in_sight, timeout=LONG_MS)
    monkeypatch.setattr(type(server), "watching", 1)
    panel.refresh(window.workbench.session.snapshot())
    assert newest(panel, "alive") != []
    assert len(serving_threads()) == 1
    window.workbench.close()
    assert serving_threads() == []


def test_a_robot_without_the_chain_gets_a_reason():
    scene, reason = scene_of(load_robot("emps"), DARK)
    assert scene is None
    assert "has no axis" in reason
