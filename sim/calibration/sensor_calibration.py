"""Calibration of a sensor from records with a laser: model, figures, and benefit.

Held-out runs measure the benefit: each run is corrected with a model fitted to the other runs, as
in a later session. A calibration that does not reduce their error is refused.
"""

from dataclasses import dataclass, replace
from math import hypot, sqrt
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.approaches import find_approaches
from rotemina.sim.calibration.comparable_parts import SensorComparison
from rotemina.sim.calibration.correction import ReadingCorrection
from rotemina.sim.calibration.fitting import FittedSensorModel, choose_structure, fit
from rotemina.sim.calibration.interpolation import find_period
from rotemina.sim.calibration.iso230 import PositioningFigures, compute_positioning
from rotemina.sim.calibration.regression_columns import SensorRun
from rotemina.sim.calibration.sensor import BEND_PLACES, STOP_RADIUS_SHARES, SensorModel
from rotemina.sim.calibration.zero_drift import find_zero_drift
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.messages import marked, message
from rotemina.sim.records import Tap
from rotemina.sim.robot import PiezoAxis, Robot
from rotemina.sim.units import format_quantity

RUNS_PER_RECORD = 5
MIN_RUNS = 3
_MIN_RUN_ROWS = 100
_MAX_FIT_ROWS = 60_000
# Oscillations between two rows are not recorded. For axis zn they shift T by 0.010 to
# 0.012 step²/T.
_UNRECORDED_LAG_FACTOR = 0.02
# The error after the calibration must be below this share of the error before.
_MAX_ERROR_RATIO = 0.99


class SensorFigureEstimate(NamedTuple):
    """A figure of a sensor with the half width of its 95 % interval, in ``unit``."""

    name: str
    value: float
    half_width: float
    unit: str


@dataclass(frozen=True, slots=True, eq=False)
class SensorCalibration:
    """The calibration of one axis' sensor from runs.

    Attributes
    ----------
    axis, unit : axis, and unit of the positions, "m" or "rad".
    model : SensorModel
    travel : (low, high) of the laser in the runs, m or rad.
    figures : of the model, with intervals.
    runs : number of runs.
    before_rms, after_rms : error of the reading in held-out runs, m or rad. The error before is
        without its mean, because the zero of a laser is arbitrary.
    position : (n,) of some of the rows, m or rad.
    before, after : (n,) the same errors at ``position``, m or rad.
    reading_before, reading_after : ISO 230-2 figures of the reading's error, or None.
    reached : ISO 230-2 figures of the laser's positions against the targets, or None.
    notes : about rows that were left out, and errors that no calibration removes.
    """

    axis: str
    unit: str
    model: SensorModel
    travel: tuple[float, float]
    figures: tuple[SensorFigureEstimate, ...]
    runs: int
    before_rms: float
    after_rms: float
    position: FloatArray
    before: FloatArray
    after: FloatArray
    reading_before: PositioningFigures | None
    reading_after: PositioningFigures | None
    reached: PositioningFigures | None
    notes: tuple[str, ...]

    @property
    def refusal(self) -> str | None:
        """The reason why this calibration must not be used, or None."""
        if self.after_rms < _MAX_ERROR_RATIO * self.before_rms:
            return None
        return message(
            "engine",
            "{axis}: in the runs left out of the fit the reading's error is {after} rms with the "
            "calibration and {before} without; the calibration is not better and is not used",
        ).fill(
            axis=self.axis,
            after=format_quantity(self.after_rms, self.unit),
            before=format_quantity(self.before_rms, self.unit),
        )


