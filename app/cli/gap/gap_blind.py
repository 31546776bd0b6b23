"""``rotemina gap blind``: run and score the sealed self-test of the diagnosis."""

import argparse
from pathlib import Path

from rotemina.app import blind
from rotemina.app.cli.gap.gap_bench import add_other_program
from rotemina.app.cli.terminal import add_robot


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = verbs.add_parser(
        "blind",
        help="run the sealed self-test of the diagnosis and score it",
        description="Make cases by equations that the diagnosis does not know, seal their labels,"
        " and diagnose each in a process that sees only records; then open the labels"
        " and score the answers. A second start continues where the first one ended.",
    )
    parser.add_argument("--cases", type=int, metavar="N", help="number of cases (default: 300)")
    parser.add_argument(
        "--seed", type=int, default=0, metavar="N", help="seed of the cases (default: 0)"
    )
    parser.add_argument(
        "--generator",
        choices=("first", "second"),
        default="first",
        help="equations that make the cases (default: first); each gives its own figures",
    )
    parser.add_argument(
        "--shard",
        type=parse_shard,
        default="1/1",
        metavar="I/N",
        help="run every N-th case, beginning with the I-th",
    )
    parser.add_argument(
        "--from", dest="source", type=Path, metavar="DIR", help="folder of your own cases"
    )
    parser.add_argument("--labels", type=Path, metavar="FILE", help="their labels, as JSON")
    parser.add_argument(
        "--folder",
        type=Path,
        metavar="DIR",
        help="folder for the results, one file per case (default: rotemina-blind-SEED in "
        "this folder)",
    )
    parser.add_argument("--json", metavar="OUT", help="write the figures as JSON ('-' prints them)")
    parser.add_argument(
        "--report",
        type=Path,
        metavar="OUT.md",
        help="write a page, with its picture next to it (seeds from 1000 on)",
    )
    parser.add_argument(
        "--calibrate",
        type=Path,
        metavar="FILE",
        help="write the calibration of probabilities, as JSON (seeds below 1000)",
    )
    parser.add_argument(
        "--beside",
        type=Path,
        metavar="DIR",
        action="append",
        default=[],
        help="count the results of this folder as well in the calibration, such as those of the "
        "other generator; may be repeated",
    )
    parser.add_argument("--jobs", type=int, metavar="N", help="parallel processes of a diagnosis")
    parser.add_argument(
        "--score", action="store_true", help="score the finished cases, and diagnose no others"
    )
    parser.add_argument(
        "--naive",
        action="store_true",
        help="let three naive methods answer the same cases, for comparison (takes longer)",
    )
    add_other_program(parser)
    add_robot(parser)
    parser.set_defaults(run=run)


def parse_shard(text: str) -> "blind.CaseShard":
    """Parse a shard ``I/N``."""
    index, slash, number = text.partition("/")
    if not (slash and index.isdecimal() and number.isdecimal() and 1 <= int(index) <= int(number)):
        raise argparse.ArgumentTypeError(f"{text!r}: must be I/N with 1 ≤ I ≤ N, such as 2/4")
    return blind.CaseShard(int(index), int(number))


def run(options: argparse.Namespace) -> int:
    """Run the unfinished cases, then score all cases."""
    blind.run_self_test(options)
    return 0
