"""Exact steps through the segments of a run, laid out for the compiled loop."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.plant.coupled_groups import Group
from rotemina.sim.plant.kernel import Steps
from rotemina.sim.plant.zero_order_hold import Linear, Segments, Ticks, cut, step_matrices, ticks_of

_ROUNDING = 1e-6  # share of an inner step by which a length may exceed a whole number of them
_RUNG_OUT = 1e-6  # of a vibration, that is left when inner steps begin to grow
_GROWTH = 1.5  # from one length of inner steps to the next
_STEPS_A_LENGTH = 32  # so that a step is at most a 64th of the time since the input began to act


def steps_of_run(
    time_s: FloatArray,
    first: int,
    delays_s: tuple[float, ...],
    groups: Sequence[Group],
    *,
    inner_step_s: float,
    may_grow: bool,
    with_holds: bool,
) -> Steps:
    """Return the steps through samples (n,), of which those before ``first`` are history.

    ``delays_s`` is as in :func:`~rotemina.sim.plant.zero_order_hold.cut`, the rest as in
    :func:`steps_through`. Steps are kept by times and matrices: a fit simulates the same records
    with one plant after the other, and a live run repeats the same few rows.
    """
    run = ticks_of(time_s, first)
    return _steps(
        _segments(run.at.tobytes(), run.length_s, first, delays_s),
        tuple((group.generator.tobytes(), group.states) for group in groups),
        inner_step_s,
        may_grow=may_grow,
        with_holds=with_holds,
    )


@lru_cache(maxsize=16)
def _segments(ticks: bytes, tick_s: float, first: int, delays_s: tuple[float, ...]) -> Segments:
    return cut(Ticks(np.frombuffer(ticks, dtype=np.int64), tick_s), first, delays_s)


@lru_cache(maxsize=24)
def _steps(
    segments: Segments,
    groups: tuple[tuple[bytes, int], ...],
    inner_step_s: float,
    *,
    may_grow: bool,
    with_holds: bool,
) -> Steps:
    return steps_through(
        segments,
        [Linear.of(numbers, states) for numbers, states in groups],
        inner_step_s=inner_step_s,
        may_grow=may_grow,
        with_holds=with_holds,
    )


def steps_through(
    segments: Segments,
    groups: Sequence[Linear | Group],
    *,
    inner_step_s: float = np.inf,
    may_grow: bool = False,
    with_holds: bool = False,
) -> Steps:
    """Return the steps through ``segments``.

    In a hold that outlasts every vibration, steps may grow with the time since it began: what still
    changes then does so ever more slowly. So a row every ten seconds costs little more than one
    every tenth of a second.

    Parameters
    ----------
    segments : Segments
    groups : sequence of Group
    inner_step_s : float
        Longest step while anything rings; longer segments are done in several.
    may_grow : bool
        Let steps be longer later in a hold.
    with_holds : bool
        Tell for how long each input acts, which effects on inputs need to know.
    """
    hold = np.zeros((0, segments.applied.shape[1]))
    if with_holds:
        hold = _holds(segments)
    longest_s = float(segments.lengths_s.max())
    grows_after_s = _grows_after(groups, inner_step_s, longest_s) if may_grow else np.inf
    cut = [list(_pieces(float(s), inner_step_s, grows_after_s)) for s in segments.lengths_s]
    pieces = list(dict.fromkeys(piece for each in cut for piece in each))
    if len(pieces) > len(cut):
        segments, hold = _with_pieces(segments, hold, cut, pieces)
    count = np.array([piece.steps for piece in pieces], dtype=np.int64)
    inner = np.array([piece.length_s for piece in pieces]) / count
    matrices = [step_matrices(group, inner) for group in groups]
    state, state_at = _flat([states for states, _ in matrices])
    inputs, input_at = _flat([into for _, into in matrices])
    return Steps(
        segments.step,
        segments.sample,
        segments.applied,
        hold,
        inner,
        count,
        state,
        state_at,
        inputs,
        input_at,
    )


class _Piece(NamedTuple):
    """A part of a segment, done in equal steps."""

    length_s: float
    steps: int


def _grows_after(groups: Sequence[Linear | Group], inner_step_s: float, longest_s: float) -> float:
    """Return the time in a hold, s, from which inner steps may grow; infinite where they may not.

    An axis that nothing holds may ring at any time, where it meets something.
    """
    least_s = inner_step_s * _STEPS_A_LENGTH / (_GROWTH - 1.0)
    if longest_s <= _GROWTH * least_s:
        return np.inf
    for group in groups:
        rates = np.linalg.eigvals(group.generator[: group.states, : group.states])
        if np.any(rates.real >= -_ROUNDING * np.abs(rates)):
            return np.inf
        ringing = -rates.real[rates.imag != 0.0]
        least_s = max(least_s, -np.log(_RUNG_OUT) / ringing.min(initial=np.inf))
    return float(least_s)


def _pieces(length_s: float, inner_step_s: float, grows_after_s: float) -> Iterator[_Piece]:
    """Cut one length into pieces, each with equal steps, that grow from one to the next."""

    def equal(piece_s: float, step_s: float) -> _Piece:
        return _Piece(piece_s, max(int(np.ceil(piece_s / step_s - _ROUNDING)), 1))

    if length_s <= _GROWTH * grows_after_s:
        yield equal(length_s, inner_step_s)
        return
    yield equal(grows_after_s, inner_step_s)
    begin_s = grows_after_s
    while begin_s < length_s:
        most_s = (_GROWTH - 1.0) * begin_s
        yield equal(min(most_s, length_s - begin_s), most_s / _STEPS_A_LENGTH)
        begin_s += most_s


def _with_pieces(
    segments: Segments, hold: FloatArray, cut: Sequence[Sequence[_Piece]], pieces: Sequence[_Piece]
) -> tuple[Segments, FloatArray]:
    """Return segments cut into pieces, and for how long each input acts."""
    place = {piece: number for number, piece in enumerate(pieces)}
    numbers = [np.array([place[piece] for piece in each], dtype=np.int64) for each in cut]
    times = np.array([len(each) for each in cut])[segments.step]
    first = np.cumsum(times) - times
    sample = np.full(int(times.sum()), -1, dtype=np.int64)
    sample[first] = segments.sample
    step = np.concatenate([numbers[number] for number in segments.step])
    applied = np.repeat(segments.applied, times, axis=0)
    if len(hold):
        hold = np.repeat(hold, times, axis=0)
    lengths_s = np.array([piece.length_s for piece in pieces])
    return Segments(sample, applied, step, lengths_s), hold


def _flat(matrices: Sequence[FloatArray]) -> tuple[FloatArray, IntArray]:
    """Return all matrices in one row, and where each group's begin."""
    parts = [matrix.ravel() for matrix in matrices]
    begin = np.cumsum([0] + [len(part) for part in parts], dtype=np.int64)[:-1]
    return np.concatenate([*parts, np.zeros(1)]), begin


def _holds(segments: Segments) -> FloatArray:
    """Return for how long the input applied at each segment acts on, (s, d), within the run."""
    lengths = segments.lengths_s[segments.step]
    if segments.applied.shape[1] == 1 and (np.diff(segments.applied[:, 0]) > 0).all():
        return lengths[:, None]  # no input is late: each acts for one segment
    begin = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    end = float(begin[-1] + lengths[-1])
    hold = np.empty(segments.applied.shape)
    for column, applied in enumerate(segments.applied.T):
        changes = np.diff(applied, prepend=applied[:1]) != 0
        until = np.append(begin[changes], end)
        hold[:, column] = until[np.cumsum(changes)] - begin
    return hold
