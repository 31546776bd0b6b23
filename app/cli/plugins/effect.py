"""``rotemina effect``: list effects, show their descriptions, and check them."""

import argparse
import time
from collections.abc import Iterable

from rotemina.app.cli.terminal import (
    add_robot,
    load_selected_robot,
    print_message,
    print_model,
)
from rotemina.sim.effects import (
    AxisProperties,
    Effect,
    EffectParameter,
    Formulation,
    list_effect_ids,
    load_all_effects,
    load_effect,
)
from rotemina.sim.errors import EffectError
from rotemina.sim.messages import (
    Message,
    MessageWording,
    message,
)
from rotemina.sim.robot import Robot
from rotemina.sim.simulation import CheckResult, EffectReport, check_effect
from rotemina.sim.units import format_quantity

_EXIT_FAILED = 1


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand with its own subcommands."""
    parser = commands.add_parser(
        "effect",
        help="list, show and check the effects that a simulated machine may have",
        description="List the installed effects, both built-in and from plugins.",
    )
    parser.set_defaults(run=_list_effects)
    verbs = parser.add_subparsers(title="subcommands", metavar="")
    listing = verbs.add_parser("list", help="print one line for each effect (default)")
    listing.set_defaults(run=_list_effects)
    showing = verbs.add_parser(
        "show", help="print equations, sources, and parameters on the axes of a robot"
    )
    showing.add_argument("id", metavar="ID")
    add_robot(showing)
    showing.set_defaults(run=_show_effect)
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
    checking.set_defaults(run=_check_effects)


def _list_effects(options: argparse.Namespace) -> int:
    effects, broken = load_all_effects()
    for effect in effects.values():
        kinds = ", ".join(sorted(effect.kinds))
        title = options.wording.localize_text("effects", effect.title)
        print(f"{effect.id:24}{effect.stage:13}{kinds:24}{title}")
    for reason in broken.values():
        print_message(options, message("cli", "left out: {reason}").fill(reason=reason))
    return 0


def _show_effect(options: argparse.Namespace) -> int:
    effect = load_effect(options.id)
    robot = load_selected_robot(options)
    wording = options.wording
    print_model(options, robot.name)
    print(f"{wording.localize_text('effects', effect.title)} ({effect.id}), {effect.stage}")
    print(wording.localize_text("effects", effect.summary))
    kinds = ", ".join(sorted(effect.kinds))
    print_message(options, message("cli", "acts on axes of kind {kinds}").fill(kinds=kinds))
    if effect.coupled:
        print_message(options, message("cli", "originates in another axis, named by from_axis"))
    for formulation in effect.formulations:
        print()
        print("\n".join(_format_formulation(effect, formulation, robot, wording)))
    return 0


def _format_formulation(
    effect: Effect, formulation: Formulation, robot: Robot, wording: MessageWording
) -> Iterable[str]:
    text = message("cli", "formulation {name}").fill(name=formulation.name)
    yield wording.format_message(text)
    yield f"  {formulation.equation}"
    text = message("cli", "source: {source}").fill(source=formulation.source)
    yield f"  {wording.format_message(text)}"
    if formulation.traits:
        text = message("cli", "traits: {traits}").fill(traits=", ".join(sorted(formulation.traits)))
        yield f"  {wording.format_message(text)}"
    for parameter in formulation.parameters:
        yield f"  {parameter.name}: {wording.localize_text('effects', parameter.meaning)}"
        axes_by_range: dict[Message, list[str]] = {}
        for name, axis in robot.axes.items():
            if axis.kind in effect.kinds:
                axes_by_range.setdefault(
                    _format_default_and_bounds(parameter, AxisProperties.of(axis)), []
                ).append(name)
        for range_text, names in axes_by_range.items():
            yield f"    {', '.join(names):24} {wording.format_message(range_text)}"


def _format_default_and_bounds(parameter: EffectParameter, properties: AxisProperties) -> Message:
    unit = parameter.unit_on(properties)
    values = (parameter.preset(properties), *parameter.bounds(properties))
    preset, low, high = (format_quantity(value, unit) for value in values)
    return message("cli", "{preset} ({low} to {high})").fill(preset=preset, low=low, high=high)


def _check_effects(options: argparse.Namespace) -> int:
    robots = [load_selected_robot(options)] if options.robot is not None else None
    known_ids = list_effect_ids()
    for effect_id in options.ids:
        if effect_id not in known_ids:
            raise EffectError(
                message("cli", "there is no effect {effect_id}; available: {names}").fill(
                    effect_id=repr(effect_id), names=", ".join(known_ids)
                )
            )
    failed_count = 0
    for effect_id in options.ids or known_ids:
        report = check_effect(effect_id, robots, clock=time.perf_counter)
        failed_count += not report.passed
        print("\n".join(_format_report(report, verbose=options.verbose)), flush=True)
    return _EXIT_FAILED if failed_count else 0


def _format_report(report: EffectReport, *, verbose: bool) -> Iterable[str]:
    passed_count = sum(check.passed is True for check in report.checks)
    failed_count = len(report.failures)
    verdict = "passed" if report.passed else "FAILED"
    if report.passed and not report.simulated:
        verdict = "NOT TRIED: it fits no axis of this robot"
    counts = f"{passed_count} checks passed" + (f", {failed_count} failed" if failed_count else "")
    yield f"{report.effect_id:24}{verdict}  {counts}"
    for check in report.checks if verbose else report.failures:
        yield _format_check(check)


def _format_check(check: CheckResult) -> str:
    verdict = {True: "ok", False: "FAILED", None: "-"}[check.passed]
    location = " ".join(part for part in (check.formulation, check.place) if part)
    value_text = ""
    # The value of a check without one is NaN, which does not equal itself.
    if check.value == check.value and check.passed is not None:
        value_text = f"{check.value:.3g} (bound {check.bound:.3g})"
    return f"  {verdict:7}{location:36}{check.name:38}{value_text}  {check.note}".rstrip()
