"""Notices: what they show, how long they stay, and that they cover nothing that is used."""

import pytest
from PySide6.QtCore import QPoint, QRect
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import (
    QApplication,
    QGridLayout,
    QLabel,
    QMainWindow,
    QPushButton,
    QTextEdit,
    QWidget,
)

from rotemina.app.motion.state import SessionState
from rotemina.app.shell import language
from rotemina.app.shell.free_places import used_places
from rotemina.app.shell.help_topics import Explained
from rotemina.app.shell.language import SETTING, translate
from rotemina.app.shell.layouts import BUILT_IN
from rotemina.app.shell.notices import NoticeBoard
from rotemina.app.shell.theme import DARK, dress
from rotemina.app.shell.workbench import Level
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import amount

AWAY = QPoint(-100, -100)
LONG = "a word or two " * 143  # 2000 characters
LONG_TEXTS = (LONG, "/a" + "_path_without_blanks" * 50, "\n".join(f"line {n}" for n in range(60)))


class Clock:
    """A clock that the test sets."""

    now_s = 100.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def window(qtbot):
    made = QMainWindow()
    qtbot.addWidget(made)
    made.setCentralWidget(QWidget())
    made.statusBar()
    made.resize(1280, 800)
    made.show()
    return made


@pytest.fixture
def notices(window):
    """Notices with no mouse over them."""
    made = NoticeBoard(window, Clock())
    made._mouse = lambda: AWAY
    return made


def texts(notices):
    return [one.text for one in notices.notices()]


def places(notices):
    return [one.geometry() for one in notices.shown()]


def body(notice):
    return notice.findChild(QTextEdit)


def fill_with_buttons(window, rows=30, columns=8):
    """Leave no room of the window without a button."""
    grid = QGridLayout(window.centralWidget())
    grid.setSpacing(2)
    for place in range(rows * columns):
        button = QPushButton("x")
        button.setMinimumSize(10, 10)
        grid.addWidget(button, *divmod(place, columns))
    QApplication.processEvents()
    return window.findChildren(QPushButton)


def test_they_stand_at_the_lower_right_and_move_nothing(window, notices):
    QApplication.processEvents()
    before = window.centralWidget().geometry()
    for number in "abcde":
        notices.show_notice(Level.ERROR, f"fault {number}, which takes more than one line " * 3)
    QApplication.processEvents()
    assert window.centralWidget().geometry() == before
    assert [one.text[:7] for one in notices.shown()] == ["fault e", "fault d", "fault c"]
    assert notices.strip.more.text() == "+2 more"
    for size in ((1920, 800), (1280, 800), (600, 500)):
        window.resize(*size)
        QApplication.processEvents()
        area = window.rect().adjusted(0, 0, 0, -window.statusBar().height())
        assert len(places(notices)) == 3
        assert all(area.contains(place) for place in places(notices))
        assert max(place.right() for place in places(notices)) > window.width() - 16
    assert notices.strip.geometry().intersects(window.statusBar().geometry())


@pytest.mark.parametrize("scale", [1.0, 2.0])
@pytest.mark.parametrize("text", LONG_TEXTS, ids=["words", "path", "lines"])
def test_a_long_text_is_there_whole_and_within_the_window(window, notices, text, scale):
    dress(window, DARK, scale)
    window.resize(1024, 720)
    notices.show_notice(Level.ERROR, text)
    QApplication.processEvents()
    (notice,) = notices.shown()
    shown = body(notice)
    assert window.rect().contains(notice.geometry())
    assert shown.document().size().width() <= shown.viewport().width()
    bar = shown.verticalScrollBar()
    assert bar.maximum() + shown.viewport().height() >= int(shown.document().size().height())
    shown.selectAll()
    shown.copy()
    assert QGuiApplication.clipboard().text() == text


def test_a_short_text_does_not_scroll_at_any_size_of_text(window, notices):
    notices.show_notice(Level.ERROR, "a word or two " * 12)
    for scale in (0.9, 1.3, 2.0):
        dress(window, DARK, scale)
        notices.look()
        QApplication.processEvents()
        assert body(notices.notices()[0]).verticalScrollBar().maximum() == 0


def test_repeats_count_up_in_place_with_the_newest_values(notices):
    def outside(axis, position_m):
        told = message("engine", "axis {axis}: target {target} is outside")
        return Explained(told.fill(axis=AxisName(axis), target=amount(position_m, "m")))

    def stopped(duration_s, at):
        told = translate("shell", "stopped after {duration_s:.2f} s, at {at}")
        return Explained(told.format(duration_s=duration_s, at=at))

    notices.show_notice(Level.ERROR, outside("x", 5e-4))
    notices.show_notice(Level.WARNING, stopped(0.5, "12:00:01"))
    before = [(one, one.geometry()) for one in notices.shown()]
    notices.show_notice(Level.ERROR, outside("x", 2e-3))  # in another unit
    notices.show_notice(Level.WARNING, stopped(11.0, "12:00:02"))
    notices.show_notice(Level.ERROR, outside("x", 3e-3))
    notices.look()
    assert [(one, one.geometry()) for one in notices.shown()] == before[::-1]
    assert [(one.count, body(one).toPlainText()) for one in notices.shown()] == [
        (3, "axis X: target 3 mm is outside"),
        (2, "stopped after 11.00 s, at 12:00:02"),
    ]
    assert [one.findChild(QLabel).text() for one in notices.shown()] == ["× 3", "× 2"]
    notices.show_notice(Level.ERROR, outside("y", 3e-3))  # another axis is another matter
    assert len(notices.notices()) == 3


