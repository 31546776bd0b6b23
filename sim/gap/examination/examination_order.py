"""The order in which axes are examined.

An axis that is moved by another axis is examined after it. Otherwise the model errors of the other
axis, such as its hysteresis, would be attributed to the coupling.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.fit import Evidence, Signals
from rotemina.sim.records import Record, Tap

# Taps at which a position is measured, in order of preference.
_POSITION_TAPS = (Tap.REF, Tap.MEAS)
# Axis B counts as moved by axis A if the motion of A explains more than this fraction of the gap of
# B, beyond the part that the motion of B explains.
_MIN_COUPLED_SHARE = 0.5


def order_axes(evidences: Mapping[str, Evidence], largest_first: Sequence[str]) -> list[str]:
    """Return the axes with a gap in the order in which to examine them.

    The axis with the largest gap comes first, but after the axes that move it. If axes move each
    other, the one with the larger gap comes first.
    """
    movers = {
        name: {
            other
            for other in largest_first
            if other != name and _find_coupled_share(evidences[name], other) > _MIN_COUPLED_SHARE
        }
        for name in largest_first
    }
    remaining, order = list(largest_first), []
    while remaining:
        ready = (name for name in remaining if not movers[name].intersection(remaining))
        order.append(next(ready, remaining[0]))
        remaining.remove(order[-1])
    return order


def _find_coupled_share(evidence: Evidence, other: str) -> float:
    """Return the share of a gap that the motion of another axis explains in addition.

    The part that the motion of the axis explains is removed first. The share comes from a linear
    regression over the records with both axes. The regressors are position, speed and acceleration
    of the model of the axis, and measured position and speed of the other axis.
    """
    gaps, own_motions, other_motions = [], [], []
    for observation, gap in zip(evidence.observations, evidence.gaps(), strict=True):
        tap, motion = _find_position_tap(gap), _find_measured_position(observation.record, other)
        if tap is None or motion is None:
            continue
        time_s = observation.record.time_s
        model_motion = observation.real[tap] - observation.floor[tap] * gap[tap]
        gaps.append(gap[tap])
        own_motions.append(_stack_derivatives(model_motion, time_s, 2))
        other_motions.append(_stack_derivatives(motion, time_s, 1))
    if not gaps:
        return 0.0
    all_gaps, own_motion = np.concatenate(gaps), np.concatenate(own_motions)
    own_remainder = _compute_residual_power(own_motion, all_gaps)
    joint_remainder = _compute_residual_power(
        np.hstack([own_motion, np.concatenate(other_motions)]), all_gaps
    )
    return 1.0 - joint_remainder / own_remainder if own_remainder > 0.0 else 0.0


def _find_position_tap(gap: Signals) -> Tap | None:
    return next((tap for tap in _POSITION_TAPS if tap in gap), None)


def _find_measured_position(record: Record, axis: str) -> FloatArray | None:
    tap = next((tap for tap in _POSITION_TAPS if record.has(axis, tap)), None)
    return None if tap is None else record.signal(axis, tap)


def _stack_derivatives(motion: FloatArray, time_s: FloatArray, order: int) -> FloatArray:
    """Return a motion and its time derivatives (n, order + 1), each without its mean."""
    columns = [motion]
    for _ in range(order):
        columns.append(np.gradient(columns[-1], time_s))
    table = np.stack(columns, axis=1)
    return np.asarray(table - table.mean(axis=0))


def _compute_residual_power(regressors: FloatArray, gap: FloatArray) -> float:
    scales = np.maximum(regressors.std(axis=0), np.finfo(np.float64).tiny)
    coefficients = np.linalg.lstsq(regressors / scales, gap, rcond=None)[0]
    return float(np.sum((gap - regressors / scales @ coefficients) ** 2))
