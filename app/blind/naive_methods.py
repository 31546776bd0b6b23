"""Three naive methods that answer the same cases, for comparison with the diagnosis."""

from collections.abc import Mapping, Sequence
from math import log
from typing import Any

import numpy as np

from rotemina.app.blind.cases import SealedCase
from rotemina.app.blind.classifier import ResidualClassifier
from rotemina.app.blind.features import compute_features, compute_gap_in_floors
from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare import candidates, scouts
from rotemina.sim.gap.fit import Evidence, Fit, fit
from rotemina.sim.records import Record, read_record
from rotemina.sim.robot import AxisEffect, Robot
from rotemina.sim.robot_files import load_robot

CONTESTANTS = {
    "best_rmse": "best in-sample RMSE",
    "bic": "BIC, baseline frozen",
    "features": "classifier on residual features",
}
# Axes with a smaller gap, in multiples of the noise floor, are not examined.
_MIN_GAP_IN_FLOORS = 1.1
_MAX_FIT_STEPS = 6
_FAILED_ANSWER = {"verdict": "failed", "causes": []}

NaiveAnswer = dict[str, Any]


def answer_case(case: SealedCase, classifier: ResidualClassifier) -> dict[str, NaiveAnswer]:
    """Return the answer of each method to a case; if one method fails, all fail."""
    try:
        robot = load_robot(case.robot)
        records = [read_record(path, robot=robot) for path in case.records]
        return answer_by_each_method(robot, records, classifier)
    except InputError:
        return dict.fromkeys(CONTESTANTS, _FAILED_ANSWER)


def answer_by_each_method(
    robot: Robot, records: Sequence[Record], classifier: ResidualClassifier
) -> dict[str, NaiveAnswer]:
    """Return the answer of each method, in the format of a diagnosis."""
    axes = dict.fromkeys(axis for record in records for axis in record.axes)
    gaps = {axis: compute_gap_in_floors(robot, records, axis) for axis in axes}
    examined_axes = sorted(
        (axis for axis in axes if gaps[axis] > _MIN_GAP_IN_FLOORS), key=lambda axis: -gaps[axis]
    )
    causes_by_method: dict[str, list[NaiveAnswer]] = {name: [] for name in CONTESTANTS}
    for axis in examined_axes:
        evidence = Evidence.of(robot, axis, records)
        effects = scouts(evidence, candidates(evidence))
        fits = [fit(evidence, (effect,), most_steps=_MAX_FIT_STEPS) for effect in effects]
        causes_by_method["best_rmse"].append(
            _make_cause_of_fit(axis, min(fits, key=lambda fitted: fitted.cost), 1.0)
        )
        causes_by_method["bic"] += _answer_by_bic(axis, evidence, fits)
        name, probability = classifier.classify(compute_features(robot, records, axis))
        causes_by_method["features"].append(_make_cause(axis, name, None, probability))
    return {name: _make_answer(causes) for name, causes in causes_by_method.items()}


def _answer_by_bic(axis: str, evidence: Evidence, fits: Sequence[Fit]) -> list[NaiveAnswer]:
    """Name the effect with the lowest BIC (Schwarz 1978), unless it is lower without an effect."""
    fit_without_effect = fit(evidence, ())
    rows = len(fit_without_effect.residual)
    bic_values = np.array(
        [rows * log(fitted.cost) + len(fitted.free) * log(rows) for fitted in fits]
    )
    if rows * log(fit_without_effect.cost) <= bic_values.min():
        return []
    weights = np.exp(-0.5 * (bic_values - bic_values.min()))
    best = int(np.argmin(bic_values))
    return [_make_cause_of_fit(axis, fits[best], float(weights[best] / weights.sum()))]


def _make_cause_of_fit(axis: str, fitted: Fit, probability: float) -> NaiveAnswer:
    effect: AxisEffect = fitted.effects[0]
    return _make_cause(axis, effect.id, effect.from_axis, probability)


def _make_cause(axis: str, effect: str, from_axis: str | None, probability: float) -> NaiveAnswer:
    return {
        "axis": axis,
        "effect": effect,
        "from_axis": from_axis,
        "probability": probability,
        "ambiguous_with": [],
    }


def _make_answer(causes: Sequence[Mapping[str, Any]]) -> NaiveAnswer:
    """Return an answer; a cause such as ``unknown``, which is really a verdict, becomes it."""
    verdicts = ("none", "unknown", "insufficient_excitation")
    named = [dict(cause) for cause in causes if cause["effect"] not in verdicts]
    verdict_causes = [cause["effect"] for cause in causes if cause["effect"] in verdicts[1:]]
    verdict = verdict_causes[0] if verdict_causes else "explained" if named else "none"
    return {"verdict": verdict, "causes": named}
