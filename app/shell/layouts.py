"""Named layouts: which panels stand where, for what an operator is about to do."""

import json
from base64 import b64decode, b64encode
from collections.abc import Mapping
from dataclasses import dataclass

from PySide6.QtCore import QByteArray, QSize, Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabBar

from rotemina.app.panel import Area
from rotemina.app.settings import Settings
from rotemina.app.shell.language import marked, translate

VERSION = 1  # of what Qt keeps of a layout
MOST_KEPT = 20
LONGEST_NAME = 40
_KEPT = "window.layouts"
DOCK_AREAS = {
    Area.LEFT: Qt.DockWidgetArea.LeftDockWidgetArea,
    Area.RIGHT: Qt.DockWidgetArea.RightDockWidgetArea,
    Area.BOTTOM: Qt.DockWidgetArea.BottomDockWidgetArea,
}
_SIDE, _MOST_SIDE = 0.2, 0.4  # of the window's width, whatever the size of text
# px at normal text: a form is cut off when it is narrower, and reads no better when it is wider.
_NARROWEST, _WIDEST = 330, 460
_NEAR = 6  # px between the tabs of docks and the docks


@dataclass(frozen=True, slots=True)
class Layout:
    """Where panels stand; those that it does not name are closed, and can be brought back.

    Attributes
    ----------
    title, shortcut, tip : as in the menu
    places : area -> panels by name, the first in front
    bottom : share of the window's height that the docks at the bottom take
    stacked : areas whose panels stand one below another, not one behind another
    """

    title: str
    shortcut: str
    tip: str
    places: Mapping[Area, tuple[str, ...]]
    bottom: float
    stacked: tuple[Area, ...] = ()

    @property
    def docks(self) -> dict[str, Area]:
        """Where its docks stand, by panel."""
        return {
            name: area
            for area, names in self.places.items()
            if area in DOCK_AREAS
            for name in names
        }

    @property
    def word(self) -> str:
        """The title without the mark of its key, in English."""
        return self.title.replace("&", "")

    @property
    def shown(self) -> str:
        """The same in the window's language."""
        return translate("shell", self.title).replace("&", "")


OPERATE = Layout(
    marked("shell", "&Operate"),
    "Ctrl+1",
    marked("shell", "Operate the machine: control, job, events, trajectory, penetration, recorder"),
    {
        Area.CENTRE: ("plots",),
        Area.LEFT: ("control",),
        Area.RIGHT: ("job", "events"),
        Area.BOTTOM: ("trajectory", "comparison", "penetration", "recorder", "view3d"),
    },
    0.33,
    stacked=(Area.RIGHT,),
)
TUNE = Layout(
    marked("shell", "T&une"),
    "Ctrl+2",
    marked("shell", "Adjust the machine and its model: identification, calibration, effects"),
    {
        Area.CENTRE: ("plots",),
        Area.LEFT: ("control",),
        Area.RIGHT: ("connection",),
        Area.BOTTOM: ("identification", "calibration", "effects", "trajectory", "comparison"),
    },
    0.45,
)
DIAGNOSE = Layout(
    marked("shell", "Dia&gnose"),
    "Ctrl+3",
    marked("shell", "Find out why machine and model differ: gap, comparison, effects"),
    {
        Area.CENTRE: ("plots",),
        Area.BOTTOM: ("gap", "comparison", "trajectory", "effects", "faults", "recorder"),
    },
    0.9,  # all but a strip of plots
)
SET_UP = Layout(
    marked("shell", "&Set up"),
    "Ctrl+4",
    marked(
        "shell",
        "Prepare the machine: connection, devices, camera, calibration, holding plate",
    ),
    {
        Area.CENTRE: ("microscope",),
        Area.LEFT: ("control",),
        Area.RIGHT: ("connection", "inputs", "teleoperation"),
        Area.BOTTOM: ("calibration", "plate", "faults"),
    },
    0.33,
)
BUILT_IN = (OPERATE, TUNE, DIAGNOSE, SET_UP)


def arrange(
    window: QMainWindow,
    docks: Mapping[str, tuple[Area, QDockWidget]],
    layout: Layout,
    text_scale: float,
) -> None:
    """Put docks where a layout wants them; the others are closed where their panels want to be."""
    for _, dock in docks.values():
        if dock.isFloating():
            dock.setFloating(False)  # takes long, whether it floats or not
        window.removeDockWidget(dock)
    named = {name: area for name, area in layout.docks.items() if name in docks}
    rest = {name: area for name, (area, _) in docks.items() if name not in named}
    first: dict[Area, QDockWidget] = {}
    for name, area in {**named, **rest}.items():
        dock = docks[name][1]
        window.addDockWidget(DOCK_AREAS[area], dock)
        below = area in layout.stacked and name in named
        if first.setdefault(area, dock) is not dock and not below:
            window.tabifyDockWidget(first[area], dock)
        dock.setVisible(name in named)
    for area in layout.places:
        if area in first:
            first[area].raise_()
    _size(window, first, layout.bottom, text_scale)
    for area in layout.stacked:
        column = [docks[name][1] for name in layout.places[area] if name in docks]
        window.resizeDocks(column, [1000] * len(column), Qt.Orientation.Vertical)


