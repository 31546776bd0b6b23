"""The error of an inverse's commands, and the recommendation of one."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np

from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel, Kind
from rotemina.sim.compensate.lag_and_creep import delayed
from rotemina.sim.compensate.samples import Samples
from rotemina.sim.messages import Message, joined, marked, message
from rotemina.sim.quantities import exact, percent

_ALIKE = 1.02  # residuals that differ by less are taken for the same: the simpler kind is chosen
_MODEST: frozenset[Kind] = frozenset({"prandtl_ishlinskii", "linear"})
NAMES: dict[Kind, str] = {
    "anfis": "ANFIS",
    "modified_prandtl_ishlinskii": marked("engine", "modified Prandtl–Ishlinskii"),
    "prandtl_ishlinskii": "Prandtl–Ishlinskii",
    "linear": marked("engine", "linear"),
}


@dataclass(frozen=True, slots=True)
class Residual:
    """The difference between the command of an inverse and the recorded one.

    Attributes
    ----------
    rms, worst : SI, of the command.
    aligned : rms without the mean, for records whose offset is unknown.
    share : rms over the range of the commands given.
    mse : mean square over the square of that range.
    offset : SI, mean; it is part of the others.
    beyond : share of rows whose position lay beyond what the inverse saw; they are not judged.
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


def residual(model: InverseModel, runs: Sequence[tuple[Samples, int]]) -> Residual:
    """Feed measured positions to an inverse and compare what it commands with what was commanded.

    Each of ``runs`` is gone through from its first row, and judged from the row given with it on.
    What was commanded is taken as late as the axis follows it.
    """
    apart, given, beyond = [], [], []
    low, high = model.desired_range
    # Not clamped here: the memory of rows that are judged would be that of others.
    free = replace(model, desired_range=(-np.inf, np.inf))
    for samples, first in runs:
        command = Inverse(free, samples.sample_s, preview=True).run(samples.position)
        late = model.lag_at(samples.sample_s) if model.lag_s else 0.0
        true = delayed(samples.command, late / samples.sample_s)
        apart.append((command - true)[first:])
        given.append(true[first:])
        beyond.append(((samples.position < low) | (samples.position > high))[first:])
    left, span = np.concatenate(apart), float(np.ptp(np.concatenate(given)))
    outside = np.concatenate(beyond)
    if outside.all():
        raise CompensationError(
            message(
                "engine",
                "axis {axis}: no row lies within {low} to {high}, the training range of the "
                "inverse; use such a record for the check, or train with a wider one",
            ).fill(
                axis=model.axis, low=exact(low, model.unit, size=high), high=exact(high, model.unit)
            )
        )
    left = left[~outside]
    rms = float(np.sqrt(np.mean(left**2)))
    return Residual(
        rms=rms,
        aligned=float(np.std(left)),
        worst=float(np.abs(left).max()),
        share=rms / span,
        mse=(rms / span) ** 2,
        offset=float(left.mean()),
        beyond=float(np.mean(outside)),
    )


def recommended(residuals: Mapping[Kind, Residual], *, one_size: bool) -> Kind:
    """Return the kind that leaves least; among equals the simpler one.

    ``residuals`` go from the richest kind to the simplest. Of ``one_size`` of swings the kinds with
    a bend or rules learn more than the swings tell, which rows of that size do not show.
    """
    fit = {k: one for k, one in residuals.items() if not one_size or k in _MODEST}
    least = min(one.rms for one in fit.values())
    return [kind for kind, one in fit.items() if one.rms <= _ALIKE * least][-1]


def reason(residuals: Mapping[Kind, Residual], chosen: Kind) -> Message:
    """Return why a kind was recommended."""
    others = [
        message("engine", "{kind} {share}").fill(kind=NAMES[kind], share=percent(one.share))
        for kind, one in residuals.items()
        if kind != chosen
    ]
    said = [
        message(
            "engine",
            "{kind} leaves {share} of the range on rows that no inverse was trained on; {others}.",
        ).fill(
            kind=NAMES[chosen],
            share=percent(residuals[chosen].share),
            others=joined(others, ", "),
        )
    ]
    least = min(one.rms for one in residuals.values())
    if residuals[chosen].rms > _ALIKE * least:
        said.append(
            message(
                "engine",
                "All swings have one size, so richer kinds would only guess at other sizes: "
                "train with swings that grow or fade.",
            )
        )
    elif residuals[chosen].rms > least:
        said.append(
            message("engine", "It is the simplest of those within {share} of the least.").fill(
                share=percent(_ALIKE - 1.0)
            )
        )
    return joined(said, " ")
