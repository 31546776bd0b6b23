"""``rotemina convert``: read a trajectory or record, and write it in another shape."""

import argparse
from pathlib import Path

from rotemina.app.cli.options import add_columns, add_robot, robot_of, tell, tell_written
from rotemina.app.display_units import speed_changes
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import Number
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.records.resampling import resample
from rotemina.sim.records.writing import write_record
from rotemina.sim.units import canonical, quantity


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
    """Convert one file, and say what resampling does to the speeds."""
    if options.output.exists() and options.output.samefile(options.source):
        raise InputError(
            message("cli", "{output} is the input file; name another by -o").fill(
                output=options.output
            )
        )
    record = read_record(options.source, columns=options.columns, robot=robot_of(options))
    if options.resample is not None:
        converted = resample(record, options.resample, options.method)
        tell(options, message("cli", "fastest command, before → after resampling:"))
        print(options.wording.shown(Number(speed_changes(record, converted))))
        record = converted
    write_record(
        record,
        options.output,
        units=_axis_units(record, options.units),
        header=not options.no_header,
    )
    tell_written(options, options.output, len(record.time_s), record.duration_s)
    return 0


def _axis_units(record: Record, names: list[str]) -> dict[str, str]:
    chosen = {quantity(name): canonical(name) for name in names}
    for kind in chosen:
        if kind not in ("m", "rad"):
            raise InputError(
                message("cli", "--units {chosen}: a position's unit is a length or an angle").fill(
                    chosen=chosen[kind]
                )
            )
    return {axis: chosen[unit] for axis, unit in record.units.items() if unit in chosen}
