"""Named layouts: which panels are placed where for a task of the operator."""

import json
from base64 import b64decode, b64encode
from collections.abc import Mapping
from dataclasses import dataclass

from PySide6.QtCore import QByteArray, QSize, Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabBar

from rotemina.app.language import marked, translate
from rotemina.app.panel import PanelArea
from rotemina.app.settings import UserSettings

# Version of the layout state that Qt saves.
STATE_VERSION = 1
MAX_SAVED_LAYOUTS = 20
MAX_NAME_LENGTH = 40
_LAYOUTS_KEY = "window.layouts"
DOCK_AREAS = {
    PanelArea.LEFT: Qt.DockWidgetArea.LeftDockWidgetArea,
    PanelArea.RIGHT: Qt.DockWidgetArea.RightDockWidgetArea,
    PanelArea.BOTTOM: Qt.DockWidgetArea.BottomDockWidgetArea,
}
# Shares of the window's width, at any text size.
_SIDE_SHARE, _MAX_SIDE_SHARE = 0.2, 0.4
# In px at normal text size. A narrower form is cut off, and a wider one is no easier to read.
_MIN_SIDE_PX, _MAX_SIDE_PX = 330, 460
_MAX_TAB_GAP_PX = 6


@dataclass(frozen=True, slots=True)
class WindowLayout:
    """Areas of the panels. Panels that are not listed are closed but can be opened again.

    Attributes
    ----------
    title, shortcut, tip : str
        As shown in the menu.
    places : mapping of PanelArea to tuple of str
        Names of the panels in each area; the first one is in front.
    bottom_share : float
        Share of the window's height for the docks at the bottom.
    stacked : tuple of PanelArea
        Areas whose panels are placed below each other instead of in tabs.
    """

    title: str
    shortcut: str
    tip: str
    places: Mapping[PanelArea, tuple[str, ...]]
    bottom_share: float
    stacked: tuple[PanelArea, ...] = ()

    @property
    def docks(self) -> dict[str, PanelArea]:
        """The area of each dock, by panel name."""
        return {
            name: area
            for area, names in self.places.items()
            if area in DOCK_AREAS
            for name in names
        }

    @property
    def plain_title(self) -> str:
        """The English title without the marker of its shortcut key."""
        return self.title.replace("&", "")

    @property
    def translated_title(self) -> str:
        """The title in the window's language."""
        return translate("shell", self.title).replace("&", "")


OPERATE = WindowLayout(
    marked("shell", "&Operate"),
    "Ctrl+1",
    marked("shell", "Operate the machine: control, job, events, trajectory, penetration, recorder"),
    {
        PanelArea.CENTRE: ("plots",),
        PanelArea.LEFT: ("control",),
        PanelArea.RIGHT: ("job", "events"),
        PanelArea.BOTTOM: ("trajectory", "comparison", "penetration", "recorder", "view3d"),
    },
    0.33,
    stacked=(PanelArea.RIGHT,),
)
TUNE = WindowLayout(
    marked("shell", "T&une"),
    "Ctrl+2",
    marked("shell", "Adjust the machine and its model: identification, calibration, effects"),
    {
        PanelArea.CENTRE: ("plots",),
        PanelArea.LEFT: ("control",),
        PanelArea.RIGHT: ("connection",),
        PanelArea.BOTTOM: ("identification", "calibration", "effects", "trajectory", "comparison"),
    },
    0.45,
)
DIAGNOSE = WindowLayout(
    marked("shell", "Dia&gnose"),
    "Ctrl+3",
    marked("shell", "Find out why machine and model differ: gap, comparison, effects"),
    {
        PanelArea.CENTRE: ("plots",),
        PanelArea.BOTTOM: ("gap", "comparison", "trajectory", "effects", "faults", "recorder"),
    },
    # Leaves only a strip of the plots.
    0.9,
)
SET_UP = WindowLayout(
    marked("shell", "&Set up"),
    "Ctrl+4",
    marked(
        "shell",
        "Prepare the machine: connection, devices, camera, calibration, holding plate",
    ),
    {
        PanelArea.CENTRE: ("microscope",),
        PanelArea.LEFT: ("control",),
        PanelArea.RIGHT: ("connection", "inputs", "teleoperation"),
        PanelArea.BOTTOM: ("calibration", "plate", "faults"),
    },
    0.33,
)
BUILT_IN = (OPERATE, TUNE, DIAGNOSE, SET_UP)


def apply_layout(
    window: QMainWindow,
    docks: Mapping[str, tuple[PanelArea, QDockWidget]],
    layout: WindowLayout,
    text_scale: float,
) -> None:
    """Place docks as a layout defines.

    The other docks are closed and moved to the areas that their panels prefer.
    """
    for _, dock in docks.values():
        if dock.isFloating():
            # This call is slow even if the dock does not float, so it is avoided.
            dock.setFloating(False)
        window.removeDockWidget(dock)
    layout_docks = {name: area for name, area in layout.docks.items() if name in docks}
    other_docks = {name: area for name, (area, _) in docks.items() if name not in layout_docks}
    front_docks: dict[PanelArea, QDockWidget] = {}
    for name, area in {**layout_docks, **other_docks}.items():
        dock = docks[name][1]
        window.addDockWidget(DOCK_AREAS[area], dock)
        is_stacked = area in layout.stacked and name in layout_docks
        if front_docks.setdefault(area, dock) is not dock and not is_stacked:
            window.tabifyDockWidget(front_docks[area], dock)
        dock.setVisible(name in layout_docks)
    for area in layout.places:
        if area in front_docks:
            front_docks[area].raise_()
    _resize_areas(window, front_docks, layout.bottom_share, text_scale)
    for area in layout.stacked:
        column = [docks[name][1] for name in layout.places[area] if name in docks]
        window.resizeDocks(column, [1000] * len(column), Qt.Orientation.Vertical)


