"""A diagnosis as a JSON document, ``rotemina-diagnosis 1``.

Values are SI. A number that is not finite is written as null. ``model`` contains the text of the
robot file and the fitted effects, so readers need no other file.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

from rotemina.sim.effects import AttachedEffect
from rotemina.sim.gap.location import GapPortion, LocatedGap
from rotemina.sim.gap.output.report_words import complete_unit
from rotemina.sim.gap.result import (
    AxisDiagnosis,
    Diagnosis,
    GapCause,
    GapShrinkage,
    GapVerdict,
    Interval,
    RankedCandidate,
    SuggestedExperiment,
)
from rotemina.sim.records import Tap
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import format_robot

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
        One for each suggested experiment. Without them, the ``commands`` are null.

    Raises
    ------
    RobotFileError, EffectError
        If the robot or an effect cannot be written.
    """
    axes = diagnosis.axes
    file_names: Sequence[ExperimentFiles | None] = files or [None] * len(diagnosis.experiments)
    experiments = zip(diagnosis.experiments, file_names, strict=True)
    return {
        "format": FORMAT,
        "verdict": str(diagnosis.verdict),
        "complete": diagnosis.is_complete,
        "failed": [
            {"axis": step.axis, "effects": list(step.effects), "reason": step.reason}
            for step in diagnosis.failed
        ],
        "axes": {name: str(axis.verdict) for name, axis in axes.items()},
        "where": _make_where_json(
            diagnosis.places if diagnosis.verdict is not GapVerdict.NONE else ()
        ),
        "causes": [_make_cause_json(cause, diagnosis.robot) for cause in sort_causes(diagnosis)],
        "shrinkage": [
            _make_shrinkage_json(item) for axis in axes.values() for item in axis.shrinkage
        ],
        "remainder": {
            name: _make_remainder_json(axis) for name, axis in axes.items() if axis.remainder
        },
        "offset": {name: _make_offset_json(axis) for name, axis in axes.items() if axis.offsets},
        "suspected": [
            {
                "axis": name,
                "effect": item.effect,
                "from_axis": item.from_axis,
                "probability": _to_json_number(item.probability),
                "in_model": item.in_model,
            }
            for name, axis in axes.items()
            for item in axis.suspected
        ],
        "candidates": {name: _make_candidates_json(axis) for name, axis in axes.items()},
        "next_experiments": [_make_experiment_json(axis, names) for axis, names in experiments],
        "model": _make_model_json(diagnosis),
        "remarks": {name: [str(text) for text in axis.remarks] for name, axis in axes.items()},
        "seed": diagnosis.seed,
    }


def sort_causes(diagnosis: Diagnosis) -> tuple[GapCause, ...]:
    """Return all causes, in descending order of the power they close, in squared floors."""

    def compute_closed_power(cause: GapCause) -> float:
        floor = find_floor(diagnosis.axes[cause.axis], cause.tap)
        closed_power = cause.gap_before**2 - cause.gap_after**2
        return closed_power / floor**2 if floor and isfinite(closed_power) else 0.0

    return tuple(sorted(diagnosis.causes, key=lambda cause: -compute_closed_power(cause)))


def find_floor(axis: AxisDiagnosis, tap: Tap | None = None) -> float | None:
    """Return the noise floor of an axis at a tap (by default the last), SI; None if unknown."""
    floors = [place.noise_floor for place in axis.places if tap in (None, place.tap)]
    return floors[-1] if floors else None


def compute_shares(places: Sequence[LocatedGap]) -> list[tuple[float, Interval]]:
    """Return the share of each place in the total gap above the floors, with its interval.

    The shares sum to 1. The interval of a share follows from the interval of the excess at that
    place; the excesses at other places are held constant.
    """
    total = sum(place.excess for place in places)
    result = []
    for place in places:
        other_excess = total - place.excess
        low, high = (end / (end + other_excess) for end in place.excess_interval)
        result.append((place.excess / total, (low, high)))
    return result


def _make_where_json(places: Sequence[LocatedGap]) -> list[Json]:
    return [
        {
            "axis": place.axis,
            "tap": str(place.tap),
            "stage": str(place.stage),
            "gap_rms": _to_json_number(place.gap_rms),
            "noise_floor": _to_json_number(place.noise_floor),
            "share": _to_json_number(share),
            "share_interval": _to_json_interval(interval),
            "worst_band_hz": _to_json_interval(place.worst_band_hz),
            "worst_regime": str(place.worst_regime) if place.worst_regime is not None else None,
            "excess": _to_json_number(place.excess),
            "excess_interval": _to_json_interval(place.excess_interval),
            "by_regime": {
                str(regime): {
                    "excess": _to_json_number(portion.excess),
                    **_make_portion_json(portion),
                }
                for regime, portion in place.by_regime.items()
            },
            "by_band": [
                {"band_hz": _to_json_interval(band), **_make_portion_json(portion)}
                for band, portion in place.by_band.items()
            ],
        }
        for place, (share, interval) in zip(places, compute_shares(places), strict=True)
    ]