def test_a_thousand_repeats_are_laid_out_once(qtbot, notices, monkeypatch):
    notices.show_notice(Level.ERROR, "board 2: fault 0")
    laid_out = []
    arrange = notices._arrange
    monkeypatch.setattr(notices, "_arrange", lambda: (laid_out.append(1), arrange()))
    for number in range(1000):
        notices.show_notice(Level.ERROR, f"board 2: fault {number}")
    assert laid_out == []
    qtbot.waitUntil(lambda: bool(laid_out))
    (notice,) = notices.shown()
    assert (notice.count, body(notice).toPlainText()) == (1001, "board 2: fault 999")


def test_each_goes_when_it_has_served_and_a_fault_when_it_is_closed(notices):
    clock = notices._clock
    for level in (Level.GOOD, Level.WARNING, Level.ERROR):
        notices.show_notice(level, str(level))
    notices.show_notice(Level.ERROR, Explained("refused", is_refusal=True))
    notices.act()  # by the action that caused it
    clock.now_s += 5.9
    notices.look()
    assert texts(notices) == ["refused", "error", "warning", "good"]
    clock.now_s += 0.2
    notices.notices()[-1].closed.emit()
    notices.look()
    assert texts(notices) == ["refused", "error", "warning"]
    notices.act()
    assert texts(notices) == ["error"]
    notices.notices()[0].closed.emit()
    assert notices.shown() == []


def test_one_under_the_mouse_stays_as_it_is(notices):
    clock = notices._clock
    notices.show_notice(Level.GOOD, "saved 1")
    (notice,) = notices.shown()
    before = notice.geometry()
    notices._mouse = lambda: before.center()
    clock.now_s += 60.0
    notices.show_notice(Level.GOOD, "saved 2, and more than that " * 9)
    notices.show_notice(Level.GOOD, "saved 2")
    notices.act()
    notices.look()
    assert notice.geometry() == before
    assert body(notice).toPlainText() == "saved 1"
    notices._mouse = lambda: AWAY
    notices.look()
    assert body(notice).toPlainText() == "saved 2"
    clock.now_s += 60.0
    notices.look()
    assert notices.notices() == []


def test_one_goes_as_soon_as_its_cause_is_gone(notices):
    notices.show_notice(Level.ERROR, Explained("lost", until=lambda state: state.fault is None))
    notices.show_notice(Level.ERROR, Explained("cannot be saved", subject="save"))
    notices.look_at(SessionState(fault="lost"))
    notices.settle("load")
    assert len(notices.notices()) == 2
    notices.look_at(SessionState())
    assert texts(notices) == ["cannot be saved"]
    notices.settle("save")
    assert notices.notices() == []


def test_none_comes_up_under_the_mouse(window, notices):
    mouse = QPoint(1100, 740)
    notices._mouse = lambda: mouse
    notices.show_notice(Level.ERROR, "here")
    (place,) = places(notices)
    assert not place.contains(mouse)


def test_they_leave_controls_that_appear_below_them(window, notices):
    notices.show_notice(Level.ERROR, "here")
    (before,) = places(notices)
    button = QPushButton("go", window.centralWidget())
    button.setGeometry(QRect(before.center(), before.size() / 4))
    button.setEnabled(False)
    button.show()
    notices.look()
    assert places(notices) == [before]  # a disabled one can be covered
    button.setEnabled(True)
    notices.look()
    (after,) = places(notices)
    assert not after.intersects(button.geometry())


def test_they_are_a_line_over_the_status_bar_where_there_is_no_place(window, notices, qtbot):
    buttons = fill_with_buttons(window)
    for number in "ab":
        notices.show_notice(Level.ERROR, f"fault {number}")
    assert notices.shown() == []
    strip = notices.strip
    assert strip.text.text() == "fault b"
    assert window.statusBar().geometry().contains(strip.geometry())
    assert not any(
        QRect(button.mapTo(window, QPoint()), button.size()).intersects(strip.geometry())
        for button in buttons
    )
    with qtbot.waitSignal(notices.more_asked):
        strip.more.click()
    strip.close_button.click()
    assert strip.text.text() == "fault a"
    strip.close_button.click()
    assert not strip.isVisible()
    for button in buttons:
        button.setEnabled(False)
    notices.show_notice(Level.ERROR, "fault c")
    assert len(notices.shown()) == 1


@pytest.mark.every_panel
@pytest.mark.parametrize("speaks", ["en", pytest.param("de", marks=pytest.mark.slow)])
def test_no_control_of_any_layout_is_covered(qapp, settings, make_robot_window, speaks):
    settings.set(SETTING, speaks)
    window = make_robot_window()
    board = window.notices
    board._mouse = lambda: AWAY
    for text in ("a short one", LONG, "a remark of some words " * 6):
        window.workbench.notify(Level.ERROR, text)
    for size in ((1920, 1080), (1280, 800), (1024, 720)):
        window.resize(*size)
        for layout in BUILT_IN:
            window.arrangement.arrange(layout)
            docks = [window.docks[name] for name in layout.docks if name in window.docks]
            for dock in docks if size == (1280, 800) else docks[:1]:
                dock.raise_()
                for _ in range(3):
                    QApplication.processEvents()
                board.look()
                here = f"{layout.word} at {size}, {dock.windowTitle()} in front"
                controls, _ = used_places(window, {board.strip, *board.notices()})
                over = [place for place in places(board) if any(map(place.intersects, controls))]
                assert over == [], here
                assert all(map(window.rect().contains, places(board))), here
                assert board.shown() or board.strip.isVisible(), here
    language.use(qapp, language.ENGLISH)
