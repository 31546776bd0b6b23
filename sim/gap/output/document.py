"""A diagnosis as a JSON document, ``rotemina-diagnosis 1``.

Values are SI; null stands for a number that is not finite. ``model`` holds the robot file as text
and the fitted effects, so readers need no other file.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.gap.diagnosis import (
    AxisDiagnosis,
    Cause,
    Diagnosis,
    Experiment,
    Interval,
    Ranked,
    Shrinkage,
    Verdict,
)
from rotemina.sim.gap.location.located_gap import LocatedGap, Portion
from rotemina.sim.gap.output.report.quantities import named_unit
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.robot.writing import robot_text

FORMAT = "rotemina-diagnosis 1"

Json = dict[str, Any]


@dataclass(frozen=True, slots=True)
class ExperimentFiles:
    """Names of the files of one suggested experiment: commands, and predictions of rivals."""

    commands: str
    predictions: Mapping[str, str]


def as_json(diagnosis: Diagnosis, files: Sequence[ExperimentFiles] = ()) -> Json:
    """Return the JSON object of a diagnosis.

    Parameters
    ----------
    diagnosis : Diagnosis
    files : sequence of ExperimentFiles
        One for each suggested experiment; without, their ``commands`` are null.

    Raises
    ------
    RobotFileError, EffectError
        If the robot or an effect cannot be written down.
    """
    axes = diagnosis.axes
    named: Sequence[ExperimentFiles | None] = files or [None] * len(diagnosis.experiments)
    suggested = zip(diagnosis.experiments, named, strict=True)
    return {
        "format": FORMAT,
        "verdict": str(diagnosis.verdict),
        "axes": {name: str(one.verdict) for name, one in axes.items()},
        "where": _where(diagnosis.places if diagnosis.verdict is not Verdict.NONE else ()),
        "causes": [_cause(cause, diagnosis.robot) for cause in ordered_causes(diagnosis)],
        "shrinkage": [_shrinkage(each) for one in axes.values() for each in one.shrinkage],
        "remainder": {name: _remainder(one) for name, one in axes.items() if one.remainder},
        "offset": {name: _offset(one) for name, one in axes.items() if one.offsets},
        "suspected": [
            {
                "axis": name,
                "effect": each.effect,
                "from_axis": each.from_axis,
                "probability": _number(each.probability),
                "in_model": each.in_model,
            }
            for name, one in axes.items()
            for each in one.suspected
        ],
        "candidates": {name: _candidates(one) for name, one in axes.items()},
        "next_experiments": [_experiment(one, names) for one, names in suggested],
        "model": _model(diagnosis),
        "remarks": {name: [str(text) for text in one.remarks] for name, one in axes.items()},
        "seed": diagnosis.seed,
    }


def ordered_causes(diagnosis: Diagnosis) -> tuple[Cause, ...]:
    """Return all causes, ordered by the gap that each closes, in squared floors of its tap."""

    def closes(cause: Cause) -> float:
        floor = floor_at(diagnosis.axes[cause.axis], cause.tap)
        gain = cause.gap_before**2 - cause.gap_after**2
        return gain / floor**2 if floor and isfinite(gain) else 0.0

    return tuple(sorted(diagnosis.causes, key=lambda cause: -closes(cause)))


def floor_at(axis: AxisDiagnosis, tap: Tap | None = None) -> float | None:
    """Return the noise floor of an axis at a tap, SI, by default at its last; None if unknown."""
    found = [place.noise_floor for place in axis.places if tap in (None, place.tap)]
    return found[-1] if found else None


def shares(places: Sequence[LocatedGap]) -> list[tuple[float, Interval]]:
    """Return the share of each place in the gap above all floors, with its interval.

    The shares sum to 1. An end of an interval is the share with the excess of this place at the end
    of its own interval, and the others unchanged.
    """
    total = sum(place.excess for place in places)
    found = []
    for place in places:
        others = total - place.excess
        low, high = (end / (end + others) for end in place.excess_interval)
        found.append((place.excess / total, (low, high)))
    return found


def _where(places: Sequence[LocatedGap]) -> list[Json]:
    return [
        {
            "axis": place.axis,
            "tap": str(place.tap),
            "stage": str(place.stage),
            "gap_rms": _number(place.gap_rms),
            "noise_floor": _number(place.noise_floor),
            "share": _number(share),
            "share_interval": _interval(interval),
            "worst_band_hz": _interval(place.worst_band_hz),
            "worst_regime": str(place.worst_regime) if place.worst_regime is not None else None,
            "excess": _number(place.excess),
            "excess_interval": _interval(place.excess_interval),
            "by_regime": {
                str(regime): {"excess": _number(one.excess), **_portion(one)}
                for regime, one in place.by_regime.items()
            },
            "by_band": [
                {"band_hz": _interval(band), **_portion(one)} for band, one in place.by_band.items()
            ],
        }
        for place, (share, interval) in zip(places, shares(places), strict=True)
    ]


def _portion(one: Portion) -> Json:
    return {"share": _number(one.share), "share_interval": _interval(one.share_interval)}


def _cause(cause: Cause, robot: Robot) -> Json:
    source_unit = robot.unit(cause.from_axis) if cause.from_axis is not None else None
    return {
        "axis": cause.axis,
        "effect": cause.effect,
        "stage": cause.stage,
        "tap": str(cause.tap),
        "from_axis": cause.from_axis,
        "probability": _number(cause.probability),
        "weight": _number(cause.weight),
        "ambiguous_with": list(cause.ambiguous_with),
        "gap_before": _number(cause.gap_before),
        "gap_after": _number(cause.gap_after),
        "closed": _number(cause.closed),
        "closed_interval": _interval(cause.closed_interval),
        "parameters": {one.name: _number(one.value) for one in cause.parameters},
        "units": {one.name: named_unit(one.unit, source_unit or "") for one in cause.parameters},
        "formulation": cause.formulation,
        "parameter_intervals": {one.name: _interval(one.interval) for one in cause.parameters},
        "at_bound": {one.name: one.at_bound for one in cause.parameters if one.at_bound},
        "in_model": cause.in_model,
        "derived": {
            one.name: {
                "value": _number(one.value),
                "interval": _interval(one.interval),
                "unit": one.unit,
            }
            for one in cause.derived
        },
    }


def _shrinkage(shrinkage: Shrinkage) -> Json:
    steps = [
        {
            "effect": step.effect,
            "rms": _number(step.rms),
            "shapley": _number(step.shapley),
            "axis": step.axis,
        }
        for step in shrinkage.steps
    ]
    return {
        "axis": shrinkage.axis,
        "tap": str(shrinkage.tap),
        **{
            name: _number(getattr(shrinkage, name))
            for name in ("raw", "retuned", "corrected", "floor", "ceiling", "closed")
        },
        "closed_interval": _interval(shrinkage.closed_interval),
        "steps": steps,
    }


def _remainder(axis: AxisDiagnosis) -> Json:
    assert axis.remainder is not None
    depends = [{"what": what, "share": _number(share)} for what, share in axis.remainder.depends_on]
    return {
        "rms": _number(axis.remainder.rms),
        "share": _number(axis.remainder.share),
        "depends_on": depends,
    }


def _offset(axis: AxisDiagnosis) -> Json:
    return {
        str(tap): None
        if one is None
        else {"value": _number(one.value), "deviation": _number(one.deviation)}
        for tap, one in axis.offsets.items()
    }


def _candidates(axis: AxisDiagnosis) -> list[Json]:
    floor = floor_at(axis)

    def in_si(one: Ranked) -> Json:
        low, high = one.held_out_interval
        return {
            "effect": one.effect,
            "probability": _number(one.probability),
            "held_out_rms": _number(one.held_out_rms * floor) if floor else None,
            "held_out_interval": _interval((low * floor, high * floor)) if floor else None,
            "from_axis": one.from_axis,
            "formulation": one.formulation,
        }

    return [in_si(one) for one in axis.ranking]


def _experiment(experiment: Experiment, files: ExperimentFiles | None) -> Json:
    return {
        "axis": experiment.axis,
        "splits": list(experiment.splits),
        "why": str(experiment.why),
        "commands": files.commands if files is not None else None,
        "predictions": dict(files.predictions) if files is not None else {},
        "tap": str(experiment.tap),
    }


def _model(diagnosis: Diagnosis) -> Json:
    for effect in diagnosis.fitted:
        Attached.of(diagnosis.robot, effect)
    return {
        "robot": robot_text(diagnosis.robot),
        "effects": [
            {
                "axis": effect.axis,
                "effect": effect.id,
                "formulation": effect.formulation,
                "from_axis": effect.from_axis,
                "parameters": {name: float(x) for name, x in effect.parameters.items()},
            }
            for effect in diagnosis.fitted
            if effect.enabled
        ],
    }


def _number(value: float | None) -> float | None:
    return float(value) if value is not None and isfinite(value) else None


def _interval(interval: Interval | None) -> list[float | None] | None:
    return None if interval is None else [_number(end) for end in interval]
