"""``rotemina gap bench``: the diagnosis of machines whose causes are known."""

import argparse
from pathlib import Path


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = verbs.add_parser(
        "bench",
        help="diagnose machines whose causes are known, one line each",
        description="Diagnose machines, each a folder with robot.toml, records train_*.csv that "
        "are diagnosed and test_*.csv that no fit sees, and what is known of it in truth.toml "
        "(optional). Print a line each: first cause, sets, how much of the gap closes on the test "
        "records, what is left beside the figure to beat, time, verdict.",
    )
    parser.add_argument(
        "folders",
        type=Path,
        nargs="+",
        metavar="FOLDER",
        help="of a machine, or of folders of machines",
    )
    parser.add_argument("--json", metavar="OUT", help="write the results as JSON ('-' prints them)")
    parser.add_argument("--report", type=Path, metavar="OUT.md", help="write a page")
    parser.add_argument("--jobs", type=int, metavar="N", help="how many processes a diagnosis uses")
    parser.add_argument(
        "--longest",
        type=_seconds,
        default=1800.0,
        metavar="S",
        help="time after which a machine is given up, s (default: 1800)",
    )
    parser.set_defaults(run=run)


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0.0 < seconds < 1e7:
        raise argparse.ArgumentTypeError(f"{text!r}: must be a time above 0, in s")
    return seconds


def run(options: argparse.Namespace) -> int:
    """Diagnose machine by machine."""
    from rotemina.app.bench.run import run_bench  # takes its time to import

    run_bench(options)
    return 0
