"""Log of penetrations: a file to which each run appends one line of JSON."""

import json
import os
from dataclasses import asdict, dataclass, fields
from datetime import datetime
from enum import StrEnum
from os import PathLike, fspath
from pathlib import Path
from types import NoneType
from typing import Any, Self

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration.thrust import MeasuredThrust
from rotemina.sim.errors import FileWriteError, describe_exception
from rotemina.sim.files import parse_json, read_bytes

# This is enough for some hundred thousand runs.
_MAX_LOG_BYTES = 256_000_000


class PenetrationVerdict(StrEnum):
    """Result of a run."""

    DONE = "done"
    # The operator ended the run; the tip is back at its start.
    ABORTED = "aborted"
    # No contact, too shallow or overload; the tip is back at its start.
    FAILED = "failed"
    # A stop, a fault or a lost link ended the run; the tip is still where it was then.
    HELD = "held"


@dataclass(frozen=True, slots=True, kw_only=True)
class PenetrationRun:
    """Log entry of one run, in SI units; positions are commands.

    A value is None if the run did not get that far.

    Attributes
    ----------
    started : str
        Time of the start, ISO 8601 with time zone.
    robot, driver : str
    model : str
        Id of the model in use.
    run, operator, sample : str
        Labels that the operator has set for all records.
    parameters : dict
        All fields of :class:`rotemina.app.motion.penetration.PenetrationParameters`.
    verdict : PenetrationVerdict
    reason : str
    phases : tuple of (str, float)
        Name of each phase, and its beginning, s after the start.
    start, contact, contact_measured, contact_height : float or None
        Positions along the axis; ``contact_height`` is the height of the tip, if the robot has one.
    contact_delay_s, contact_from_start, noise_rms, threshold : float, bool or None
        Results of the contact detection.
    planned_average_speed, planned_peak_speed, fit_error : float or None
    thrust : MeasuredThrust or None
    peak_deviation, final_deviation : float or None
        Change of ``meas − command`` since the contact, positive against the thrust: its peak
        during the thrust, including the lag of one tick, and its value at the end.
    gave_way : bool or None
        Whether this deviation fell by a third of its peak and by more than the noise, which shows
        that a membrane broke.
    """

    started: str
    robot: str
    driver: str
    parameters: dict[str, Any]
    verdict: PenetrationVerdict
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
    thrust: MeasuredThrust | None = None
    peak_deviation: float | None = None
    final_deviation: float | None = None
    gave_way: bool | None = None

    def to_json(self) -> str:
        """Return the run as one line of JSON."""
        return json.dumps(asdict(self), allow_nan=False, ensure_ascii=False)

    def overlaps(self, began: datetime, duration_s: float) -> bool:
        """Return whether the run overlaps a recording, whose start is rounded to whole seconds."""
        try:
            after_s = (datetime.fromisoformat(self.started) - began).total_seconds()
        # The text may not be a time, or may lack the time zone.
        except (ValueError, TypeError):
            return False
        run_duration_s = self.phases[-1][1] if self.phases else 0.0
        return -run_duration_s - 1.0 <= after_s <= duration_s

    @classmethod
    def from_json(cls, line: str) -> Self:
        """Read a run from a line of JSON.

        Raises
        ------
        PenetrationError
            If the line is not a run.
        """
        try:
            table = parse_json(line, "run", PenetrationError)
            table["verdict"] = PenetrationVerdict(table["verdict"])
            table["phases"] = tuple((str(name), float(time_s)) for name, time_s in table["phases"])
            if table.get("thrust") is not None:
                table["thrust"] = MeasuredThrust(**table["thrust"])
            run = cls(**table)
            _check_field_types(run)
            return run
        except (ValueError, TypeError, KeyError) as error:
            raise PenetrationError(
                "not the run of a penetration: {error}", error=describe_exception(error)
            ) from error


class RunLog:
    """File of runs in the order of time. A crash while a run is appended loses only that run."""

    def __init__(self, path: str | PathLike[str]) -> None:
        self.path = fspath(path)

    def append(self, run: PenetrationRun) -> None:
        """Append a run in a single write, and wait until it is on the disk.

        Raises
        ------
        FileWriteError
            If the run cannot be written.
        """
        data = (run.to_json() + "\n").encode()
        try:
            Path(self.path).parent.mkdir(parents=True, exist_ok=True)
            descriptor = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
            try:
                if os.lseek(descriptor, 0, os.SEEK_END):
                    os.lseek(descriptor, -1, os.SEEK_END)
                    if os.read(descriptor, 1) != b"\n":
                        # A crash has cut off the last line. End that line before the new one.
                        data = b"\n" + data
                written = os.write(descriptor, data)
                os.fsync(descriptor)
            finally:
                os.close(descriptor)
        except OSError as error:
            raise FileWriteError(
                "{path}: cannot be written: {strerror}",
                path=self.path,
                strerror=str(error.strerror),
            ) from error
        if written != len(data):
            raise FileWriteError(
                "{path}: the run was not written completely; the disk may be full", path=self.path
            )

    def read(self) -> tuple[tuple[PenetrationRun, ...], tuple[str, ...]]:
        """Return the runs, and the errors of invalid lines with their line numbers.

        Raises
        ------
        PenetrationError
            If the file cannot be read.
        """
        text = read_bytes(self.path, PenetrationError, _MAX_LOG_BYTES).decode(errors="replace")
        runs, problems = [], []
        for number, line in enumerate(text.split("\n"), 1):
            if not line.strip():
                continue
            try:
                runs.append(PenetrationRun.from_json(line))
            except PenetrationError as error:
                problems.append(f"{self.path}, line {number}: {error}")
        return tuple(runs), tuple(problems)


def _check_field_types(run: PenetrationRun) -> None:
    text_fields = ("started", "robot", "driver", "model", "run", "operator", "sample", "reason")
    types_by_field: dict[str, tuple[type, ...]] = {
        **dict.fromkeys(text_fields, (str,)),
        **{"parameters": (dict,), "verdict": (PenetrationVerdict,), "phases": (tuple,)},
        "thrust": (MeasuredThrust, NoneType),
    }
    checked_objects: list[tuple[Any, tuple[type, ...]]] = [(run, (float, int, NoneType))]
    if run.thrust is not None:
        checked_objects.append((run.thrust, (float, int)))
    for checked_object, number_types in checked_objects:
        for field in fields(checked_object):
            value = getattr(checked_object, field.name)
            if not isinstance(value, types_by_field.get(field.name, number_types)):
                raise TypeError(f"{field.name} = {str(value)[:40]!r}: has the wrong type")
