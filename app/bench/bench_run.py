"""Run of ``rotemina gap bench``, which diagnoses each machine in a separate process."""

import json
import subprocess
import sys
import time
from argparse import Namespace
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

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
_PROGRAM = (sys.executable, "-m", "rotemina.app.cli.main")


def run_bench(options: Namespace) -> None:
    """Diagnose all machines, print a line for each, and write the requested files."""
    bench_machines = find_machines(options.folders)
    results = []
    for machine in bench_machines:
        results.append(diagnose_machine(machine, options.jobs, options.longest))
        if options.json != "-":
            print(format_line(results[-1]), flush=True)
    text = format_json(
        {"format": BENCH_FORMAT, "machines": [result.as_json() for result in results]}
    )
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


def diagnose_machine(
    machine: BenchMachine,
    jobs: int | None = None,
    timeout_s: float = 1800.0,
    program: Sequence[str] = _PROGRAM,
) -> BenchResult:
    """Diagnose a machine from its train records, and test the corrected model.

    The test records give the residual of the model before and after the correction.
    """
    title = load_robot(machine.robot).name
    if machine.is_inverse:
        return BenchResult(machine, title, not_run="inverse mode")
    with TemporaryDirectory(prefix="rotemina-") as folder:
        document_path = Path(folder) / "answer.json"
        start_s = time.monotonic()
        fault = _run_diagnosis(machine, document_path, jobs, timeout_s, program)
        seconds = time.monotonic() - start_s
        if fault is not None:
            return BenchResult(machine, title, seconds=seconds, not_run=fault)
        return _evaluate_diagnosis(machine, title, document_path, seconds)


def _run_diagnosis(
    machine: BenchMachine,
    document_path: Path,
    jobs: int | None,
    timeout_s: float,
    program: Sequence[str],
) -> str | None:
    """Run the diagnosis; return the reason if it fails, otherwise None."""
    command = [*program, "gap", "diagnose", *map(str, machine.train), "--robot", str(machine.robot)]
    command += ["--json", str(document_path)] + ([] if jobs is None else ["--jobs", str(jobs)])
    try:
        process = subprocess.run(command, capture_output=True, timeout=timeout_s, check=False)
    except subprocess.TimeoutExpired:
        return f"it took longer than {timeout_s:g} s"
    if process.returncode == 0:
        return None
    error_lines = process.stderr.decode("utf-8", "replace").strip().splitlines() or [""]
    return error_lines[-1].removeprefix("rotemina: ") or f"exit status {process.returncode}"


def _evaluate_diagnosis(
    machine: BenchMachine, title: str, document_path: Path, seconds: float
) -> BenchResult:
    document = read_document(document_path)
    causes = tuple(_read_causes(json.loads(document_path.read_bytes())))
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
        return BenchResult(machine, title, verdict, causes, seconds=seconds, unit=unit)
    before, after = (
        compute_model_residual(robot, records, tap)
        for robot in (document.robot, document.corrected)
    )
    return BenchResult(machine, title, verdict, causes, before, after, seconds, unit)


def _read_causes(document: dict[str, Any]) -> Iterator[NamedCause]:
    for cause in document["causes"]:
        yield NamedCause(
            cause["axis"],
            cause["effect"],
            cause["probability"],
            tuple(cause["ambiguous_with"]),
        )
