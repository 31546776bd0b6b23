"""How the window looks: layouts, theme and size of text, all of them kept between starts."""

from collections.abc import Iterator

from PySide6.QtCore import QByteArray, QObject, QSize, Qt, QTimer
from PySide6.QtWidgets import QDockWidget, QMainWindow, QWidget

from rotemina.app.panel import Area
from rotemina.app.shell import layouts
from rotemina.app.shell import theme as themes
from rotemina.app.shell.folded_panels import NARROW_BELOW, FoldedPanels
from rotemina.app.shell.language import translate
from rotemina.app.shell.layout_menu import LayoutRow
from rotemina.app.shell.panel_host import Panels
from rotemina.app.shell.screen_fit import fit_on_screen
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.scroll_areas import PanelFrame

_STEP = 16  # px of the window's size from which on panels are given other room
_LITTLE = 48  # px: of a panel that stands with too many others some can still be seen
_THEME, _SCALE, _AUTOMATIC = "window.theme", "window.scale", 0.0


class ArrangedWindow(QMainWindow):
    """What an arrangement knows of its window."""

    workbench: Workbench
    panels: Panels
    docks: dict[str, QDockWidget]
    panel_room: QSize  # px: for which a panel may ask
    folded: FoldedPanels
    layout_row: LayoutRow
    header: QWidget

    def bring_up(self, name: str) -> None:
        """Show a panel, in front of those beside it."""
        raise NotImplementedError

    def frames(self) -> Iterator[PanelFrame]:
        """Yield the frames of all panels that are made."""
        raise NotImplementedError


