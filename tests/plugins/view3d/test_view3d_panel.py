"""The 3-D panel: nothing is started unasked, what is shown follows, and what it says."""

import threading

import pytest
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QDesktopServices, QGuiApplication
from PySide6.QtWidgets import QLabel

from rotemina.app.scene.views import View
from rotemina.app.shell.theme import DARK, LIGHT
from rotemina.plugins.view3d import embedding
from rotemina.plugins.view3d import panel as panel_module
from rotemina.plugins.view3d.panel import scene_of
from rotemina.sim.robot.file import load_robot

PANELS = ("comparison",)

LONG_MS = 30_000


class FakeProcess(QObject):
    """Stands for the process that draws the view in the window."""

    made = Signal(object)
    loaded = Signal()
    ended = Signal(str)
    stop_asked = Signal()
    latch_asked = Signal()
    last = None

    def __init__(self, parent):
        super().__init__(parent)
        FakeProcess.last = self
        self.url = None
        self.released = False

    def start(self, url):
        self.url = url

    def release(self, wait=False):
        self.released = True


@pytest.fixture
def panel(window, monkeypatch):
    monkeypatch.setattr(panel_module, "WebProcess", FakeProcess)
    monkeypatch.setattr(embedding, "why_not", lambda environment, user: None)
    panel = window.panels["view3d"]
    window.docks["view3d"].raise_()
    panel.show_state()
    return panel


@pytest.fixture
def opened(qtbot, panel):
    panel.here.click()
    assert "Starting" in panel.words.text()
    qtbot.waitUntil(lambda: panel._view is not None, timeout=LONG_MS)
    view = FakeProcess.last
    view.made.emit(QLabel("drawn"))
    view.loaded.emit()
    return panel


def newest(panel, kind):
    return [c for c in panel.robot_scene.scene.changes().commands if c["type"] == kind]


def pose(panel, path):
    (command,) = (c for c in newest(panel, "set_transform") if c["path"] == path)
    return command["matrix"]


def serving_threads():
    return [thread for thread in threading.enumerate() if thread.name == "3-D view"]


def test_it_is_opened_shown_steered_lost_and_opened_again(qtbot, window, opened, monkeypatch):
    panel, view = opened, FakeProcess.last
    server = panel.serving.server
    assert view.url == server.url
    assert panel.stack.currentWidget().text() == "drawn"
    assert panel.browser.isEnabled()

    # Nobody has connected, so nothing is computed; with a viewer it follows, unless out of sight.
    assert newest(panel, "alive") == []
    monkeypatch.setattr(type(server), "watching", 1)
    qtbot.waitUntil(lambda: len(newest(panel, "set_transform")) == 10, timeout=LONG_MS)
    window.workbench.session.go_to({"x": 0.0285})
    for ghost in ("real", "model"):
        path = f"/robot/{ghost}/x"
        qtbot.waitUntil(lambda p=path: abs(pose(panel, p)[12] - 0.0285) < 1e-6, timeout=LONG_MS)
    window.docks["comparison"].raise_()
    qtbot.waitUntil(lambda: not panel.in_sight, timeout=LONG_MS)
    revision = panel.robot_scene.scene.changes().revision
    panel.refresh(window.workbench.session.snapshot())
    assert panel.robot_scene.scene.changes().revision == revision
    window.docks["view3d"].raise_()
    qtbot.waitUntil(lambda: panel.in_sight, timeout=LONG_MS)

    # What the controls do.
    panel.views[View.BELOW].click()
    assert newest(panel, "view")[0]["eye"][2] < 0
    panel.factor.setCurrentIndex(2)
    assert "50 ×" in newest(panel, "note")[0]["warnings"][0]
    panel.ghosts.setCurrentText("Model")
    assert newest(panel, "note")[0]["shown"] == ["model"]
    window.workbench.theme_changed.emit(LIGHT)  # without the style sheet, which takes seconds
    assert newest(panel, "note")[0]["colours"]["model"] == LIGHT.model
    window.workbench.teach_floor()
    path = "/robot/bounds/floor"
    qtbot.waitUntil(
        lambda: any(c["path"] == path for c in newest(panel, "set_object")), timeout=LONG_MS
    )

    # Esc in the view stops; one that has ended takes nothing with it.
    view.latch_asked.emit()
    assert window.workbench.session.snapshot().latched is not None
    view.ended.emit("exit status -6")
    assert view.released
    assert "exit status -6" in panel.words.text()
    assert panel.stack.currentIndex() == 0
    panel.here.click()
    assert FakeProcess.last is not view
    assert FakeProcess.last.url == server.url
    assert len(serving_threads()) == 1
    window.workbench.close()
    assert FakeProcess.last.released
    assert serving_threads() == []


def test_nothing_is_started_unasked_and_the_browser_gets_the_address(
    qtbot, window, panel, monkeypatch, caplog
):
    assert panel.serving.server is None
    assert serving_threads() == []
    assert not panel.views[View.TOP].isEnabled()
    assert "open the view first" in panel.views[View.TOP].toolTip()
    reason = "Qt WebEngine is not installed; use the browser."
    monkeypatch.setattr(embedding, "why_not", lambda environment, user: reason)
    panel.show_state()
    assert not panel.here.isEnabled()
    assert reason in panel.words.text()
    opened = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: bool(opened.append(url)))
    panel.browser.click()
    qtbot.waitUntil(lambda: opened != [], timeout=LONG_MS)
    assert opened[0].toString() == panel.serving.server.url
    # None could be opened: the address is a secret, and stays out of notices and the log.
    assert QGuiApplication.clipboard().text() == panel.serving.server.url
    notices = " ".join(notice.text for notice in window.notices.notices())
    assert "clipboard" in notices
    for text in (notices, caplog.text):
        assert panel.serving.server.url not in text
    assert panel.views[View.TOP].isEnabled()


def test_a_robot_without_the_chain_gets_a_reason():
    scene, reason = scene_of(load_robot("emps"), DARK)
    assert scene is None
    assert "missing" in reason
