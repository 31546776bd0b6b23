"""Exact sampling: when commands act, and how the state steps between samples.

A command is held from its sample to the next (zero-order hold). The state is therefore stepped by
the matrix exponential of the augmented system over each interval, uniform or not. Van Loan,
"Computing integrals involving the matrix exponential", IEEE TAC 23 (1978).
"""

from dataclasses import dataclass
from functools import lru_cache
from math import isqrt
from typing import NamedTuple, Self

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.errors import PlantError
from rotemina.sim.messages import format_rounded
from rotemina.sim.plant.coupled_groups import AxisGroup

# Smaller differences between sample times are rounding errors.
MIN_TICK_S = 2.0**-50
_MAX_CACHED_LENGTHS = 32
# 0.5¹⁶ / 16! is below 1e-18.
_SERIES_TERM_COUNT = 16
_MAX_COUNTED_TICKS = 4096
# Times and delays are rounded separately, so their sums may differ by this much.
_ROUNDING_TICKS = 2


@dataclass(frozen=True, slots=True, eq=False)
class RunSegments:
    """Segments of a run, cut where a sample is taken or a delayed input begins to act.

    Attributes
    ----------
    sample : (s,) int
        Which sample is taken at the segment's start, or -1.
    applied : (s, d) int
        Which sample's input acts during the segment, for each of d delays.
    step : (s,) int
        Index of the segment's length in ``lengths_s``.
    lengths_s : (k,) float
        The distinct lengths, s. The last segment has length 0.
    """

    sample: IntArray
    applied: IntArray
    step: IntArray
    lengths_s: FloatArray


class LinearSystem(NamedTuple):
    """Linear system: the augmented matrix whose exponential steps it, and its number of states.

    ``generator`` is as in :class:`~rotemina.sim.plant.coupled_groups.AxisGroup`.
    """

    generator: FloatArray
    states: int

    @classmethod
    def of(cls, matrix_bytes: bytes, states: int) -> Self:
        """Return the system whose matrix has these bytes."""
        generator = np.frombuffer(matrix_bytes)
        size = isqrt(len(generator))
        return cls(generator.reshape(size, size), states)


class SampleTicks(NamedTuple):
    """Sample times ``at`` (n,) in whole ticks of ``length_s``, counted from the start of a run."""

    at: IntArray
    length_s: float


def make_ticks(time_s: FloatArray, first: int) -> SampleTicks:
    """Return the times (n,) of samples, of which those before ``first`` are history.

    With ``first`` > 0 the run starts at sample ``first - 1``, whose state is known.

    Raises
    ------
    PlantError
        If two samples are closer than the rounding of their times.
    """
    start = max(first - 1, 0)
    tick_s = _find_tick(float(np.abs(time_s[[0, -1]]).max()))
    ticks = np.rint((time_s - time_s[start]) / tick_s).astype(np.int64)
    if len(ticks) > start + 1 and np.diff(ticks[start:]).min() <= 0:
        row = start + int(np.argmin(np.diff(ticks[start:])))
        raise PlantError(
            "the samples after t = {time_s} s are {apart_s} s apart, but the rounding "
            "there is {tick} s; count time from the start of the record",
            time_s=repr(time_s[row]),
            apart_s=format_rounded(time_s[row + 1] - time_s[row], 3),
            tick=format_rounded(tick_s, 3),
        )
    return SampleTicks(ticks, tick_s)


