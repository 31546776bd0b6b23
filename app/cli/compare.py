"""``rotemina compare``: how far the nominal model is from a record of the real machine."""

import argparse
from pathlib import Path

from rotemina.app.cli.files import add_columns, add_robot, robot_of, write_json
from rotemina.sim.comparison.comparison import FITTABLE, Comparison, TapComparison, compare
from rotemina.sim.comparison.figure import drawing_unit, save_figure
from rotemina.sim.records.reading import read_record
from rotemina.sim.units import symbol, to_unit


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "compare",
        help="compare the model with a record of the real machine",
        description="Simulate the nominal model over a record's commands and say, for every "
        "measured tap (u, ref, meas), how far the real machine is from it.",
    )
    parser.add_argument("record", type=Path, metavar="RECORD", help="a record file (.csv, .gz)")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--fit",
        type=lambda text: tuple(name.strip() for name in text.split(",") if name.strip()),
        default=(),
        metavar="NAMES",
        help=f"re-fit these by least squares first: {','.join(FITTABLE)}",
    )
    parser.add_argument("--json", metavar="OUT", help="write the figures as JSON ('-' prints them)")
    parser.add_argument("--plot", type=Path, metavar="OUT", help="draw a picture (.svg .png .pdf)")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Compare, print a table, and write what was asked for."""
    robot = robot_of(options)
    record = read_record(options.record, columns=options.columns, robot=robot)
    comparison = compare(robot, record, fit=options.fit)
    if options.plot is not None:
        save_figure(comparison, options.plot)
    if options.json is not None:
        write_json(comparison.as_json(), options.json)
    if options.json != "-":
        print(table(comparison))
    return 0


def table(comparison: Comparison) -> str:
    """Return the figures as text, one line a tap, in units that read well."""
    head = ("tap", "rms", "peak", "of range", "rel. error", "delay", "noise floor", "re-fitted")
    rows = [head, *(_row(tap) for tap in comparison.taps)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(head))]
    return "\n".join(
        "  ".join(
            cell.ljust(width) if column == 0 else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        for row in rows
    )


def _row(tap: TapComparison) -> tuple[str, ...]:
    def length(value: float | None) -> str:
        if value is None:
            return "–"
        unit = drawing_unit(tap.unit, value)
        return f"{to_unit(value, unit):.4g} {symbol(unit)}"

    def percent(value: float | None) -> str:
        return "–" if value is None else f"{100.0 * value:.4g} %"

    return (
        f"{tap.axis}.{tap.tap}",
        length(tap.rms),
        length(tap.peak),
        percent(tap.share_of_range),
        percent(tap.relative_error),
        "–" if tap.delay_s is None else f"{1e3 * tap.delay_s:.3g} ms",
        length(tap.noise_floor),
        length(tap.rms_refitted),
    )
