"""``rotemina gap diagnose``: where the gap lies, which effects cause it, how far it shrinks."""

import argparse
import sys
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

from rotemina.app.cli.options import (
    add_columns,
    add_robot,
    records_of_model,
    robot_of,
    tell_model,
)
from rotemina.app.cli.progress import ProgressLine
from rotemina.app.cli.workers import add_workers, workers
from rotemina.app.files import json_text
from rotemina.sim.errors import InputError
from rotemina.sim.gap.diagnosis import Diagnosis
from rotemina.sim.gap.experiment.experiment_files import Suggestion, may_be_suggested, suggestion
from rotemina.sim.gap.intake.cautions import Caution
from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.gap.output.document import as_json
from rotemina.sim.gap.output.summary import summary
from rotemina.sim.messages import Wording, message
from rotemina.sim.records.record import Record
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.model import Robot
from rotemina.sim.whole_files import replaced


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = verbs.add_parser(
        "diagnose",
        help="find where model and machine differ, which effects cause it, and how far the"
        " gap shrinks",
        description="Compare the model with records of the real machine, name the effects that "
        "the model lacks, and prove it with data that the fit never used. Several "
        "records of one robot are diagnosed together; they may differ in rate, "
        "length, axes and signals.",
    )
    parser.add_argument("records", type=Path, nargs="+", metavar="RECORD")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument(
        "--json",
        metavar="OUT",
        help="write the diagnosis as JSON, with suggested experiments beside it ('-' prints it)",
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
        raise InputError(message("cli", "--seed {seed}: must be 0 or more").fill(seed=options.seed))
    document = Path(options.json) if options.json not in (None, "-") else None
    _check_files(options, document)
    robot = robot_of(options)
    records = records_of_model(options, robot, options.records)
    cautions = check(robot, records, list(map(str, options.records)))
    tell_model(options, robot.name)
    _tell(cautions, options.records, options.wording)
    with (
        workers(options.jobs, options.cluster) as jobs,
        ProgressLine(sys.stderr, options.wording) as listener,
    ):
        diagnosis = diagnose(
            robot, records, seed=options.seed, jobs=jobs, listener=listener, cautions=cautions
        )
    suggestions = [] if document is None else _suggestions(diagnosis, records, document)
    text = json_text(as_json(diagnosis, [each.names for each in suggestions]))
    told = text if options.json == "-" else summary(diagnosis, records, options.wording)
    page = (
        None
        if options.report is None
        else report(diagnosis, records, options.records, options.wording)
    )
    # All files appear together or none: a failure at one leaves the others' places alone.
    with ExitStack() as files:
        if document is not None:
            files.enter_context(replaced(document)).write(text.encode("utf-8"))
        if page is not None:
            files.enter_context(replaced(options.report)).write(page)
        for each in suggestions:
            for name, record in each.records.items():
                file = files.enter_context(replaced(document.with_name(name)))
                file.write(_file_of(record))
    print(told)
    if options.json == "-" and diagnosis.experiments:
        print(
            "rotemina: suggested experiments are written beside a JSON file; name one by --json",
            file=sys.stderr,
        )
    return 0


def _tell(cautions: Sequence[Caution], files: Sequence[Path], wording: Wording) -> None:
    """Print cautions on stderr; one that several axes share is told once."""
    axes: dict[tuple[int | None, str], list[str]] = {}
    for one in cautions:
        axes.setdefault((one.record, one.text), []).extend([one.axis] if one.axis else [])
    for (record, text), concerned in axes.items():
        file = f"{files[record]}: " if record is not None else ""
        axis = f"{', '.join(concerned)}: " if concerned else ""
        print(f"rotemina: {file}{axis}{wording.shown(text)}", file=sys.stderr)


def _suggestions(
    diagnosis: Diagnosis, records: Iterable[Record], document: Path
) -> list[Suggestion]:
    units = {name: unit for record in records for name, unit in record.units.items()}
    units |= {name: unit for name in diagnosis.robot.axes if (unit := diagnosis.robot.unit(name))}
    return [
        suggestion(one, number, document.stem, units)
        for number, one in enumerate(diagnosis.experiments, start=1)
    ]


def _file_of(record: Record) -> bytes:
    """Return the bytes of a record file."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "record.csv"
        write_record(record, path)
        return path.read_bytes()


def _check_files(options: argparse.Namespace, document: Path | None) -> None:
    """Refuse an output that would take the place of an input or of another output."""
    taken = [*options.records, *([Path(options.robot)] if Path(options.robot).is_file() else [])]
    for output in (document, options.report):
        if output is None:
            continue
        if not output.parent.is_dir():  # told before the work, not after it
            raise InputError(
                message(
                    "cli",
                    "{output} cannot be written: there is no folder {parent}; create it, or "
                    "choose another",
                ).fill(output=output, parent=output.parent)
            )
        if any(_is_same(output, other) for other in taken):
            raise InputError(
                message("cli", "{output} is named twice; give each file its own name").fill(
                    output=output
                )
            )
        taken.append(output)
    for other in taken:
        if document is None or not _is_same(document.parent, other.parent):
            continue
        if may_be_suggested(other.name, document.stem):
            raise InputError(
                message(
                    "cli",
                    "{other} would be overwritten by a suggested experiment of {document}; "
                    "name another file by --json",
                ).fill(other=other, document=document)
            )


def _is_same(one: Path, other: Path) -> bool:
    if one.absolute() == other.absolute():
        return True
    return one.exists() and other.exists() and one.samefile(other)


def diagnose(
    robot: Robot,
    records: Sequence[Record],
    *,
    seed: int,
    jobs: int,
    listener: ProgressLine,
    cautions: Sequence[Caution],
) -> Diagnosis:
    """Run the diagnosis."""
    from rotemina.sim.gap import diagnosis_pipeline  # takes its time to import

    return diagnosis_pipeline.diagnose(
        robot, records, seed=seed, jobs=jobs, listener=listener, cautions=cautions
    )


def report(
    diagnosis: Diagnosis, records: Sequence[Record], files: Sequence[Path], wording: Wording
) -> bytes:
    """Return the page of a report."""
    from rotemina.sim.gap.output.report.page import report_text  # takes its time to import

    names = [path.name for path in files]
    return report_text(diagnosis, records, names, wording).encode("utf-8", "replace")
