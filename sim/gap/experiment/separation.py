"""Separation of rivals on a test, after each is fitted to the records and to the test.

A rival can adapt if the records leave its parameters open. With a step δ of its parameters, it can
absorb part of the difference to another rival's prediction, ``d = y_other - y_own``. The remaining
distance is ``min |d - S δ|² + δᵀ H δ``, with the sensitivities S of its prediction and the
information H = JᵀJ of its fit to the records, all in noise floors (optimal discrimination between
fitted models: Atkinson and Fedorov, Biometrika 62 (1975) 57-70). The means of signals are ignored.
A parameter that no record determines is uncertain by about its own size.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import load_effect
from rotemina.sim.errors import EffectError, PlantError
from rotemina.sim.gap.fit import (
    Fit,
    begun,
    bounds,
    descend,
    with_values,
)
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, Robot
from rotemina.sim.trajectory import MAX_OVERSHOOT_RATIO

# Value, in noise floors, that replaces the prediction of a rival that cannot be simulated.
_FAILED_PREDICTION_FLOORS = 1e6
# Maximum number of iterations of a fit to a test.
_MAX_FIT_STEPS = 4
# Only the closest pairs of rivals are fitted to each other.
_FITTED_PAIR_COUNT = 1

Prediction = Mapping[Tap, FloatArray]


@dataclass(frozen=True, slots=True, eq=False)
class RivalSimulator:
    """Simulates tests of an axis; ``heartbeat`` is called before every run."""

    robot: Robot
    axis: str
    heartbeat: Callable[[], None]

    def simulate(self, effects: Sequence[AxisEffect], record: Record) -> Prediction | None:
        """Return the signal of the axis at each tap (n,), SI; None if it cannot be simulated."""
        self.heartbeat()
        robot = replace(self.robot, effects=(*self.robot.effects, *effects))
        try:
            response = simulate_nominal_response(robot, record)
        except (EffectError, PlantError):
            return None
        return {
            tap: signal for (axis, tap), signal in response.signals.items() if axis == self.axis
        }

    def stays_in_range(self, prediction: Prediction) -> bool:
        """Return whether a prediction keeps the axis within its range, as a dry run requires."""
        model = self.robot.axes[self.axis]
        low, high = model.range
        position = prediction[Tap.REF]
        overshoot = max(low - float(position.min()), float(position.max()) - high)
        return overshoot <= MAX_OVERSHOOT_RATIO * model.span


@dataclass(frozen=True, slots=True, eq=False)
class AdaptableRival:
    """A rival whose prediction of a test can adapt to that of another rival.

    ``prediction`` (rows,) and its sensitivities ``slopes`` (rows, parameters) are in noise floors;
    the rows of all taps are concatenated. ``information`` (parameters, parameters) comes from the
    fit to the records. ``predict_with`` simulates other parameters.
    """

    fitted: Fit
    prediction: FloatArray
    slopes: FloatArray
    information: FloatArray
    predict_with: Callable[[FloatArray], FloatArray]

    @classmethod
    def of(
        cls,
        simulator: RivalSimulator,
        fitted: Fit,
        record: Record,
        prediction: Prediction,
        floors: Mapping[Tap, float],
    ) -> "AdaptableRival":
        """Return a fitted rival with its prediction of a test and the sensitivities."""
        own_prediction = scale_by_floors(prediction, floors)

        def predict(x: FloatArray) -> FloatArray:
            effects = with_values(fitted.effects, fitted.free, x)
            changed = simulator.simulate(effects, record)
            return (
                np.full(len(own_prediction), _FAILED_PREDICTION_FLOORS)
                if changed is None
                else scale_by_floors(changed, floors)
            )

        low, high, _ = bounds(fitted.free)
        slopes = begun(predict, fitted.x, low, high).jacobian
        return cls(fitted, own_prediction, slopes, _compute_information(fitted), predict)

    def compute_linear_distance(self, other: "AdaptableRival") -> float:
        """Return the squared distance from another's prediction to the closest one of this rival.

        The prediction of this rival is assumed to be linear in its parameters.
        """
        difference = other.prediction - self.prediction
        directions = np.linalg.qr(np.vstack([self.slopes, _compute_root(self.information)]))[0][
            : len(difference)
        ]
        return max(float(difference @ difference - np.sum((directions.T @ difference) ** 2)), 0.0)

    def compute_fitted_distance(self, other: "AdaptableRival") -> float:
        """Return the same squared distance, with this rival fitted to the other's prediction."""
        root = _compute_root(self.information)
        low, high, _ = bounds(self.fitted.free)
        start = self.fitted.x

        def residual(x: FloatArray) -> FloatArray:
            return np.concatenate([self.predict_with(x) - other.prediction, root @ (x - start)])

        fit = descend(residual, begun(residual, start, low, high), low, high, _MAX_FIT_STEPS)
        return float(fit.residual @ fit.residual)


