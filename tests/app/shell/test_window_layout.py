"""Layouts, themes and sizes of text of the window."""

import pytest
from PySide6.QtCore import QByteArray, QPoint
from PySide6.QtWidgets import QApplication, QLabel, QTabBar

from rotemina.app.panel import Area
from rotemina.app.shell.central_column import LEAST_HEIGHT
from rotemina.app.shell.folded_panels import FOLDED
from rotemina.app.shell.layouts import BUILT_IN, DIAGNOSE, MOST_KEPT, OPERATE, KeptLayouts

LONG_MS = 30_000


def settle():
    for _ in range(5):
        QApplication.processEvents()


def forgotten_tabs(window):
    """Tab bars that are seen and have no dock beside them."""
    docks = [dock for dock in window.docks.values() if not dock.visibleRegion().isEmpty()]
    left = []
    for bar in window.findChildren(QTabBar):
        tabs = bar.geometry()
        if bar.parent() is window and bar.isVisible() and window.rect().intersects(tabs):
            near = [
                dock
                for dock in docks
                if abs(dock.geometry().left() - tabs.left()) < 10
                and abs(dock.geometry().top() - tabs.bottom()) < 10
            ]
            if not near:
                left.append([bar.tabText(number) for number in range(bar.count())])
    return left


def shown(window):
    return {name for name, dock in window.docks.items() if not dock.isHidden()}


def named(layout):
    return {
        name for area, names in layout.places.items() if area is not Area.CENTRE for name in names
    }


def test_layouts_and_sizes_of_text(window, settings):
    layouts_can_be_taken_kept_and_brought_back(window)
    text_grows_by_steps_to_its_end_and_is_remembered(window, settings)


def layouts_can_be_taken_kept_and_brought_back(window):
    looks = window.arrangement
    for layout in BUILT_IN:
        window.layout_row.buttons[layout.word].click()
        settle()
        assert shown(window) == named(layout) - set(FOLDED)  # which fold away at 1280 px
        assert window.folded.isVisible() == (layout is OPERATE)
        assert forgotten_tabs(window) == []
        marked = [word for word, one in window.layout_row.buttons.items() if one.isChecked()]
        assert marked == [layout.word]
        for area, names in layout.places.items():
            if area is not Area.CENTRE and names[0] not in FOLDED:
                assert not window.docks[names[0]].visibleRegion().isEmpty()
    looks.arrange(DIAGNOSE)
    settle()
    assert window.docks["gap"].height() > 0.6 * window.height()
    assert window.centralWidget().height() == LEAST_HEIGHT
    tops = {plot.mapTo(window, QPoint()).y() for plot in window.panels["plots"].plots.values()}
    assert len(tops) == 1  # a strip of plots, side by side
    window.docks["faults"].setFloating(True)
    looks.keep("mine")
    assert "mine" in window.notices.notices()[0].text
    for dock in window.docks.values():
        dock.close()
    window.reset_layout()
    settle()
    assert shown(window) == set(window.docks)
    assert not any(dock.isFloating() for dock in window.docks.values())
    assert forgotten_tabs(window) == []
    window.layout_menu.aboutToShow.emit()
    action = next(each for each in window.layout_menu.actions() if each.text() == "mine")
    action.trigger()
    settle()
    assert shown(window) == named(DIAGNOSE)
    assert window.docks["faults"].isFloating()
    assert forgotten_tabs(window) == []
    looks.arrange(OPERATE)
    the_rail_opens_one_panel_and_a_wide_window_has_both(window)
    window.docks["plate"].toggleViewAction().trigger()  # one that the layout had closed
    settle()
    assert "plate" in shown(window)
    window.bring_up("effects")
    settle()
    assert not window.docks["effects"].visibleRegion().isEmpty()
    assert not window.docks["effects"].isFloating()


def the_rail_opens_one_panel_and_a_wide_window_has_both(window):
    for name in FOLDED:
        window.folded.buttons[name].click()
        assert shown(window) & set(FOLDED) == {name}
        assert window.layout_row.buttons["Operate"].isChecked()
    window.resize(1920, 1080)
    settle()
    assert set(FOLDED) <= shown(window)
    assert not window.folded.isVisible()
    job, events = (window.docks[name].geometry() for name in FOLDED)
    assert job.left() == events.left()
    assert job.bottom() < events.top()
    window.docks["trajectory"].close()  # by hand: it is that layout no more
    settle()
    assert not window.layout_row.buttons["Operate"].isChecked()
    window.docks["trajectory"].show()
    window.resize(1280, 800)
    settle()
    assert not shown(window) & set(FOLDED)
    assert window.layout_row.buttons["Operate"].isChecked()


def test_layouts_of_the_users_own_are_kept_within_bounds(settings):
    kept = KeptLayouts(settings)
    assert kept.names() == ()
    kept.keep("b & c", QByteArray(b"\x00state"))
    kept.keep("A", QByteArray(b"other"))
    assert KeptLayouts(settings).names() == ("A", "b & c")
    assert KeptLayouts(settings).state("b & c") == QByteArray(b"\x00state")
    kept.forget("A")
    assert kept.names() == ("b & c",)
    assert kept.objection("") == "enter a name"
    assert "of the program" in kept.objection("operate")
    assert "41" in kept.objection(41 * "x")
    for number in range(MOST_KEPT - 1):
        kept.keep(f"n{number}", QByteArray(b"x"))
    assert "delete one first" in kept.objection("one more")
    assert kept.objection("n1") is None


@pytest.mark.parametrize("spoilt", ["", "[1]", "{", '{"a": 3}', '{"a": "no base 64"}'])
def test_spoilt_layouts_are_no_failure(settings, spoilt):
    settings.set("window.layouts", spoilt)
    kept = KeptLayouts(settings)
    for name in kept.names():
        assert kept.state(name).isEmpty()
    kept.keep("good", QByteArray(b"x"))
    assert kept.state("good") == QByteArray(b"x")


def text_grows_by_steps_to_its_end_and_is_remembered(window, settings):
    looks = window.arrangement
    before, plain = window.stop_button.sizeHint().height(), QLabel(parent=window)
    plain.ensurePolished()
    assert plain.font().pixelSize() == 13
    assert looks.text_scale == 1.0
    settings.set("window.scale", 1.75)
    looks.step_scale(1)
    looks.step_scale(1)
    assert looks.text_scale == 2.0
    assert window.stop_button.sizeHint().height() > 1.5 * before
    assert plain.font().pixelSize() == 26
    looks.use_theme("contrast")
    assert window.workbench.theme.name == "contrast"
    assert window.stop_button.sizeHint().height() > 1.5 * before  # a theme keeps the size
    assert settings.get("window.scale", 0.0) == 2.0
    looks.suit_the_screen()
    assert looks.text_scale == 1.0
    settings.set("window.scale", 77.7)  # no size that is offered
    assert looks.text_scale == 1.0
