"""Notices: their content, how long they stay, and that they cover no control."""

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

from rotemina.app.language import translate
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.notices import NoticeBoard
from rotemina.app.shell.notices.free_places import find_used_places
from rotemina.app.shell.window import BUILT_IN
from rotemina.app.widgets.style.theme import DARK, apply_theme
from rotemina.app.workbench import Level, NoticeMessage
from rotemina.sim.messages import AxisName, message
from rotemina.sim.units import format_quantity

OUTSIDE_WINDOW = QPoint(-100, -100)
LONG_WORDS = "a word or two " * 143  # 2000 characters
LONG_PATH = "/a" + "_path_without_blanks" * 50
MANY_LINES = "\n".join(f"line {n}" for n in range(60))


class Clock:
    """A clock that the test sets."""

    now_s = 100.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def window(qtbot):
    main_window = QMainWindow()
    qtbot.addWidget(main_window)
    main_window.setCentralWidget(QWidget())
    main_window.statusBar()
    main_window.resize(1280, 800)
    main_window.show()
    return main_window


@pytest.fixture
def notices(window):
    """Notices with no mouse over them."""
    board = NoticeBoard(window, Clock())
    board._find_mouse = lambda: OUTSIDE_WINDOW
    return board


def get_texts(notices):
    return [notice.text for notice in notices.notices()]


def get_geometries(notices):
    return [notice.geometry() for notice in notices.visible_notices()]


def find_text_view(notice):
    return notice.findChild(QTextEdit)


def fill_with_buttons(window, rows=30, columns=8):
    """Fill the whole window with buttons."""
    grid = QGridLayout(window.centralWidget())
    grid.setSpacing(2)
    for cell in range(rows * columns):
        button = QPushButton("x")
        button.setMinimumSize(10, 10)
        grid.addWidget(button, *divmod(cell, columns))
    QApplication.processEvents()
    return window.findChildren(QPushButton)


def test_notices_appear_at_the_lower_right_and_move_nothing(window, notices):
    QApplication.processEvents()
    before = window.centralWidget().geometry()
    for number in "abcde":
        notices.show_notice(Level.ERROR, f"fault {number}, which takes more than one line " * 3)
    QApplication.processEvents()
    assert window.centralWidget().geometry() == before
    assert [notice.text[:7] for notice in notices.visible_notices()] == [
        "fault e",
        "fault d",
        "fault c",
    ]
    assert notices.strip.more.text() == "+2 more"
    for size in ((1920, 800), (1280, 800), (600, 500)):
        window.resize(*size)
        QApplication.processEvents()
        area = window.rect().adjusted(0, 0, 0, -window.statusBar().height())
        assert len(get_geometries(notices)) == 3
        assert all(area.contains(place) for place in get_geometries(notices))
        assert max(place.right() for place in get_geometries(notices)) > window.width() - 16
    assert notices.strip.geometry().intersects(window.statusBar().geometry())


@pytest.mark.parametrize(
    ("text", "scale"),
    [(LONG_WORDS, 1.0), (LONG_PATH, 2.0), (MANY_LINES, 2.0)],
    ids=["words", "path", "lines"],
)
def test_a_long_text_can_be_read_completely_within_the_window(window, notices, text, scale):
    apply_theme(window, DARK, scale)
    window.resize(1024, 720)
    notices.show_notice(Level.ERROR, text)
    QApplication.processEvents()
    (notice,) = notices.visible_notices()
    shown = find_text_view(notice)
    assert window.rect().contains(notice.geometry())
    assert shown.document().size().width() <= shown.viewport().width()
    bar = shown.verticalScrollBar()
    assert bar.maximum() + shown.viewport().height() >= int(shown.document().size().height())
    shown.selectAll()
    shown.copy()
    assert QGuiApplication.clipboard().text() == text