def hide_forgotten_tabs(window: QMainWindow) -> None:
    """Hide tab bars that Qt has made on the way and forgotten (seen in 6.11); others may scroll.

    The tabs of docks stand right above (or below) the one in front; those that stand above none
    are what is left of another layout.
    """
    only_mine = Qt.FindChildOption.FindDirectChildrenOnly
    docks = [
        dock
        for dock in window.findChildren(QDockWidget, options=only_mine)
        if dock.isVisible() and not dock.isFloating()
    ]
    for bar in window.findChildren(QTabBar, options=only_mine):
        # Qt cuts the words of all to a letter where there are many: rather scroll.
        bar.setElideMode(Qt.TextElideMode.ElideNone)
        bar.setUsesScrollButtons(True)
        if bar.isVisible() and not any(_belongs(bar, dock) for dock in docks):
            bar.hide()


def size_with_tabs(window: QMainWindow, dock: QDockWidget) -> QSize:
    """Return the size of a dock with the tabs above it, as Qt counts it when docks are resized."""
    bars = window.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly)
    tabs = [bar.height() for bar in bars if bar.isVisible() and _belongs(bar, dock)]
    return dock.size() + QSize(0, max(tabs, default=0))


def _belongs(bar: QTabBar, dock: QDockWidget) -> bool:
    titles = {bar.tabText(number).replace("&", "") for number in range(bar.count())}
    place, tabs = dock.geometry(), bar.geometry()
    beside = min(abs(tabs.bottom() - place.top()), abs(place.bottom() - tabs.top())) <= _NEAR
    return beside and abs(tabs.left() - place.left()) <= _NEAR and dock.windowTitle() in titles


def _size(
    window: QMainWindow, first: Mapping[Area, QDockWidget], bottom: float, text_scale: float
) -> None:
    side = round(min(max(_SIDE * window.width(), _NARROWEST * text_scale), _WIDEST * text_scale))
    side = min(side, round(_MOST_SIDE * window.width()))
    for area in (Area.LEFT, Area.RIGHT):
        if area in first:
            window.resizeDocks([first[area]], [side], Qt.Orientation.Horizontal)
    if Area.BOTTOM in first:
        height = round(bottom * window.height())
        window.resizeDocks([first[Area.BOTTOM]], [height], Qt.Orientation.Vertical)


class KeptLayouts:
    """The layouts that a user has saved under names, among the preferences."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings

    def names(self) -> tuple[str, ...]:
        """Return their names in the order of the alphabet."""
        return tuple(sorted(self._all(), key=str.casefold))

    def state(self, name: str) -> QByteArray:
        """Return what Qt keeps of one; nothing where there is none or it was spoilt."""
        return decoded(self._all().get(name, ""))

    def keep(self, name: str, state: QByteArray) -> None:
        """Keep one, in the place of that of the same name."""
        self._write({**self._all(), name: encoded(state)})

    def forget(self, name: str) -> None:
        """Keep one no longer."""
        self._write({other: state for other, state in self._all().items() if other != name})

    def objection(self, name: str) -> str | None:
        """Return why a layout cannot be kept under a name, or None."""
        if not name:
            return translate("shell", "enter a name")
        if len(name) > LONGEST_NAME:
            return translate(
                "shell", "the name has {n} letters; at most {most} are possible"
            ).format(n=len(name), most=LONGEST_NAME)
        if name.casefold() in (
            word.casefold() for layout in BUILT_IN for word in (layout.word, layout.shown)
        ):
            return translate(
                "shell", "{name} is a layout of the program; choose another name"
            ).format(name=name)
        if len(self._all()) >= MOST_KEPT and name not in self._all():
            return translate(
                "shell", "{n} layouts, the maximum, are saved; delete one first"
            ).format(n=MOST_KEPT)
        return None

    def _all(self) -> dict[str, str]:
        try:
            kept = json.loads(self._settings.get(_KEPT, "{}"))
        except (ValueError, RecursionError):
            return {}
        if not isinstance(kept, dict):
            return {}
        return {name: state for name, state in kept.items() if isinstance(state, str)}

    def _write(self, layouts: Mapping[str, str]) -> None:
        self._settings.set(_KEPT, json.dumps(layouts))


def encoded(state: QByteArray) -> str:
    """Return bytes of Qt's as text."""
    return b64encode(state.data()).decode("ascii")


def decoded(text: str) -> QByteArray:
    """Return kept bytes; none where they were spoilt, which Qt then ignores."""
    try:
        return QByteArray(b64decode(text, validate=True))
    except ValueError:
        return QByteArray()
