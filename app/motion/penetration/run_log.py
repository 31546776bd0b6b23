"""The log of penetrations: one line of JSON per run, appended to a file."""

import json
import os
from dataclasses import asdict, dataclass, fields
from datetime import datetime
from enum import StrEnum
from os import PathLike, fspath
from pathlib import Path
from types import NoneType
from typing import Any, Self

from rotemina.app.motion.penetration.parameters import PenetrationError
from rotemina.app.motion.penetration.thrust import ThrustMeasured
from rotemina.sim.errors import reason_of
from rotemina.sim.input_files import parse_json, read_bytes
from rotemina.sim.messages import message
from rotemina.sim.whole_files import FileWriteError

_MOST_BYTES = 256_000_000  # some hundred thousand runs


class Verdict(StrEnum):
    """How a run ended."""

    DONE = "done"
    ABORTED = "aborted"  # by the operator; the tip is back where it began
    FAILED = "failed"  # no contact, too shallow, overload; the tip is back where it began
    HELD = "held"  # by a stop, a fault or a lost link; the tip is where that left it


@dataclass(frozen=True, slots=True, kw_only=True)
class PenetrationRun:
    """One run; SI units, positions as commanded, None for what did not happen.

    Attributes
    ----------
    started : str
        When it was started, ISO 8601 with the zone.
    robot, driver : str
    model : str
        Id of the model in use.
    run, operator, sample : str
        As the operator says of all that is recorded.
    parameters : dict
        All of :class:`rotemina.app.motion.penetration.parameters.PenetrationParameters`.
    verdict : Verdict
    reason : str
    phases : tuple of (str, float)
        Each phase and when it began, s since the start.
    start, contact, contact_measured, contact_height : float or None
        Along the axis; the height is the tip's, where the robot has one.
    contact_delay_s, contact_from_start, noise_rms, threshold : float, bool or None
        Of the detection.
    planned_average_speed, planned_peak_speed, fit_error : float or None
    thrust : ThrustMeasured or None
    peak_deviation, final_deviation : float or None
        Change of ``meas − command`` since the contact, against the thrust: its peak on the way, a
        tick's lag included, and what was left at its end.
    gave_way : bool or None
        Whether it fell by a third of its peak, and by more than noise: a membrane that broke.
    """

    started: str
    robot: str
    driver: str
    parameters: dict[str, Any]
    verdict: Verdict
    reason: str
    phases: tuple[tuple[str, float], ...]
    model: str = ""
    run: str = ""
    operator: str = ""
    sample: str = ""
    start: float | None = None
    contact: float | None = None
    contact_measured: float | None = None
    contact_height: float | None = None
    contact_delay_s: float | None = None
    contact_from_start: bool | None = None
    noise_rms: float | None = None
    threshold: float | None = None
    planned_average_speed: float | None = None
    planned_peak_speed: float | None = None
    fit_error: float | None = None
    thrust: ThrustMeasured | None = None
    peak_deviation: float | None = None
    final_deviation: float | None = None
    gave_way: bool | None = None

    def line(self) -> str:
        """Return the run as one line of JSON."""
        return json.dumps(asdict(self), allow_nan=False, ensure_ascii=False)

    def during(self, began: datetime, duration_s: float) -> bool:
        """Return whether it was under way while something was recorded, begun at a whole second."""
        try:
            after_s = (datetime.fromisoformat(self.started) - began).total_seconds()
        except (ValueError, TypeError):  # it names no moment, or no zone
            return False
        lasted_s = self.phases[-1][1] if self.phases else 0.0
        return -lasted_s - 1.0 <= after_s <= duration_s

    @classmethod
    def parsed(cls, line: str) -> Self:
        """Return the run of a line.

        Raises
        ------
        PenetrationError
            If the line is none.
        """
        try:
            table = parse_json(line, "run", PenetrationError)
            table["verdict"] = Verdict(table["verdict"])
            table["phases"] = tuple((str(name), float(at)) for name, at in table["phases"])
            if table.get("thrust") is not None:
                table["thrust"] = ThrustMeasured(**table["thrust"])
            run = cls(**table)
            _require_kinds(run)
            return run
        except (ValueError, TypeError, KeyError) as error:
            raise PenetrationError(
                message("engine", "not the run of a penetration: {error}").fill(
                    error=reason_of(error)
                )
            ) from error


class RunLog:
    """A file of runs, latest last. A crash during an append costs only that run."""

    def __init__(self, path: str | PathLike[str]) -> None:
        self.path = fspath(path)

    def append(self, run: PenetrationRun) -> None:
        """Write a run behind the others, by a single write, and have it on the disk.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        data = (run.line() + "\n").encode()
        try:
            Path(self.path).parent.mkdir(parents=True, exist_ok=True)
            descriptor = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
            try:
                if os.lseek(descriptor, 0, os.SEEK_END):
                    os.lseek(descriptor, -1, os.SEEK_END)
                    if os.read(descriptor, 1) != b"\n":
                        data = b"\n" + data  # a line that was cut off stays alone
                written = os.write(descriptor, data)
                os.fsync(descriptor)
            finally:
                os.close(descriptor)
        except OSError as error:
            raise FileWriteError(
                message("engine", "{path}: cannot be written: {strerror}").fill(
                    path=self.path, strerror=str(error.strerror)
                )
            ) from error
        if written != len(data):
            raise FileWriteError(
                message(
                    "engine", "{path}: the run was not written completely; the disk may be full"
                ).fill(path=self.path)
            )

    def read(self) -> tuple[tuple[PenetrationRun, ...], tuple[str, ...]]:
        """Return the runs, and the errors of invalid lines, each with its number.

        Raises
        ------
        PenetrationError
            If the file cannot be read.
        """
        text = read_bytes(self.path, PenetrationError, _MOST_BYTES).decode(errors="replace")
        runs, problems = [], []
        for number, line in enumerate(text.split("\n"), 1):
            if not line.strip():
                continue
            try:
                runs.append(PenetrationRun.parsed(line))
            except PenetrationError as error:
                problems.append(f"{self.path}, line {number}: {error}")
        return tuple(runs), tuple(problems)


def _require_kinds(run: PenetrationRun) -> None:
    """Raise a TypeError unless the run's texts are texts and its figures are figures."""
    texts = ("started", "robot", "driver", "model", "run", "operator", "sample", "reason")
    kinds: dict[str, tuple[type, ...]] = {
        **dict.fromkeys(texts, (str,)),
        **{"parameters": (dict,), "verdict": (Verdict,), "phases": (tuple,)},
        "thrust": (ThrustMeasured, NoneType),
    }
    parts: list[tuple[Any, tuple[type, ...]]] = [(run, (float, int, NoneType))]
    if run.thrust is not None:
        parts.append((run.thrust, (float, int)))
    for part, figure in parts:
        for one in fields(part):
            value = getattr(part, one.name)
            if not isinstance(value, kinds.get(one.name, figure)):
                raise TypeError(f"{one.name} = {str(value)[:40]!r}: of the wrong kind")
