"""The diagnosis as a separate process, in a folder that contains only records."""

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
from rotemina.sim.blind.sealing import digest

_PROGRAM = (sys.executable, "-m", "rotemina.app.cli.main")
_LONGEST_S = 1800.0
_SEED = "0"  # of the diagnosis: the cases' own would tell


@dataclass(frozen=True, slots=True)
class Answer:
    """What the diagnosis wrote, its hash, how long it took, and what it predicts (a file's text).

    Where it failed, ``document`` has the verdict ``failed`` and says why.
    """

    document: dict[str, Any]
    sha256: str
    seconds: float
    predicted: bytes | None


def diagnose(
    case: SealedCase, jobs: int | None = None, program: Sequence[str] = _PROGRAM
) -> Answer:
    """Run ``gap diagnose`` on a case's records, then ``gap predict`` on its withheld commands."""
    with TemporaryDirectory(prefix="records-") as records, TemporaryDirectory() as out:
        names = _copied(case, Path(records))
        written = Path(out) / "answer.json"
        arguments = ["gap", "diagnose", *names, "--robot", case.robot, "--seed", _SEED]
        arguments += ["--json", str(written)]
        arguments += [] if jobs is None else ["--jobs", str(jobs)]
        begin_s = time.monotonic()
        fault = _run([*program, *arguments], Path(records))
        seconds = time.monotonic() - begin_s
        if fault is not None:
            text = json.dumps({"verdict": "failed", "why": fault}).encode()
            return Answer(json.loads(text), digest(text), seconds, None)
        text = written.read_bytes()
        return Answer(json.loads(text), digest(text), seconds, _predicted(case, written, program))


def _copied(case: SealedCase, folder: Path) -> list[str]:
    """Copy the records under names that tell nothing."""
    names = []
    for number, path in enumerate(case.records, start=1):
        ending = ".csv.gz" if path.name.endswith(".gz") else ".csv"
        shutil.copyfile(path, folder / f"record_{number}{ending}")
        names.append(f"record_{number}{ending}")
    return names


def _predicted(case: SealedCase, answer: Path, program: Sequence[str]) -> bytes | None:
    if case.commands is None:
        return None
    predicted = answer.with_name("predicted.csv")
    arguments = ["gap", "predict", str(answer), str(case.commands.resolve()), "-o", str(predicted)]
    fault = _run([*program, *arguments], answer.parent)
    return None if fault is not None else predicted.read_bytes()


def _run(command: Sequence[str], folder: Path) -> str | None:
    """Run a program; return None, or what it said in the end where it failed."""
    try:
        done = subprocess.run(
            command, cwd=folder, capture_output=True, timeout=_LONGEST_S, check=False
        )
    except subprocess.TimeoutExpired:
        return f"it took longer than {_LONGEST_S:g} s"
    if done.returncode == 0:
        return None
    said = done.stderr.decode("utf-8", "replace").strip()
    return f"exit status {done.returncode}: {said[-400:]}"