def hide_stray_tab_bars(window: QMainWindow) -> None:
    """Hide tab bars that Qt leaves behind when it changes the layout (seen in Qt 6.11).

    The tab bar of a group of docks is directly above or below the front dock. A bar that is next to
    no dock is a leftover of a previous layout.
    """
    direct_children = Qt.FindChildOption.FindDirectChildrenOnly
    docks = [
        dock
        for dock in window.findChildren(QDockWidget, options=direct_children)
        if dock.isVisible() and not dock.isFloating()
    ]
    for bar in window.findChildren(QTabBar, options=direct_children):
        # With many tabs Qt shortens all titles to one letter, so the bar scrolls instead.
        bar.setElideMode(Qt.TextElideMode.ElideNone)
        bar.setUsesScrollButtons(True)
        if bar.isVisible() and not any(_has_tab_for(bar, dock) for dock in docks):
            bar.hide()


def measure_with_tabs(window: QMainWindow, dock: QDockWidget) -> QSize:
    """Return the size of a dock including its tab bar, as ``resizeDocks`` of Qt expects it."""
    bars = window.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly)
    heights = [bar.height() for bar in bars if bar.isVisible() and _has_tab_for(bar, dock)]
    return dock.size() + QSize(0, max(heights, default=0))


def _has_tab_for(bar: QTabBar, dock: QDockWidget) -> bool:
    titles = {bar.tabText(number).replace("&", "") for number in range(bar.count())}
    dock_rect, bar_rect = dock.geometry(), bar.geometry()
    is_adjacent = (
        min(abs(bar_rect.bottom() - dock_rect.top()), abs(dock_rect.bottom() - bar_rect.top()))
        <= _MAX_TAB_GAP_PX
    )
    return (
        is_adjacent
        and abs(bar_rect.left() - dock_rect.left()) <= _MAX_TAB_GAP_PX
        and dock.windowTitle() in titles
    )


def _resize_areas(
    window: QMainWindow,
    front_docks: Mapping[PanelArea, QDockWidget],
    bottom_share: float,
    text_scale: float,
) -> None:
    side_width = round(
        min(max(_SIDE_SHARE * window.width(), _MIN_SIDE_PX * text_scale), _MAX_SIDE_PX * text_scale)
    )
    side_width = min(side_width, round(_MAX_SIDE_SHARE * window.width()))
    for area in (PanelArea.LEFT, PanelArea.RIGHT):
        if area in front_docks:
            window.resizeDocks([front_docks[area]], [side_width], Qt.Orientation.Horizontal)
    if PanelArea.BOTTOM in front_docks:
        height = round(bottom_share * window.height())
        window.resizeDocks([front_docks[PanelArea.BOTTOM]], [height], Qt.Orientation.Vertical)


class SavedLayouts:
    """The layouts that the user has saved in the preferences."""

    def __init__(self, settings: UserSettings) -> None:
        self._settings = settings

    def list_names(self) -> tuple[str, ...]:
        """Return the names in alphabetical order."""
        return tuple(sorted(self._read_all(), key=str.casefold))

    def read_state(self, name: str) -> QByteArray:
        """Return the saved Qt state of a layout; empty if there is none or it is damaged."""
        return decode_state(self._read_all().get(name, ""))

    def save(self, name: str, state: QByteArray) -> None:
        """Save a layout; it replaces one of the same name."""
        self._write({**self._read_all(), name: encode_state(state)})

    def delete(self, name: str) -> None:
        """Delete a layout."""
        self._write({key: state for key, state in self._read_all().items() if key != name})

    def find_objection(self, name: str) -> str | None:
        """Return why a layout cannot be saved under a name, or None."""
        if not name:
            return translate("shell", "enter a name")
        if len(name) > MAX_NAME_LENGTH:
            return translate(
                "shell", "the name has {n} letters; at most {most} are possible"
            ).format(n=len(name), most=MAX_NAME_LENGTH)
        if name.casefold() in (
            word.casefold()
            for layout in BUILT_IN
            for word in (layout.plain_title, layout.translated_title)
        ):
            return translate(
                "shell", "{name} is a layout of the program; choose another name"
            ).format(name=name)
        if len(self._read_all()) >= MAX_SAVED_LAYOUTS and name not in self._read_all():
            return translate(
                "shell", "{n} layouts, the maximum, are saved; delete one first"
            ).format(n=MAX_SAVED_LAYOUTS)
        return None

    def _read_all(self) -> dict[str, str]:
        try:
            layouts = json.loads(self._settings.get(_LAYOUTS_KEY, "{}"))
        except (ValueError, RecursionError):
            return {}
        if not isinstance(layouts, dict):
            return {}
        return {name: state for name, state in layouts.items() if isinstance(state, str)}

    def _write(self, layouts: Mapping[str, str]) -> None:
        self._settings.set(_LAYOUTS_KEY, json.dumps(layouts))


def encode_state(state: QByteArray) -> str:
    """Return Qt's bytes as text."""
    return b64encode(state.data()).decode("ascii")


def decode_state(text: str) -> QByteArray:
    """Return the bytes of a saved text, or no bytes (which Qt ignores) if it is damaged."""
    try:
        return QByteArray(b64decode(text, validate=True))
    except ValueError:
        return QByteArray()
