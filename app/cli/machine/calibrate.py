"""``rotemina calibrate``: calibrate the sensors of the axes with a laser."""

import argparse
import tomllib
from datetime import datetime
from pathlib import Path

from platformdirs import user_config_path

from rotemina.app.calibration import (
    CALIBRATION_FORMAT,
    CalibrationFile,
    CalibrationStore,
    SourceRecord,
    format_figure_lines,
    format_iso_lines,
    format_remark_lines,
    format_summary,
    make_calibration_file,
    make_iso_rows,
    make_source_record,
    to_json,
)
from rotemina.app.cli.terminal import (
    add_columns,
    add_robot,
    load_selected_robot,
    print_message,
    print_model,
    read_records_of_model,
)
from rotemina.app.motion import playback
from rotemina.app.settings import format_json
from rotemina.sim import calibration as sensor_calibration
from rotemina.sim.calibration import (
    DEFAULT_RATE_HZ,
    DEFAULT_RUNS,
    DEFAULT_TARGETS,
    SensorCalibration,
    SensorFigureEstimate,
    calibrate_sensor,
    compare_with_laser,
    make_calibration_motion,
)
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.messages import message
from rotemina.sim.records import Record, read_record, write_record
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact


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
    verbs = parser.add_subparsers(title="subcommands", metavar="", required=True)
    _add_plan(verbs)
    _add_fit(verbs)
    _add_run(verbs)
    show = verbs.add_parser("show", help="print the contents of a calibration")
    show.add_argument("calibration", type=Path, metavar="FILE")
    _add_json(show)
    show.set_defaults(run=_show_calibration)
    listing = verbs.add_parser("list", help="list the stored calibrations of a robot")
    add_robot(listing, default="rotemina")
    _add_folder(listing)
    _add_json(listing)
    listing.set_defaults(run=_list_calibrations)


