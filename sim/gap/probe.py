"""What a residual still depends on: a black box of simple features, judged on unseen records.

If it can predict what an explanation leaves, something is still missing; without an explanation it
shows what any model could reach at best (the ceiling of a diagnosis).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.facts import Facts
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.gap.fit import folds
from rotemina.sim.records.record import Record, Tap

_SETTLING_S = (0.003, 0.03, 0.3, 3.0)  # time constants of what follows a command late
_RIDGE = 1e-3  # of the features' power
_LEAST_GAIN = 0.05  # of what is left, that a group of features must predict to be named


@dataclass(frozen=True, slots=True, eq=False)
class Probe:
    """What a black box predicts of a residual.

    ``left`` (rows,) is what it does not, each record predicted from the others; ``depends_on``
    names the groups of features, the most telling first, with the share of the power that each
    predicts by itself.
    """

    left: FloatArray
    depends_on: tuple[tuple[str, float], ...]

    @property
    def score(self) -> float:
        """Mean square over the floor of what is left."""
        return float(np.mean(self.left**2))


def probed(evidence: Evidence, residual: FloatArray) -> Probe:
    """Try to predict a residual (rows,) over the floor from features of the commands."""
    groups = _features(evidence)
    power = float(np.mean(residual**2))
    left = _unpredicted(evidence, residual, list(groups.values()))
    alone = {
        name: 1.0 - float(np.mean(_unpredicted(evidence, residual, [own]) ** 2)) / power
        for name, own in groups.items()
    }
    named = sorted(alone.items(), key=lambda pair: -pair[1])
    return Probe(left, tuple((name, share) for name, share in named if share >= _LEAST_GAIN))


def _unpredicted(
    evidence: Evidence, residual: FloatArray, groups: Sequence[FloatArray]
) -> FloatArray:
    """Return what ridge regression on features leaves of each fold by fitting the others.

    A prediction worse than none is left out: the black box then has nothing to say there.
    """
    features = np.hstack(groups)
    left = residual.copy()
    for _, out in folds(evidence):
        known = features[~out]
        gram = known.T @ known
        gram += _RIDGE * np.diag(np.diag(gram)) + 1e-12 * np.trace(gram) * np.eye(len(gram))
        weights = np.linalg.solve(gram, known.T @ residual[~out])
        then = residual[out] - features[out] @ weights
        if float(then @ then) < float(residual[out] @ residual[out]):
            left[out] = then
    return left


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
        "past commands": np.stack([_late(at, s / period_s) for s in _SETTLING_S], axis=1),
        "time": np.stack([time_s - time_s[0], (time_s - time_s[0]) ** 2], axis=1),
        "position phase": _phases(command, facts),
    }
    others = [name for name in record.axes if name != axis and record.has(name, Tap.CMD)]
    for name in others:
        other = record.signal(name, Tap.CMD)
        lates = [_late(other, s / period_s) for s in _SETTLING_S[:3]]
        groups[f"axis {name}"] = np.stack([other, *lates], axis=1) / facts.span
    return groups


def _last_direction(change: FloatArray) -> FloatArray:
    """Return which way (n,) a command last went, 0 before it first did."""
    moved = np.where(change != 0.0, np.arange(len(change)), -1)
    last = np.maximum.accumulate(moved)
    return np.where(last >= 0, np.sign(change[np.maximum(last, 0)]), 0.0)


def _late(signal: FloatArray, rows: float) -> FloatArray:
    """Return a signal (n,) that follows by a first-order lag of so many rows."""
    share = 1.0 - np.exp(-1.0 / max(rows, 1e-9))
    followed, _ = lfilter([share], [1.0, share - 1.0], signal, zi=[(1.0 - share) * signal[0]])
    return np.asarray(followed)


def _phases(command: FloatArray, facts: Facts) -> FloatArray:
    turns = 2.0 * np.pi * command[:, None] / np.array([facts.pitch, 4.0 * facts.full_step])
    return np.hstack([np.sin(turns), np.cos(turns)])
