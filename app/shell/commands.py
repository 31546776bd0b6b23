"""The commands of the window's menus, as a table."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple, Protocol

from rotemina.app.motion.state import Connection
from rotemina.app.shell.about import show_about
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.layouts import BUILT_IN
from rotemina.app.shell.theme import THEMES
from rotemina.app.shell.window_layout import Arrangement
from rotemina.app.shell.workbench import Workbench

_THEME_TEXTS = {
    "dark": marked("shell", "&Dark theme"),
    "light": marked("shell", "&Light theme"),
    "contrast": marked("shell", "&High contrast"),
}


class _Window(Protocol):
    workbench: Workbench
    arrangement: Arrangement

    def ask_trajectory(self) -> None: ...
    def ask_trajectory_of_record(self) -> None: ...
    def ask_record(self) -> None: ...
    def ask_save(self) -> None: ...
    def ask_layout_name(self) -> None: ...
    def reset_layout(self) -> None: ...
    def toggle_palette(self) -> None: ...
    def help_here(self) -> None: ...
    def show_help(self) -> None: ...
    def show_keys(self) -> None: ...
    def show_log(self) -> None: ...
    def show_support(self) -> None: ...
    def bring_up(self, name: str) -> None: ...
    def use_theme(self, name: str) -> None: ...
    def close(self) -> bool: ...


def always() -> str | None:
    """Nothing ever stands against it."""
    return None


class Command(NamedTuple):
    """One entry of a menu.

    Attributes
    ----------
    why_not : says what stands against it now, None for nothing
    panel : for what may move or switch something, name of the panel that must be visible for the
        command palette to run it; "" for anything else, and for what stops the machine
    """

    menu: str
    text: str
    shortcut: str
    run: Callable[[], object]
    tip: str
    why_not: Callable[[], str | None] = always
    panel: str = ""


def _unless(able: Callable[[], object], reason: str) -> Callable[[], str | None]:
    return lambda: None if able() else reason


def commands(window: _Window) -> list[Command]:
    """Return every command of the menus but the kept layouts, in their order."""
    return [*_file(window), *_motion(window), *_view(window), *_help(window)]


def _file(window: _Window) -> list[Command]:
    command = partial(Command, translate("shell", "&File"))
    bench = window.workbench
    no_record = translate("shell", "there is no record; play a trajectory or open one")
    return [
        command(
            translate("shell", "Load &trajectory …"),
            "Ctrl+T",
            window.ask_trajectory,
            translate("shell", "Load and dry-run"),
        ),
        command(
            translate("shell", "Trajectory from &record …"),
            "",
            window.ask_trajectory_of_record,
            translate("shell", "Load the commands of a record of the library"),
        ),
        command(
            translate("shell", "&Open record …"),
            "Ctrl+O",
            window.ask_record,
            translate("shell", "Compare with the model"),
        ),
        command(
            translate("shell", "&Save record …"),
            "Ctrl+S",
            window.ask_save,
            translate("shell", "Save the last record"),
            _unless(lambda: bench.record, no_record),
        ),
        command(
            translate("shell", "&Quit"),
            "Ctrl+Q",
            window.close,
            translate("shell", "Stop and leave"),
        ),
    ]


def _motion(window: _Window) -> list[Command]:
    command = partial(Command, translate("shell", "&Motion"))
    bench = window.workbench
    state = bench.session.snapshot

    def no_play() -> str | None:
        none = translate("shell", "there is no trajectory; load one first")
        return state().locked if bench.plan else none

    def connected() -> bool:
        return state().connection is Connection.CONNECTED

    no_device = _unless(connected, translate("shell", "no device is connected"))
    return [
        command(
            translate("shell", "&Play or pause"),
            "Ctrl+P",
            bench.toggle_playback,
            translate("shell", "The trajectory"),
            no_play,
            "trajectory",
        ),
        command(
            translate("shell", "&Stop"),
            "",
            bench.stop,
            translate("shell", "Stop all axes and hold their positions (Esc)"),
        ),
        command(
            translate("shell", "Stop and loc&k"),
            "",
            bench.emergency_stop,
            translate("shell", "Locks until release (Shift+Esc)"),
        ),
        command(
            translate("shell", "Re&lease the lock"),
            "",
            bench.release,
            translate("shell", "Let axes move"),
            _unless(lambda: state().latched, translate("shell", "the machine is not locked")),
            "connection",
        ),
        command(
            translate("shell", "&Back to the previous position"),
            "Ctrl+Z",
            bench.undo,
            translate("shell", "Retract, travel, approach"),
            _unless(
                lambda: bench.session.undoable, translate("shell", "there is no previous position")
            ),
            "control",
        ),
        command(
            translate("shell", "&Home all axes"),
            "",
            bench.home,
            translate("shell", "Find the limit switches"),
            no_device,
            "control",
        ),
        command(
            translate("shell", "&Clear fault"),
            "",
            bench.clear_fault,
            translate("shell", "Acknowledge the fault"),
            _unless(lambda: state().fault, translate("shell", "there is no fault")),
            "connection",
        ),
        command(
            translate("shell", "C&onnect …"),
            "",
            lambda: window.bring_up("connection"),
            translate("shell", "Choose a machine or the simulator"),
        ),
        command(
            translate("shell", "&Reconnect"),
            "",
            bench.reconnect,
            translate("shell", "Connect after a failure"),
            _unless(lambda: not connected(), translate("shell", "already connected")),
            "connection",
        ),
        command(
            translate("shell", "&Disconnect"),
            "",
            bench.let_go,
            translate("shell", "Stop and disconnect"),
            no_device,
            "connection",
        ),
    ]


def _view(window: _Window) -> list[Command]:
    command = partial(Command, translate("shell", "&View"))
    looks = window.arrangement
    layouts = [
        command(
            translate("shell", layout.title),
            layout.shortcut,
            lambda layout=layout: looks.arrange(layout),
            translate("shell", layout.tip),
        )
        for layout in BUILT_IN
    ]
    return [
        *layouts,
        command(
            translate("shell", "Save la&yout …"),
            "",
            window.ask_layout_name,
            translate("shell", "Save the layout under a name"),
        ),
        command(
            translate("shell", "&Restore the layout"),
            "Ctrl+Shift+0",
            window.reset_layout,
            translate("shell", "Restore all panels"),
        ),
        *(
            command(
                translate("shell", _THEME_TEXTS[name]),
                "",
                lambda name=name: window.use_theme(name),
                "",
            )
            for name in THEMES
        ),
        command(
            translate("shell", "Larger text"),
            "Ctrl++",
            lambda: looks.step_scale(1),
            translate("shell", "Up to twice"),
        ),
        command(translate("shell", "Smaller text"), "Ctrl+-", lambda: looks.step_scale(-1), ""),
        command(
            translate("shell", "Text size: automatic"),
            "Ctrl+0",
            looks.suit_the_screen,
            translate("shell", "By the height of the screen"),
        ),
    ]


def _help(window: _Window) -> list[Command]:
    command = partial(Command, translate("shell", "&Help"))
    return [
        command(
            translate("shell", "&Find a command …"),
            "Ctrl+Shift+P",
            window.toggle_palette,
            translate("shell", "By letters of its name"),
        ),
        command(
            translate("shell", "Help on this &panel"),
            "F1",
            window.help_here,
            translate("shell", "The panel that has the focus"),
        ),
        command(
            translate("shell", "&All pages"),
            "",
            window.show_help,
            translate("shell", "They need no network"),
        ),
        command(
            translate("shell", "&Keys"),
            "Shift+F1",
            window.show_keys,
            translate("shell", "All shortcuts"),
        ),
        command(
            translate("shell", "&Log"),
            "Ctrl+L",
            window.show_log,
            translate("shell", "All messages of the program"),
        ),
        command(
            translate("shell", "&Support bundle …"),
            "",
            window.show_support,
            translate("shell", "Log, settings, versions and record for support"),
        ),
        command(
            translate("shell", "A&bout RoTeMiNa"),
            "",
            lambda: show_about(window, window.workbench),
            translate("shell", "Version, licence and folders"),
        ),
    ]
