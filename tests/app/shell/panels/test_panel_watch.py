"""A third-party panel that fails while the window is open is named and left out; ours stay."""

import gc
import logging
import sys
import threading
from types import ModuleType

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtWidgets import QDockWidget, QLabel, QMainWindow, QTabWidget, QWidget
from shiboken6 import isValid

from rotemina.app.shell.panels import PanelWatch
from rotemina.app.shell.panels.panel_watch import MAX_FAULTS
from rotemina.app.shell.startup.exit_guard import ExitRefusedError, refuse_exits
from rotemina.app.workbench import Level

THIRD_PARTY_MODULE = """
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


def make_module(name):
    """Create a module as if it came from another package."""
    module = ModuleType(name)
    exec(compile(THIRD_PARTY_MODULE, name, "exec"), vars(module))  # noqa: S102
    return module


@pytest.fixture
def make_window(qtbot):
    """Make a watched window with two panels, one in a dock and one in a tab."""
    watches = []

    def build(package="others_panels", *, one_module=False):
        window = QMainWindow()
        qtbot.addWidget(window)
        module = make_module(f"{package}.panel")
        second = module.Other if one_module else make_module("second_panels").Fragile
        docked, tabbed = module.Fragile("docked"), second("tabbed")
        dock, tabs = QDockWidget("docked"), QTabWidget()
        dock.setWidget(docked)
        tabs.addTab(QLabel("ours"), "ours")
        tabs.addTab(tabbed, "tabbed")
        window.setCentralWidget(tabs)
        window.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, dock)
        reports = []
        panels, docks = {"docked": docked, "tabbed": tabbed}, {"docked": dock}
        watch = PanelWatch(window, panels, docks, lambda *args: reports.append(args))
        watch.install()
        watches.append(watch)
        window.show()
        return window, panels, docks, reports

    yield build
    for watch in watches:
        watch.remove()


def settle():
    for _ in range(3):  # due events, the events they post, and deferred deletions
        QCoreApplication.processEvents()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


@pytest.mark.parametrize("leaves_a_painter", [False, True])
def test_a_panel_that_cannot_paint_is_left_out_at_once(make_window, leaves_a_painter):
    window, panels, docks, reports = make_window()
    bad = panels["docked"]
    bad.paints_badly, bad.leaves_a_painter = True, leaves_a_painter
    bad.repaint()
    settle()
    ((level, text),) = reports
    assert level is Level.ERROR
    assert "'docked' is left out" in text
    assert "ValueError: no colour" in text
    assert not isValid(bad)
    assert docks == {}
    assert list(panels) == ["tabbed"]
    assert window.findChildren(QDockWidget) == []
    assert not (leaves_a_painter and bad.painter.isActive())


def test_of_two_panels_in_one_module_only_the_failing_one_is_left_out(make_window):
    _, panels, _, reports = make_window(one_module=True)
    panels["tabbed"].paints_badly = True
    panels["tabbed"].parentWidget().parentWidget().setCurrentIndex(1)
    panels["tabbed"].repaint()
    settle()
    assert "'tabbed' is left out" in reports[0][1]
    assert list(panels) == ["docked"]


def test_a_panel_is_left_out_after_several_faults_in_slots_and_timers(make_window):
    _, panels, _, reports = make_window()
    bad = panels["tabbed"]
    tabs, error = bad.parentWidget().parentWidget(), catch_error(bad.click)
    for _ in range(MAX_FAULTS):
        assert isValid(bad)
        bad.tick()
        settle()
    assert [level for level, _ in reports] == [Level.WARNING, Level.ERROR]
    assert f"after {MAX_FAULTS} faults: KeyError: 'thy'" in reports[-1][1]
    assert not isValid(bad)
    assert [tabs.tabText(number) for number in range(tabs.count())] == ["ours"]
    assert list(panels) == ["docked"]
    sys.excepthook(*error)  # what is left of it may fail again
    settle()
    assert len(reports) == 2


def catch_error(call):
    try:
        call()
    except Exception as error:
        return type(error), error, error.__traceback__
    raise AssertionError("nothing was raised")


def test_an_error_in_an_event_within_a_guarded_call_is_noted(make_window):
    window, panels, docks, reports = make_window()
    panels["docked"].paints_badly = True
    watch = PanelWatch(window, panels, docks, lambda *args: reports.append(args))
    with watch.guard():
        panels["docked"].grab()
    settle()
    assert "'docked' is left out" in reports[0][1]
    with pytest.raises(ZeroDivisionError), watch.guard():
        _ = 1 / 0


@pytest.mark.parametrize("package", ["rotemina.plugins.control", "rotemina.app.shell"])
def test_built_in_panels_stay_and_their_faults_are_reported_once(make_window, caplog, package):
    _, panels, docks, reports = make_window(package)
    error = catch_error(panels["docked"].click)
    for _ in range(5):
        sys.excepthook(*error)
    assert (list(panels), list(docks)) == (["docked", "tabbed"], ["docked"])
    ((level, text),) = reports
    assert (level, "KeyError: 'thy'" in text) == (Level.ERROR, True)
    first, *later = caplog.records
    assert first.exc_info[1] is error[1]
    assert [(record.levelno, record.args[0]) for record in later] == [
        (logging.ERROR, 2),
        (logging.ERROR, 4),
    ]


def test_errors_in_threads_and_in_garbage_collection_are_reported_by_the_window(make_window):
    _, panels, _, reports = make_window()
    for call in (panels["docked"].click, sys.exit):  # a thread may end with sys.exit
        thread = threading.Thread(target=call)
        thread.start()
        thread.join()
    assert reports == []  # the window's thread reports it
    settle()
    assert "Panel 'docked' has failed: KeyError" in reports[0][1]

    class RaisesOnDeletion:
        def __del__(self, click=panels["tabbed"].click):
            click()

    RaisesOnDeletion()
    gc.collect()
    settle()
    assert ["Panel 'tabbed' has failed: KeyError" in text for _, text in reports] == [False, True]


def test_a_call_that_would_end_the_program_is_a_fault_of_the_panel(make_window):
    _, panels, _, reports = make_window()
    before = sys.exit, exit, quit
    with refuse_exits():
        sys.excepthook(*catch_error(panels["docked"].leave))
        for call in (exit, quit):
            with pytest.raises(ExitRefusedError, match=r"exit\(None\)"):
                call()
    assert (sys.exit, exit, quit) == before
    assert "'docked' has failed: ExitRefusedError: it called exit(3)" in reports[0][1]


def test_a_panel_without_a_dock_is_removed(make_window, qtbot):
    _, panels, _, _ = make_window()
    panel = panels["tabbed"]
    parent = QWidget()
    qtbot.addWidget(parent)
    panel.setParent(parent)
    panel.show()
    panel.paints_badly = True
    parent.show()
    settle()
    assert not isValid(panel)
