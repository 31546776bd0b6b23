"""Notices over the window: what the operator must know, without covering what is used."""

import time
from collections.abc import Callable, Hashable, Iterator

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QSize, QTimer, Signal
from PySide6.QtGui import QCursor
from PySide6.QtWidgets import QMainWindow

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.free_places import FreePlaces, used_places
from rotemina.app.shell.header_row import bottom_of_header
from rotemina.app.shell.help_topics import Explained
from rotemina.app.shell.notice import Notice, NoticeStrip
from rotemina.app.shell.workbench import Level
from rotemina.drivers.clock import Clock

MOST = 3  # are shown; how many more there are is said on the status bar
MOST_OPEN = 50  # the log keeps older ones
CONFIRMATION_S = 6.0
_READ_S = 1.0  # a warning that an action itself has caused outlives that action
_LETTERS = (62, 46, 34)  # in a line, the best first
_SHARE = 0.5  # of the height that a window has for notices, which a long one takes at most
_LINES = (5, 3, 2)  # of a text that scrolls for want of room
_MARGIN = 8  # px
_REACH = 16  # px around the mouse that stay free
_LOOK_MS = 250
_SOON_MS = 40


class NoticeBoard(QObject):
    """The notices that are still open, newest first, over what else is shown.

    A confirmation goes after 6 s, a warning and a refusal with the next action, an error when it is
    closed, and each as soon as its cause is gone. One under the mouse stays, where and as it is.

    A notice stands next to the lower right corner, where it covers no control that can be used,
    nor the mouse, nor another notice; if it can, it covers no text either. It takes another place
    when that is no longer so. For want of any place it is a line over the status bar.

    Signals
    -------
    asked(str) : which page of the help is to be opened.
    more_asked() : those that are not seen are wanted.
    """

    asked = Signal(str)
    more_asked = Signal()

    def __init__(self, window: QMainWindow, clock: Clock = time.monotonic) -> None:
        super().__init__(window)
        self._window, self._clock = window, clock
        self._open: list[Notice] = []
        self.strip = NoticeStrip(window)
        self.strip.closed.connect(self._close_unplaced)
        self.strip.more_asked.connect(self.more_asked)
        self._unplaced: list[Notice] = []
        self._timer = QTimer(self, interval=_LOOK_MS)
        self._timer.timeout.connect(self.look)
        self._soon = QTimer(self, interval=_SOON_MS, singleShot=True)
        self._soon.timeout.connect(lambda: self._arrange())
        window.installEventFilter(self)

    def show_notice(self, level: Level, text: Explained) -> None:
        """Add a notice; one that is open already is counted up where it is."""
        text = text if isinstance(text, Explained) else Explained(text)
        before = next((one for one in self._open if one.text.key == text.key), None)
        if before is not None:
            before.repeat(level, text, self._clock())
            self._open.remove(before)
            self._open.insert(0, before)  # so one without a place gets one; others keep theirs
            self._arrange_soon()
            return
        notice = Notice(level, text, self._clock(), self._window)
        notice.closed.connect(lambda: self._drop(lambda one: one is notice))
        notice.asked.connect(self.asked)
        self._open.insert(0, notice)
        for oldest in self._open[MOST_OPEN:]:
            self._remove(oldest)
        self._timer.start()
        self._arrange()

    def notices(self) -> list[Notice]:
        """Return the open notices, newest first."""
        return list(self._open)

    def shown(self) -> list[Notice]:
        """Return those that have a place."""
        return [one for one in self._open if one.isVisible()]

    # --- when they go -----------------------------------------------------------------------------

    def look(self) -> None:
        """Let confirmations go that have been read, and place anew what covers something."""
        before_s = self._clock() - CONFIRMATION_S
        self._drop(
            lambda one: (
                one.level in (Level.INFO, Level.GOOD)
                and one.since_s <= before_s
                and not self._is_held(one)
            )
        )
        if self._open:
            self._arrange()
        else:
            self._timer.stop()

    def look_at(self, state: SessionState) -> None:
        """Let those go whose cause is gone."""
        self._drop(
            lambda one: (
                not self._is_held(one)
                and one.settle(lambda cause: cause.until is not None and cause.until(state))
            )
        )

    def settle(self, subject: Hashable) -> None:
        """Let those go that told of an earlier failure of what is done now."""
        self._drop(lambda one: one.settle(lambda cause: cause.subject == subject))

    def act(self) -> None:
        """Let warnings and refusals go: the operator has done something else since."""
        before_s = self._clock() - _READ_S
        self._drop(
            lambda one: (
                (one.level is Level.WARNING or one.text.is_refusal)
                and one.since_s <= before_s
                and not self._is_held(one)
            )
        )

    def _drop(self, is_over: Callable[[Notice], bool]) -> None:
        gone = [one for one in self._open if is_over(one)]
        for one in gone:
            self._remove(one)
        if gone:
            self._arrange()

    def _remove(self, notice: Notice) -> None:
        self._open.remove(notice)
        notice.hide()
        notice.deleteLater()

    def _close_unplaced(self) -> None:
        self._drop(lambda one: one in self._unplaced[:1])

    def _is_held(self, notice: Notice) -> bool:
        """Whether the mouse is over a notice."""
        return notice.isVisible() and notice.geometry().contains(self._mouse())

    # --- where they are ---------------------------------------------------------------------------

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Place them anew in a window of another size or layout."""
        if self._open and event.type() == QEvent.Type.Resize:
            self._arrange(anew=True)
        elif self._open and event.type() == QEvent.Type.LayoutRequest:
            self._arrange_soon()
        return super().eventFilter(watched, event)

    def _arrange_soon(self) -> None:
        """Arrange them once for all that happens until then."""
        if not self._soon.isActive():
            self._soon.start()

    def _arrange(self, *, anew: bool = False) -> None:
        """Leave each where it may stay, unless ``anew``, and give the others a place."""
        self._soon.stop()
        held = [one for one in self._open if self._is_held(one)]
        wanted = [*held, *(one for one in self._open if one not in held)][:MOST]
        controls, content = used_places(self._window, {self.strip, *self._open})
        places = _Places(self._area(), controls, content, self._mouse())
        for one in held:
            places.take(one.geometry())
        free = [one for one in wanted if one not in held]
        fresh = [one for one in free if anew or not self._stays(one, places)]
        self._unplaced = [one for one in fresh if not self._place(one, places)]
        for one in self._open:
            if one not in wanted or one in self._unplaced:
                one.hide()
        self._show_strip(controls)

    def _stays(self, notice: Notice, places: "_Places") -> bool:
        """Take the place that a notice has, if it may stay there with what it says now."""
        notice.show_repeats()
        if not (notice.isVisible() and notice.fits and places.may_stay(notice.geometry())):
            return False
        places.take(notice.geometry())
        notice.raise_()
        return True

    def _place(self, notice: Notice, places: "_Places") -> bool:
        """Give a notice the best place that there is; return whether there is one."""
        notice.show_repeats()
        notice.polish()
        for size, clear in _sizes(notice, places.area.size()):
            rect = places.find(size, clear=clear)
            if rect is not None:
                places.take(rect)
                notice.stand(rect)
                return True
        return False

    def _area(self) -> QRect:
        """Return where notices may be: below the header, above the status bar."""
        window = self._window
        top = bottom_of_header(window)
        area = QRect(0, top, window.width(), self._line().top() - top)
        return area.adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN)

    def _line(self) -> QRect:
        bar = self._window.statusBar()
        if bar.isVisible():
            return bar.geometry()
        height = bar.sizeHint().height()
        return QRect(0, self._window.height() - height, self._window.width(), height)

    def _show_strip(self, controls: list[QRect]) -> None:
        """Say over the status bar, left of its buttons, what has no place."""
        unplaced = self._unplaced[0] if self._unplaced else None
        beyond = len(self._open) - len(self.shown()) - (unplaced is not None)
        self.strip.show_notices(unplaced, beyond)
        line = self._line()
        buttons = [rect.left() for rect in controls if rect.intersects(line)]
        line.setRight(min([line.right(), *buttons]) - _MARGIN)
        if unplaced is None:
            line.setLeft(line.right() - self.strip.sizeHint().width() + 1)
        self.strip.setGeometry(line)
        self.strip.raise_()

    def _mouse(self) -> QPoint:
        return self._window.mapFromGlobal(QCursor.pos())


class _Places:
    """Where notices may be: an area without controls, and the part of it without text, too."""

    def __init__(
        self, area: QRect, controls: list[QRect], content: list[QRect], mouse: QPoint
    ) -> None:
        self.area = area
        around = QRect(mouse - QPoint(_REACH, _REACH), mouse + QPoint(_REACH, _REACH))
        self._lasting = FreePlaces(area, controls)
        self._usable = FreePlaces(area, [*controls, around])
        self._clear = FreePlaces(area, [*controls, around, *content])

    def take(self, rect: QRect) -> None:
        """Let no other notice have a place."""
        for places in (self._lasting, self._usable, self._clear):
            places.take(rect)

    def may_stay(self, rect: QRect) -> bool:
        """Return whether a notice covers no control there, and no other notice."""
        return self._lasting.is_free(rect)

    def find(self, size: QSize, *, clear: bool) -> QRect | None:
        """Return a place for a new notice, ``clear`` of text or not; None where there is none."""
        return (self._clear if clear else self._usable).find(size)


def _sizes(notice: Notice, room: QSize) -> Iterator[tuple[QSize, bool]]:
    """Yield the sizes that a notice may have, the best first, and whether it may cover no text.

    All of a text over another is better than a text that scrolls.
    """
    widths = [min(letters * notice.letter_width, room.width()) for letters in _LETTERS]
    most = round(_SHARE * room.height())
    whole = [QSize(width, min(notice.heightForWidth(width), most)) for width in widths]
    shorter = (
        [QSize(size.width(), min(notice.height_of(lines), size.height())) for size in whole]
        for lines in _LINES
    )
    for sizes in (whole, *shorter):
        for clear in (True, False):
            yield from ((size, clear) for size in sizes)
