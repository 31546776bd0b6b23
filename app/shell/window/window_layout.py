"""The appearance of the window: layouts, theme and text size, all saved between starts."""

from collections.abc import Iterator

from PySide6.QtCore import QByteArray, QObject, QSize, Qt, QTimer
from PySide6.QtWidgets import QDockWidget, QMainWindow, QWidget

from rotemina.app.language import translate
from rotemina.app.panel import PanelArea
from rotemina.app.shell.panels import PanelCollection
from rotemina.app.shell.window import layouts
from rotemina.app.shell.window.folded_panels import NARROW_WIDTH_PX, FoldedPanelButtons
from rotemina.app.shell.window.layout_menu import LayoutRow
from rotemina.app.shell.window.screen_fit import fit_on_screen
from rotemina.app.widgets.layout import PanelFrame
from rotemina.app.widgets.style import theme as themes
from rotemina.app.workbench import Level, Workbench

# Smaller changes of the window's size do not change the space for panels.
_ROOM_STEP_PX = 16
# Keeps a part of each panel visible, even among too many.
_MIN_PANEL_ROOM_PX = 48
_THEME_KEY, _SCALE_KEY, _AUTOMATIC_SCALE = "window.theme", "window.scale", 0.0


class ArrangedWindow(QMainWindow):
    """The parts of the main window that its arrangement uses."""

    workbench: Workbench
    panels: PanelCollection
    docks: dict[str, QDockWidget]
    # The largest size, in px, that a panel may request.
    panel_room: QSize
    folded: FoldedPanelButtons
    layout_row: LayoutRow
    header: QWidget

    def bring_up(self, name: str) -> None:
        """Show a panel in front of its neighbours."""
        raise NotImplementedError

    def frames(self) -> Iterator[PanelFrame]:
        """Yield the frames of all panels that exist so far."""
        raise NotImplementedError


