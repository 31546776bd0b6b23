"""Effects fitted to records by output error: simulate, compare, correct.

All parameters of all effects are fitted together, within their bounds, to the gaps over their noise
floors. A parameter is scaled by its size: its preset, or a hundredth of its scale if the preset is
zero. No effect is fitted to a frozen model: the model's own parameters may be re-tuned with it.
"""

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.effects import AttachedEffect, EffectParameter, Interval, RecordCoverage
from rotemina.sim.errors import EffectError, PlantError
from rotemina.sim.gap.fit.descent import Descent, begun, descend, exact
from rotemina.sim.gap.fit.effect_catalogue import is_stepped, is_whole_own
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.robot import AxisEffect

_LOG = logging.getLogger(__name__)

NUMERICAL = (np.linalg.LinAlgError, ArithmeticError)  # failures of a candidate, not of a diagnosis

LOST = 1e6  # floors by which a model that cannot be simulated is off
_FINITE = 1e100  # floors beyond which a model diverges
_SMALL_SHARE = 0.01  # of its scale, as the size of a parameter whose preset is zero
_UNBOUNDED = 1e6  # sizes up to which a parameter without a bound may go
_BLIND = 1e-10  # of the greatest eigenvalue, below which the records say nothing
_BLIND_SHARE = 1e-3  # of a parameter in such directions, from which it is unknown
_AT_BOUND = 1e-6  # sizes from a bound that are none


@dataclass(frozen=True, slots=True)
class Free:
    """One parameter: whose, its bounds, size and start, SI."""

    effect: int
    name: str
    low: float
    high: float
    size: float
    start: float


@dataclass(frozen=True, eq=False)
class Fit:
    """Effects fitted to evidence.

    Attributes
    ----------
    effects : tuple of AxisEffect
        With the fitted parameters.
    free : tuple of Free
        The parameters.
    x : (parameters,)
        Their values in units of their sizes.
    residual : (rows,)
        What is left of all records, over the floor.
    jacobian : (rows, parameters)
        Of the residual.
    fresh : bool
        Whether the jacobian is that of ``x``, and not carried along on the way there.
    taken_at : float
        The sum of squares where the jacobian was taken by differences.
    """

    effects: tuple[AxisEffect, ...]
    free: tuple[Free, ...]
    x: FloatArray
    residual: FloatArray
    jacobian: FloatArray
    fresh: bool = True
    taken_at: float = np.inf

    @property
    def cost(self) -> float:
        """Mean square of what is left."""
        return float(np.mean(self.residual**2))

    @property
    def parameters(self) -> int:
        """How many parameters were found, those of a grid of steps beside others included."""
        free = {one.effect for one in self.free}
        grids = (
            one
            for number, one in enumerate(self.effects)
            if is_stepped(one.id) and number not in free
        )
        return len(self.free) + sum(len(one.parameters) for one in grids)

    @property
    def at_bound(self) -> Mapping[tuple[int, str], str]:
        """Parameters (effect number, name) that ended at a bound: "low" or "high"."""
        ends: dict[tuple[int, str], str] = {}
        for one, x in zip(self.free, self.x, strict=True):
            for bound, name in ((one.low, "low"), (one.high, "high")):
                if abs(x - bound / one.size) < _AT_BOUND * max(1.0, abs(x)):
                    ends[one.effect, one.name] = name
        return ends

    @cached_property
    def basis(self) -> FloatArray:
        """Orthonormal directions (rows, directions) in which the fit can still give way."""
        ends = self.at_bound
        inner = [(one.effect, one.name) not in ends for one in self.free]
        return np.linalg.qr(self.jacobian[:, inner])[0]

    @cached_property
    def beside(self) -> FloatArray:
        """What is left (rows,) that the fit could not take away even so."""
        return np.asarray(self.residual - self.basis @ (self.basis.T @ self.residual))

    def deviation(self, numbers: IntArray) -> FloatArray:
        """Return the standard deviation (parameters,) of ``x``, infinite where nothing tells.

        Rows of one block, as ``numbers`` (rows,) count them, may err alike: the sandwich of Huber
        (5th Berkeley Symposium 1 (1967) 221-233) with scores summed over blocks.
        """
        if not self.free:
            return np.zeros(0)
        return self.deviation_along(np.eye(len(self.free)), numbers)

    def deviation_along(self, directions: FloatArray, numbers: IntArray) -> FloatArray:
        """Return the standard deviations (m,) of ``directions @ x`` for directions (m, parameters).

        They are infinite where nothing tells; a combination may be known where its parts are not.
        """
        scores = np.stack(
            [np.bincount(numbers, column * self.residual) for column in self.jacobian.T], axis=1
        )
        hessian = self.jacobian.T @ self.jacobian
        scale = np.sqrt(np.maximum(np.diag(hessian), 1e-300))
        values, vectors = np.linalg.eigh(hessian / np.outer(scale, scale))
        told = values > _BLIND * values.max(initial=0.0)
        along = directions / scale
        seen = along @ (vectors[:, told] / values[told]) @ vectors[:, told].T / scale
        blind = ((along @ vectors[:, ~told]) ** 2).sum(axis=1)
        unknown = blind > _BLIND_SHARE * (along**2).sum(axis=1)
        return np.where(unknown, np.inf, np.sqrt(((seen @ scores.T) ** 2).sum(axis=1)))


