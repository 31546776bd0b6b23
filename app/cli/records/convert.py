"""``rotemina convert``: convert units, sampling or header of a trajectory or record."""

import argparse
from pathlib import Path

from rotemina.app.cli.terminal import (
    add_columns,
    add_robot,
    load_selected_robot,
    print_message,
    print_written_file,
)
from rotemina.app.errors import CommandError
from rotemina.app.language import describe_speed_changes
from rotemina.sim.messages import NumberText, message
from rotemina.sim.records import Record, read_record, resample, write_record
from rotemina.sim.units import parse_unit, si_unit_of


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "convert",
        help="convert a trajectory or record: units, sampling, header",
        description="Read a trajectory or record and write it again: in other units, resampled, "
        "or as plain columns without a header.",
    )
    parser.add_argument("source", type=Path, metavar="IN")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--units",
        type=lambda text: [part.strip() for part in text.split(",") if part.strip()],
        default=[],
        metavar="um,urad",
        help="units of lengths and angles in the output (default: m, rad)",
    )
    parser.add_argument("--no-header", action="store_true", help="write the numbers alone")
    parser.add_argument("--resample", type=float, metavar="HZ", help="resample at this rate")
    parser.add_argument(
        "--method",
        choices=("hold", "linear", "cubic"),
        default="hold",
        help="interpolation between rows (default: hold, as a device does)",
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Convert a file, and print how resampling changes the maximum speeds."""
    if options.output.exists() and options.output.samefile(options.source):
        raise CommandError(
            "{output} is the input file; choose another output with -o", output=options.output
        )
    record = read_record(
        options.source, columns=options.columns, robot=load_selected_robot(options)
    )
    if options.resample is not None:
        converted = resample(record, options.resample, options.method)
        print_message(options, message("cli", "fastest command, before → after resampling:"))
        print(options.wording.format_field(NumberText(describe_speed_changes(record, converted))))
        record = converted
    write_record(
        record,
        options.output,
        units=_choose_axis_units(record, options.units),
        header=not options.no_header,
    )
    print_written_file(options, options.output, len(record.time_s), record.duration_s)
    return 0


def _choose_axis_units(record: Record, names: list[str]) -> dict[str, str]:
    unit_by_si_unit = {si_unit_of(name): parse_unit(name) for name in names}
    for si_unit in unit_by_si_unit:
        if si_unit not in ("m", "rad"):
            raise CommandError(
                "--units {chosen}: a position's unit is a length or an angle",
                chosen=unit_by_si_unit[si_unit],
            )
    return {
        axis: unit_by_si_unit[unit]
        for axis, unit in record.units.items()
        if unit in unit_by_si_unit
    }
