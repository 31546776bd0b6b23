"""Logged runs as rows and in full, and the choice of those shown."""

import json
from collections.abc import Callable, Iterable
from datetime import datetime
from functools import partial
from typing import Any

from rotemina.app.motion.penetration.parameters import BOUNDS
from rotemina.app.motion.penetration.run_log import PenetrationRun
from rotemina.app.shell.engine_words import spoken
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.parameter_quantities import QUANTITIES
from rotemina.plugins.penetration.plan_preview import UNKNOWN, speed_text, way_text
from rotemina.sim.quantities import fixed, rounded

MOST = 50
COLUMNS = (
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


class RunList:
    """The latest runs, the latest first; those of this start and of the file, each once."""

    def __init__(self) -> None:
        self.runs: tuple[PenetrationRun, ...] = ()
        self._latest: PenetrationRun | None = None
        self.of_this_start = 0

    def take_file(self, runs: Iterable[PenetrationRun]) -> None:
        """Put the file's runs behind those that are known."""
        known = {_key(run) for run in self.runs}
        older = [run for run in reversed(tuple(runs)) if _key(run) not in known]
        self.runs = (*self.runs, *older)[:MOST]

    def take_latest(self, run: PenetrationRun | None) -> bool:
        """Put a run in front, if it is another than the last; return whether it is."""
        if run is None or run is self._latest:
            return False
        self._latest = run
        if _key(run) not in {_key(one) for one in self.runs}:
            self.runs = (run, *self.runs)[:MOST]
        self.of_this_start += 1
        return True


def row(run: PenetrationRun, now: datetime) -> tuple[str, ...]:
    """Return a run's texts in the order of :data:`COLUMNS`; ``now`` knows its zone."""
    thrust = run.thrust
    figures = (UNKNOWN,) * 4
    if thrust is not None:
        figures = (
            way_text(thrust.depth),
            speed_text(thrust.average_speed),
            speed_text(thrust.peak_speed),
            way_text(thrust.error),
        )
    return when(run.started, now), spoken(run.verdict), _height(run), *figures, spoken(run.reason)


def when(started: str, now: datetime) -> str:
    """Return a time as the operator's clock has it; with its date unless that is today's."""
    try:
        at = datetime.fromisoformat(started).astimezone(now.tzinfo)
    except (ValueError, OverflowError):
        return started
    return f"{at:%H:%M:%S}" if at.date() == now.date() else f"{at:%Y-%m-%d %H:%M}"


def in_full(run: PenetrationRun) -> str:
    """Return all that is known of a run, a line each."""
    lines = [
        f"{run.started}  {spoken(run.verdict)}" + (f": {spoken(run.reason)}" if run.reason else ""),
        tr("robot {robot}, driver {driver}").format(robot=run.robot, driver=run.driver),
        "",
        *(f"{fixed(at, 3):>8} s  {spoken(name)}" for name, at in run.phases),
        "",
        *_found(run),
        "",
        *(_parameter(key, value) for key, value in run.parameters.items()),
    ]
    return "\n".join(lines)


def _found(run: PenetrationRun) -> list[str]:
    height = None if run.contact_height is None else _height(run)
    rows: list[tuple[str, Any, Callable[[Any], str]]] = [
        (tr("started at"), run.start, way_text),
        (tr("contact at"), run.contact, way_text),
        (tr("contact, as measured"), run.contact_measured, way_text),
        (tr("contact, height of the tip"), height, str),
        (tr("contact detected after"), run.contact_delay_s, _ms),
        (tr("in contact from the start"), run.contact_from_start, _yes),
        (tr("noise, rms"), run.noise_rms, _nm),
        (tr("detector's threshold"), run.threshold, partial(rounded, digits=3)),
        (tr("planned average speed"), run.planned_average_speed, speed_text),
        (tr("planned peak speed"), run.planned_peak_speed, speed_text),
        (tr("deviation of the cubics from the profile"), run.fit_error, _nm),
    ]
    if run.thrust is not None:
        thrust = run.thrust
        rows += [
            (tr("depth"), thrust.depth, way_text),
            (tr("average speed"), thrust.average_speed, speed_text),
            (tr("peak speed"), thrust.peak_speed, speed_text),
            (tr("error against the profile"), thrust.error, way_text),
            (tr("delay removed"), thrust.delay_s, _ms),
            (tr("samples"), f"{fixed(thrust.rate_hz, 0)} Hz", str),
        ]
    rows += [
        (tr("deviation, peak"), run.peak_deviation, way_text),
        (tr("deviation, at the end"), run.final_deviation, way_text),
        (tr("membrane ruptured"), run.gave_way, _yes),
    ]
    return [f"{name}: {said(value)}" for name, value, said in rows if value is not None]


def _parameter(key: str, value: Any) -> str:
    one = QUANTITIES.get(key)
    if one is not None and key in BOUNDS and isinstance(value, int | float):
        return f"{_inline(one.group)}, {_inline(one.title)}: {one.text(value)}"
    if isinstance(value, list | tuple):  # a table; from a file and of this start it reads alike
        value = json.dumps(value) if value else ""
    if isinstance(value, str):
        value = spoken(value)
    return f"{spoken(key.replace('_', ' '))}: {value or UNKNOWN}"


def _inline(title: str) -> str:
    """Return a title within a line: English ones lose their capitals, others may be nouns."""
    said = tr(title)
    return said.lower() if said == title else said


def _key(run: PenetrationRun) -> tuple[str, str, int]:
    """Tell runs apart: one that was held and then retracted has a line for each."""
    return run.started, str(run.verdict), len(run.phases)


def _height(run: PenetrationRun) -> str:
    if run.contact_height is not None:
        height = run.contact_height
        return f"{fixed(1e3 * height, 4)} mm" if abs(height) >= 1e-3 else way_text(height)
    return UNKNOWN if run.contact is None else way_text(run.contact)


def _nm(value: float) -> str:
    return f"{fixed(1e9 * value, 1)} nm"


def _ms(value: float) -> str:
    return f"{fixed(1e3 * value, 1)} ms"


def _yes(value: bool) -> str:
    return tr("yes") if value else tr("no")
