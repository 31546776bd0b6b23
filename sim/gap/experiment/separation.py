"""The separation of rivals on a test, after each is fitted to the records and to the test.

A rival may adapt where the records leave its parameters open. It absorbs the difference to another
rival's prediction, ``d = y_other - y_own``, by a step δ of its parameters as far as the records
permit; the remainder is ``min |d - S δ|² + δᵀ H δ``, with the sensitivities S of its own answer and
the information H = JᵀJ of its fit to the records, all over the noise floors (optimal discrimination
between fitted models: Atkinson and Fedorov, Biometrika 62 (1975) 57-70). Constants in a signal
carry no information. A parameter that no record determines is uncertain by about its own size.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.gap.fit.descent import begun, descend
from rotemina.sim.gap.fit.output_error import Fit, bounds, with_values
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import AxisEffect, Robot
from rotemina.sim.trajectory.prediction import OVERSHOOT_SHARE

_LOST = 1e6  # floors by which a rival that cannot be simulated is off
_STEPS = 4  # of a fit to a test
_CLOSEST = 1  # pairs of rivals that are fitted to each other

Answer = Mapping[Tap, FloatArray]


@dataclass(frozen=True, slots=True, eq=False)
class Player:
    """Simulates tests of an axis of a robot; ``heartbeat`` is called before every run."""

    robot: Robot
    axis: str
    heartbeat: Callable[[], None]

    def answer(self, effects: Sequence[AxisEffect], record: Record) -> Answer | None:
        """Return the answer of the axis at each tap (n,), SI; None if it cannot be simulated."""
        self.heartbeat()
        robot = replace(self.robot, effects=(*self.robot.effects, *effects))
        try:
            response = nominal_response(robot, record)
        except (EffectError, PlantError):
            return None
        return {tap: one for (axis, tap), one in response.signals.items() if axis == self.axis}

    def stays_inside(self, answer: Answer) -> bool:
        """Tell whether an answer keeps the axis within its range, as a dry run asks for it."""
        described = self.robot.axes[self.axis]
        low, high = described.range
        position = answer[Tap.REF]
        outside = max(low - float(position.min()), float(position.max()) - high)
        return outside <= OVERSHOOT_SHARE * described.span


@dataclass(frozen=True, slots=True, eq=False)
class Yielding:
    """A rival on a test: its answer (rows,), and how far it can adapt (rows, parameters).

    Both are over the floors of some taps, one after the other; ``information`` (parameters,
    parameters) comes from the records, and ``answer_of`` answers with other parameters.
    """

    fitted: Fit
    answer: FloatArray
    slopes: FloatArray
    information: FloatArray
    answer_of: Callable[[FloatArray], FloatArray]

    @classmethod
    def of(
        cls,
        player: Player,
        fitted: Fit,
        record: Record,
        answer: Answer,
        floors: Mapping[Tap, float],
    ) -> "Yielding":
        """Find out how a fitted rival, which gave ``answer`` to a test, can give way."""
        own = over_floors(answer, floors)

        def answer_of(x: FloatArray) -> FloatArray:
            effects = with_values(fitted.effects, fitted.free, x)
            then = player.answer(effects, record)
            return np.full(len(own), _LOST) if then is None else over_floors(then, floors)

        low, high, _ = bounds(fitted.free)
        slopes = begun(answer_of, fitted.x, low, high).jacobian
        return cls(fitted, own, slopes, _information(fitted), answer_of)

    def left_of(self, other: "Yielding") -> float:
        """Return the square sum of another's answer that this rival, as if linear, keeps off."""
        apart = other.answer - self.answer
        slopes = np.linalg.qr(np.vstack([self.slopes, _root(self.information)]))[0][: len(apart)]
        return max(float(apart @ apart - np.sum((slopes.T @ apart) ** 2)), 0.0)

    def left_by_fit_of(self, other: "Yielding") -> float:
        """Return the same, found by fitting."""
        root = _root(self.information)
        low, high, _ = bounds(self.fitted.free)
        start = self.fitted.x

        def residual(x: FloatArray) -> FloatArray:
            return np.concatenate([self.answer_of(x) - other.answer, root @ (x - start)])

        found = descend(residual, begun(residual, start, low, high), low, high, _STEPS)
        return float(found.residual @ found.residual)


def _information(fitted: Fit) -> FloatArray:
    """Return the information of records on parameters, reduced by their unexplained remainder."""
    known = fitted.jacobian.T @ fitted.jacobian / max(fitted.cost, 1.0)
    for column, free in enumerate(fitted.free):
        effect = effect_named(fitted.effects[free.effect].id)
        if free.name in effect.identification.of_the_record:
            known[column, :] = known[:, column] = 0.0
    return np.asarray(known + np.diag(1.0 / np.maximum(1.0, np.abs(fitted.x)) ** 2))


def _root(information: FloatArray) -> FloatArray:
    """Return rows R (parameters, parameters) with RᵀR the information, which may be singular."""
    sizes = np.sqrt(np.diag(information))
    values, vectors = np.linalg.eigh(information / np.outer(sizes, sizes))
    return np.asarray(np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T * sizes)


def apart(rivals: Sequence[Yielding], rows: int) -> float:
    """Return the rms, in floors, by which the closest two of the rivals differ, as if linear."""
    return float(np.sqrt(_pairs(rivals)[0][0] / rows))


def apart_by_fit(rivals: Sequence[Yielding], rows: int) -> float:
    """Return the same, with the closest of them fitted indeed."""
    pairs = _pairs(rivals)
    left = [
        max(one.left_by_fit_of(other), other.left_by_fit_of(one))
        for _, one, other in pairs[:_CLOSEST]
    ]
    return float(np.sqrt(min([*left, *(far for far, _, _ in pairs[_CLOSEST:])]) / rows))


def alike(rivals: Sequence[Yielding], rows: int, least: float) -> list[int]:
    """Return the numbers of those rivals that are closer than ``least`` floors to another one."""
    close = {
        id(each)
        for left, one, other in _pairs(rivals)
        if left < least**2 * rows
        for each in (one, other)
    }
    return [number for number, one in enumerate(rivals) if id(one) in close]


def _pairs(rivals: Sequence[Yielding]) -> list[tuple[float, Yielding, Yielding]]:
    """Return pairs of rivals, closest first, with the squared sum that separates them.

    If one rival can imitate the other but not vice versa, a test decides in either case: the
    simpler one is right wherever it is as good.
    """
    pairs = [
        (max(one.left_of(other), other.left_of(one)), one, other)
        for one, other in combinations(rivals, 2)
    ]
    return sorted(pairs, key=lambda pair: pair[0])


def plainly_apart(answers: Sequence[FloatArray], rows: int) -> float:
    """Return the rms for answers (rows,) that do not give way."""
    pairs = combinations(answers, 2)
    return float(np.sqrt(min(float(np.sum((one - other) ** 2)) for one, other in pairs) / rows))


def over_floors(answer: Answer, floors: Mapping[Tap, float]) -> FloatArray:
    """Return the signals (rows,) of some taps, each without its mean and over its floor."""
    return np.concatenate([(answer[t] - answer[t].mean()) / floors[t] for t in floors])
