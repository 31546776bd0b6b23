"""Palette, shortcuts, log page, support bundle and every action of the window."""

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

from rotemina.app.motion.state import ConnectionState
from rotemina.app.panel import offer_in_palette
from rotemina.app.shell.help import key_help
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.widgets.style import theme as themes
from rotemina.app.workbench import Level

LONG_MS = 30_000
CONTROLS = (QAbstractButton, QAbstractSlider, QAbstractSpinBox, QComboBox, QLineEdit)
COMPOSITE_CONTROLS = (QAbstractSpinBox, QComboBox, QLineEdit, QTabBar)
UNIT = re.compile(r"(?<=[ ,])(mm/s|µm/s|mm|µm|µrad|ms|Hz|1/h|s|%)$")
LIMIT = re.compile(r"\d to [\d.]|above 0|at most \d|within its range")


@pytest.fixture
def close_dialogs(monkeypatch):
    """Close every dialog at once."""
    monkeypatch.setattr(QFileDialog, "show", lambda dialog: dialog.close())
    monkeypatch.setattr(QInputDialog, "show", lambda dialog: dialog.close())


def iterate_actions(menu):
    for action in menu.actions():
        if action.menu() is not None:
            yield from iterate_actions(action.menu())
        elif not action.isSeparator():
            yield action


def test_every_menu_action_and_palette_entry_runs(qtbot, window, close_dialogs, monkeypatch):
    clicked_buttons, applied_themes = [], []
    # Each panel tests its own buttons. (A bound method would not receive the button.)
    monkeypatch.setattr(QPushButton, "click", lambda button: clicked_buttons.append(button))
    monkeypatch.setattr(
        themes, "apply_theme", lambda _, theme, scale: applied_themes.append((theme, scale))
    )
    texts = {command.text for command in window.make_commands()}
    triggered = set()
    for action in iterate_actions(window.menuBar()):
        if action.text() != "&Quit":
            action.trigger()
            triggered.add(action.text())
    assert texts - {"&Quit"} <= triggered
    assert {dock.windowTitle() for dock in window.docks.values()} <= triggered
    assert {theme for theme, _ in applied_themes} == set(themes.THEMES.values())
    assert len({scale for _, scale in applied_themes}) > 1
    bench = window.workbench
    bench.release()
    bench.reconnect()  # the menu has disconnected it
    connected = ConnectionState.CONNECTED
    qtbot.waitUntil(lambda: bench.session.snapshot().connection is connected, timeout=LONG_MS)
    window.palette_page.hide()
    entries = list(window._make_palette_entries())
    for entry in entries:
        assert entry.group
        assert entry.title.strip(": ") == entry.title != ""
    assert texts <= {command.text for command in window.make_commands()}
    run_count = 0
    for entry in entries[len(texts) :]:  # the commands were just triggered
        if entry.objection is None:
            entry.run()
            run_count += 1
    assert run_count > len(clicked_buttons) + len(window.docks)
    assert clicked_buttons
    assert window.isVisible()
    qtbot.waitUntil(lambda: not window.workbench.busy, timeout=LONG_MS)


def test_the_palette_works_by_keyboard_alone(qtbot, window):
    palette = window.palette_page
    panel = window.panels["faults"]
    enabled, disabled = QPushButton("Zebra crossing …", panel), QPushButton("Zebra stripes", panel)
    offer_in_palette(enabled, disabled, safe_while_hidden=True)
    enable_unless(enabled, None, "Go")
    enable_unless(disabled, "there is no zebra", "Go")
    pressed = []
    enabled.clicked.connect(lambda: pressed.append("enabled"))
    disabled.clicked.connect(lambda: pressed.append("disabled"))
    for button in (enabled, disabled):
        button.show()
    window.docks["faults"].close()
    window.toggle_palette()
    assert palette.isVisible()
    qtbot.keyClicks(palette.field, "zeb")
    assert [entry.title for entry in palette._shown] == ["Zebra crossing", "Zebra stripes"]
    qtbot.keyClick(palette.field, Qt.Key.Key_Down)
    assert palette.reason.text() == "Not now: there is no zebra."
    assert "there is no zebra" in palette.list.item(1).text()
    qtbot.keyClick(palette.field, Qt.Key.Key_Return)
    assert pressed == []
    assert palette.isVisible()
    qtbot.keyClick(palette.field, Qt.Key.Key_Up)
    qtbot.keyClick(palette.field, Qt.Key.Key_Return)
    assert pressed == ["enabled"]
    assert palette.isHidden()
    assert not window.docks["faults"].isHidden()  # the panel of the button is shown
    window.toggle_palette()
    assert palette.field.text() == ""
    qtbot.keyClicks(palette.field, "back previous position")
    assert palette.reason.text() == "Not now: there is no previous position."
    palette.field.setText("qqqqq")
    assert palette.list.count() == 0
    assert "No command" in palette.reason.text()
    window.toggle_palette()
    assert palette.isHidden()