def cut_run(run: SampleTicks, first: int, delay_s: tuple[float, ...]) -> RunSegments:
    """Cut the time span of a run, from sample ``first``, into segments.

    Samples before ``first`` are history: they are not taken again, but their inputs still act.
    ``delay_s`` (d,) are the times after its sample at which an input may begin to act.
    """
    ticks, tick_s = run
    start = max(first - 1, 0)
    if not any(delay_s):
        return _cut_at_samples(ticks, np.arange(start, len(ticks))[:, None], start, first, tick_s)
    delays = np.rint(np.array(delay_s) / tick_s).astype(np.int64)
    rows = [
        _find_rows(ticks + delay, ticks) if delay else np.arange(len(ticks)) for delay in delays
    ]
    begins = [
        np.where(row >= 0, ticks[row], ticks + delay)
        for row, delay in zip(rows, delays, strict=True)
    ]
    # If every delayed input begins to act at a sample, or after the run, samples are the only cuts.
    if all((begin[row < 0] > ticks[-1]).all() for row, begin in zip(rows, begins, strict=True)):
        counts = [np.bincount(row[row >= 0], minlength=len(ticks)).cumsum() - 1 for row in rows]
        applied = np.stack([np.maximum(row[start:], 0) for row in counts], axis=1)
        return _cut_at_samples(ticks, applied, start, first, tick_s)
    breaks = _sort_distinct(np.concatenate([ticks[start:], *begins]))
    breaks = breaks[(breaks >= 0) & (breaks <= ticks[-1])]
    sample = np.full(len(breaks), -1, dtype=np.int64)
    sample[np.searchsorted(breaks, ticks[first:])] = np.arange(first, len(ticks))
    applied = np.stack([_find_latest(begin, breaks) for begin in begins], axis=1)
    step, lengths = _number_distinct(np.append(np.diff(breaks), 0))
    return RunSegments(sample, applied, step, np.asarray(lengths * tick_s, dtype=np.float64))


def _find_rows(begin_ticks: IntArray, ticks: IntArray) -> IntArray:
    """Return the sample at which each input begins to act, to within rounding; -1 for none."""
    row = np.minimum(np.searchsorted(ticks, begin_ticks - _ROUNDING_TICKS), len(ticks) - 1)
    return np.where(np.abs(ticks[row] - begin_ticks) <= _ROUNDING_TICKS, row, -1)


def _find_latest(begin: IntArray, breaks: IntArray) -> IntArray:
    """Return which of the instants ``begin`` (n,) is the latest at each of ``breaks``."""
    position = np.searchsorted(breaks, begin)
    inner_positions = position[(begin >= 0) & (begin <= breaks[-1])]
    counts = np.bincount(inner_positions, minlength=len(breaks)).cumsum()
    return np.asarray(np.maximum(counts + np.count_nonzero(begin < 0) - 1, 0), dtype=np.int64)


def _sort_distinct(values: IntArray) -> IntArray:
    """Return the distinct values, sorted; this is much faster than numpy's ``unique``."""
    values = np.sort(values)
    return np.asarray(values[np.concatenate([[True], np.diff(values) > 0])])


def _find_tick(latest_s: float) -> float:
    """Return the time difference, s, that is within rounding at this time.

    It is a power of two, so that the same step lengths recur in a live run.
    """
    rounding = 4.0 * float(np.finfo(np.float64).eps) * latest_s
    return max(MIN_TICK_S, 2.0 ** float(np.ceil(np.log2(rounding)))) if rounding > 0 else MIN_TICK_S


def _cut_at_samples(
    ticks: IntArray, applied: IntArray, start: int, first: int, tick_s: float
) -> RunSegments:
    """Cut a run in which every input begins to act at a sample; ``applied`` as in the result."""
    sample = np.arange(start, len(ticks))
    if first > start:
        sample[0] = -1
    step, lengths = _number_distinct(np.append(np.diff(ticks[start:]), 0))
    return RunSegments(sample, applied, step, np.asarray(lengths * tick_s, dtype=np.float64))


def _number_distinct(lengths: IntArray) -> tuple[IntArray, IntArray]:
    """Return the index of each length among the sorted distinct lengths, and the distinct lengths.

    The lengths of uniform sampling differ only by rounding, and counting is faster than sorting.
    """
    min_length, interval_count = int(lengths[:-1].min(initial=2**62)), len(lengths) - 1
    differences = lengths[:interval_count] - min_length
    if interval_count == 0 or int(differences.max()) > _MAX_COUNTED_TICKS:
        values = _sort_distinct(lengths)
        return np.searchsorted(values, lengths).astype(np.int64), values
    differences_present = np.flatnonzero(np.bincount(differences))
    index_of_difference = np.zeros(differences_present[-1] + 1, dtype=np.int64)
    index_of_difference[differences_present] = np.arange(1, len(differences_present) + 1)
    return np.append(index_of_difference[differences], 0), np.concatenate(
        [[0], min_length + differences_present]
    )