class Arrangement(QObject):
    """Arranges and dresses a window; made when its docks stand where they stand at first."""

    def __init__(self, window: ArrangedWindow) -> None:
        super().__init__(window)
        self._window, self._bench = window, window.workbench
        self._settings = window.workbench.settings
        self._first = window.saveState(layouts.VERSION)
        self.kept = layouts.KeptLayouts(self._settings)
        # After Qt has laid out: only then is it seen which tabs belong to nothing.
        self._tidy = QTimer(self, singleShot=True, interval=0)
        self._tidy.timeout.connect(self._tidy_up)
        self._narrow = False
        self._arranged: layouts.Layout | None = None  # the latest
        self._columns, self._rows = 3, 2  # of panels, side by side and one below another
        # Sizes of docks at each size of text, and those that they are to have once it is in use.
        self._sizes: dict[float, dict[str, QSize]] = {}
        self._wanted: dict[str, QSize] = {}
        for dock in window.docks.values():
            dock.visibilityChanged.connect(lambda _: self._tidy.start())
            dock.topLevelChanged.connect(lambda _: self._tidy.start())

    # --- layouts ----------------------------------------------------------------------------------

    def arrange(self, layout: layouts.Layout) -> None:
        """Put the panels where a layout wants them; the others are closed."""
        window = self._window
        kinds = window.panels.kinds
        docks = {name: (kinds[name].area, dock) for name, dock in window.docks.items()}
        layouts.arrange(window, docks, layout, self.text_scale)
        for name in layout.places.get(Area.CENTRE, ()):
            window.bring_up(name)
        if layout is layouts.OPERATE and self._bench.microscope.camera.camera is not None:
            window.bring_up("microscope")
        self._arranged = layout
        self._fold(layout)
        window.layout_row.mark(self.in_use)
        self._tidy.start()

    def fit(self) -> None:
        """Give panels the room that the window has; fold some away in a narrow one."""
        self._share_room()
        narrow = self._window.width() < NARROW_BELOW * self.text_scale
        if narrow is self._narrow:
            return
        layout, self._narrow = self.in_use, narrow
        if layout is not None:
            self._fold(layout)
        self._tidy.start()

    def _fold(self, layout: layouts.Layout) -> None:
        for name, dock in self._window.folded.docks.items():
            if name in layout.docks:
                dock.setVisible(not self._narrow)

    def _show_folded(self) -> None:
        """Show the buttons in a narrow window, where the layout has a panel for them."""
        layout = self._arranged or self.in_use
        wanted = layout is not None and self._window.folded.docks.keys() & layout.docks.keys()
        self._window.folded.setVisible(self._narrow and bool(wanted))

    @property
    def in_use(self) -> layouts.Layout | None:
        """The built-in layout that shows; None: the user has changed it, or it is one of theirs."""
        found = (self._arranged, *layouts.BUILT_IN)
        return next((one for one in found if one is not None and self._is_shown(one)), None)

    def _is_shown(self, layout: layouts.Layout) -> bool:
        """Whether the docks that are open are those of a layout, where it wants them."""
        window = self._window
        aside = window.folded.docks.keys() if self._narrow else ()
        wanted = {
            name: layouts.DOCK_AREAS[area]
            for name, area in layout.docks.items()
            if name in window.docks and name not in aside
        }
        shown = {
            name: None if dock.isFloating() else window.dockWidgetArea(dock)
            for name, dock in window.docks.items()
            if not dock.isHidden() and name not in aside
        }
        return shown == wanted

    def _tidy_up(self) -> None:
        layouts.hide_forgotten_tabs(self._window)
        self._show_folded()
        self._window.layout_row.mark(self.in_use)
        self._count_panels()
        if self._wanted:
            self._resize_docks(self._wanted)
            self._wanted = {}

    # --- room -------------------------------------------------------------------------------------

    def _count_panels(self) -> None:
        """Count how many panels share the width and the height."""
        window = self._window
        seen = [dock for dock in window.docks.values() if _is_docked(dock)]
        places = [part.geometry() for part in (window.centralWidget(), *seen)]
        columns, rows = len({at.x() for at in places}), len({at.y() for at in places})
        if (columns, rows) != (self._columns, self._rows):
            self._columns, self._rows = columns, rows
            self._share_room()

    def _share_room(self) -> None:
        """Let each panel ask for its share of the window at most: together they never need more."""
        window = self._window
        title = 2 * window.fontMetrics().height()  # of a dock; tabs take as much
        around = (window.menuBar(), window.statusBar(), window.header)
        height = window.height() - sum(part.height() for part in around)
        room = QSize(
            max(window.width() // self._columns - title, _LITTLE),
            max(height // self._rows - 2 * title, _LITTLE),
        )
        room = _STEP * QSize(room.width() // _STEP, room.height() // _STEP)
        if room != window.panel_room:
            window.panel_room = room
            for frame in window.frames():
                frame.give_room(room)

    def _dock_sizes(self) -> dict[str, QSize]:
        docks = {name: dock for name, dock in self._window.docks.items() if _is_docked(dock)}
        return {name: layouts.size_with_tabs(self._window, dock) for name, dock in docks.items()}

    def _resize_docks(self, sizes: dict[str, QSize]) -> None:
        """Give docks sizes, as far as they are still docked."""
        window = self._window
        bottom = Qt.DockWidgetArea.BottomDockWidgetArea
        for at_bottom in (False, True):  # last, as the docks at the sides stand next to these
            docks = {
                dock: sizes[name]
                for name, dock in window.docks.items()
                if name in sizes and _is_docked(dock)
                if (window.dockWidgetArea(dock) is bottom) is at_bottom
            }
            if not at_bottom:
                widths = [size.width() for size in docks.values()]
                window.resizeDocks([*docks], widths, Qt.Orientation.Horizontal)
            heights = [size.height() for size in docks.values()]
            window.resizeDocks([*docks], heights, Qt.Orientation.Vertical)

    def reset(self) -> None:
        """Bring every dock back to where it was at first."""
        self._use(self._first)
        for dock in self._window.docks.values():
            dock.show()

    def keep(self, name: str) -> None:
        """Keep the layout as it is under a name, in the place of one of that name."""
        objection = self.kept.objection(name)
        if objection is not None:
            text = translate("shell", "The layout is not saved: {objection}.").format(
                objection=objection
            )
            self._bench.notify(Level.WARNING, text, about="window.md#layouts")
            return
        self.kept.keep(name, self._window.saveState(layouts.VERSION))
        self._bench.notify(
            Level.GOOD, translate("shell", "The layout is saved as {name!r}.").format(name=name)
        )

    def use_kept(self, name: str) -> None:
        """Bring back a layout that was kept."""
        if not self._use(self.kept.state(name)):
            self._bench.notify(
                Level.WARNING,
                translate(
                    "shell", "The layout {name!r} cannot be read; delete it and save it again."
                ).format(name=name),
                about="window.md#layouts",
            )

    def restore(self) -> None:
        """Bring back size and layout of the last time."""
        self._window.resize(1280, 800)
        self._window.restoreGeometry(layouts.decoded(self._settings.get("window.geometry", "")))
        fit_on_screen(self._window)
        self._use(layouts.decoded(self._settings.get("window.state", "")))

    def remember(self) -> None:
        """Keep size and layout for the next time."""
        window = self._window
        kept = {"geometry": window.saveGeometry(), "state": window.saveState(layouts.VERSION)}
        for key, value in kept.items():
            self._settings.set(f"window.{key}", layouts.encoded(value))

    def _use(self, state: QByteArray) -> bool:
        done = self._window.restoreState(state, layouts.VERSION)
        if done:
            self._arranged = None
        self._tidy.start()
        return done

    # --- theme and size of text -------------------------------------------------------------------

    @property
    def text_scale(self) -> float:
        """How large text is, 1.0 for 13 px; chosen, or as the screen suits."""
        chosen = self._settings.get(_SCALE, _AUTOMATIC)
        return chosen if chosen in themes.SCALES else self._suiting

    @property
    def _suiting(self) -> float:
        return themes.scale_for(self._window.screen().size().height())

    def use_theme(self, name: str) -> None:
        """Change the colours and remember them."""
        theme = themes.theme_named(name)
        self._settings.set(_THEME, theme.name)
        self._dress(theme)
        self._bench.set_theme(theme)

    def step_scale(self, steps: int) -> None:
        """Make text larger or smaller by steps, and remember it."""
        place = themes.SCALES.index(self.text_scale) + steps
        self._use_scale(themes.SCALES[min(max(place, 0), len(themes.SCALES) - 1)])

    def suit_the_screen(self) -> None:
        """Make text as large as the screen suits from now on."""
        self._use_scale(_AUTOMATIC)

    def _use_scale(self, chosen: float) -> None:
        """Change the size of text; docks grow with it, and have their former sizes with it."""
        before = self.text_scale
        self._sizes[before] = sizes = self._dock_sizes()
        self._settings.set(_SCALE, chosen)
        after = self.text_scale
        if after == before:
            return
        grown = {
            name: QSize(round(size.width() * after / before), size.height())
            for name, size in sizes.items()
        }
        self._wanted = grown | self._sizes.get(after, {})
        self._dress(self._bench.theme)
        self.fit()
        self._tidy.start()

    def dress(self) -> None:
        """Dress the window in the theme in use, at the size of text of the last time."""
        self._dress(self._bench.theme)

    def _dress(self, theme: themes.Theme) -> None:
        themes.dress(self._window, theme, self.text_scale)


def _is_docked(dock: QDockWidget) -> bool:
    """Whether a dock is seen at a side of the window, not behind the tab of another."""
    return dock.isVisible() and not dock.isFloating() and not dock.visibleRegion().isEmpty()
