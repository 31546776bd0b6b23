"""Layouts, themes and text scales of the window."""

import pytest
from PySide6.QtCore import QByteArray, QPoint
from PySide6.QtWidgets import QApplication, QLabel, QTabBar

from rotemina.app.panel import PanelArea
from rotemina.app.shell.window import BUILT_IN, DIAGNOSE, OPERATE
from rotemina.app.shell.window.central_column import MIN_PANELS_HEIGHT_PX
from rotemina.app.shell.window.folded_panels import FOLDED_PANELS
from rotemina.app.shell.window.layouts import MAX_SAVED_LAYOUTS, SavedLayouts

LONG_MS = 30_000


def settle():
    for _ in range(5):
        QApplication.processEvents()


def find_orphan_tab_bars(window):
    """Return the visible tab bars without a dock next to them."""
    docks = [dock for dock in window.docks.values() if not dock.visibleRegion().isEmpty()]
    orphans = []
    for bar in window.findChildren(QTabBar):
        tabs = bar.geometry()
        if bar.parent() is window and bar.isVisible() and window.rect().intersects(tabs):
            adjacent = [
                dock
                for dock in docks
                if abs(dock.geometry().left() - tabs.left()) < 10
                and abs(dock.geometry().top() - tabs.bottom()) < 10
            ]
            if not adjacent:
                orphans.append([bar.tabText(number) for number in range(bar.count())])
    return orphans


def get_shown_docks(window):
    return {name for name, dock in window.docks.items() if not dock.isHidden()}


def get_docks_of_layout(layout):
    return {
        name
        for area, names in layout.places.items()
        if area is not PanelArea.CENTRE
        for name in names
    }


def test_layouts_and_text_scale(window, settings):
    check_layouts(window)
    check_text_scale(window, settings)


def check_layouts(window):
    arrangement = window.arrangement
    for layout in BUILT_IN:
        window.layout_row.buttons[layout.plain_title].click()
        settle()
        # Folded panels are hidden at 1280 px.
        assert get_shown_docks(window) == get_docks_of_layout(layout) - set(FOLDED_PANELS)
        assert window.folded.isVisible() == (layout is OPERATE)
        assert find_orphan_tab_bars(window) == []
        checked = [
            title for title, button in window.layout_row.buttons.items() if button.isChecked()
        ]
        assert checked == [layout.plain_title]
        for area, names in layout.places.items():
            if area is not PanelArea.CENTRE and names[0] not in FOLDED_PANELS:
                assert not window.docks[names[0]].visibleRegion().isEmpty()
    arrangement.arrange(DIAGNOSE)
    settle()
    assert window.docks["gap"].height() > 0.6 * window.height()
    assert window.centralWidget().height() == MIN_PANELS_HEIGHT_PX
    tops = {plot.mapTo(window, QPoint()).y() for plot in window.panels["plots"].plots.values()}
    assert len(tops) == 1  # the plots are side by side
    window.docks["faults"].setFloating(True)
    arrangement.save_layout("mine")
    assert "mine" in window.notices.notices()[0].text
    for dock in window.docks.values():
        dock.close()
    window.reset_layout()
    settle()
    assert get_shown_docks(window) == set(window.docks)
    assert not any(dock.isFloating() for dock in window.docks.values())
    assert find_orphan_tab_bars(window) == []
    window.layout_menu.aboutToShow.emit()
    action = next(
        candidate for candidate in window.layout_menu.actions() if candidate.text() == "mine"
    )
    action.trigger()
    settle()
    assert get_shown_docks(window) == get_docks_of_layout(DIAGNOSE)
    assert window.docks["faults"].isFloating()
    assert find_orphan_tab_bars(window) == []
    arrangement.arrange(OPERATE)
    check_folded_panels(window)
    window.docks["plate"].toggleViewAction().trigger()  # a panel that the layout had closed
    settle()
    assert "plate" in get_shown_docks(window)
    window.bring_up("effects")
    settle()
    assert not window.docks["effects"].visibleRegion().isEmpty()
    assert not window.docks["effects"].isFloating()


def check_folded_panels(window):
    for name in FOLDED_PANELS:
        window.folded.buttons[name].click()
        assert get_shown_docks(window) & set(FOLDED_PANELS) == {name}
        assert window.layout_row.buttons["Operate"].isChecked()
    window.resize(1920, 1080)
    settle()
    assert set(FOLDED_PANELS) <= get_shown_docks(window)
    assert not window.folded.isVisible()
    job, events = (window.docks[name].geometry() for name in FOLDED_PANELS)
    assert job.left() == events.left()
    assert job.bottom() < events.top()
    window.docks["trajectory"].close()  # by hand: this is no longer the layout
    settle()
    assert not window.layout_row.buttons["Operate"].isChecked()
    window.docks["trajectory"].show()
    window.resize(1280, 800)
    settle()
    assert not get_shown_docks(window) & set(FOLDED_PANELS)
    assert window.layout_row.buttons["Operate"].isChecked()


def test_saved_layouts_are_limited_in_number(settings):
    layouts = SavedLayouts(settings)
    assert layouts.list_names() == ()
    layouts.save("b & c", QByteArray(b"\x00state"))
    layouts.save("A", QByteArray(b"other"))
    assert SavedLayouts(settings).list_names() == ("A", "b & c")
    assert SavedLayouts(settings).read_state("b & c") == QByteArray(b"\x00state")
    layouts.delete("A")
    assert layouts.list_names() == ("b & c",)
    assert layouts.find_objection("") == "enter a name"
    assert "of the program" in layouts.find_objection("operate")
    assert "41" in layouts.find_objection(41 * "x")
    for number in range(MAX_SAVED_LAYOUTS - 1):
        layouts.save(f"n{number}", QByteArray(b"x"))
    assert "delete one first" in layouts.find_objection("one more")
    assert layouts.find_objection("n1") is None


@pytest.mark.parametrize("content", ["[1]", "{", '{"a": 3}', '{"a": "no base 64"}'])
def test_invalid_saved_layouts_are_ignored(settings, content):
    settings.set("window.layouts", content)
    layouts = SavedLayouts(settings)
    for name in layouts.list_names():
        assert layouts.read_state(name).isEmpty()
    layouts.save("good", QByteArray(b"x"))
    assert layouts.read_state("good") == QByteArray(b"x")


def check_text_scale(window, settings):
    arrangement = window.arrangement
    before, label = window.stop_button.sizeHint().height(), QLabel(parent=window)
    label.ensurePolished()
    assert label.font().pixelSize() == 13
    assert arrangement.text_scale == 1.0
    settings.set("window.scale", 1.75)
    arrangement.step_scale(1)
    arrangement.step_scale(1)
    assert arrangement.text_scale == 2.0
    assert window.stop_button.sizeHint().height() > 1.5 * before
    assert label.font().pixelSize() == 26
    arrangement.use_theme("contrast")
    assert window.workbench.theme.name == "contrast"
    assert window.stop_button.sizeHint().height() > 1.5 * before  # a theme keeps the size
    assert settings.get("window.scale", 0.0) == 2.0
    arrangement.use_automatic_scale()
    assert arrangement.text_scale == 1.0
    settings.set("window.scale", 77.7)  # not an offered size
    assert arrangement.text_scale == 1.0
