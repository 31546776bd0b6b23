"""``rotemina recording``: inspect, recover and export recordings of sessions."""

import argparse
import webbrowser
from pathlib import Path

from rotemina.app.cli.terminal import (
    add_columns,
    add_robot,
    load_selected_robot,
    print_message,
    print_model,
    read_records_of_model,
)
from rotemina.app.errors import CommandError
from rotemina.app.settings import write_text
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.records import write_record
from rotemina.sim.trajectory import DEFAULT_SETPOINT_PERIOD_S
from rotemina.sim.units import make_scale

_PRINTED_METADATA = ("began", "program", "robot", "robot_sha256", "driver", "driver_settings")
_OPTIONAL_METADATA = ("model", "effects", "run", "operator", "sample")


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "recording",
        help="inspect recordings of sessions, recover and export them",
        description="Inspect recordings of sessions, recover them after a crash, and export parts"
        " of them as records or as trajectories that can be played.",
    )
    verbs = parser.add_subparsers(metavar="", required=True)

    info_parser = verbs.add_parser("info", help="print the contents of a recording")
    info_parser.add_argument("recording", type=Path, metavar="FILE")
    info_parser.add_argument("--events", action="store_true", help="list the events as well")
    info_parser.add_argument(
        "--robot-file", action="store_true", help="print only the robot file of the recording"
    )
    info_parser.set_defaults(run=print_info)

    recover_parser = verbs.add_parser("recover", help="complete recordings after a crash")
    recover_parser.add_argument("source", type=Path, metavar="FILE_OR_FOLDER")
    recover_parser.set_defaults(run=recover_recordings)

    export_parser = verbs.add_parser("export", help="write a part as a record, or as a trajectory")
    export_parser.add_argument("recording", type=Path, metavar="FILE")
    export_parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT")
    export_parser.add_argument(
        "--from", type=float, default=0.0, dest="begin", metavar="S",
        help="start of the part, in seconds from the start of the recording",
    )  # fmt: skip
    export_parser.add_argument(
        "--to", type=float, default=float("inf"), dest="end", metavar="S",
        help="end of the part, in seconds from the start of the recording",
    )  # fmt: skip
    export_parser.add_argument(
        "--trajectory", action="store_true",
        help="write the commands of the axes that moved as a checked trajectory",
    )  # fmt: skip
    export_parser.add_argument(
        "--period", type=float, default=DEFAULT_SETPOINT_PERIOD_S, metavar="S",
        help="period of the trajectory's rows (default: %(default)g s)",
    )  # fmt: skip
    export_parser.add_argument(
        "--reference", metavar="AXIS",
        help="write a record in which the position of this axis (x, y, thx, thy) in the "
"microscope's picture is the reference, for 'rotemina gap diagnose'",
    )  # fmt: skip
    export_parser.set_defaults(run=export_part)

    report_parser = verbs.add_parser(
        "report", help="write the run report of a recording or a playback"
    )
    report_parser.add_argument(
        "record", type=Path, metavar="FILE", help="*.arrows, or a text record"
    )
    report_parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT.html")
    add_robot(report_parser)
    add_columns(report_parser)
    report_parser.add_argument("--open", action="store_true", help="open it in the browser")
    report_parser.set_defaults(run=write_report)


def print_info(options: argparse.Namespace) -> int:
    """Print the contents of a recording."""
    # Arrow is slow to import, and the help does not need it.
    from rotemina.app.motion.recording import Recording

    recording = Recording.open(options.recording)
    metadata = recording.metadata
    if options.robot_file:
        print(metadata.get("robot_file", ""), end="")
        return 0
    duration = make_scale("s", decimals=3).format_with_unit(recording.ended_s - recording.began_s)
    print(f"{options.recording}: {options.wording.format_field(duration)}")
    for key in _PRINTED_METADATA:
        print(f"  {key:16s}{metadata.get(key, '')}")
    for key in _OPTIONAL_METADATA:
        if metadata.get(key):
            print(f"  {key:16s}{metadata[key]}")
    template = message("cli", "{count} of {names}")
    sample_text = template.fill(count=recording.count, names=", ".join(recording.axes))
    print(f"  {'samples':16s}{options.wording.format_message(sample_text)}")
    for name in recording.channels:
        columns = recording.read_channel(name)
        rows = len(columns.pop("host_time_s"))
        template = message("cli", "{name}: {rows} rows of {columns}")
        channel_text = template.fill(name=name, rows=rows, columns=", ".join(columns))
        print(f"  {'channel':16s}{options.wording.format_message(channel_text)}")
    events = recording.read_events()
    print(f"  {'events':16s}{len(events)}")
    for event in events if options.events else ():
        print(f"  {event.host_time_s - recording.began_s:12.6f} {event.kind:14s} {event.text}")
    return 0


