"""``rotemina calibrate``: the axes' own sensors against a laser."""

import argparse
import tomllib
from datetime import datetime
from pathlib import Path

from platformdirs import user_config_path

from rotemina.app.calibration.files import FORMAT, CalibrationFile, Source, kept, source_of
from rotemina.app.calibration.store import CalibrationStore
from rotemina.app.calibration.words import (
    as_json,
    figure_lines,
    iso_lines,
    iso_rows,
    remark_lines,
    summary,
)
from rotemina.app.cli.options import (
    add_columns,
    add_robot,
    records_of_model,
    robot_of,
    tell,
    tell_model,
)
from rotemina.app.files import json_text
from rotemina.app.motion.player import play_offline
from rotemina.sim.calibration.comparable_parts import compared
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.calibration.laser_join import joined
from rotemina.sim.calibration.plan import RATE_HZ, RUNS, TARGETS, calibration_motion
from rotemina.sim.calibration.sensor_calibration import Calibration, Figure, calibrated
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.model import Robot


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand and its own subcommands."""
    parser = commands.add_parser(
        "calibrate",
        help="calibrate the sensor of an axis against a laser",
        description='Calibrate the sensor of an axis against a laser: "plan" writes the motion, '
        '"fit" makes a calibration from records with meas and ref of the axis, "run" '
        'does both on the simulator, "show" prints a calibration, "list" prints the '
        "stored ones.",
    )
    own = parser.add_subparsers(title="subcommands", metavar="", required=True)
    _add_plan(own)
    _add_fit(own)
    _add_run(own)
    show = own.add_parser("show", help="print what a calibration holds")
    show.add_argument("calibration", type=Path, metavar="FILE")
    _add_json(show)
    show.set_defaults(run=_show)
    listing = own.add_parser("list", help="list the stored calibrations of a robot")
    add_robot(listing, default="rotemina")
    _add_folder(listing)
    _add_json(listing)
    listing.set_defaults(run=_list)


def _add_plan(own: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    plan = own.add_parser("plan", help="write the motion that shows the errors of a sensor")
    _add_axis(plan)
    _add_motion(plan)
    plan.add_argument("-o", "--output", type=Path, required=True, metavar="FILE")
    plan.set_defaults(run=_plan)


def _add_fit(own: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    fit = own.add_parser("fit", help="make a calibration from records")
    fit.add_argument("records", type=Path, nargs="+", metavar="RECORD")
    _add_axis(fit)
    add_columns(fit)
    fit.add_argument(
        "--laser",
        type=Path,
        action="append",
        default=[],
        metavar="FILE",
        help="record of the laser itself, one for each RECORD; the motion matches their clocks",
    )
    _add_result(fit)
    fit.set_defaults(run=_fit)


def _add_run(own: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    run = own.add_parser(
        "run", help="calibrate on the simulator, with the effects of the robot file"
    )
    _add_axis(run)
    _add_motion(run)
    run.add_argument("--noise", type=int, default=0, metavar="N", help="seed of the noise")
    run.add_argument("--record", type=Path, metavar="FILE", help="write the record as well")
    _add_result(run)
    run.set_defaults(run=_run)


def _add_axis(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--axis", required=True, metavar="NAME")
    add_robot(parser, default="rotemina")


def _add_motion(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--runs",
        type=int,
        default=RUNS,
        metavar="N",
        help="runs of the motion (default: %(default)s)",
    )
    parser.add_argument(
        "--targets",
        type=int,
        default=TARGETS,
        metavar="N",
        help="target positions of a stepper axis (default: %(default)s)",
    )
    parser.add_argument(
        "--rate",
        type=float,
        default=RATE_HZ,
        metavar="HZ",
        help="rows per second (default: %(default)g)",
    )
    parser.add_argument(
        "--seed", type=int, default=0, metavar="N", help="seed of the target positions"
    )


def _add_result(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--keep-zero",
        action="store_true",
        help="the laser's zero is arbitrary: keep the reading at mid-travel",
    )
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE", help="write the calibration to this file"
    )
    parser.add_argument(
        "--store", action="store_true", help="keep the calibration in the user's folder"
    )
    _add_folder(parser)
    _add_json(parser)


def _add_folder(parser: argparse.ArgumentParser) -> None:
    folder = user_config_path("rotemina", appauthor=False)
    parser.add_argument(
        "--folder",
        type=Path,
        default=folder,
        metavar="DIR",
        help="folder of the calibrations (default: the user's own)",
    )


def _add_json(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="print JSON in SI units")


def _motion(robot: Robot, options: argparse.Namespace) -> Record:
    return calibration_motion(
        robot,
        options.axis,
        runs=options.runs,
        targets=options.targets,
        rate_hz=options.rate,
        seed=options.seed,
    )


def _plan(options: argparse.Namespace) -> int:
    robot = robot_of(options)
    motion = _motion(robot, options)
    write_record(motion, options.output)
    tell_model(options, robot.name)
    said = message("cli", "{output}: {motion}, {duration}").fill(
        output=options.output,
        motion=motion.metadata["calibration"],
        duration=exact(motion.duration_s, "s"),
    )
    tell(options, said)
    return 0


def _fit(options: argparse.Namespace) -> int:
    robot = robot_of(options)
    records = records_of_model(options, robot, options.records)
    names = [path.name for path in options.records]
    if options.laser:
        if len(options.laser) != len(records):
            raise CalibrationError(
                message(
                    "cli", "--laser: {count} files for {records} records; give one for each"
                ).fill(count=len(options.laser), records=len(records))
            )
        lasers = [read_record(path, robot=robot) for path in options.laser]
        records = [
            joined(record, laser, options.axis)
            for record, laser in zip(records, lasers, strict=True)
        ]
    compare = [
        compared(record, options.axis, robot, name)
        for record, name in zip(records, names, strict=True)
    ]
    found = calibrated(robot, compare, lags=not options.laser, absolute=not options.keep_zero)
    sources = tuple(map(source_of, records, names))
    return _tell(found, robot, sources, options)


def _run(options: argparse.Namespace) -> int:
    robot = robot_of(options)
    record = play_offline(robot, _motion(robot, options), seed=options.noise, laser=True)
    name = "simulator"
    if options.record is not None:
        write_record(record, options.record)
        name = options.record.name
    found = calibrated(
        robot, [compared(record, options.axis, robot, name)], absolute=not options.keep_zero
    )
    return _tell(found, robot, (source_of(record, name),), options)


def _tell(
    found: Calibration, robot: Robot, sources: tuple[Source, ...], options: argparse.Namespace
) -> int:
    """Print a calibration, and keep it where that was asked; a refused one replaces nothing."""
    answer = as_json(found)
    lines = [summary(found, options.wording)]
    if options.out is not None or options.store:
        calibration = kept(found, robot.name, sources, datetime.now().astimezone())
        written = _written(calibration, robot, options)
        answer["written"] = [str(path) for path in written]
        said = message("cli", "{file}: written")
        lines += [options.wording.of(said.fill(file=path)) for path in written]
    tell_model(options, robot.name)
    print(json_text(answer) if options.json else "\n".join(lines))
    return 0


def _written(calibration: CalibrationFile, robot: Robot, options: argparse.Namespace) -> list[Path]:
    written = []
    if options.out is not None:
        FORMAT.save(options.out, calibration)
        written.append(options.out)
    if options.store:
        store = CalibrationStore(options.folder, robot)
        written.append(store.save(calibration))
        store.switch(calibration.axis, written[-1])
    return written


def _show(options: argparse.Namespace) -> int:
    one = FORMAT.load(options.calibration)
    if options.json:
        print(json_text({"name": one.name, **tomllib.loads(FORMAT.text(one))}))
        return 0
    said = message("cli", "{name}: axis {axis} of robot {robot}, {runs} runs")
    tell(options, said.fill(name=one.name, axis=one.axis, robot=one.robot, runs=one.runs))
    figures = [
        Figure(
            each.name,
            each.value,
            float("nan") if each.half_width is None else each.half_width,
            each.unit,
        )
        for each in one.figures
    ]
    iso = (one.iso_reading_before, one.iso_reading_after, one.iso_reached)
    rows = iso_rows(*(each.figures if each is not None else None for each in iso), one.unit)
    source = message("cli", "from {name} ({digest})")
    lines = [
        *figure_lines(figures, options.wording),
        *iso_lines(rows, options.wording),
        *(
            f"  {options.wording.of(source.fill(name=each.name, digest=each.digest))}"
            for each in one.sources
        ),
        *remark_lines(one.notes, None, options.wording),
    ]
    print("\n".join(lines))
    return 0


def _list(options: argparse.Namespace) -> int:
    stored, problems = CalibrationStore(options.folder, robot_of(options)).listed()
    if options.json:
        rows = [
            {
                "file": str(one.path),
                "axis": one.calibration.axis,
                "name": one.calibration.name,
                "on": one.on,
            }
            for one in stored
        ]
        print(json_text({"calibrations": rows, "problems": list(problems)}))
        return 0
    for one in stored:
        state = options.wording.of(message("cli", "on") if one.on else message("cli", "off"))
        print(f"{one.calibration.axis:8}{one.calibration.name}  {state:4}{one.path}")
    for problem in problems:
        tell(options, message("cli", "left out: {reason}").fill(reason=problem))
    if not stored:
        tell(options, message("cli", "no calibrations are stored"))
    return 0
