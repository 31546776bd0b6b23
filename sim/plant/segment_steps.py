"""Exact steps through the segments of a run, arranged for the compiled loop."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.plant.coupled_groups import AxisGroup
from rotemina.sim.plant.kernel import KernelSteps
from rotemina.sim.plant.zero_order_hold import (
    LinearSystem,
    RunSegments,
    SampleTicks,
    compute_step_matrices,
    cut_run,
    make_ticks,
)

# Rounding may make a length exceed a whole number of inner steps by this fraction of a step.
_LENGTH_SLACK_RATIO = 1e-6
# Fraction of a vibration that remains when inner steps begin to grow.
_RESIDUAL_VIBRATION_RATIO = 1e-6
# Ratio of the time in a hold at the end of a piece to that at its beginning.
_PIECE_GROWTH_RATIO = 1.5
# With this number, a step is at most a 64th of the time since the input began to act.
_STEPS_PER_PIECE = 32


def make_steps_of_run(
    time_s: FloatArray,
    first: int,
    delays_s: tuple[float, ...],
    groups: Sequence[AxisGroup],
    *,
    inner_step_s: float,
    may_grow: bool,
    with_holds: bool,
) -> KernelSteps:
    """Return the steps through samples (n,), of which those before ``first`` are history.

    ``delays_s`` is as in :func:`~rotemina.sim.plant.cut_run`, the other parameters
    as in :func:`make_steps`. The steps are cached by times and matrices, because a fit simulates
    the same records with many plants, and a live run repeats the same few rows.
    """
    run = make_ticks(time_s, first)
    return _make_steps(
        _cut_segments(run.at.tobytes(), run.length_s, first, delays_s),
        tuple((group.generator.tobytes(), group.states) for group in groups),
        inner_step_s,
        may_grow=may_grow,
        with_holds=with_holds,
    )


@lru_cache(maxsize=16)
def _cut_segments(
    ticks: bytes, tick_s: float, first: int, delays_s: tuple[float, ...]
) -> RunSegments:
    return cut_run(SampleTicks(np.frombuffer(ticks, dtype=np.int64), tick_s), first, delays_s)


@lru_cache(maxsize=24)
def _make_steps(
    segments: RunSegments,
    groups: tuple[tuple[bytes, int], ...],
    inner_step_s: float,
    *,
    may_grow: bool,
    with_holds: bool,
) -> KernelSteps:
    return make_steps(
        segments,
        [LinearSystem.of(numbers, states) for numbers, states in groups],
        inner_step_s=inner_step_s,
        may_grow=may_grow,
        with_holds=with_holds,
    )


def make_steps(
    segments: RunSegments,
    groups: Sequence[LinearSystem | AxisGroup],
    *,
    inner_step_s: float = np.inf,
    may_grow: bool = False,
    with_holds: bool = False,
) -> KernelSteps:
    """Return the steps through ``segments``.

    In a hold that outlasts every vibration, the steps may grow with the time since the hold began,
    because the remaining changes become ever slower. A row every ten seconds then costs little more
    than one every tenth of a second.

    Parameters
    ----------
    segments : RunSegments
    groups : sequence of AxisGroup
    inner_step_s : float
        Longest step while anything vibrates; longer segments are divided.
    may_grow : bool
        Whether steps may become longer later in a hold.
    with_holds : bool
        Whether to compute how long each input acts, which effects on inputs need.
    """
    hold_times_s = np.zeros((0, segments.applied.shape[1]))
    if with_holds:
        hold_times_s = _compute_holds(segments)
    longest_s = float(segments.lengths_s.max())
    grows_after_s = _find_growth_start(groups, inner_step_s, longest_s) if may_grow else np.inf
    cut_lengths = [
        list(_cut_length(float(s), inner_step_s, grows_after_s)) for s in segments.lengths_s
    ]
    # Segments of equal length share their pieces, and therefore their matrices.
    pieces = list(dict.fromkeys(piece for cut_length in cut_lengths for piece in cut_length))
    if len(pieces) > len(cut_lengths):
        segments, hold_times_s = _split_segments(segments, hold_times_s, cut_lengths, pieces)
    step_counts = np.array([piece.steps for piece in pieces], dtype=np.int64)
    step_lengths_s = np.array([piece.length_s for piece in pieces]) / step_counts
    matrices = [compute_step_matrices(group, step_lengths_s) for group in groups]
    state, state_at = _flatten([states for states, _ in matrices])
    inputs, input_at = _flatten([input_matrices for _, input_matrices in matrices])
    return KernelSteps(
        segments.step,
        segments.sample,
        segments.applied,
        hold_times_s,
        step_lengths_s,
        step_counts,
        state,
        state_at,
        inputs,
        input_at,
    )


class _Piece(NamedTuple):
    length_s: float
    steps: int


def _find_growth_start(
    groups: Sequence[LinearSystem | AxisGroup], inner_step_s: float, longest_s: float
) -> float:
    """Return the time in a hold, s, after which inner steps may grow; infinite if they may not.

    An axis without stiffness may start to vibrate at any time, when it meets a contact.
    """
    start_s = inner_step_s * _STEPS_PER_PIECE / (_PIECE_GROWTH_RATIO - 1.0)
    if longest_s <= _PIECE_GROWTH_RATIO * start_s:
        return np.inf
    for group in groups:
        rates = np.linalg.eigvals(group.generator[: group.states, : group.states])
        if np.any(rates.real >= -_LENGTH_SLACK_RATIO * np.abs(rates)):
            return np.inf
        decay_rates = -rates.real[rates.imag != 0.0]
        start_s = max(start_s, -np.log(_RESIDUAL_VIBRATION_RATIO) / decay_rates.min(initial=np.inf))
    return float(start_s)


def _cut_length(length_s: float, inner_step_s: float, grows_after_s: float) -> Iterator[_Piece]:
    def make_piece(piece_s: float, step_s: float) -> _Piece:
        return _Piece(piece_s, max(int(np.ceil(piece_s / step_s - _LENGTH_SLACK_RATIO)), 1))

    if length_s <= _PIECE_GROWTH_RATIO * grows_after_s:
        yield make_piece(length_s, inner_step_s)
        return
    yield make_piece(grows_after_s, inner_step_s)
    begin_s = grows_after_s
    while begin_s < length_s:
        longest_s = (_PIECE_GROWTH_RATIO - 1.0) * begin_s
        yield make_piece(min(longest_s, length_s - begin_s), longest_s / _STEPS_PER_PIECE)
        begin_s += longest_s


def _split_segments(
    segments: RunSegments,
    hold_times_s: FloatArray,
    cut_lengths: Sequence[Sequence[_Piece]],
    pieces: Sequence[_Piece],
) -> tuple[RunSegments, FloatArray]:
    index_of_piece = {piece: index for index, piece in enumerate(pieces)}
    piece_indices = [
        np.array([index_of_piece[piece] for piece in pieces_of_length], dtype=np.int64)
        for pieces_of_length in cut_lengths
    ]
    piece_counts = np.array([len(pieces_of_length) for pieces_of_length in cut_lengths])[
        segments.step
    ]
    first_rows = np.cumsum(piece_counts) - piece_counts
    sample = np.full(int(piece_counts.sum()), -1, dtype=np.int64)
    sample[first_rows] = segments.sample
    step = np.concatenate([piece_indices[length_index] for length_index in segments.step])
    applied = np.repeat(segments.applied, piece_counts, axis=0)
    if len(hold_times_s):
        hold_times_s = np.repeat(hold_times_s, piece_counts, axis=0)
    lengths_s = np.array([piece.length_s for piece in pieces])
    return RunSegments(sample, applied, step, lengths_s), hold_times_s


def _flatten(matrices: Sequence[FloatArray]) -> tuple[FloatArray, IntArray]:
    parts = [matrix.ravel() for matrix in matrices]
    begin = np.cumsum([0] + [len(part) for part in parts], dtype=np.int64)[:-1]
    return np.concatenate([*parts, np.zeros(1)]), begin


def _compute_holds(segments: RunSegments) -> FloatArray:
    """Return the times (s, d) for which the input applied at each segment acts within the run."""
    lengths = segments.lengths_s[segments.step]
    if segments.applied.shape[1] == 1 and (np.diff(segments.applied[:, 0]) > 0).all():
        # No input is delayed: each acts for one segment.
        return lengths[:, None]
    begin_s = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    run_end_s = float(begin_s[-1] + lengths[-1])
    hold_times_s = np.empty(segments.applied.shape)
    for column, applied in enumerate(segments.applied.T):
        changes = np.diff(applied, prepend=applied[:1]) != 0
        end_s = np.append(begin_s[changes], run_end_s)
        hold_times_s[:, column] = end_s[np.cumsum(changes)] - begin_s
    return hold_times_s
