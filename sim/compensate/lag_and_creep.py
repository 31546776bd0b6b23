"""Lag and creep of an axis, fitted together with its hysteresis by variable projection.

For every trial of the nonlinear parameters, the linear ones (factors of the stops of the position)
are solved by least squares (Golub and Pereyra, Inverse Problems 19 (2003) R1–R26).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate import kernel
from rotemina.sim.compensate.prandtl_ishlinskii import compute_stops
from rotemina.sim.compensate.samples import TrainingSamples

PLAY_COUNT = 12
# The lag may exceed the smallest possible one by this much.
MAX_EXTRA_LAG_SAMPLES = 20
# Faster creep is part of the hysteresis loop.
_MIN_CREEP_TIME_S = 0.1
# Ratio of the time constants of neighbouring relaxations.
_CREEP_TIME_RATIO = 10.0
# Largest creep of each relaxation, as a share of a move.
_MAX_CREEP_SHARE = 0.1
# More rows take more time, but do not improve the fit.
_MAX_ROWS = 20_000
# Largest share of the range by which the low end may differ from its nominal position.
_MAX_LOW_END_SHARE = 0.1
# One unit of penalty corresponds to this lag in excess of the smallest possible one, or to this
# difference between the weights of neighbouring relaxations.
_LAG_PENALTY_SAMPLES = 5.0
_CREEP_PENALTY_DIFFERENCE = 0.03
# Rms (share of the range) by which the fit must improve for one unit of a penalty.
_PENALTY_RMS_SHARE = 1e-3
_DAMPING_RATIO = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class LagAndCreep:
    """The stages after the hysteresis: the lag (s) and relaxations ``(c,)`` as in an inverse.

    ``origin`` of the position, ``command_origin`` and ``span`` convert both to shares. ``memory``
    is the state of the plays at the low end, in shares of their radii: 0 means the middle, as in
    virgin material, and 1 means after a long descent. ``low`` is the position there, a share.
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
        """States (p,) of the plays of the position at the low end."""
        return self.low + self.memory * make_radii()

    def compute_positions(self, samples: TrainingSamples) -> FloatArray:
        """Return the positions (n,) without creep, shares."""
        shares = (samples.position - self.origin) / self.span
        return kernel.subtract_creep(self._make_creep_table(), shares)

    def compute_commands(self, samples: TrainingSamples) -> FloatArray:
        """Return the commands (n,) delayed by the lag, shares."""
        shares = (samples.command - self.command_origin) / self.span
        return delay_rows(shares, self.lag_s / self.sample_s)

    def _make_creep_table(self) -> FloatArray:
        step_fractions = -np.expm1(-self.sample_s / self.creep_times_s)
        return np.stack([step_fractions, self.creep_weights])


def delay_rows(values: FloatArray, rows: float) -> FloatArray:
    """Return ``values`` (n,) delayed by ``rows``, with linear interpolation.

    The first value is repeated before the first row.
    """
    index = np.arange(len(values), dtype=np.float64)
    return np.asarray(np.interp(index - rows, index, values), dtype=np.float64)


def make_radii(count: int = PLAY_COUNT) -> FloatArray:
    """Return radii of plays, shares: closer where they are small, up to half the range."""
    return 0.5 * ((np.arange(count) + 0.5) / count) ** 1.5


def fit_lag_and_creep(
    samples: Sequence[TrainingSamples],
    origin: float,
    command_origin: float,
    span: float,
    min_lag_s: float,
) -> LagAndCreep:
    """Fit lag, memory at the low end, and creep of an axis to runs at one rate."""
    sample_s = samples[0].sample_s
    longest_s = max(len(run.command) for run in samples) * sample_s
    times_s = _make_creep_times(longest_s)
    min_lag = min_lag_s / sample_s

    def make_stages(parameters: FloatArray) -> LagAndCreep:
        lag_s = float(parameters[0]) * sample_s
        normalisation = (origin, command_origin, span, sample_s)
        memory, low = float(parameters[1]), float(parameters[2])
        return LagAndCreep(*normalisation, lag_s, memory, low, times_s, parameters[3:].copy())

    stride = max(sum(len(run.command) for run in samples) // _MAX_ROWS, 1)

    def compute_residuals(parameters: FloatArray) -> FloatArray:
        rows, goals = _make_regression_rows(make_stages(parameters), samples, stride)
        residual = goals - rows @ solve_damped(rows, goals)
        penalties = np.concatenate(
            [
                [
                    parameters[2] / _MAX_LOW_END_SHARE,
                    (parameters[0] - min_lag) / _LAG_PENALTY_SAMPLES,
                ],
                np.diff(parameters[3:]) / _CREEP_PENALTY_DIFFERENCE,
            ]
        )
        return np.concatenate([residual, _PENALTY_RMS_SHARE * np.sqrt(len(rows)) * penalties])

    initial_parameters = np.concatenate([[min_lag + 0.3, 0.5, 0.0], np.full(len(times_s), 1e-3)])
    low = np.concatenate(
        [[min_lag, 0.0, -_MAX_LOW_END_SHARE], np.full(len(times_s), -0.1 * _MAX_CREEP_SHARE)]
    )
    high = np.concatenate(
        [
            [min_lag + MAX_EXTRA_LAG_SAMPLES, 1.0, _MAX_LOW_END_SHARE],
            np.full(len(times_s), _MAX_CREEP_SHARE),
        ]
    )
    scale = np.concatenate([[0.3, 0.3, 0.03], np.full(len(times_s), 1e-2)])
    solution = scipy.optimize.least_squares(
        compute_residuals,
        initial_parameters,
        bounds=(low, high),
        x_scale=scale,
        diff_step=np.full(len(initial_parameters), 1e-3),
        max_nfev=25,
    )
    return make_stages(solution.x)


def _make_creep_times(longest_s: float) -> FloatArray:
    decades = np.log10(max(longest_s, _MIN_CREEP_TIME_S) / _MIN_CREEP_TIME_S)
    return np.asarray(
        _MIN_CREEP_TIME_S * _CREEP_TIME_RATIO ** np.arange(int(decades + 1.0)), dtype=np.float64
    )


def _make_regression_rows(
    stages: LagAndCreep, samples: Sequence[TrainingSamples], stride: int
) -> tuple[FloatArray, FloatArray]:
    rows, goals = [], []
    for run in samples:
        z = stages.compute_positions(run)
        selected = slice(run.first, None, stride)
        rows.append(_make_bent_features(z[selected], find_axis_stops(z, stages.initial)[selected]))
        goals.append(stages.compute_commands(run)[selected])
    return np.concatenate(rows), np.concatenate(goals)


def _make_bent_features(z: FloatArray, stops_of_z: FloatArray) -> FloatArray:
    """Return features of a loop (n, …) whose slope and width change along the range."""
    powers = z[:, None] ** np.arange(5)
    return np.column_stack(
        [powers, stops_of_z, stops_of_z * z[:, None], stops_of_z * z[:, None] ** 2]
    )


def find_axis_stops(z: FloatArray, initial: FloatArray) -> FloatArray:
    """Return the stops (n, p) of z (n,), whose plays begin in the states ``initial`` (p,)."""
    return compute_stops(z, make_radii(), initial.copy())


def solve_damped(rows: FloatArray, goals: FloatArray) -> FloatArray:
    """Return the least-squares solution (c,) of ``rows`` (n, c) for ``goals`` (n,).

    It is damped slightly, so that it exists for any rows.
    """
    square = rows.T @ rows
    square[np.diag_indices_from(square)] += _DAMPING_RATIO * len(rows)
    return np.asarray(np.linalg.solve(square, rows.T @ goals))
