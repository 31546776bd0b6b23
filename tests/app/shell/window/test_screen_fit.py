"""No window, including its frame, is larger than the available area of its screen."""

import pytest
from PySide6.QtCore import QRect, QSize
from PySide6.QtWidgets import QApplication, QWidget

from rotemina.app.shell.window import MainWindow
from rotemina.app.shell.window.screen_fit import fit_on_screen

#: The screen area next to the task bar.
AVAILABLE_AREA = QRect(100, 30, 1024, 690)


class SmallScreen:
    """A screen with a task bar at its left and its top."""

    def availableGeometry(self):  # noqa: N802 (Qt's name)
        return AVAILABLE_AREA

    def size(self):
        return QSize(1124, 720)


class SmallScreenWindow(QWidget):
    """A window on the small screen."""

    def screen(self):
        return SmallScreen()


@pytest.mark.parametrize(
    "place",
    [(0, 0, 1600, 1200), (900, 500, 1000, 600), (-50, -50, 3000, 500), (200, 100, 800, 600)],
)
def test_a_window_is_moved_and_shrunk_with_its_frame(qtbot, place):
    window = SmallScreenWindow()
    qtbot.addWidget(window)
    window.setGeometry(*place)
    window.show()
    QApplication.processEvents()
    fit_on_screen(window)
    assert window.frameGeometry().size() != window.size()
    assert AVAILABLE_AREA.contains(window.frameGeometry())
    if place == (200, 100, 800, 600):
        assert window.geometry().getRect() == place


def test_a_maximised_window_is_not_changed(qtbot):
    window = SmallScreenWindow()
    qtbot.addWidget(window)
    window.resize(1500, 900)
    window.showMaximized()
    before = window.geometry()
    fit_on_screen(window)
    assert window.geometry() == before
    assert window.isMaximized()


def test_saved_geometry_of_a_larger_screen_fits_a_smaller_one(make_robot_window, monkeypatch):
    first = make_robot_window()
    first.resize(1900, 1040)
    QApplication.processEvents()
    first.arrangement.save_state()
    monkeypatch.setattr(MainWindow, "screen", lambda _: SmallScreen())
    second = make_robot_window()
    for _ in range(5):
        QApplication.processEvents()
    assert AVAILABLE_AREA.contains(second.frameGeometry())
    assert second.minimumSize().width() <= 1024
    assert second.rect().contains(
        second.stop_button.mapTo(second, second.stop_button.rect().bottomRight())
    )
