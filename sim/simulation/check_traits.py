"""Checks that the declared traits of an effect are true: each is measured."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import EffectTrait, ForceFunction
from rotemina.sim.plant import Plant, make_run
from rotemina.sim.records import Tap
from rotemina.sim.robot import Robot
from rotemina.sim.simulation.check_bench import SEED, EffectBench, make_moves, make_path, make_waves
from rotemina.sim.simulation.check_result import CheckResult, check_at_most, skip_check

_ROW_COUNT = 800
_RISE_ROW_COUNT = 300
# Deviations are relative to the contribution of the effect, unless stated otherwise.
_MAX_NONLINEAR_RATIO = 1e-6
# A rate-independent effect must leave the same trace when the motion is slower by this factor.
_SLOW_PACE_RATIO = 3.0
# Largest deviation at rest, relative to the contribution during the motion.
_MAX_REST_RATIO = 1e-4
# Changes that are attributed to rounding, relative to the range.
_ROUNDING_RATIO = 1e-9
# The same for forces: no motion of the check is slow enough to exclude the dynamics of the axis.
_MAX_RATE_RATIO = 0.05
# Factor on the voltage, so that a free axis overcomes friction.
_FREE_AXIS_VOLTAGE_RATIO = 8.0
# Rows of a swing: five periods of the axis.
_SWING_ROW_COUNT = 40
# Largest gain, relative to the energy: forces held during a step are not exactly passive.
_MAX_ENERGY_GAIN_RATIO = 0.01


def check_traits(bench: EffectBench) -> Iterator[CheckResult]:
    """Measure each trait that the formulation declares."""
    for trait in EffectTrait:
        if trait in _CHECKS and trait in bench.formulation.traits:
            yield _CHECKS[trait](bench, f"trait {trait.value}")


def _check_linear(bench: EffectBench, name: str) -> CheckResult:
    first, second = 0.5 * make_waves(_ROW_COUNT), 0.4 * make_moves(_ROW_COUNT)
    zero_motion = np.zeros(_ROW_COUNT)
    zero_response, first_response, second_response, sum_response = (
        bench.read_signals(bench.run(bench.make_commands(shape)))
        for shape in (zero_motion, first, second, first + second)
    )
    deviation = np.abs(sum_response - first_response - second_response + zero_response).max()
    contribution = np.abs(bench.measure_contribution(bench.make_commands(first + second))).max()
    return _check_ratio(
        bench, name, deviation, contribution, _MAX_NONLINEAR_RATIO, "superposition does not hold"
    )


def _check_memoryless(bench: EffectBench, name: str) -> CheckResult:
    return _compare_at_rest(
        bench, name, lambda above, below: above - below, "it depends on the path"
    )


def _check_transient(bench: EffectBench, name: str) -> CheckResult:
    return _compare_at_rest(bench, name, lambda above, below: above, "it adds something at rest")


def _compare_at_rest(
    bench: EffectBench,
    name: str,
    compare: Callable[[FloatArray, FloatArray], FloatArray],
    fault: str,
) -> CheckResult:
    if not bench.is_held:
        return skip_check(name, "nothing holds this axis at rest")
    from_above, from_below = (
        bench.measure_contribution(
            bench.make_commands(make_path(places, _RISE_ROW_COUNT, bench.rest_rows))
        )
        for places in ((0.0, 0.9, 0.2), (0.0, -0.9, 0.2))
    )
    deviation = np.abs(compare(from_above[-1], from_below[-1])).max()
    contribution = max(np.abs(from_above).max(), np.abs(from_below).max())
    return _check_ratio(bench, name, deviation, contribution, _MAX_REST_RATIO, fault)


def _check_rate_independent(bench: EffectBench, name: str) -> CheckResult:
    path = make_path((0.0, 0.8, -0.6, 0.4, -0.1), _RISE_ROW_COUNT, 1)
    bound, static = _MAX_NONLINEAR_RATIO, bench.as_static()
    if not bench.is_held:
        return skip_check(name, "this axis cannot follow a path")
    if static is None:
        path, bound = np.repeat(path, 4), _MAX_RATE_RATIO
    used_bench = static or bench
    fast = used_bench.measure_contribution(used_bench.make_commands(path))
    slow = used_bench.measure_contribution(
        used_bench.make_commands(path, slowdown=_SLOW_PACE_RATIO)
    )
    deviation = np.abs(fast - slow).max()
    return _check_ratio(
        bench, name, deviation, np.abs(fast).max(), bound, "it depends on the speed"
    )


def _check_locked_to_time(bench: EffectBench, name: str) -> CheckResult:
    resting = bench.measure_contribution(bench.make_commands(np.zeros(_ROW_COUNT)), seed=SEED)
    moving = bench.measure_contribution(bench.make_commands(make_waves(_ROW_COUNT)), seed=SEED)
    contribution = max(np.abs(resting).max(), np.abs(moving).max())
    deviation = np.abs(resting - moving).max()
    return _check_ratio(bench, name, deviation, contribution, _MAX_REST_RATIO, "motion changes it")


def _check_locked_to_position(bench: EffectBench, name: str) -> CheckResult:
    """Compare the contributions at the same positions, up and down, quickly and slowly."""
    static = bench.as_static()
    if static is None:
        return skip_check(name, "this axis cannot follow a path")
    rising_path = np.linspace(-0.7, 0.7, _RISE_ROW_COUNT)
    path = np.concatenate([rising_path, rising_path[::-1]])
    fast = static.measure_contribution(static.make_commands(path))
    slow = static.measure_contribution(static.make_commands(path, slowdown=_SLOW_PACE_RATIO))
    deviation = max(np.abs(fast - slow).max(), np.abs(fast - fast[::-1]).max())
    return _check_ratio(
        bench,
        name,
        deviation,
        np.abs(fast).max(),
        _MAX_NONLINEAR_RATIO,
        "it depends on speed or direction",
    )


def _check_reading_only(bench: EffectBench, name: str) -> CheckResult:
    commands = bench.make_commands(make_waves(_ROW_COUNT))
    with_effect, without_effect = (
        bench.run(commands, seed=SEED),
        bench.run(commands, seed=SEED, effects=()),
    )
    deviations = [
        np.abs(with_effect.signal(bench.axis, tap) - without_effect.signal(bench.axis, tap)).max()
        / scale
        for tap, scale in ((Tap.REF, bench.robot_axis.span), (Tap.U, bench.facts.input_span))
        if without_effect.has(bench.axis, tap)
    ]
    return check_at_most(name, float(max(deviations)), _ROUNDING_RATIO, "the true motion changes")


def _check_dissipative(bench: EffectBench, name: str) -> CheckResult:
    """Measure the energy that a force adds to a vibration, or the direction of hysteresis loops."""
    if isinstance(bench.formulation.acts, ForceFunction):
        return _check_energy(bench, name)
    static = bench.as_static()
    if static is None:
        return skip_check(name, "this axis cannot follow a path")
    path = make_path((0.0, 0.9, -0.9, 0.9, -0.9, 0.3, 0.6, 0.3, 0.9), _RISE_ROW_COUNT, 1)
    record = static.run(static.make_commands(path))
    command, response = record.signal(bench.axis, Tap.CMD), record.signal(bench.axis, Tap.REF)
    # From one reversal to the end of the path, which is at the same position.
    loop = slice(_RISE_ROW_COUNT - 1, None)
    mean_command = 0.5 * (command[loop][1:] + command[loop][:-1]) - command[loop][0]
    loop_energy = -float(np.sum(mean_command * np.diff(response[loop])))
    return check_at_most(
        name,
        loop_energy / bench.robot_axis.span**2,
        _ROUNDING_RATIO,
        "its loops turn the wrong way",
    )


def _check_energy(bench: EffectBench, name: str) -> CheckResult:
    shape = np.concatenate([make_moves(200), np.zeros(bench.rest_rows)])
    if not bench.is_held:
        shape *= _FREE_AXIS_VOLTAGE_RATIO
    commands = bench.make_commands(shape)
    plant = Plant.of(_without_losses(bench), only=[bench.axis])
    run = make_run(plant, commands)
    motion, _ = plant.advance(
        plant.find_rest_state(run.time_s[0], run.command[0]),
        run.time_s,
        run.command,
        inputs=run.inputs,
    )
    column, facts = plant.axes.index(bench.axis), bench.facts
    speed = motion.velocity[:, column]
    energy = 0.5 * facts.mass * speed**2
    if facts.stiffness > 0.0:
        energy += 0.5 * facts.stiffness * (motion.position - run.command)[:, column] ** 2
    energy_after = energy[201:]
    if energy.max() <= 0.0:
        return skip_check(name, "the axis does not move")
    # A spring returns the energy that it took, so only the maxima of the swings must not grow.
    swing_maxima = (
        energy_after[: len(energy_after) // _SWING_ROW_COUNT * _SWING_ROW_COUNT]
        .reshape(-1, _SWING_ROW_COUNT)
        .max(axis=1)
    )
    growth = float(np.max(swing_maxima - np.minimum.accumulate(swing_maxima)))
    return check_at_most(
        name, growth / float(energy.max()), _MAX_ENERGY_GAIN_RATIO, "it adds energy"
    )


def _without_losses(bench: EffectBench) -> Robot:
    axis = bench.robot_axis
    no_damping = {"damping_ratio": 0.0} if axis.damping_ratio is not None else {"damping": 0.0}
    axes = {**bench.robot.axes, bench.axis: replace(axis, **no_damping)}  # type: ignore[arg-type]
    return replace(bench.robot, axes=axes, couplings=(), effects=(bench.make_entry(),))


def _check_ratio(
    bench: EffectBench, name: str, deviation: float, contribution: float, bound: float, fault: str
) -> CheckResult:
    rounding = 1e-12 * bench.robot_axis.span
    if contribution <= rounding:
        return skip_check(name, "it adds nothing here at its presets")
    return check_at_most(name, float(max(deviation - rounding, 0.0) / contribution), bound, fault)


_CHECKS: dict[EffectTrait, Callable[[EffectBench, str], CheckResult]] = {
    EffectTrait.LINEAR: _check_linear,
    EffectTrait.MEMORYLESS: _check_memoryless,
    EffectTrait.TRANSIENT: _check_transient,
    EffectTrait.RATE_INDEPENDENT: _check_rate_independent,
    EffectTrait.LOCKED_TO_TIME: _check_locked_to_time,
    EffectTrait.LOCKED_TO_POSITION: _check_locked_to_position,
    EffectTrait.READING_ONLY: _check_reading_only,
    EffectTrait.DISSIPATIVE: _check_dissipative,
}
