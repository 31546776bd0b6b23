"""Which effects records of an axis can show, and which motion would show the others.

Each effect is simulated at its typical size on the commands of the records. What it changes beyond
the offset of a record and beyond a re-tuning of the model's own numbers is what a diagnosis can
see. An effect is visible from three noise floors (rms) on, which is also the level from which it
counts as present in an answer.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import EffectError, PlantError
from rotemina.sim.gap.compare import candidates, scouts
from rotemina.sim.gap.experiment.safe_tests import SafeTest, find_safe_tests
from rotemina.sim.gap.experiment.separation import RivalSimulator
from rotemina.sim.gap.fit import Evidence, Fit, baseline, catalogue, is_own, sketched, with_values
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, Robot

# Contribution at a tap, in noise floors (rms), from which an effect is visible.
MIN_VISIBLE_FLOORS = 3.0
# More rows take seconds to simulate, and hardly show anything else.
_MAX_ROWS = 60_000
# Step of a parameter, relative to its size, for the response to a re-tuning.
_RETUNING_STEP = 1e-3


@dataclass(frozen=True, slots=True)
class EffectVisibility:
    """How well records show an effect.

    Attributes
    ----------
    effect : str
    from_axis : str or None
        Axis whose motion causes the effect.
    floors : float
        Contribution at its typical size, at the tap that shows it best, in noise floors (rms).
    test : SafeTest or None
        For an effect that the records do not show: a motion that would.
    test_floors : float
        Contribution on that motion, in noise floors.
    """

    effect: str
    from_axis: str | None
    floors: float
    test: SafeTest | None = None
    test_floors: float = 0.0

    @property
    def is_visible(self) -> bool:
        """Whether the records show the effect."""
        return self.floors >= MIN_VISIBLE_FLOORS


@dataclass(frozen=True, slots=True)
class AxisVisibility:
    """What the records of one axis can show.

    Attributes
    ----------
    axis : str
    effects : tuple of EffectVisibility
        Effects that repeat with the motion, the most visible first.
    random_effects : tuple of str
        Ids of the other effects. They show as noise, spikes, jumps or drift in any motion.
    """

    axis: str
    effects: tuple[EffectVisibility, ...]
    random_effects: tuple[str, ...]


def find_visible_effects(robot: Robot, axis: str, records: Sequence[Record]) -> AxisVisibility:
    """Return which effects records of an axis can show, and motions that would show the others.

    Raises
    ------
    GapError
        If no record has a measured channel of the axis with a known noise floor.
    PlantError
        If a record does not fit the robot.
    """
    evidence = Evidence.of(robot, axis, _shorten(axis, records))
    fitted = sketched(evidence, baseline(evidence), most_steps=0)
    retuning = np.linalg.qr(fitted.jacobian)[0]
    original = evidence.residual()
    visibilities: dict[tuple[str, str | None], tuple[EffectVisibility, AxisEffect]] = {}
    all_candidates = candidates(evidence)
    for candidate in scouts(evidence, all_candidates):
        try:
            change = evidence.residual([candidate]) - original
        # At its typical size the effect cannot be simulated on this axis.
        except (EffectError, PlantError, ArithmeticError):
            continue
        if not is_own(evidence, candidate):
            change = change - retuning @ (retuning.T @ change)
        floors = max(
            float(np.sqrt(np.mean(change[part.rows] ** 2))) if np.all(np.isfinite(change)) else 0.0
            for part in evidence.parts
        )
        key = candidate.id, candidate.from_axis
        if key not in visibilities or floors > visibilities[key][0].floors:
            visibilities[key] = EffectVisibility(*key, floors), candidate
    found = list(_add_tests(evidence, fitted, list(visibilities.values())))
    fitted_ids = {candidate.id for candidate in all_candidates}
    kind = robot.axes[axis].kind
    random_effects = [
        effect.id for effect in catalogue() if kind in effect.kinds and effect.id not in fitted_ids
    ]
    return AxisVisibility(
        axis, tuple(sorted(found, key=lambda item: -item.floors)), tuple(random_effects)
    )


def _shorten(axis: str, records: Sequence[Record]) -> list[Record]:
    """Return the records of an axis, each cut to its share of the rows that are simulated."""
    own = [record for record in records if axis in record.axes]
    ratio = _MAX_ROWS / sum(len(record.time_s) for record in own)
    if ratio >= 1.0:
        return own
    # A periodic record starts in its steady state, which needs whole periods.
    return [
        record
        if record.period_samples
        else record.select_rows(slice(0, max(round(len(record.time_s) * ratio), 2)))
        for record in own
    ]


def _add_tests(
    evidence: Evidence, fitted: Fit, items: Sequence[tuple[EffectVisibility, AxisEffect]]
) -> Iterator[EffectVisibility]:
    """Yield the effects, hidden ones with the first safe motion that shows them.

    Motions that stay within those of the records come first.
    """
    yield from (visibility for visibility, _ in items if visibility.is_visible)
    hidden = [item for item in items if not item[0].is_visible]
    for test, original, retuning in _simulate_tests(evidence, fitted, hidden):
        remaining = []
        for visibility, candidate in hidden:
            floors = _measure_contribution(evidence, candidate, test, original, retuning)
            if floors >= MIN_VISIBLE_FLOORS:
                yield replace(visibility, test=test, test_floors=floors)
            else:
                remaining.append((visibility, candidate))
        hidden = remaining
        if not hidden:
            return
    yield from (visibility for visibility, _ in hidden)


def _simulate_tests(
    evidence: Evidence, fitted: Fit, hidden: Sequence[tuple[EffectVisibility, AxisEffect]]
) -> Iterator[tuple[SafeTest, Mapping[Tap, FloatArray], Mapping[Tap, FloatArray]]]:
    """Yield safe tests with their signals (n,), and what re-tuning changes (n, parameters)."""
    if not hidden:
        return
    simulator = RivalSimulator(evidence.robot, evidence.axis, evidence.heartbeat)
    records = [observation.record for observation in evidence.observations]
    sources = [item.from_axis for item, _ in hidden if item.from_axis is not None]
    for beyond_records in (False, True):
        for test in find_safe_tests(
            evidence.robot, evidence.axis, records, sources, beyond_records=beyond_records
        ):
            original = simulator.simulate((), test.record)
            if original is None:
                continue
            changes: dict[Tap, list[FloatArray]] = {
                tap: [np.ones(len(signal))] for tap, signal in original.items()
            }
            for column in range(len(fitted.free)):
                x = fitted.x.copy()
                x[column] += _RETUNING_STEP
                retuned = simulator.simulate(
                    with_values(fitted.effects, fitted.free, x), test.record
                )
                for tap, signal in (retuned or {}).items():
                    changes[tap].append((signal - original[tap]) / _RETUNING_STEP)
            yield (
                test,
                original,
                {tap: np.linalg.qr(np.stack(signals, 1))[0] for tap, signals in changes.items()},
            )


def _measure_contribution(
    evidence: Evidence,
    candidate: AxisEffect,
    test: SafeTest,
    original: Mapping[Tap, FloatArray],
    retuning: Mapping[Tap, FloatArray],
) -> float:
    """Return what an effect changes on a test beyond a re-tuning, in noise floors (rms)."""
    simulator = RivalSimulator(evidence.robot, evidence.axis, evidence.heartbeat)
    signals = simulator.simulate([candidate], test.record)
    if signals is None or not simulator.stays_in_range(signals):
        return 0.0
    contributions = [0.0]
    for tap, signal in signals.items():
        if evidence.has(tap):
            change, basis = signal - original[tap], retuning[tap]
            change = (
                change - change.mean()
                if is_own(evidence, candidate)
                else change - basis @ (basis.T @ change)
            )
            contributions.append(float(np.sqrt(np.mean(change**2))) / evidence.floor(tap))
    return max(contributions)
