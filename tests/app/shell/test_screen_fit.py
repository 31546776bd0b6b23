"""No window is larger than the room on its screen, its frame included."""

import pytest
from PySide6.QtCore import QRect, QSize
from PySide6.QtWidgets import QApplication, QWidget

from rotemina.app.shell.main_window import MainWindow
from rotemina.app.shell.screen_fit import fit_on_screen

ROOM = QRect(100, 30, 1024, 690)  # next to a task bar


class SmallScreen:
    """A screen with a task bar at its left and its top."""

    def availableGeometry(self):  # noqa: N802 (Qt's name)
        return ROOM

    def size(self):
        return QSize(1124, 720)


class OnSmallScreen(QWidget):
    """A window on that screen."""

    def screen(self):
        return SmallScreen()


@pytest.mark.parametrize(
    "place",
    [(0, 0, 1600, 1200), (900, 500, 1000, 600), (-50, -50, 3000, 500), (200, 100, 800, 600)],
)
def test_a_window_with_its_frame_is_moved_and_shrunk_into_the_room(qtbot, place):
    window = OnSmallScreen()
    qtbot.addWidget(window)
    window.setGeometry(*place)
    window.show()
    QApplication.processEvents()
    fit_on_screen(window)
    assert window.frameGeometry().size() != window.size()
    assert ROOM.contains(window.frameGeometry())
    if place == (200, 100, 800, 600):
        assert window.geometry().getRect() == place


def test_a_window_that_takes_the_whole_screen_is_left(qtbot):
    window = OnSmallScreen()
    qtbot.addWidget(window)
    window.resize(1500, 900)
    window.showMaximized()
    before = window.geometry()
    fit_on_screen(window)
    assert window.geometry() == before
    assert window.isMaximized()


def test_geometry_of_a_larger_screen_is_brought_back_on_a_smaller_one(
    make_robot_window, monkeypatch
):
    first = make_robot_window()
    first.resize(1900, 1040)
    QApplication.processEvents()
    first.arrangement.remember()
    monkeypatch.setattr(MainWindow, "screen", lambda _: SmallScreen())
    second = make_robot_window()
    for _ in range(5):
        QApplication.processEvents()
    assert ROOM.contains(second.frameGeometry())
    assert second.minimumSize().width() <= 1024
    assert second.rect().contains(
        second.stop_button.mapTo(second, second.stop_button.rect().bottomRight())
    )
