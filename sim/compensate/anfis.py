"""An adaptive neuro-fuzzy inference system (Takagi and Sugeno), trained after Jang.

    x = Σ_r φ_r (a_r0 + a_r1 z + Σ_j a_r,j+1 E_j),   φ_r = Π_i μ_ri(v_i) / Σ_s Π_i μ_si(v_i)

Each epoch solves for the consequents ``a`` by least squares. Then it moves the centres and widths
of the memberships μ against the gradient (Jang, IEEE Transactions on Systems, Man, and Cybernetics
23 (1993) 665–685). As in that paper, the step grows after four improvements in a row and shrinks
after a deterioration. The rules are tied to the single rule that fits best. So a rule that few rows
determine stays close to the others.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.compensate import kernel
from rotemina.sim.compensate.inverse_parameters import RulePremises
from rotemina.sim.errors import ConvergenceError
from rotemina.sim.messages import format_rounded

Listener = Callable[[int, int, float], None]

# Strengths of the tie to the single rule, relative to the weight of the rows. The one with the
# smallest validation error is used.
_TIE_STRENGTHS = (1e-5, 1e-4, 1e-3)
_FIRST_STEP, _STEP_GROWTH, _STEP_SHRINKAGE = 0.02, 1.1, 0.5
_MIN_WIDTH, _MAX_WIDTH = 0.03, 3.0
# At most this many rows move the memberships. All rows determine the consequents.
_MAX_DESCENT_ROWS = 12_000


@dataclass(frozen=True, slots=True)
class AnfisSettings:
    """Settings of an ANFIS and its training.

    Attributes
    ----------
    memberships : number of membership functions for each premise input.
    plays : plays that are premise inputs in addition to the position, as shares 0 … 1 of the
        number of plays.
    epochs : largest number of epochs.
    patience : epochs without an improvement on the validation rows, after which training ends.
    """

    memberships: int = 5
    plays: tuple[float, ...] = ()
    epochs: int = 30
    patience: int = 8


@dataclass(frozen=True, slots=True, eq=False)
class TrainedAnfis:
    """A trained system and the history (epochs, 2) of its rms errors: training, validation."""

    premises: RulePremises
    consequents: FloatArray
    history: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class _TrainingRows:
    """Normalised training rows.

    Attributes
    ----------
    columns : (n, c) of the consequents.
    inputs : (n, k) of the premises.
    goals : (n,) commands to be learnt.
    """

    columns: FloatArray
    inputs: FloatArray
    goals: FloatArray

    def select(self, selection: BoolArray | slice) -> "_TrainingRows":
        return _TrainingRows(self.columns[selection], self.inputs[selection], self.goals[selection])


def train(
    columns: FloatArray,
    radii: FloatArray,
    goals: FloatArray,
    validation: BoolArray,
    settings: AnfisSettings,
    listener: Listener | None = None,
) -> TrainedAnfis:
    """Train a system for the commands ``goals`` (n,).

    ``columns`` (n, 2 + p) are 1, z and the stops. The rows where ``validation`` (n,) is true decide
    when the training ends and how strongly the rules are tied.

    Raises
    ------
    ConvergenceError
        If the final error is not finite, or not below that of a constant command.
    """
    plays = (-1, *(min(int(share * len(radii)), len(radii) - 1) for share in settings.plays))
    inputs = np.column_stack(
        [columns[:, 1] if j < 0 else columns[:, 2 + j] / radii[j] for j in plays]
    )
    rows = _TrainingRows(columns, inputs, goals)
    training_rows, validation_rows = rows.select(~validation), rows.select(validation)
    memberships = _spread_memberships(inputs, settings.memberships)
    tie_strength = min(
        _TIE_STRENGTHS,
        key=lambda strength: _rms(
            validation_rows, memberships, _solve_consequents(training_rows, memberships, strength)
        ),
    )
    memberships, history = _descend(
        training_rows, validation_rows, memberships, tie_strength, settings, listener
    )
    consequents = _solve_consequents(rows, memberships, tie_strength)
    error = _rms(rows, memberships, consequents)
    command_std = float(np.std(goals))
    if not np.isfinite(error) or error >= command_std:
        raise ConvergenceError(
            "ANFIS: the training did not converge: after {count} epochs it leaves "
            "{error} rms of commands that vary by {spread}; nothing was replaced. Record "
            "slower motions over the whole range, or use another kind",
            count=len(history),
            error=format_rounded(error, 3),
            spread=format_rounded(command_std, 3),
        )
    return TrainedAnfis(RulePremises(plays, memberships[0], memberships[1]), consequents, history)


def _spread_memberships(inputs: FloatArray, count: int) -> FloatArray:
    """Return memberships (2, k, m) evenly spaced over each input; neighbours meet at one half."""
    low, high = inputs.min(axis=0), inputs.max(axis=0)
    share = np.linspace(0.0, 1.0, count)
    centres = low[:, None] + (high - low)[:, None] * share
    half_distance = 0.5 * (high - low) / max(count - 1, 1)
    widths = np.repeat(half_distance[:, None] / np.sqrt(2.0 * np.log(2.0)), count, axis=1)
    return np.stack([centres, np.maximum(widths, _MIN_WIDTH)])


def _solve_consequents(
    rows: _TrainingRows, memberships: FloatArray, tie_strength: float
) -> FloatArray:
    """Return consequents (rules, c), tied to those of the single rule that fits best."""
    count = rows.columns.shape[1]
    square = rows.columns.T @ rows.columns
    square[np.diag_indices(count)] += 1e-9 * len(rows.goals)
    single_rule = np.linalg.solve(square, rows.columns.T @ rows.goals)
    grades = kernel.grade_rules(memberships, rows.inputs)
    products = (grades[:, :, None] * rows.columns[:, None, :]).reshape(len(grades), -1)
    square = products.T @ products
    square[np.diag_indices_from(square)] += (
        tie_strength * len(grades) / grades.shape[1] * _compute_tie_weights(rows, grades)
    )
    residual = rows.goals - rows.columns @ single_rule
    return np.asarray(
        single_rule + np.linalg.solve(square, products.T @ residual).reshape(-1, count)
    )


def _compute_tie_weights(rows: _TrainingRows, grades: FloatArray) -> FloatArray:
    """Return the mean square of each column for every rule, which scales the tie."""
    return np.tile(np.mean(rows.columns**2, axis=0) + 1e-12, grades.shape[1])


def _infer_commands(
    rows: _TrainingRows, memberships: FloatArray, consequents: FloatArray
) -> FloatArray:
    grades = kernel.grade_rules(memberships, rows.inputs)
    return np.asarray(np.einsum("nr,nr->n", grades, rows.columns @ consequents.T))


def _rms(rows: _TrainingRows, memberships: FloatArray, consequents: FloatArray) -> float:
    return float(
        np.sqrt(np.mean((_infer_commands(rows, memberships, consequents) - rows.goals) ** 2))
    )


def _descend(
    training_rows: _TrainingRows,
    validation_rows: _TrainingRows,
    memberships: FloatArray,
    tie_strength: float,
    settings: AnfisSettings,
    listener: Listener | None,
) -> tuple[FloatArray, FloatArray]:
    descent_rows = training_rows.select(
        slice(None, None, max(len(training_rows.goals) // _MAX_DESCENT_ROWS, 1))
    )
    best, step, stale_epochs, improvements = memberships, _FIRST_STEP, 0, 0
    lowest_error, previous_error = np.inf, np.inf
    history = []
    for epoch in range(settings.epochs):
        consequents = _solve_consequents(descent_rows, memberships, tie_strength)
        error, validation_error = (
            _rms(descent_rows, memberships, consequents),
            _rms(validation_rows, memberships, consequents),
        )
        history.append((error, validation_error))
        if listener is not None:
            listener(epoch + 1, settings.epochs, validation_error)
        if validation_error < lowest_error * (1.0 - 1e-3):
            best, lowest_error, stale_epochs = memberships, validation_error, 0
        else:
            stale_epochs += 1
        if stale_epochs >= settings.patience or not np.isfinite(error):
            break
        improvements = improvements + 1 if error < previous_error else 0
        step *= (
            _STEP_SHRINKAGE
            if error >= previous_error
            else (_STEP_GROWTH if improvements >= 4 else 1.0)
        )
        previous_error = error
        memberships = _step_memberships(descent_rows, memberships, consequents, step)
    return best, np.array(history)


def _step_memberships(
    rows: _TrainingRows, memberships: FloatArray, consequents: FloatArray, step: float
) -> FloatArray:
    gradient = _compute_gradient(rows, memberships, consequents)
    norm = float(np.linalg.norm(gradient))
    new_memberships = memberships - step * gradient / norm if norm > 0.0 else memberships.copy()
    new_memberships[1] = np.clip(new_memberships[1], _MIN_WIDTH, _MAX_WIDTH)
    return np.asarray(new_memberships)


def _compute_gradient(
    rows: _TrainingRows, memberships: FloatArray, consequents: FloatArray
) -> FloatArray:
    """Return the derivatives (2, k, m) of the mean square error by centres and widths.

    ``∂x/∂ln μ_im = Σ_{r with m of i} φ_r (x_r − x)`` holds if the rules are the normalised
    products of all combinations of memberships.
    """
    grades = kernel.grade_rules(memberships, rows.inputs)
    rule_commands = rows.columns @ consequents.T
    command = np.einsum("nr,nr->n", grades, rule_commands)
    sensitivity = (
        2.0
        * (command - rows.goals)[:, None]
        * grades
        * (rule_commands - command[:, None])
        / len(grades)
    )
    inputs, count = memberships.shape[1:]
    sensitivity = sensitivity.reshape(len(grades), *(count,) * inputs)
    gradient = np.empty_like(memberships)
    for i in range(inputs):
        others = tuple(1 + k for k in range(inputs) if k != i)
        distance = (rows.inputs[:, i, None] - memberships[0, i]) / memberships[1, i]
        scaled_sensitivity = sensitivity.sum(axis=others) / memberships[1, i]
        gradient[0, i] = np.sum(scaled_sensitivity * distance, axis=0)
        gradient[1, i] = np.sum(scaled_sensitivity * distance**2, axis=0)
    return gradient
