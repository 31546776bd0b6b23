"""Checks of a whole run with an effect: finite, repeatable, the same in pieces, at rest first."""

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np

from rotemina.sim.effects.formulation import Trait, Values
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.records.record import RecordError
from rotemina.sim.simulation.check_bench import SEED, Bench, moves, waves
from rotemina.sim.simulation.check_result import Check, exceeds, left_out, measured, stated
from rotemina.sim.simulation.simulation import Simulation

ROWS = 600
_EDGES = (0, 1, 2, 3, 7, 8, 60, 333, ROWS)  # between the pieces of a run
_ROUNDING = 1e-9  # of the range
_ABSENT = 1e-10  # of the range: finer steps round otherwise
_SHARES = (1e-3, 1e-6)  # of the presets,
_LESS = 0.1  # and how much of what the first adds the second may
_QUIET = 1e-6  # of the range: how far a start at rest may creep
_FREE = 1e-3  # the same of an axis that nothing holds
_HINT = 1e-4  # share of the effect below which a leftover is no mere change of the model
_TRIES = 3
_TIMED_S = 10.0
_TIMED_RATE_HZ = 2000.0
_LONGEST_S = 0.25


def check_response(bench: Bench) -> Iterator[Check]:
    """Check runs with an effect at its presets, and at its bounds."""
    yield from _at_presets_and_bounds(bench)
    yield from _nothing(bench)
    yield from _seeds(bench)
    yield _pieces(bench)
    yield _rest(bench)


def check_speed(bench: Bench, clock: Callable[[], float]) -> Check:
    """Check that ten seconds at 2 kHz take no longer than a fit can afford; the best of three."""
    rows = int(_TIMED_S * _TIMED_RATE_HZ)
    slower = bench.rate_hz / _TIMED_RATE_HZ
    commands = bench.record(waves(rows), slower=slower)
    bench.run(commands)
    taken = []
    for _ in range(_TRIES):
        begin = clock()
        bench.run(commands)
        taken.append(clock() - begin)
    return measured("is fast enough to be fitted", min(taken), _LONGEST_S, "s for 10 s at 2 kHz")


def _at_presets_and_bounds(bench: Bench) -> Iterator[Check]:
    """Check that all values give finite answers, and that some do something."""
    greatest, faults = 0.0, []
    for shape in (waves(ROWS), moves(ROWS)):
        commands = bench.record(shape)
        clean = bench.seen(bench.run(commands, seed=SEED, effects=()))
        for values in ({}, *bench.corners()):
            try:
                seen = bench.seen(bench.run(commands, values, seed=SEED))
            except PlantError:  # it says cleanly that such a machine diverges
                greatest = np.inf
                continue
            except RecordError as error:
                faults.append(f"{_said(values)}: {error}")
                continue
            if np.isfinite(seen).all():
                greatest = max(greatest, float(np.abs(seen - clean).max()))
                continue
            faults.append(f"{_said(values)}: not finite")
    yield stated("stays finite at presets and bounds", faults[:3])
    if not faults:
        acts = min(greatest / bench.own.span, 1e300)
        yield exceeds("does something", acts, 1e-15, "nothing happens at any bound")


def _said(values: Values) -> str:
    return ", ".join(f"{name} = {value:g}" for name, value in values.items()) or "presets"


def _nothing(bench: Bench) -> Iterator[Check]:
    """Check that zeros, where they are no effect, leave the nominal response, and come smoothly."""
    name = "is absent at zero"
    values = bench.nothing()
    if values is None:
        yield left_out(name, "no parameter can be zero")
        return
    commands = bench.record(waves(ROWS))
    left = np.abs(bench.added(commands, values, seed=SEED)).max() / bench.own.span
    full = np.abs(bench.added(commands, seed=SEED)).max() / bench.own.span
    if left > max(_HINT * full, _ABSENT):
        yield left_out(name, "zeros are no absence of it")
        return
    yield measured(name, float(left), _ABSENT, "it nearly vanishes, but not quite")
    yield _onset(bench, list(values))


def _onset(bench: Bench, names: list[str]) -> Check:
    """Check that a fit finds its way from nothing: a thousandth as much adds far less."""
    name = "comes from zero smoothly"
    if bench.own.static:
        return left_out(name, "a static axis is late by whole samples")
    commands, presets = bench.record(waves(ROWS)), bench.presets
    some, less = (
        float(np.abs(bench.added(commands, {n: share * presets[n] for n in names})).max())
        for share in _SHARES
    )
    span = bench.own.span
    return measured(name, less / span, _LESS * some / span + _ABSENT, "it is there all at once")


def _seeds(bench: Bench) -> Iterator[Check]:
    commands = bench.record(waves(ROWS))
    values = {}
    if Trait.RANDOM in bench.formulation.traits:  # rare events are to happen here
        ends = {p.name: p.bounds(bench.facts)[1] for p in bench.formulation.parameters}
        values = {name: end for name, end in ends.items() if np.isfinite(end)}
    first, again, other = (
        bench.added(commands, values, seed=seed) for seed in (SEED, SEED, SEED + 1)
    )
    span = bench.own.span
    same = float(np.abs(first - again).max()) / span
    yield measured("one seed gives one answer", same, 0.0, "chance comes from elsewhere")
    apart = float(np.abs(first - other).max()) / span
    if Trait.RANDOM not in bench.formulation.traits:
        yield measured("is not random", apart, _ROUNDING, "seeds matter: declare it random")
        return
    yield exceeds("differs from seed to seed", apart, 0.0, "declared random, but seeds do nothing")
    silent = float(np.abs(bench.added(commands, values)).max()) / span
    yield measured("is absent without chance", silent, 0.0, "it acts without a seed too")


def _pieces(bench: Bench) -> Check:
    commands = bench.record(waves(ROWS))
    whole = bench.seen(bench.run(commands, seed=SEED))
    simulation = Simulation(bench.robot, [bench.asked()], commands, np.random.default_rng(SEED))
    parts = [
        bench.seen(simulation.follow(commands.part(slice(begin, end))))
        for begin, end in pairwise(_EDGES)
    ]
    # Reference noise is drawn as it comes; so are all streams.
    gap = float(np.abs(np.concatenate(parts) - whole).max()) / bench.own.span
    return measured("in pieces is as at once", gap, _ROUNDING, "it forgets between pieces")


def _rest(bench: Bench) -> Check:
    name = "starts at rest"
    if Trait.LOCKED_TO_TIME in bench.formulation.traits:
        return left_out(name, "it acts by itself")
    shape = np.full(60, 0.37) if bench.held else np.zeros(60)
    reading = bench.seen(bench.run(bench.record(shape)))
    span = bench.own.span
    if bench.held:
        return measured(
            name, float(np.ptp(reading, axis=0).max()) / span, _QUIET, "the start is no equilibrium"
        )
    jump = float(np.abs(np.diff(reading, axis=0)).max()) / span
    return measured(name, jump, _FREE, "it jumps at the start")
