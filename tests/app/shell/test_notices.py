"""Notices: where they stand, how long they stay, and that nothing moves for them."""

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QApplication, QMainWindow, QWidget

from rotemina.app.shell.notices import NoticeBar
from rotemina.app.shell.workbench import Level


class Clock:
    """A clock that the test sets."""

    now_s = 100.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def window(qtbot):
    made = QMainWindow()
    qtbot.addWidget(made)
    made.setCentralWidget(QWidget())
    made.statusBar()
    made.resize(1280, 800)
    made.show()
    return made


@pytest.fixture
def notices(window):
    """Notices with no mouse over them."""
    made = NoticeBar(window, Clock())
    made._mouse = lambda: QPoint(-1, -1)
    return made


def texts(notices):
    return [one.text for one in notices.notices()]


def test_they_stand_over_the_lower_right_and_move_nothing(window, notices):
    QApplication.processEvents()
    before = window.centralWidget().geometry()
    for number in range(5):
        notices.show_notice(Level.ERROR, f"fault {number}, which takes more than one line " * 3)
    QApplication.processEvents()
    assert window.centralWidget().geometry() == before
    seen = [one for one in notices.notices() if one.isVisible()]
    assert [one.text[:7] for one in seen] == ["fault 4", "fault 3", "fault 2"]
    assert all(one.findChild(QWidget).height() > 0 for one in seen)
    assert notices.more.text() == "+2 more"
    for width in (1920, 1280):
        window.resize(width, 800)
        place = notices.geometry()
        assert width - 16 <= place.right() < width
        assert place.bottom() < window.statusBar().geometry().top()
        assert place.height() < 300


def test_each_goes_when_it_has_served_and_a_fault_when_it_is_closed(notices):
    clock = notices._clock
    for level in (Level.GOOD, Level.WARNING, Level.ERROR):
        notices.show_notice(level, str(level))
    notices.show_notice(Level.ERROR, "error")
    assert [one.count for one in notices.notices()] == [2, 1, 1]
    notices.act()  # by the action that caused it
    clock.now_s += 5.9
    notices.let_go()
    assert texts(notices) == ["error", "warning", "good"]
    clock.now_s += 0.2
    notices._mouse = notices.geometry().center
    notices.let_go()
    assert texts(notices) == ["error", "warning", "good"]  # while the mouse is over them
    notices._mouse = lambda: QPoint(-1, -1)
    notices.let_go()
    assert texts(notices) == ["error", "warning"]
    notices.act()
    assert texts(notices) == ["error"]
    notices.notices()[0].closed.emit()
    assert not notices.isVisible()


def test_none_comes_up_under_the_mouse(notices):
    notices._mouse = lambda: QPoint(1100, 760)
    notices.show_notice(Level.ERROR, "here")
    assert notices.geometry().right() < 640
