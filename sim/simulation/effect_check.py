"""The check of an effect, ours or a third party's: whether it is what it says.

Every formulation is put on axes of the shipped robots, one of each kind that it can sit on, and
simulated. A catalogue that says less than it should, a parameter whose bounds do not hold, a step
function that reaches beyond its memory, a response that is not finite, not repeatable or not the
same in pieces, and a declared trait that is not true are found.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from rotemina.sim.effects.errors import BrokenEffectError, EffectError
from rotemina.sim.effects.formulation import Effect
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.errors import InputError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.file import load_robot, nominal_robots
from rotemina.sim.robot.model import Robot
from rotemina.sim.simulation.check_bench import Bench, benches_of
from rotemina.sim.simulation.check_catalogue import check_bounds, check_catalogue
from rotemina.sim.simulation.check_response import check_response, check_speed
from rotemina.sim.simulation.check_result import Check, Report, left_out
from rotemina.sim.simulation.check_step import check_step
from rotemina.sim.simulation.check_traits import check_traits


def check_effect(
    effect_id: str,
    robots: Sequence[Robot] | None = None,
    *,
    clock: Callable[[], float] | None = None,
) -> Report:
    """Check an installed effect.

    Parameters
    ----------
    effect_id : str
    robots : sequence of Robot, optional
        Whose axes it is put on; all that are shipped by default.
    clock : callable, optional
        Tells the time in s; without, how long a run takes is not checked.

    Raises
    ------
    EffectError
        If there is no effect of that id. One that cannot be loaded fails its check.
    """
    try:
        effect = effect_named(effect_id)
    except EffectError as error:
        if str(error).startswith("there is no effect"):
            raise
        return Report(effect_id, (Check("can be loaded", False, note=str(error)),))
    shipped = robots is None
    if robots is None:
        names = sorted(nominal_robots(), key=lambda name: (name != "rotemina", name))
        robots = [load_robot(name) for name in names]
    return Report(effect_id, tuple(_checks(effect, robots, clock, shipped)))


def _checks(
    effect: Effect, robots: Sequence[Robot], clock: Callable[[], float] | None, shipped: bool
) -> Iterator[Check]:
    said = list(check_catalogue(effect))
    yield from said
    if not all(check.passed for check in said):
        yield Check("can be simulated", None, note="what it says of itself comes first")
        return
    benches = benches_of(effect, robots)
    for formulation in effect.formulations:
        found = [
            replace(check, formulation=formulation.name, place=bench.place)
            for bench in benches
            if bench.formulation is formulation
            for check in _guarded(bench, clock)
        ]
        yield from found
        if all(check.passed is None for check in found):
            reason = found[0].note if found else f"it sits on {', '.join(sorted(effect.kinds))}"
            missing = left_out("finds an axis", f"none of these fits: {reason}")
            verdict = False if shipped else None  # a robot of one's own may lack such axes
            yield replace(missing, passed=verdict, formulation=formulation.name)


def _guarded(bench: Bench, clock: Callable[[], float] | None) -> Iterator[Check]:
    """Check on one bench; what a third party's code raises is a finding."""
    try:
        yield from _on(bench, clock)
    except InputError as error:
        yield Check("can be simulated", False, note=str(error))
    except Exception as error:  # whatever a plugin may raise
        yield Check("can be simulated", False, note=f"{type(error).__name__}: {error}")


def _on(bench: Bench, clock: Callable[[], float] | None) -> Iterator[Check]:
    try:
        Plant.of(replace(bench.robot, effects=(bench.asked(),)))
    except BrokenEffectError:
        raise
    except EffectError as error:
        yield left_out("sits here", str(error))
        return
    bounds = check_bounds(bench)
    steps = list(check_step(bench))
    yield bounds
    yield from steps
    if not all(check.passed for check in (bounds, *steps[:1], *steps[2:3])):
        return  # a run would write where it must not
    yield from check_response(bench)
    yield from check_traits(bench)
    if clock is not None:
        yield check_speed(bench, clock)
