"""The commands of the window's menus, as a table."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple, Protocol

from rotemina.app.language import marked, translate
from rotemina.app.motion.state import ConnectionState
from rotemina.app.shell.help import show_about
from rotemina.app.shell.window.layouts import BUILT_IN
from rotemina.app.shell.window.window_layout import WindowArrangement
from rotemina.app.widgets.style import THEMES
from rotemina.app.workbench import Workbench

_THEME_TEXTS = {
    "dark": marked("shell", "&Dark theme"),
    "light": marked("shell", "&Light theme"),
    "contrast": marked("shell", "&High contrast"),
}


class _Window(Protocol):
    workbench: Workbench
    arrangement: WindowArrangement

    def ask_trajectory(self) -> None: ...
    def ask_trajectory_of_record(self) -> None: ...
    def ask_record(self) -> None: ...
    def ask_save(self) -> None: ...
    def ask_layout_name(self) -> None: ...
    def reset_layout(self) -> None: ...
    def toggle_palette(self) -> None: ...
    def show_panel_help(self) -> None: ...
    def show_help(self) -> None: ...
    def show_keys(self) -> None: ...
    def show_log(self) -> None: ...
    def show_support(self) -> None: ...
    def bring_up(self, name: str) -> None: ...
    def use_theme(self, name: str) -> None: ...
    def close(self) -> bool: ...


def accept_always() -> str | None:
    """Return None: the command can always run."""
    return None


class MenuCommand(NamedTuple):
    """One entry of a menu.

    Attributes
    ----------
    why_not : callable
        Returns why the command cannot run now, or None if it can.
    panel : str
        Name of the panel that must be visible before the command palette runs a command that may
        move or switch something. "" if none is needed; commands that stop the machine need none.
    """

    menu: str
    text: str
    shortcut: str
    run: Callable[[], object]
    tip: str
    find_objection: Callable[[], str | None] = accept_always
    panel: str = ""


def _require(condition: Callable[[], object], reason: str) -> Callable[[], str | None]:
    return lambda: None if condition() else reason


def make_commands(window: _Window) -> list[MenuCommand]:
    """Return every command of the menus in menu order, except the saved layouts."""
    return [
        *_make_file_commands(window),
        *_make_motion_commands(window),
        *_make_view_commands(window),
        *_make_help_commands(window),
    ]


def _make_file_commands(window: _Window) -> list[MenuCommand]:
    command = partial(MenuCommand, translate("shell", "&File"))
    bench = window.workbench
    no_record_text = translate("shell", "there is no record; play a trajectory or open one")
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
            _require(lambda: bench.record, no_record_text),
        ),
        command(
            translate("shell", "&Quit"),
            "Ctrl+Q",
            window.close,
            translate("shell", "Stop the machine and quit"),
        ),
    ]


def _make_motion_commands(window: _Window) -> list[MenuCommand]:
    command = partial(MenuCommand, translate("shell", "&Motion"))
    bench = window.workbench
    state = bench.session.snapshot

    def find_play_objection() -> str | None:
        no_trajectory = translate("shell", "there is no trajectory; load one first")
        return state().lock_reason if bench.plan else no_trajectory

    def is_connected() -> bool:
        return state().connection is ConnectionState.CONNECTED

    require_device = _require(is_connected, translate("shell", "no device is connected"))
    return [
        command(
            translate("shell", "&Play or pause"),
            "Ctrl+P",
            bench.toggle_playback,
            translate("shell", "The trajectory"),
            find_play_objection,
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
            _require(lambda: state().latch_reason, translate("shell", "the machine is not locked")),
            "connection",
        ),
        command(
            translate("shell", "&Back to the previous position"),
            "Ctrl+Z",
            bench.undo,
            translate("shell", "Retract, travel, approach"),
            _require(
                lambda: bench.session.can_undo, translate("shell", "there is no previous position")
            ),
            "control",
        ),
        command(
            translate("shell", "&Home all axes"),
            "",
            bench.home,
            translate("shell", "Find the limit switches"),
            require_device,
            "control",
        ),
        command(
            translate("shell", "&Clear fault"),
            "",
            bench.clear_fault,
            translate("shell", "Acknowledge the fault"),
            _require(lambda: state().fault, translate("shell", "there is no fault")),
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
            _require(lambda: not is_connected(), translate("shell", "already connected")),
            "connection",
        ),
        command(
            translate("shell", "&Disconnect"),
            "",
            bench.disconnect_device,
            translate("shell", "Stop and disconnect"),
            require_device,
            "connection",
        ),
    ]


def _make_view_commands(window: _Window) -> list[MenuCommand]:
    command = partial(MenuCommand, translate("shell", "&View"))
    arrangement = window.arrangement
    layouts = [
        command(
            translate("shell", layout.title),
            layout.shortcut,
            lambda layout=layout: arrangement.arrange(layout),
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
            lambda: arrangement.step_scale(1),
            translate("shell", "Up to twice the normal size"),
        ),
        command(
            translate("shell", "Smaller text"), "Ctrl+-", lambda: arrangement.step_scale(-1), ""
        ),
        command(
            translate("shell", "Text size: automatic"),
            "Ctrl+0",
            arrangement.use_automatic_scale,
            translate("shell", "Depends on the height of the screen"),
        ),
    ]


def _make_help_commands(window: _Window) -> list[MenuCommand]:
    command = partial(MenuCommand, translate("shell", "&Help"))
    return [
        command(
            translate("shell", "&Find a command …"),
            "Ctrl+Shift+P",
            window.toggle_palette,
            translate("shell", "Type part of its name"),
        ),
        command(
            translate("shell", "Help on this &panel"),
            "F1",
            window.show_panel_help,
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