def fit(
    evidence: Evidence,
    effects: Sequence[AxisEffect],
    *,
    most_steps: int = 12,
    near: Fit | None = None,
) -> Fit:
    """Fit all parameters of ``effects``, from those that they name or their presets on.

    ``near`` is as in :func:`sketched`; with it, the fit is an attempt as in :func:`finished`.

    Raises
    ------
    EffectError
        If an effect cannot sit where it is asked to.
    """
    sketch = sketched(evidence, effects, most_steps=0, near=near)
    return finished(evidence, sketch, most_steps=most_steps, attempt=near is not None)


def sketched(
    evidence: Evidence, effects: Sequence[AxisEffect], *, most_steps: int, near: Fit | None = None
) -> Fit:
    """Return a fit after a few steps, its jacobian carried along.

    What fails numerically is lost: see :func:`lost`. ``near`` is a fit of some of the
    effects to the same evidence; its slopes are used until they lead no further.

    Raises
    ------
    EffectError
        If an effect cannot sit where it is asked to.
    """
    free = free_parameters(evidence, effects)
    if not free:
        return _unfitted(effects, residual_of(evidence, effects))
    low, high, start = bounds(free)

    def residual_at(x: FloatArray) -> FloatArray:
        return residual_of(evidence, effects, free, x)

    known = {} if near is None else _slopes_of(near, effects, free)
    try:
        at = begun(residual_at, start, low, high, known)
        found = descend(residual_at, at, low, high, most_steps)
    except NUMERICAL as error:
        return lost(evidence, effects, error)
    return _fitted(effects, free, found)


def finished(evidence: Evidence, sketch: Fit, *, most_steps: int, attempt: bool = False) -> Fit:
    """Return a fit with as many steps more as lead on, and the jacobian of where it ends.

    An ``attempt`` may keep one computed close by.
    """
    if not sketch.free:
        return sketch
    low, high, _ = bounds(sketch.free)

    def residual_at(x: FloatArray) -> FloatArray:
        return residual_of(evidence, sketch.effects, sketch.free, x)

    at = Descent(sketch.x, sketch.residual, sketch.jacobian, sketch.fresh, since=sketch.taken_at)
    try:
        at = descend(residual_at, at, low, high, most_steps)
        found = exact(residual_at, at, high, nearly=attempt)
    except NUMERICAL as error:
        return lost(evidence, sketch.effects, error)
    return _fitted(sketch.effects, sketch.free, found)


def lost(evidence: Evidence, effects: Sequence[AxisEffect], error: Exception) -> Fit:
    """Return the fit of a candidate whose numbers failed: it leaves more than any other."""
    _LOG.warning(
        "axis %s: %s is left out of the diagnosis, its fit failed: %s",
        evidence.axis,
        " + ".join(one.id for one in effects),
        error,
    )
    evidence.note_failure(effects, error)
    return _unfitted(effects, np.full(_rows(evidence), LOST))


def _unfitted(effects: Sequence[AxisEffect], residual: FloatArray) -> Fit:
    return Fit(tuple(effects), (), np.zeros(0), residual, np.zeros((len(residual), 0)))


