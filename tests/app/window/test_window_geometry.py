"""The stop buttons stay in the window, and nothing is cut, in every scale, language and layout."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication
from tests.app.window.window_geometry import (
    SMALLEST_SIZE,
    find_geometry_faults,
    settle,
    show_everything,
)

from rotemina.app.language import language
from rotemina.app.panel import Panel
from rotemina.app.shell.window import BUILT_IN, DIAGNOSE, OPERATE
from rotemina.app.shell.window.layouts import TUNE
from rotemina.app.widgets.style.theme import TEXT_SCALES

SIZES = (SMALLEST_SIZE, (1280, 800), (1920, 1080))
SCALES = (0.9, 1.3, 2.0)  # the extremes and one in the middle


@pytest.fixture
def make_translated_window(settings, make_robot_window):
    """Return a function that makes a window in a language."""

    def make_window(language_name):
        settings.set(language.LANGUAGE_KEY, language_name)
        return make_robot_window()

    yield make_window
    language.use_language(QApplication.instance(), "en")


def use_scale(window, scale):
    """Change the text scale in steps, as an operator does."""
    steps = TEXT_SCALES.index(scale) - TEXT_SCALES.index(window.arrangement.text_scale)
    window.arrangement.step_scale(steps)
    settle()


def find_faults_at_size(window, size):
    """Resize a window and return its faults, including a size that it does not take."""
    window.resize(*size)
    settle()
    size_faults = [] if window.size().toTuple() == size else [f"the window has {window.size()}"]
    return [f"{size}: {fault}" for fault in (*size_faults, *find_geometry_faults(window))]


def iterate_layouts(window):
    """Use each layout in turn, finally all docks, and yield its name."""
    for layout in BUILT_IN:
        window.arrangement.arrange(layout)
        yield layout.plain_title
    window.reset_layout()
    yield "every dock"


@pytest.mark.slow
@pytest.mark.every_panel
@pytest.mark.parametrize(("name", "is_full"), [("en", False), ("de", True)], ids=["plain", "full"])
def test_the_stops_stay_at_every_text_scale_in_every_layout(make_translated_window, name, is_full):
    window = make_translated_window(name)
    window.panels.make_all()
    if is_full:
        show_everything(window)
    faults = []
    for scale in SCALES:
        use_scale(window, scale)
        for layout in iterate_layouts(window):
            for size in SIZES:
                faults += [
                    f"{scale}, {layout}, {fault}" for fault in find_faults_at_size(window, size)
                ]
    assert "\n".join(faults) == ""


def test_the_stops_stay_with_the_largest_text_and_all_optional_parts(make_translated_window):
    window = make_translated_window("de")
    before = window.size()
    window.arrangement.arrange(DIAGNOSE)
    show_everything(window)
    use_scale(window, 2.0)
    assert window.size() == before
    assert window.minimumSize().width() <= SMALLEST_SIZE[0]
    assert window.minimumSize().height() <= SMALLEST_SIZE[1]
    assert find_faults_at_size(window, SMALLEST_SIZE) == []


class HugePanel(Panel):
    """A panel with a minimum size larger than the screen."""

    title = "huge"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.setMinimumSize(3000, 3000)


def test_a_panel_larger_than_the_screen_is_scrolled(window):
    before = window.size()
    window.panels.panel_types["huge"] = HugePanel
    window._add_dock("huge", HugePanel)
    for layout in (OPERATE, TUNE, DIAGNOSE):
        window.arrangement.arrange(layout)
        window.bring_up("huge")
        window.resize(before)
        settle()
        dock = window.docks["huge"]
        assert window.size() == before
        assert dock.widget().widget().size().toTuple() == (3000, 3000)
        assert dock.widget().verticalScrollBar().maximum() > 2000
        assert find_faults_at_size(window, SMALLEST_SIZE) == []


def get_dock_sizes(window):
    docks = window.docks.items()
    return {name: dock.size() for name, dock in docks if not dock.visibleRegion().isEmpty()}


def test_docks_regain_their_sizes_when_the_text_scale_is_reset(window):
    for layout in (OPERATE, TUNE, DIAGNOSE):
        window.arrangement.arrange(layout)
        window.resizeDocks([window.docks["control"]], [400], Qt.Orientation.Horizontal)
        settle()
        before = get_dock_sizes(window)
        use_scale(window, 2.0)
        assert get_dock_sizes(window) != before
        use_scale(window, 1.0)
        after = get_dock_sizes(window)
        assert after.keys() == before.keys()
        for name, size in after.items():  # up to the rounding of separators, which are scaled too
            assert abs(size.width() - before[name].width()) <= 2
            assert abs(size.height() - before[name].height()) <= 2
