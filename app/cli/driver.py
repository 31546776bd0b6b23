"""``rotemina driver``: which drivers are installed, and whether they keep the contract."""

import argparse
from collections.abc import Iterable

from rotemina.app.cli.options import add_robot, robot_of, tell
from rotemina.drivers import abilities
from rotemina.drivers.conformance.bench import bench_of
from rotemina.drivers.conformance.check import Result, Verdict
from rotemina.drivers.conformance.suite import checks_named, run_checks
from rotemina.drivers.driver import Driver
from rotemina.drivers.registry import discover_drivers, driver_named
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.sim.messages import Message, message

_FAILED = 1
_SWITCH = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "driver",
        help="list drivers, and check whether they keep the contract",
        description="The installed drivers: built in, and of plugins.",
    )
    parser.set_defaults(run=_list)
    verbs = parser.add_subparsers(title="subcommands", metavar="")
    listing = verbs.add_parser("list", help="print one line for each driver (default)")
    listing.set_defaults(run=_list)
    checking = verbs.add_parser(
        "check",
        help="check a driver against the contract",
        description="Open a driver and measure whether it keeps the contract. On a real device, "
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
        "--verbose", action="store_true", help="also print what each check demands"
    )
    checking.set_defaults(run=_check)


def _list(options: argparse.Namespace) -> int:
    """Print a line for each driver, what it can do, and what could not be loaded."""
    discovery = discover_drivers()
    for name, driver in discovery.found.items():
        clock = message("cli", "any clock") if driver.virtual_time else message("cli", "real time")
        can = ", ".join(_abilities(driver)) or message("cli", "moves")
        print(f"{name:16}{options.wording.of(clock):16}{options.wording.shown(can)}")
    for name, reason in discovery.broken.items():
        said = message("cli", "left out: {name}: {reason}").fill(name=name, reason=reason)
        tell(options, said)
    return 0


def _abilities(driver: type[Driver]) -> Iterable[str]:
    """Return the names of the abilities that a driver has, in the contract's order."""
    for name, ability in vars(abilities).items():
        own = isinstance(ability, type) and issubclass(ability, Driver) and ability is not Driver
        if own and issubclass(driver, ability):
            yield name


def _check(options: argparse.Namespace) -> int:
    """Check a driver and print what was found; status 1 if something failed."""
    driver, robot = driver_named(options.name), robot_of(options)
    settings = _settings(driver, options.settings)
    driver(robot, settings)  # a setting out of bounds is bad input, no failed check
    checks = checks_named(options.only)
    may_move = driver.virtual_time or options.move
    if not driver.virtual_time:
        tell(options, _warning(options.name, may_move))
    results = []
    for result in run_checks(bench_of(driver, robot, settings), checks, may_move=may_move):
        results.append(result)
        print("\n".join(_lines(result, verbose=options.verbose)), flush=True)
    counts = ((sum(one.verdict is each for one in results), each) for each in Verdict)
    print(f"{options.name} on {robot.name}: {', '.join(f'{n} {each}' for n, each in counts)}")
    return _FAILED if any(one.verdict is Verdict.FAILED for one in results) else 0


def _warning(name: str, may_move: bool) -> Message:
    if may_move:
        warning = message(
            "cli",
            "{name} runs in real time: ALL AXES WILL MOVE, also to the ends of their ranges. "
            "Remove the tool, and keep the machine's emergency stop switch within reach.",
        )
    else:
        warning = message(
            "cli",
            "{name} runs in real time: only checks without motion run; --move lets the axes move",
        )
    return warning.fill(name=name)


def _lines(result: Result, *, verbose: bool) -> Iterable[str]:
    verdict = {Verdict.PASSED: "ok", Verdict.FAILED: "FAILED", Verdict.SKIPPED: "-"}
    yield f"  {verdict[result.verdict]:8}{result.name:26}{result.note}".rstrip()
    if verbose or result.verdict is Verdict.FAILED:
        yield f"          {result.demand}"


def _settings(driver: type[Driver], given: Iterable[str]) -> dict[str, SettingValue]:
    """Return settings of the command line, each with the type of its default.

    Raises
    ------
    SettingError
        For what is no KEY=VALUE, no setting of the driver, or not of its type.
    """
    settings: dict[str, SettingValue] = {}
    for text in given:
        name, equals, value = text.partition("=")
        if not equals:
            raise SettingError(
                message("cli", "--set {text}: must be KEY=VALUE").fill(text=repr(text))
            )
        if name not in driver.default_settings:
            known = ", ".join(driver.default_settings) or "none"
            raise SettingError(
                message("cli", "{name}: unknown setting {setting}; available: {known}").fill(
                    name=driver.name, setting=repr(name), known=known
                )
            )
        settings[name] = _typed(name, value, driver.default_settings[name])
    return settings


def _typed(name: str, value: str, default: SettingValue) -> SettingValue:
    try:
        if isinstance(default, bool):
            return _SWITCH[value.lower()]
        return type(default)(value)
    except (KeyError, ValueError) as error:
        kind = "true or false" if isinstance(default, bool) else type(default).__name__
        raise SettingError(
            message("cli", "--set {name}={value}: must be {kind}").fill(
                name=name, value=value, kind=kind
            )
        ) from error
