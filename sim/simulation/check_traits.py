"""Checks that the traits which an effect declares are true: each is measured."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.formulation import Force, Trait
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.response import run_of
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.simulation.check_bench import SEED, Bench, moves, visit, waves
from rotemina.sim.simulation.check_result import Check, left_out, measured

_ROWS = 800
_RISE_ROWS = 300
_LINEAR = 1e-6  # of what it adds
_SLOWER = 3.0  # times, at which a rate-independent trace must be the same
_LEFT = 1e-4  # of what it adds on the way: what may be left at rest
_ROUNDING = 1e-9  # of what it adds; and of the range
_SLOW_FORCE = 0.05  # of what it adds: the axis' own dynamics is never quite slow
_PUSH = 8.0  # times the usual voltage, so that a free axis overcomes friction
_SWING_ROWS = 40  # five periods
_GAINED = 0.01  # of the energy: forces that are held for a while are not quite passive


def check_traits(bench: Bench) -> Iterator[Check]:
    """Measure each trait that the formulation declares."""
    for trait in Trait:
        if trait in _CHECKS and trait in bench.formulation.traits:
            yield _CHECKS[trait](bench, f"trait {trait.value}")


def _linear(bench: Bench, name: str) -> Check:
    """Superpose two motions about the operating point."""
    first, second = 0.5 * waves(_ROWS), 0.4 * moves(_ROWS)
    nothing = np.zeros(_ROWS)
    at, of_first, of_second, of_both = (
        bench.seen(bench.run(bench.record(shape)))
        for shape in (nothing, first, second, first + second)
    )
    gap = np.abs(of_both - of_first - of_second + at).max()
    size = np.abs(bench.added(bench.record(first + second))).max()
    return _relative(bench, name, gap, size, _LINEAR, "superposition does not hold")


def _memoryless(bench: Bench, name: str) -> Check:
    """Compare what is added at a place, come to from above and from below."""
    return _at_rest(bench, name, lambda above, below: above - below, "it depends on the way")


def _transient(bench: Bench, name: str) -> Check:
    """Measure what is added at rest."""
    return _at_rest(bench, name, lambda above, below: above, "something is left at rest")


def _at_rest(
    bench: Bench, name: str, what: Callable[[FloatArray, FloatArray], FloatArray], fault: str
) -> Check:
    if not bench.held:
        return left_out(name, "nothing holds this axis at rest")
    above, below = (
        bench.added(bench.record(visit(places, _RISE_ROWS, bench.rest_rows)))
        for places in ((0.0, 0.9, 0.2), (0.0, -0.9, 0.2))
    )
    gap = np.abs(what(above[-1], below[-1])).max()
    size = max(np.abs(above).max(), np.abs(below).max())
    return _relative(bench, name, gap, size, _LEFT, fault)


def _rate_independent(bench: Bench, name: str) -> Check:
    """Follow one path at two paces, on an axis that follows at once."""
    path = visit((0.0, 0.8, -0.6, 0.4, -0.1), _RISE_ROWS, 1)
    bound, static = _LINEAR, bench.as_static()
    if not bench.held:
        return left_out(name, "no path can be given to this axis")
    if static is None:
        path, bound = np.repeat(path, 4), _SLOW_FORCE
    rig = static or bench
    quick = rig.added(rig.record(path))
    slow = rig.added(rig.record(path, slower=_SLOWER))
    gap = np.abs(quick - slow).max()
    return _relative(bench, name, gap, np.abs(quick).max(), bound, "the pace matters")


def _locked_to_time(bench: Bench, name: str) -> Check:
    """Compare an axis at rest with one that moves; something must happen at rest."""
    resting = bench.added(bench.record(np.zeros(_ROWS)), seed=SEED)
    moving = bench.added(bench.record(waves(_ROWS)), seed=SEED)
    size = max(np.abs(resting).max(), np.abs(moving).max())
    gap = np.abs(resting - moving).max()
    return _relative(bench, name, gap, size, _LEFT, "motion changes it")


def _locked_to_position(bench: Bench, name: str) -> Check:
    """Compare what is added at the same places, up and down, quickly and slowly."""
    static = bench.as_static()
    if static is None:
        return left_out(name, "no path can be given to this axis")
    up = np.linspace(-0.7, 0.7, _RISE_ROWS)
    path = np.concatenate([up, up[::-1]])
    quick = static.added(static.record(path))
    slow = static.added(static.record(path, slower=_SLOWER))
    gap = max(np.abs(quick - slow).max(), np.abs(quick - quick[::-1]).max())
    return _relative(bench, name, gap, np.abs(quick).max(), _LINEAR, "pace or direction matter")


def _reading_only(bench: Bench, name: str) -> Check:
    """Measure by how much reference and input change."""
    commands = bench.record(waves(_ROWS))
    faulty, clean = bench.run(commands, seed=SEED), bench.run(commands, seed=SEED, effects=())
    gaps = [
        np.abs(faulty.signal(bench.axis, tap) - clean.signal(bench.axis, tap)).max() / scale
        for tap, scale in ((Tap.REF, bench.own.span), (Tap.U, bench.facts.input_span))
        if clean.has(bench.axis, tap)
    ]
    return measured(name, float(max(gaps)), _ROUNDING, "the motion changes")


def _dissipative(bench: Bench, name: str) -> Check:
    """Measure what a force adds to the energy of a vibration; else, the sign of loops."""
    if isinstance(bench.formulation.acts, Force):
        return _energy(bench, name)
    static = bench.as_static()
    if static is None:
        return left_out(name, "no path can be given to this axis")
    way = visit((0.0, 0.9, -0.9, 0.9, -0.9, 0.3, 0.6, 0.3, 0.9), _RISE_ROWS, 1)
    record = static.run(static.record(way))
    drive, answer = record.signal(bench.axis, Tap.CMD), record.signal(bench.axis, Tap.REF)
    loop = slice(_RISE_ROWS - 1, None)  # from one reversal to where the path ends at the same
    middle = 0.5 * (drive[loop][1:] + drive[loop][:-1]) - drive[loop][0]
    gained = -float(np.sum(middle * np.diff(answer[loop])))
    return measured(name, gained / bench.own.span**2, _ROUNDING, "its loops turn the wrong way")


def _energy(bench: Bench, name: str) -> Check:
    """Measure how much swings grow after the last move, relative to the most energy before."""
    shape = np.concatenate([moves(200), np.zeros(bench.rest_rows)])
    if not bench.held:
        shape *= _PUSH
    commands = bench.record(shape)
    plant = Plant.of(_lossless(bench), only=[bench.axis])
    run = run_of(plant, commands)
    motion, _ = plant.advance(
        plant.at_rest(run.time_s[0], run.command[0]), run.time_s, run.command, inputs=run.inputs
    )
    column, facts = plant.axes.index(bench.axis), bench.facts
    speed = motion.velocity[:, column]
    energy = 0.5 * facts.mass * speed**2
    if facts.stiffness > 0.0:
        energy += 0.5 * facts.stiffness * (motion.position - run.command)[:, column] ** 2
    free = energy[201:]
    if energy.max() <= 0.0:
        return left_out(name, "the axis does not move")
    # A spring gives back what it took: only from swing to swing must nothing be gained.
    swings = free[: len(free) // _SWING_ROWS * _SWING_ROWS].reshape(-1, _SWING_ROWS).max(axis=1)
    growth = float(np.max(swings - np.minimum.accumulate(swings)))
    return measured(name, growth / float(energy.max()), _GAINED, "it feeds energy in")


def _lossless(bench: Bench) -> Robot:
    """Return the robot with the effect on an axis that loses no energy by itself."""
    axis = bench.own
    told = {"damping_ratio": 0.0} if axis.damping_ratio is not None else {"damping": 0.0}
    axes = {**bench.robot.axes, bench.axis: replace(axis, **told)}  # type: ignore[arg-type]
    return replace(bench.robot, axes=axes, couplings=(), effects=(bench.asked(),))


def _relative(bench: Bench, name: str, gap: float, size: float, bound: float, fault: str) -> Check:
    """Compare a gap with what the effect adds; rounding of the range is no gap."""
    rounding = 1e-12 * bench.own.span
    if size <= rounding:
        return left_out(name, "it adds nothing here at its presets")
    return measured(name, float(max(gap - rounding, 0.0) / size), bound, fault)


_CHECKS: dict[Trait, Callable[[Bench, str], Check]] = {
    Trait.LINEAR: _linear,
    Trait.MEMORYLESS: _memoryless,
    Trait.TRANSIENT: _transient,
    Trait.RATE_INDEPENDENT: _rate_independent,
    Trait.LOCKED_TO_TIME: _locked_to_time,
    Trait.LOCKED_TO_POSITION: _locked_to_position,
    Trait.READING_ONLY: _reading_only,
    Trait.DISSIPATIVE: _dissipative,
}
