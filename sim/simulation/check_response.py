"""Checks of a run with an effect: finite, repeatable, equal in pieces, and from rest."""

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np

from rotemina.sim.effects import EffectTrait, Values
from rotemina.sim.errors import PlantError, RecordError
from rotemina.sim.simulation.check_bench import SEED, EffectBench, make_moves, make_waves
from rotemina.sim.simulation.check_result import (
    CheckResult,
    check_above,
    check_at_most,
    check_no_faults,
    skip_check,
)
from rotemina.sim.simulation.simulation import SimulatedMachine

ROW_COUNT = 600
# Rows at which the pieces of a run begin and end.
_PIECE_EDGES = (0, 1, 2, 3, 7, 8, 60, 333, ROW_COUNT)
# Differences below these fractions of the range are attributed to rounding. An effect may need
# inner steps, which round differently even if it is absent.
_ROUNDING_RANGE_RATIO = 1e-9
_ABSENT_RANGE_RATIO = 1e-10
# The effect is simulated with these two fractions of its presets. The ratio below bounds the
# contribution at the smaller fraction, relative to that at the larger one.
_ONSET_PRESET_RATIOS = (1e-3, 1e-6)
_MAX_ONSET_RATIO = 0.1
# Permitted creep of an axis at rest, relative to its range.
_MAX_REST_RANGE_RATIO = 1e-6
# Permitted jump of a free axis at the start, relative to its range.
_MAX_FREE_JUMP_RANGE_RATIO = 1e-3
# If the contribution at zero is larger, relative to that at the presets, zero does not remove the
# effect.
_MAX_ABSENT_EFFECT_RATIO = 1e-4
_TIMING_COUNT = 3
_TIMED_S = 10.0
_TIMED_RATE_HZ = 2000.0
_MAX_RUN_TIME_S = 0.25


def check_response(bench: EffectBench) -> Iterator[CheckResult]:
    """Check runs with an effect at its presets, and at its bounds."""
    yield from _check_presets_and_bounds(bench)
    yield from _check_zero(bench)
    yield from _check_seeds(bench)
    yield _check_pieces(bench)
    yield _check_rest(bench)


def check_speed(bench: EffectBench, clock: Callable[[], float]) -> CheckResult:
    """Check that 10 s at 2 kHz, best of three runs, are simulated fast enough for a fit."""
    rows = int(_TIMED_S * _TIMED_RATE_HZ)
    slower = bench.rate_hz / _TIMED_RATE_HZ
    commands = bench.make_commands(make_waves(rows), slowdown=slower)
    bench.run(commands)
    durations_s = []
    for _ in range(_TIMING_COUNT):
        begin_s = clock()
        bench.run(commands)
        durations_s.append(clock() - begin_s)
    return check_at_most(
        "is fast enough to be fitted", min(durations_s), _MAX_RUN_TIME_S, "s for 10 s at 2 kHz"
    )


def _check_presets_and_bounds(bench: EffectBench) -> Iterator[CheckResult]:
    """Check that all values give finite responses, and that some of them change the response."""
    largest_change, faults = 0.0, []
    for shape in (make_waves(ROW_COUNT), make_moves(ROW_COUNT)):
        commands = bench.make_commands(shape)
        without_effect = bench.read_signals(bench.run(commands, seed=SEED, effects=()))
        for values in ({}, *bench.list_corners()):
            try:
                signals = bench.read_signals(bench.run(commands, values, seed=SEED))
            # A machine may diverge at a bound, if this is reported.
            except PlantError:
                largest_change = np.inf
                continue
            except RecordError as error:
                faults.append(f"{_describe_values(values)}: {error}")
                continue
            if np.isfinite(signals).all():
                largest_change = max(largest_change, float(np.abs(signals - without_effect).max()))
                continue
            faults.append(f"{_describe_values(values)}: not finite")
    yield check_no_faults("stays finite at presets and bounds", faults[:3])
    if not faults:
        relative_change = min(largest_change / bench.robot_axis.span, 1e300)
        yield check_above("has an effect", relative_change, 1e-15, "nothing happens at any bound")


def _describe_values(values: Values) -> str:
    return ", ".join(f"{name} = {value:g}" for name, value in values.items()) or "presets"


