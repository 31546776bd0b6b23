"""An adaptive neuro-fuzzy inference system (Takagi and Sugeno), trained after Jang.

    x = Σ_r φ_r (a_r0 + a_r1 z + Σ_j a_r,j+1 E_j),   φ_r = Π_i μ_ri(v_i) / Σ_s Π_i μ_si(v_i)

Each epoch solves for the consequents ``a`` by least squares and then moves centres and widths of
the memberships μ against the gradient (Jang, IEEE Transactions on Systems, Man, and Cybernetics 23
(1993) 665–685). The step grows after four gains in a row and shrinks after a loss, as there. Rules
are held to the one that serves all of them, so that a rule which few rows know does not run wild.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.compensate import kernel
from rotemina.sim.compensate.errors import ConvergenceError
from rotemina.sim.compensate.inverse_parameters import Premises
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

Listener = Callable[[int, int, float], None]

_TIES = (1e-5, 1e-4, 1e-3)  # how firmly, beside the rows' own weight
_STEP, _GROWTH, _SHRINKAGE = 0.02, 1.1, 0.5
_LEAST_WIDTH, _MOST_WIDTH = 0.03, 3.0
_ROWS = 12_000  # to move the memberships by; all rows settle the consequents


@dataclass(frozen=True, slots=True)
class Settings:
    """How an ANFIS is made and trained.

    Attributes
    ----------
    memberships : of each input of the premises.
    plays : inputs besides the position, shares of the number of plays.
    epochs : at most.
    patience : epochs without a gain on the rows kept for validation, after which it ends.
    """

    memberships: int = 5
    plays: tuple[float, ...] = ()
    epochs: int = 30
    patience: int = 8


@dataclass(frozen=True, slots=True, eq=False)
class Anfis:
    """A trained system, and the history (epochs, 2) of its rms errors: training, validation."""

    premises: Premises
    consequents: FloatArray
    history: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class _Rows:
    """Consequents' columns (n, c), premises' inputs (n, k) and commands (n,), shares."""

    columns: FloatArray
    inputs: FloatArray
    goals: FloatArray

    def those(self, which: BoolArray | slice) -> "_Rows":
        return _Rows(self.columns[which], self.inputs[which], self.goals[which])


def train(
    columns: FloatArray,
    radii: FloatArray,
    goals: FloatArray,
    validation: BoolArray,
    settings: Settings,
    listener: Listener | None = None,
) -> Anfis:
    """Train a system on ``columns`` (n, 2 + p): 1, z and the stops; commands ``goals`` (n,).

    Rows where ``validation`` (n,) holds decide when it ends and how firmly rules are tied.

    Raises
    ------
    ConvergenceError
        If it comes to no error below that of a constant command, or to none that is finite.
    """
    plays = (-1, *(min(int(share * len(radii)), len(radii) - 1) for share in settings.plays))
    inputs = np.column_stack(
        [columns[:, 1] if j < 0 else columns[:, 2 + j] / radii[j] for j in plays]
    )
    rows = _Rows(columns, inputs, goals)
    fitted, kept = rows.those(~validation), rows.those(validation)
    grid = _spread(inputs, settings.memberships)
    tie = min(_TIES, key=lambda each: _rms(kept, grid, _solve(fitted, grid, each)))
    grid, history = _descend(fitted, kept, grid, tie, settings, listener)
    consequents = _solve(rows, grid, tie)
    error = _rms(rows, grid, consequents)
    spread = float(np.std(goals))
    if not np.isfinite(error) or error >= spread:
        raise ConvergenceError(
            message(
                "engine",
                "ANFIS: the training did not converge: after {count} epochs it leaves "
                "{error} rms of commands that vary by {spread}; nothing was replaced. Record "
                "slower motions over the whole range, or use another kind",
            ).fill(count=len(history), error=rounded(error, 3), spread=rounded(spread, 3))
        )
    return Anfis(Premises(plays, grid[0], grid[1]), consequents, history)


def _spread(inputs: FloatArray, count: int) -> FloatArray:
    """Return memberships (2, k, m) evenly over each input, neighbours meeting at a half."""
    low, high = inputs.min(axis=0), inputs.max(axis=0)
    share = np.linspace(0.0, 1.0, count)
    centres = low[:, None] + (high - low)[:, None] * share
    half = 0.5 * (high - low) / max(count - 1, 1)
    widths = np.repeat(half[:, None] / np.sqrt(2.0 * np.log(2.0)), count, axis=1)
    return np.stack([centres, np.maximum(widths, _LEAST_WIDTH)])


def _solve(rows: _Rows, grid: FloatArray, tie: float) -> FloatArray:
    """Return consequents (rules, c), tied to those of the single rule that fits best."""
    count = rows.columns.shape[1]
    square = rows.columns.T @ rows.columns
    square[np.diag_indices(count)] += 1e-9 * len(rows.goals)
    single = np.linalg.solve(square, rows.columns.T @ rows.goals)
    held = kernel.graded(grid, rows.inputs)
    wide = (held[:, :, None] * rows.columns[:, None, :]).reshape(len(held), -1)
    square = wide.T @ wide
    square[np.diag_indices_from(square)] += tie * len(held) / held.shape[1] * _weights(rows, held)
    left = rows.goals - rows.columns @ single
    return np.asarray(single + np.linalg.solve(square, wide.T @ left).reshape(-1, count))


def _weights(rows: _Rows, held: FloatArray) -> FloatArray:
    """Return the mean square of each column, for every rule: what a tie is measured by."""
    return np.tile(np.mean(rows.columns**2, axis=0) + 1e-12, held.shape[1])


def _answers(rows: _Rows, grid: FloatArray, consequents: FloatArray) -> FloatArray:
    held = kernel.graded(grid, rows.inputs)
    return np.asarray(np.einsum("nr,nr->n", held, rows.columns @ consequents.T))


def _rms(rows: _Rows, grid: FloatArray, consequents: FloatArray) -> float:
    return float(np.sqrt(np.mean((_answers(rows, grid, consequents) - rows.goals) ** 2)))


def _descend(
    fitted: _Rows,
    kept: _Rows,
    grid: FloatArray,
    tie: float,
    settings: Settings,
    listener: Listener | None,
) -> tuple[FloatArray, FloatArray]:
    """Return the memberships that serve the rows kept for validation best, and the history."""
    few = fitted.those(slice(None, None, max(len(fitted.goals) // _ROWS, 1)))
    best, step, since, gains = grid, _STEP, 0, 0
    lowest, last = np.inf, np.inf
    history = []
    for epoch in range(settings.epochs):
        consequents = _solve(few, grid, tie)
        error, unseen = _rms(few, grid, consequents), _rms(kept, grid, consequents)
        history.append((error, unseen))
        if listener is not None:
            listener(epoch + 1, settings.epochs, unseen)
        if unseen < lowest * (1.0 - 1e-3):
            best, lowest, since = grid, unseen, 0
        else:
            since += 1
        if since >= settings.patience or not np.isfinite(error):
            break
        gains = gains + 1 if error < last else 0
        step *= _SHRINKAGE if error >= last else (_GROWTH if gains >= 4 else 1.0)
        last = error
        grid = _moved(few, grid, consequents, step)
    return best, np.array(history)


def _moved(rows: _Rows, grid: FloatArray, consequents: FloatArray, step: float) -> FloatArray:
    """Return the memberships a step of such length, in all, against the gradient of the error."""
    gradient = _gradient(rows, grid, consequents)
    size = float(np.linalg.norm(gradient))
    out = grid - step * gradient / size if size > 0.0 else grid.copy()
    out[1] = np.clip(out[1], _LEAST_WIDTH, _MOST_WIDTH)
    return np.asarray(out)


def _gradient(rows: _Rows, grid: FloatArray, consequents: FloatArray) -> FloatArray:
    """Return the mean square error's derivatives (2, k, m) by centres and widths.

    ``∂x/∂ln μ_im = Σ_{r holding m of i} φ_r (x_r − x)`` for a normalised product over a grid.
    """
    held = kernel.graded(grid, rows.inputs)
    each = rows.columns @ consequents.T
    answer = np.einsum("nr,nr->n", held, each)
    pull = 2.0 * (answer - rows.goals)[:, None] * held * (each - answer[:, None]) / len(held)
    inputs, count = grid.shape[1:]
    pull = pull.reshape(len(held), *(count,) * inputs)
    out = np.empty_like(grid)
    for i in range(inputs):
        others = tuple(1 + k for k in range(inputs) if k != i)
        away = (rows.inputs[:, i, None] - grid[0, i]) / grid[1, i]
        share = pull.sum(axis=others) / grid[1, i]
        out[0, i] = np.sum(share * away, axis=0)
        out[1, i] = np.sum(share * away**2, axis=0)
    return out
