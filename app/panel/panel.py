"""The interface of panel plugins: the base class, and the workbench shared by all panels.

A panel is a :class:`Panel` subclass named by an entry point of the group ``rotemina.panels``.
Its constructor receives the :class:`~rotemina.app.workbench.Workbench` of the window: the
robot, the motion session, the current trajectory and comparison, and signals for their changes.
A panel that cannot be loaded is reported and left out; the window opens without it.
"""

from collections.abc import Callable
from enum import StrEnum
from itertools import count
from time import monotonic
from typing import TYPE_CHECKING, ClassVar

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QAbstractButton, QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.workbench import Workbench
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.plugin_points import API_VERSIONS

API_VERSION = API_VERSIONS["rotemina.panels"]
# Readings older than this are marked as old.
STALE_AGE_S = 0.5
# Update period of a panel that is not visible.
HIDDEN_UPDATE_PERIOD_S = 0.2
_PALETTE_OFFER_PROPERTY = "paletteOffer"
# Each panel gets its own number, by which panels update in different frames.
_panel_numbers = count()


class PaletteOffer(StrEnum):
    """When the command palette may click a button."""

    WHILE_VISIBLE = "while visible"
    ALWAYS = "always"


def offer_in_palette(*buttons: QAbstractButton, safe_while_hidden: bool = False) -> None:
    """Offer buttons of a panel in the command palette; other buttons are not in it.

    Unless they are ``safe_while_hidden``, the palette clicks them only while their panel is
    visible, and otherwise opens the panel instead. A button is safe while hidden only if it
    neither moves nor switches anything in the machine, or if it stops the machine.
    """
    offer = PaletteOffer.ALWAYS if safe_while_hidden else PaletteOffer.WHILE_VISIBLE
    for button in buttons:
        button.setProperty(_PALETTE_OFFER_PROPERTY, offer.value)


def get_palette_offer(button: QAbstractButton) -> PaletteOffer | None:
    """Return when the command palette may click a button; None if it is not offered."""
    offer = button.property(_PALETTE_OFFER_PROPERTY)
    return PaletteOffer(offer) if offer else None


class PanelArea(StrEnum):
    """The initial area of a panel in the window."""

    CENTRE = "centre"
    LEFT = "left"
    RIGHT = "right"
    BOTTOM = "bottom"


class Panel(QWidget):
    """One panel of the window.

    Attributes
    ----------
    title : str
        Shown on its frame and in the menu, in the language of the window. It is marked for
        translation by ``marked("panels", "Gap")``.
    area : PanelArea
    order : int
        Panels of an area are sorted by this number.
    help_page : str
        The page that the "?" of the panel opens: a page of the documentation, such as
        ``safety_at.md`` or ``plate.md#the-panel``, or a page in the package of the plugin, such as
        ``glass_stage:help.md``. If it is empty, there is no "?".
    at_once : bool
        Whether the panel is made with the window, before the machine is connected. Set it for
        panels that record events. Other panels are made when they are first visible, or a
        little later.
    api_version : int
        The version of this interface that the panel was written for.
    """

    title: ClassVar[str] = ""
    area: ClassVar[PanelArea] = PanelArea.RIGHT
    order: ClassVar[int] = 100
    help_page: ClassVar[str] = ""
    at_once: ClassVar[bool] = False
    api_version: ClassVar[int] = API_VERSION

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.workbench = workbench
        self._callbacks: list[Callable[[SessionState], object]] = []
        self._frame_callbacks: list[tuple[Callable[[SessionState], object], bool]] = []
        self._number = next(_panel_numbers)
        # Hidden panels update in turns, not all in the same frame: multiples of the golden ratio
        # spread them evenly over the period.
        self._last_update_s = monotonic() - HIDDEN_UPDATE_PERIOD_S * (0.618 * self._number % 1.0)
        self.installEventFilter(_UpdateOnShow(self))

    def follow(self, callback: Callable[[SessionState], object]) -> None:
        """Call ``callback`` with the machine's state ten times a second, less often while hidden.

        It is also called as soon as the machine begins to move, comes to rest or is locked, and
        before the panel is painted: once after construction, and again whenever it is shown. So
        ``callback`` may enable buttons and actions; they are up to date whenever the panel is
        visible.
        """
        if not self._callbacks:
            # Qt disconnects a bound method when its panel is deleted.
            self.workbench.refreshed.connect(self._on_refreshed)
        self._callbacks.append(callback)

    def follow_frames(
        self, callback: Callable[[SessionState], object], *, shown: bool = False
    ) -> None:
        """Call ``callback`` in every frame, even while hidden, and before the panel is painted.

        With ``shown``, its argument is the state that the window shows, which may be that of a
        replay. Otherwise it is the state of the machine.
        """
        (self.workbench.shown if shown else self.workbench.refreshed).connect(callback)
        self._frame_callbacks.append((callback, shown))

    def update_now(self) -> None:
        """Call all callbacks with the present state at once, without waiting for a frame.

        Code that makes a panel must call this method afterwards, as :func:`make_panel` does.
        """
        session, source = self.workbench.session, self.workbench.source
        state = session.snapshot()
        with self.workbench.turns.suspend():
            self._call_callbacks(state)
            for callback, shown in self._frame_callbacks:
                callback(source.snapshot() if shown and source is not session else state)

    def _on_refreshed(self, state: SessionState) -> None:
        now_s = monotonic()
        is_hidden = not self.isVisible() and self.window().isVisible()
        # A hidden panel has its own period; a visible one shares the turns of the workbench.
        if now_s - self._last_update_s >= HIDDEN_UPDATE_PERIOD_S if is_hidden else self.texts_due:
            self._last_update_s = now_s
            self._call_callbacks(state)

    def _call_callbacks(self, state: SessionState) -> None:
        for callback in self._callbacks:
            callback(state)

    @property
    def texts_due(self) -> bool:
        """Whether to update texts in this frame, for a panel that draws in every frame."""
        return self.workbench.turns.is_due(self._number)

    @property
    def main_window(self) -> QWidget:
        """The window of the panel, even while its dock floats."""
        widget: QWidget = self
        while (parent := widget.parentWidget()) is not None:
            widget = parent
        return widget

    # Former names, which work for one more release.
    look_now = FormerMember("update_now")


class _UpdateOnShow(QObject):
    """Updates a panel as soon as it is shown, before it is painted.

    An event filter does this instead of ``showEvent``, so that a panel that overrides
    ``showEvent`` need not call the base class.
    """

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self._panel = panel

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Update the panel when it is shown."""
        if event.type() == QEvent.Type.Show:
            self._panel.update_now()
        return False


def make_panel(kind: type[Panel], workbench: Workbench) -> Panel:
    """Make a panel that shows the machine's present state.

    Raises
    ------
    Exception
        Any exception of its constructor, or of the first call of its callbacks.
    """
    panel = kind(workbench)
    try:
        panel.update_now()
    except BaseException:
        # A panel that stayed connected would fail again in every frame.
        panel.deleteLater()
        raise
    return panel


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Area="PanelArea",
        HIDDEN_S="HIDDEN_UPDATE_PERIOD_S",
        STALE_S="STALE_AGE_S",
        palette_offer="get_palette_offer",
    )