def compute_step_matrices(
    group: LinearSystem | AxisGroup, lengths_s: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return exact steps over each length: state (k, n, n) and input (k, n, 2m + 1) matrices.

    The input columns are the m inputs, the constant force, and a unit force on each axis.
    """
    # A live run uses the same few lengths again and again, so each of them is cached.
    if len(lengths_s) <= _MAX_CACHED_LENGTHS:
        exact = np.stack([_compute_step(group, float(length)) for length in lengths_s])
    else:
        matrix_and_lengths = group.generator.tobytes(), lengths_s.tobytes()
        exact = _compute_many_steps(*matrix_and_lengths, len(group.generator), group.states)
    states = group.states
    return np.ascontiguousarray(exact[:, :, :states]), np.ascontiguousarray(exact[:, :, states:])


def _compute_step(group: LinearSystem | AxisGroup, length_s: float) -> FloatArray:
    """Return the rows of ``exp(A h)`` that belong to states."""
    size = len(group.generator)
    return _compute_exponential(group.generator.tobytes(), size, length_s)[: group.states]


@lru_cache(maxsize=1024)
def _compute_exponential(matrix_bytes: bytes, size: int, length_s: float) -> FloatArray:
    """Return ``exp(A h)``: the power series of a part of the step, squared up to the whole step.

    This needs no linear solves, as a Padé approximation does; a parallel linear algebra library
    makes those slow for such small matrices. The result is cached by the numbers in A, because a
    fit creates the same plant repeatedly.
    """
    generator = np.frombuffer(matrix_bytes).reshape(size, size)
    # Balancing makes the norm small, so that few doublings are needed; it is undone at the end.
    balanced, (scale, _) = scipy.linalg.matrix_balance(generator, permute=False, separate=True)
    doublings = max(int(np.ceil(np.log2(2.0 * length_s * np.linalg.norm(balanced, 1) + 1e-300))), 0)
    exact = _sum_series(
        np.asarray(balanced, dtype=np.float64), np.array([length_s * 0.5**doublings])
    )[0]
    for _ in range(doublings):
        exact = exact @ exact
    return np.asarray(exact * scale[:, None] / scale)


@lru_cache(maxsize=16)
def _compute_many_steps(matrix_bytes: bytes, lengths: bytes, size: int, states: int) -> FloatArray:
    """Return the steps of uneven sampling: ``exp(A h) = exp(A h₀) exp(A (h − h₀))``.

    h₀ is chosen from a grid so fine that the power series of the second factor converges to
    rounding. One matrix exponential then serves many lengths. The result is cached as a single step
    is, because a fit simulates the same uneven record repeatedly.
    """
    generator, lengths_s = np.frombuffer(matrix_bytes).reshape(size, size), np.frombuffer(lengths)
    balanced, _ = scipy.linalg.matrix_balance(generator, permute=False)
    # A static axis without states has a rate of zero: one step serves all its lengths.
    grid_step_s = 1.0 / max(float(np.linalg.norm(balanced, 1)), np.finfo(np.float64).tiny)
    bucket = np.rint(lengths_s / grid_step_s).astype(np.int64)
    series = _sum_series(generator, lengths_s - bucket * grid_step_s)
    exact = np.empty((len(lengths_s), states, size))
    for grid_index in np.unique(bucket):
        members = bucket == grid_index
        step = _compute_exponential(matrix_bytes, size, float(grid_index * grid_step_s))[:states]
        exact[members] = step @ series[members]
    exact.flags.writeable = False
    return exact


def _sum_series(generator: FloatArray, lengths_s: FloatArray) -> FloatArray:
    """Return the power series of ``exp(A h)``, (k, n, n), for lengths with ‖A h‖ ≤ 1/2."""
    # Stacked, the sums of all lengths are one matrix product.
    powers, weights = [np.eye(len(generator))], [np.ones(len(lengths_s))]
    for order in range(1, _SERIES_TERM_COUNT):
        powers.append(powers[-1] @ generator)
        weights.append(weights[-1] * lengths_s / order)
    flat = np.stack(weights, axis=1) @ np.stack(powers).reshape(_SERIES_TERM_COUNT, -1)
    return np.asarray(flat.reshape(len(lengths_s), *generator.shape))
