"""Effects fitted to records by output error: simulate, compare, correct.

All parameters of all effects are fitted together, within their bounds, by a trust-region
least-squares method (Branch, Coleman, Li, SIAM J. Sci. Comput. 21 (1999) 1-23) on the gaps over
their noise floors. A parameter is counted in units of its size: of its preset, or of a hundredth
of its scale where that is zero.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.gap.evidence import Evidence, Signals
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.robot.model import AxisEffect

_STEP = 1e-4  # of a parameter's size, for its derivative
_LOST = 1e6  # floors by which a model that cannot be simulated is off
_SMALL_SHARE = 0.01  # of its scale, as the size of a parameter whose preset is zero
_UNBOUNDED = 1e6  # sizes up to which a parameter without a bound may go


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """Effects fitted to evidence.

    Attributes
    ----------
    effects : tuple of AxisEffect
        With the fitted parameters.
    gaps : list of mapping tap -> (n,)
        What is left of each record, over the floor.
    cost : float
        Mean square of what is left, over the records that were fitted.
    jacobian : (rows, parameters)
        Of the gaps, by parameters in units of their sizes.
    at_bound : mapping (effect number, parameter) -> "low" or "high"
        Parameters that ended at a bound.
    runs : int
        How many times all records were simulated.
    """

    effects: tuple[AxisEffect, ...]
    gaps: list[Signals]
    cost: float
    jacobian: FloatArray
    at_bound: Mapping[tuple[int, str], str]
    runs: int


@dataclass(frozen=True, slots=True)
class _Free:
    """One parameter: whose, and its bounds, size and start, SI."""

    effect: int
    name: str
    low: float
    high: float
    size: float
    start: float


def fit(
    evidence: Evidence,
    effects: Sequence[AxisEffect],
    *,
    records: Sequence[int] | None = None,
    most_steps: int = 30,
) -> Fit:
    """Fit all parameters of ``effects``, from those that they name or their presets on.

    Parameters
    ----------
    evidence : Evidence
    effects : sequence of AxisEffect
    records : sequence of int, optional
        Which records to fit; all of them by default. The gaps of all are told.
    most_steps : int
        After which the fit ends where it is.

    Raises
    ------
    EffectError
        If an effect cannot sit where it is asked to.
    """
    free = _free_parameters(evidence, effects)
    chosen = range(len(evidence.observations)) if records is None else records
    rows = sum(
        len(real) for number in chosen for real in evidence.observations[number].real.values()
    )
    runs = 0

    def residual(sizes: FloatArray) -> FloatArray:
        nonlocal runs
        runs += 1
        try:
            gaps = evidence.gaps(_with(effects, free, sizes))
        except (EffectError, PlantError):
            return np.full(rows, _LOST)
        return np.concatenate([gap for number in chosen for gap in gaps[number].values()])

    low = np.array([one.low / one.size for one in free])
    high = np.array([one.high / one.size for one in free])
    start = np.array([one.start / one.size for one in free])
    if not free:
        gaps = evidence.gaps(effects)
        left = residual(start)
        return Fit(tuple(effects), gaps, float(np.mean(left**2)), np.zeros((rows, 0)), {}, 1)
    # The method wants to begin inside; a bound itself is reached as nearly as makes no difference.
    inside = 1e-9 * np.maximum(high - low, 1.0)
    found = least_squares(
        residual,
        np.clip(start, low + inside, high - inside),
        bounds=(low, high),
        diff_step=np.full(len(free), _STEP),
        max_nfev=most_steps,
    )
    fitted = _with(effects, free, found.x)
    ends = {-1: "low", 1: "high"}
    at_bound = {
        (one.effect, one.name): ends[int(end)]
        for one, end in zip(free, found.active_mask, strict=True)
        if end != 0
    }
    cost = 2.0 * float(found.cost) / rows
    return Fit(fitted, evidence.gaps(fitted), cost, np.asarray(found.jac), at_bound, runs)


def _free_parameters(evidence: Evidence, effects: Sequence[AxisEffect]) -> list[_Free]:
    free: list[_Free] = []
    for number, asked in enumerate(effects):
        attached = Attached.of(evidence.robot, asked)
        for parameter in attached.formulation.parameters:
            low, high = parameter.bounds(attached.facts)
            preset = parameter.preset(attached.facts)
            size = abs(preset) or _SMALL_SHARE * parameter.scale(attached.facts)
            start = attached.values[parameter.name]
            free.append(
                _Free(
                    number,
                    parameter.name,
                    max(low, -_UNBOUNDED * size),
                    min(high, _UNBOUNDED * size),
                    size,
                    start,
                )
            )
    return free


def _with(
    effects: Sequence[AxisEffect], free: Sequence[_Free], sizes: FloatArray
) -> tuple[AxisEffect, ...]:
    """Return the effects with these parameters, each given in units of its size."""
    values: list[dict[str, float]] = [{} for _ in effects]
    for one, size in zip(free, sizes, strict=True):
        values[one.effect][one.name] = float(np.clip(size * one.size, one.low, one.high))
    return tuple(replace(asked, parameters=own) for asked, own in zip(effects, values, strict=True))
