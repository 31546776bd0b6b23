"""``rotemina driver``: which drivers are installed, and whether they keep the contract."""

import argparse
from collections.abc import Iterable

from rotemina.app.cli.options import add_robot, robot_of
from rotemina.drivers import abilities
from rotemina.drivers.conformance.bench import bench_of
from rotemina.drivers.conformance.check import Result, Verdict
from rotemina.drivers.conformance.suite import checks_named, run_checks
from rotemina.drivers.driver import Driver
from rotemina.drivers.registry import discover_drivers, driver_named
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.sim.messages import message

_FAILED = 1
_SWITCH = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "driver",
        help="list drivers, and check whether they keep the contract",
        description="The drivers that are installed, ours and those of plugins.",
    )
    parser.set_defaults(run=_list)
    verbs = parser.add_subparsers(title="subcommands", metavar="")
    listing = verbs.add_parser("list", help="one line for each driver (this without a subcommand)")
    listing.set_defaults(run=_list)
    checking = verbs.add_parser(
        "check",
        help="put a driver to the checks of the contract",
        description="Open a driver and measure whether it does what the contract demands. With a "
        "real device only what moves nothing is checked, unless --move is given. Exit status: "
        "0 all passed, 1 a check failed.",
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
        "--only", action="append", default=[], metavar="CHECK", help="this check (may be repeated)"
    )
    checking.add_argument("--move", action="store_true", help="let the axes of a real device move")
    checking.add_argument("--verbose", action="store_true", help="what each check demands as well")
    checking.set_defaults(run=_check)


def _list(_options: argparse.Namespace) -> int:
    """Print a line for each driver, what it can do, and what could not be loaded."""
    discovery = discover_drivers()
    for name, driver in discovery.found.items():
        clock = "any clock" if driver.virtual_time else "real time"
        print(f"{name:16}{clock:12}{', '.join(_abilities(driver)) or 'moves'}")
    for name, reason in discovery.broken.items():
        print(f"left out: {name}: {reason}")
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
        print(_warning(options.name, may_move), flush=True)
    results = []
    for result in run_checks(bench_of(driver, robot, settings), checks, may_move=may_move):
        results.append(result)
        print("\n".join(_lines(result, verbose=options.verbose)), flush=True)
    counts = ((sum(one.verdict is each for one in results), each) for each in Verdict)
    print(f"{options.name} on {robot.name}: {', '.join(f'{n} {each}' for n, each in counts)}")
    return _FAILED if any(one.verdict is Verdict.FAILED for one in results) else 0


def _warning(name: str, may_move: bool) -> str:
    if may_move:
        return (
            f"{name} runs in real time: ALL AXES ARE GOING TO MOVE, to ends of their ranges too. "
            "Take the tool off; the machine's emergency switch must be in reach."
        )
    return f"{name} runs in real time: only what moves no axis is checked; --move lets axes move"


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
            known = ", ".join(driver.default_settings) or "none at all"
            raise SettingError(
                message("cli", "{name}: unknown setting {setting}; it knows {known}").fill(
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
