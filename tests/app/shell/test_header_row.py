"""What the header and the menu bar show in windows of every width; nothing stands on the stops."""

import pytest
from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QApplication

from rotemina.app.shell.layouts import DIAGNOSE, OPERATE
from rotemina.app.shell.workbench import Level

LONG_MS = 30_000
PANELS = ("gap", "job", "events")


def settle():
    for _ in range(5):
        QApplication.processEvents()


def resized(window, width, scale=1.0):
    window.workbench.settings.set("window.scale", scale)
    window.arrangement.dress()
    window.resize(width, 720)
    settle()
    return window._bar


def entries(button):
    button.menu().aboutToShow.emit()
    return {action.text(): action for action in button.menu().actions()}


def test_chips_are_dropped_one_by_one_and_listed(window):
    bar = resized(window, 1900)
    chips = (bar.owner, bar.events, bar.model)
    left = []
    for width in range(1900, 800, -20):
        resized(window, width)
        left.append([chip for chip in chips if chip.isVisible()])
        hidden = len(chips) - len(left[-1])
        if bar.row.dropped.isVisible():
            assert len(entries(bar.row.dropped)) == hidden > 0
    drops = [at for at in range(len(chips) + 1) if list(chips[at:]) in left]
    assert drops == [0, 1, 2, 3]
    assert all(list(chips[len(chips) - len(seen) :]) == seen for seen in left)


def test_a_chip_that_was_dropped_still_does_what_it_does(window, monkeypatch):
    bar = resized(window, 1000)
    assert not bar.events.isVisible()
    assert bar.row.dropped.isVisible()
    entries(bar.row.dropped)["Warnings 0"].trigger()
    assert window.log_page.isVisible()
    window.log_page.hide()
    assert not entries(bar.row.dropped)["No one is driving"].isEnabled()


def test_a_recording_is_shown_before_any_other_chip(window):
    bar = resized(window, 1000)
    before = bar.recording.isVisible()
    bar.recording.setText("● 12:34  5 MB")
    bar.row.fill(bar.recording, full=True)  # without a frame, in which nothing is recorded
    assert not before
    assert bar.recording.isVisible()
    assert not bar.owner.isVisible()
    bar.row.fill(bar.recording, full=False)
    assert not bar.recording.isVisible()


def test_the_reason_gives_way_after_the_chips_and_is_in_the_tooltip_then(qtbot, window):
    bar = resized(window, 1024, scale=1.3)
    assert bar.doing.isVisible()
    assert not any(chip.isVisible() for chip in (bar.owner, bar.events))
    resized(window, 1024, scale=2.0)
    assert not bar.doing.isVisible()
    window.workbench.emergency_stop()
    qtbot.waitUntil(lambda: "Locked by the operator" in bar.state.toolTip(), timeout=LONG_MS)
    resized(window, 1900, scale=1.0)
    qtbot.waitUntil(lambda: bar.state.toolTip() == "", timeout=LONG_MS)
    assert bar.doing.isVisible()


def test_nothing_of_the_window_stands_on_the_stops(window):
    window.panels.make_all()
    bar = resized(window, 1024, scale=2.0)
    for number in range(5):
        window.workbench.notify(Level.ERROR, f"{number}: " + 40 * "something is wrong ")
    window.toggle_palette()
    settle()
    palette = window.palette_page.frameGeometry()
    for button in (bar.stop, bar.emergency):
        place = QRect(button.mapTo(window, QPoint()), button.size())
        assert not any(notice.geometry().intersects(place) for notice in window.notices.shown())
        assert not palette.intersects(place.translated(window.mapToGlobal(QPoint())))
        assert window.childAt(place.center()) is button
    window.toggle_palette()


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_layouts_are_chosen_in_the_menu_bar_as_its_room_allows(window, scale):
    row = window.layout_row
    window.arrangement.arrange(OPERATE)
    resized(window, 1900, scale)
    assert row.buttons["Tune"].isVisible()
    resized(window, 1024, scale)
    assert row.buttons["Tune"].isVisible() is (scale == 1.0)
    assert row.short.isVisible() is (scale == 2.0)
    if row.short.isVisible():
        assert row.short.text() == "Operate"
        offered = entries(row.short)
        assert list(offered) == ["Operate", "Tune", "Diagnose", "Set up", "Job", "Events"]
        assert offered["Operate"].isChecked()
        offered["Job"].trigger()
        assert not window.docks["job"].isHidden()
        offered["Diagnose"].trigger()
        settle()
        assert window.arrangement.in_use is DIAGNOSE
        assert row.short.text() == "Diagnose"
    last = window.menuBar().actionGeometry(window.menuBar().actions()[-1])
    assert row.geometry().left() > last.right()
    assert row.geometry().right() < window.width()
