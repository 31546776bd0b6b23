"""Figures of step responses: rise, delay, overshoot, settling, steady-state gain."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.errors import (
    IdentificationError,
    IdentificationSettingError,
    InsufficientExcitationError,
)
from rotemina.sim.records import Record, Tap

# The level of a hold is averaged over this final share of its rows.
_LEVEL_HOLD_RATIO = 0.1
# A hold needs at least this many rows for its level to be measured.
_MIN_HOLD_ROWS = 50


class StepMetrics(NamedTuple):
    """Figures of one step in SI units. Times count from the first row of the new command.

    A figure is None if the record does not show it: the output does not cross the threshold, or
    does not settle before the last tenth of the hold.

    Attributes
    ----------
    start_s : float
        Time of the step in the record.
    command_from, command_to, output_from, output_to : float
        Levels before and after the step.
    gain : float
        Step of the output over step of the command.
    error : float
        Final output minus final command.
    delay_s : float or None
        Time to 50 % of the step of the output.
    rise_s : float or None
        Time from 10 % to 90 %.
    overshoot_percent : float
        Overshoot as a percentage of the step of the output.
    peak_s : float or None
        Time to the largest overshoot; None without overshoot.
    settling_2_s, settling_5_s : float or None
        Time after which the output stays within 2 % or 5 % of its step from its final level.
    noise_rms : float
        RMS deviation from the final level.
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


def measure_steps(
    record: Record,
    axis: str,
    tap: Tap = Tap.MEAS,
    *,
    drive: Tap = Tap.CMD,
    min_step: float = 0.01,
    min_hold_s: float = 0.0,
) -> tuple[StepMetrics, ...]:
    """Measure every step of a command. The sampling may be non-uniform.

    A step is a jump between two holds of fifty rows or more. Levels are means over the last tenth
    of a hold; crossings are interpolated linearly between rows. Definitions follow K. Ogata,
    *Modern Control Engineering*, 5th ed., 2010, section 5-3.

    Parameters
    ----------
    record : Record
    axis : str
    tap : Tap
        The output to measure.
    drive : Tap
        The tap that commands the steps.
    min_step : float
        Smallest jump that counts as a step, as a share of the command's peak-to-peak value.
    min_hold_s : float
        Shortest hold. Steps next to a shorter one are left out. Choose a few times the settling
        time of the axis; otherwise a level may be measured while the axis still moves.

    Raises
    ------
    IdentificationSettingError
        If ``min_step`` is out of range.
    IdentificationError
        If a channel is missing.
    InsufficientExcitationError
        If the command contains no such step.
    """
    if not 0.0 < min_step <= 1.0:
        raise IdentificationSettingError(
            "minimum step {least_step}: not in (0, 1]; use a value such as 0.01",
            least_step=repr(min_step),
        )
    for required_tap in (drive, tap):
        if not record.has(axis, required_tap):
            raise IdentificationError(
                "steps: the record has no {axis}.{needed}; it has {names}",
                axis=axis,
                needed=required_tap,
                names=", ".join(map(str, record.columns)),
            )
    command, output = record.signal(axis, drive), record.signal(axis, tap)
    bounds = _find_holds(command, min_step * float(np.ptp(command)))
    time_s = record.time_s
    metrics = [
        _measure_step(time_s, command, output, begin, jump, end)
        for begin, jump, end in zip(bounds[:-2], bounds[1:-1], bounds[2:], strict=True)
        if min(jump - begin, end - jump) >= _MIN_HOLD_ROWS
        and min(time_s[jump] - time_s[begin], time_s[end - 1] - time_s[jump]) >= min_hold_s
    ]
    if not metrics:
        raise InsufficientExcitationError(
            "steps: {axis}.{drive} holds no jump between two holds of at least "
            "{shortest_hold} rows and {shortest_hold_s} s; record a staircase",
            axis=axis,
            drive=drive,
            shortest_hold=_MIN_HOLD_ROWS,
            shortest_hold_s=min_hold_s,
        )
    return tuple(metrics)


def _find_holds(command: FloatArray, min_jump: float) -> IntArray:
    """Return the first rows of holds, and n at the end. Each row of a ramp counts as one hold."""
    jumps = np.flatnonzero(np.abs(np.diff(command)) > min_jump) + 1
    return np.concatenate([[0], jumps, [len(command)]]).astype(np.int64)


def _measure_step(
    time_s: FloatArray, command: FloatArray, output: FloatArray, begin: int, jump: int, end: int
) -> StepMetrics:
    before, after = output[_select_level_rows(begin, jump)], output[_select_level_rows(jump, end)]
    low, high = float(before.mean()), float(after.mean())
    step, command_step = high - low, float(command[jump] - command[jump - 1])
    elapsed_s = time_s[jump:end] - time_s[jump]
    # The normalised response is 0 at the old level and 1 at the new one for both step directions.
    response = (output[jump:end] - low) / step if step else np.zeros(end - jump)
    crossings = [_find_first_crossing(elapsed_s, response, level) for level in (0.1, 0.5, 0.9)]
    rise_s = None
    if crossings[0] is not None and crossings[2] is not None:
        rise_s = crossings[2] - crossings[0]
    peak = int(np.argmax(response))
    overshoot = max(float(response[peak]) - 1.0, 0.0)
    latest_s = elapsed_s[-1] * (1.0 - _LEVEL_HOLD_RATIO)
    return StepMetrics(
        start_s=float(time_s[jump]),
        command_from=float(command[jump - 1]),
        command_to=float(command[jump]),
        output_from=low,
        output_to=high,
        gain=step / command_step,
        error=high - float(command[jump]),
        delay_s=crossings[1],
        rise_s=rise_s,
        overshoot_percent=100.0 * overshoot,
        peak_s=float(elapsed_s[peak]) if overshoot > 0 else None,
        settling_2_s=_find_settling_time(elapsed_s, response, 0.02, latest_s),
        settling_5_s=_find_settling_time(elapsed_s, response, 0.05, latest_s),
        noise_rms=float(after.std()),
    )


def _select_level_rows(begin: int, end: int) -> slice:
    return slice(end - max(int((end - begin) * _LEVEL_HOLD_RATIO), 1), end)


def _find_first_crossing(elapsed_s: FloatArray, response: FloatArray, level: float) -> float | None:
    above = np.flatnonzero(response >= level)
    if len(above) == 0:
        return None
    row = int(above[0])
    return _interpolate_crossing(elapsed_s, response - level, row)


def _find_settling_time(
    elapsed_s: FloatArray, response: FloatArray, band: float, latest_s: float
) -> float | None:
    outside = np.flatnonzero(np.abs(response - 1.0) > band)
    if len(outside) == 0:
        return 0.0
    row = int(outside[-1]) + 1
    if row >= len(response) or elapsed_s[row] > latest_s:
        return None
    return _interpolate_crossing(elapsed_s, np.abs(response - 1.0) - band, row)


def _interpolate_crossing(elapsed_s: FloatArray, excess: FloatArray, row: int) -> float:
    if row == 0:
        return float(elapsed_s[0])
    fraction = excess[row - 1] / (excess[row - 1] - excess[row])
    return float(elapsed_s[row - 1] + fraction * (elapsed_s[row] - elapsed_s[row - 1]))
