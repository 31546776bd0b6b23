"""Calibration of a sensor from records with a laser: model, figures, and benefit.

What it is worth is told by runs that were left out of the fit: the correction, made of the other
runs, is applied to them as a session would. One that does not make them better is refused.
"""

from dataclasses import dataclass, replace
from math import hypot, sqrt
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.approaches import approaches
from rotemina.sim.calibration.comparable_parts import Comparison
from rotemina.sim.calibration.correction import Correction
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.calibration.fitting import Fitted, chosen, fit
from rotemina.sim.calibration.interpolation import found_period
from rotemina.sim.calibration.iso230 import Positioning, positioning
from rotemina.sim.calibration.regression_columns import Run
from rotemina.sim.calibration.sensor import PLACES, SHARES, SensorModel
from rotemina.sim.calibration.zero_drift import zero_drifts
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import amount
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import PiezoAxis, Robot

RUNS = 5  # into which a single record is cut
LEAST_RUNS = 3
_LEAST_RUN_ROWS = 100
_MOST_ROWS = 60_000  # in a fit
# What the axis rings between two rows is not seen; it shifts T by 0.010 to 0.012 step²/T at zn.
_UNSEEN = 0.02
_BETTER = 0.99  # of the error before: more is no improvement


class Figure(NamedTuple):
    """A figure of a sensor with the half width of its 95 % interval, in ``unit``."""

    name: str
    value: float
    half_width: float
    unit: str


@dataclass(frozen=True, slots=True, eq=False)
class Calibration:
    """The calibration of one axis' sensor from runs.

    Attributes
    ----------
    axis, unit : of the positions, "m" or "rad".
    model : SensorModel
    travel : (low, high) of the laser in the runs, m or rad.
    figures : those of the model, with intervals.
    runs : how many there were.
    before_rms, after_rms : error of the reading at held-out runs, m or rad; before: without its
        mean, as a laser's zero is anywhere.
    before, after : (n,) the same errors over ``position`` (n,), some of the rows, m or rad.
    reading_before, reading_after : ISO 230-2 figures of the reading's error, or None.
    reached : those of where the axis went, by the laser, against its targets, or None.
    notes : what was left out, and what no calibration removes.
    """

    axis: str
    unit: str
    model: SensorModel
    travel: tuple[float, float]
    figures: tuple[Figure, ...]
    runs: int
    before_rms: float
    after_rms: float
    position: FloatArray
    before: FloatArray
    after: FloatArray
    reading_before: Positioning | None
    reading_after: Positioning | None
    reached: Positioning | None
    notes: tuple[str, ...]

    @property
    def refusal(self) -> str | None:
        """Why this calibration must not be used; None where it may."""
        if self.after_rms < _BETTER * self.before_rms:
            return None
        return message(
            "engine",
            "{axis}: in the runs left out of the fit the reading's error is {after} rms with the "
            "calibration and {before} without; the calibration is not better and is not used",
        ).fill(
            axis=self.axis,
            after=amount(self.after_rms, self.unit),
            before=amount(self.before_rms, self.unit),
        )


