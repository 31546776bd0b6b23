"""No text of any panel is cut and nothing overlaps, in all layouts, sizes and languages."""

import re

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QTextDocument
from PySide6.QtWidgets import (
    QApplication,
    QCheckBox,
    QGroupBox,
    QLabel,
    QPushButton,
    QRadioButton,
    QStyle,
    QStyleOptionButton,
    QTabBar,
    QTabWidget,
    QToolBar,
    QToolButton,
    QWidget,
)

from rotemina.app.language import language
from rotemina.app.shell.window import BUILT_IN, OPERATE
from rotemina.app.widgets.text import ElidedLabel

pytestmark = [pytest.mark.slow, pytest.mark.every_panel]
SMALL_SIZE, LARGE_SIZE = (1280, 800), (1920, 1080)
#: Rounding tolerance, px.
_SLACK = 1


def settle():
    for _ in range(12):
        QApplication.processEvents()


def get_text_width(check_button):
    """Return the width that the style leaves for a button's text."""
    option = QStyleOptionButton()
    check_button.initStyleOption(option)
    element = {
        QCheckBox: QStyle.SubElement.SE_CheckBoxContents,
        QRadioButton: QStyle.SubElement.SE_RadioButtonContents,
    }.get(type(check_button), QStyle.SubElement.SE_PushButtonContents)
    return check_button.style().subElementRect(element, option, check_button).width()


def check_label(widget):
    """Describe a label, plain or rich text, whose text is cut, or return None."""
    if isinstance(widget, ElidedLabel) or not widget.text():
        return None  # the tooltip of an elided label has its full text
    rect, is_wrapped = widget.contentsRect(), widget.wordWrap()
    is_plain = widget.textFormat() == Qt.TextFormat.PlainText or not re.search(
        r"<[a-z]+", widget.text()
    )
    if is_plain:
        has_lines = is_wrapped or "\n" in widget.text()
        flags = Qt.TextFlag.TextWordWrap if has_lines else Qt.TextFlag.TextSingleLine
        needed = widget.fontMetrics().boundingRect(rect, int(flags), widget.text()).size()
    else:
        document = QTextDocument()
        document.setDefaultFont(widget.font())
        document.setDocumentMargin(0)
        document.setHtml(widget.text())
        document.setTextWidth(rect.width() if is_wrapped else -1)
        needed = document.size().toSize()
    if needed.width() > rect.width() + _SLACK or needed.height() > rect.height() + _SLACK:
        room = f"{needed.toTuple()} in {rect.size().toTuple()}"
        return f"label {widget.text()[:50]!r} of {type(widget.parent()).__name__}: {room}"
    return None


def check_button(widget):
    """Describe a button or check box whose text is cut, or return None."""
    text = widget.text().replace("&", "")
    lines = text.split("\n")
    needed = max(map(widget.fontMetrics().horizontalAdvance, lines))
    room = widget.width() if isinstance(widget, QToolButton) else get_text_width(widget)
    is_too_high = len(lines) * widget.fontMetrics().height() > widget.height() + _SLACK
    if text and (needed > room + _SLACK or is_too_high):
        return f"{type(widget).__name__} {text!r}: {needed} in {room}"
    return None


def check_tabs(widget):
    """Describe a tab whose text is cut, or return None."""
    for number in range(widget.count()):
        text, room = widget.tabText(number).replace("&", ""), widget.tabRect(number).width()
        needed = widget.fontMetrics().horizontalAdvance(text)
        if needed > room:
            return f"tab {text!r}: {needed} in {room}"
    return None


def check_group(widget):
    """Describe a group box whose title is cut, or return None."""
    needed = widget.fontMetrics().horizontalAdvance(widget.title())
    return f"group {widget.title()!r}: {needed}" if needed > widget.width() else None


CHECKS = (
    (QLabel, check_label),
    ((QPushButton, QCheckBox, QRadioButton, QToolButton), check_button),
    (QTabBar, check_tabs),
    (QGroupBox, check_group),
)


def find_cut_text(widget):
    """Describe the cut text of a widget, or return None."""
    return next((describe(widget) for kinds, describe in CHECKS if isinstance(widget, kinds)), None)


