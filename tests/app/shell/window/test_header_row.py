"""Header and menu bar fit every window width, and nothing covers the stop buttons."""

from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QApplication

from rotemina.app.shell.window import DIAGNOSE, OPERATE
from rotemina.app.workbench import Level

LONG_MS = 30_000
PANELS = ("gap", "job", "events")


def settle():
    for _ in range(5):
        QApplication.processEvents()


def resize_window(window, width, scale=1.0):
    window.workbench.settings.set("window.scale", scale)
    window.arrangement.apply_current_theme()
    window.resize(width, 720)
    settle()
    return window._bar


def read_menu(button):
    button.menu().aboutToShow.emit()
    return {action.text(): action for action in button.menu().actions()}


def test_chips_are_dropped_one_by_one_and_work_from_the_menu(window):
    bar = resize_window(window, 1900)
    chips = (bar.owner, bar.events, bar.model)
    visible_chips = []
    for width in range(1900, 800, -40):
        resize_window(window, width)
        visible_chips.append([chip for chip in chips if chip.isVisible()])
        hidden = len(chips) - len(visible_chips[-1])
        if bar.row.overflow_button.isVisible():
            assert len(read_menu(bar.row.overflow_button)) == hidden > 0
    drops = [start for start in range(len(chips) + 1) if list(chips[start:]) in visible_chips]
    assert drops == [0, 1, 2, 3]
    assert all(list(chips[len(chips) - len(shown) :]) == shown for shown in visible_chips)
    resize_window(window, 1000)
    read_menu(bar.row.overflow_button)["Warnings 0"].trigger()
    assert window.log_page.isVisible()
    window.log_page.hide()
    assert not read_menu(bar.row.overflow_button)["No one is driving"].isEnabled()
    assert not bar.recording.isVisible()
    bar.recording.setText("● 12:34  5 MB")
    # No frame may come in between: it would say that nothing is being recorded.
    bar.row.set_chip_wanted(bar.recording, wanted=True)
    assert bar.recording.isVisible()  # it has priority
    assert not bar.owner.isVisible()
    bar.row.set_chip_wanted(bar.recording, wanted=False)
    assert not bar.recording.isVisible()


def test_the_reason_moves_to_the_tooltip_after_the_chips_are_dropped(qtbot, window):
    bar = resize_window(window, 1024, scale=1.3)
    assert bar.reason_label.isVisible()
    assert not any(chip.isVisible() for chip in (bar.owner, bar.events))
    resize_window(window, 1024, scale=2.0)
    assert not bar.reason_label.isVisible()
    window.workbench.emergency_stop()
    qtbot.waitUntil(lambda: "Locked by the operator" in bar.state.toolTip(), timeout=LONG_MS)
    resize_window(window, 1900, scale=1.0)
    qtbot.waitUntil(lambda: bar.state.toolTip() == "", timeout=LONG_MS)
    assert bar.reason_label.isVisible()


def test_nothing_covers_the_stop_buttons(window):
    window.panels.make_all()
    bar = resize_window(window, 1024, scale=2.0)
    for number in range(5):
        window.workbench.notify(Level.ERROR, f"{number}: " + 40 * "something is wrong ")
    window.toggle_palette()
    settle()
    palette = window.palette_page.frameGeometry()
    for button in (bar.stop, bar.emergency):
        stop_area = QRect(button.mapTo(window, QPoint()), button.size())
        assert not any(
            notice.geometry().intersects(stop_area) for notice in window.notices.visible_notices()
        )
        assert not palette.intersects(stop_area.translated(window.mapToGlobal(QPoint())))
        assert window.childAt(stop_area.center()) is button
    window.toggle_palette()


def test_the_layout_buttons_collapse_to_a_menu_in_a_narrow_window(window):
    row = window.layout_row
    window.arrangement.arrange(OPERATE)
    for width, scale, are_collapsed in ((1900, 1.0, False), (1024, 1.0, False), (1024, 2.0, True)):
        resize_window(window, width, scale)
        assert row.buttons["Tune"].isVisible() is not are_collapsed
        assert row.menu_button.isVisible() is are_collapsed
        last_menu = window.menuBar().actionGeometry(window.menuBar().actions()[-1])
        assert row.geometry().left() > last_menu.right()
        assert row.geometry().right() < window.width()
    assert row.menu_button.text() == "Operate"
    entries = read_menu(row.menu_button)
    assert list(entries) == ["Operate", "Tune", "Diagnose", "Set up", "Job", "Events"]
    assert entries["Operate"].isChecked()
    entries["Job"].trigger()
    assert not window.docks["job"].isHidden()
    entries["Diagnose"].trigger()
    settle()
    assert window.arrangement.current_layout is DIAGNOSE
    assert row.menu_button.text() == "Diagnose"