def calibrated(
    robot: Robot,
    comparisons: list[Comparison],
    *,
    lags: bool = True,
    absolute: bool = True,
) -> Calibration:
    """Calibrate the sensor of the axis that comparisons of one or more records are of.

    Parameters
    ----------
    robot : Robot
    comparisons : list of Comparison
        Of the same axis. Three records or more are runs by themselves, fewer are cut into five.
    lags : bool
        Whether sensor and laser are on one clock; else a lag cannot be told from the clocks.
    absolute : bool
        Whether the laser's zero is the axis'. Else the middle of the travel keeps its reading.

    Raises
    ------
    CalibrationError
        If there are too few rows.
    """
    axis = comparisons[0].axis
    bounds = robot.axes[axis].range
    runs = _runs(comparisons)
    period = 0.0
    if not isinstance(robot.axes[axis], PiezoAxis):
        smooth = fit(runs, bounds, chosen(runs, bounds, 0.0, lags))
        period = found_period(runs, [_remainder(smooth.model, run, bounds) for run in runs])
    choice = chosen(runs, bounds, period, lags)
    everywhere = np.concatenate([run.reference for run in runs])
    travel = float(everywhere.min()), float(everywhere.max())
    fitted = fit(runs, bounds, choice)
    before, after = _held_out(runs, fitted, travel)
    if period:  # and is it worth its place?
        plain = fit(runs, bounds, choice._replace(period=0.0), fitted.model.lag_s)
        held = _held_out(runs, plain, travel)
        if _rms(after) > _BETTER * _rms(held[1]):
            fitted, (before, after) = plain, held
    notes = [note for each in comparisons for note in each.losses]
    left = [_remainder(fitted.model, run, bounds) for run in runs]
    notes += zero_drifts(runs, left, robot.unit(axis) or "m")
    model = fitted.model if absolute else _kept_middle(fitted.model, travel)
    unit = robot.unit(axis) or "m"
    iso = _positionings(comparisons, model, travel)
    every = max(1, len(before) // 4000)
    return Calibration(
        axis=axis,
        unit=unit,
        model=model,
        travel=travel,
        figures=_figures(fitted, unit, runs[0].step_s),
        runs=len(runs),
        before_rms=_rms(before),
        after_rms=_rms(after),
        position=everywhere[::every],
        before=before[::every],
        after=after[::every],
        reading_before=iso[0],
        reading_after=iso[1],
        reached=iso[2],
        notes=tuple(notes),
    )


def _runs(comparisons: list[Comparison]) -> list[Run]:
    """Return the runs: records, or the equal parts of one or two."""
    parts = [part for each in comparisons for part in each.parts]
    every = max(1, sum(len(part.reading) for part in parts) // _MOST_ROWS)
    whole = [Run(part.reading, part.reference, part.step_s, every) for part in parts]
    if len(comparisons) < LEAST_RUNS:
        whole = [piece for run in whole for piece in _cut(run, RUNS)]
    whole = [run for run in whole if len(run.reading) >= _LEAST_RUN_ROWS]
    if len(whole) < LEAST_RUNS:
        raise CalibrationError(
            message(
                "engine",
                "{count} runs of {least_run_rows} rows or more; a calibration needs {least_runs}, "
                "of which each is held out once; record longer",
            ).fill(count=len(whole), least_run_rows=_LEAST_RUN_ROWS, least_runs=LEAST_RUNS)
        )
    return whole


def _cut(run: Run, count: int) -> list[Run]:
    """Return the equal parts of a run."""
    return [
        Run(run.reading[rows], run.reference[rows], run.step_s, run.every)
        for rows in np.array_split(np.arange(len(run.reading)), count)
    ]


def _remainder(model: SensorModel, run: Run, bounds: tuple[float, float]) -> FloatArray:
    """Return the error (n,) of the corrected reading of a run."""
    return _corrected(model, run, bounds) - run.reference


def _corrected(model: SensorModel, run: Run, travel: tuple[float, float]) -> FloatArray:
    times = np.arange(len(run.reading)) * run.step_s
    return Correction(model, travel).apply(np.asarray(times, dtype=np.float64), run.reading)


def _held_out(
    runs: list[Run], fitted: Fitted, travel: tuple[float, float]
) -> tuple[FloatArray, FloatArray]:
    """Return errors (n,) before and after, each run corrected by what the others tell."""
    bounds = fitted.model.low, fitted.model.high
    before, after = [], []
    for held, run in enumerate(runs):
        others = runs[:held] + runs[held + 1 :]
        zero = float(np.mean([np.mean(each.reading - each.reference) for each in others]))
        model = fit(others, bounds, fitted.choice, fitted.model.lag_s).model
        before.append(run.reading - run.reference - zero)
        after.append(_corrected(model, run, travel) - run.reference)
    return np.concatenate(before), np.concatenate(after)


def _kept_middle(model: SensorModel, travel: tuple[float, float]) -> SensorModel:
    """Return the model with the offset at which the middle of the travel is read as it is."""
    middle = np.array([0.5 * (travel[0] + travel[1])])
    error = float(model.gain_error * middle[0] + model.bent(middle)[0])
    return replace(model, offset=-error)


def _positionings(
    comparisons: list[Comparison], model: SensorModel, travel: tuple[float, float]
) -> tuple[Positioning | None, Positioning | None, Positioning | None]:
    """Return the ISO figures of the reading before and after, and of where the axis went."""
    one = comparisons[0]
    record, axis = one.record, one.axis
    if len(comparisons) > 1 or not record.has(axis, Tap.CMD):
        return None, None, None
    found = approaches(record.time_s, record.signal(axis, Tap.CMD))
    if found is None:
        return None, None, None
    reading, reference = record.signal(axis, Tap.MEAS), record.signal(axis, Tap.REF)
    corrected = Correction(model, travel).apply(record.time_s, reading)
    answers = []
    for error in (
        reading - reference,
        corrected - reference,
        reference - record.signal(axis, Tap.CMD),
    ):
        means = found.means(error, one.sound)
        kept = np.isfinite(means).all(axis=(1, 2))
        answers.append(positioning(means[kept]) if kept.any() else None)
    return answers[0], answers[1], answers[2]


def _figures(fitted: Fitted, unit: str, step_s: float) -> tuple[Figure, ...]:
    model, choice = fitted.model, fitted.choice
    figures = [
        Figure(marked("engine", "offset"), model.offset, fitted.half_width({0: 1.0}), unit),
        Figure(marked("engine", "gain error"), model.gain_error, fitted.half_width({1: 1.0}), "1"),
    ]
    at = 2
    if choice.bends:
        worst = float(PLACES[np.argmax(np.abs(model.bend_at(PLACES)))])
        weights = {at + k: (1.0 - worst**2) * worst**k for k in range(choice.bends)}
        figures.append(
            Figure(
                marked("engine", "nonlinearity"),
                model.nonlinearity,
                fitted.half_width(weights),
                unit,
            )
        )
        at += choice.bends
    if choice.hysteresis:
        span = model.high - model.low
        weights = {at + k: 2.0 * share * span for k, share in enumerate(SHARES)}
        figures.append(
            Figure(
                marked("engine", "hysteresis"), model.hysteresis, fitted.half_width(weights), unit
            )
        )
        at += len(SHARES)
    if choice.period:
        spread = sqrt(sum(fitted.half_width({at + k: 1.0}) ** 2 for k in range(4)))
        figures.append(
            Figure(marked("engine", "interpolation error"), model.interpolation, spread, unit)
        )
        figures.append(Figure(marked("engine", "its period"), model.period, float("nan"), unit))
        at += 4
    if model.lag_s:
        name = (
            marked("engine", "time constant")
            if choice.lag == "first_order"
            else marked("engine", "delay")
        )
        unseen_s = min(_UNSEEN * step_s**2 / model.lag_s, 0.05 * step_s)
        half_s = hypot(fitted.half_width({at: 1.0}), unseen_s)
        figures.append(
            Figure(message("engine", "lag, {name}").fill(name=name), model.lag_s, half_s, "s")
        )
    return tuple(figures)


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
