"""Three naive contestants that answer the same cases, for comparison with the diagnosis."""

from collections.abc import Mapping, Sequence
from math import log
from typing import Any

import numpy as np

from rotemina.app.blind.cases import SealedCase
from rotemina.app.blind.classifier import Classifier
from rotemina.app.blind.features import features, gap_in_floors
from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare.candidates import candidates, scouts
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import Fit, fit
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect, Robot

CONTESTANTS = {
    "best_rmse": "best in-sample RMSE",
    "bic": "BIC, baseline frozen",
    "features": "classifier on residual features",
}
_LEAST_GAP = 1.1  # in floors, above which an axis is asked about
_STEPS = 6
_FAILED = {"verdict": "failed", "causes": []}

Answer = dict[str, Any]


def contest(case: SealedCase, classifier: Classifier) -> dict[str, Answer]:
    """Return each contestant's answer to a case; if one fails, all fail."""
    try:
        robot = load_robot(case.robot)
        records = [read_record(path, robot=robot) for path in case.records]
        return naive_answers(robot, records, classifier)
    except InputError:
        return dict.fromkeys(CONTESTANTS, _FAILED)


def naive_answers(
    robot: Robot, records: Sequence[Record], classifier: Classifier
) -> dict[str, Answer]:
    """Return the answer of each contestant, in the form of a diagnosis."""
    axes = dict.fromkeys(axis for record in records for axis in record.axes)
    gaps = {axis: gap_in_floors(robot, records, axis) for axis in axes}
    asked = sorted((a for a in axes if gaps[a] > _LEAST_GAP), key=lambda axis: -gaps[axis])
    told: dict[str, list[Answer]] = {name: [] for name in CONTESTANTS}
    for axis in asked:
        evidence = Evidence.of(robot, axis, records)
        tried = scouts(evidence, candidates(evidence))
        fits = [fit(evidence, (one,), most_steps=_STEPS) for one in tried]
        told["best_rmse"].append(_named(axis, min(fits, key=lambda one: one.cost), 1.0))
        told["bic"] += _by_bic(axis, evidence, fits)
        name, probability = classifier.classify(features(robot, records, axis))
        told["features"].append(_cause(axis, name, None, probability))
    return {name: _answer(causes) for name, causes in told.items()}


def _by_bic(axis: str, evidence: Evidence, fits: Sequence[Fit]) -> list[Answer]:
    """Name the effect of the least BIC (Schwarz 1978), unless none at all has less."""
    nothing = fit(evidence, ())
    rows = len(nothing.residual)
    scores = np.array([rows * log(one.cost) + len(one.free) * log(rows) for one in fits])
    if rows * log(nothing.cost) <= scores.min():
        return []
    weights = np.exp(-0.5 * (scores - scores.min()))
    best = int(np.argmin(scores))
    return [_named(axis, fits[best], float(weights[best] / weights.sum()))]


def _named(axis: str, fitted: Fit, probability: float) -> Answer:
    effect: AxisEffect = fitted.effects[0]
    return _cause(axis, effect.id, effect.from_axis, probability)


def _cause(axis: str, effect: str, source: str | None, probability: float) -> Answer:
    return {
        "axis": axis,
        "effect": effect,
        "from_axis": source,
        "probability": probability,
        "ambiguous_with": [],
    }


def _answer(causes: Sequence[Mapping[str, Any]]) -> Answer:
    """Return an answer; a class that is a verdict becomes one."""
    verdicts = ("none", "unknown", "insufficient_excitation")
    named = [dict(cause) for cause in causes if cause["effect"] not in verdicts]
    others = [cause["effect"] for cause in causes if cause["effect"] in verdicts[1:]]
    verdict = others[0] if others else "explained" if named else "none"
    return {"verdict": verdict, "causes": named}
