"""Exact sampling: when commands act, and how the state steps between samples.

A command is held from its sample to the next (zero-order hold), so the state is stepped by the
matrix exponential of the augmented system over each interval, uniform or not. Van Loan,
"Computing integrals involving the matrix exponential", IEEE TAC 23 (1978).
"""

from dataclasses import dataclass
from functools import lru_cache
from math import isqrt
from typing import NamedTuple, Self

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.messages import message
from rotemina.sim.plant.coupled_groups import Group
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.quantities import rounded

TICK_S = 2.0**-50  # finest difference of sample times that is told from rounding
_FEW_LENGTHS = 32
_SERIES_TERMS = 16  # 0.5¹⁶ / 16! is below 1e-18
_FEW_TICKS = 4096
_SAME_TICKS = 2  # times and delays are rounded each by itself


@dataclass(frozen=True, slots=True, eq=False)
class Segments:
    """A run cut where a sample is taken or a delayed input begins to act.

    Attributes
    ----------
    sample : (s,) int
        Which sample is taken at the segment's start, or -1.
    applied : (s, d) int
        Which sample's input acts during the segment, for each of d delays.
    step : (s,) int
        Which entry of ``lengths_s`` is the segment's length.
    lengths_s : (k,) float
        The different lengths, s. The last segment has length 0.
    """

    sample: IntArray
    applied: IntArray
    step: IntArray
    lengths_s: FloatArray


class Linear(NamedTuple):
    """A linear system: the augmented matrix whose exponential steps it, and its number of states.

    ``generator`` as of :class:`~rotemina.sim.plant.coupled_groups.Group`.
    """

    generator: FloatArray
    states: int

    @classmethod
    def of(cls, numbers: bytes, states: int) -> Self:
        """Return it from the ``numbers`` of its matrix."""
        generator = np.frombuffer(numbers)
        size = isqrt(len(generator))
        return cls(generator.reshape(size, size), states)


class Ticks(NamedTuple):
    """Sample times ``at`` (n,) in whole ticks of ``length_s``, counted from where a run starts."""

    at: IntArray
    length_s: float


def ticks_of(time_s: FloatArray, first: int) -> Ticks:
    """Return the times (n,) of samples, of which those before ``first`` are history.

    With ``first`` > 0 the run starts at sample ``first - 1``, whose state is known.

    Raises
    ------
    PlantError
        If rounding cannot tell two samples apart.
    """
    start = max(first - 1, 0)
    tick = _tick(float(np.abs(time_s[[0, -1]]).max()))
    ticks = np.rint((time_s - time_s[start]) / tick).astype(np.int64)
    if len(ticks) > start + 1 and np.diff(ticks[start:]).min() <= 0:
        row = start + int(np.argmin(np.diff(ticks[start:])))
        raise PlantError(
            message(
                "engine",
                "the samples after t = {time_s} s are {apart_s} s apart, but the rounding "
                "there is {tick} s; count time from the start of the record",
            ).fill(
                time_s=repr(time_s[row]),
                apart_s=rounded(time_s[row + 1] - time_s[row], 3),
                tick=rounded(tick, 3),
            )
        )
    return Ticks(ticks, tick)


def cut(run: Ticks, first: int, delay_s: tuple[float, ...]) -> Segments:
    """Cut the span of a run, from sample ``first``, into segments.

    Samples before ``first`` are history: they are not taken again but their inputs still act.
    ``delay_s`` (d,) are the times after its sample at which an input may begin to act.
    """
    ticks, tick = run
    start = max(first - 1, 0)
    if not any(delay_s):
        return _cut_at_samples(ticks, np.arange(start, len(ticks))[:, None], start, first, tick)
    delays = np.rint(np.array(delay_s) / tick).astype(np.int64)
    rows = [_rows(ticks + delay, ticks) if delay else np.arange(len(ticks)) for delay in delays]
    begins = [
        np.where(row >= 0, ticks[row], ticks + delay)
        for row, delay in zip(rows, delays, strict=True)
    ]
    if all((begin[row < 0] > ticks[-1]).all() for row, begin in zip(rows, begins, strict=True)):
        begun = [np.bincount(row[row >= 0], minlength=len(ticks)).cumsum() - 1 for row in rows]
        applied = np.stack([np.maximum(row[start:], 0) for row in begun], axis=1)
        return _cut_at_samples(ticks, applied, start, first, tick)
    breaks = _ascending(np.concatenate([ticks[start:], *begins]))
    breaks = breaks[(breaks >= 0) & (breaks <= ticks[-1])]
    sample = np.full(len(breaks), -1, dtype=np.int64)
    sample[np.searchsorted(breaks, ticks[first:])] = np.arange(first, len(ticks))
    applied = np.stack([_latest(begin, breaks) for begin in begins], axis=1)
    step, lengths = _distinct(np.append(np.diff(breaks), 0))
    return Segments(sample, applied, step, np.asarray(lengths * tick, dtype=np.float64))


def _rows(late: IntArray, ticks: IntArray) -> IntArray:
    """Return at which sample each input begins to act, rounding aside; -1 where at none."""
    place = np.minimum(np.searchsorted(ticks, late - _SAME_TICKS), len(ticks) - 1)
    return np.where(np.abs(ticks[place] - late) <= _SAME_TICKS, place, -1)


def _latest(begin: IntArray, breaks: IntArray) -> IntArray:
    """Return which of the instants ``begin`` (n,) is the latest at each of ``breaks``."""
    place = np.searchsorted(breaks, begin)
    within = place[(begin >= 0) & (begin <= breaks[-1])]
    begun = np.bincount(within, minlength=len(breaks)).cumsum()
    return np.asarray(np.maximum(begun + np.count_nonzero(begin < 0) - 1, 0), dtype=np.int64)