def recover_recordings(options: argparse.Namespace) -> int:
    """Complete a recording, or all recordings in a folder."""
    from rotemina.app.motion.recording import recovery

    source = options.source
    paths = recovery.find_unfinished(source) if source.is_dir() else (source,)
    if not paths:
        print_message(options, message("cli", "{source}: nothing to recover").fill(source=source))
    error_texts = []
    for path in paths:
        try:
            print(recovery.recover_recording(path))
        except InputError as error:
            # A recording that is still running must not prevent the recovery of the others.
            error_texts.append(str(error))
    if error_texts:
        raise InputError("\n".join(error_texts))
    return 0


def export_part(options: argparse.Namespace) -> int:
    """Write a part of a recording as a record or a trajectory."""
    from rotemina.app.motion.recording import Recording, exporting

    if not 0.0 <= options.begin < options.end:
        raise CommandError(
            "--from {begin} --to {end}: must be 0 or more, and in order",
            begin=options.begin,
            end=options.end,
        )
    if options.trajectory and options.reference is not None:
        raise CommandError("--trajectory and --reference: choose one of them")
    if not options.period > 0.0:
        raise CommandError("--period {period}: must be more than 0 s", period=options.period)
    _require_different_file(options.output, options.recording)
    recording = Recording.open(options.recording)
    begin_s, end_s = (recording.began_s + offset_s for offset_s in (options.begin, options.end))
    if options.trajectory:
        commands = exporting.make_trajectory(recording, begin_s, end_s, options.period).commands
        write_record(commands, options.output)
        rows = len(commands.time_s)
    elif options.reference is not None:
        from rotemina.app.microscope import make_reference_record

        reference_record = make_reference_record(recording, options.reference, begin_s, end_s)
        write_record(reference_record, options.output)
        rows = len(reference_record.time_s)
    else:
        rows = exporting.export_record(recording, options.output, begin_s, end_s)
    text = message("cli", "{output}: {rows} rows")
    print_message(options, text.fill(output=options.output, rows=rows))
    return 0


def write_report(options: argparse.Namespace) -> int:
    """Write the run report of a recording, or of a text record that is compared with the model."""
    from platformdirs import user_data_path

    from rotemina.app.motion.penetration import RunLog
    from rotemina.app.motion.playback import ComparedRun
    from rotemina.app.motion.recording import RECORDING_SUFFIX
    from rotemina.app.records import RecordStore, RunReport, render_report
    from rotemina.sim.comparison import compare

    path, data_folder = options.record.absolute(), user_data_path("rotemina", appauthor=False)
    _require_different_file(options.output, path)
    entry = next(
        (stored for stored in RecordStore(data_folder).read_all() if stored.path == path), None
    )
    if path.suffix == RECORDING_SUFFIX:
        log = RunLog(data_folder / "penetrations.jsonl")
        penetrations = log.read()[0] if Path(log.path).exists() else ()
        run_report = RunReport.from_recording(path, entry, penetrations)
    else:
        robot = load_selected_robot(options)
        (record,) = read_records_of_model(options, robot, [path])
        print_model(options, robot.name)
        run_report = RunReport.from_run(
            ComparedRun(path.name, compare(robot, record)), robot, entry
        )
    write_text(options.output, render_report(run_report, options.wording))
    print(options.output)
    if options.open:
        webbrowser.open(options.output.absolute().as_uri())
    return 0


def _require_different_file(output: Path, source: Path) -> None:
    if output.exists() and output.samefile(source):
        raise CommandError(
            "{output} is the input file; choose another output with -o", output=output
        )
