"""The commands of the window's menus, as a table."""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from rotemina.app.motion.state import Connection
from rotemina.app.shell.layouts import BUILT_IN
from rotemina.app.shell.theme import THEMES
from rotemina.app.shell.workbench import Workbench

if TYPE_CHECKING:
    from rotemina.app.shell.main_window import MainWindow

_THEME_TEXTS = {"dark": "&Dark theme", "light": "&Light theme", "contrast": "&High contrast"}


def always() -> str | None:
    """Nothing ever stands against it."""
    return None


class Command(NamedTuple):
    """One entry of a menu; ``why_not`` says what stands against it now, None for nothing."""

    menu: str
    text: str
    shortcut: str
    run: Callable[[], object]
    tip: str
    why_not: Callable[[], str | None] = always


def commands(window: "MainWindow") -> list[Command]:
    """Return every command of the menus but the kept layouts, in their order."""
    return [*_file(window), *_motion(window.workbench), *_view(window), *_help(window)]


def _file(window: "MainWindow") -> list[Command]:
    bench = window.workbench

    def no_record() -> str | None:
        return None if bench.record else "there is no record; play a trajectory or open one"

    return [
        Command("&File", "Load &trajectory …", "Ctrl+T", window.ask_trajectory, "Load and dry-run"),
        Command("&File", "&Open record …", "Ctrl+O", window.ask_record, "Compare with the model"),
        Command(
            "&File", "&Save record …", "Ctrl+S", window.ask_save, "Save the last record", no_record
        ),
        Command("&File", "&Quit", "Ctrl+Q", window.close, "Stop and leave"),
    ]


def _motion(bench: Workbench) -> list[Command]:
    state = bench.session.snapshot

    def no_play() -> str | None:
        return state().locked if bench.plan else "there is no trajectory; load one first"

    def no_release() -> str | None:
        return None if state().latched else "the emergency stop is not latched"

    def no_way_back() -> str | None:
        return None if bench.session.undoable else "there is no move to take back"

    def no_device() -> str | None:
        return None if state().connection is Connection.CONNECTED else "no device is connected"

    def no_fault() -> str | None:
        return None if state().fault else "there is no fault"

    def connected() -> str | None:
        return "it is connected" if state().connection is Connection.CONNECTED else None

    menu = "&Motion"
    return [
        Command(menu, "&Play or pause", "Ctrl+P", bench.toggle_playback, "The trajectory", no_play),
        Command(menu, "&Stop", "", bench.stop, "Stop all axes and hold (Esc)"),
        Command(menu, "&Emergency stop", "", bench.emergency_stop, "Latched (Shift+Esc)"),
        Command(
            menu, "Re&lease the emergency stop", "", bench.release, "Let axes move", no_release
        ),
        Command(
            menu,
            "&Back to before the latest move",
            "Ctrl+Z",
            bench.undo,
            "Retract, travel, approach",
            no_way_back,
        ),
        Command(menu, "&Home all axes", "", bench.home, "Find the limit switches", no_device),
        Command(menu, "&Clear fault", "", bench.clear_fault, "Acknowledge it", no_fault),
        Command(menu, "&Reconnect", "", bench.reconnect, "Connect after a failure", connected),
        Command(menu, "&Disconnect", "", bench.let_go, "Stop, and let go of it", no_device),
    ]


def _view(window: "MainWindow") -> list[Command]:
    looks = window.arrangement
    layouts = [
        Command(
            "&View",
            layout.title,
            layout.shortcut,
            lambda layout=layout: looks.arrange(layout),
            layout.tip,
        )
        for layout in BUILT_IN
    ]
    return [
        *layouts,
        Command("&View", "Save la&yout …", "", window.ask_layout_name, "Keep it under a name"),
        Command(
            "&View", "&Restore the layout", "Ctrl+Shift+0", window.reset_layout, "All docks back"
        ),
        *(
            Command("&View", _THEME_TEXTS[name], "", lambda name=name: window.use_theme(name), "")
            for name in THEMES
        ),
        Command("&View", "Larger text", "Ctrl++", lambda: looks.step_scale(1), "Up to twice"),
        Command("&View", "Smaller text", "Ctrl+-", lambda: looks.step_scale(-1), ""),
        Command(
            "&View", "Text as the screen suits", "Ctrl+0", looks.suit_the_screen, "By its height"
        ),
    ]


def _help(window: "MainWindow") -> list[Command]:
    return [
        Command("&Help", "&Find a command …", "Ctrl+Shift+P", window.toggle_palette, "By letters"),
        Command("&Help", "Help on this &panel", "F1", window.help_here, "The one with the focus"),
        Command("&Help", "&All pages", "", window.show_help, "They need no network"),
        Command("&Help", "&Keys", "Shift+F1", window.show_keys, "All shortcuts"),
        Command("&Help", "&Log", "Ctrl+L", window.show_log, "All that the program told"),
        Command(
            "&Help",
            "&Support bundle …",
            "",
            window.show_support,
            "Log, settings, versions and record for those who help",
        ),
    ]
