"""The placement of the header's parts, for each width and text size."""

from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QEvent, QSize, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QMenu, QSizePolicy, QToolButton, QWidget

from rotemina.app.language import translate
from rotemina.app.widgets.controls import make_tooltip

_NORMAL_TEXT_PX = 13.0
_MARGIN_PX, _GAP_PX = 8, 10


class HeaderSizes(NamedTuple):
    """Height of the header and sizes of its parts, in px at normal text size."""

    height: int
    badge: QSize
    state: QSize
    lock: QSize
    stop: QSize

    @property
    def width(self) -> int:
        """The width of all parts side by side, without any chip."""
        return sum(part.width() for part in self[1:]) + 2 * _MARGIN_PX + 3 * _GAP_PX

    def scale_by(self, scale: float) -> "HeaderSizes":
        """Return the sizes at another text size."""
        return HeaderSizes(round(self.height * scale), *(part * scale for part in self[1:]))


LARGE_SIZES = HeaderSizes(72, QSize(280, 56), QSize(420, 56), QSize(160, 64), QSize(240, 64))
SMALL_SIZES = HeaderSizes(46, QSize(170, 40), QSize(260, 40), QSize(100, 44), QSize(150, 44))
# The state is placed below the badge. Both take the width that the stop buttons leave.
STACKED_SIZES = HeaderSizes(56, QSize(0, 26), QSize(0, 27), QSize(100, 52), QSize(150, 52))
# Window width, at normal text size, from which the large sizes are used.
_MIN_LARGE_WIDTH_PX = 1600
# Largest share of the header's width that the stop buttons take.
_MAX_STOPS_SHARE = 0.55


class ChipOverflowButton(QToolButton):
    """A button with a menu of the chips that do not fit into the header."""

    def __init__(self) -> None:
        super().__init__()
        self.setText("⋯")
        # The style sheet draws it like a chip.
        self.setObjectName("model")
        self.setToolTip(
            make_tooltip(translate("shell", "Indicators that do not fit into the header"))
        )
        self.setAccessibleName(translate("shell", "Indicators that do not fit into the header"))
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.chips: Sequence[QWidget] = ()
        menu = QMenu(self)
        menu.aboutToShow.connect(self._fill)
        self.setMenu(menu)

    def _fill(self) -> None:
        """List the chips; clicking an entry acts like clicking its chip."""
        menu = self.menu()
        menu.clear()
        for chip in self.chips:
            text = str(chip.property("text"))
            chip_menu = chip.menu() if isinstance(chip, QToolButton) else None
            if chip_menu is not None:
                menu.addMenu(chip_menu).setText(text)
            elif isinstance(chip, QToolButton):
                menu.addAction(text, chip.click)
            else:
                menu.addAction(text).setEnabled(False)


