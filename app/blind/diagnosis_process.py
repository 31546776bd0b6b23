"""Run the diagnosis as a separate process in a folder that contains only records."""

import json
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rotemina.app.bench import OWN_PROGRAM, run_program
from rotemina.app.blind.cases import SealedCase
from rotemina.sim.blind import compute_digest

# The diagnosis must not receive the seed of the cases, from which it could reconstruct them.
_DIAGNOSIS_SEED = "0"


@dataclass(frozen=True, slots=True)
class BlindAnswer:
    """The document of a diagnosis, its hash and cost, and its predicted record as CSV text.

    If the diagnosis failed, the verdict of ``document`` is ``failed``, and ``why`` is the reason.
    """

    document: dict[str, Any]
    sha256: str
    seconds: float
    predicted: bytes | None
    processor_s: float = 0.0


def diagnose_case(
    case: SealedCase, jobs: int | None = None, program: Sequence[str] = OWN_PROGRAM
) -> BlindAnswer:
    """Run ``gap diagnose`` on a case's records, then ``gap predict`` on its withheld commands."""
    with TemporaryDirectory(prefix="records-") as records, TemporaryDirectory() as output:
        names = _copy_records(case, Path(records))
        path = Path(output) / "answer.json"
        arguments = ["gap", "diagnose", *names, "--robot", case.robot, "--seed", _DIAGNOSIS_SEED]
        arguments += ["--json", str(path)]
        arguments += [] if jobs is None else ["--jobs", str(jobs)]
        run = run_program([*program, *arguments], Path(records))
        if run.fault is None:
            content, predicted = path.read_bytes(), _predict_record(case, path, program)
        else:
            content = json.dumps({"verdict": "failed", "why": run.fault}).encode()
            predicted = None
        return BlindAnswer(
            json.loads(content), compute_digest(content), run.seconds, predicted, run.processor_s
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
    run = run_program([*program, *arguments], answer.parent)
    return None if run.fault is not None else predicted.read_bytes()
