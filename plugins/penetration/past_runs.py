"""List of the latest runs, and texts about a run: a table row, or all details."""

import json
from collections.abc import Callable, Iterable
from datetime import datetime
from functools import partial
from typing import Any

from rotemina.app.language import translate_message
from rotemina.app.motion.penetration import PARAMETER_BOUNDS, PenetrationRun
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.parameter_quantities import QUANTITIES
from rotemina.plugins.penetration.plan_preview import UNKNOWN_TEXT, format_distance, format_speed
from rotemina.sim.messages import format_fixed, format_rounded

MAX_RUNS = 50
COLUMN_TITLES = (
    mark("Time"),
    mark("Outcome"),
    mark("Contact"),
    mark("Depth"),
    mark("Average"),
    mark("Peak"),
    mark("Error"),
    mark("Reason"),
)
COLUMN_TIPS = (
    mark("Start time of the run"),
    mark("Done, aborted by the button, failed, or held by a stop; the tip retracts unless held"),
    mark("Height of the tip at the detected contact; without a tip, position of the axis"),
    mark("Travel of the axis in the thrust, by its own sensor"),
    mark("Average speed of the thrust, measured"),
    mark("Maximum speed of the thrust, measured over five samples"),
    mark("Maximum distance from the profile, without a constant delay"),
    mark("Reason for the outcome"),
)


class PastRunList:
    """List of the latest runs, newest first.

    It holds the runs since the program start and the runs of the log file, without duplicates.
    """

    def __init__(self) -> None:
        self.runs: tuple[PenetrationRun, ...] = ()
        self._latest: PenetrationRun | None = None
        self.new_run_count = 0

    def add_logged(self, runs: Iterable[PenetrationRun]) -> None:
        """Append the runs of the log file that are not in the list."""
        known_keys = {_make_key(run) for run in self.runs}
        older = [run for run in reversed(tuple(runs)) if _make_key(run) not in known_keys]
        self.runs = (*self.runs, *older)[:MAX_RUNS]

    def add_latest(self, run: PenetrationRun | None) -> bool:
        """Insert a run at the front, and return whether it is a new one."""
        if run is None or run is self._latest:
            return False
        self._latest = run
        if _make_key(run) not in {_make_key(known_run) for known_run in self.runs}:
            self.runs = (run, *self.runs)[:MAX_RUNS]
        self.new_run_count += 1
        return True


def make_run_row(run: PenetrationRun, now: datetime) -> tuple[str, ...]:
    """Return the texts of a run in the order of :data:`COLUMN_TITLES`.

    ``now`` must have the time zone of the display.
    """
    thrust = run.thrust
    thrust_texts = (UNKNOWN_TEXT,) * 4
    if thrust is not None:
        thrust_texts = (
            format_distance(thrust.depth),
            format_speed(thrust.average_speed),
            format_speed(thrust.peak_speed),
            format_distance(thrust.error),
        )
    return (
        format_start_time(run.started, now),
        translate_message(run.verdict),
        _format_height(run),
        *thrust_texts,
        translate_message(run.reason),
    )


def format_start_time(started: str, now: datetime) -> str:
    """Return a start time in the time zone of ``now``, with its date unless that is today."""
    try:
        start_time = datetime.fromisoformat(started).astimezone(now.tzinfo)
    except (ValueError, OverflowError):
        return started
    is_today = start_time.date() == now.date()
    return f"{start_time:%H:%M:%S}" if is_today else f"{start_time:%Y-%m-%d %H:%M}"


def describe_run(run: PenetrationRun) -> str:
    """Return all details of a run, one per line."""
    lines = [
        f"{run.started}  {translate_message(run.verdict)}"
        + (f": {translate_message(run.reason)}" if run.reason else ""),
        tr("robot {robot}, driver {driver}").format(robot=run.robot, driver=run.driver),
        "",
        *(
            f"{format_fixed(time_s, 3):>8} s  {translate_message(name)}"
            for name, time_s in run.phases
        ),
        "",
        *_describe_results(run),
        "",
        *(_describe_parameter(key, value) for key, value in run.parameters.items()),
    ]
    return "\n".join(lines)


def _describe_results(run: PenetrationRun) -> list[str]:
    height = None if run.contact_height is None else _format_height(run)
    rows: list[tuple[str, Any, Callable[[Any], str]]] = [
        (tr("started at"), run.start, format_distance),
        (tr("contact at"), run.contact, format_distance),
        (tr("contact, as measured"), run.contact_measured, format_distance),
        (tr("contact, height of the tip"), height, str),
        (tr("contact detected after"), run.contact_delay_s, _format_ms),
        (tr("in contact from the start"), run.contact_from_start, _format_yes_no),
        (tr("noise, rms"), run.noise_rms, _format_nm),
        (tr("detector's threshold"), run.threshold, partial(format_rounded, digits=3)),
        (tr("planned average speed"), run.planned_average_speed, format_speed),
        (tr("planned peak speed"), run.planned_peak_speed, format_speed),
        (tr("deviation of the cubics from the profile"), run.fit_error, _format_nm),
    ]
    if run.thrust is not None:
        thrust = run.thrust
        rows += [
            (tr("depth"), thrust.depth, format_distance),
            (tr("average speed"), thrust.average_speed, format_speed),
            (tr("peak speed"), thrust.peak_speed, format_speed),
            (tr("error against the profile"), thrust.error, format_distance),
            (tr("delay removed"), thrust.delay_s, _format_ms),
            (tr("samples"), f"{format_fixed(thrust.rate_hz, 0)} Hz", str),
        ]
    rows += [
        (tr("deviation, peak"), run.peak_deviation, format_distance),
        (tr("deviation, at the end"), run.final_deviation, format_distance),
        (tr("membrane ruptured"), run.gave_way, _format_yes_no),
    ]
    return [f"{name}: {to_text(value)}" for name, value, to_text in rows if value is not None]


def _describe_parameter(key: str, value: Any) -> str:
    quantity = QUANTITIES.get(key)
    if quantity is not None and key in PARAMETER_BOUNDS and isinstance(value, int | float):
        titles = f"{_to_inline_title(quantity.group)}, {_to_inline_title(quantity.title)}"
        return f"{titles}: {quantity.format_value(value)}"
    # A table is a list if it was read from the log, or else a tuple. Their JSON is the same.
    if isinstance(value, list | tuple):
        value = json.dumps(value) if value else ""
    if isinstance(value, str):
        value = translate_message(value)
    return f"{translate_message(key.replace('_', ' '))}: {value or UNKNOWN_TEXT}"


def _to_inline_title(title: str) -> str:
    """Return a title for use within a line.

    An English title is put in lower case. A translated one may be a noun and keeps its capital.
    """
    translated = tr(title)
    return translated.lower() if translated == title else translated


def _make_key(run: PenetrationRun) -> tuple[str, str, int]:
    """Return the key that identifies a run.

    The start time is not enough: a run that was held and then retracted has two log lines.
    """
    return run.started, str(run.verdict), len(run.phases)


def _format_height(run: PenetrationRun) -> str:
    if run.contact_height is not None:
        height = run.contact_height
        return (
            f"{format_fixed(1e3 * height, 4)} mm"
            if abs(height) >= 1e-3
            else format_distance(height)
        )
    return UNKNOWN_TEXT if run.contact is None else format_distance(run.contact)


def _format_nm(value: float) -> str:
    return f"{format_fixed(1e9 * value, 1)} nm"


def _format_ms(value: float) -> str:
    return f"{format_fixed(1e3 * value, 1)} ms"


def _format_yes_no(value: bool) -> str:
    return tr("yes") if value else tr("no")
