"""The health card of an axis: figures computed from a record, compared with an earlier card.

A figure counts as changed if its 95 % confidence intervals on the two cards do not overlap.
"""

from collections.abc import Callable
from math import isfinite, sqrt
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration import SensorFigureEstimate, find_holds
from rotemina.sim.errors import IdentificationError, InputError
from rotemina.sim.identification import (
    ModelOrders,
    find_natural_modes,
    identify_oe,
    measure_loops,
    signals_from_record,
)
from rotemina.sim.messages import format_fixed, join_messages
from rotemina.sim.records import Record, Tap

# Confidence level of every interval, and the two-sided quantile of the normal distribution for it.
CONFIDENCE_LEVEL = 0.95
_NORMAL_QUANTILE = 1.96
# The model is fitted to this many rows at most, which limits the computing time.
_MAX_ROWS = 60_000
# A model with a poorer fit says nothing about the machine.
_MIN_FIT_PERCENT = 80.0
# In each row the sensor is read just before the command is output, so the reading lags by one row.
_SENSOR_LAG_ROWS = 1
# A reading has settled once it stays within this multiple of its rms noise.
_SETTLING_BAND_NOISE_RATIO = 4.0


class FigureComparison(NamedTuple):
    """A figure, the earlier figure, and whether their intervals are disjoint."""

    now: SensorFigureEstimate
    before: SensorFigureEstimate | None
    changed: bool


def compute_health_figures(record: Record, axis: str) -> tuple[SensorFigureEstimate, ...]:
    """Return the health figures of an axis from a record that excites it.

    From ``cmd`` to ``meas``:

    - static gain, resonance and damping of a fitted second-order model
    - width of the hysteresis loop relative to its stroke

    From the holds after each move:

    - settling time, until the reading stays within four times its noise
    - rms noise of the settled reading
    - repeatability: the spread of the positions at which the axis comes to rest when a set-point is
      approached repeatedly from the same side

    Raises
    ------
    IdentificationError
        If the record lacks one of these signals, or no figure can be computed from it.
    """
    for tap in (Tap.CMD, Tap.MEAS):
        if not record.has(axis, tap):
            raise IdentificationError(
                "health card: the record has no {axis}.{tap}", axis=axis, tap=tap
            )
    methods: tuple[Callable[[Record, str], list[SensorFigureEstimate]], ...] = (
        _compute_model_figures,
        _compute_hysteresis_figures,
        _compute_hold_figures,
    )
    figures: list[SensorFigureEstimate] = []
    reasons = []
    for method in methods:
        try:
            figures += method(record, axis)
        except InputError as error:
            reasons.append(str(error))
    if not figures:
        raise IdentificationError(
            "health card: the record gives no figure of {axis}: {names}",
            axis=axis,
            names=join_messages(reasons, "; "),
        )
    return tuple(figures)


def compare_cards(
    now: tuple[SensorFigureEstimate, ...], before: tuple[SensorFigureEstimate, ...]
) -> tuple[FigureComparison, ...]:
    """Compare each figure with the one of the same name and unit on an earlier card."""
    earlier_figures = {(figure.name, figure.unit): figure for figure in before}
    comparisons = []
    for figure_now in now:
        figure_before = earlier_figures.get((figure_now.name, figure_now.unit))
        has_changed = False
        if figure_before is not None:
            has_changed = (
                abs(figure_now.value - figure_before.value)
                > figure_now.half_width + figure_before.half_width
            )
        comparisons.append(FigureComparison(figure_now, figure_before, has_changed))
    return tuple(comparisons)


def _compute_model_figures(record: Record, axis: str) -> list[SensorFigureEstimate]:
    section = record.select_rows(slice(0, _MAX_ROWS))
    signals = signals_from_record(section, [(axis, Tap.CMD)], [(axis, Tap.MEAS)])
    model = identify_oe(signals, ModelOrders(2, 2, _SENSOR_LAG_ROWS))
    if model.fit_percent < _MIN_FIT_PERCENT:
        raise IdentificationError(
            "the fit of a second-order model is only {fit_percent} %",
            fit_percent=format_fixed(model.fit_percent, 0),
        )
    gain = model.transfer_function.static_gain
    figures = [
        SensorFigureEstimate("gain", gain, _NORMAL_QUANTILE * model.static_gain_deviation, "1")
    ]
    for mode in find_natural_modes(model)[:1]:
        if mode.oscillates:
            figures += [
                SensorFigureEstimate(
                    "resonance",
                    mode.frequency_hz,
                    _NORMAL_QUANTILE * mode.frequency_deviation,
                    "Hz",
                ),
                SensorFigureEstimate(
                    "damping", mode.damping_ratio, _NORMAL_QUANTILE * mode.damping_deviation, "1"
                ),
            ]
    return [figure for figure in figures if isfinite(figure.value) and isfinite(figure.half_width)]


