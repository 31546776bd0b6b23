"""Run of ``rotemina gap bench``, which diagnoses each machine in a separate process."""

import json
import sys
from argparse import Namespace
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rotemina.app.bench.diagnosis_program import OWN_PROGRAM, run_program
from rotemina.app.bench.engine_comparison import (
    EngineAnswers,
    describe_answer,
    format_difference,
    format_summary,
)
from rotemina.app.bench.machine import BenchMachine, find_machines
from rotemina.app.bench.residual import compute_model_residual
from rotemina.app.bench.result import BenchResult, NamedCause
from rotemina.app.bench.words import format_line, format_page
from rotemina.app.settings import format_json
from rotemina.sim.errors import InputError
from rotemina.sim.files import replace_file
from rotemina.sim.gap.output import read_document
from rotemina.sim.records import Tap, read_record
from rotemina.sim.robot_files import load_robot

BENCH_FORMAT = "rotemina-bench 1"


def run_bench(options: Namespace) -> None:
    """Diagnose all machines, print a line for each, and write the requested files."""
    bench_machines = find_machines(options.folders)
    results: list[BenchResult] = []
    comparisons: list[EngineAnswers] = []
    for number, machine in enumerate(bench_machines):
        if options.against is None:
            results.append(diagnose_machine(machine, options.jobs, options.longest))
        else:
            result, answers = _compare_engines(machine, options, own_first=number % 2 == 0)
            results.append(result)
            comparisons.append(answers)
        if options.json != "-":
            print(format_line(results[-1]), flush=True)
            if comparisons:
                print(f"  {format_difference(comparisons[-1])}".replace("\n", "\n  "), flush=True)
    document = {"format": BENCH_FORMAT, "machines": [result.as_json() for result in results]}
    if comparisons:
        document["against"] = [answers.as_json() for answers in comparisons]
        print(format_summary(comparisons), file=sys.stderr if options.json == "-" else sys.stdout)
    text = format_json(document)
    # All files are replaced together, or none.
    with ExitStack() as files:
        if options.report is not None:
            files.enter_context(replace_file(options.report)).write(
                format_page(results).encode("utf-8")
            )
        if options.json not in (None, "-"):
            files.enter_context(replace_file(options.json)).write(text.encode("utf-8"))
    if options.json == "-":
        print(text)


def _compare_engines(
    machine: BenchMachine, options: Namespace, *, own_first: bool
) -> tuple[BenchResult, EngineAnswers]:
    """Diagnose a machine with this program and with the other one.

    The order alternates from machine to machine, so that a computer that gets slower with time
    favours neither.
    """
    programs = {"own": OWN_PROGRAM, "other": options.against}
    results = {
        name: diagnose_machine(machine, options.jobs, options.longest, programs[name])
        for name in (("own", "other") if own_first else ("other", "own"))
    }
    own, other = results["own"], results["other"]
    known = machine.truth.causes if machine.truth is not None else ()
    return own, EngineAnswers(
        machine.name,
        own.answer,
        other.answer,
        own.processor_s,
        other.processor_s,
        ", ".join(f"{{{' '.join(effects)}}}" for effects in known),
    )


def diagnose_machine(
    machine: BenchMachine,
    jobs: int | None = None,
    timeout_s: float = 1800.0,
    program: Sequence[str] = OWN_PROGRAM,
) -> BenchResult:
    """Diagnose a machine from its train records, and test the corrected model.

    The test records give the residual of the model before and after the correction.
    """
    title = load_robot(machine.robot).name
    if machine.is_inverse:
        return BenchResult(machine, title, not_run="inverse mode")
    with TemporaryDirectory(prefix="rotemina-") as folder:
        document_path = Path(folder) / "answer.json"
        command = [*program, "gap", "diagnose", *map(str, machine.train)]
        command += ["--robot", str(machine.robot), "--json", str(document_path)]
        command += [] if jobs is None else ["--jobs", str(jobs)]
        run = run_program(command, timeout_s=timeout_s)
        result = (
            BenchResult(machine, title, not_run=run.fault)
            if run.fault is not None
            else _evaluate_diagnosis(machine, title, document_path)
        )
        return replace(result, seconds=run.seconds, processor_s=run.processor_s)


def _evaluate_diagnosis(machine: BenchMachine, title: str, document_path: Path) -> BenchResult:
    document = read_document(document_path)
    table = json.loads(document_path.read_bytes())
    causes, answer = tuple(_read_causes(table)), describe_answer(table)
    verdict = str(document.verdict)
    tap = machine.truth.tap if machine.truth is not None else Tap.MEAS
    records = [read_record(path, robot=document.robot) for path in machine.test]
    units = {unit for record in records for unit in record.units.values()}
    if len(units) > 1:
        raise InputError(
            f"{machine.name}: its axes have the units {', '.join(sorted(units))}; the benchmark "
            "needs axes of the same unit"
        )
    unit = "V" if tap is Tap.U else next(iter(units), "m")
    if not records:
        return BenchResult(machine, title, verdict, causes, unit=unit, answer=answer)
    before, after = (
        compute_model_residual(robot, records, tap)
        for robot in (document.robot, document.corrected)
    )
    return BenchResult(machine, title, verdict, causes, before, after, unit=unit, answer=answer)


def _read_causes(document: dict[str, Any]) -> Iterator[NamedCause]:
    for cause in document["causes"]:
        yield NamedCause(
            cause["axis"],
            cause["effect"],
            cause["probability"],
            tuple(cause["ambiguous_with"]),
        )