def _check_zero(bench: EffectBench) -> Iterator[CheckResult]:
    """Check that the effect is absent at zero, and that it starts smoothly from there."""
    name = "is absent at zero"
    values = bench.find_zero_values()
    if values is None:
        yield skip_check(name, "no parameter can be zero")
        return
    commands = bench.make_commands(make_waves(ROW_COUNT))
    zero_contribution = (
        np.abs(bench.measure_contribution(commands, values, seed=SEED)).max()
        / bench.robot_axis.span
    )
    preset_contribution = (
        np.abs(bench.measure_contribution(commands, seed=SEED)).max() / bench.robot_axis.span
    )
    if zero_contribution > max(_MAX_ABSENT_EFFECT_RATIO * preset_contribution, _ABSENT_RANGE_RATIO):
        yield skip_check(name, "zero parameters do not remove it")
        return
    yield check_at_most(
        name, float(zero_contribution), _ABSENT_RANGE_RATIO, "it does not vanish completely"
    )
    yield _check_onset(bench, list(values))


def _check_onset(bench: EffectBench, names: list[str]) -> CheckResult:
    """Check that a fit can start from zero: a much smaller amount must contribute far less."""
    name = "starts smoothly from zero"
    if bench.robot_axis.static:
        return skip_check(name, "a static axis is delayed by whole samples")
    commands, presets = bench.make_commands(make_waves(ROW_COUNT)), bench.presets
    larger_contribution, smaller_contribution = (
        float(
            np.abs(
                bench.measure_contribution(commands, {n: ratio * presets[n] for n in names})
            ).max()
        )
        for ratio in _ONSET_PRESET_RATIOS
    )
    span = bench.robot_axis.span
    return check_at_most(
        name,
        smaller_contribution / span,
        _MAX_ONSET_RATIO * larger_contribution / span + _ABSENT_RANGE_RATIO,
        "it sets in abruptly",
    )


def _check_seeds(bench: EffectBench) -> Iterator[CheckResult]:
    commands = bench.make_commands(make_waves(ROW_COUNT))
    values = {}
    # At the upper bounds even rare events occur in this run.
    if EffectTrait.RANDOM in bench.formulation.traits:
        ends = {p.name: p.bounds(bench.facts)[1] for p in bench.formulation.parameters}
        values = {name: end for name, end in ends.items() if np.isfinite(end)}
    first, repeated, other_seed = (
        bench.measure_contribution(commands, values, seed=seed) for seed in (SEED, SEED, SEED + 1)
    )
    span = bench.robot_axis.span
    repetition = float(np.abs(first - repeated).max()) / span
    yield check_at_most(
        "repeats with the same seed",
        repetition,
        0.0,
        "its random numbers do not come from the seed",
    )
    difference = float(np.abs(first - other_seed).max()) / span
    if EffectTrait.RANDOM not in bench.formulation.traits:
        yield check_at_most(
            "is not random",
            difference,
            _ROUNDING_RANGE_RATIO,
            "it depends on the seed; declare it random",
        )
        return
    yield check_above(
        "differs from seed to seed",
        difference,
        0.0,
        "it is declared random but does not depend on the seed",
    )
    without_seed = float(np.abs(bench.measure_contribution(commands, values)).max()) / span
    yield check_at_most(
        "is absent without a seed", without_seed, 0.0, "it also acts without a seed"
    )


def _check_pieces(bench: EffectBench) -> CheckResult:
    commands = bench.make_commands(make_waves(ROW_COUNT))
    complete = bench.read_signals(bench.run(commands, seed=SEED))
    simulation = SimulatedMachine(
        bench.robot, [bench.make_entry()], commands, np.random.default_rng(SEED)
    )
    pieces = [
        bench.read_signals(simulation.follow(commands.select_rows(slice(begin, end))))
        for begin, end in pairwise(_PIECE_EDGES)
    ]
    # All streams, including that of the reference noise, must draw the same numbers in pieces.
    difference = float(np.abs(np.concatenate(pieces) - complete).max()) / bench.robot_axis.span
    return check_at_most(
        "gives the same in pieces",
        difference,
        _ROUNDING_RANGE_RATIO,
        "it loses its memory between pieces",
    )


def _check_rest(bench: EffectBench) -> CheckResult:
    name = "starts at rest"
    if EffectTrait.LOCKED_TO_TIME in bench.formulation.traits:
        return skip_check(name, "it acts without motion")
    shape = np.full(60, 0.37) if bench.is_held else np.zeros(60)
    reading = bench.read_signals(bench.run(bench.make_commands(shape)))
    span = bench.robot_axis.span
    if bench.is_held:
        return check_at_most(
            name,
            float(np.ptp(reading, axis=0).max()) / span,
            _MAX_REST_RANGE_RATIO,
            "the start is not an equilibrium",
        )
    jump = float(np.abs(np.diff(reading, axis=0)).max()) / span
    return check_at_most(name, jump, _MAX_FREE_JUMP_RANGE_RATIO, "it jumps at the start")
