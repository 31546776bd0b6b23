"""How far rivals stay apart on a test, once each is fitted to the records and to the test as well.

A rival may give way where the records leave its parameters open. It explains what another says of
a test, ``d = y_other - y_own``, by a step δ of its parameters as far as the records let it: what
stays is ``min |d - S δ|² + δᵀ H δ``, with the sensitivities S of its own answer and the
information H = JᵀJ of its fit to the records, all over the noise floors (optimal discrimination
between fitted models: Atkinson and Fedorov, Biometrika 62 (1975) 57-70). What is constant in a
signal says nothing.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.gap.fit import Fit, with_values
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import AxisEffect, Robot
from rotemina.sim.trajectory.prediction import OVERSHOOT_SHARE

_STEP = 1e-2  # of a parameter, for its sensitivity
_LOOSE = 1.0  # of itself and its size: by how much a parameter may be off that no record tells

Answer = Mapping[Tap, FloatArray]


@dataclass(frozen=True, slots=True, eq=False)
class Player:
    """Simulates tests of an axis of a robot; ``heartbeat`` is called before every run."""

    robot: Robot
    axis: str
    heartbeat: Callable[[], None]

    def answer(self, effects: Sequence[AxisEffect], record: Record) -> Answer | None:
        """Return what the axis answers at each tap (n,), SI; None where it cannot be simulated."""
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
    """A rival on a test: what it answers (rows,), and how that can give way (rows, parameters).

    Over the floors of some taps, one after the other; ``information`` (parameters, parameters) is
    what the records say of its parameters.
    """

    answer: FloatArray
    slopes: FloatArray
    information: FloatArray

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
        slopes = np.zeros((len(own), len(fitted.free)))
        for column, free in enumerate(fitted.free):
            step = _STEP * max(1.0, abs(fitted.x[column]))
            if (fitted.x[column] + step) * free.size > free.high:
                step = -step
            aside = fitted.x.copy()
            aside[column] += step
            then = player.answer(with_values(fitted.effects, fitted.free, aside), record)
            if then is not None:
                slopes[:, column] = (over_floors(then, floors) - own) / step
        loose = 1.0 / (_LOOSE * np.maximum(1.0, np.abs(fitted.x))) ** 2
        # What the records leave unexplained makes them say less of the parameters.
        known = fitted.jacobian.T @ fitted.jacobian / max(fitted.cost, 1.0)
        return cls(own, slopes, known + np.diag(loose))

    def left_of(self, other: "Yielding") -> float:
        """Return the square sum of another's answer that this rival cannot explain."""
        apart = other.answer - self.answer
        along = self.slopes.T @ apart
        step = np.linalg.solve(self.slopes.T @ self.slopes + self.information, along)
        return max(float(apart @ apart - along @ step), 0.0)


def apart(rivals: Sequence[Yielding], rows: int) -> float:
    """Return the rms, in floors, by which the closest two of the rivals differ on a test."""
    return float(np.sqrt(min(one.left_of(other) for one, other in permutations(rivals, 2)) / rows))


def alike(rivals: Sequence[Yielding], rows: int, least: float) -> list[int]:
    """Return the numbers of those rivals that are closer than ``least`` floors to another one."""
    close = {
        number
        for pair in permutations(range(len(rivals)), 2)
        if rivals[pair[0]].left_of(rivals[pair[1]]) < least**2 * rows
        for number in pair
    }
    return sorted(close)


def plainly_apart(answers: Sequence[FloatArray], rows: int) -> float:
    """Return the same for answers (rows,) that do not give way."""
    pairs = permutations(answers, 2)
    return float(np.sqrt(min(float(np.sum((one - other) ** 2)) for one, other in pairs) / rows))


def over_floors(answer: Answer, floors: Mapping[Tap, float]) -> FloatArray:
    """Return the signals (rows,) of some taps, each without its mean and over its floor."""
    return np.concatenate([(answer[t] - answer[t].mean()) / floors[t] for t in floors])
