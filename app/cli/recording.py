"""``rotemina recording``: inspect, recover and export recordings of sessions."""

import argparse
import webbrowser
from pathlib import Path

from rotemina.app.cli.options import (
    add_columns,
    add_robot,
    records_of_model,
    robot_of,
    tell,
    tell_model,
)
from rotemina.app.files import write_text
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import scale_in
from rotemina.sim.records.writing import write_record
from rotemina.sim.trajectory.speed_and_acceleration import SETPOINT_PERIOD_S

_TOLD = ("began", "program", "robot", "robot_sha256", "driver", "driver_settings")
_TOLD_IF_GIVEN = ("model", "effects", "run", "operator", "sample")


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand and what it does."""
    parser = commands.add_parser(
        "recording",
        help="inspect recordings of sessions, recover and export them",
        description="Inspect recordings of sessions, recover them after a crash, and export parts"
        " of them as records or as trajectories that can be played.",
    )
    does = parser.add_subparsers(metavar="", required=True)

    one = does.add_parser("info", help="print what a recording holds")
    one.add_argument("recording", type=Path, metavar="FILE")
    one.add_argument("--events", action="store_true", help="list the events as well")
    one.add_argument(
        "--robot-file", action="store_true", help="print only the robot file of the recording"
    )
    one.set_defaults(run=info)

    one = does.add_parser("recover", help="complete recordings after a crash")
    one.add_argument("source", type=Path, metavar="FILE_OR_FOLDER")
    one.set_defaults(run=recover)

    one = does.add_parser("export", help="write a part as a record, or as a trajectory")
    one.add_argument("recording", type=Path, metavar="FILE")
    one.add_argument("-o", "--output", type=Path, required=True, metavar="OUT")
    one.add_argument(
        "--from", type=float, default=0.0, dest="begin", metavar="S",
        help="start of the part, in seconds from the start of the recording",
    )  # fmt: skip
    one.add_argument(
        "--to", type=float, default=float("inf"), dest="end", metavar="S",
        help="end of the part, in seconds from the start of the recording",
    )  # fmt: skip
    one.add_argument(
        "--trajectory", action="store_true",
        help="write the commands of the axes that moved as a checked trajectory",
    )  # fmt: skip
    one.add_argument(
        "--period", type=float, default=SETPOINT_PERIOD_S, metavar="S",
        help="period of the trajectory's rows (default: %(default)g s)",
    )  # fmt: skip
    one.add_argument(
        "--reference", metavar="AXIS",
        help="write a record in which the position of this axis (x, y, thx, thy) in the "
"microscope's picture is the reference, for 'rotemina gap diagnose'",
    )  # fmt: skip
    one.set_defaults(run=export)

    one = does.add_parser("report", help="write the run report of a recording or a playback")
    one.add_argument("record", type=Path, metavar="FILE", help="*.arrows, or a text record")
    one.add_argument("-o", "--output", type=Path, required=True, metavar="OUT.html")
    add_robot(one)
    add_columns(one)
    one.add_argument("--open", action="store_true", help="open it in the browser")
    one.set_defaults(run=report)


def info(options: argparse.Namespace) -> int:
    """Print what a recording holds."""
    from rotemina.app.motion.recording.recording_reader import (
        Recording,  # Arrow takes its time to import
    )

    recording = Recording.open(options.recording)
    about = recording.metadata
    if options.robot_file:
        print(about.get("robot_file", ""), end="")
        return 0
    duration = scale_in("s", decimals=3).text(recording.ended_s - recording.began_s)
    print(f"{options.recording}: {options.wording.shown(duration)}")
    for key in _TOLD:
        print(f"  {key:16s}{about.get(key, '')}")
    for key in _TOLD_IF_GIVEN:
        if about.get(key):
            print(f"  {key:16s}{about[key]}")
    said = message("cli", "{count} of {names}")
    samples = said.fill(count=recording.count, names=", ".join(recording.axes))
    print(f"  {'samples':16s}{options.wording.of(samples)}")
    for name in recording.channels:
        columns = recording.channel(name)
        rows = len(columns.pop("host_time_s"))
        said = message("cli", "{name}: {rows} rows of {columns}")
        channel = said.fill(name=name, rows=rows, columns=", ".join(columns))
        print(f"  {'channel':16s}{options.wording.of(channel)}")
    events = recording.events()
    print(f"  {'events':16s}{len(events)}")
    for event in events if options.events else ():
        print(f"  {event.host_time_s - recording.began_s:12.6f} {event.kind:14s} {event.text}")
    return 0


def recover(options: argparse.Namespace) -> int:
    """Finish one recording, or all in a folder."""
    from rotemina.app.motion.recording import recovery

    source = options.source
    found = recovery.unfinished(source) if source.is_dir() else (source,)
    if not found:
        tell(options, message("cli", "{source}: nothing to recover").fill(source=source))
    refused = []
    for path in found:
        try:
            print(recovery.recover(path))
        except InputError as error:  # one that is being recorded keeps nobody from the others
            refused.append(str(error))
    if refused:
        raise InputError("\n".join(refused))
    return 0


def export(options: argparse.Namespace) -> int:
    """Write a stretch of a recording."""
    from rotemina.app.motion.recording import exporting
    from rotemina.app.motion.recording.recording_reader import Recording

    if not 0.0 <= options.begin < options.end:
        raise InputError(
            message("cli", "--from {begin} --to {end}: must be 0 or more, and in order").fill(
                begin=options.begin, end=options.end
            )
        )
    if options.trajectory and options.reference is not None:
        raise InputError(message("cli", "--trajectory and --reference: choose one of them"))
    if not options.period > 0.0:
        raise InputError(
            message("cli", "--period {period}: must be more than 0 s").fill(period=options.period)
        )
    _require_other(options.output, options.recording)
    recording = Recording.open(options.recording)
    begin_s, end_s = (recording.began_s + each for each in (options.begin, options.end))
    if options.trajectory:
        commands = exporting.trajectory(recording, begin_s, end_s, options.period).commands
        write_record(commands, options.output)
        rows = len(commands.time_s)
    elif options.reference is not None:
        from rotemina.app.microscope.recorded_reference import recorded_reference

        referenced = recorded_reference(recording, options.reference, begin_s, end_s)
        write_record(referenced, options.output)
        rows = len(referenced.time_s)
    else:
        rows = exporting.export(recording, options.output, begin_s, end_s)
    said = message("cli", "{output}: {rows} rows")
    tell(options, said.fill(output=options.output, rows=rows))
    return 0


def report(options: argparse.Namespace) -> int:
    """Write the run report of a recording, or of another record beside the nominal model."""
    from platformdirs import user_data_path

    from rotemina.app.motion.compared_run import Run
    from rotemina.app.motion.penetration.run_log import RunLog
    from rotemina.app.motion.recording.recovery import SUFFIX
    from rotemina.app.records.database import RecordStore
    from rotemina.app.records.run_report import RunReport, report_text
    from rotemina.sim.comparison.comparison import compare

    path, own = options.record.absolute(), user_data_path("rotemina", appauthor=False)
    _require_other(options.output, path)
    entry = next((one for one in RecordStore(own).all() if one.path == path), None)
    if path.suffix == SUFFIX:
        log = RunLog(own / "penetrations.jsonl")
        penetrations = log.read()[0] if Path(log.path).exists() else ()
        told = RunReport.of_recording(path, entry, penetrations)
    else:
        robot = robot_of(options)
        (record,) = records_of_model(options, robot, [path])
        tell_model(options, robot.name)
        told = RunReport.of_run(Run(path.name, compare(robot, record)), robot, entry)
    write_text(options.output, report_text(told, options.wording))
    print(options.output)
    if options.open:
        webbrowser.open(options.output.absolute().as_uri())
    return 0


def _require_other(output: Path, read: Path) -> None:
    if output.exists() and output.samefile(read):
        raise InputError(
            message("cli", "{output} is the input file; name another by -o").fill(output=output)
        )
