"""``rotemina gap diagnose``: locate the gap, find its causes, and measure how far it shrinks."""

import argparse
import sys
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

from rotemina.app.cli.terminal import (
    TerminalProgressLine,
    add_columns,
    add_robot,
    add_workers,
    check_output_files,
    find_json_file,
    find_robot_file,
    is_same_file,
    load_selected_robot,
    prepare_workers,
    print_model,
    read_records_of_model,
)
from rotemina.app.errors import CommandError
from rotemina.app.settings import format_json
from rotemina.sim.files import replace_file
from rotemina.sim.gap.experiment import (
    ExperimentRecords,
    is_experiment_file,
    make_experiment_records,
)
from rotemina.sim.gap.intake import RecordCaution, check_records
from rotemina.sim.gap.output import as_json, make_summary_text
from rotemina.sim.gap.result import Diagnosis
from rotemina.sim.messages import MessageWording
from rotemina.sim.records import Record, write_record
from rotemina.sim.robot import Robot


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = verbs.add_parser(
        "diagnose",
        help="find where model and machine differ, which effects cause it, and how far the"
        " gap shrinks",
        description="Compare the model with records of the real machine, name the effects that "
        "the model lacks, and prove this with data that the fit never used. Several "
        "records of one robot are diagnosed together; they may differ in rate, "
        "length, axes and signals.",
    )
    parser.add_argument("records", type=Path, nargs="+", metavar="RECORD")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--json",
        metavar="OUT",
        help="write the diagnosis as JSON, and suggested experiments next to it ('-' prints it)",
    )
    parser.add_argument(
        "--report",
        type=Path,
        metavar="OUT.html",
        help="write a report, one page that works offline",
    )
    parser.add_argument(
        "--seed", type=int, default=0, metavar="N", help="seed of random numbers (default: 0)"
    )
    add_workers(parser)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Diagnose, print a summary, and write the requested files."""
    if options.seed < 0:
        raise CommandError("--seed {seed}: must be 0 or more", seed=options.seed)
    document_path = find_json_file(options.json)
    _check_files(options, document_path)
    robot = load_selected_robot(options)
    records = read_records_of_model(options, robot, options.records)
    cautions = check_records(robot, records, list(map(str, options.records)))
    print_model(options, robot.name)
    _print_cautions(cautions, options.records, options.wording)
    with (
        prepare_workers(options.jobs, options.cluster) as jobs,
        TerminalProgressLine(sys.stderr, options.wording) as listener,
    ):
        diagnosis = run_diagnosis(
            robot, records, seed=options.seed, jobs=jobs, listener=listener, cautions=cautions
        )
    suggestions = (
        [] if document_path is None else _make_suggestions(diagnosis, records, document_path)
    )
    text = format_json(as_json(diagnosis, [suggestion.names for suggestion in suggestions]))
    output = text if options.json == "-" else make_summary_text(diagnosis, records, options.wording)
    report = (
        None
        if options.report is None
        else make_report(diagnosis, records, options.records, options.wording)
    )
    # All files are replaced together or not at all, even if writing one of them fails.
    with ExitStack() as files:
        if document_path is not None:
            files.enter_context(replace_file(document_path)).write(text.encode("utf-8"))
        if report is not None:
            files.enter_context(replace_file(options.report)).write(report)
        for suggestion in suggestions:
            for name, record in suggestion.records.items():
                file = files.enter_context(replace_file(document_path.with_name(name)))
                file.write(_make_record_file(record))
    print(output)
    if options.json == "-" and diagnosis.experiments:
        print(
            "rotemina: suggested experiments are written next to a JSON file; name one by --json",
            file=sys.stderr,
        )
    return _report_failures(diagnosis)


def _report_failures(diagnosis: Diagnosis) -> int:
    """Print which axes could not be examined, and return the exit status."""
    for step in diagnosis.failed:
        if not step.effects:
            print(
                f"rotemina: axis {step.axis}: the program failed to examine it ({step.reason}); "
                "the answer is not complete. Send the records and this text to the maintainer",
                file=sys.stderr,
            )
    return 0 if diagnosis.is_complete else 1


def _print_cautions(
    cautions: Sequence[RecordCaution], files: Sequence[Path], wording: MessageWording
) -> None:
    axes_by_caution: dict[tuple[int | None, str], list[str]] = {}
    for caution in cautions:
        axes_by_caution.setdefault((caution.record, caution.text), []).extend(
            [caution.axis] if caution.axis else []
        )
    for (record, text), axes in axes_by_caution.items():
        file = f"{files[record]}: " if record is not None else ""
        axis = f"{', '.join(axes)}: " if axes else ""
        print(f"rotemina: {file}{axis}{wording.format_field(text)}", file=sys.stderr)


def _make_suggestions(
    diagnosis: Diagnosis, records: Iterable[Record], document_path: Path
) -> list[ExperimentRecords]:
    units = {name: unit for record in records for name, unit in record.units.items()}
    units |= {name: unit for name in diagnosis.robot.axes if (unit := diagnosis.robot.unit(name))}
    return [
        make_experiment_records(experiment, number, document_path.stem, units)
        for number, experiment in enumerate(diagnosis.experiments, start=1)
    ]


def _make_record_file(record: Record) -> bytes:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "record.csv"
        write_record(record, path)
        return path.read_bytes()


def _check_files(options: argparse.Namespace, document_path: Path | None) -> None:
    """Refuse outputs that cannot be written, or that would overwrite an input or each other."""
    inputs = [*options.records, find_robot_file(options.robot)]
    check_output_files([document_path, options.report], inputs)
    if document_path is None:
        return
    for other in filter(None, (*inputs, options.report)):
        if is_same_file(document_path.parent, other.parent) and is_experiment_file(
            other.name, document_path.stem
        ):
            raise CommandError(
                "{other} would be overwritten by a suggested experiment of {document}; "
                "name another file by --json",
                other=other,
                document=document_path,
            )


def run_diagnosis(
    robot: Robot,
    records: Sequence[Record],
    *,
    seed: int,
    jobs: int,
    listener: TerminalProgressLine,
    cautions: Sequence[RecordCaution],
) -> Diagnosis:
    """Run the diagnosis."""
    # The import is slow, and invalid input must be refused quickly.
    from rotemina.sim.gap.pipeline import diagnosis_pipeline

    return diagnosis_pipeline.diagnose(
        robot, records, seed=seed, jobs=jobs, listener=listener, cautions=cautions
    )


def make_report(
    diagnosis: Diagnosis, records: Sequence[Record], files: Sequence[Path], wording: MessageWording
) -> bytes:
    """Return the report as an HTML page."""
    # The import is slow, and needed only with --report.
    from rotemina.sim.gap.output import make_report_text

    names = [path.name for path in files]
    return make_report_text(diagnosis, records, names, wording).encode("utf-8", "replace")
