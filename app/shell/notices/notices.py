"""Notices over the window, placed so that they cover nothing that is in use."""

import time
from collections.abc import Callable, Hashable, Iterator
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QSize, QTimer, Signal
from PySide6.QtGui import QCursor
from PySide6.QtWidgets import QMainWindow

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.notices.free_places import (
    FreeSpaceMap,
    find_header_bottom,
    find_used_places,
)
from rotemina.app.shell.notices.notice import Notice, NoticeStrip
from rotemina.app.workbench import Level, NoticeMessage
from rotemina.drivers.contract import Clock
from rotemina.sim.compatibility import FormerMember, serve_former_names

# The number of further notices is shown above the status bar.
MAX_SHOWN = 3
# Older notices are still in the log.
MAX_OPEN = 50
CONFIRMATION_TIME_S = 6.0
# A warning that is caused by an action must outlive that action.
_MIN_WARNING_TIME_S = 1.0
# Numbers of letters in a line, in order of preference.
_LINE_LENGTHS = (62, 46, 34)
# Share of the height available for notices that one long notice may take.
_MAX_HEIGHT_SHARE = 0.5
_SCROLLED_LINE_COUNTS = (5, 3, 2)
_MARGIN_PX = 8
_MOUSE_CLEARANCE_PX = 16
_CHECK_PERIOD_MS = 250
_ARRANGE_DELAY_MS = 40