def _fitted(effects: Sequence[AxisEffect], free: tuple[Free, ...], found: Descent) -> Fit:
    own = with_values(effects, free, found.x)
    return Fit(own, free, found.x, found.residual, found.jacobian, found.fresh, found.since)


def _slopes_of(
    near: Fit, effects: Sequence[AxisEffect], free: Sequence[Free]
) -> dict[int, FloatArray]:
    """Return the slopes (rows,) of a fit, by the number of the same parameter among others."""

    def key(own: Sequence[AxisEffect], one: Free) -> tuple[str, str | None, str | None, str]:
        asked = own[one.effect]
        return asked.id, asked.formulation, asked.from_axis, one.name

    theirs = {key(near.effects, one): column for column, one in enumerate(near.free)}
    return {
        number: near.jacobian[:, theirs[key(effects, one)]]
        for number, one in enumerate(free)
        if key(effects, one) in theirs
    }


def residual_of(
    evidence: Evidence,
    effects: Sequence[AxisEffect],
    free: Sequence[Free] = (),
    x: FloatArray | tuple[()] = (),
    only: Sequence[int] | None = None,
) -> FloatArray:
    """Return the residual (rows,) with these parameters; of a model that diverges it is large."""
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            left = evidence.residual(with_values(effects, free, x), only)
    except (EffectError, PlantError, *NUMERICAL):
        return np.full(_rows(evidence, only), LOST)
    return left if np.abs(left).max(initial=0.0) < _FINITE else np.full(len(left), LOST)


def _rows(evidence: Evidence, only: Sequence[int] | None = None) -> int:
    """Return how many rows the residual of some records has."""
    return sum(
        part.rows.stop - part.rows.start
        for part in evidence.parts
        if only is None or part.record in only
    )


def bounds(free: Sequence[Free]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return lows, highs and starts (parameters,) in units of their sizes."""
    low = np.array([one.low / one.size for one in free])
    high = np.array([one.high / one.size for one in free])
    return low, high, np.array([one.start / one.size for one in free])


def free_parameters(evidence: Evidence, effects: Sequence[AxisEffect]) -> tuple[Free, ...]:
    """Return the parameters of effects, numbered as these, but for those found by spectra.

    A grid of steps is found so, too. Beside others it stays: a slope over its jumps tells nothing.
    """
    free: list[Free] = []
    others = sum(not is_whole_own(asked.id) for asked in effects)
    for number, asked in enumerate(effects):
        attached = AttachedEffect.of(evidence.robot, asked)
        if attached.formulation.by_spectra or (is_stepped(asked.id) and others > 1):
            continue
        for parameter in attached.formulation.parameters:
            low, high = tolerance(attached, parameter, evidence.extent)
            preset = parameter.preset(attached.facts)
            scale = max(parameter.scale(attached.facts), parameter.compute_spare(attached.facts))
            size = abs(preset) or _SMALL_SHARE * scale
            free.append(
                Free(
                    number,
                    parameter.name,
                    max(low, -_UNBOUNDED * size),
                    min(high, _UNBOUNDED * size),
                    size,
                    attached.values[parameter.name],
                )
            )
    return tuple(free)


def with_values(
    effects: Sequence[AxisEffect], free: Sequence[Free], x: FloatArray | tuple[()]
) -> tuple[AxisEffect, ...]:
    """Return the effects with these parameters, each given in units of its size."""
    values: list[dict[str, float]] = [{} for _ in effects]
    for one, size in zip(free, x, strict=True):
        values[one.effect][one.name] = float(np.clip(size * one.size, one.low, one.high))
    return tuple(
        replace(asked, parameters={**asked.parameters, **own})
        for asked, own in zip(effects, values, strict=True)
    )


def tolerance(
    attached: AttachedEffect, parameter: EffectParameter, extent: RecordCoverage
) -> Interval:
    """Return the least and greatest value of a parameter that a fit to records may find, SI."""
    bounds = parameter.bounds(attached.facts)
    domain = attached.effect.identification.domain.get(parameter.name, bounds)
    if callable(domain):
        return domain(attached.values, attached.facts, bounds, extent)
    return domain
