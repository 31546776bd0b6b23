"""``rotemina gap bench``: test the diagnosis on machines whose gaps have known causes."""

import argparse
from pathlib import Path

from rotemina.app import bench


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = verbs.add_parser(
        "bench",
        help="diagnose machines with known causes, one line each",
        description="Diagnose machines. Each is a folder with robot.toml, records train_*.csv for"
        " the diagnosis, records test_*.csv that no fit uses, and its known causes in"
        " truth.toml (optional). Print one line each: first cause, sets, how much of "
        "the gap closes on the test records, the remaining error and the figure to "
        "beat, time, verdict.",
    )
    parser.add_argument(
        "folders",
        type=Path,
        nargs="+",
        metavar="FOLDER",
        help="folder of a machine, or of several machines",
    )
    parser.add_argument("--json", metavar="OUT", help="write the results as JSON ('-' prints them)")
    parser.add_argument(
        "--report", type=Path, metavar="OUT.md", help="write a page with all results"
    )
    parser.add_argument("--jobs", type=int, metavar="N", help="parallel processes of a diagnosis")
    parser.add_argument(
        "--longest",
        type=_parse_seconds,
        default=1800.0,
        metavar="S",
        help="time limit for each machine, s (default: 1800)",
    )
    add_other_program(parser)
    parser.set_defaults(run=run)


def add_other_program(parser: argparse.ArgumentParser) -> None:
    """Add the option that names another version of the diagnosis."""
    parser.add_argument(
        "--against",
        type=bench.parse_program,
        metavar="COMMAND",
        help="diagnose each case with this command as well, such as"
        " '/other/.venv/bin/rotemina'; print where the two answers differ, and the processor time"
        " of both",
    )


def _parse_seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0.0 < seconds < 1e7:
        raise argparse.ArgumentTypeError(f"{text!r}: must be a time above 0, in s")
    return seconds


def run(options: argparse.Namespace) -> int:
    """Diagnose the machines one after the other."""
    bench.run_bench(options)
    return 0