def find_overlaps(parent):
    """Yield descriptions of children of a layout that overlap."""
    if parent.layout() is None:
        return
    layout = parent.layout()
    visible = {item for item in iterate_widgets(layout) if item.isVisible()}
    children = sorted(visible, key=lambda widget: (widget.y(), widget.x()))
    for number, first in enumerate(children):
        for second in children[number + 1 :]:
            overlap = first.geometry().intersected(second.geometry())
            if overlap.width() > _SLACK and overlap.height() > _SLACK:
                names = f"{describe_widget(first)} on {describe_widget(second)}"
                yield f"{names} by {overlap.size().toTuple()}"


def iterate_widgets(layout):
    for number in range(layout.count()):
        item = layout.itemAt(number)
        if item.widget() is not None:
            if type(layout).__name__ != "QStackedLayout":
                yield item.widget()
        elif item.layout() is not None:
            yield from iterate_widgets(item.layout())


def describe_widget(widget):
    text = getattr(widget, "text", None)
    return f"{type(widget).__name__}({text()[:30] if callable(text) else widget.objectName()})"


def find_panel_faults(panel):
    visible = [widget for widget in (panel, *panel.findChildren(QWidget)) if widget.isVisible()]
    for widget in visible:
        fault = find_cut_text(widget)
        if fault is not None:
            yield fault
        yield from find_overlaps(widget)


def open_pages(panel):
    """Open each tab of a panel in turn and yield its title."""
    yield ""
    for tab_widget in panel.findChildren(QTabWidget):
        before = tab_widget.currentIndex()
        for number in range(tab_widget.count()):
            if tab_widget.isTabEnabled(number):
                tab_widget.setCurrentIndex(number)
                settle()
                yield f" ▸ {tab_widget.tabText(number)}"
        tab_widget.setCurrentIndex(before)


@pytest.fixture
def make_translated_window(settings, make_robot_window):
    """Return a function that makes a window in a language."""

    def make_window(language_name):
        settings.set(language.LANGUAGE_KEY, language_name)
        return make_robot_window()

    yield make_window
    language.use_language(QApplication.instance(), "en")


def find_window_faults(window):
    """Return all cut texts and overlaps of every page of every panel."""
    faults = []
    for name in window.panels:
        window.bring_up(name)
        settle()
        for page in open_pages(window.panels[name]):
            faults += [f"{name}{page}: {fault}" for fault in find_panel_faults(window.panels[name])]
    for bar in window.findChildren(QTabBar):
        if bar.isVisible() and bar.parent() is window:
            faults += filter(None, [find_cut_text(bar)])
    for part in (window.layout_row, *window.findChildren(QToolBar)):
        faults += find_panel_faults(part)
    return list(dict.fromkeys(faults))


@pytest.mark.parametrize("name", language.LANGUAGES)
def test_every_text_has_room(make_translated_window, name):
    """Themes differ only in their colours, so one of them is enough."""
    window = make_translated_window(name)
    window.panels.make_all()
    for layout in BUILT_IN:
        window.arrangement.arrange(layout)
        check_size(window, SMALL_SIZE, layout.plain_title)
        if layout is OPERATE:
            assert "\n".join(find_window_faults(window)) == ""
    window.reset_layout()
    check_size(window, SMALL_SIZE, "all panels")
    assert "\n".join(find_window_faults(window)) == ""
    window.arrangement.arrange(OPERATE)
    check_size(window, LARGE_SIZE, OPERATE.plain_title)
    assert "\n".join(find_window_faults(window)) == ""


def check_size(window, size, title):
    """Resize a window, and check that it takes the size."""
    window.resize(*size)
    settle()
    assert (title, window.size().toTuple()) == (title, size)


def test_large_german_text_has_room(make_translated_window, settings):
    settings.set("window.scale", 1.5)
    window = make_translated_window("de")
    window.panels.make_all()
    window.arrangement.arrange(OPERATE)
    window.resize(*LARGE_SIZE)
    settle()
    assert "\n".join(find_window_faults(window)) == ""
