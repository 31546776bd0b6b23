"""A third party's panel that fails while the window is open is named and left out; ours stay."""

import gc
import logging
import sys
import threading
from types import ModuleType

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtWidgets import QDockWidget, QLabel, QMainWindow, QTabWidget, QWidget
from shiboken6 import isValid

from rotemina.app.shell.exit_guard import ExitRefusedError, exits_refused
from rotemina.app.shell.panel_watch import MOST_FAULTS, PanelWatch
from rotemina.app.shell.workbench import Level

THEIRS = """
import sys

from PySide6.QtCore import QTimer
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QLabel


class Fragile(QLabel):
    paints_badly = False
    leaves_a_painter = False

    def paintEvent(self, event):
        if self.leaves_a_painter:
            self.painter = QPainter(self)
        if self.paints_badly:
            raise ValueError("no colour")

    def click(self):
        raise KeyError("thy")

    def leave(self):
        sys.exit(3)

    def tick(self):
        QTimer.singleShot(0, self, self.click)


class Other(QLabel):
    paints_badly = False

    def paintEvent(self, event):
        if self.paints_badly:
            raise ValueError("no colour")
"""


def module_of(name):
    """A module that was imported from elsewhere."""
    module = ModuleType(name)
    exec(compile(THEIRS, name, "exec"), vars(module))  # noqa: S102
    return module


@pytest.fixture
def make(qtbot):
    """Make a window with two panels, one in a dock and one in a tab, that is watched."""
    made = []

    def make(package="others_panels", *, one_module=False):
        window = QMainWindow()
        qtbot.addWidget(window)
        module = module_of(f"{package}.panel")
        second = module.Other if one_module else module_of("second_panels").Fragile
        docked, tabbed = module.Fragile("docked"), second("tabbed")
        dock, tabs = QDockWidget("docked"), QTabWidget()
        dock.setWidget(docked)
        tabs.addTab(QLabel("ours"), "ours")
        tabs.addTab(tabbed, "tabbed")
        window.setCentralWidget(tabs)
        window.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, dock)
        told = []
        panels, docks = {"docked": docked, "tabbed": tabbed}, {"docked": dock}
        watch = PanelWatch(window, panels, docks, lambda *said: told.append(said))
        watch.install()
        made.append(watch)
        window.show()
        return window, panels, docks, told

    yield make
    for watch in made:
        watch.remove()


def settle():
    for _ in range(3):  # what is due now, what that has asked for, and what is to be deleted
        QCoreApplication.processEvents()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_one_that_cannot_paint_is_left_out_at_once(make):
    window, panels, docks, told = make()
    bad = panels["docked"]
    bad.paints_badly = True
    bad.repaint()
    settle()
    ((level, text),) = told
    assert level is Level.ERROR
    assert "'docked' is left out" in text
    assert "ValueError: no colour" in text
    assert not isValid(bad)
    assert docks == {}
    assert list(panels) == ["tabbed"]
    assert window.findChildren(QDockWidget) == []


def test_a_painter_that_a_failed_paint_event_leaves_is_ended_before_qt_goes_on(make):
    _, panels, _, told = make()
    bad = panels["docked"]
    bad.paints_badly = bad.leaves_a_painter = True
    bad.repaint()
    settle()
    assert "'docked' is left out" in told[0][1]
    assert not bad.painter.isActive()


def test_of_two_in_one_module_the_one_that_fails_is_left_out(make):
    _, panels, _, told = make(one_module=True)
    panels["tabbed"].paints_badly = True
    panels["tabbed"].parentWidget().parentWidget().setCurrentIndex(1)
    panels["tabbed"].repaint()
    settle()
    assert "'tabbed' is left out" in told[0][1]
    assert list(panels) == ["docked"]


def test_one_that_fails_in_slots_and_timers_has_a_few_chances(make):
    _, panels, _, told = make()
    bad = panels["tabbed"]
    tabs = bad.parentWidget().parentWidget()
    for _ in range(MOST_FAULTS):
        assert isValid(bad)
        bad.tick()
        settle()
    assert [level for level, _ in told] == [Level.WARNING, Level.ERROR]
    assert f"after {MOST_FAULTS} faults: KeyError: 'thy'" in told[-1][1]
    assert not isValid(bad)
    assert [tabs.tabText(number) for number in range(tabs.count())] == ["ours"]
    assert list(panels) == ["docked"]


def raised(call):
    try:
        call()
    except Exception as error:
        return type(error), error, error.__traceback__
    raise AssertionError("nothing was raised")


def test_what_an_event_raises_within_a_call_is_noted(make):
    window, panels, docks, told = make()
    panels["docked"].paints_badly = True
    watch = PanelWatch(window, panels, docks, lambda *said: told.append(said))
    with watch.guarding():
        panels["docked"].grab()
    settle()
    assert "'docked' is left out" in told[0][1]
    with pytest.raises(ZeroDivisionError), watch.guarding():
        _ = 1 / 0


def test_what_is_left_of_a_panel_may_fail_in_silence(make):
    _, panels, _, told = make()
    bad = panels["docked"]
    seen = raised(bad.click)
    for _ in range(MOST_FAULTS + 5):
        sys.excepthook(*seen)
    settle()
    assert len(told) == 2


@pytest.mark.parametrize("package", ["rotemina.plugins.control", "rotemina.app.shell"])
def test_our_own_stay_and_their_faults_are_logged_and_told_once(make, caplog, package):
    _, panels, docks, told = make(package)
    seen = raised(panels["docked"].click)
    for _ in range(5):
        sys.excepthook(*seen)
    assert (list(panels), list(docks)) == (["docked", "tabbed"], ["docked"])
    ((level, text),) = told
    assert (level, "KeyError: 'thy'" in text) == (Level.ERROR, True)
    first, *later = caplog.records
    assert first.exc_info[1] is seen[1]
    assert [(one.levelno, one.args[0]) for one in later] == [(logging.ERROR, 2), (logging.ERROR, 4)]


def test_what_a_thread_of_a_panel_raises_is_told_on_the_window_s_thread(make):
    _, panels, _, told = make()
    for call in (panels["docked"].click, sys.exit):  # the latter is how a thread may end
        thread = threading.Thread(target=call)
        thread.start()
        thread.join()
    assert told == []
    settle()
    ((_, text),) = told
    assert "Panel 'docked' has failed: KeyError" in text


def test_what_a_panel_raises_as_it_is_collected_is_told(make):
    _, panels, _, told = make()

    class Leaving:
        def __del__(self, click=panels["docked"].click):
            click()

    Leaving()
    gc.collect()
    settle()
    assert "Panel 'docked' has failed: KeyError" in told[0][1]


def test_a_call_that_would_end_the_program_is_a_fault_of_the_panel(make):
    _, panels, _, told = make()
    before = sys.exit, exit, quit
    with exits_refused():
        sys.excepthook(*raised(panels["docked"].leave))
        for call in (exit, quit):
            with pytest.raises(ExitRefusedError, match=r"exit\(None\)"):
                call()
    assert (sys.exit, exit, quit) == before
    assert "'docked' has failed: ExitRefusedError: it called exit(3)" in told[0][1]


def test_a_panel_that_stands_alone_is_taken_out(make, qtbot):
    _, panels, _, _ = make()
    alone = panels["tabbed"]
    parent = QWidget()
    qtbot.addWidget(parent)
    alone.setParent(parent)
    alone.show()
    alone.paints_badly = True
    parent.show()
    settle()
    assert not isValid(alone)