def _ascending(values: IntArray) -> IntArray:
    """Return the distinct values, sorted; much faster than numpy's ``unique`` of integers."""
    values = np.sort(values)
    return np.asarray(values[np.concatenate([[True], np.diff(values) > 0])])


def _tick(latest_s: float) -> float:
    """Return what rounding cannot tell apart at this time, s.

    A power of two, so that a live run meets the same step lengths again and again.
    """
    rounding = 4.0 * float(np.finfo(np.float64).eps) * latest_s
    return max(TICK_S, 2.0 ** float(np.ceil(np.log2(rounding)))) if rounding > 0 else TICK_S


def _cut_at_samples(
    ticks: IntArray, applied: IntArray, start: int, first: int, tick: float
) -> Segments:
    """Cut where every input begins to act with a sample; ``applied`` as in :class:`Segments`."""
    sample = np.arange(start, len(ticks))
    if first > start:
        sample[0] = -1
    step, lengths = _distinct(np.append(np.diff(ticks[start:]), 0))
    return Segments(sample, applied, step, np.asarray(lengths * tick, dtype=np.float64))


def _distinct(lengths: IntArray) -> tuple[IntArray, IntArray]:
    """Return for each length which of the sorted distinct ones it is, and those.

    The lengths of even sampling differ by rounding alone, and counting is faster than sorting.
    """
    low, last = int(lengths[:-1].min(initial=2**62)), len(lengths) - 1
    away = lengths[:last] - low
    if last == 0 or int(away.max()) > _FEW_TICKS:
        values = _ascending(lengths)
        return np.searchsorted(values, lengths).astype(np.int64), values
    seen = np.flatnonzero(np.bincount(away))
    number = np.zeros(seen[-1] + 1, dtype=np.int64)
    number[seen] = np.arange(1, len(seen) + 1)
    return np.append(number[away], 0), np.concatenate([[0], low + seen])


def step_matrices(group: Linear | Group, lengths_s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return exact steps over each length: state (k, n, n) and input (k, n, 2m + 1) matrices.

    The input columns are the m inputs, the constant force, and a unit force on each axis.
    """
    if len(lengths_s) <= _FEW_LENGTHS:  # a live run asks for the same few lengths again and again
        exact = np.stack([_step(group, float(length)) for length in lengths_s])
    else:
        numbers = group.generator.tobytes(), lengths_s.tobytes()
        exact = _many_steps(*numbers, len(group.generator), group.states)
    states = group.states
    return np.ascontiguousarray(exact[:, :, :states]), np.ascontiguousarray(exact[:, :, states:])


def _step(group: Linear | Group, length_s: float) -> FloatArray:
    """Return the rows of ``exp(A h)`` that are states."""
    size = len(group.generator)
    return _exponential(group.generator.tobytes(), size, length_s)[: group.states]


@lru_cache(maxsize=1024)
def _exponential(numbers: bytes, size: int, length_s: float) -> FloatArray:
    """Return ``exp(A h)``: power series of a part of the step, squared up to the whole.

    Without the linear solves of a Padé approximation, which a parallel linear algebra library
    makes slow for matrices as small as these. Kept by the numbers in A, as a fit makes the same
    plant over and over.
    """
    generator = np.frombuffer(numbers).reshape(size, size)
    balanced, (scale, _) = scipy.linalg.matrix_balance(generator, permute=False, separate=True)
    doublings = max(int(np.ceil(np.log2(2.0 * length_s * np.linalg.norm(balanced, 1) + 1e-300))), 0)
    exact = _series(np.asarray(balanced, dtype=np.float64), np.array([length_s * 0.5**doublings]))[
        0
    ]
    for _ in range(doublings):
        exact = exact @ exact
    return np.asarray(exact * scale[:, None] / scale)


@lru_cache(maxsize=16)
def _many_steps(numbers: bytes, lengths: bytes, size: int, states: int) -> FloatArray:
    """Return the steps of uneven sampling: ``exp(A h) = exp(A h₀) exp(A (h − h₀))``.

    The second factor is its power series, with h₀ chosen from a grid so fine that the series
    converges to rounding; one matrix exponential then serves many lengths. Kept as a single step
    is: a fit goes over the same uneven record again and again.
    """
    generator, lengths_s = np.frombuffer(numbers).reshape(size, size), np.frombuffer(lengths)
    balanced, _ = scipy.linalg.matrix_balance(generator, permute=False)
    # A static axis without states has a rate of zero: one step serves all its lengths.
    pitch = 1.0 / max(float(np.linalg.norm(balanced, 1)), np.finfo(np.float64).tiny)
    bucket = np.rint(lengths_s / pitch).astype(np.int64)
    series = _series(generator, lengths_s - bucket * pitch)
    exact = np.empty((len(lengths_s), states, size))
    for number in np.unique(bucket):
        members = bucket == number
        step = _exponential(numbers, size, float(number * pitch))[:states]
        exact[members] = step @ series[members]
    exact.flags.writeable = False
    return exact


def _series(generator: FloatArray, lengths_s: FloatArray) -> FloatArray:
    """Return the power series of ``exp(A h)``, (k, n, n), for lengths with ‖A h‖ ≤ 1/2."""
    powers, weights = [np.eye(len(generator))], [np.ones(len(lengths_s))]
    for order in range(1, _SERIES_TERMS):
        powers.append(powers[-1] @ generator)
        weights.append(weights[-1] * lengths_s / order)
    flat = np.stack(weights, axis=1) @ np.stack(powers).reshape(_SERIES_TERMS, -1)
    return np.asarray(flat.reshape(len(lengths_s), *generator.shape))
