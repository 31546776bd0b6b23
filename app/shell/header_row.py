"""Where the parts of the header stand: plain arithmetic, for each width and each size of text."""

from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QMenu, QSizePolicy, QToolBar, QToolButton, QWidget

from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import plain_tip

_TEXT = 13.0  # px, of normal text
_MARGIN, _GAP = 8, 10  # px


class Sizes(NamedTuple):
    """The header's height and the sizes of its parts, px at normal text."""

    height: int
    badge: QSize
    state: QSize
    lock: QSize
    stop: QSize

    @property
    def width(self) -> int:
        """What the parts take side by side, without any chip."""
        return sum(each.width() for each in self[1:]) + 2 * _MARGIN + 3 * _GAP

    def scaled(self, scale: float) -> "Sizes":
        """Return the sizes at another size of text."""
        return Sizes(round(self.height * scale), *(each * scale for each in self[1:]))


LARGE = Sizes(72, QSize(280, 56), QSize(420, 56), QSize(160, 64), QSize(240, 64))
SMALL = Sizes(46, QSize(170, 40), QSize(260, 40), QSize(100, 44), QSize(150, 44))
# The state stands below the badge, both as wide as the stops leave them.
STACKED = Sizes(56, QSize(0, 26), QSize(0, 27), QSize(100, 52), QSize(150, 52))
_LARGE_FROM = 1600  # px of width at normal text
_STOPS_SHARE = 0.55  # of the width, at most


class DroppedChips(QToolButton):
    """A menu of the chips for which the header has no room."""

    def __init__(self) -> None:
        super().__init__()
        self.setText("⋯")
        self.setObjectName("model")  # looks like a chip
        self.setToolTip(plain_tip(translate("shell", "What the header has no room for")))
        self.setAccessibleName(translate("shell", "What the header has no room for"))
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.chips: Sequence[QWidget] = ()
        menu = QMenu(self)
        menu.aboutToShow.connect(self._fill)
        self.setMenu(menu)

    def _fill(self) -> None:
        """List what the chips say; those that do something do it from here."""
        menu = self.menu()
        menu.clear()
        for chip in self.chips:
            text = str(chip.property("text"))
            own = chip.menu() if isinstance(chip, QToolButton) else None
            if own is not None:
                menu.addMenu(own).setText(text)
            elif isinstance(chip, QToolButton):
                menu.addAction(text, chip.click)
            else:
                menu.addAction(text).setEnabled(False)


