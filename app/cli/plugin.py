"""``rotemina plugin``: write a new plugin's package, list what is installed, check it."""

import argparse
from pathlib import Path

from rotemina.app.cli.options import add_robot, robot_of, tell
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message

_FAILED = 1
_ROW = "{:8}{:24}{:28}{:10}{:15}{}"
_KINDS = ("driver", "panel", "effect", "camera", "input")


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "plugin",
        help="write a new plugin, list plugins and check them",
        description="Plugins of all kinds: drivers, panels, effects, cameras, input devices.",
    )
    verbs = parser.add_subparsers(metavar="", required=True)

    one = verbs.add_parser(
        "new",
        help="write a package with a working, tested plugin",
        description="Write a package rotemina-NAME into a folder of its own. Existing files are "
        "not overwritten.",
    )
    one.add_argument("kind", metavar="KIND", choices=_KINDS, help=", ".join(_KINDS))
    one.add_argument("name", metavar="NAME", help="small letters, digits, single underscores")
    one.add_argument(
        "--folder", type=Path, default=Path(), metavar="DIR", help="parent folder (default: here)"
    )
    one.set_defaults(run=new)

    one = verbs.add_parser("list", help="print one line for each plugin, and why any was left out")
    one.add_argument("kind", nargs="?", metavar="KIND", choices=_KINDS, help="only this kind")
    one.set_defaults(run=list_plugins)

    one = verbs.add_parser(
        "check",
        help="run the checks for the plugin's kind",
        description="Import a plugin anew and run the checks of its kind. For the driver of a "
        "real device, no check moves an axis (see `rotemina driver check`). Exit "
        "status: 0 all passed, 1 a check failed.",
    )
    one.add_argument("name", metavar="NAME")
    one.add_argument(
        "--kind", metavar="KIND", choices=_KINDS, help="kind, where several kinds share the name"
    )
    one.add_argument("--verbose", action="store_true", help="also print what each check demands")
    add_robot(one)
    one.set_defaults(run=check)


def new(options: argparse.Namespace) -> int:
    """Write a package, and print the next steps."""
    from rotemina.app.plugin_kit.plugin_kinds import Kind  # the kinds take their time to import
    from rotemina.app.plugin_kit.writing import new_plugin

    place = new_plugin(Kind(options.kind), options.name, options.folder)
    said = message(
        "cli",
        "{place}: {kind} {name}; install it with\n"
        "  pip install --editable '{place}[test]'\n"
        "and check it with `rotemina plugin check {name}` and `pytest {place}`.",
    )
    tell(options, said.fill(place=place, kind=options.kind, name=options.name))
    return 0


def list_plugins(options: argparse.Namespace) -> int:
    """Print a line for each plugin: kind, name, package, version, interface, state."""
    from rotemina.app.plugin_kit.plugin_kinds import Kind, installed_plugins

    wording = options.wording
    head = [
        wording.of(one)
        for one in (
            message("cli", "kind"),
            message("cli", "name"),
            message("cli", "package"),
            message("cli", "version"),
            message("cli", "interface"),
            message("cli", "state"),
        )
    ]
    print(_ROW.format(*head))
    for kind in Kind if options.kind is None else (Kind(options.kind),):
        for one in installed_plugins(kind):
            written_for = "?" if one.api_version is None else str(one.api_version)
            said = message("cli", "{version} of {current}")
            interface = wording.of(said.fill(version=written_for, current=kind.api_version))
            state = message("cli", "loaded")
            if one.refused:
                state = message("cli", "left out: {reason}").fill(reason=one.refused)
            row = (kind, one.name, one.package or "?", one.version or "?", interface)
            print(_ROW.format(*row, wording.of(state)))
    return 0


def check(options: argparse.Namespace) -> int:
    """Check the plugins of a name; status 1 if something failed."""
    from rotemina.app.plugin_kit.checking import check_plugin
    from rotemina.app.plugin_kit.plugin_kinds import named_points
    from rotemina.drivers.conformance.check import Verdict

    points = [
        (kind, point)
        for kind, point in named_points(options.name)
        if options.kind in (None, str(kind))
    ]
    if not points:
        wanted = options.kind or "plugin"
        raise InputError(
            message("cli", "there is no {wanted} {name}; `rotemina plugin list` lists all").fill(
                wanted=wanted, name=repr(options.name)
            )
        )
    said = {Verdict.PASSED: "ok", Verdict.FAILED: "FAILED", Verdict.SKIPPED: "-"}
    robot = robot_of(options)
    failed = 0
    for kind, point in points:
        print(f"{kind} {point.name} ({point.value})", flush=True)
        for result in check_plugin(kind, point, robot):
            failed += result.verdict is Verdict.FAILED
            print(f"  {said[result.verdict]:8}{result.name:38}{result.note}".rstrip(), flush=True)
            if options.verbose or result.verdict is Verdict.FAILED:
                print(f"          {result.demand}", flush=True)
    return _FAILED if failed else 0
