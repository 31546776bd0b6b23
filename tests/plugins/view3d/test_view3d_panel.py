"""The 3-D panel: drawing only while visible, mouse control, and viewers in a browser."""

import threading
import time
from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QDesktopServices, QGuiApplication, QWheelEvent

from rotemina.app.scene import SceneViewpoint
from rotemina.app.widgets.style.theme import DARK, LIGHT
from rotemina.plugins.view3d.panel import make_scene
from rotemina.sim.robot_files import load_robot

PANELS = ("comparison",)

LONG_MS = 30_000
LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton


@pytest.fixture
def panel(qtbot, window):
    panel = window.panels["view3d"]
    window.docks["view3d"].raise_()
    qtbot.waitUntil(lambda: panel.canvas.paint_count > 0, timeout=LONG_MS)
    return panel


def list_commands(panel, kind):
    return [
        command
        for command in panel.robot_scene.scene.get_changes().commands
        if command["type"] == kind
    ]


def get_matrix(panel, path):
    (command,) = (
        candidate
        for candidate in list_commands(panel, "set_transform")
        if candidate["path"] == path
    )
    return command["matrix"]


def list_server_threads():
    return [thread for thread in threading.enumerate() if thread.name == "3-D view"]


def drag_right(qtbot, canvas, button=LEFT):
    middle = canvas.rect().center()
    qtbot.mousePress(canvas, button, pos=middle)
    qtbot.mouseMove(canvas, middle + QPoint(40, 0))
    qtbot.mouseRelease(canvas, button, pos=middle + QPoint(40, 0))


def test_the_scene_follows_the_machine_and_its_controls_while_visible(qtbot, window, panel):
    canvas = panel.canvas
    qtbot.waitUntil(lambda: len(list_commands(panel, "set_transform")) == 10, timeout=LONG_MS)
    window.workbench.session.go_to({"x": 0.0285})
    for ghost in ("real", "model"):
        path = f"/robot/{ghost}/x"
        qtbot.waitUntil(
            lambda transform_path=path: abs(get_matrix(panel, transform_path)[12] - 0.0285) < 1e-6,
            timeout=LONG_MS,
        )
    assert list_commands(panel, "alive") == []  # sent to browsers only

    window.docks["comparison"].raise_()
    qtbot.waitUntil(lambda: not canvas.is_in_sight, timeout=LONG_MS)
    revision, painted = panel.robot_scene.scene.get_changes().revision, canvas.paint_count
    panel.refresh(window.workbench.session.snapshot())
    assert panel.robot_scene.scene.get_changes().revision == revision
    panel.magnification.setCurrentIndex(1)
    qtbot.wait(60)
    assert canvas.paint_count == painted
    window.docks["view3d"].raise_()
    qtbot.waitUntil(lambda: canvas.is_in_sight, timeout=LONG_MS)

    panel.views[SceneViewpoint.BELOW].click()
    assert list_commands(panel, "view")[0]["eye"][2] < 0
    qtbot.waitUntil(lambda: canvas.picture.camera.offset[2] < 0, timeout=LONG_MS)
    panel.magnification.setCurrentIndex(2)
    assert "50 ×" in list_commands(panel, "note")[0]["warnings"][0]
    panel.ghosts.setCurrentText("Model")
    assert list_commands(panel, "note")[0]["shown"] == ["model"]
    window.workbench.theme_changed.emit(LIGHT)  # without the slow change of the style sheet
    assert list_commands(panel, "note")[0]["colours"]["model"] == LIGHT.model
    qtbot.waitUntil(lambda: window.workbench.session.at_rest, timeout=LONG_MS)
    window.workbench.teach_floor()
    path = "/robot/bounds/floor"
    qtbot.waitUntil(
        lambda: any(command["path"] == path for command in list_commands(panel, "set_object")),
        timeout=LONG_MS,
    )


def test_the_mouse_rotates_pans_zooms_and_resets_the_view(qtbot, panel):
    canvas = panel.canvas
    home = canvas.picture.camera
    drag_right(qtbot, canvas)
    rotated = canvas.picture.camera
    assert rotated.offset[:2].tolist() != pytest.approx(home.offset[:2].tolist())
    assert rotated.offset[2] == pytest.approx(home.offset[2])
    drag_right(qtbot, canvas, RIGHT)
    panned = canvas.picture.camera
    assert panned.target.tolist() != pytest.approx(home.target.tolist())
    middle = QPointF(canvas.rect().center())
    wheel = QWheelEvent(
        middle, canvas.mapToGlobal(middle), QPoint(), QPoint(0, 120), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QGuiApplication.sendEvent(canvas, wheel)
    assert abs(canvas.picture.camera.offset).max() < abs(panned.offset).max()
    qtbot.mouseDClick(canvas, LEFT, pos=canvas.rect().center())
    assert canvas.picture.camera is home
    qtbot.mouseRelease(canvas, LEFT)


def test_only_a_visible_move_of_an_axis_redraws_the_picture(window, panel, monkeypatch):
    canvas, redraws = panel.canvas, []
    window.workbench.shown.disconnect(panel.refresh)
    state = window.workbench.session.snapshot()
    panel.refresh(state)
    old_image = canvas.grab().toImage()
    monkeypatch.setattr(canvas, "redraw", lambda: redraws.append(1))
    panel.refresh(state)
    moved_by_1_nm = state.measured | {"x": state.measured["x"] + 1e-9}
    panel.refresh(replace(state, measured=moved_by_1_nm))
    assert redraws == []
    moved_by_1_mm = state.measured | {"x": state.measured["x"] + 1e-3}
    panel.refresh(replace(state, measured=moved_by_1_mm))
    assert redraws == [1]
    assert canvas.grab().toImage() != old_image


def test_the_frame_rate_is_limited_to_25_per_second(qtbot, panel):
    canvas = panel.canvas
    for _ in range(20):  # draw the requests from the opening of the window first
        QGuiApplication.processEvents()
    painted, began_s = canvas.paint_count, time.monotonic()
    while time.monotonic() - began_s < 0.2:
        canvas.redraw()
        QGuiApplication.processEvents()
    assert 1 <= canvas.paint_count - painted <= 1 + 25 * (time.monotonic() - began_s)


def test_the_server_starts_on_request_and_the_browser_gets_the_address(
    qtbot, window, panel, monkeypatch, caplog
):
    assert panel.scene_server.server is None
    assert list_server_threads() == []
    opened = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: bool(opened.append(url)))
    panel.browser.click()
    assert "opened" in panel.browser.toolTip()
    qtbot.waitUntil(lambda: opened != [], timeout=LONG_MS)
    server = panel.scene_server.server
    assert opened[0].toString() == server.url
    # No browser could be opened. The address is secret, so notices and the log must not contain it.
    assert QGuiApplication.clipboard().text() == server.url
    notices = " ".join(notice.text for notice in window.notices.notices())
    assert "clipboard" in notices
    for text in (notices, caplog.text):
        assert server.url not in text
    # Browsers are also updated while the panel is hidden.
    window.docks["comparison"].raise_()
    qtbot.waitUntil(lambda: not panel.canvas.is_in_sight, timeout=LONG_MS)
    monkeypatch.setattr(type(server), "viewer_count", 1)
    panel.refresh(window.workbench.session.snapshot())
    assert list_commands(panel, "alive") != []
    assert len(list_server_threads()) == 1
    window.workbench.close()
    assert list_server_threads() == []


def test_a_robot_without_the_chain_gets_a_reason():
    scene, reason = make_scene(load_robot("emps"), DARK)
    assert scene is None
    assert "has no axis" in reason