class WindowArrangement(QObject):
    """Layout, theme and text size of a window.

    Create it while the docks are at their original places.
    """

    def __init__(self, window: ArrangedWindow) -> None:
        super().__init__(window)
        self._window, self._bench = window, window.workbench
        self._settings = window.workbench.settings
        self._original_state = window.saveState(layouts.STATE_VERSION)
        self.saved_layouts = layouts.SavedLayouts(self._settings)
        # Delayed until Qt has laid out the docks, because only then stray tab bars can be
        # recognised.
        self._tidy_timer = QTimer(self, singleShot=True, interval=0)
        self._tidy_timer.timeout.connect(self._tidy_up)
        self._is_narrow = False
        self._latest_layout: layouts.WindowLayout | None = None
        # Numbers of panels side by side and below each other.
        self._columns, self._rows = 3, 2
        # Sizes of docks at each text size, and the sizes to set once a new text size is in use.
        self._sizes_by_scale: dict[float, dict[str, QSize]] = {}
        self._target_sizes: dict[str, QSize] = {}
        for dock in window.docks.values():
            dock.visibilityChanged.connect(lambda _: self._tidy_timer.start())
            dock.topLevelChanged.connect(lambda _: self._tidy_timer.start())

    def arrange(self, layout: layouts.WindowLayout) -> None:
        """Place the panels as a layout defines; the others are closed."""
        window = self._window
        kinds = window.panels.panel_types
        docks = {name: (kinds[name].area, dock) for name, dock in window.docks.items()}
        layouts.apply_layout(window, docks, layout, self.text_scale)
        for name in layout.places.get(PanelArea.CENTRE, ()):
            window.bring_up(name)
        if layout is layouts.OPERATE and self._bench.microscope.camera.camera is not None:
            window.bring_up("microscope")
        self._latest_layout = layout
        self._fold(layout)
        window.layout_row.mark_layout(self.current_layout)
        self._tidy_timer.start()

    def fit(self) -> None:
        """Divide the window's space among the panels; fold some away in a narrow window."""
        self._divide_space()
        is_narrow = self._window.width() < NARROW_WIDTH_PX * self.text_scale
        if is_narrow is self._is_narrow:
            return
        layout, self._is_narrow = self.current_layout, is_narrow
        if layout is not None:
            self._fold(layout)
        self._tidy_timer.start()

    def _fold(self, layout: layouts.WindowLayout) -> None:
        for name, dock in self._window.folded.docks.items():
            if name in layout.docks:
                dock.setVisible(not self._is_narrow)

    def _show_folded(self) -> None:
        layout = self._latest_layout or self.current_layout
        has_folded = layout is not None and self._window.folded.docks.keys() & layout.docks.keys()
        self._window.folded.setVisible(self._is_narrow and bool(has_folded))

    @property
    def current_layout(self) -> layouts.WindowLayout | None:
        """The built-in layout that is visible; None if the user changed it or uses a saved one."""
        candidates = (self._latest_layout, *layouts.BUILT_IN)
        return next(
            (layout for layout in candidates if layout is not None and self._is_shown(layout)), None
        )

    def _is_shown(self, layout: layouts.WindowLayout) -> bool:
        window = self._window
        folded_names = window.folded.docks.keys() if self._is_narrow else ()
        layout_places = {
            name: layouts.DOCK_AREAS[area]
            for name, area in layout.docks.items()
            if name in window.docks and name not in folded_names
        }
        current_places = {
            name: None if dock.isFloating() else window.dockWidgetArea(dock)
            for name, dock in window.docks.items()
            if not dock.isHidden() and name not in folded_names
        }
        return current_places == layout_places

    def _tidy_up(self) -> None:
        layouts.hide_stray_tab_bars(self._window)
        self._show_folded()
        self._window.layout_row.mark_layout(self.current_layout)
        self._count_panels()
        if self._target_sizes:
            self._resize_docks(self._target_sizes)
            self._target_sizes = {}

    def _count_panels(self) -> None:
        window = self._window
        docked = [dock for dock in window.docks.values() if _is_docked(dock)]
        rects = [part.geometry() for part in (window.centralWidget(), *docked)]
        columns, rows = len({rect.x() for rect in rects}), len({rect.y() for rect in rects})
        if (columns, rows) != (self._columns, self._rows):
            self._columns, self._rows = columns, rows
            self._divide_space()

    def _divide_space(self) -> None:
        """Limit each panel to its share of the window, so that together they never enlarge it."""
        window = self._window
        # The title of a dock; tabs take the same height.
        title_height = 2 * window.fontMetrics().height()
        bars = (window.menuBar(), window.statusBar(), window.header)
        height = window.height() - sum(part.height() for part in bars)
        room = QSize(
            max(window.width() // self._columns - title_height, _MIN_PANEL_ROOM_PX),
            max(height // self._rows - 2 * title_height, _MIN_PANEL_ROOM_PX),
        )
        room = _ROOM_STEP_PX * QSize(room.width() // _ROOM_STEP_PX, room.height() // _ROOM_STEP_PX)
        if room != window.panel_room:
            window.panel_room = room
            for frame in window.frames():
                frame.set_room(room)

    def _measure_docks(self) -> dict[str, QSize]:
        docks = {name: dock for name, dock in self._window.docks.items() if _is_docked(dock)}
        return {name: layouts.measure_with_tabs(self._window, dock) for name, dock in docks.items()}

    def _resize_docks(self, sizes: dict[str, QSize]) -> None:
        window = self._window
        bottom = Qt.DockWidgetArea.BottomDockWidgetArea
        # The bottom docks come last, because those at the sides are next to them.
        for at_bottom in (False, True):
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
        """Return every dock to its original place."""
        self._restore_state(self._original_state)
        for dock in self._window.docks.values():
            dock.show()

    def save_layout(self, name: str) -> None:
        """Save the current layout under a name; it replaces an older one of that name."""
        objection = self.saved_layouts.find_objection(name)
        if objection is not None:
            text = translate("shell", "The layout is not saved: {objection}.").format(
                objection=objection
            )
            self._bench.notify(Level.WARNING, text, about="window.md#layouts")
            return
        self.saved_layouts.save(name, self._window.saveState(layouts.STATE_VERSION))
        self._bench.notify(
            Level.GOOD, translate("shell", "The layout is saved as {name!r}.").format(name=name)
        )

    def use_saved_layout(self, name: str) -> None:
        """Restore a saved layout."""
        if not self._restore_state(self.saved_layouts.read_state(name)):
            self._bench.notify(
                Level.WARNING,
                translate(
                    "shell", "The layout {name!r} cannot be read; delete it and save it again."
                ).format(name=name),
                about="window.md#layouts",
            )

    def restore(self) -> None:
        """Restore the size and layout of the last session."""
        self._window.resize(1280, 800)
        self._window.restoreGeometry(
            layouts.decode_state(self._settings.get("window.geometry", ""))
        )
        fit_on_screen(self._window)
        self._restore_state(layouts.decode_state(self._settings.get("window.state", "")))

    def save_state(self) -> None:
        """Save the size and layout for the next start."""
        window = self._window
        values = {
            "geometry": window.saveGeometry(),
            "state": window.saveState(layouts.STATE_VERSION),
        }
        for key, value in values.items():
            self._settings.set(f"window.{key}", layouts.encode_state(value))

    def _restore_state(self, state: QByteArray) -> bool:
        is_restored = self._window.restoreState(state, layouts.STATE_VERSION)
        if is_restored:
            self._latest_layout = None
        self._tidy_timer.start()
        return is_restored

    @property
    def text_scale(self) -> float:
        """The text size, 1.0 for 13 px; chosen by the user or by the screen height."""
        scale = self._settings.get(_SCALE_KEY, _AUTOMATIC_SCALE)
        return scale if scale in themes.TEXT_SCALES else self._automatic_scale

    @property
    def _automatic_scale(self) -> float:
        return themes.find_text_scale(self._window.screen().size().height())

    def use_theme(self, name: str) -> None:
        """Change the colours and remember them."""
        theme = themes.find_theme(name)
        self._settings.set(_THEME_KEY, theme.name)
        self._apply_theme(theme)
        self._bench.set_theme(theme)

    def step_scale(self, steps: int) -> None:
        """Enlarge or shrink the text by steps and remember it."""
        index = themes.TEXT_SCALES.index(self.text_scale) + steps
        self._use_scale(themes.TEXT_SCALES[min(max(index, 0), len(themes.TEXT_SCALES) - 1)])

    def use_automatic_scale(self) -> None:
        """Choose the text size by the height of the screen again."""
        self._use_scale(_AUTOMATIC_SCALE)

    def _use_scale(self, setting: float) -> None:
        """Change the text size.

        Docks grow with the text, or get the sizes that they last had at this text size.
        """
        old_scale = self.text_scale
        self._sizes_by_scale[old_scale] = sizes = self._measure_docks()
        self._settings.set(_SCALE_KEY, setting)
        new_scale = self.text_scale
        if new_scale == old_scale:
            return
        scaled_sizes = {
            name: QSize(round(size.width() * new_scale / old_scale), size.height())
            for name, size in sizes.items()
        }
        self._target_sizes = scaled_sizes | self._sizes_by_scale.get(new_scale, {})
        self._apply_theme(self._bench.theme)
        self.fit()
        self._tidy_timer.start()

    def apply_current_theme(self) -> None:
        """Apply the theme and the text size in use."""
        self._apply_theme(self._bench.theme)

    def _apply_theme(self, theme: themes.Theme) -> None:
        themes.apply_theme(self._window, theme, self.text_scale)


def _is_docked(dock: QDockWidget) -> bool:
    """Return whether a dock is visible at a side of the window, and not behind another tab."""
    return dock.isVisible() and not dock.isFloating() and not dock.visibleRegion().isEmpty()
