"""Figures of step responses: rise, delay, overshoot, settling, steady-state gain."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.identification.errors import ExcitationError, IdentificationError, SettingError
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap

_LEVEL_SHARE = 0.1  # of a hold, over whose end a level is averaged
_SHORTEST_HOLD = 50  # rows; a shorter one has no level to speak of


class StepMetrics(NamedTuple):
    """One step, SI units; times count from the first row of the new command.

    None stands for what the record does not show: a threshold not crossed, or not settled before
    the last tenth of the hold. ``rise_s`` from 10 % to 90 %; ``delay_s`` to 50 %; ``peak_s`` to the
    largest excess (None without overshoot); ``overshoot_percent`` of the step of the output;
    ``settling_2_s``, ``settling_5_s`` after which the output stays within 2 % or 5 % of its step
    about its final level; ``gain`` step of the output over step of the command; ``error`` final
    output minus final command; ``noise_rms`` about the final level.
    """

    start_s: float
    command_from: float
    command_to: float
    output_from: float
    output_to: float
    gain: float
    error: float
    delay_s: float | None
    rise_s: float | None
    overshoot_percent: float
    peak_s: float | None
    settling_2_s: float | None
    settling_5_s: float | None
    noise_rms: float


def step_metrics(
    record: Record,
    axis: str,
    tap: Tap = Tap.MEAS,
    *,
    drive: Tap = Tap.CMD,
    least_step: float = 0.01,
    shortest_hold_s: float = 0.0,
) -> tuple[StepMetrics, ...]:
    """Measure every step that a command holds, at any (also non-uniform) sampling.

    A step is a jump between two holds of fifty rows or more. Levels are means over the last tenth
    of a hold; crossings are interpolated linearly between rows. Definitions follow K. Ogata,
    *Modern Control Engineering*, 5th ed., 2010, section 5-3.

    Parameters
    ----------
    record, axis, tap : the output measured.
    drive : the tap that commands the steps.
    least_step : of the command's peak-to-peak; smaller jumps are passed over.
    shortest_hold_s : steps next to a shorter hold are left out; choose a few times the time in
        which the axis settles, else levels are those of a motion that still continues.

    Raises
    ------
    IdentificationError, ExcitationError
        If a channel is missing, or the command holds no such step.
    """
    if not 0.0 < least_step <= 1.0:
        raise SettingError(
            message("engine", "least step {least_step}: not in (0, 1]; use one such as 0.01").fill(
                least_step=repr(least_step)
            )
        )
    for needed in (drive, tap):
        if not record.has(axis, needed):
            raise IdentificationError(
                message("engine", "steps: the record has no {axis}.{needed}; it has {names}").fill(
                    axis=axis, needed=needed, names=", ".join(map(str, record.columns))
                )
            )
    command, output = record.signal(axis, drive), record.signal(axis, tap)
    bounds = _holds(command, least_step * float(np.ptp(command)))
    time_s = record.time_s
    metrics = [
        _measure(time_s, command, output, begin, jump, end)
        for begin, jump, end in zip(bounds[:-2], bounds[1:-1], bounds[2:], strict=True)
        if min(jump - begin, end - jump) >= _SHORTEST_HOLD
        and min(time_s[jump] - time_s[begin], time_s[end - 1] - time_s[jump]) >= shortest_hold_s
    ]
    if not metrics:
        raise ExcitationError(
            message(
                "engine",
                "steps: {axis}.{drive} holds no jump between two holds of {shortest_hold} rows and "
                "{shortest_hold_s} s; record a staircase",
            ).fill(
                axis=axis,
                drive=drive,
                shortest_hold=_SHORTEST_HOLD,
                shortest_hold_s=shortest_hold_s,
            )
        )
    return tuple(metrics)


def _holds(command: FloatArray, least: float) -> IntArray:
    """Return the rows at which holds begin, with 0 and n; a ramp makes holds of one row."""
    jumps = np.flatnonzero(np.abs(np.diff(command)) > least) + 1
    return np.concatenate([[0], jumps, [len(command)]]).astype(np.int64)


def _measure(
    time_s: FloatArray, command: FloatArray, output: FloatArray, begin: int, jump: int, end: int
) -> StepMetrics:
    before, after = output[_last(begin, jump)], output[_last(jump, end)]
    low, high = float(before.mean()), float(after.mean())
    step, commanded = high - low, float(command[jump] - command[jump - 1])
    since = time_s[jump:end] - time_s[jump]
    # 0 at the old level, 1 at the new one, whichever way the step goes.
    course = (output[jump:end] - low) / step if step else np.zeros(end - jump)
    crossings = [_first_crossing(since, course, level) for level in (0.1, 0.5, 0.9)]
    rise = None
    if crossings[0] is not None and crossings[2] is not None:
        rise = crossings[2] - crossings[0]
    peak = int(np.argmax(course))
    over = max(float(course[peak]) - 1.0, 0.0)
    settled_by = since[-1] * (1.0 - _LEVEL_SHARE)
    return StepMetrics(
        start_s=float(time_s[jump]),
        command_from=float(command[jump - 1]),
        command_to=float(command[jump]),
        output_from=low,
        output_to=high,
        gain=step / commanded,
        error=high - float(command[jump]),
        delay_s=crossings[1],
        rise_s=rise,
        overshoot_percent=100.0 * over,
        peak_s=float(since[peak]) if over > 0 else None,
        settling_2_s=_settling(since, course, 0.02, settled_by),
        settling_5_s=_settling(since, course, 0.05, settled_by),
        noise_rms=float(after.std()),
    )


def _last(begin: int, end: int) -> slice:
    return slice(end - max(int((end - begin) * _LEVEL_SHARE), 1), end)


def _first_crossing(since: FloatArray, course: FloatArray, level: float) -> float | None:
    above = np.flatnonzero(course >= level)
    if len(above) == 0:
        return None
    row = int(above[0])
    return _between(since, course - level, row)


def _settling(since: FloatArray, course: FloatArray, band: float, latest: float) -> float | None:
    outside = np.flatnonzero(np.abs(course - 1.0) > band)
    if len(outside) == 0:
        return 0.0
    row = int(outside[-1]) + 1
    if row >= len(course) or since[row] > latest:
        return None
    return _between(since, np.abs(course - 1.0) - band, row)


def _between(since: FloatArray, excess: FloatArray, row: int) -> float:
    """Return when ``excess`` changes sign between the row before and this one."""
    if row == 0:
        return float(since[0])
    share = excess[row - 1] / (excess[row - 1] - excess[row])
    return float(since[row - 1] + share * (since[row] - since[row - 1]))