def test_a_short_text_does_not_scroll_at_any_text_scale(window, notices):
    notices.show_notice(Level.ERROR, "a word or two " * 12)
    for scale in (0.9, 1.3, 2.0):
        apply_theme(window, DARK, scale)
        notices.drop_confirmations()
        QApplication.processEvents()
        assert find_text_view(notices.notices()[0]).verticalScrollBar().maximum() == 0


def test_repeats_count_up_in_place_with_the_newest_values(notices):
    def make_limit_error(axis, position_m):
        template = message("engine", "axis {axis}: target {target} is outside")
        return NoticeMessage(
            template.fill(axis=AxisName(axis), target=format_quantity(position_m, "m"))
        )

    def make_stop_warning(duration_s, at):
        template = translate("shell", "stopped after {duration_s:.2f} s, at {at}")
        return NoticeMessage(template.format(duration_s=duration_s, at=at))

    notices.show_notice(Level.ERROR, make_limit_error("x", 5e-4))
    notices.show_notice(Level.WARNING, make_stop_warning(0.5, "12:00:01"))
    before = [(notice, notice.geometry()) for notice in notices.visible_notices()]
    notices.show_notice(Level.ERROR, make_limit_error("x", 2e-3))  # in another unit
    notices.show_notice(Level.WARNING, make_stop_warning(11.0, "12:00:02"))
    notices.show_notice(Level.ERROR, make_limit_error("x", 3e-3))
    notices.drop_confirmations()
    assert [(notice, notice.geometry()) for notice in notices.visible_notices()] == before[::-1]
    assert [
        (notice.count, find_text_view(notice).toPlainText()) for notice in notices.visible_notices()
    ] == [(3, "axis X: target 3 mm is outside"), (2, "stopped after 11.00 s, at 12:00:02")]
    assert [notice.findChild(QLabel).text() for notice in notices.visible_notices()] == [
        "× 3",
        "× 2",
    ]
    # A different axis is a different notice.
    notices.show_notice(Level.ERROR, make_limit_error("y", 3e-3))
    assert len(notices.notices()) == 3


def test_a_thousand_repeats_are_laid_out_once(qtbot, notices, monkeypatch):
    notices.show_notice(Level.ERROR, "board 2: fault 0")
    layouts = []
    original_arrange = notices._arrange
    monkeypatch.setattr(notices, "_arrange", lambda: (layouts.append(1), original_arrange()))
    for number in range(1000):
        notices.show_notice(Level.ERROR, f"board 2: fault {number}")
    assert layouts == []
    qtbot.waitUntil(lambda: bool(layouts))
    (notice,) = notices.visible_notices()
    assert (notice.count, find_text_view(notice).toPlainText()) == (1001, "board 2: fault 999")


def test_notices_expire_by_level_and_errors_stay_until_closed(notices):
    clock = notices._clock
    for level in (Level.GOOD, Level.WARNING, Level.ERROR):
        notices.show_notice(level, str(level))
    notices.show_notice(Level.ERROR, NoticeMessage("refused", is_refusal=True))
    notices.drop_warnings()  # by the action that caused it
    clock.now_s += 5.9
    notices.drop_confirmations()
    assert get_texts(notices) == ["refused", "error", "warning", "good"]
    clock.now_s += 0.2
    notices.notices()[-1].closed.emit()
    notices.drop_confirmations()
    assert get_texts(notices) == ["refused", "error", "warning"]
    notices.drop_warnings()
    assert get_texts(notices) == ["error"]
    notices.notices()[0].closed.emit()
    assert notices.visible_notices() == []


