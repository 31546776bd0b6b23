"""Starts ``rotemina`` unchanged, and answers questions of a test about its widgets.

Each line on standard input is a Python expression; its value is printed as a line of JSON. The
expressions only read: the test operates the window by mouse and keyboard.
"""

import json
import os
import sys

from PySide6.QtCore import QSocketNotifier
from PySide6.QtWidgets import QApplication, QComboBox, QLineEdit, QPushButton  # noqa: F401 (for expressions)

from rotemina.app.cli.main import main
from rotemina.app.shell.window import MainWindow

_original_show_event = MainWindow.showEvent


def locate(widget, point=None):
    """Return the screen position of a widget's centre or of a point of it; None if invisible."""
    position = widget.rect().center() if point is None else point
    if not widget.isVisible() or not widget.visibleRegion().contains(position):
        return None
    screen_position = widget.mapToGlobal(position)
    return screen_position.x(), screen_position.y()


def find_dialog(title):
    """Return the visible dialog with this title, or None."""
    for widget in QApplication.topLevelWidgets():
        if widget.isVisible() and widget.windowTitle() == title:
            return widget
    return None


def read_file_name(title):
    """Return the text of the file name field of a dialog."""
    return find_dialog(title).findChild(QLineEdit, "fileNameEdit").text()


def locate_button(title, text):
    """Return the screen position of a button of a dialog, or None."""
    shown_dialog = find_dialog(title)
    for push_button in shown_dialog.findChildren(QPushButton) if shown_dialog is not None else ():
        if push_button.text().replace("&", "") == text:
            return locate(push_button)
    return None


def locate_item(menu, text):
    """Return the screen position of an item of an open menu, or None."""
    for action in menu.actions():
        if menu.isVisible() and action.text() == text:
            position = menu.mapToGlobal(menu.actionGeometry(action).center())
            return position.x(), position.y()
    return None


def show_event(window, event):
    """Start answering when the window is first shown."""
    _original_show_event(window, event)
    if hasattr(window, "_expression_notifier"):
        return
    names = {**globals(), "window": window, "bench": window.workbench, "panels": window.panels}

    def answer():
        line = os.read(0, 65536).decode()
        if not line:
            window._expression_notifier.setEnabled(False)
        for expression in filter(None, line.split("\n")):
            print(json.dumps(eval(expression, names)), flush=True)  # noqa: S307 (from the test)

    window._expression_notifier = QSocketNotifier(0, QSocketNotifier.Type.Read, window)
    window._expression_notifier.activated.connect(answer)


MainWindow.showEvent = show_event
sys.exit(main(sys.argv[1:]))
