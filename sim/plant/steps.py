"""Exact steps through the segments of a run, laid out for the compiled loop."""

from collections.abc import Sequence

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.plant.group import Group
from rotemina.sim.plant.kernel import Steps
from rotemina.sim.plant.sampling import Segments, step_matrices

_ROUNDING = 1e-6  # share of an inner step by which a length may exceed a whole number of them


def steps_through(
    segments: Segments,
    groups: Sequence[Group],
    *,
    inner_step_s: float = np.inf,
    with_holds: bool = False,
) -> Steps:
    """Return the steps through ``segments``.

    Parameters
    ----------
    segments : Segments
    groups : sequence of Group
    inner_step_s : float
        Longest step; longer segments are done in several equal ones.
    with_holds : bool
        Tell for how long each input acts, which effects on inputs need to know.
    """
    lengths = segments.lengths_s
    count = np.maximum(np.ceil(lengths / inner_step_s - _ROUNDING), 1.0).astype(np.int64)
    inner = lengths / count
    matrices = [step_matrices(group, inner) for group in groups]
    state, state_at = _flat([states for states, _ in matrices])
    inputs, input_at = _flat([into for _, into in matrices])
    hold = np.zeros((0, segments.applied.shape[1]))
    if with_holds:
        hold = _holds(segments)
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
