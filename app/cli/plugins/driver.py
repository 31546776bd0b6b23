"""``rotemina driver``: list the installed drivers, and check them against the contract."""

import argparse
from collections.abc import Iterable

from rotemina.app.cli.terminal import (
    add_robot,
    load_selected_robot,
    print_message,
)
from rotemina.app.settings import parse_assignments
from rotemina.drivers.abilities import abilities
from rotemina.drivers.conformance import (
    CheckVerdict,
    DriverCheckResult,
    find_checks,
    make_bench,
    run_checks,
)
from rotemina.drivers.contract import Driver, discover_drivers, find_driver
from rotemina.sim.messages import Message, message

_EXIT_FAILED = 1


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "driver",
        help="list drivers, and check whether they meet the driver contract",
        description="List the installed drivers, both built-in and from plugins.",
    )
    parser.set_defaults(run=_list_drivers)
    verbs = parser.add_subparsers(title="subcommands", metavar="")
    listing = verbs.add_parser("list", help="print one line for each driver (default)")
    listing.set_defaults(run=_list_drivers)
    checking = verbs.add_parser(
        "check",
        help="check a driver against the contract",
        description="Open a driver and measure whether it meets the contract. On a real device, "
        "only the checks without motion run unless --move is given. Exit status: 0 "
        "all passed, 1 a check failed.",
    )
    checking.add_argument("name", metavar="NAME")
    add_robot(checking)
    checking.add_argument(
        "--set",
        dest="settings",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="a setting of the driver (may be repeated)",
    )
    checking.add_argument(
        "--only",
        action="append",
        default=[],
        metavar="CHECK",
        help="only this check (may be repeated)",
    )
    checking.add_argument("--move", action="store_true", help="let the axes of a real device move")
    checking.add_argument(
        "--verbose", action="store_true", help="also print what each check requires"
    )
    checking.set_defaults(run=_check_driver)


def _list_drivers(options: argparse.Namespace) -> int:
    discovery = discover_drivers()
    for name, driver_class in discovery.plugins.items():
        clock = (
            message("cli", "any clock")
            if driver_class.virtual_time
            else message("cli", "real time")
        )
        abilities_text = ", ".join(_list_abilities(driver_class)) or message("cli", "moves")
        print(
            f"{name:16}{options.wording.format_message(clock):16}{options.wording.format_field(abilities_text)}"
        )
    for name, reason in discovery.problems.items():
        text = message("cli", "left out: {name}: {reason}").fill(name=name, reason=reason)
        print_message(options, text)
    return 0


def _list_abilities(driver_class: type[Driver]) -> Iterable[str]:
    for name, ability in vars(abilities).items():
        is_ability = (
            isinstance(ability, type) and issubclass(ability, Driver) and ability is not Driver
        )
        if is_ability and issubclass(driver_class, ability):
            yield name


def _check_driver(options: argparse.Namespace) -> int:
    driver_class, robot = find_driver(options.name), load_selected_robot(options)
    settings = parse_assignments(driver_class, options.settings)
    # A setting out of bounds is invalid input and not a failed check. The constructor raises here.
    driver_class(robot, settings)
    checks = find_checks(options.only)
    may_move = driver_class.virtual_time or options.move
    if not driver_class.virtual_time:
        print_message(options, _make_warning(options.name, may_move))
    results = []
    for result in run_checks(make_bench(driver_class, robot, settings), checks, may_move=may_move):
        results.append(result)
        print("\n".join(_format_result(result, verbose=options.verbose)), flush=True)
    counts = ", ".join(
        f"{sum(result.verdict is verdict for result in results)} {verdict}"
        for verdict in CheckVerdict
    )
    print(f"{options.name} on {robot.name}: {counts}")
    return _EXIT_FAILED if any(result.verdict is CheckVerdict.FAILED for result in results) else 0


def _make_warning(name: str, may_move: bool) -> Message:
    if may_move:
        warning = message(
            "cli",
            "{name} may drive a real machine: ALL AXES WILL MOVE, including to the ends of "
            "their ranges. Remove the tool, and keep the machine's emergency stop switch within "
            "reach.",
        )
    else:
        warning = message(
            "cli",
            "{name} may drive a real machine: only checks without motion run; --move lets the "
            "axes move",
        )
    return warning.fill(name=name)


def _format_result(result: DriverCheckResult, *, verbose: bool) -> Iterable[str]:
    verdict_texts = {
        CheckVerdict.PASSED: "ok",
        CheckVerdict.FAILED: "FAILED",
        CheckVerdict.SKIPPED: "-",
    }
    yield f"  {verdict_texts[result.verdict]:8}{result.name:26}{result.note}".rstrip()
    if verbose or result.verdict is CheckVerdict.FAILED:
        yield f"          {result.requirement}"