class HeaderRow(QWidget):
    """Row of badge, state, chips and stop buttons that has no minimum width.

    If space is short, the chips are hidden first, in the order of ``hiding_order``. Then the second
    line of the state is hidden and the state moves below the badge. The stop buttons always stay.

    Signals
    -------
    reason_visibility_changed(bool) : whether there is space for the second line of the state.
    """

    reason_visibility_changed = Signal(bool)

    def __init__(
        self,
        badge: QWidget,
        state: QWidget,
        chips: Sequence[QWidget],
        hiding_order: Sequence[QWidget],
        stops: tuple[QWidget, QWidget],
    ) -> None:
        super().__init__()
        self._badge, self._state, self._stops = badge, state, stops
        self._chips, self._hiding_order = tuple(chips), tuple(hiding_order)
        self.overflow_button = ChipOverflowButton()
        self._unwanted_chips: set[QWidget] = set()
        self._has_reason = True
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        for part in (badge, state, *chips, self.overflow_button, *stops):
            part.setParent(self)
        self.overflow_button.hide()

    def set_chip_wanted(self, chip: QWidget, *, wanted: bool) -> None:
        """Set whether a chip is shown as soon as there is space for it."""
        if wanted is (chip in self._unwanted_chips):
            (self._unwanted_chips.discard if wanted else self._unwanted_chips.add)(chip)
            self.place_parts()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request no width: a tool bar hides a widget that requests more than there is."""
        return QSize(1, self.height())

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request only the height."""
        return self.minimumSizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Place the parts again."""
        super().resizeEvent(event)
        self.place_parts()

    def event(self, event: QEvent) -> bool:
        """Place the parts again when a part or the text changes its size."""
        was_handled = super().event(event)
        size_events = (QEvent.Type.LayoutRequest, QEvent.Type.FontChange, QEvent.Type.StyleChange)
        if event.type() in size_events:
            self.place_parts()
        return was_handled

    def place_parts(self) -> None:
        """Place all parts according to the width and the text size."""
        width, scale = self.width(), max(self.font().pixelSize() / _NORMAL_TEXT_PX, 1.0)
        is_stacked = width < SMALL_SIZES.width * scale
        sizes = (
            STACKED_SIZES
            if is_stacked
            else LARGE_SIZES
            if width >= _MIN_LARGE_WIDTH_PX * scale
            else SMALL_SIZES
        )
        stops_width = sizes.lock.width() + sizes.stop.width()
        sizes = sizes.scale_by(min(scale, max(_MAX_STOPS_SHARE * width / stops_width, 0.1)))
        if self.maximumHeight() != sizes.height:
            self.setFixedHeight(sizes.height)
        right_end = self._place_stops(sizes)
        if is_stacked:
            self._place_stacked(sizes, right_end)
        else:
            self._place_in_line(sizes, right_end)
        if self._has_reason is is_stacked:
            self._has_reason = not is_stacked
            self.reason_visibility_changed.emit(self._has_reason)

    def _place_stops(self, sizes: HeaderSizes) -> int:
        """Place the stop buttons at the right; return the right end of the remaining space."""
        left = self.width() - _MARGIN_PX
        for widget, size in zip(reversed(self._stops), (sizes.stop, sizes.lock), strict=True):
            left -= size.width()
            self._place_centred(widget, left, size)
            left -= _GAP_PX
        return left

    def _place_stacked(self, sizes: HeaderSizes, right_end: int) -> None:
        """Place the state below the badge and hide all chips."""
        width = max(right_end - _MARGIN_PX, 0)
        top = (sizes.height - sizes.badge.height() - sizes.state.height()) // 2
        self._badge.setGeometry(_MARGIN_PX, top, width, sizes.badge.height())
        state_top = top + sizes.badge.height()
        self._state.setGeometry(_MARGIN_PX, state_top, width, sizes.state.height())
        self._show_chips(0, 0)

    def _place_in_line(self, sizes: HeaderSizes, right_end: int) -> None:
        self._place_centred(self._badge, _MARGIN_PX, sizes.badge)
        left = _MARGIN_PX + sizes.badge.width() + _GAP_PX
        # The state's word and button are never cut; chips are dropped to make space for them.
        needed = max(sizes.state.width(), self._state.sizeHint().width())
        chips_left = self._show_chips(left + min(needed, right_end - left) + _GAP_PX, right_end)
        # The reason below the word gets the space that the chips leave.
        self._place_centred(
            self._state, left, QSize(chips_left - _GAP_PX - left, sizes.state.height())
        )

    def _show_chips(self, left: int, right_end: int) -> int:
        """Show as many chips as fit, and the overflow button if some do not fit.

        The chips are placed at the right end of their space. Return the left edge of the first one.
        """
        wanted_chips = [chip for chip in self._chips if chip not in self._unwanted_chips]
        shown_chips = list(wanted_chips)
        button_width = _find_size(self.overflow_button).width() + _GAP_PX
        for chip in self._hiding_order:
            if (
                _sum_widths(shown_chips) + (button_width if shown_chips != wanted_chips else 0)
                <= right_end - left
            ):
                break
            if chip in shown_chips:
                shown_chips.remove(chip)
        self.overflow_button.chips = [chip for chip in wanted_chips if chip not in shown_chips]
        has_button = bool(self.overflow_button.chips) and button_width <= right_end - left
        # The space of the stop buttons already includes the gap after the last chip.
        left = first_left = (
            right_end + _GAP_PX - _sum_widths(shown_chips) - (button_width if has_button else 0)
        )
        for chip in (*self._chips, self.overflow_button):
            visible = chip in shown_chips or (chip is self.overflow_button and has_button)
            if chip.isHidden() is visible:
                chip.setVisible(visible)
            if visible:
                self._place_centred(chip, left, _find_size(chip))
                left += chip.width() + _GAP_PX
        return first_left

    def _place_centred(self, widget: QWidget, left: int, size: QSize) -> None:
        widget.setGeometry(left, (self.maximumHeight() - size.height()) // 2, *size.toTuple())


def _find_size(widget: QWidget) -> QSize:
    return widget.sizeHint().expandedTo(widget.minimumSize()).boundedTo(widget.maximumSize())


def _sum_widths(chips: Sequence[QWidget]) -> int:
    return sum(_find_size(chip).width() + _GAP_PX for chip in chips)
