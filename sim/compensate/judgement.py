"""The residual of an inverse's commands, and the recommendation of a kind of inverse."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np

from rotemina.sim.compensate.inverse import Inverse
from rotemina.sim.compensate.inverse_parameters import InverseKind, InverseModel
from rotemina.sim.compensate.lag_and_creep import delay_rows
from rotemina.sim.compensate.samples import TrainingSamples
from rotemina.sim.errors import CompensationError
from rotemina.sim.messages import (
    Message,
    join_messages,
    marked,
    message,
)
from rotemina.sim.units import format_exact, format_percent

# Residuals within this ratio count as equal, and the simplest kind is recommended.
_MAX_EQUAL_RATIO = 1.02
_SIMPLE_KINDS: frozenset[InverseKind] = frozenset({"prandtl_ishlinskii", "linear"})
KIND_NAMES: dict[InverseKind, str] = {
    "anfis": "ANFIS",
    "modified_prandtl_ishlinskii": marked("engine", "modified Prandtl–Ishlinskii"),
    "prandtl_ishlinskii": "Prandtl–Ishlinskii",
    "linear": marked("engine", "linear"),
}


@dataclass(frozen=True, slots=True)
class InverseResidual:
    """The difference between the commands of an inverse and the recorded commands.

    Attributes
    ----------
    rms, worst : rms and largest absolute difference, SI.
    aligned : rms after the mean is subtracted, for records with an unknown offset.
    share : rms divided by the range of the recorded commands.
    mse : mean square divided by the square of that range.
    offset : mean difference, SI. All figures except ``aligned`` include it.
    beyond : share of rows outside the training range of the inverse, which are not judged.
    """

    rms: float
    aligned: float
    worst: float
    share: float
    mse: float
    offset: float
    beyond: float

    def as_json(self) -> dict[str, float]:
        """Return the figures by name."""
        return asdict(self)


def compute_residual(
    model: InverseModel, runs: Sequence[tuple[TrainingSamples, int]]
) -> InverseResidual:
    """Feed measured positions to an inverse and compare its commands with the recorded ones.

    Each run is simulated from its first row, but only the rows from its given row on are judged.
    The recorded commands are delayed by the lag of the axis.
    """
    differences, recorded, outside_parts = [], [], []
    low, high = model.desired_range
    # Positions are not clamped here, because that would change the history of the judged rows.
    unclamped_model = replace(model, desired_range=(-np.inf, np.inf))
    for samples, first_row in runs:
        command = Inverse(unclamped_model, samples.sample_s, preview=True).run(samples.position)
        lag_s = model.lag_at(samples.sample_s) if model.lag_s else 0.0
        delayed_command = delay_rows(samples.command, lag_s / samples.sample_s)
        differences.append((command - delayed_command)[first_row:])
        recorded.append(delayed_command[first_row:])
        outside_parts.append(((samples.position < low) | (samples.position > high))[first_row:])
    errors, recorded_range = np.concatenate(differences), float(np.ptp(np.concatenate(recorded)))
    is_outside = np.concatenate(outside_parts)
    if is_outside.all():
        raise CompensationError(
            "axis {axis}: no row lies within {low} to {high}, the training range of the "
            "inverse; use such a record for the check, or train with a wider one",
            axis=model.axis,
            low=format_exact(low, model.unit, size=high),
            high=format_exact(high, model.unit),
        )
    errors = errors[~is_outside]
    rms = float(np.sqrt(np.mean(errors**2)))
    return InverseResidual(
        rms=rms,
        aligned=float(np.std(errors)),
        worst=float(np.abs(errors).max()),
        share=rms / recorded_range,
        mse=(rms / recorded_range) ** 2,
        offset=float(errors.mean()),
        beyond=float(np.mean(is_outside)),
    )


def recommend_kind(
    residuals: Mapping[InverseKind, InverseResidual], *, one_size: bool
) -> InverseKind:
    """Return the kind with the smallest residual, or the simplest one among equals.

    ``residuals`` go from the richest kind to the simplest. If the swings have only
    ``one_size``, the kinds with a bend or several rules are left out: they adapt to that size,
    and rows of the same size do not reveal it.
    """
    candidates = {
        kind: residual
        for kind, residual in residuals.items()
        if not one_size or kind in _SIMPLE_KINDS
    }
    smallest = min(residual.rms for residual in candidates.values())
    return [
        kind for kind, residual in candidates.items() if residual.rms <= _MAX_EQUAL_RATIO * smallest
    ][-1]


def explain_recommendation(
    residuals: Mapping[InverseKind, InverseResidual], chosen: InverseKind
) -> Message:
    """Return the reason for a recommendation."""
    others = [
        message("engine", "{kind} {share}").fill(
            kind=KIND_NAMES[kind], share=format_percent(residual.share)
        )
        for kind, residual in residuals.items()
        if kind != chosen
    ]
    sentences = [
        message(
            "engine",
            "{kind} leaves {share} of the range on rows that no inverse was trained on; {others}.",
        ).fill(
            kind=KIND_NAMES[chosen],
            share=format_percent(residuals[chosen].share),
            others=join_messages(others, ", "),
        )
    ]
    smallest = min(residual.rms for residual in residuals.values())
    if residuals[chosen].rms > _MAX_EQUAL_RATIO * smallest:
        sentences.append(
            message(
                "engine",
                "All swings have one size, so richer kinds would only guess at other sizes: "
                "train with swings that grow or fade.",
            )
        )
    elif residuals[chosen].rms > smallest:
        sentences.append(
            message(
                "engine",
                "It is the simplest kind whose residual is within {share} of the smallest.",
            ).fill(share=format_percent(_MAX_EQUAL_RATIO - 1.0))
        )
    return join_messages(sentences, " ")
