"""Inverses of all kinds from the same rows, compared on rows that none was trained with."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.compensate import anfis
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse_parameters import InverseModel, Kind
from rotemina.sim.compensate.judgement import Residual, reason, recommended, residual
from rotemina.sim.compensate.lag_and_creep import Stages, find_stages, stops_of, thresholds
from rotemina.sim.compensate.modified_prandtl_ishlinskii import fit_modified
from rotemina.sim.compensate.prandtl_ishlinskii import Hysteresis, fit_hysteresis
from rotemina.sim.compensate.samples import Samples, common, one_size
from rotemina.sim.messages import Message, marked, message
from rotemina.sim.quantities import percent
from rotemina.sim.robot.model import PiezoAxis, Robot

Listener = Callable[[str, float], None]

HELD_OUT = 0.25  # of the known rows, the last ones, where no further record is given
_VALIDATION = 0.2  # of the rows to train on, in blocks
_BLOCKS = 20
_FEWEST = 500  # rows to train on
_FAR = 0.2  # of the range: so far outside it a position has an origin of its own


@dataclass(frozen=True, slots=True, eq=False)
class Trained:
    """The result of a training.

    Attributes
    ----------
    models : by kind, in the order of ``KINDS``.
    residuals : by kind, on rows that no inverse was trained on.
    chosen : the kind that is recommended.
    remarks : what else is to be said.
    """

    models: dict[Kind, InverseModel]
    residuals: dict[Kind, Residual]
    chosen: Kind
    remarks: tuple[str, ...] = ()

    @property
    def why(self) -> Message:
        """Why that kind is recommended."""
        return reason(self.residuals, self.chosen)


def train(
    robot: Robot,
    samples: Sequence[Samples],
    held_out: Sequence[Samples] = (),
    *,
    settings: anfis.Settings | None = None,
    listener: Listener | None = None,
) -> Trained:
    """Train the inverses of an axis on runs of it, and judge them on others.

    Parameters
    ----------
    robot : Robot
    samples : runs to train on, all at one rate.
    held_out : runs to judge on; without any, the last quarter of each of ``samples``.
    settings : of the ANFIS.
    listener : is told what is done, and the share that is done.

    Raises
    ------
    CompensationError
        If the runs do not fit together or hold too little.
    ConvergenceError
        If no kind of inverse converges. The ANFIS alone may fail: the remarks then say so.
    """
    tell = listener or _nobody
    first = common([*samples, *held_out])
    tell(marked("engine", "lag and creep"), 0.0)
    kept = [_split(each, whole=bool(held_out)) for each in samples]
    known = [
        replace(each, command=each.command[:last], position=each.position[:last])
        for each, last in zip(samples, kept, strict=True)
    ]
    if sum(len(each.command) - each.first for each in known) < _FEWEST:
        raise CompensationError(
            message(
                "engine",
                "{name}: axis {axis}: fewer than {fewest} rows are left to train on, after "
                "the first swing over the whole range; record longer",
            ).fill(name=first.name, axis=first.axis, fewest=_FEWEST)
        )
    axis = robot.axes[first.axis]
    assert isinstance(axis, PiezoAxis)
    low = axis.range[0]
    stages = find_stages(known, _origin(axis, known), low, axis.span, _least_lag_s(axis, first))
    pool = _pool(stages, known)
    tell(marked("engine", "plays"), 0.3)
    facts = _facts(axis, known, stages)
    models: dict[Kind, InverseModel] = {}
    remarks: list[str] = []

    def learning(epoch: int, epochs: int, error: float) -> None:
        tell(
            message("engine", "ANFIS, epoch {epoch}: {error} unseen").fill(
                epoch=epoch, error=percent(error)
            ),
            0.4 + 0.55 * epoch / epochs,
        )

    try:
        models["anfis"] = _anfis(facts, pool, settings or anfis.Settings(), learning)
    except CompensationError as error:
        remarks.append(str(error))
    models["modified_prandtl_ishlinskii"] = _modified(facts, pool)
    models["prandtl_ishlinskii"] = _classical(facts, pool)
    models["linear"] = _linear(facts, known)
    judges = [(each, each.first) for each in held_out] or list(zip(samples, kept, strict=True))
    residuals = {kind: residual(model, judges) for kind, model in models.items()}
    chosen = recommended(residuals, one_size=one_size(known))
    tell(marked("engine", "done"), 1.0)
    return Trained(models, residuals, chosen, tuple(remarks))


def _nobody(_what: str, _share: float) -> None:
    """Tell nobody."""


def _split(samples: Samples, *, whole: bool) -> int:
    """Return the row at which training ends."""
    rows = len(samples.command)
    return rows if whole else rows - int(HELD_OUT * (rows - samples.first))


def _least_lag_s(axis: PiezoAxis, samples: Samples) -> float:
    """Return by how much the model alone comes late: the held command, and the damping 2ζ/ω."""
    if axis.inertia is None:
        return samples.sample_s  # read before the next command acts
    return 0.5 * samples.sample_s + axis.inertia.damping / axis.inertia.stiffness


def _origin(axis: PiezoAxis, samples: Sequence[Samples]) -> float:
    """Return about the position at the low end.

    That is the low end of the axis' range where positions are at all near it, else the lowest.
    """
    low = min(float(each.position[each.first :].min()) for each in samples)
    high = max(float(each.position[each.first :].max()) for each in samples)
    near = _FAR * axis.span
    return axis.range[0] if low > axis.range[0] - near and high < axis.range[1] + near else low


@dataclass(frozen=True, slots=True, eq=False)
class _Pool:
    """Known rows of all runs, shares: positions (n,) without creep, commands (n,) with the lag.

    ``columns`` (n, 2 + p) are 1, z and the stops of z, whose plays begin in ``initial`` (p,);
    ``plays`` (n, p) those of the command, which begin in ``commanded`` (p,).
    """

    initial: FloatArray
    commanded: FloatArray
    z: FloatArray
    command: FloatArray
    columns: FloatArray
    plays: FloatArray
    validation: BoolArray


def _pool(stages: Stages, samples: Sequence[Samples]) -> _Pool:
    parts = []
    for each in samples:
        z, x = stages.position(each), stages.command(each)
        columns = np.column_stack([np.ones_like(z), z, stops_of(z, stages.initial)])
        plays = x[:, None] - stops_of(x, stages.memory * thresholds())
        parts.append([values[each.first :] for values in (z, x, columns, plays)])
    z, command, columns, plays = (np.concatenate(part) for part in zip(*parts, strict=True))
    block = np.arange(len(z)) * _BLOCKS // len(z)
    every = round(1.0 / _VALIDATION)
    starts = stages.initial, stages.memory * thresholds()
    return _Pool(*starts, z, command, columns, plays, block % every == every // 2)


def _facts(axis: PiezoAxis, samples: Sequence[Samples], stages: Stages) -> dict[str, Any]:
    """Return what models of all kinds have in common."""
    first = samples[0]
    positions = np.concatenate([each.position[each.first :] for each in samples])
    speed = max(float(np.abs(np.diff(each.command)).max()) for each in samples) / first.sample_s
    resonance = 0.0
    if axis.inertia is not None:
        resonance = axis.inertia.mass / axis.inertia.stiffness
    return {
        "axis": first.axis,
        "unit": first.unit,
        "sample_s": first.sample_s,
        "origin": stages.origin,
        "command_origin": stages.command_origin,
        "span": stages.span,
        "desired_range": (float(positions.min()), float(positions.max())),
        "command_range": axis.range,
        "speed": speed,
        "lag_s": stages.lag_s,
        "mode_s2": resonance,
        "creep_times_s": stages.creep_times_s,
        "creep_weights": stages.creep_weights,
    }


def _anfis(
    facts: dict[str, Any], pool: _Pool, settings: anfis.Settings, listener: anfis.Listener
) -> InverseModel:
    radii = thresholds()
    found = anfis.train(pool.columns, radii, pool.command, pool.validation, settings, listener)
    return InverseModel(
        kind="anfis",
        radii=radii,
        initial=pool.initial,
        premises=found.premises,
        consequents=found.consequents,
        **facts,
    )


def _modified(facts: dict[str, Any], pool: _Pool) -> InverseModel:
    whole, bend = fit_modified(thresholds(), pool.commanded, pool.command, pool.plays, pool.z)
    bends = {"bend_offset": bend.offset, "bend_at": bend.at, "bend": bend.slopes}
    return _inverted("modified_prandtl_ishlinskii", whole, facts | bends)


def _classical(facts: dict[str, Any], pool: _Pool) -> InverseModel:
    whole = fit_hysteresis(thresholds(), pool.commanded, pool.command, pool.plays, pool.z)
    return _inverted("prandtl_ishlinskii", whole, facts | {"bend_offset": -whole.offset})


def _inverted(kind: Kind, whole: Hysteresis, facts: dict[str, Any]) -> InverseModel:
    inverse = whole.inverse()
    return InverseModel(
        kind=kind,
        radii=inverse.radii,
        initial=inverse.initial,
        consequents=inverse.consequents(),
        **facts,
    )


def _linear(facts: dict[str, Any], samples: Sequence[Samples]) -> InverseModel:
    """Return the straight line from position to command, without memory or stages besides."""
    z = np.concatenate([each.position[each.first :] for each in samples]) - facts["origin"]
    x = np.concatenate([each.command[each.first :] for each in samples]) - facts["command_origin"]
    rows = np.column_stack([np.ones_like(z), z / facts["span"]])
    consequents = np.linalg.lstsq(rows, x / facts["span"])[0][None]
    empty = np.zeros(0)
    plain = facts | {"lag_s": 0.0, "mode_s2": 0.0, "creep_times_s": empty, "creep_weights": empty}
    return InverseModel(kind="linear", consequents=consequents, **plain)
