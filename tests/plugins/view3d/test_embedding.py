"""Whether the view may stand in the window, the process that draws it, and one in earnest."""

import importlib.util
import os
import sys
import textwrap

import pytest

from rotemina.app.scene.robot_scene import Colours, Reading, RobotScene
from rotemina.app.scene.server import ViewServer
from rotemina.plugins.view3d import embedding
from rotemina.plugins.view3d.embedding import WebProcess, why_not
from rotemina.sim.robot.file import load_robot

LONG_MS = 30_000
ADDRESS = "http://127.0.0.1:1/secret/"
WEB_ENGINE = importlib.util.find_spec("PySide6.QtWebEngineWidgets") is not None


@pytest.fixture
def make_process(qtbot, qapp, monkeypatch, tmp_path):
    """Start processes that do what a script says in place of showing a page."""
    made = []

    def make(script):
        path = tmp_path / "child.py"
        path.write_text(textwrap.dedent(script), "utf-8")
        monkeypatch.setattr(embedding, "_COMMAND", (str(path),))
        process = WebProcess(qapp)
        made.append(process)
        return process

    yield make
    for process in made:
        process.release(wait=True)


def test_without_web_engine_it_is_said_how_to_get_it(monkeypatch):
    monkeypatch.setattr(embedding, "find_spec", lambda name: None)
    assert "rotemina[view3d]" in why_not({}, 1000)


def test_root_is_sent_to_the_browser_unless_the_sandbox_is_off(monkeypatch):
    monkeypatch.setattr(embedding, "find_spec", lambda name: object())
    assert "root" in why_not({}, 0)
    assert why_not({"QTWEBENGINE_DISABLE_SANDBOX": "1"}, 0) is None
    assert why_not({}, 1000) is None
    assert why_not({}, None) is None  # no Unix


def test_the_process_has_the_address_from_its_input_and_is_heard(qtbot, make_process):
    process = make_process("""
        import sys
        assert sys.stdin.readline().strip().endswith("/secret/")
        assert "secret" not in " ".join(sys.argv)
        print("window 7", "loaded", "stop", "latch", sep="\\n", flush=True)
        sys.stdin.read()
    """)
    heard = []
    process.made.connect(heard.append)
    process.loaded.connect(lambda: heard.append("loaded"))
    process.stop_asked.connect(lambda: heard.append("stop"))
    with qtbot.waitSignal(process.latch_asked, timeout=LONG_MS):
        process.start(ADDRESS)
    assert heard == [None, "loaded", "stop"]  # offscreen it stays a window of its own


@pytest.mark.parametrize(
    "script", ["import os; os.abort()", "raise SystemExit(3)", "print('failed')"]
)
def test_one_that_breaks_off_says_so(qtbot, make_process, script):
    process = make_process(script)
    with qtbot.waitSignal(process.ended, timeout=LONG_MS):
        process.start(ADDRESS)


def test_one_that_hangs_is_ended_with_the_program(qtbot, make_process, monkeypatch):
    monkeypatch.setattr(embedding, "_ENDING_MS", 100)
    process = make_process("""
        import time
        print("loaded", flush=True)
        time.sleep(1000)
    """)
    with qtbot.waitSignal(process.loaded, timeout=LONG_MS):
        process.start(ADDRESS)
    process.release(wait=True)
    assert process._process.state() == process._process.ProcessState.NotRunning


@pytest.mark.slow
@pytest.mark.skipif(not WEB_ENGINE, reason="Qt WebEngine is not installed")
def test_web_engine_draws_the_scene(qtbot, qapp, monkeypatch):
    flags = "--use-angle=swiftshader --enable-unsafe-swiftshader --in-process-gpu"
    monkeypatch.setenv("QTWEBENGINE_CHROMIUM_FLAGS", f"--disable-gpu-compositing {flags}")
    if embedding.user_number() == 0:
        monkeypatch.setenv("QTWEBENGINE_DISABLE_SANDBOX", "1")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
    robot = load_robot("rotemina")
    colours = Colours("#1c2027", "#8b95a5", "#4c9be8", "#f0a35e", "#d93a3a")
    scene = RobotScene(robot, colours, old_s=0.5)
    centre = dict(zip(robot.axes, scene.chain.centre.tolist(), strict=True))
    server = ViewServer(scene.scene)
    server.start()
    process = WebProcess(qapp)
    try:
        process.start(server.url)
        qtbot.waitUntil(lambda: server.watching == 1, timeout=2 * LONG_MS)
        (viewer,) = server._viewers._all
        for step in range(20):  # each is sent only after the one before was drawn
            scene.show(Reading(centre | {"x": 1e-3 * step}, centre))
            before = viewer._seen
            server.changed()
            qtbot.waitUntil(lambda before=before: viewer._seen > before, timeout=LONG_MS)
    finally:
        process.release(wait=True)
        assert server.close()
