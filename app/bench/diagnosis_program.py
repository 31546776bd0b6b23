"""The diagnosis as a program in a process of its own, and a second one to compare it with."""

import os
import shlex
import shutil
import subprocess
import sys
from argparse import ArgumentTypeError
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

# Command line of this program.
OWN_PROGRAM = (sys.executable, "-m", "rotemina.app.cli.main")


@dataclass(frozen=True, slots=True)
class ProgramRun:
    """What a run of a program cost; ``fault`` is its last message if it failed.

    ``processor_s`` is the time that processors worked on it, in all its threads and processes. It
    depends less than ``seconds`` on what else runs on this computer. It is 0 on Windows, where it
    cannot be measured.
    """

    seconds: float
    processor_s: float
    fault: str | None = None


def run_program(
    command: Sequence[str], folder: Path | None = None, timeout_s: float = 1800.0
) -> ProgramRun:
    """Run a program in a folder. No other child process of this one may end meanwhile."""
    start_s, processor_start_s = monotonic(), _measure_processor_time()
    fault = None
    try:
        process = subprocess.run(
            command, cwd=folder, capture_output=True, timeout=timeout_s, check=False
        )
    except subprocess.TimeoutExpired:
        fault = f"it took longer than {timeout_s:g} s"
    else:
        if process.returncode != 0:
            messages = process.stderr.decode("utf-8", "replace").strip().splitlines() or [""]
            fault = messages[-1].removeprefix("rotemina: ") or f"exit status {process.returncode}"
    return ProgramRun(
        monotonic() - start_s, round(_measure_processor_time() - processor_start_s, 3), fault
    )


def parse_program(text: str) -> tuple[str, ...]:
    """Parse the command line of a program, such as ``/other/.venv/bin/rotemina``.

    Raises
    ------
    ArgumentTypeError
        If it is empty, not closed by a quote, or its program cannot be run.
    """
    try:
        command = tuple(shlex.split(text))
    except ValueError as error:
        raise ArgumentTypeError(f"{text!r}: cannot be read as a command ({error})") from error
    program = shutil.which(command[0]) if command else None
    if program is None:
        raise ArgumentTypeError(
            f"{text!r}: there is no such program; name the command of another installation, such "
            "as /other/.venv/bin/rotemina"
        )
    # It is run in the folder of the records.
    return (str(Path(program).absolute()), *command[1:])


def _measure_processor_time() -> float:
    times = os.times()
    return times.children_user + times.children_system
