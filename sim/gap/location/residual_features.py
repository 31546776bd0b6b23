"""A probe of the residual: a black-box model of simple features, validated on unseen records.

If the probe can predict part of what an explanation leaves unexplained, an effect is still missing.
Applied to the raw gap, it shows the best that any model could achieve (the ceiling of a diagnosis).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.signal import lfilter

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects import AxisProperties
from rotemina.sim.gap.fit import Evidence, folds
from rotemina.sim.records import Record, Tap

# Time constants of the lags, for the command of the axis itself and for those of other axes.
_LAG_TIMES_S = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
_OTHER_AXIS_LAG_TIMES_S = (0.003, 0.03, 0.3)
# Ridge parameter, relative to the power of the features.
_RIDGE_POWER_RATIO = 1e-3
# Minimum ridge, which keeps the matrix regular if features are zero.
_MIN_RIDGE = 1e-12
# A group of features is named if it predicts at least this fraction of the residual's power.
_MIN_PREDICTED_SHARE = 0.05
# Of a two-phase stepper motor.
_FULL_STEPS_PER_ELECTRICAL_PERIOD = 4.0


@dataclass(frozen=True, slots=True, eq=False)
class ResidualProbe:
    """The result of predicting a residual with a black-box model.

    ``remainder`` (rows,) is the unpredicted part; each record is predicted by a fit to the others.
    ``depends_on`` names the groups of features, most informative first, with the fraction of the
    power that each group predicts alone.
    """

    remainder: FloatArray
    depends_on: tuple[tuple[str, float], ...]

    @property
    def score(self) -> float:
        """Mean square of the unpredicted part, in units of the squared noise floor."""
        return float(np.mean(self.remainder**2))


def probe_residual(
    evidence: Evidence, residual: FloatArray, *, by_time: bool = True
) -> ResidualProbe:
    """Try to predict a residual (rows,) from features of the commands.

    The residual is in units of the noise floor. With ``by_time``, the time since the beginning of
    the record is a feature as well.
    """
    groups = {
        name: features
        for name, features in _build_features(evidence).items()
        if by_time or name != "time"
    }
    features = np.hstack(list(groups.values()))
    fold_moments = [
        _FoldMoments.of(features, residual, is_in_fold) for is_in_fold in folds(evidence)
    ]
    all_columns = list(range(features.shape[1]))
    remainder = _subtract_predictions(features, residual, fold_moments, all_columns)
    predicted_shares = {
        name: 1.0
        - _compute_mean_square(_subtract_predictions(features, residual, fold_moments, columns))
        / _compute_mean_square(residual)
        for name, columns in _find_group_columns(groups).items()
    }
    ranked = sorted(predicted_shares.items(), key=lambda pair: -pair[1])
    return ResidualProbe(
        remainder, tuple((name, share) for name, share in ranked if share >= _MIN_PREDICTED_SHARE)
    )


@dataclass(frozen=True, slots=True, eq=False)
class _FoldMoments:
    """Gram matrix (m, m) of the features of a fold, and their products (m,) with the residual.

    ``is_in_fold`` (rows,) is true for the rows of the fold.
    """

    is_in_fold: BoolArray
    gram: FloatArray
    moments: FloatArray

    @classmethod
    def of(cls, features: FloatArray, residual: FloatArray, is_in_fold: BoolArray) -> Self:
        held_out = features[is_in_fold]
        return cls(is_in_fold, held_out.T @ held_out, held_out.T @ residual[is_in_fold])


def _subtract_predictions(
    features: FloatArray,
    residual: FloatArray,
    fold_moments: Sequence[_FoldMoments],
    columns: Sequence[int],
) -> FloatArray:
    """Return the residual of each fold minus its prediction by a ridge regression on the others.

    Only the given columns of the features are used. If a fold is predicted worse than by zeros, it
    keeps its residual.
    """
    remainder = residual.copy()
    block = np.ix_(columns, columns)
    gram = sum((fold.gram[block] for fold in fold_moments), np.zeros((len(columns), len(columns))))
    moments = sum((fold.moments[columns] for fold in fold_moments), np.zeros(len(columns)))
    for fold in fold_moments:
        regularized_gram = gram - fold.gram[block]
        regularized_gram += np.diag(_RIDGE_POWER_RATIO * np.diag(gram)) + (
            _MIN_RIDGE * np.trace(gram) + _MIN_RIDGE
        ) * np.eye(len(gram))
        weights = np.linalg.solve(regularized_gram, moments - fold.moments[columns])
        fold_remainder = residual[fold.is_in_fold] - features[fold.is_in_fold][:, columns] @ weights
        if float(fold_remainder @ fold_remainder) < float(
            residual[fold.is_in_fold] @ residual[fold.is_in_fold]
        ):
            remainder[fold.is_in_fold] = fold_remainder
    return remainder


def _find_group_columns(groups: Mapping[str, FloatArray]) -> dict[str, list[int]]:
    columns_by_group, first_column = {}, 0
    for name, features in groups.items():
        columns_by_group[name] = list(range(first_column, first_column + features.shape[1]))
        first_column += features.shape[1]
    return columns_by_group


def _compute_mean_square(remainder: FloatArray) -> float:
    return float(np.mean(remainder**2))


def _build_features(evidence: Evidence) -> Mapping[str, FloatArray]:
    """Return groups of features (rows, m), with the mean over each record removed.

    The rows of each tap of a record have the same features, which depend only on the commands and
    the time of the record.
    """
    facts = AxisProperties.of(evidence.robot.axes[evidence.axis])
    by_record = [
        _build_record_features(evidence.axis, observation.record, facts)
        for observation in evidence.observations
    ]
    names = dict.fromkeys(name for record_groups in by_record for name in record_groups)
    groups = {}
    for name in names:
        width = max(
            record_groups[name].shape[1] for record_groups in by_record if name in record_groups
        )
        columns = []
        for part in evidence.parts:
            features = by_record[part.record].get(name)
            rows = part.rows.stop - part.rows.start
            columns.append(
                np.zeros((rows, width)) if features is None else features - features.mean(axis=0)
            )
        groups[name] = np.vstack(columns)
    return groups


def _build_record_features(
    axis: str, record: Record, facts: AxisProperties
) -> dict[str, FloatArray]:
    time_s, command = record.time_s, record.signal(axis, Tap.CMD)
    period_s = float(np.median(np.diff(time_s)))
    position = (command - facts.low) / facts.span - 0.5
    change = np.diff(position, prepend=position[0])
    direction = _find_last_direction(change)
    speed = change / period_s
    groups = {
        "command": np.stack([position, position**2, position**3], axis=1),
        "direction": np.stack([direction, direction * position], axis=1),
        "speed": np.stack([speed, np.abs(speed)], axis=1),
        "past commands": np.stack(
            [apply_lag(position, lag_s / period_s) for lag_s in _LAG_TIMES_S], axis=1
        ),
        "time": np.stack([time_s - time_s[0], (time_s - time_s[0]) ** 2], axis=1),
        "position phase": _compute_phase_features(command, facts),
    }
    others = [name for name in record.axes if name != axis and record.has(name, Tap.CMD)]
    for name in others:
        other_command = record.signal(name, Tap.CMD)
        lagged_signals = [
            apply_lag(other_command, lag_s / period_s) for lag_s in _OTHER_AXIS_LAG_TIMES_S
        ]
        # The span of this axis serves as a scale for the other axis, too, because the ridge is
        # relative to the power of each feature.
        groups[f"axis {name}"] = np.stack([other_command, *lagged_signals], axis=1) / facts.span
    return groups


def _find_last_direction(change: FloatArray) -> FloatArray:
    """Return the direction (n,) in which a command last moved; 0 before its first motion."""
    move_rows = np.where(change != 0.0, np.arange(len(change)), -1)
    last_move_row = np.maximum.accumulate(move_rows)
    return np.where(last_move_row >= 0, np.sign(change[np.maximum(last_move_row, 0)]), 0.0)


def apply_lag(signal: FloatArray, time_constant_rows: float) -> FloatArray:
    """Return a signal (n,) after a first-order lag; the time constant is in rows."""
    weight = 1.0 - np.exp(-1.0 / max(time_constant_rows, 1e-9))
    filtered, _ = lfilter([weight], [1.0, weight - 1.0], signal, zi=[(1.0 - weight) * signal[0]])
    return np.asarray(filtered)


def _compute_phase_features(command: FloatArray, facts: AxisProperties) -> FloatArray:
    electrical_period = _FULL_STEPS_PER_ELECTRICAL_PERIOD * facts.full_step
    phases_rad = 2.0 * np.pi * command[:, None] / np.array([facts.pitch, electrical_period])
    return np.hstack([np.sin(phases_rad), np.cos(phases_rad)])
