"""The order in which axes are examined.

An axis that another axis moves is examined after that one. Otherwise the model errors of the other
axis, such as its hysteresis, would be attributed to the coupling.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.fit.evidence import Evidence, Signals
from rotemina.sim.records.record import Record, Tap

_TAPS = (Tap.REF, Tap.MEAS)  # of a position, the better one first
_MOVED = 0.5  # of what an axis' own motion leaves of its gap, that another's motion explains


def examination_order(evidences: Mapping[str, Evidence], largest_first: Sequence[str]) -> list[str]:
    """Return axes with a gap in the order in which to examine them.

    The largest gap comes first, but after those that move it, unless these move each other.
    """
    movers = {
        name: {
            other
            for other in largest_first
            if other != name and _share(evidences[name], other) > _MOVED
        }
        for name in largest_first
    }
    left, ordered = list(largest_first), []
    while left:
        free = (name for name in left if not movers[name].intersection(left))
        ordered.append(next(free, left[0]))
        left.remove(ordered[-1])
    return ordered


def _share(evidence: Evidence, other: str) -> float:
    """Return the share of a gap that another axis' motion explains in addition to the axis' own.

    By linear regression, over the records of both, on measured position and speed of the other
    axis, and position, speed and acceleration of the axis' model.
    """
    gaps, owns, others = [], [], []
    for observation, gap in zip(evidence.observations, evidence.gaps(), strict=True):
        tap, motion = _position(gap), _measured(observation.record, other)
        if tap is None or motion is None:
            continue
        time_s = observation.record.time_s
        own = observation.real[tap] - observation.floor[tap] * gap[tap]
        gaps.append(gap[tap])
        owns.append(_with_rates(own, time_s, 2))
        others.append(_with_rates(motion, time_s, 1))
    if not gaps:
        return 0.0
    whole, own_motion = np.concatenate(gaps), np.concatenate(owns)
    left = _left(own_motion, whole)
    least = _left(np.hstack([own_motion, np.concatenate(others)]), whole)
    return 1.0 - least / left if left > 0.0 else 0.0


def _position(gap: Signals) -> Tap | None:
    return next((tap for tap in _TAPS if tap in gap), None)


def _measured(record: Record, axis: str) -> FloatArray | None:
    """Return the measured position of an axis; None if there is none."""
    tap = next((tap for tap in _TAPS if record.has(axis, tap)), None)
    return None if tap is None else record.signal(axis, tap)


def _with_rates(motion: FloatArray, time_s: FloatArray, order: int) -> FloatArray:
    """Return a motion and its derivatives (n, order + 1), each without its mean."""
    columns = [motion]
    for _ in range(order):
        columns.append(np.gradient(columns[-1], time_s))
    together = np.stack(columns, axis=1)
    return np.asarray(together - together.mean(axis=0))


def _left(regressors: FloatArray, gap: FloatArray) -> float:
    """Return the power that a regression leaves of a gap (n,)."""
    sizes = np.maximum(regressors.std(axis=0), np.finfo(np.float64).tiny)
    amounts = np.linalg.lstsq(regressors / sizes, gap, rcond=None)[0]
    return float(np.sum((gap - regressors / sizes @ amounts) ** 2))
