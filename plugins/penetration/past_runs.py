"""Logged runs as rows and in full, and the choice of those shown."""

import json
from collections.abc import Iterable
from datetime import datetime
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
    mark("Verdict"),
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
    mark("Reason for the verdict"),
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
    rows: list[tuple[str, str | None]] = [
        (tr("started at"), _way(run.start)),
        (tr("contact at"), _way(run.contact)),
        (tr("contact, as measured"), _way(run.contact_measured)),
        (tr("contact, height of the tip"), None if run.contact_height is None else _height(run)),
        (tr("contact detected after"), _ms(run.contact_delay_s)),
        (tr("in contact from the start"), _yes(run.contact_from_start)),
        (tr("noise, rms"), _nm(run.noise_rms)),
        (tr("detector's threshold"), _plain(run.threshold)),
        (tr("planned average speed"), _speed(run.planned_average_speed)),
        (tr("planned peak speed"), _speed(run.planned_peak_speed)),
        (tr("deviation of the cubics from the profile"), _nm(run.fit_error)),
    ]
    if run.thrust is not None:
        thrust = run.thrust
        rows += [
            (tr("depth"), _way(thrust.depth)),
            (tr("average speed"), _speed(thrust.average_speed)),
            (tr("peak speed"), _speed(thrust.peak_speed)),
            (tr("error against the profile"), _way(thrust.error)),
            (tr("delay removed"), _ms(thrust.delay_s)),
            (tr("samples"), f"{fixed(thrust.rate_hz, 0)} Hz"),
        ]
    rows += [
        (tr("deviation, peak"), _way(run.peak_deviation)),
        (tr("deviation, at the end"), _way(run.final_deviation)),
        (tr("membrane ruptured"), _yes(run.gave_way)),
    ]
    return [f"{name}: {text}" for name, text in rows if text is not None]


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


def _way(value: float | None) -> str | None:
    return None if value is None else way_text(value)


def _nm(value: float | None) -> str | None:
    return None if value is None else f"{fixed(1e9 * value, 1)} nm"


def _ms(value: float | None) -> str | None:
    return None if value is None else f"{fixed(1e3 * value, 1)} ms"


def _speed(value: float | None) -> str | None:
    return None if value is None else speed_text(value)


def _plain(value: float | None) -> str | None:
    return None if value is None else rounded(value, 3)


def _yes(value: bool | None) -> str | None:
    return None if value is None else tr("yes") if value else tr("no")