def calibrate_sensor(
    robot: Robot,
    comparisons: list[SensorComparison],
    *,
    has_common_clock: bool = True,
    absolute: bool = True,
) -> SensorCalibration:
    """Calibrate the sensor of an axis from one or more comparisons.

    Parameters
    ----------
    robot : Robot
    comparisons : list of SensorComparison
        Of the same axis. Three or more records count as one run each. One or two records are cut
        into five runs each.
    lags : bool
        Whether sensor and laser have the same clock. Otherwise a lag cannot be separated from the
        difference of the clocks.
    absolute : bool
        Whether the laser's zero is that of the axis. Otherwise the middle of the travel keeps its
        reading.

    Raises
    ------
    SensorCalibrationError
        If there are too few rows.
    """
    axis = comparisons[0].axis
    bounds = robot.axes[axis].range
    runs = _make_runs(comparisons)
    period = 0.0
    if not isinstance(robot.axes[axis], PiezoAxis):
        smooth = fit(runs, bounds, choose_structure(runs, bounds, 0.0, has_common_clock))
        period = find_period(
            runs, [_compute_remaining_error(smooth.model, run, bounds) for run in runs]
        )
    choice = choose_structure(runs, bounds, period, has_common_clock)
    positions = np.concatenate([run.reference for run in runs])
    travel = float(positions.min()), float(positions.max())
    fitted = fit(runs, bounds, choice)
    before, after = _compute_held_out_errors(runs, fitted, travel)
    # The interpolation error is kept only if it reduces the error in held-out runs.
    if period:
        without_interpolation = fit(runs, bounds, choice._replace(period=0.0), fitted.model.lag_s)
        errors_without = _compute_held_out_errors(runs, without_interpolation, travel)
        if _rms(after) > _MAX_ERROR_RATIO * _rms(errors_without[1]):
            fitted, (before, after) = without_interpolation, errors_without
    notes = [note for comparison in comparisons for note in comparison.losses]
    remainders = [_compute_remaining_error(fitted.model, run, bounds) for run in runs]
    notes += find_zero_drift(runs, remainders, robot.unit(axis) or "m")
    model = fitted.model if absolute else _keep_middle(fitted.model, travel)
    unit = robot.unit(axis) or "m"
    reading_before, reading_after, reached = _compute_positionings(comparisons, model, travel)
    stride = max(1, len(before) // 4000)
    return SensorCalibration(
        axis=axis,
        unit=unit,
        model=model,
        travel=travel,
        figures=_make_figures(fitted, unit, runs[0].step_s),
        runs=len(runs),
        before_rms=_rms(before),
        after_rms=_rms(after),
        position=positions[::stride],
        before=before[::stride],
        after=after[::stride],
        reading_before=reading_before,
        reading_after=reading_after,
        reached=reached,
        notes=tuple(notes),
    )


def _make_runs(comparisons: list[SensorComparison]) -> list[SensorRun]:
    """Return the runs: one for each record, or equal parts of one or two records."""
    parts = [part for comparison in comparisons for part in comparison.parts]
    stride = max(1, sum(len(part.reading) for part in parts) // _MAX_FIT_ROWS)
    runs = [SensorRun(part.reading, part.reference, part.step_s, stride) for part in parts]
    if len(comparisons) < MIN_RUNS:
        runs = [piece for run in runs for piece in _cut_run(run, RUNS_PER_RECORD)]
    runs = [run for run in runs if len(run.reading) >= _MIN_RUN_ROWS]
    if len(runs) < MIN_RUNS:
        raise SensorCalibrationError(
            "only {count} runs have {least_run_rows} rows or more; a calibration needs "
            "{least_runs}, because each run is held out once; make a longer record",
            count=len(runs),
            least_run_rows=_MIN_RUN_ROWS,
            least_runs=MIN_RUNS,
        )
    return runs


def _cut_run(run: SensorRun, count: int) -> list[SensorRun]:
    return [
        SensorRun(run.reading[rows], run.reference[rows], run.step_s, run.stride)
        for rows in np.array_split(np.arange(len(run.reading)), count)
    ]


def _compute_remaining_error(
    model: SensorModel, run: SensorRun, bounds: tuple[float, float]
) -> FloatArray:
    return _correct_run(model, run, bounds) - run.reference


def _correct_run(model: SensorModel, run: SensorRun, travel: tuple[float, float]) -> FloatArray:
    times = np.arange(len(run.reading)) * run.step_s
    return ReadingCorrection(model, travel).apply(np.asarray(times, dtype=np.float64), run.reading)


def _compute_held_out_errors(
    runs: list[SensorRun], fitted: FittedSensorModel, travel: tuple[float, float]
) -> tuple[FloatArray, FloatArray]:
    """Return errors (n,) before and after, each run corrected by a fit to the others."""
    bounds = fitted.model.low, fitted.model.high
    before, after = [], []
    for index, run in enumerate(runs):
        others = runs[:index] + runs[index + 1 :]
        mean_error = float(np.mean([np.mean(other.reading - other.reference) for other in others]))
        model = fit(others, bounds, fitted.structure, fitted.model.lag_s).model
        before.append(run.reading - run.reference - mean_error)
        after.append(_correct_run(model, run, travel) - run.reference)
    return np.concatenate(before), np.concatenate(after)


def _keep_middle(model: SensorModel, travel: tuple[float, float]) -> SensorModel:
    """Return the model with the offset that makes it exact in the middle of the travel."""
    middle = np.array([0.5 * (travel[0] + travel[1])])
    error = float(model.gain_error * middle[0] + model.compute_position_error(middle)[0])
    return replace(model, offset=-error)


def _compute_positionings(
    comparisons: list[SensorComparison], model: SensorModel, travel: tuple[float, float]
) -> tuple[PositioningFigures | None, PositioningFigures | None, PositioningFigures | None]:
    """Return ISO figures of the reading before and after, and of the reached positions."""
    comparison = comparisons[0]
    record, axis = comparison.record, comparison.axis
    if len(comparisons) > 1 or not record.has(axis, Tap.CMD):
        return None, None, None
    approaches = find_approaches(record.time_s, record.signal(axis, Tap.CMD))
    if approaches is None:
        return None, None, None
    reading, reference = record.signal(axis, Tap.MEAS), record.signal(axis, Tap.REF)
    corrected = ReadingCorrection(model, travel).apply(record.time_s, reading)
    figures = []
    for error in (
        reading - reference,
        corrected - reference,
        reference - record.signal(axis, Tap.CMD),
    ):
        means = approaches.compute_means(error, comparison.valid)
        complete = np.isfinite(means).all(axis=(1, 2))
        figures.append(compute_positioning(means[complete]) if complete.any() else None)
    return figures[0], figures[1], figures[2]


def _make_figures(
    fitted: FittedSensorModel, unit: str, step_s: float
) -> tuple[SensorFigureEstimate, ...]:
    model, choice = fitted.model, fitted.structure
    figures = [
        SensorFigureEstimate(
            marked("engine", "offset"), model.offset, fitted.compute_half_width({0: 1.0}), unit
        ),
        SensorFigureEstimate(
            marked("engine", "gain error"),
            model.gain_error,
            fitted.compute_half_width({1: 1.0}),
            "1",
        ),
    ]
    first = 2
    if choice.bends:
        worst_place = float(BEND_PLACES[np.argmax(np.abs(model.compute_bend(BEND_PLACES)))])
        weights = {first + k: (1.0 - worst_place**2) * worst_place**k for k in range(choice.bends)}
        figures.append(
            SensorFigureEstimate(
                marked("engine", "nonlinearity"),
                model.nonlinearity,
                fitted.compute_half_width(weights),
                unit,
            )
        )
        first += choice.bends
    if choice.hysteresis:
        span = model.high - model.low
        weights = {first + k: 2.0 * share * span for k, share in enumerate(STOP_RADIUS_SHARES)}
        figures.append(
            SensorFigureEstimate(
                marked("engine", "hysteresis"),
                model.hysteresis,
                fitted.compute_half_width(weights),
                unit,
            )
        )
        first += len(STOP_RADIUS_SHARES)
    if choice.period:
        half_width = sqrt(sum(fitted.compute_half_width({first + k: 1.0}) ** 2 for k in range(4)))
        figures.append(
            SensorFigureEstimate(
                marked("engine", "interpolation error"), model.interpolation, half_width, unit
            )
        )
        figures.append(
            SensorFigureEstimate(marked("engine", "its period"), model.period, float("nan"), unit)
        )
        first += 4
    if model.lag_s:
        name = (
            marked("engine", "time constant")
            if choice.lag == "first_order"
            else marked("engine", "delay")
        )
        unrecorded_s = min(_UNRECORDED_LAG_FACTOR * step_s**2 / model.lag_s, 0.05 * step_s)
        half_width_s = hypot(fitted.compute_half_width({first: 1.0}), unrecorded_s)
        figures.append(
            SensorFigureEstimate(
                message("engine", "lag, {name}").fill(name=name), model.lag_s, half_width_s, "s"
            )
        )
    return tuple(figures)


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