def test_the_pages_of_help(qtbot, window, tmp_path):
    check_tooltips_give_unit_and_limits(window)
    check_shortcuts_are_unique(window)
    check_log_page(window)
    check_support_bundle(qtbot, window, tmp_path)


def check_tooltips_give_unit_and_limits(window):
    state = window.workbench.session.snapshot()
    without_tooltip, without_limits = [], []
    for name, panel in dict(window.panels).items():
        window.bring_up(name)
        pages = {"microscope": lambda p: p.bar.tools, "control": lambda p: p.tabs}.get(name)
        for page in range(pages(panel).count() if pages else 1):
            if pages:
                pages(panel).setCurrentIndex(page)
            window.workbench.refreshed.emit(state)
            window.workbench.shown.emit(state)
        for control in iterate_controls(panel):
            label, tip = f"{name}: {control.accessibleName()}", control.toolTip()
            if not tip:
                without_tooltip.append(f"{label} {getattr(control, 'text', str)()}")
            if not has_limits(control, tip):
                without_limits.append(f"{label}: {tip}")
    assert without_tooltip == []
    assert without_limits == []


def iterate_controls(panel):
    for control in panel.findChildren(QWidget):
        # The corner button of a table has no label.
        is_bare = type(control) in (QAbstractButton, QScrollBar)
        if (
            isinstance(control, CONTROLS)
            and not is_bare
            and not isinstance(control.parent(), COMPOSITE_CONTROLS)
        ):
            yield control


def has_limits(control, tip):
    if isinstance(control, QSpinBox | QDoubleSpinBox):
        return all(f"{end:.7g}" in tip for end in (control.minimum(), control.maximum()))
    unit = UNIT.search(control.accessibleName())
    if unit is None or not isinstance(control, QLineEdit):
        return True
    return unit[0] in tip and LIMIT.search(tip) is not None


def check_shortcuts_are_unique(window):
    rows = key_help.list_shortcuts(window.findChildren(QAction))
    shortcuts = [a for a in window.findChildren(QAction) if not a.shortcut().isEmpty()]
    # Otherwise a held key would play, pause and resume.
    assert [action.text() for action in shortcuts if action.autoRepeat()] == []
    listed_keys = [key for key, _ in rows]
    assert len(listed_keys) == len(set(listed_keys))
    assert ("Shift+Esc", "Stop and lock: nothing moves until release; a software stop") in rows
    command_keys = {command.shortcut for command in window.make_commands() if command.shortcut}
    assert command_keys <= set(listed_keys)
    window.show_keys()
    page = window.findChild(key_help.ShortcutsDialog)
    assert "Ctrl+Shift+P" in page.table.text()
    page.close()


def check_log_page(window):
    bench, page = window.workbench, window.log_page
    for _ in range(10):
        window.loop_watch.beat()
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
    assert page.lateness.text().startswith("Window delay:")
    page.close()


def check_support_bundle(qtbot, window, tmp_path):
    window.workbench.notify(Level.INFO, f"opened {tmp_path.home()}/secret.csv")
    window.show_support()
    page = window._support
    assert not page.save.isEnabled()
    qtbot.waitUntil(page.save.isEnabled, timeout=LONG_MS)
    assert page.list.count() == 5
    assert "secret.csv" in page.view.toPlainText()
    assert str(tmp_path.home()) + "/" not in page.view.toPlainText()
    (delays,) = [item.text for item in page.items if item.name == "window.json"]
    assert "late_99_percent_ms" in delays
    target = tmp_path / "bundle.zip"
    page.write(target)
    qtbot.waitUntil(lambda: "Saved" in window.notices.notices()[0].text, timeout=LONG_MS)
    with zipfile.ZipFile(target) as archive:
        assert set(archive.namelist()) == {item.name for item in page.items}
    QApplication.processEvents()


def test_recent_files_are_listed_while_they_exist(window, settings, tmp_path):
    menu = window.recent_files
    assert not menu.actions()[0].isEnabled()
    paths = [tmp_path / f"{number}.csv" for number in range(11)]
    for path in paths:
        path.touch()
        menu.add("record", path)
    menu.add("record", paths[5])
    paths[9].unlink()
    menu.fill()
    entries = [action.text()[4:] for action in menu.actions()]
    assert entries == [f"record: {n}.csv" for n in (5, 10, 8, 7, 6, 4, 3, 2)]
    settings.set("files.recent", "nonsense\nrecord\t\nother\tx.csv")
    assert menu.entries == []