def _compute_hysteresis_figures(record: Record, axis: str) -> list[SensorFigureEstimate]:
    command, reading = record.signal(axis, Tap.CMD), record.signal(axis, Tap.MEAS)
    widths = [
        loop.width_percent for loop in measure_loops(command, reading, lag_samples=_SENSOR_LAG_ROWS)
    ]
    return _compute_mean_figure("hysteresis width", 0.01 * np.array(widths), "1")


def _compute_hold_figures(record: Record, axis: str) -> list[SensorFigureEstimate]:
    command, reading = record.signal(axis, Tap.CMD), record.signal(axis, Tap.MEAS)
    holds = find_holds(record.time_s, command)
    if not len(holds):
        raise IdentificationError("{axis}.cmd is never held after a move", axis=axis)
    unit = record.units[axis]
    # The keys are the set-point, and whether it was approached from below.
    rest_positions: dict[tuple[float, bool], list[float]] = {}
    noises, settling_times = [], []
    for start, end in holds.tolist():
        # The second half of a hold counts as settled.
        settled_reading = reading[(start + end) // 2 : end]
        rest_position = float(settled_reading.mean())
        step = float(command[start] - command[start - 1])
        noises.append(float(settled_reading.std()))
        rest_positions.setdefault((float(command[start]), step > 0.0), []).append(rest_position)
        settling_times.append(
            _compute_settling_s(record.time_s[start:end], reading[start:end], rest_position)
        )
    figures = _compute_mean_figure("settling", np.array(settling_times), "s")
    figures += _compute_mean_figure("noise rms", np.array(noises), unit)
    return figures + _compute_repeatability(rest_positions, unit)


def _compute_settling_s(time_s: FloatArray, reading: FloatArray, rest_position: float) -> float:
    """Return the time after which the reading stays within four times its final noise."""
    half = len(reading) // 2
    band = _SETTLING_BAND_NOISE_RATIO * float(reading[half:].std())
    rows_outside = np.flatnonzero(np.abs(reading[:half] - rest_position) > band)
    return float(time_s[rows_outside[-1] + 1] - time_s[0]) if len(rows_outside) else 0.0


def _compute_mean_figure(name: str, values: FloatArray, unit: str) -> list[SensorFigureEstimate]:
    """Return the mean of the values, with its interval by Student's t.

    The list is empty if there are fewer than two values.
    """
    if len(values) < 2:
        return []
    # Imported only here, because it takes a third of a second.
    from scipy.stats import t as student

    quantile = float(student.ppf(0.5 + CONFIDENCE_LEVEL / 2.0, len(values) - 1))
    half_width = quantile * float(values.std(ddof=1)) / sqrt(len(values))
    return [SensorFigureEstimate(name, float(values.mean()), half_width, unit)]


def _compute_repeatability(
    rest_positions: dict[tuple[float, bool], list[float]], unit: str
) -> list[SensorFigureEstimate]:
    """Return the pooled spread of the rest positions at each set-point and approach direction."""
    groups = [np.array(values) for values in rest_positions.values() if len(values) > 1]
    degrees_of_freedom = sum(len(values) - 1 for values in groups)
    if degrees_of_freedom < 2:
        return []
    # Imported only here, because it takes a third of a second.
    from scipy.stats import chi2

    square_sum = sum(float(((values - values.mean()) ** 2).sum()) for values in groups)
    spread = sqrt(square_sum / degrees_of_freedom)
    quantile = float(chi2.ppf(0.5 - CONFIDENCE_LEVEL / 2.0, degrees_of_freedom))
    upper_bound = spread * sqrt(degrees_of_freedom / quantile)
    # The interval is asymmetric; its wider side, above the spread, is used for both sides.
    return [SensorFigureEstimate("repeatability", spread, upper_bound - spread, unit)]
