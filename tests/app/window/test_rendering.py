"""All text of all panels has room, nothing overlaps: three themes, two sizes, two languages."""

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

from rotemina.app.shell import language
from rotemina.app.shell.layouts import BUILT_IN, OPERATE
from rotemina.app.shell.theme import THEMES
from rotemina.app.widgets.labels import ElidedLabel

pytestmark = [pytest.mark.slow, pytest.mark.every_panel]
SIZES = ((1280, 800), (1920, 1080))
_SLACK = 1  # px of rounding


def settle():
    for _ in range(12):
        QApplication.processEvents()


def room_of(button):
    """Return the width that the style leaves for a button's text."""
    option = QStyleOptionButton()
    button.initStyleOption(option)
    element = {
        QCheckBox: QStyle.SubElement.SE_CheckBoxContents,
        QRadioButton: QStyle.SubElement.SE_RadioButtonContents,
    }.get(type(button), QStyle.SubElement.SE_PushButtonContents)
    return button.style().subElementRect(element, option, button).width()


def label(widget):
    """Tell of a label without room, of plain or of rich text."""
    if isinstance(widget, ElidedLabel) or not widget.text():
        return None  # the tooltip of an elided one has all of it
    rect, wraps = widget.contentsRect(), widget.wordWrap()
    plain = widget.textFormat() == Qt.TextFormat.PlainText or not re.search(
        r"<[a-z]+", widget.text()
    )
    if plain:
        several = wraps or "\n" in widget.text()
        flags = Qt.TextFlag.TextWordWrap if several else Qt.TextFlag.TextSingleLine
        needed = widget.fontMetrics().boundingRect(rect, int(flags), widget.text()).size()
    else:
        page = QTextDocument()
        page.setDefaultFont(widget.font())
        page.setDocumentMargin(0)
        page.setHtml(widget.text())
        page.setTextWidth(rect.width() if wraps else -1)
        needed = page.size().toSize()
    if needed.width() > rect.width() + _SLACK or needed.height() > rect.height() + _SLACK:
        room = f"{needed.toTuple()} in {rect.size().toTuple()}"
        return f"label {widget.text()[:50]!r} of {type(widget.parent()).__name__}: {room}"
    return None


def button(widget):
    """Tell of a button or a check box without room."""
    text = widget.text().replace("&", "")
    lines = text.split("\n")
    needed = max(map(widget.fontMetrics().horizontalAdvance, lines))
    room = widget.width() if isinstance(widget, QToolButton) else room_of(widget)
    high = len(lines) * widget.fontMetrics().height() > widget.height() + _SLACK
    if text and (needed > room + _SLACK or high):
        return f"{type(widget).__name__} {text!r}: {needed} in {room}"
    return None


def tabs(widget):
    """Tell of a tab without room."""
    for number in range(widget.count()):
        text, room = widget.tabText(number).replace("&", ""), widget.tabRect(number).width()
        needed = widget.fontMetrics().horizontalAdvance(text)
        if needed > room:
            return f"tab {text!r}: {needed} in {room}"
    return None


def group(widget):
    """Tell of a group's title without room."""
    needed = widget.fontMetrics().horizontalAdvance(widget.title())
    return f"group {widget.title()!r}: {needed}" if needed > widget.width() else None


KINDS = (
    (QLabel, label),
    ((QPushButton, QCheckBox, QRadioButton, QToolButton), button),
    (QTabBar, tabs),
    (QGroupBox, group),
)


def cut(widget):
    """Return what text of a widget is cut off, or None."""
    return next((told(widget) for kinds, told in KINDS if isinstance(widget, kinds)), None)


def overlaps(parent):
    """Yield children of a layout that stand on each other."""
    if parent.layout() is None:
        return
    layout = parent.layout()
    laid = {item for item in all_widgets(layout) if item.isVisible()}
    children = sorted(laid, key=lambda one: (one.y(), one.x()))
    for number, one in enumerate(children):
        for other in children[number + 1 :]:
            both = one.geometry().intersected(other.geometry())
            if both.width() > _SLACK and both.height() > _SLACK:
                yield f"{name_of(one)} on {name_of(other)} by {both.size().toTuple()}"


def all_widgets(layout):
    for number in range(layout.count()):
        item = layout.itemAt(number)
        if item.widget() is not None:
            if type(layout).__name__ != "QStackedLayout":
                yield item.widget()
        elif item.layout() is not None:
            yield from all_widgets(item.layout())


def name_of(widget):
    text = getattr(widget, "text", None)
    return f"{type(widget).__name__}({text()[:30] if callable(text) else widget.objectName()})"


def faults_of(panel):
    seen = [one for one in (panel, *panel.findChildren(QWidget)) if one.isVisible()]
    for widget in seen:
        told = cut(widget)
        if told is not None:
            yield told
        yield from overlaps(widget)


def pages(panel):
    """Bring up each tab of a panel in turn."""
    yield ""
    for book in panel.findChildren(QTabWidget):
        before = book.currentIndex()
        for number in range(book.count()):
            if book.isTabEnabled(number):
                book.setCurrentIndex(number)
                settle()
                yield f" ▸ {book.tabText(number)}"
        book.setCurrentIndex(before)


@pytest.fixture
def speaking(settings, make_robot_window):
    """Make a window that speaks a language."""

    def make(name):
        settings.set(language.SETTING, name)
        return make_robot_window()

    yield make
    language.use(QApplication.instance(), "en")


def faults_in(window):
    """Return what is cut or stands on something, of every page of every panel."""
    found = []
    for name in window.panels:
        window.bring_up(name)
        settle()
        for page in pages(window.panels[name]):
            found += [f"{name}{page}: {fault}" for fault in faults_of(window.panels[name])]
    for bar in window.findChildren(QTabBar):
        if bar.isVisible() and bar.parent() is window:
            found += filter(None, [cut(bar)])
    for part in (window.layout_row, *window.findChildren(QToolBar)):
        found += faults_of(part)
    return list(dict.fromkeys(found))


@pytest.mark.parametrize("name", language.LANGUAGES)
@pytest.mark.parametrize("size", SIZES, ids=lambda size: "x".join(map(str, size)))
@pytest.mark.parametrize("theme", sorted(THEMES))
def test_every_text_has_room(speaking, theme, size, name):
    window = speaking(name)
    window.use_theme(theme)
    window.panels.make_all()
    window.arrangement.arrange(OPERATE)
    window.resize(*size)
    settle()
    assert window.size().toTuple() == size  # it does not need more
    assert "\n".join(faults_in(window)) == ""


@pytest.mark.parametrize("name", language.LANGUAGES)
def test_every_layout_fits_a_small_screen(speaking, name):
    window = speaking(name)
    window.panels.make_all()
    for layout in BUILT_IN:
        window.arrangement.arrange(layout)
        window.resize(*SIZES[0])
        settle()
        assert (layout.word, window.size().toTuple()) == (layout.word, SIZES[0])
    window.reset_layout()  # all panels
    window.resize(*SIZES[0])
    settle()
    assert window.size().toTuple() == SIZES[0]
    assert "\n".join(faults_in(window)) == ""


@pytest.mark.parametrize("name", language.LANGUAGES)
def test_large_text_has_room(speaking, settings, name):
    settings.set("window.scale", 1.5)
    window = speaking(name)
    window.panels.make_all()
    window.arrangement.arrange(OPERATE)
    window.resize(*SIZES[1])
    settle()
    assert "\n".join(faults_in(window)) == ""
