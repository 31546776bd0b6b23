"""A panel of another package is imported anew while the window is open."""

import sys
from importlib.metadata import EntryPoint

import pytest
from PySide6.QtCore import Qt
from shiboken6 import isValid

from rotemina.app.panel import Panel
from rotemina.app.shell import reloading
from rotemina.app.shell.panel_watch import PanelWatch
from rotemina.drivers.registry import load_class

PANELS = ()
LONG_MS = 20_000
PANEL = """
from rotemina.app.panel import Area, Panel

closed = []


class Lamp(Panel):
    title = "Lamp {number}"
    area = Area.LEFT

    def __init__(self, workbench):
        super().__init__(workbench)
        self.seen = 0
        self.follow(self.look)
        {makes}

    def look(self, state):
        self.seen += 1
        {looks}

    def closeEvent(self, event):
        closed.append({number})
"""


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Write the module of a panel ``lamp``, as a package of others would bring it."""
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    point = EntryPoint("lamp", "glass_lamp:Lamp", reloading.GROUP)
    monkeypatch.setattr(reloading, "entry_points", lambda group: [point])

    def write(number, makes="pass", looks="pass"):
        text = PANEL.format(number=number, makes=makes, looks=looks)
        (tmp_path / "glass_lamp.py").write_text(text, "utf-8")
        return point

    yield write
    sys.modules.pop("glass_lamp", None)


@pytest.fixture
def loaded(qtbot, window, write):
    """The window with the first version of the panel."""
    write(1)
    window.reloading.reload("lamp")
    qtbot.waitUntil(lambda: "lamp" in window.panels.made, timeout=LONG_MS)
    return window


def texts(window):
    return [one.text for one in window.notices.notices()]


def reload(qtbot, window):
    before = texts(window)
    window.reloading.reload("lamp")
    qtbot.waitUntil(lambda: texts(window) != before, timeout=LONG_MS)


def test_the_new_one_takes_the_place_of_the_old_one(qtbot, loaded, write):
    old, dock = loaded.panels["lamp"], loaded.docks["lamp"]
    assert dock.windowTitle() == "Lamp 1"
    closed = sys.modules["glass_lamp"].closed
    write(2)
    loaded.reload_menu.look()
    (action,) = loaded.reload_menu.actions()
    assert action.text() == "Reload lamp"
    action.trigger()
    qtbot.waitUntil(lambda: loaded.panels["lamp"] is not old, timeout=LONG_MS)
    new = loaded.panels["lamp"]
    assert loaded.docks["lamp"] is dock
    assert dock.widget().widget() is new
    assert dock.windowTitle() == "Lamp 2"
    assert closed == [1]
    qtbot.waitUntil(lambda: not isValid(old), timeout=LONG_MS)
    seen = new.seen
    qtbot.waitUntil(lambda: new.seen > seen, timeout=LONG_MS)  # and what is gone does not fail


def test_one_that_cannot_be_imported_leaves_the_old_one(qtbot, loaded, write):
    old, module = loaded.panels["lamp"], sys.modules["glass_lamp"]
    write(2, makes="for")
    reload(qtbot, loaded)
    assert "'lamp' is not reloaded" in texts(loaded)[0]
    assert "SyntaxError" in texts(loaded)[0]
    assert loaded.panels["lamp"] is old
    assert sys.modules["glass_lamp"] is module


def test_one_that_cannot_be_made_is_left_out_and_comes_back_by_its_notice(qtbot, loaded, write):
    write(2, makes="raise ValueError('no bulb')")
    reload(qtbot, loaded)
    assert texts(loaded)[0] == "Panel 'lamp' is left out: ValueError: no bulb"
    assert "lamp" not in loaded.panels
    assert "lamp" not in loaded.docks
    write(3)
    qtbot.mouseClick(loaded.notices.notices()[0].remedy, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: "lamp" in loaded.panels.made, timeout=LONG_MS)
    assert loaded.docks["lamp"].widget().widget() is loaded.panels["lamp"]


def test_faults_are_counted_anew(qtbot, window, write):
    kind = load_class(write(1), Panel)
    watch = PanelWatch(window, window.panels, window.docks, window.workbench.notify)
    watch.begin_with("lamp", kind)
    watch._faults["lamp"] = 2
    window.reloading.renewed.connect(watch.begin_with)
    window.reloading.reload("lamp")
    qtbot.waitUntil(lambda: "lamp" in window.panels.made, timeout=LONG_MS)
    assert watch._faults["lamp"] == 0


def test_nothing_is_imported_while_the_machine_moves(qtbot, loaded, write):
    old = loaded.panels["lamp"]
    write(2)
    loaded.workbench.session.go_to({"x": 0.03})
    qtbot.waitUntil(lambda: bool(loaded.workbench.session.snapshot().owners), timeout=LONG_MS)
    reload(qtbot, loaded)
    assert texts(loaded)[0].endswith("the machine is moving; stop it first")
    assert loaded.panels["lamp"] is old
    loaded.workbench.stop()