def _add_plan(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    plan = verbs.add_parser("plan", help="write the motion that shows the errors of a sensor")
    _add_axis(plan)
    _add_motion(plan)
    plan.add_argument("-o", "--output", type=Path, required=True, metavar="FILE")
    plan.set_defaults(run=_write_plan)


def _add_fit(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    fit = verbs.add_parser("fit", help="make a calibration from records")
    fit.add_argument("records", type=Path, nargs="+", metavar="RECORD")
    _add_axis(fit)
    add_columns(fit)
    fit.add_argument(
        "--laser",
        type=Path,
        action="append",
        default=[],
        metavar="FILE",
        help="separate record of the laser, one for each RECORD; the motion aligns their clocks",
    )
    _add_result(fit)
    fit.set_defaults(run=_fit_calibration)


def _add_run(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    run = verbs.add_parser(
        "run", help="calibrate on the simulator, with the effects of the robot file"
    )
    _add_axis(run)
    _add_motion(run)
    run.add_argument("--noise", type=int, default=0, metavar="N", help="seed of the noise")
    run.add_argument("--record", type=Path, metavar="FILE", help="write the record as well")
    _add_result(run)
    run.set_defaults(run=_run_calibration)


def _add_axis(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--axis", required=True, metavar="NAME")
    add_robot(parser, default="rotemina")


def _add_motion(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--runs",
        type=int,
        default=DEFAULT_RUNS,
        metavar="N",
        help="runs of the motion (default: %(default)s)",
    )
    parser.add_argument(
        "--targets",
        type=int,
        default=DEFAULT_TARGETS,
        metavar="N",
        help="target positions of a stepper axis (default: %(default)s)",
    )
    parser.add_argument(
        "--rate",
        type=float,
        default=DEFAULT_RATE_HZ,
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


def _make_motion(robot: Robot, options: argparse.Namespace) -> Record:
    return make_calibration_motion(
        robot,
        options.axis,
        runs=options.runs,
        targets=options.targets,
        rate_hz=options.rate,
        seed=options.seed,
    )


def _write_plan(options: argparse.Namespace) -> int:
    robot = load_selected_robot(options)
    motion = _make_motion(robot, options)
    write_record(motion, options.output)
    print_model(options, robot.name)
    text = message("cli", "{output}: {motion}, {duration}").fill(
        output=options.output,
        motion=motion.metadata["calibration"],
        duration=format_exact(motion.duration_s, "s"),
    )
    print_message(options, text)
    return 0


def _fit_calibration(options: argparse.Namespace) -> int:
    robot = load_selected_robot(options)
    records = read_records_of_model(options, robot, options.records)
    names = [path.name for path in options.records]
    if options.laser:
        if len(options.laser) != len(records):
            raise SensorCalibrationError(
                message(
                    "cli", "--laser: {count} files for {records} records; give one for each"
                ).fill(count=len(options.laser), records=len(records))
            )
        lasers = [read_record(path, robot=robot) for path in options.laser]
        records = [
            sensor_calibration.join_laser_record(record, laser, options.axis)
            for record, laser in zip(records, lasers, strict=True)
        ]
    comparisons = [
        compare_with_laser(record, options.axis, robot, name)
        for record, name in zip(records, names, strict=True)
    ]
    calibration = calibrate_sensor(
        robot, comparisons, has_common_clock=not options.laser, absolute=not options.keep_zero
    )
    sources = tuple(map(make_source_record, records, names))
    return _print_calibration(calibration, robot, sources, options)


def _run_calibration(options: argparse.Namespace) -> int:
    robot = load_selected_robot(options)
    record = playback.play_offline(
        robot, _make_motion(robot, options), seed=options.noise, laser=True
    )
    name = "simulator"
    if options.record is not None:
        write_record(record, options.record)
        name = options.record.name
    calibration = calibrate_sensor(
        robot,
        [compare_with_laser(record, options.axis, robot, name)],
        absolute=not options.keep_zero,
    )
    return _print_calibration(calibration, robot, (make_source_record(record, name),), options)


def _print_calibration(
    calibration: SensorCalibration,
    robot: Robot,
    sources: tuple[SourceRecord, ...],
    options: argparse.Namespace,
) -> int:
    """Print a calibration, and write it if requested.

    If the calibration may not be stored, an error is raised before anything is written or printed.
    """
    document = to_json(calibration)
    lines = [format_summary(calibration, options.wording)]
    if options.out is not None or options.store:
        file = make_calibration_file(calibration, robot.name, sources, datetime.now().astimezone())
        paths = _write_calibration(file, robot, options)
        document["written"] = [str(path) for path in paths]
        text = message("cli", "{file}: written")
        lines += [options.wording.format_message(text.fill(file=path)) for path in paths]
    print_model(options, robot.name)
    print(format_json(document) if options.json else "\n".join(lines))
    return 0


def _write_calibration(
    calibration: CalibrationFile, robot: Robot, options: argparse.Namespace
) -> list[Path]:
    paths = []
    if options.out is not None:
        CALIBRATION_FORMAT.save(options.out, calibration)
        paths.append(options.out)
    if options.store:
        store = CalibrationStore(options.folder, robot)
        paths.append(store.save(calibration))
        store.select(calibration.axis, paths[-1])
    return paths


def _show_calibration(options: argparse.Namespace) -> int:
    calibration = CALIBRATION_FORMAT.load(options.calibration)
    if options.json:
        print(
            format_json(
                {"name": calibration.name, **tomllib.loads(CALIBRATION_FORMAT.to_toml(calibration))}
            )
        )
        return 0
    title = message("cli", "{name}: axis {axis} of robot {robot}, {runs} runs")
    print_message(
        options,
        title.fill(
            name=calibration.name,
            axis=calibration.axis,
            robot=calibration.robot,
            runs=calibration.runs,
        ),
    )
    figures = [
        SensorFigureEstimate(
            figure.name,
            figure.value,
            float("nan") if figure.half_width is None else figure.half_width,
            figure.unit,
        )
        for figure in calibration.figures
    ]
    iso_results = (
        calibration.iso_reading_before,
        calibration.iso_reading_after,
        calibration.iso_reached,
    )
    rows = make_iso_rows(
        *(result.positioning if result is not None else None for result in iso_results),
        calibration.unit,
    )
    origin = message("cli", "from {name} ({digest})")
    lines = [
        *format_figure_lines(figures, options.wording),
        *format_iso_lines(rows, options.wording),
        *(
            "  "
            + options.wording.format_message(origin.fill(name=source.name, digest=source.digest))
            for source in calibration.sources
        ),
        *format_remark_lines(calibration.notes, None, options.wording),
    ]
    print("\n".join(lines))
    return 0


def _list_calibrations(options: argparse.Namespace) -> int:
    stored, problems = CalibrationStore(
        options.folder, load_selected_robot(options)
    ).list_calibrations()
    if options.json:
        rows = [
            {
                "file": str(entry.path),
                "axis": entry.calibration.axis,
                "name": entry.calibration.name,
                "on": entry.on,
            }
            for entry in stored
        ]
        print(format_json({"calibrations": rows, "problems": list(problems)}))
        return 0
    for entry in stored:
        state = options.wording.format_message(
            message("cli", "on") if entry.on else message("cli", "off")
        )
        print(f"{entry.calibration.axis:8}{entry.calibration.name}  {state:4}{entry.path}")
    for problem in problems:
        print_message(options, message("cli", "left out: {reason}").fill(reason=problem))
    if not stored:
        print_message(options, message("cli", "no calibrations are stored"))
    return 0
