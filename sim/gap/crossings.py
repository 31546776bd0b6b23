"""What a coarse reading says exactly: where the axis was when it went from one step to the next.

Within a step nothing is known but half of it; at the edge between two, the middle of them was
passed a moment ago (level-crossing sampling: Marvasti, Nonuniform Sampling, 2001, ch. 4).
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.gap.evidence import Evidence, Observation, Signals
from rotemina.sim.records.record import Tap

_ONE = 0.1  # of a step, by which a change may differ from it
_SLOW = 0.25  # of a step, that the axis goes from row to row at most
_LEAST = 60  # edges in a record, from which they are used alone
_FINER = 0.5  # of the floor of all rows, that theirs is at most


def at_crossings(
    whole: Evidence, raised: Evidence, answers: Sequence[Signals], step: float
) -> Evidence:
    """Return evidence whose coarse readings count at the edges of their steps alone.

    Parameters
    ----------
    whole, raised : Evidence
        With the sensor's declared floor, and with that of its steps. Records with few edges, or
        with no finer floor there, stay as they are in the latter.
    answers : sequence of mapping of Tap to (n,)
        Of the model, whose pace tells how long ago an edge was passed.
    step : float
        SI.
    """
    return raised.with_observations(
        [
            _at_edges(fine, coarse, answer, step) if Tap.MEAS in fine.floor else coarse
            for fine, coarse, answer in zip(
                whole.observations, raised.observations, answers, strict=True
            )
        ]
    )


def _at_edges(fine: Observation, coarse: Observation, answer: Signals, step: float) -> Observation:
    reading, expected = fine.real[Tap.MEAS], answer[Tap.MEAS]
    change = np.diff(reading, prepend=reading[0])
    pace = np.diff(expected, prepend=expected[0])
    edges = _edges(change, pace, step) & _both_kept(fine)
    if edges.sum() < _LEAST:
        return coarse
    passed = reading - 0.5 * change + 0.5 * pace
    # Steps need not be even: what differs from edge to edge is no finer than that.
    uneven = float(np.mean(np.diff((passed - expected)[edges]) ** 2)) / 2.0
    since = float(np.mean(pace[edges] ** 2)) / 12.0
    floor = float(np.sqrt(max(fine.floor[Tap.MEAS] ** 2 + since, uneven)))
    if floor > _FINER * coarse.floor[Tap.MEAS]:
        return coarse
    # Rows that do not count are zeros: the mean square over all rows is one at the floor all the
    # same.
    share = float(edges.mean())
    return replace(
        coarse,
        real={**coarse.real, Tap.MEAS: np.where(edges, passed, reading)},
        kept={**coarse.kept, Tap.MEAS: edges},
        floor={**coarse.floor, Tap.MEAS: floor * np.sqrt(share)},
    )


def _edges(change: FloatArray, pace: FloatArray, step: float) -> BoolArray:
    one = np.abs(np.abs(change) - step) < _ONE * step
    return np.asarray(one & (np.abs(pace) < _SLOW * step))


def _both_kept(observation: Observation) -> BoolArray:
    kept = observation.kept.get(Tap.MEAS)
    if kept is None:
        return np.ones(len(observation.real[Tap.MEAS]), dtype=np.bool_)
    return np.asarray(kept & np.concatenate([kept[:1], kept[:-1]]))
