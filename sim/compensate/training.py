"""Training of all kinds of inverses on the same rows, and their comparison on held-out rows."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.compensate import anfis
from rotemina.sim.compensate.inverse_parameters import InverseKind, InverseModel
from rotemina.sim.compensate.judgement import (
    InverseResidual,
    compute_residual,
    explain_recommendation,
    recommend_kind,
)
from rotemina.sim.compensate.lag_and_creep import (
    LagAndCreep,
    find_axis_stops,
    fit_lag_and_creep,
    make_radii,
)
from rotemina.sim.compensate.modified_prandtl_ishlinskii import fit_modified
from rotemina.sim.compensate.prandtl_ishlinskii import PrandtlIshlinskii, fit_hysteresis
from rotemina.sim.compensate.samples import TrainingSamples, check_common_rate, have_one_size
from rotemina.sim.errors import CompensationError
from rotemina.sim.messages import (
    Message,
    marked,
    message,
)
from rotemina.sim.robot import PiezoAxis, Robot
from rotemina.sim.units import format_percent

Listener = Callable[[str, float], None]

# Share of the known rows, at the end of each run, that is held out if there is no other record.
HELD_OUT_SHARE = 0.25
# Share of the training rows that is used for validation, in blocks.
_VALIDATION_SHARE = 0.2
_BLOCK_COUNT = 20
_MIN_TRAINING_ROWS = 500
# Positions that are outside the range by more than this share of it must have another origin.
_MAX_OUTSIDE_SHARE = 0.2


@dataclass(frozen=True, slots=True, eq=False)
class TrainingResult:
    """The result of a training.

    Attributes
    ----------
    models : by kind, in the order of ``INVERSE_KINDS``.
    residuals : by kind, on rows that were not used for training.
    recommended_kind : InverseKind
    remarks : further messages.
    """

    models: dict[InverseKind, InverseModel]
    residuals: dict[InverseKind, InverseResidual]
    recommended_kind: InverseKind
    remarks: tuple[str, ...] = ()

    @property
    def recommendation_reason(self) -> Message:
        """The reason for the recommendation."""
        return explain_recommendation(self.residuals, self.recommended_kind)


def train(
    robot: Robot,
    samples: Sequence[TrainingSamples],
    held_out: Sequence[TrainingSamples] = (),
    *,
    settings: anfis.AnfisSettings | None = None,
    listener: Listener | None = None,
) -> TrainingResult:
    """Train the inverses of an axis on some runs, and judge them on others.

    Parameters
    ----------
    robot : Robot
    samples : runs to train on, all at one rate.
    held_out : runs to judge on; by default, the last quarter of each of ``samples``.
    settings : of the ANFIS.
    listener : called with a description of the present step, and the completed share of the
        training.

    Raises
    ------
    CompensationError
        If the runs do not fit together or have too few rows.
    ConvergenceError
        If no kind of inverse converges. If only the ANFIS fails, the remarks contain the reason.
    """
    report = listener or _ignore_progress
    first_run = check_common_rate([*samples, *held_out])
    report(marked("engine", "lag and creep"), 0.0)
    training_ends = [_find_training_end(run, use_all=bool(held_out)) for run in samples]
    training_runs = [
        replace(run, command=run.command[:end], position=run.position[:end])
        for run, end in zip(samples, training_ends, strict=True)
    ]
    if sum(len(run.command) - run.first for run in training_runs) < _MIN_TRAINING_ROWS:
        raise CompensationError(
            "{name}: axis {axis}: fewer than {fewest} rows are left to train on, after "
            "the first swing over the whole range; record longer",
            name=first_run.name,
            axis=first_run.axis,
            fewest=_MIN_TRAINING_ROWS,
        )
    axis = robot.axes[first_run.axis]
    assert isinstance(axis, PiezoAxis)
    low = axis.range[0]
    stages = fit_lag_and_creep(
        training_runs,
        _find_origin(axis, training_runs),
        low,
        axis.span,
        _compute_min_lag_s(axis, first_run),
    )
    pool = _make_pool(stages, training_runs)
    report(marked("engine", "plays"), 0.3)
    common = _collect_common_values(axis, training_runs, stages)
    models: dict[InverseKind, InverseModel] = {}
    remarks: list[str] = []

    def report_epoch(epoch: int, epochs: int, error: float) -> None:
        report(
            message("engine", "ANFIS, epoch {epoch}: {error} unseen").fill(
                epoch=epoch, error=format_percent(error)
            ),
            0.4 + 0.55 * epoch / epochs,
        )

    try:
        models["anfis"] = _train_anfis(
            common, pool, settings or anfis.AnfisSettings(), report_epoch
        )
    except CompensationError as error:
        remarks.append(str(error))
    models["modified_prandtl_ishlinskii"] = _fit_modified_inverse(common, pool)
    models["prandtl_ishlinskii"] = _fit_classical_inverse(common, pool)
    models["linear"] = _fit_linear_inverse(common, training_runs)
    judged_runs = [(run, run.first) for run in held_out] or list(
        zip(samples, training_ends, strict=True)
    )
    residuals = {kind: compute_residual(model, judged_runs) for kind, model in models.items()}
    recommended = recommend_kind(residuals, one_size=have_one_size(training_runs))
    report(marked("engine", "done"), 1.0)
    return TrainingResult(models, residuals, recommended, tuple(remarks))


def _ignore_progress(_what: str, _share: float) -> None:
    pass


def _find_training_end(samples: TrainingSamples, *, use_all: bool) -> int:
    rows = len(samples.command)
    return rows if use_all else rows - int(HELD_OUT_SHARE * (rows - samples.first))


def _compute_min_lag_s(axis: PiezoAxis, samples: TrainingSamples) -> float:
    """Return the smallest possible lag, s: half a sample for the held command, and 2ζ/ω."""
    if axis.inertia is None:
        # The position is read before the next command acts.
        return samples.sample_s
    return 0.5 * samples.sample_s + axis.inertia.damping / axis.inertia.stiffness


def _find_origin(axis: PiezoAxis, samples: Sequence[TrainingSamples]) -> float:
    """Return an approximate position of the low end.

    That is the low end of the axis' range if the positions are close to that range, otherwise the
    lowest position.
    """
    low = min(float(run.position[run.first :].min()) for run in samples)
    high = max(float(run.position[run.first :].max()) for run in samples)
    margin = _MAX_OUTSIDE_SHARE * axis.span
    return axis.range[0] if low > axis.range[0] - margin and high < axis.range[1] + margin else low


@dataclass(frozen=True, slots=True, eq=False)
class _TrainingPool:
    """Known rows of all runs, in shares: positions (n,) without creep, commands (n,) with the lag.

    ``columns`` (n, 2 + p) are 1, z and the stops of z, whose plays begin in ``initial`` (p,).
    ``plays`` (n, p) are the plays of the command, which begin in ``command_initial`` (p,).
    """

    initial: FloatArray
    command_initial: FloatArray
    z: FloatArray
    command: FloatArray
    columns: FloatArray
    plays: FloatArray
    validation: BoolArray


def _make_pool(stages: LagAndCreep, samples: Sequence[TrainingSamples]) -> _TrainingPool:
    parts = []
    for run in samples:
        z, x = stages.compute_positions(run), stages.compute_commands(run)
        columns = np.column_stack([np.ones_like(z), z, find_axis_stops(z, stages.initial)])
        plays = x[:, None] - find_axis_stops(x, stages.memory * make_radii())
        parts.append([values[run.first :] for values in (z, x, columns, plays)])
    z, command, columns, plays = (np.concatenate(part) for part in zip(*parts, strict=True))
    block = np.arange(len(z)) * _BLOCK_COUNT // len(z)
    block_stride = round(1.0 / _VALIDATION_SHARE)
    starts = stages.initial, stages.memory * make_radii()
    return _TrainingPool(
        *starts, z, command, columns, plays, block % block_stride == block_stride // 2
    )


def _collect_common_values(
    axis: PiezoAxis, samples: Sequence[TrainingSamples], stages: LagAndCreep
) -> dict[str, Any]:
    first_run = samples[0]
    positions = np.concatenate([run.position[run.first :] for run in samples])
    speed = max(float(np.abs(np.diff(run.command)).max()) for run in samples) / first_run.sample_s
    mode_s2 = 0.0
    if axis.inertia is not None:
        mode_s2 = axis.inertia.mass / axis.inertia.stiffness
    return {
        "axis": first_run.axis,
        "unit": first_run.unit,
        "sample_s": first_run.sample_s,
        "origin": stages.origin,
        "command_origin": stages.command_origin,
        "span": stages.span,
        "desired_range": (float(positions.min()), float(positions.max())),
        "command_range": axis.range,
        "speed": speed,
        "lag_s": stages.lag_s,
        "mode_s2": mode_s2,
        "creep_times_s": stages.creep_times_s,
        "creep_weights": stages.creep_weights,
    }


def _train_anfis(
    common: dict[str, Any],
    pool: _TrainingPool,
    settings: anfis.AnfisSettings,
    listener: anfis.Listener,
) -> InverseModel:
    radii = make_radii()
    trained = anfis.train(pool.columns, radii, pool.command, pool.validation, settings, listener)
    return InverseModel(
        kind="anfis",
        radii=radii,
        initial=pool.initial,
        premises=trained.premises,
        consequents=trained.consequents,
        **common,
    )


def _fit_modified_inverse(common: dict[str, Any], pool: _TrainingPool) -> InverseModel:
    hysteresis, bend = fit_modified(
        make_radii(), pool.command_initial, pool.command, pool.plays, pool.z
    )
    bends = {"bend_offset": bend.offset, "bend_at": bend.at, "bend": bend.slopes}
    return _make_inverse_model("modified_prandtl_ishlinskii", hysteresis, common | bends)


def _fit_classical_inverse(common: dict[str, Any], pool: _TrainingPool) -> InverseModel:
    hysteresis = fit_hysteresis(
        make_radii(), pool.command_initial, pool.command, pool.plays, pool.z
    )
    return _make_inverse_model(
        "prandtl_ishlinskii", hysteresis, common | {"bend_offset": -hysteresis.offset}
    )


def _make_inverse_model(
    kind: InverseKind, hysteresis: PrandtlIshlinskii, common: dict[str, Any]
) -> InverseModel:
    inverse = hysteresis.make_inverse()
    return InverseModel(
        kind=kind,
        radii=inverse.radii,
        initial=inverse.initial,
        consequents=inverse.to_consequents(),
        **common,
    )


def _fit_linear_inverse(common: dict[str, Any], samples: Sequence[TrainingSamples]) -> InverseModel:
    z = np.concatenate([run.position[run.first :] for run in samples]) - common["origin"]
    x = np.concatenate([run.command[run.first :] for run in samples]) - common["command_origin"]
    rows = np.column_stack([np.ones_like(z), z / common["span"]])
    consequents = np.linalg.lstsq(rows, x / common["span"])[0][None]
    empty = np.zeros(0)
    without_dynamics = common | {
        "lag_s": 0.0,
        "mode_s2": 0.0,
        "creep_times_s": empty,
        "creep_weights": empty,
    }
    return InverseModel(kind="linear", consequents=consequents, **without_dynamics)