def test_a_notice_under_the_mouse_does_not_change(notices):
    clock = notices._clock
    notices.show_notice(Level.GOOD, "saved 1")
    (notice,) = notices.visible_notices()
    before = notice.geometry()
    notices._find_mouse = lambda: before.center()
    clock.now_s += 60.0
    notices.show_notice(Level.GOOD, "saved 2, and more than that " * 9)
    notices.show_notice(Level.GOOD, "saved 2")
    notices.drop_warnings()
    notices.drop_confirmations()
    assert notice.geometry() == before
    assert find_text_view(notice).toPlainText() == "saved 1"
    notices._find_mouse = lambda: OUTSIDE_WINDOW
    notices.drop_confirmations()
    assert find_text_view(notice).toPlainText() == "saved 2"
    clock.now_s += 60.0
    notices.drop_confirmations()
    assert notices.notices() == []


def test_a_notice_goes_as_soon_as_its_cause_is_gone(notices):
    notices.show_notice(Level.ERROR, NoticeMessage("lost", until=lambda state: state.fault is None))
    notices.show_notice(Level.ERROR, NoticeMessage("<b>x</b> cannot be saved", subject="save"))
    notices.drop_settled(SessionState(fault="lost"))
    notices.settle_subject("load")
    assert len(notices.notices()) == 2
    notices.drop_settled(SessionState())
    (notice,) = notices.notices()
    assert find_text_view(notice).toPlainText() == "<b>x</b> cannot be saved"  # as plain text
    notices.settle_subject("save")
    assert notices.notices() == []


def test_no_notice_appears_under_the_mouse(window, notices):
    mouse = QPoint(1100, 740)
    notices._find_mouse = lambda: mouse
    notices.show_notice(Level.ERROR, "here")
    (place,) = get_geometries(notices)
    assert not place.contains(mouse)


def test_notices_move_away_from_controls_that_appear_below_them(window, notices):
    notices.show_notice(Level.ERROR, "here")
    (before,) = get_geometries(notices)
    button = QPushButton("go", window.centralWidget())
    button.setGeometry(QRect(before.center(), before.size() / 4))
    button.setEnabled(False)
    button.show()
    notices.drop_confirmations()
    assert get_geometries(notices) == [before]  # a disabled one can be covered
    button.setEnabled(True)
    notices.drop_confirmations()
    (after,) = get_geometries(notices)
    assert not after.intersects(button.geometry())


def test_notices_shrink_to_a_line_in_the_status_bar_without_space(window, notices, qtbot):
    buttons = fill_with_buttons(window)
    for number in "ab":
        notices.show_notice(Level.ERROR, f"fault {number}")
    assert notices.visible_notices() == []
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
    assert len(notices.visible_notices()) == 1


@pytest.mark.every_panel
def test_no_control_of_any_layout_is_covered(make_robot_window):
    window = make_robot_window()
    board = window.notices
    board._find_mouse = lambda: OUTSIDE_WINDOW
    for text in ("a short one", LONG_WORDS, "a remark of some words " * 6):
        window.workbench.notify(Level.ERROR, text)
    for size in ((1920, 1080), (1024, 720)):
        window.resize(*size)
        for layout in BUILT_IN:
            window.arrangement.arrange(layout)
            docks = [window.docks[name] for name in layout.docks if name in window.docks]
            for dock in docks if size == (1024, 720) else docks[:1]:
                dock.raise_()
                for _ in range(3):
                    QApplication.processEvents()
                board.drop_confirmations()
                situation = f"{layout.plain_title} at {size}, {dock.windowTitle()} in front"
                controls, _ = find_used_places(window, {board.strip, *board.notices()})
                covering = [
                    place for place in get_geometries(board) if any(map(place.intersects, controls))
                ]
                assert covering == [], situation
                assert all(map(window.rect().contains, get_geometries(board))), situation
                assert board.visible_notices() or board.strip.isVisible(), situation


@pytest.mark.parametrize("text", ["", "\n", "first line\nsecond line"])
def test_a_notice_without_a_free_place_may_have_any_number_of_lines(window, notices, text):
    fill_with_buttons(window)
    notices.show_notice(Level.ERROR, text)
    QApplication.processEvents()
    assert notices.strip.text.text() == ("first line" if "first" in text else "")
