"""``rotemina plugin``: write the package of a new plugin, list plugins, and check them."""

import argparse
import warnings
from pathlib import Path

from rotemina.app.cli.terminal import add_robot, load_selected_robot, print_message
from rotemina.app.errors import CommandError
from rotemina.sim.messages import message

_EXIT_FAILED = 1
_ROW_FORMAT = "{:8}{:24}{:28}{:10}{:15}{}"
_PLUGIN_KINDS = ("driver", "panel", "effect", "camera", "input")


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "plugin",
        help="write a new plugin, list plugins and check them",
        description="Plugins of all kinds: drivers, panels, effects, cameras, input devices.",
    )
    verbs = parser.add_subparsers(metavar="", required=True)

    new_parser = verbs.add_parser(
        "new",
        help="write a package with a working, tested plugin",
        description="Write a package into a new folder rotemina-NAME. Existing files are not "
        "overwritten.",
    )
    new_parser.add_argument(
        "kind", metavar="KIND", choices=_PLUGIN_KINDS, help=", ".join(_PLUGIN_KINDS)
    )
    new_parser.add_argument(
        "name", metavar="NAME", help="small letters, digits, single underscores"
    )
    new_parser.add_argument(
        "--folder", type=Path, default=Path(), metavar="DIR", help="parent folder (default: here)"
    )
    new_parser.set_defaults(run=create_plugin)

    list_parser = verbs.add_parser(
        "list", help="print one line for each plugin, and why a plugin was not loaded"
    )
    list_parser.add_argument(
        "kind", nargs="?", metavar="KIND", choices=_PLUGIN_KINDS, help="only this kind"
    )
    list_parser.set_defaults(run=list_plugins)

    check_parser = verbs.add_parser(
        "check",
        help="run the checks for the plugin's kind",
        description="Import a plugin again and run the checks of its kind. For the driver of a "
        "real device, no check moves an axis (see `rotemina driver check`). Exit "
        "status: 0 all passed, 1 a check failed.",
    )
    check_parser.add_argument("name", metavar="NAME")
    check_parser.add_argument(
        "--kind",
        metavar="KIND",
        choices=_PLUGIN_KINDS,
        help="kind, if plugins of several kinds have this name",
    )
    check_parser.add_argument(
        "--verbose", action="store_true", help="also print what each check requires"
    )
    add_robot(check_parser)
    check_parser.set_defaults(run=check_plugins)


def create_plugin(options: argparse.Namespace) -> int:
    """Write a package, and print the next steps."""
    # The imports are slow, and the help does not need them.
    from rotemina.app.plugin_kit import PluginKind, write_plugin

    folder = write_plugin(PluginKind(options.kind), options.name, options.folder)
    text = message(
        "cli",
        "{place}: {kind} {name}; install it with\n"
        "  pip install --editable '{place}[test]'\n"
        "and check it with `rotemina plugin check {name}` and `pytest {place}`.",
    )
    print_message(options, text.fill(place=folder, kind=options.kind, name=options.name))
    return 0


def list_plugins(options: argparse.Namespace) -> int:
    """Print a line for each plugin: kind, name, package, version, interface, state."""
    from rotemina.app.plugin_kit import PluginKind, load_installed_plugins

    wording = options.wording
    header = [
        wording.format_message(title)
        for title in (
            message("cli", "kind"),
            message("cli", "name"),
            message("cli", "package"),
            message("cli", "version"),
            message("cli", "interface"),
            message("cli", "state"),
        )
    ]
    print(_ROW_FORMAT.format(*header))
    for kind in PluginKind if options.kind is None else (PluginKind(options.kind),):
        for plugin in load_installed_plugins(kind):
            plugin_version = "?" if plugin.api_version is None else str(plugin.api_version)
            template = message("cli", "{version} of {current}")
            interface = wording.format_message(
                template.fill(version=plugin_version, current=kind.api_version)
            )
            state = message("cli", "loaded")
            if plugin.refusal:
                state = message("cli", "left out: {reason}").fill(reason=plugin.refusal)
            row = (kind, plugin.name, plugin.package or "?", plugin.version or "?", interface)
            print(_ROW_FORMAT.format(*row, wording.format_message(state)))
    return 0


def check_plugins(options: argparse.Namespace) -> int:
    """Check the plugins with a name; return 1 if a check failed."""
    from rotemina.app.plugin_kit import check_plugin, find_entry_points
    from rotemina.drivers.conformance import CheckVerdict

    points = [
        (kind, point)
        for kind, point in find_entry_points(options.name)
        if options.kind in (None, str(kind))
    ]
    if not points:
        missing_kind = options.kind or "plugin"
        raise CommandError(
            "there is no {wanted} {name}; `rotemina plugin list` lists all",
            wanted=missing_kind,
            name=repr(options.name),
        )
    verdict_texts = {
        CheckVerdict.PASSED: "ok",
        CheckVerdict.FAILED: "FAILED",
        CheckVerdict.SKIPPED: "-",
    }
    robot = load_selected_robot(options)
    failed_count = 0
    for kind, point in points:
        print(f"{kind} {point.name} ({point.value})", flush=True)
        with warnings.catch_warnings(record=True) as caught_warnings:
            warnings.simplefilter("always", DeprecationWarning)
            for result in check_plugin(kind, point, robot):
                failed_count += result.verdict is CheckVerdict.FAILED
                print(
                    f"  {verdict_texts[result.verdict]:8}{result.name:38}{result.note}".rstrip(),
                    flush=True,
                )
                if options.verbose or result.verdict is CheckVerdict.FAILED:
                    print(f"          {result.requirement}", flush=True)
        # A dict keeps the order and drops repetitions.
        for text in dict.fromkeys(str(warning.message) for warning in caught_warnings):
            print(f"  warning {text}", flush=True)
    return _EXIT_FAILED if failed_count else 0
