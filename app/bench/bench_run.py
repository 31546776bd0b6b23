"""The bench run by the command line: one machine after another, each diagnosis in a process."""

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

from rotemina.app.bench.machine import Machine, machines
from rotemina.app.bench.residual import residual_of
from rotemina.app.bench.result import NamedCause, Result
from rotemina.app.bench.words import line, page
from rotemina.app.files import json_text
from rotemina.sim.errors import InputError
from rotemina.sim.gap.output.document_reader import read_document
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.whole_files import replaced

FORMAT = "rotemina-bench 1"
_PROGRAM = (sys.executable, "-m", "rotemina.app.cli.main")


def run_bench(options: Namespace) -> None:
    """Diagnose every machine, print one line each, and write the requested files."""
    found = machines(options.folders)
    results = []
    for machine in found:
        results.append(result_of(machine, options.jobs, options.longest))
        if options.json != "-":
            print(line(results[-1]), flush=True)
    text = json_text({"format": FORMAT, "machines": [one.as_json() for one in results]})
    with ExitStack() as files:  # all files appear together or none
        if options.report is not None:
            files.enter_context(replaced(options.report)).write(page(results).encode("utf-8"))
        if options.json not in (None, "-"):
            files.enter_context(replaced(options.json)).write(text.encode("utf-8"))
    if options.json == "-":
        print(text)


def result_of(
    machine: Machine,
    jobs: int | None = None,
    longest_s: float = 1800.0,
    program: Sequence[str] = _PROGRAM,
) -> Result:
    """Diagnose a machine by its train records, and try the corrected model on its test records."""
    title = load_robot(machine.robot).name
    if machine.is_inverse:
        return Result(machine, title, not_run="inverse mode")
    with TemporaryDirectory(prefix="rotemina-") as folder:
        written = Path(folder) / "answer.json"
        begin_s = time.monotonic()
        fault = _diagnosed(machine, written, jobs, longest_s, program)
        seconds = time.monotonic() - begin_s
        if fault is not None:
            return Result(machine, title, seconds=seconds, not_run=fault)
        return _tried(machine, title, written, seconds)


def _diagnosed(
    machine: Machine, written: Path, jobs: int | None, longest_s: float, program: Sequence[str]
) -> str | None:
    """Run the diagnosis; return None, or why there is none."""
    command = [*program, "gap", "diagnose", *map(str, machine.train), "--robot", str(machine.robot)]
    command += ["--json", str(written)] + ([] if jobs is None else ["--jobs", str(jobs)])
    try:
        done = subprocess.run(command, capture_output=True, timeout=longest_s, check=False)
    except subprocess.TimeoutExpired:
        return f"it took longer than {longest_s:g} s"
    if done.returncode == 0:
        return None
    said = done.stderr.decode("utf-8", "replace").strip().splitlines() or [""]
    return said[-1].removeprefix("rotemina: ") or f"exit status {done.returncode}"


def _tried(machine: Machine, title: str, written: Path, seconds: float) -> Result:
    document = read_document(written)
    causes = tuple(_causes(json.loads(written.read_bytes())))
    verdict = str(document.verdict)
    tap = machine.truth.tap if machine.truth is not None else Tap.MEAS
    records = [read_record(path, robot=document.robot) for path in machine.test]
    units = {unit for record in records for unit in record.units.values()}
    if len(units) > 1:
        raise InputError(f"{machine.name}: its axes are in {', '.join(sorted(units))}; one is told")
    unit = "V" if tap is Tap.U else next(iter(units), "m")
    if not records:
        return Result(machine, title, verdict, causes, seconds=seconds, unit=unit)
    before, after = (residual_of(one, records, tap) for one in (document.robot, document.corrected))
    return Result(machine, title, verdict, causes, before, after, seconds, unit)


def _causes(document: dict[str, Any]) -> Iterator[NamedCause]:
    for cause in document["causes"]:
        yield NamedCause(
            cause["axis"],
            cause["effect"],
            cause["probability"],
            tuple(cause["ambiguous_with"]),
        )