def _compute_information(fitted: Fit) -> FloatArray:
    """Return the information of the records on the parameters, scaled by the cost of the fit."""
    information = fitted.jacobian.T @ fitted.jacobian / max(fitted.cost, 1.0)
    for column, free_parameter in enumerate(fitted.free):
        effect = load_effect(fitted.effects[free_parameter.effect].id)
        if free_parameter.name in effect.identification.of_the_record:
            information[column, :] = information[:, column] = 0.0
    return np.asarray(information + np.diag(1.0 / np.maximum(1.0, np.abs(fitted.x)) ** 2))


def _compute_root(information: FloatArray) -> FloatArray:
    """Return R (parameters, parameters) such that RᵀR is the information, which may be singular."""
    scales = np.sqrt(np.diag(information))
    eigenvalues, eigenvectors = np.linalg.eigh(information / np.outer(scales, scales))
    return np.asarray(np.sqrt(np.maximum(eigenvalues, 0.0))[:, None] * eigenvectors.T * scales)


def compute_linear_separation(rivals: Sequence[AdaptableRival], rows: int) -> float:
    """Return the rms difference, in floors, of the closest two rivals after linear adaptation."""
    return float(np.sqrt(_sort_pairs(rivals)[0][0] / rows))


def compute_fitted_separation(rivals: Sequence[AdaptableRival], rows: int) -> float:
    """Return the same rms, but with the closest two rivals fitted to each other."""
    pairs = _sort_pairs(rivals)
    distances = [
        max(first.compute_fitted_distance(second), second.compute_fitted_distance(first))
        for _, first, second in pairs[:_FITTED_PAIR_COUNT]
    ]
    return float(
        np.sqrt(
            min([*distances, *(distance for distance, _, _ in pairs[_FITTED_PAIR_COUNT:])]) / rows
        )
    )


def find_close_rivals(rivals: Sequence[AdaptableRival], rows: int, min_floors: float) -> list[int]:
    """Return the indices of the rivals that are closer than ``min_floors`` to another one."""
    close_ids = {
        id(rival)
        for distance, first, second in _sort_pairs(rivals)
        if distance < min_floors**2 * rows
        for rival in (first, second)
    }
    return [index for index, rival in enumerate(rivals) if id(rival) in close_ids]


def _sort_pairs(
    rivals: Sequence[AdaptableRival],
) -> list[tuple[float, AdaptableRival, AdaptableRival]]:
    """Return the squared distance of each pair of rivals and the pair, closest pair first.

    If one rival can imitate the other but not vice versa, the test is still decisive, because the
    simpler rival is preferred if both fit equally well. Therefore the larger distance counts.
    """
    pairs = [
        (
            max(first.compute_linear_distance(second), second.compute_linear_distance(first)),
            first,
            second,
        )
        for first, second in combinations(rivals, 2)
    ]
    return sorted(pairs, key=lambda pair: pair[0])


def compute_fixed_separation(predictions: Sequence[FloatArray], rows: int) -> float:
    """Return the rms difference, in floors, of the closest two predictions, without adaptation."""
    pairs = combinations(predictions, 2)
    return float(
        np.sqrt(min(float(np.sum((first - second) ** 2)) for first, second in pairs) / rows)
    )


def scale_by_floors(prediction: Prediction, floors: Mapping[Tap, float]) -> FloatArray:
    """Return the signals of the taps in ``floors``, in floors, without means, concatenated."""
    return np.concatenate([(prediction[t] - prediction[t].mean()) / floors[t] for t in floors])