def _make_portion_json(portion: GapPortion) -> Json:
    return {
        "share": _to_json_number(portion.share),
        "share_interval": _to_json_interval(portion.share_interval),
    }


def _make_cause_json(cause: GapCause, robot: Robot) -> Json:
    source_unit = robot.unit(cause.from_axis) if cause.from_axis is not None else None
    return {
        "axis": cause.axis,
        "effect": cause.effect,
        "stage": cause.stage,
        "tap": str(cause.tap),
        "from_axis": cause.from_axis,
        "probability": _to_json_number(cause.probability),
        "weight": _to_json_number(cause.weight),
        "ambiguous_with": list(cause.ambiguous_with),
        "gap_before": _to_json_number(cause.gap_before),
        "gap_after": _to_json_number(cause.gap_after),
        "closed": _to_json_number(cause.closed),
        "closed_interval": _to_json_interval(cause.closed_interval),
        "parameters": {
            parameter.name: _to_json_number(parameter.value) for parameter in cause.parameters
        },
        "units": {
            parameter.name: complete_unit(parameter.unit, source_unit or "")
            for parameter in cause.parameters
        },
        "formulation": cause.formulation,
        "parameter_intervals": {
            parameter.name: _to_json_interval(parameter.interval) for parameter in cause.parameters
        },
        "at_bound": {
            parameter.name: parameter.at_bound
            for parameter in cause.parameters
            if parameter.at_bound
        },
        "in_model": cause.in_model,
        "derived": {
            parameter.name: {
                "value": _to_json_number(parameter.value),
                "interval": _to_json_interval(parameter.interval),
                "unit": parameter.unit,
            }
            for parameter in cause.derived
        },
    }


def _make_shrinkage_json(shrinkage: GapShrinkage) -> Json:
    steps = [
        {
            "effect": step.effect,
            "rms": _to_json_number(step.rms),
            "shapley": _to_json_number(step.shapley),
            "axis": step.axis,
        }
        for step in shrinkage.steps
    ]
    return {
        "axis": shrinkage.axis,
        "tap": str(shrinkage.tap),
        **{
            name: _to_json_number(getattr(shrinkage, name))
            for name in ("raw", "retuned", "corrected", "floor", "ceiling", "closed")
        },
        "closed_interval": _to_json_interval(shrinkage.closed_interval),
        "steps": steps,
    }


def _make_remainder_json(axis: AxisDiagnosis) -> Json:
    assert axis.remainder is not None
    dependencies = [
        {"what": predictor, "share": _to_json_number(share)}
        for predictor, share in axis.remainder.depends_on
    ]
    return {
        "rms": _to_json_number(axis.remainder.rms),
        "share": _to_json_number(axis.remainder.share),
        "depends_on": dependencies,
    }


def _make_offset_json(axis: AxisDiagnosis) -> Json:
    return {
        str(tap): None
        if offset is None
        else {
            "value": _to_json_number(offset.value),
            "deviation": _to_json_number(offset.deviation),
        }
        for tap, offset in axis.offsets.items()
    }


def _make_candidates_json(axis: AxisDiagnosis) -> list[Json]:
    floor = find_floor(axis)

    def make_candidate_json(candidate: RankedCandidate) -> Json:
        low, high = candidate.held_out_interval
        return {
            "effect": candidate.effect,
            "probability": _to_json_number(candidate.probability),
            "held_out_rms": _to_json_number(candidate.held_out_rms * floor) if floor else None,
            "held_out_interval": _to_json_interval((low * floor, high * floor)) if floor else None,
            "from_axis": candidate.from_axis,
            "formulation": candidate.formulation,
        }

    return [make_candidate_json(candidate) for candidate in axis.ranking]


def _make_experiment_json(experiment: SuggestedExperiment, files: ExperimentFiles | None) -> Json:
    return {
        "axis": experiment.axis,
        "splits": list(experiment.splits),
        "why": str(experiment.why),
        "commands": files.commands if files is not None else None,
        "predictions": dict(files.predictions) if files is not None else {},
        "tap": str(experiment.tap),
    }


def _make_model_json(diagnosis: Diagnosis) -> Json:
    # Attaching an effect raises an error if the effect is invalid.
    for effect in diagnosis.fitted:
        AttachedEffect.of(diagnosis.robot, effect)
    return {
        "robot": format_robot(diagnosis.robot),
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


def _to_json_number(value: float | None) -> float | None:
    return float(value) if value is not None and isfinite(value) else None


def _to_json_interval(interval: Interval | None) -> list[float | None] | None:
    return None if interval is None else [_to_json_number(end) for end in interval]
