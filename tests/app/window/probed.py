"""Starts ``rotemina`` as it is, and tells a test where its widgets are and what they show.

Each line on standard input is an expression of Python; its value comes back as a line of JSON. It
is for looking only: what is done to the window is done by mouse and keyboard.
"""

import json
import os
import sys

from PySide6.QtCore import QSocketNotifier
from PySide6.QtWidgets import QApplication, QComboBox, QLineEdit, QPushButton  # noqa: F401 (asked for)

from rotemina.app.cli.main import main
from rotemina.app.shell.main_window import MainWindow

_shown = MainWindow.showEvent


def place(widget, point=None):
    """Return where the middle of a widget, or a point of it, is on the screen; None if unseen."""
    at = widget.rect().center() if point is None else point
    if not widget.isVisible() or not widget.visibleRegion().contains(at):
        return None
    where = widget.mapToGlobal(at)
    return where.x(), where.y()


def dialog(title):
    """Return the dialog of this title that is seen, or None."""
    for one in QApplication.topLevelWidgets():
        if one.isVisible() and one.windowTitle() == title:
            return one
    return None


def written(title):
    """Return what stands in the field for a file's name of a dialog."""
    return dialog(title).findChild(QLineEdit, "fileNameEdit").text()


def button(title, text):
    """Return where a button of a dialog is on the screen, or None."""
    found = dialog(title)
    for one in found.findChildren(QPushButton) if found is not None else ():
        if one.text().replace("&", "") == text:
            return place(one)
    return None


def item(menu, text):
    """Return where an item of an open menu is on the screen, or None."""
    for action in menu.actions():
        if menu.isVisible() and action.text() == text:
            at = menu.mapToGlobal(menu.actionGeometry(action).center())
            return at.x(), at.y()
    return None


def show_event(window, event):
    """Begin to answer when the window is first shown."""
    _shown(window, event)
    if hasattr(window, "_asked"):
        return
    names = {**globals(), "window": window, "bench": window.workbench, "panels": window.panels}

    def answer():
        line = os.read(0, 65536).decode()
        if not line:
            window._asked.setEnabled(False)
        for expression in filter(None, line.split("\n")):
            print(json.dumps(eval(expression, names)), flush=True)  # noqa: S307 (the test's own)

    window._asked = QSocketNotifier(0, QSocketNotifier.Type.Read, window)
    window._asked.activated.connect(answer)


MainWindow.showEvent = show_event
sys.exit(main(sys.argv[1:]))
