"""A probe of the residual: a black box of simple features, judged on unseen records.

If it predicts the remainder of an explanation, something is still missing; without an explanation
it shows what any model could reach at best (the ceiling of a diagnosis).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.signal import lfilter

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects.facts import Facts
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.held_out import folds
from rotemina.sim.records.record import Record, Tap

# Time constants of what follows a command late; other axes' commands have the shorter ones.
_SETTLING_S = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
_CROSSING_S = (0.003, 0.03, 0.3)
_RIDGE = 1e-3  # of the features' power
_TINY = 1e-12
_LEAST_GAIN = 0.05  # of what is left, that a group of features must predict to be named


@dataclass(frozen=True, slots=True, eq=False)
class Probe:
    """The prediction of a residual by a black box.

    ``left`` (rows,) is the unpredicted part, each record predicted from the others; ``depends_on``
    names the groups of features, most informative first, with the share of the power that each
    predicts alone.
    """

    left: FloatArray
    depends_on: tuple[tuple[str, float], ...]

    @property
    def score(self) -> float:
        """Mean square of the unpredicted part over the floor."""
        return float(np.mean(self.left**2))


def probed(evidence: Evidence, residual: FloatArray, *, by_time: bool = True) -> Probe:
    """Try to predict a residual (rows,) over the floor from features of the commands.

    And from the time since a record began, unless it is not to count ``by_time``.
    """
    groups = {name: one for name, one in _features(evidence).items() if by_time or name != "time"}
    features = np.hstack(list(groups.values()))
    learned = [_Learned.of(features, residual, out) for out in folds(evidence)]
    every = list(range(features.shape[1]))
    left = _unpredicted(features, residual, learned, every)
    alone = {
        name: 1.0 - _score(_unpredicted(features, residual, learned, columns)) / _score(residual)
        for name, columns in _columns(groups).items()
    }
    named = sorted(alone.items(), key=lambda pair: -pair[1])
    return Probe(left, tuple((name, share) for name, share in named if share >= _LEAST_GAIN))


@dataclass(frozen=True, slots=True, eq=False)
class _Learned:
    """What the rows of a fold, ``out`` (rows,), say of features: gram (m, m) and moments (m,)."""

    out: BoolArray
    gram: FloatArray
    moments: FloatArray

    @classmethod
    def of(cls, features: FloatArray, residual: FloatArray, out: BoolArray) -> Self:
        own = features[out]
        return cls(out, own.T @ own, own.T @ residual[out])


def _unpredicted(
    features: FloatArray, residual: FloatArray, learned: Sequence[_Learned], columns: Sequence[int]
) -> FloatArray:
    """Return what ridge regression on some features leaves of each fold by fitting the others.

    A prediction worse than none is left out: the black box then has nothing to say there.
    """
    left = residual.copy()
    some = np.ix_(columns, columns)
    gram = sum((one.gram[some] for one in learned), np.zeros((len(columns), len(columns))))
    moments = sum((one.moments[columns] for one in learned), np.zeros(len(columns)))
    for one in learned:
        known = gram - one.gram[some]
        known += np.diag(_RIDGE * np.diag(gram)) + (_TINY * np.trace(gram) + _TINY) * np.eye(
            len(gram)
        )
        weights = np.linalg.solve(known, moments - one.moments[columns])
        then = residual[one.out] - features[one.out][:, columns] @ weights
        if float(then @ then) < float(residual[one.out] @ residual[one.out]):
            left[one.out] = then
    return left


def _columns(groups: Mapping[str, FloatArray]) -> dict[str, list[int]]:
    """Return which columns of all features each group has."""
    found, begin = {}, 0
    for name, own in groups.items():
        found[name] = list(range(begin, begin + own.shape[1]))
        begin += own.shape[1]
    return found


def _score(left: FloatArray) -> float:
    return float(np.mean(left**2))


def _features(evidence: Evidence) -> Mapping[str, FloatArray]:
    """Return groups of features (rows, m), without their means over a record.

    All taps share them, each with weights over its own floor.
    """
    facts = Facts.of(evidence.robot.axes[evidence.axis])
    by_record = [_of(evidence.axis, o.record, facts) for o in evidence.observations]
    names = dict.fromkeys(name for one in by_record for name in one)
    groups = {}
    for name in names:
        wide = max(one[name].shape[1] for one in by_record if name in one)
        columns = []
        for part in evidence.parts:
            own = by_record[part.record].get(name)
            rows = part.rows.stop - part.rows.start
            columns.append(np.zeros((rows, wide)) if own is None else own - own.mean(axis=0))
        groups[name] = np.vstack(columns)
    return groups


def _of(axis: str, record: Record, facts: Facts) -> dict[str, FloatArray]:
    time_s, command = record.time_s, record.signal(axis, Tap.CMD)
    period_s = float(np.median(np.diff(time_s)))
    at = (command - facts.low) / facts.span - 0.5
    change = np.diff(at, prepend=at[0])
    way = _last_direction(change)
    speed = change / period_s
    groups = {
        "command": np.stack([at, at**2, at**3], axis=1),
        "direction": np.stack([way, way * at], axis=1),
        "speed": np.stack([speed, np.abs(speed)], axis=1),
        "past commands": np.stack([lagged(at, s / period_s) for s in _SETTLING_S], axis=1),
        "time": np.stack([time_s - time_s[0], (time_s - time_s[0]) ** 2], axis=1),
        "position phase": _phases(command, facts),
    }
    others = [name for name in record.axes if name != axis and record.has(name, Tap.CMD)]
    for name in others:
        other = record.signal(name, Tap.CMD)
        lates = [lagged(other, s / period_s) for s in _CROSSING_S]
        groups[f"axis {name}"] = np.stack([other, *lates], axis=1) / facts.span
    return groups


def _last_direction(change: FloatArray) -> FloatArray:
    """Return which way (n,) a command last went, 0 before it first did."""
    moved = np.where(change != 0.0, np.arange(len(change)), -1)
    last = np.maximum.accumulate(moved)
    return np.where(last >= 0, np.sign(change[np.maximum(last, 0)]), 0.0)


def lagged(signal: FloatArray, rows: float) -> FloatArray:
    """Return a signal (n,) after a first-order lag of so many rows."""
    share = 1.0 - np.exp(-1.0 / max(rows, 1e-9))
    followed, _ = lfilter([share], [1.0, share - 1.0], signal, zi=[(1.0 - share) * signal[0]])
    return np.asarray(followed)


def _phases(command: FloatArray, facts: Facts) -> FloatArray:
    turns = 2.0 * np.pi * command[:, None] / np.array([facts.pitch, 4.0 * facts.full_step])
    return np.hstack([np.sin(turns), np.cos(turns)])
