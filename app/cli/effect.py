"""``rotemina effect``: list effects, show their descriptions, and check them."""

import argparse
import time
from collections.abc import Iterable

from rotemina.app.cli.options import add_robot, robot_of, tell, tell_model
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import Effect, Formulation, Parameter
from rotemina.sim.effects.registry import all_effects, effect_ids, effect_named
from rotemina.sim.messages import Message, Wording, message
from rotemina.sim.quantities import amount
from rotemina.sim.robot.model import Robot
from rotemina.sim.simulation.check_result import Check, Report
from rotemina.sim.simulation.effect_check import check_effect

_FAILED = 1


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "effect",
        help="list, show and check the effects that a simulated machine may have",
        description="The installed effects: built in, and of plugins.",
    )
    parser.set_defaults(run=_list)
    verbs = parser.add_subparsers(title="subcommands", metavar="")
    listing = verbs.add_parser("list", help="print one line for each effect (default)")
    listing.set_defaults(run=_list)
    showing = verbs.add_parser(
        "show", help="print equations, sources, and parameters on the axes of a robot"
    )
    showing.add_argument("id", metavar="ID")
    add_robot(showing)
    showing.set_defaults(run=_show)
    checking = verbs.add_parser(
        "check",
        help="measure whether effects match their descriptions",
        description="Simulate each formulation on axes of the shipped robots, or of one robot, "
        "and compare it with its description. Exit status: 0 all passed, 1 a check "
        "failed.",
    )
    checking.add_argument(
        "ids", nargs="*", metavar="ID", help="effects to be checked (default: all)"
    )
    checking.add_argument(
        "--robot",
        default=None,
        metavar="NAME_OR_FILE",
        help="a robot file, or a shipped robot, whose axes are used (default: all shipped ones)",
    )
    checking.add_argument(
        "--verbose", action="store_true", help="print every check, not only the failed ones"
    )
    checking.set_defaults(run=_check)


def _list(options: argparse.Namespace) -> int:
    """Print a line for each effect in the order of the signal chain."""
    effects, broken = all_effects()
    for effect in effects.values():
        kinds = ", ".join(sorted(effect.kinds))
        title = options.wording.text("effects", effect.title)
        print(f"{effect.id:24}{effect.stage:13}{kinds:24}{title}")
    for reason in broken.values():
        tell(options, message("cli", "left out: {reason}").fill(reason=reason))
    return 0


def _show(options: argparse.Namespace) -> int:
    """Print everything that an effect says of itself."""
    effect = effect_named(options.id)
    robot = robot_of(options)
    wording = options.wording
    tell_model(options, robot.name)
    print(f"{wording.text('effects', effect.title)} ({effect.id}), {effect.stage}")
    print(wording.text("effects", effect.summary))
    kinds = ", ".join(sorted(effect.kinds))
    tell(options, message("cli", "acts on axes of kind {kinds}").fill(kinds=kinds))
    if effect.coupled:
        tell(options, message("cli", "originates in another axis, named by from_axis"))
    for formulation in effect.formulations:
        print()
        print("\n".join(_formulation_lines(effect, formulation, robot, wording)))
    return 0


def _formulation_lines(
    effect: Effect, formulation: Formulation, robot: Robot, wording: Wording
) -> Iterable[str]:
    said = message("cli", "formulation {name}").fill(name=formulation.name)
    yield wording.of(said)
    yield f"  {formulation.equation}"
    said = message("cli", "source: {source}").fill(source=formulation.source)
    yield f"  {wording.of(said)}"
    if formulation.traits:
        said = message("cli", "traits: {traits}").fill(traits=", ".join(sorted(formulation.traits)))
        yield f"  {wording.of(said)}"
    for parameter in formulation.parameters:
        yield f"  {parameter.name}: {wording.text('effects', parameter.meaning)}"
        texts: dict[Message, list[str]] = {}
        for name, axis in robot.axes.items():
            if axis.kind in effect.kinds:
                texts.setdefault(_figures(parameter, Facts.of(axis)), []).append(name)
        for figures, names in texts.items():
            yield f"    {', '.join(names):24} {wording.of(figures)}"


def _figures(parameter: Parameter, facts: Facts) -> Message:
    """Return preset and bounds on an axis."""
    unit = parameter.unit_on(facts)
    values = (parameter.preset(facts), *parameter.bounds(facts))
    preset, low, high = (amount(value, unit) for value in values)
    return message("cli", "{preset} ({low} to {high})").fill(preset=preset, low=low, high=high)


def _check(options: argparse.Namespace) -> int:
    """Check effects and print what was found; status 1 if something failed."""
    robots = [robot_of(options)] if options.robot is not None else None
    known = effect_ids()
    for effect_id in options.ids:
        if effect_id not in known:
            raise EffectError(
                message("cli", "there is no effect {effect_id}; available: {names}").fill(
                    effect_id=repr(effect_id), names=", ".join(known)
                )
            )
    failed = 0
    for effect_id in options.ids or known:
        report = check_effect(effect_id, robots, clock=time.perf_counter)
        failed += not report.passed
        print("\n".join(_report_lines(report, verbose=options.verbose)), flush=True)
    return _FAILED if failed else 0


def _report_lines(report: Report, *, verbose: bool) -> Iterable[str]:
    passed = sum(check.passed is True for check in report.checks)
    failed = len(report.failures)
    verdict = "passed" if report.passed else "FAILED"
    if report.passed and not report.simulated:
        verdict = "NOT TRIED: it fits no axis of this robot"
    counts = f"{passed} checks passed" + (f", {failed} failed" if failed else "")
    yield f"{report.effect_id:24}{verdict}  {counts}"
    for check in report.checks if verbose else report.failures:
        yield _check_line(check)


def _check_line(check: Check) -> str:
    verdict = {True: "ok", False: "FAILED", None: "-"}[check.passed]
    where = " ".join(part for part in (check.formulation, check.place) if part)
    figures = ""
    if check.value == check.value and check.passed is not None:
        figures = f"{check.value:.3g} (bound {check.bound:.3g})"
    return f"  {verdict:7}{where:36}{check.name:38}{figures}  {check.note}".rstrip()
