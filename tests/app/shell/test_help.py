"""Palette, keys, log page and support bundle, and every action of the window."""

import re
import zipfile

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QGuiApplication
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QDoubleSpinBox,
    QFileDialog,
    QInputDialog,
    QLineEdit,
    QPushButton,
    QScrollBar,
    QSpinBox,
    QTabBar,
    QWidget,
)

from rotemina.app.motion.state import Connection
from rotemina.app.panel import offer_in_palette
from rotemina.app.shell import key_help
from rotemina.app.shell import theme as themes
from rotemina.app.shell.workbench import Level
from rotemina.app.widgets.controls import allow

LONG_MS = 30_000
CONTROLS = (QAbstractButton, QAbstractSlider, QAbstractSpinBox, QComboBox, QLineEdit)
PARTS_OF = (QAbstractSpinBox, QComboBox, QLineEdit, QTabBar)
UNIT = re.compile(r"(?<=[ ,])(mm/s|µm/s|mm|µm|µrad|ms|Hz|1/h|s|%)$")
LIMIT = re.compile(r"\d to [\d.]|above 0|at most \d|within its range")


@pytest.fixture
def silent(monkeypatch):
    """No dialog waits for an answer."""
    monkeypatch.setattr(QFileDialog, "show", lambda dialog: dialog.close())
    monkeypatch.setattr(QInputDialog, "show", lambda dialog: dialog.close())


def all_actions(menu):
    for action in menu.actions():
        if action.menu() is not None:
            yield from all_actions(action.menu())
        elif not action.isSeparator():
            yield action


def test_every_action_of_every_menu_and_of_the_palette(qtbot, window, silent, monkeypatch):
    clicked, dressed = [], []
    # Panels test what their own buttons do. (A bound method would not be given the button.)
    monkeypatch.setattr(QPushButton, "click", lambda button: clicked.append(button))
    monkeypatch.setattr(themes, "dress", lambda _, theme, scale: dressed.append((theme, scale)))
    texts = {command.text for command in window.commands()}
    seen = set()
    for action in all_actions(window.menuBar()):
        if action.text() != "&Quit":
            action.trigger()
            seen.add(action.text())
    assert texts - {"&Quit"} <= seen
    assert {dock.windowTitle() for dock in window.docks.values()} <= seen
    assert {theme for theme, _ in dressed} == set(themes.THEMES.values())
    assert len({scale for _, scale in dressed}) > 1
    bench = window.workbench
    bench.release()
    bench.reconnect()  # the menu has disconnected it
    connected = Connection.CONNECTED
    qtbot.waitUntil(lambda: bench.session.snapshot().connection is connected, timeout=LONG_MS)
    window.palette_page.hide()
    offered = list(window._entries())
    for entry in offered:
        assert entry.where
        assert entry.what.strip(": ") == entry.what != ""
    assert texts <= {command.text for command in window.commands()}
    done = 0
    for entry in offered[len(texts) :]:  # the commands were just triggered
        if entry.why_not is None:
            entry.run()
            done += 1
    assert done > len(clicked) + len(window.docks)
    assert clicked
    assert window.isVisible()
    qtbot.waitUntil(lambda: not window.workbench.busy, timeout=LONG_MS)


def test_the_palette_finds_explains_and_does_by_keys_alone(qtbot, window):
    bench, palette = window.workbench, window.palette_page
    panel = window.panels["faults"]
    able, unable = QPushButton("Zebra crossing …", panel), QPushButton("Zebra stripes", panel)
    offer_in_palette(able, unable, safe_while_hidden=True)
    allow(able, None, "Go")
    allow(unable, "there is no zebra", "Go")
    pressed = []
    able.clicked.connect(lambda: pressed.append("able"))
    unable.clicked.connect(lambda: pressed.append("unable"))
    for button in (able, unable):
        button.show()
    window.docks["faults"].close()
    window.toggle_palette()
    assert palette.isVisible()
    qtbot.keyClicks(palette.field, "zeb")
    assert [entry.what for entry in palette._shown] == ["Zebra crossing", "Zebra stripes"]
    qtbot.keyClick(palette.field, Qt.Key.Key_Down)
    assert palette.reason.text() == "Not now: there is no zebra."
    assert "there is no zebra" in palette.list.item(1).text()
    qtbot.keyClick(palette.field, Qt.Key.Key_Return)
    assert pressed == []
    assert palette.isVisible()
    qtbot.keyClick(palette.field, Qt.Key.Key_Up)
    qtbot.keyClick(palette.field, Qt.Key.Key_Return)
    assert pressed == ["able"]
    assert palette.isHidden()
    assert not window.docks["faults"].isHidden()  # the panel that it acts in is shown
    window.toggle_palette()
    assert palette.field.text() == ""
    qtbot.keyClicks(palette.field, "back previous position")
    assert palette.reason.text() == "Not now: there is no previous position."
    palette.field.setText("qqqqq")
    assert palette.list.count() == 0
    assert "No command" in palette.reason.text()
    window.toggle_palette()
    assert palette.isHidden()
    session = bench.session
    session.jog("x", 1e-5)
    qtbot.waitUntil(lambda: session.undoable and not session.snapshot().owners, timeout=LONG_MS)
    undo = next(e for e in window._entries() if e.what.startswith("Back to the previous"))
    assert undo.why_not is None
    there = session.snapshot().command["x"]
    undo.run()
    qtbot.waitUntil(lambda: session.snapshot().command["x"] < there - 0.9e-5, timeout=LONG_MS)


