"""The interface of panel plugins: the base class, and the workbench shared by all panels.

A panel is a :class:`Panel` subclass named by an entry point of the group ``rotemina.panels``.
It is made with the :class:`~rotemina.app.shell.workbench.Workbench` of the window: the robot, the
motion session, the trajectory and the comparison in hand, and the signals that say when they
change. A panel that cannot be loaded is named and left out; the window opens without it.
"""

from collections.abc import Callable
from enum import StrEnum
from itertools import count
from time import monotonic
from typing import ClassVar

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QAbstractButton, QWidget

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Workbench
from rotemina.sim.plugin_points import API_VERSIONS

API_VERSION = API_VERSIONS["rotemina.panels"]
STALE_S = 0.5  # data older than this is shown as old
HIDDEN_S = 0.2  # between two looks of a panel that is out of sight
_PALETTE_OFFER = "paletteOffer"
_made = count()


class PaletteOffer(StrEnum):
    """When the command palette may click a button."""

    WHILE_VISIBLE = "while visible"
    ALWAYS = "always"


def offer_in_palette(*buttons: QAbstractButton, safe_while_hidden: bool = False) -> None:
    """Offer buttons of a panel in the command palette, which has none by itself.

    Unless they are ``safe_while_hidden``, the palette clicks them only while their panel is
    visible, and otherwise opens the panel instead. Only what moves nothing and switches nothing of
    the machine is safe while hidden, and what stops it.
    """
    offer = PaletteOffer.ALWAYS if safe_while_hidden else PaletteOffer.WHILE_VISIBLE
    for button in buttons:
        button.setProperty(_PALETTE_OFFER, offer.value)


def palette_offer(button: QAbstractButton) -> PaletteOffer | None:
    """Return when the command palette may click a button; None if it is not offered."""
    offer = button.property(_PALETTE_OFFER)
    return PaletteOffer(offer) if offer else None


class Area(StrEnum):
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
        Shown on its frame and in the menu, there in the window's language: it is marked for
        translation as ``marked("panels", "Gap")``.
    area : Area
    order : int
        Panels of one area stand in this order.
    help_page : str
        What its "?" opens: a page of the documentation, as ``safety.md`` or ``plate.md#the-panel``,
        or one that the plugin's own package carries, as ``glass_stage:help.md``. Without one there
        is no "?".
    at_once : bool
        Whether it is made with the window, before the machine is connected: for one that keeps what
        happens. Others are made when they are first seen, or a little later.
    api_version : int
        The version of this interface that the panel was written for.
    """

    title: ClassVar[str] = ""
    area: ClassVar[Area] = Area.RIGHT
    order: ClassVar[int] = 100
    help_page: ClassVar[str] = ""
    at_once: ClassVar[bool] = False
    api_version: ClassVar[int] = API_VERSION

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.workbench = workbench
        self._looks: list[Callable[[SessionState], object]] = []
        self._frame_looks: list[tuple[Callable[[SessionState], object], bool]] = []
        self._made = next(_made)
        # Those out of sight look in turns, not all at one frame: the golden ratio spreads them.
        self._followed_s = monotonic() - HIDDEN_S * (0.618 * self._made % 1.0)
        self.installEventFilter(_LookWhenShown(self))

    def follow(self, look: Callable[[SessionState], object]) -> None:
        """Call ``look`` with the machine's state ten times a second, less often while out of sight.

        It is also called as soon as the machine begins to move, comes to rest or is locked, and
        before the panel is painted: once after construction, and again whenever it is shown. So
        buttons and actions that ``look`` enables are right in every picture of the panel.
        """
        if not self._looks:
            self.workbench.refreshed.connect(self._hear)  # forgotten with the panel
        self._looks.append(look)

    def follow_frames(self, look: Callable[[SessionState], object], *, shown: bool = False) -> None:
        """Call ``look`` in every frame, also while out of sight, and before the panel is painted.

        With ``shown`` it is called with the state of what is shown, which may be a replay;
        otherwise with the machine's.
        """
        (self.workbench.shown if shown else self.workbench.refreshed).connect(look)
        self._frame_looks.append((look, shown))

    def look_now(self) -> None:
        """Call everything that follows the machine with its present state, and wait for no frame.

        Whatever makes a panel calls this afterwards, as :func:`make_panel` does.
        """
        session, source = self.workbench.session, self.workbench.source
        state = session.snapshot()
        with self.workbench.turns.suspended():
            self._look_at(state)
            for look, shown in self._frame_looks:
                look(source.snapshot() if shown and source is not session else state)

    def _hear(self, state: SessionState) -> None:
        now_s = monotonic()
        hidden = not self.isVisible() and self.window().isVisible()
        if now_s - self._followed_s >= HIDDEN_S if hidden else self.texts_due:
            self._followed_s = now_s
            self._look_at(state)

    def _look_at(self, state: SessionState) -> None:
        for look in self._looks:
            look(state)

    @property
    def texts_due(self) -> bool:
        """Whether texts are to be written in this frame, for a panel that draws in each."""
        return self.workbench.turns.due(self._made)

    @property
    def main_window(self) -> QWidget:
        """The window that the panel belongs to, also while its dock floats by itself."""
        widget: QWidget = self
        while (parent := widget.parentWidget()) is not None:
            widget = parent
        return widget


class _LookWhenShown(QObject):
    """Has a panel show the present state as soon as it is shown, before it is painted.

    No method of the panel does this, so that a panel with a ``showEvent`` of its own need not call
    the one of its base class.
    """

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self._panel = panel

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Look when the panel is shown."""
        if event.type() == QEvent.Type.Show:
            self._panel.look_now()
        return False


def make_panel(kind: type[Panel], workbench: Workbench) -> Panel:
    """Make a panel that shows the machine's present state.

    Raises
    ------
    Exception
        Whatever its constructor raises, or what follows the machine when it is first called.
    """
    panel = kind(workbench)
    try:
        panel.look_now()
    except BaseException:
        panel.deleteLater()  # it would fail again in every frame
        raise
    return panel
