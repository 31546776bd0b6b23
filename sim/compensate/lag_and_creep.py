"""Lag and creep of an axis, fitted together with its hysteresis by variable projection.

What is linear in its coefficients (the stops of the position) is solved for at every trial of what
is not (Golub and Pereyra, Inverse Problems 19 (2003) R1–R26).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate import kernel
from rotemina.sim.compensate.samples import Samples
from rotemina.sim.stops import stops

PLAYS = 12
MOST_LAG = 20  # samples more than the least
_QUICKEST_S = 0.1  # what creeps faster is part of the loop
_DECADE = 10.0  # between neighbouring relaxations
_MOST_CREEP = 0.1  # of a move, by each relaxation
_ROWS = 20_000  # to find the stages on; more rows add time, not knowledge
_MOST_LOW = 0.1  # of the range, by which the low end lies off its nominal place
_LATE = 5.0  # samples more than the least
_UNEVEN = 0.03  # difference of neighbouring relaxations
_DOUBT = 1e-3  # rms, as a share, that must be gained for each of these to be believed
_SMALL = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Stages:
    """What comes after the hysteresis: lag, s, and relaxations ``(c,)`` as an inverse holds them.

    ``origin`` of the position, ``command_origin`` and ``span`` make shares of both. ``memory``
    says where plays are at the low end, in shares of their radii: 0 in their middle, as in a fresh
    material, 1 as after a long way down; ``low`` is the position there, a share.
    """

    origin: float
    command_origin: float
    span: float
    sample_s: float
    lag_s: float
    memory: float
    low: float
    creep_times_s: FloatArray
    creep_weights: FloatArray

    @property
    def initial(self) -> FloatArray:
        """States (p,) of plays of the position at the low end."""
        return self.low + self.memory * thresholds()

    def position(self, samples: Samples) -> FloatArray:
        """Return the positions (n,) without creep, shares."""
        shares = (samples.position - self.origin) / self.span
        return kernel.uncrept(self._creep(), shares)

    def command(self, samples: Samples) -> FloatArray:
        """Return the commands (n,) as late as the axis follows them, shares."""
        shares = (samples.command - self.command_origin) / self.span
        return delayed(shares, self.lag_s / self.sample_s)

    def _creep(self) -> FloatArray:
        moved = -np.expm1(-self.sample_s / self.creep_times_s)
        return np.stack([moved, self.creep_weights])


def delayed(values: FloatArray, rows: float) -> FloatArray:
    """Return ``values`` (n,) so many rows late, straight between them, the first one before."""
    places = np.arange(len(values), dtype=np.float64)
    return np.asarray(np.interp(places - rows, places, values), dtype=np.float64)


def thresholds(count: int = PLAYS) -> FloatArray:
    """Return radii of plays, shares: closer where they are small, up to half the range."""
    return 0.5 * ((np.arange(count) + 0.5) / count) ** 1.5


def find_stages(
    samples: Sequence[Samples],
    origin: float,
    command_origin: float,
    span: float,
    least_lag_s: float,
) -> Stages:
    """Find lag, memory at the low end and creep of an axis from runs at one rate."""
    sample_s = samples[0].sample_s
    longest_s = max(len(each.command) for each in samples) * sample_s
    times_s = _times(longest_s)
    least = least_lag_s / sample_s

    def of(values: FloatArray) -> Stages:
        late_s = float(values[0]) * sample_s
        shares = (origin, command_origin, span, sample_s)
        memory, low = float(values[1]), float(values[2])
        return Stages(*shares, late_s, memory, low, times_s, values[3:].copy())

    every = max(sum(len(each.command) for each in samples) // _ROWS, 1)

    def tail(values: FloatArray) -> FloatArray:
        rows, goals = _rows(of(values), samples, every)
        apart = goals - rows @ solved(rows, goals)
        odd = np.concatenate(
            [[values[2] / _MOST_LOW, (values[0] - least) / _LATE], np.diff(values[3:]) / _UNEVEN]
        )
        return np.concatenate([apart, _DOUBT * np.sqrt(len(rows)) * odd])

    start = np.concatenate([[least + 0.3, 0.5, 0.0], np.full(len(times_s), 1e-3)])
    low = np.concatenate([[least, 0.0, -_MOST_LOW], np.full(len(times_s), -0.1 * _MOST_CREEP)])
    high = np.concatenate([[least + MOST_LAG, 1.0, _MOST_LOW], np.full(len(times_s), _MOST_CREEP)])
    scale = np.concatenate([[0.3, 0.3, 0.03], np.full(len(times_s), 1e-2)])
    found = scipy.optimize.least_squares(
        tail,
        start,
        bounds=(low, high),
        x_scale=scale,
        diff_step=np.full(len(start), 1e-3),
        max_nfev=25,
    )
    return of(found.x)


def _times(longest_s: float) -> FloatArray:
    decades = np.log10(max(longest_s, _QUICKEST_S) / _QUICKEST_S)
    return np.asarray(_QUICKEST_S * _DECADE ** np.arange(int(decades + 1.0)), dtype=np.float64)


def _rows(stages: Stages, samples: Sequence[Samples], every: int) -> tuple[FloatArray, FloatArray]:
    rows, goals = [], []
    for each in samples:
        z = stages.position(each)
        known = slice(each.first, None, every)
        rows.append(_bent_features(z[known], stops_of(z, stages.initial)[known]))
        goals.append(stages.command(each)[known])
    return np.concatenate(rows), np.concatenate(goals)


def _bent_features(z: FloatArray, held: FloatArray) -> FloatArray:
    """Return what can tell a loop (n, …) whose slope and width change along the range."""
    powers = z[:, None] ** np.arange(5)
    return np.column_stack([powers, held, held * z[:, None], held * z[:, None] ** 2])


def stops_of(z: FloatArray, initial: FloatArray) -> FloatArray:
    """Return the stops (n, p) of z (n,), whose plays begin in ``initial`` (p,) states."""
    return stops(z, thresholds(), initial.copy())


def solved(rows: FloatArray, goals: FloatArray) -> FloatArray:
    """Return the least squares of ``rows`` (n, c) for ``goals`` (n,), hardly damped."""
    square = rows.T @ rows
    square[np.diag_indices_from(square)] += _SMALL * len(rows)
    return np.asarray(np.linalg.solve(square, rows.T @ goals))