def test_the_pages_of_help(qtbot, window, tmp_path):
    every_control_says_what_it_does_with_unit_and_limits(window)
    keys_are_those_of_the_actions_and_no_two_are_alike(window)
    the_log_page_filters_follows_and_copies(window)
    the_support_bundle_is_shown_before_it_is_written(qtbot, window, tmp_path)


def every_control_says_what_it_does_with_unit_and_limits(window):
    state = window.workbench.session.snapshot()
    silent, boundless = [], []
    for name, panel in dict(window.panels).items():
        window.bring_up(name)
        pages = {"microscope": lambda p: p.bar.tools, "control": lambda p: p.tabs}.get(name)
        for page in range(pages(panel).count() if pages else 1):
            if pages:
                pages(panel).setCurrentIndex(page)
            window.workbench.refreshed.emit(state)
            window.workbench.shown.emit(state)
        for control in controls_of(panel):
            what, tip = f"{name}: {control.accessibleName()}", control.toolTip()
            if not tip:
                silent.append(f"{what} {getattr(control, 'text', str)()}")
            if not tells_limits(control, tip):
                boundless.append(f"{what}: {tip}")
    assert silent == []
    assert boundless == []


def controls_of(panel):
    for control in panel.findChildren(QWidget):
        bare = type(control) in (QAbstractButton, QScrollBar)  # the corner of a table
        if (
            isinstance(control, CONTROLS)
            and not bare
            and not isinstance(control.parent(), PARTS_OF)
        ):
            yield control


def tells_limits(control, tip):
    if isinstance(control, QSpinBox | QDoubleSpinBox):
        return all(f"{end:.7g}" in tip for end in (control.minimum(), control.maximum()))
    unit = UNIT.search(control.accessibleName())
    if unit is None or not isinstance(control, QLineEdit):
        return True
    return unit[0] in tip and LIMIT.search(tip) is not None


def keys_are_those_of_the_actions_and_no_two_are_alike(window):
    rows = key_help.keys(window.findChildren(QAction))
    found = [key for key, _ in rows]
    assert len(found) == len(set(found))
    assert (
        "Shift+Esc",
        "Stop and lock: nothing moves until release; a software stop",
    ) in rows
    given = {command.shortcut for command in window.commands() if command.shortcut}
    assert given <= set(found)
    window.show_keys()
    page = window.findChild(key_help.KeyHelp)
    assert "Ctrl+Shift+P" in page.table.text()
    page.close()


def the_log_page_filters_follows_and_copies(window):
    bench, page = window.workbench, window.log_page
    window.show_log()
    bench.notify(Level.GOOD, "all is well")
    bench.notify(Level.ERROR, "the <b>line</b> is cut\nsecond line")
    bench.go_to({"x": 99.0})  # a command that is refused
    page.refresh()
    top = page.model.index(0, 3).data()
    assert "99" in top
    page.words.setText("LINE cut")
    assert page.model.rowCount() == 1
    assert page.model.index(0, 2).data() == "window"
    assert page.model.index(0, 3).data() == "the <b>line</b> is cut"
    page.copy.click()
    assert QGuiApplication.clipboard().text().endswith("is cut\n    second line")
    page.words.clear()
    page.level.setCurrentIndex(2)
    assert page.model.rowCount() == 2
    page.table.selectRow(1)
    page.copy.click()
    assert "second line" in QGuiApplication.clipboard().text()
    assert top not in QGuiApplication.clipboard().text()
    page.words.setText("nobody ever said that")
    assert not page.copy.isEnabled()
    page.close()


def the_support_bundle_is_shown_before_it_is_written(qtbot, window, tmp_path):
    window.workbench.notify(Level.INFO, f"opened {tmp_path.home()}/secret.csv")
    window.show_support()
    page = window._support
    assert not page.save.isEnabled()
    qtbot.waitUntil(page.save.isEnabled, timeout=LONG_MS)
    assert page.list.count() == 5
    assert "secret.csv" in page.view.toPlainText()
    assert str(tmp_path.home()) + "/" not in page.view.toPlainText()
    target = tmp_path / "bundle.zip"
    page.write(target)
    qtbot.waitUntil(lambda: "Saved" in window.notices.notices()[0].text, timeout=LONG_MS)
    with zipfile.ZipFile(target) as archive:
        assert set(archive.namelist()) == {item.name for item in page.items}
    QApplication.processEvents()


def test_the_name_of_a_panel_finds_it_before_anything_in_it(window):
    palette = window.palette_page
    window.toggle_palette()
    for dock in window.docks.values():
        palette.field.setText(dock.windowTitle().lower())
        assert palette._shown[0].text == f"Panel: {dock.windowTitle()}"
    window.toggle_palette()


def test_recent_files_are_offered_while_they_are_there(window, settings, tmp_path):
    menu = window.recent_files
    assert not menu.actions()[0].isEnabled()
    paths = [tmp_path / f"{number}.csv" for number in range(11)]
    for path in paths:
        path.touch()
        menu.add("record", path)
    menu.add("record", paths[5])
    paths[9].unlink()
    menu.fill()
    shown = [action.text()[4:] for action in menu.actions()]
    assert shown == [f"record: {n}.csv" for n in (5, 10, 8, 7, 6, 4, 3, 2)]
    settings.set("files.recent", "nonsense\nrecord\t\nother\tx.csv")
    assert menu.listed == []
