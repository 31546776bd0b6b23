"""The stops stay in the window, and nothing in it is cut: every size of text, language, layout."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication
from tests.app.window.window_geometry import (
    SMALLEST,
    faults_of_geometry,
    settle,
    show_everything,
)

from rotemina.app.panel import Panel
from rotemina.app.shell import language
from rotemina.app.shell.layouts import BUILT_IN, DIAGNOSE, OPERATE, SET_UP, TUNE
from rotemina.app.shell.theme import SCALES

SIZES = (SMALLEST, (1280, 800), (1920, 1080))
THEMES = (
    ("light", "en", 2.0, OPERATE),
    ("light", "de", 1.3, TUNE),
    ("contrast", "de", 1.75, SET_UP),
)


@pytest.fixture
def speaking(settings, make_robot_window):
    """Make a window that speaks a language."""

    def make(name):
        settings.set(language.SETTING, name)
        return make_robot_window()

    yield make
    language.use(QApplication.instance(), "en")


def use_scale(window, settings, scale):
    """Change the size of text by steps, as an operator does."""
    steps = SCALES.index(scale) - SCALES.index(window.arrangement.text_scale)
    window.arrangement.step_scale(steps)
    settle()


def look_at(window, size):
    """Return what is wrong in a window of a size, which it must be able to take."""
    window.resize(*size)
    settle()
    taken = [] if window.size().toTuple() == size else [f"the window has {window.size()}"]
    return [f"{size}: {fault}" for fault in (*taken, *faults_of_geometry(window))]


def arrangements(window):
    """Use each layout in turn, and at last every dock; yield its name."""
    for layout in BUILT_IN:
        window.arrangement.arrange(layout)
        yield layout.word
    window.reset_layout()
    yield "every dock"


@pytest.mark.slow
@pytest.mark.every_panel
@pytest.mark.parametrize("name", language.LANGUAGES)
@pytest.mark.parametrize("full", [False, True], ids=["plain", "full"])
def test_the_stops_stay_at_every_size_of_text_in_every_layout(speaking, settings, name, full):
    window = speaking(name)
    window.panels.make_all()
    if full:
        show_everything(window)
    found = []
    for scale in SCALES:
        use_scale(window, settings, scale)
        for layout in arrangements(window):
            for size in SIZES:
                found += [f"{scale}, {layout}, {fault}" for fault in look_at(window, size)]
    assert "\n".join(found) == ""


@pytest.mark.slow
@pytest.mark.every_panel
@pytest.mark.parametrize(("theme", "name", "scale", "layout"), THEMES)
def test_the_stops_stay_in_every_theme(speaking, settings, theme, name, scale, layout):
    window = speaking(name)
    window.panels.make_all()
    window.use_theme(theme)
    use_scale(window, settings, scale)
    window.arrangement.arrange(layout)
    assert [fault for size in SIZES for fault in look_at(window, size)] == []


def test_the_stops_stay_with_the_largest_text_and_all_that_can_be_shown(speaking, settings):
    window = speaking("de")
    before = window.size()
    window.arrangement.arrange(DIAGNOSE)
    show_everything(window)
    use_scale(window, settings, 2.0)
    assert window.size() == before
    assert window.minimumSize().width() <= SMALLEST[0]
    assert window.minimumSize().height() <= SMALLEST[1]
    assert look_at(window, SMALLEST) == []


class HugePanel(Panel):
    """A panel of a careless author."""

    title = "huge"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.setMinimumSize(3000, 3000)


@pytest.mark.parametrize("layout", BUILT_IN, ids=lambda layout: layout.word)
def test_a_panel_that_asks_for_more_than_the_screen_is_scrolled(window, layout):
    before = window.size()
    window.panels.kinds["huge"] = HugePanel
    window._add_dock("huge", HugePanel)
    window.arrangement.arrange(layout)
    window.bring_up("huge")
    settle()
    dock = window.docks["huge"]
    assert window.size() == before
    assert dock.widget().widget().size().toTuple() == (3000, 3000)
    assert dock.widget().verticalScrollBar().maximum() > 2000
    assert look_at(window, SMALLEST) == []


def sizes_of_docks(window):
    docks = window.docks.items()
    return {name: dock.size() for name, dock in docks if not dock.visibleRegion().isEmpty()}


@pytest.mark.parametrize("layout", BUILT_IN, ids=lambda layout: layout.word)
def test_docks_have_their_former_sizes_when_the_size_of_text_is_reset(window, settings, layout):
    window.arrangement.arrange(layout)
    window.resizeDocks([window.docks["control"]], [400], Qt.Orientation.Horizontal)
    settle()
    before = sizes_of_docks(window)
    use_scale(window, settings, 2.0)
    assert sizes_of_docks(window) != before
    use_scale(window, settings, 1.0)
    after = sizes_of_docks(window)
    assert after.keys() == before.keys()
    for name, size in after.items():  # all but what separators, which grow too, round away
        assert abs(size.width() - before[name].width()) <= 2
        assert abs(size.height() - before[name].height()) <= 2