class HeaderRow(QWidget):
    """Badge, state, chips and stops in a row that never asks for a width.

    First the chips give way, in the order in which ``droppable`` names them, then the second line
    of the state, which then stands below the badge. The stops never do.

    Signals
    -------
    reason_shown(bool) : whether there is room for the second line of the state.
    """

    reason_shown = Signal(bool)

    def __init__(
        self,
        badge: QWidget,
        state: QWidget,
        chips: Sequence[QWidget],
        droppable: Sequence[QWidget],
        stops: tuple[QWidget, QWidget],
    ) -> None:
        super().__init__()
        self._badge, self._state, self._stops = badge, state, stops
        self._chips, self._droppable = tuple(chips), tuple(droppable)
        self.dropped = DroppedChips()
        self._empty: set[QWidget] = set()
        self._has_reason = True
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        for part in (badge, state, *chips, self.dropped, *stops):
            part.setParent(self)
        self.dropped.hide()

    def fill(self, chip: QWidget, *, full: bool) -> None:
        """Show a chip from now on, where there is room, or no more."""
        if full is (chip in self._empty):
            (self._empty.discard if full else self._empty.add)(chip)
            self.place()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for no width: a tool bar hides what asks for more than there is."""
        return QSize(1, self.height())

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for the height alone."""
        return self.minimumSizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Place the parts anew."""
        super().resizeEvent(event)
        self.place()

    def event(self, event: QEvent) -> bool:
        """Place the parts anew where one has another size, or text has."""
        done = super().event(event)
        kinds = (QEvent.Type.LayoutRequest, QEvent.Type.FontChange, QEvent.Type.StyleChange)
        if event.type() in kinds:
            self.place()
        return done

    def place(self) -> None:
        """Place all parts by the width and the size of text."""
        width, scale = self.width(), max(self.font().pixelSize() / _TEXT, 1.0)
        stacked = width < SMALL.width * scale
        sizes = STACKED if stacked else LARGE if width >= _LARGE_FROM * scale else SMALL
        stops = sizes.lock.width() + sizes.stop.width()
        sizes = sizes.scaled(min(scale, max(_STOPS_SHARE * width / stops, 0.1)))
        if self.maximumHeight() != sizes.height:
            self.setFixedHeight(sizes.height)
        end = self._place_stops(sizes)
        if stacked:
            self._stack(sizes, end)
        else:
            self._line_up(sizes, end)
        if self._has_reason is stacked:
            self._has_reason = not stacked
            self.reason_shown.emit(self._has_reason)

    def _place_stops(self, sizes: Sizes) -> int:
        """Place the stops at the right end; return where the room for the others ends."""
        left = self.width() - _MARGIN
        for widget, size in zip(reversed(self._stops), (sizes.stop, sizes.lock), strict=True):
            left -= size.width()
            self._put(widget, left, size)
            left -= _GAP
        return left

    def _stack(self, sizes: Sizes, end: int) -> None:
        """Place the state below the badge; there is no room for chips."""
        width = max(end - _MARGIN, 0)
        top = (sizes.height - sizes.badge.height() - sizes.state.height()) // 2
        self._badge.setGeometry(_MARGIN, top, width, sizes.badge.height())
        below = top + sizes.badge.height()
        self._state.setGeometry(_MARGIN, below, width, sizes.state.height())
        self._show_chips(0, 0)

    def _line_up(self, sizes: Sizes, end: int) -> None:
        """Place badge, state and the chips for which there is room side by side."""
        self._put(self._badge, _MARGIN, sizes.badge)
        left = _MARGIN + sizes.badge.width() + _GAP
        # The word and the button that helps are never cut; chips are dropped for them.
        needed = max(sizes.state.width(), self._state.sizeHint().width())
        chips = self._show_chips(left + min(needed, end - left) + _GAP, end)
        # The reason below the word has all the room that the chips leave.
        self._put(self._state, left, QSize(chips - _GAP - left, sizes.state.height()))

    def _show_chips(self, left: int, end: int) -> int:
        """Show as many chips as there is room for, and where to find the others.

        They stand at the end of their room; return where the first one begins.
        """
        wanted = [chip for chip in self._chips if chip not in self._empty]
        shown = list(wanted)
        button = _size(self.dropped).width() + _GAP
        for chip in self._droppable:
            if _width(shown) + (button if shown != wanted else 0) <= end - left:
                break
            if chip in shown:
                shown.remove(chip)
        self.dropped.chips = [chip for chip in wanted if chip not in shown]
        has_button = bool(self.dropped.chips) and button <= end - left
        # The gap after the last one belongs to the stops.
        left = first = end + _GAP - _width(shown) - (button if has_button else 0)
        for chip in (*self._chips, self.dropped):
            visible = chip in shown or (chip is self.dropped and has_button)
            if chip.isHidden() is visible:
                chip.setVisible(visible)
            if visible:
                self._put(chip, left, _size(chip))
                left += chip.width() + _GAP
        return first

    def _put(self, widget: QWidget, left: int, size: QSize) -> None:
        """Place a widget in the middle of the height."""
        widget.setGeometry(left, (self.maximumHeight() - size.height()) // 2, *size.toTuple())


def _size(widget: QWidget) -> QSize:
    return widget.sizeHint().expandedTo(widget.minimumSize()).boundedTo(widget.maximumSize())


def _width(chips: Sequence[QWidget]) -> int:
    return sum(_size(chip).width() + _GAP for chip in chips)


def bottom_of_header(window: QWidget) -> int:
    """Return where a window's header ends, px from its top: nothing may stand above that."""
    bars = window.findChildren(QToolBar, options=Qt.FindChildOption.FindDirectChildrenOnly)
    return max((bar.geometry().bottom() + 1 for bar in bars if bar.isVisible()), default=0)
