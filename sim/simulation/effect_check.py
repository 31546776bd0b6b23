"""Check of an effect, built-in or third-party, against its own description.

Every formulation is simulated on axes of the shipped robots, one of each kind that can carry it.
The check finds an incomplete description, a parameter whose bounds are not enforced, a step
function that writes outside its memory, and a declared trait that is not true. It also finds a
response that is not finite, not repeatable, or different when it is simulated in pieces.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from rotemina.sim.effects import Effect, load_effect
from rotemina.sim.errors import BrokenEffectError, EffectError, InputError
from rotemina.sim.plant import Plant
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import list_nominal_robots, load_robot
from rotemina.sim.simulation.check_bench import EffectBench, make_benches
from rotemina.sim.simulation.check_catalogue import check_bounds, check_catalogue
from rotemina.sim.simulation.check_response import check_response, check_speed
from rotemina.sim.simulation.check_result import CheckResult, EffectReport, skip_check
from rotemina.sim.simulation.check_step import check_step
from rotemina.sim.simulation.check_traits import check_traits


def check_effect(
    effect_id: str,
    robots: Sequence[Robot] | None = None,
    *,
    clock: Callable[[], float] | None = None,
) -> EffectReport:
    """Check an installed effect.

    Parameters
    ----------
    effect_id : str
    robots : sequence of Robot, optional
        Robots on whose axes the effect is checked; by default all shipped robots.
    clock : callable, optional
        Returns the time in s. Without it, the duration of a run is not checked.

    Raises
    ------
    EffectError
        If there is no effect of this id. An effect that cannot be loaded fails its check.
    """
    try:
        effect = load_effect(effect_id)
    except EffectError as error:
        if str(error).startswith("there is no effect"):
            raise
        return EffectReport(effect_id, (CheckResult("can be loaded", False, note=str(error)),))
    are_shipped = robots is None
    if robots is None:
        names = sorted(list_nominal_robots(), key=lambda name: (name != "rotemina", name))
        robots = [load_robot(name) for name in names]
    return EffectReport(effect_id, tuple(_run_checks(effect, robots, clock, are_shipped)))


def _run_checks(
    effect: Effect, robots: Sequence[Robot], clock: Callable[[], float] | None, are_shipped: bool
) -> Iterator[CheckResult]:
    description = list(check_catalogue(effect))
    yield from description
    if not all(check.passed for check in description):
        yield CheckResult("can be simulated", None, note="correct its description first")
        return
    benches = make_benches(effect, robots)
    for formulation in effect.formulations:
        results = [
            replace(check, formulation=formulation.name, place=bench.location)
            for bench in benches
            if bench.formulation is formulation
            for check in _check_safely(bench, clock)
        ]
        yield from results
        if all(check.passed is None for check in results):
            reason = results[0].note if results else f"it acts on {', '.join(sorted(effect.kinds))}"
            no_axis_result = skip_check("has a suitable axis", f"none of these fits: {reason}")
            # A user's robot may lack such axes; the shipped robots have all kinds.
            verdict = False if are_shipped else None
            yield replace(no_axis_result, passed=verdict, formulation=formulation.name)


def _check_safely(bench: EffectBench, clock: Callable[[], float] | None) -> Iterator[CheckResult]:
    """Check on one bench; an exception in the code of a plugin becomes a failed check."""
    try:
        yield from _check_bench(bench, clock)
    except InputError as error:
        yield CheckResult("can be simulated", False, note=str(error))
    # A plugin may raise anything.
    except Exception as error:
        yield CheckResult("can be simulated", False, note=f"{type(error).__name__}: {error}")


def _check_bench(bench: EffectBench, clock: Callable[[], float] | None) -> Iterator[CheckResult]:
    try:
        Plant.of(replace(bench.robot, effects=(bench.make_entry(),)))
    except BrokenEffectError:
        raise
    except EffectError as error:
        yield skip_check("fits this axis", str(error))
        return
    bounds = check_bounds(bench)
    steps = list(check_step(bench))
    yield bounds
    yield from steps
    if not all(check.passed for check in (bounds, *steps[:1], *steps[2:3])):
        # A run would write outside the memory of the function.
        return
    yield from check_response(bench)
    yield from check_traits(bench)
    if clock is not None:
        yield check_speed(bench, clock)