class NoticeBoard(QObject):
    """The open notices, newest first, on top of the window's other contents.

    A confirmation disappears after 6 s, a warning or refusal with the next action, and an error
    when it is closed. Each disappears as soon as its cause is gone. A notice under the mouse does
    not change.

    A notice is placed near the lower right corner, where it covers no usable control, no other
    notice and not the mouse; if possible, it covers no text either. It moves when this is no longer
    true. A notice for which there is no free place becomes a line above the status bar.

    Signals
    -------
    page_asked(str) : the help page of this name should be opened.
    more_asked() : the user asked to see the notices that are not visible.
    """

    page_asked = Signal(str)
    more_asked = Signal()

    def __init__(self, window: QMainWindow, clock: Clock = time.monotonic) -> None:
        super().__init__(window)
        self._window, self._clock = window, clock
        self._open_notices: list[Notice] = []
        self.strip = NoticeStrip(window)
        self.strip.closed.connect(self._drop_unplaced)
        self.strip.more_asked.connect(self.more_asked)
        self._unplaced: list[Notice] = []
        self._timer = QTimer(self, interval=_CHECK_PERIOD_MS)
        self._timer.timeout.connect(self.drop_confirmations)
        self._arrange_timer = QTimer(self, interval=_ARRANGE_DELAY_MS, singleShot=True)
        self._arrange_timer.timeout.connect(lambda: self._arrange())
        window.installEventFilter(self)

    def show_notice(self, level: Level, text: NoticeMessage) -> None:
        """Add a notice, or count it as a repeat of an open one."""
        text = text if isinstance(text, NoticeMessage) else NoticeMessage(text)
        repeated = next(
            (open_notice for open_notice in self._open_notices if open_notice.text.key == text.key),
            None,
        )
        if repeated is not None:
            repeated.repeat(level, text, self._clock())
            self._open_notices.remove(repeated)
            # The newest is placed first, so a notice without a place gets one; others keep theirs.
            self._open_notices.insert(0, repeated)
            self._arrange_soon()
            return
        notice = Notice(level, text, self._clock(), self._window)
        notice.closed.connect(lambda: self._drop(lambda open_notice: open_notice is notice))
        notice.page_asked.connect(self.page_asked)
        self._open_notices.insert(0, notice)
        for oldest in self._open_notices[MAX_OPEN:]:
            self._remove(oldest)
        self._timer.start()
        self._arrange()

    def notices(self) -> list[Notice]:
        """Return the open notices, newest first."""
        return list(self._open_notices)

    def visible_notices(self) -> list[Notice]:
        """Return the notices that are visible."""
        return [notice for notice in self._open_notices if notice.isVisible()]

    def drop_confirmations(self) -> None:
        """Remove confirmations that have expired, and move notices that cover something."""
        latest_start_s = self._clock() - CONFIRMATION_TIME_S
        self._drop(
            lambda notice: (
                notice.level in (Level.INFO, Level.GOOD)
                and notice.since_s <= latest_start_s
                and not self._is_under_mouse(notice)
            )
        )
        if self._open_notices:
            self._arrange()
        else:
            self._timer.stop()

    def drop_settled(self, state: SessionState) -> None:
        """Remove notices whose cause is gone."""
        self._drop(
            lambda notice: (
                not self._is_under_mouse(notice)
                and notice.settle_causes(
                    lambda cause: cause.until is not None and cause.until(state)
                )
            )
        )

    def settle_subject(self, subject: Hashable) -> None:
        """Remove notices about an earlier failure of what has now succeeded."""
        self._drop(lambda notice: notice.settle_causes(lambda cause: cause.subject == subject))

    def drop_warnings(self) -> None:
        """Remove warnings and refusals, because the operator has since done something else."""
        latest_start_s = self._clock() - _MIN_WARNING_TIME_S
        self._drop(
            lambda notice: (
                (notice.level is Level.WARNING or notice.text.is_refusal)
                and notice.since_s <= latest_start_s
                and not self._is_under_mouse(notice)
            )
        )

    def _drop(self, is_over: Callable[[Notice], bool]) -> None:
        finished = [notice for notice in self._open_notices if is_over(notice)]
        for notice in finished:
            self._remove(notice)
        if finished:
            self._arrange()

    def _remove(self, notice: Notice) -> None:
        self._open_notices.remove(notice)
        notice.hide()
        notice.deleteLater()

    def _drop_unplaced(self) -> None:
        self._drop(lambda notice: notice in self._unplaced[:1])

    def _is_under_mouse(self, notice: Notice) -> bool:
        return notice.isVisible() and notice.geometry().contains(self._find_mouse())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Place the notices again when the window changes its size or layout."""
        if self._open_notices and event.type() == QEvent.Type.Resize:
            self._arrange(move_all=True)
        elif self._open_notices and event.type() == QEvent.Type.LayoutRequest:
            self._arrange_soon()
        return super().eventFilter(watched, event)

    def _arrange_soon(self) -> None:
        """Arrange the notices after a short delay, once for all events until then."""
        if not self._arrange_timer.isActive():
            self._arrange_timer.start()

    def _arrange(self, *, move_all: bool = False) -> None:
        """Place the notices; those that may stay keep their place, unless ``move_all`` is set."""
        self._arrange_timer.stop()
        under_mouse = [notice for notice in self._open_notices if self._is_under_mouse(notice)]
        shown_notices = [
            *under_mouse,
            *(notice for notice in self._open_notices if notice not in under_mouse),
        ][:MAX_SHOWN]
        controls, content = find_used_places(self._window, {self.strip, *self._open_notices})
        places = _NoticePlaces(self._find_area(), controls, content, self._find_mouse())
        for notice in under_mouse:
            places.take(notice.geometry())
        movable = [notice for notice in shown_notices if notice not in under_mouse]
        notices_to_place = [
            notice for notice in movable if move_all or not self._keep_place(notice, places)
        ]
        self._unplaced = [
            notice for notice in notices_to_place if not self._place_notice(notice, places)
        ]
        for notice in self._open_notices:
            if notice not in shown_notices or notice in self._unplaced:
                notice.hide()
        self._show_strip(controls)

    def _keep_place(self, notice: Notice, places: "_NoticePlaces") -> bool:
        notice.show_repeats()
        if not (notice.isVisible() and notice.has_room and places.may_stay(notice.geometry())):
            return False
        places.take(notice.geometry())
        notice.raise_()
        return True

    def _place_notice(self, notice: Notice, places: "_NoticePlaces") -> bool:
        notice.show_repeats()
        notice.polish()
        for size, avoid_text in _list_sizes(notice, places.area.size()):
            rect = places.find(size, avoid_text=avoid_text)
            if rect is not None:
                places.take(rect)
                notice.show_at(rect)
                return True
        return False

    def _find_area(self) -> QRect:
        window = self._window
        top = find_header_bottom(window)
        area = QRect(0, top, window.width(), self._find_status_line().top() - top)
        return area.adjusted(_MARGIN_PX, _MARGIN_PX, -_MARGIN_PX, -_MARGIN_PX)

    def _find_status_line(self) -> QRect:
        bar = self._window.statusBar()
        if bar.isVisible():
            return bar.geometry()
        height = bar.sizeHint().height()
        return QRect(0, self._window.height() - height, self._window.width(), height)

    def _show_strip(self, controls: list[QRect]) -> None:
        """Show unplaced notices above the status bar, left of its buttons."""
        unplaced = self._unplaced[0] if self._unplaced else None
        further_count = (
            len(self._open_notices) - len(self.visible_notices()) - (unplaced is not None)
        )
        self.strip.show_notices(unplaced, further_count)
        line_rect = self._find_status_line()
        button_lefts = [rect.left() for rect in controls if rect.intersects(line_rect)]
        line_rect.setRight(min([line_rect.right(), *button_lefts]) - _MARGIN_PX)
        if unplaced is None:
            line_rect.setLeft(line_rect.right() - self.strip.sizeHint().width() + 1)
        self.strip.setGeometry(line_rect)
        self.strip.raise_()

    def _find_mouse(self) -> QPoint:
        return self._window.mapFromGlobal(QCursor.pos())

    # Former names, which work for one more release.
    act = FormerMember("drop_warnings")
    asked = FormerMember("page_asked")
    look = FormerMember("drop_confirmations")
    look_at = FormerMember("drop_settled")
    settle = FormerMember("settle_subject")
    shown = FormerMember("visible_notices")


class _NoticePlaces:
    """Places for notices: an area without controls, and the part of it without text."""

    def __init__(
        self, area: QRect, controls: list[QRect], content: list[QRect], mouse: QPoint
    ) -> None:
        self.area = area
        mouse_rect = QRect(
            mouse - QPoint(_MOUSE_CLEARANCE_PX, _MOUSE_CLEARANCE_PX),
            mouse + QPoint(_MOUSE_CLEARANCE_PX, _MOUSE_CLEARANCE_PX),
        )
        self._free_of_controls = FreeSpaceMap(area, controls)
        self._usable = FreeSpaceMap(area, [*controls, mouse_rect])
        self._clear = FreeSpaceMap(area, [*controls, mouse_rect, *content])

    def take(self, rect: QRect) -> None:
        """Reserve a rectangle for one notice."""
        for places in (self._free_of_controls, self._usable, self._clear):
            places.take(rect)

    def may_stay(self, rect: QRect) -> bool:
        """Return whether a rectangle covers no control and no other notice."""
        return self._free_of_controls.is_free(rect)

    def find(self, size: QSize, *, avoid_text: bool) -> QRect | None:
        """Return a free place for a notice, or None; ``avoid_text`` excludes places over text."""
        return (self._clear if avoid_text else self._usable).find(size)


def _list_sizes(notice: Notice, available: QSize) -> Iterator[tuple[QSize, bool]]:
    """Yield possible sizes of a notice, the best first, and whether to avoid covering text.

    It is better to show the full text and cover other text than to scroll.
    """
    widths = [min(letters * notice.letter_width_px, available.width()) for letters in _LINE_LENGTHS]
    max_height = round(_MAX_HEIGHT_SHARE * available.height())
    full_sizes = [QSize(width, min(notice.heightForWidth(width), max_height)) for width in widths]
    scrolled_sizes = (
        [
            QSize(size.width(), min(notice.height_for_lines(lines), size.height()))
            for size in full_sizes
        ]
        for lines in _SCROLLED_LINE_COUNTS
    )
    for sizes in (full_sizes, *scrolled_sizes):
        for avoid_text in (True, False):
            yield from ((size, avoid_text) for size in sizes)


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        CONFIRMATION_S="CONFIRMATION_TIME_S",
        MOST="MAX_SHOWN",
        MOST_OPEN="MAX_OPEN",
    )
