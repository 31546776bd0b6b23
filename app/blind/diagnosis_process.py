"""Run the diagnosis as a separate process in a folder that contains only records."""

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rotemina.app.blind.cases import SealedCase
from rotemina.sim.blind import compute_digest

_PROGRAM = (sys.executable, "-m", "rotemina.app.cli.main")
_TIMEOUT_S = 1800.0
# The diagnosis must not receive the seed of the cases, from which it could reconstruct them.
_DIAGNOSIS_SEED = "0"


@dataclass(frozen=True, slots=True)
class BlindAnswer:
    """The document of a diagnosis, its hash and duration, and its predicted record as CSV text.

    If the diagnosis failed, the verdict of ``document`` is ``failed``, and ``why`` is the reason.
    """

    document: dict[str, Any]
    sha256: str
    seconds: float
    predicted: bytes | None


def diagnose_case(
    case: SealedCase, jobs: int | None = None, program: Sequence[str] = _PROGRAM
) -> BlindAnswer:
    """Run ``gap diagnose`` on a case's records, then ``gap predict`` on its withheld commands."""
    with TemporaryDirectory(prefix="records-") as records, TemporaryDirectory() as output:
        names = _copy_records(case, Path(records))
        path = Path(output) / "answer.json"
        arguments = ["gap", "diagnose", *names, "--robot", case.robot, "--seed", _DIAGNOSIS_SEED]
        arguments += ["--json", str(path)]
        arguments += [] if jobs is None else ["--jobs", str(jobs)]
        start_s = time.monotonic()
        fault = _run([*program, *arguments], Path(records))
        seconds = time.monotonic() - start_s
        if fault is not None:
            content = json.dumps({"verdict": "failed", "why": fault}).encode()
            return BlindAnswer(json.loads(content), compute_digest(content), seconds, None)
        content = path.read_bytes()
        return BlindAnswer(
            json.loads(content),
            compute_digest(content),
            seconds,
            _predict_record(case, path, program),
        )


def _copy_records(case: SealedCase, folder: Path) -> list[str]:
    names = []
    for number, path in enumerate(case.records, start=1):
        suffix = ".csv.gz" if path.name.endswith(".gz") else ".csv"
        shutil.copyfile(path, folder / f"record_{number}{suffix}")
        names.append(f"record_{number}{suffix}")
    return names


def _predict_record(case: SealedCase, answer: Path, program: Sequence[str]) -> bytes | None:
    if case.commands is None:
        return None
    predicted = answer.with_name("predicted.csv")
    arguments = ["gap", "predict", str(answer), str(case.commands.resolve()), "-o", str(predicted)]
    fault = _run([*program, *arguments], answer.parent)
    return None if fault is not None else predicted.read_bytes()


def _run(command: Sequence[str], folder: Path) -> str | None:
    """Run a program; return the end of its messages if it fails, otherwise None."""
    try:
        process = subprocess.run(
            command, cwd=folder, capture_output=True, timeout=_TIMEOUT_S, check=False
        )
    except subprocess.TimeoutExpired:
        return f"it took longer than {_TIMEOUT_S:g} s"
    if process.returncode == 0:
        return None
    messages = process.stderr.decode("utf-8", "replace").strip()
    return f"exit status {process.returncode}: {messages[-400:]}"
