"""``rotemina gap check``: effects that records can show, and motions that would show others."""

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rotemina.app.cli.terminal import (
    add_columns,
    add_robot,
    check_output_files,
    find_json_file,
    find_robot_file,
    load_selected_robot,
    print_message,
    print_model,
    read_records_of_model,
)
from rotemina.app.settings import format_json, write_text
from rotemina.sim.errors import GapError
from rotemina.sim.gap.experiment import AxisVisibility, EffectVisibility, describe_test
from rotemina.sim.gap.output import name_effect
from rotemina.sim.messages import (
    AxisName,
    Field,
    FieldList,
    Message,
    format_rounded,
    join_lines,
    message,
)
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot

CHECK_FORMAT = "rotemina-check 1"


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the subcommand."""
    parser = verbs.add_parser(
        "check",
        help="say which effects records can show, and which motion would show the others",
        description="Say which effects a diagnosis of these records could find at their typical "
        "size, which it could not, and which motion would show them. It takes seconds; whether "
        "an effect is there is found by 'gap diagnose'.",
    )
    parser.add_argument("records", type=Path, nargs="+", metavar="RECORD")
    add_robot(parser)
    add_columns(parser)
    parser.add_argument("--json", metavar="OUT", help="write the result as JSON ('-' prints it)")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Check the records of each axis, and print the result."""
    path = find_json_file(options.json)
    check_output_files([path], [*options.records, find_robot_file(options.robot)])
    robot = load_selected_robot(options)
    records = read_records_of_model(options, robot, options.records)
    print_model(options, robot.name)
    axes = find_visible_effects_of_axes(robot, records)
    text = format_json(make_check_document(axes))
    if path is not None:
        write_text(path, text)
    if options.json == "-":
        print(text)
    else:
        print_message(options, join_lines([line for axis in axes for line in _describe_axis(axis)]))
    return 0


def find_visible_effects_of_axes(
    robot: Robot, records: Sequence[Record]
) -> tuple[AxisVisibility, ...]:
    """Return what the records of each measured axis can show.

    Raises
    ------
    GapError
        If no axis is measured.
    """
    # The import is slow, and invalid input must be refused quickly.
    from rotemina.sim.gap.experiment import find_visible_effects

    axes, refusals = [], []
    for name in robot.axes:
        if any(name in record.axes for record in records):
            try:
                axes.append(find_visible_effects(robot, name, records))
            except GapError as error:
                refusals.append(error)
    if not axes:
        if refusals:
            raise refusals[0]
        raise GapError("the records contain no axis of the robot")
    return tuple(axes)


def make_check_document(axes: Sequence[AxisVisibility]) -> dict[str, Any]:
    """Return the JSON object of a check."""
    return {
        "format": CHECK_FORMAT,
        "axes": {
            axis.axis: {
                "shown": [_make_effect_json(item) for item in axis.effects if item.is_visible],
                "hidden": [
                    {**_make_effect_json(item), "test": _make_test_json(axis.axis, item)}
                    for item in axis.effects
                    if not item.is_visible
                ],
                "in_any_motion": list(axis.random_effects),
            }
            for axis in axes
        },
    }


def _make_effect_json(item: EffectVisibility) -> dict[str, Any]:
    return {"effect": item.effect, "from_axis": item.from_axis, "floors": item.floors}


def _make_test_json(axis: str, item: EffectVisibility) -> dict[str, Any] | None:
    if item.test is None:
        return None
    return {"motion": str(describe_test(item.test, axis)), "floors": item.test_floors}


def _describe_axis(axis: AxisVisibility) -> Iterator[Message]:
    name = AxisName(axis.axis)
    shown = [_describe_effect(item) for item in axis.effects if item.is_visible]
    if shown:
        yield message(
            "cli",
            "{axis}: these records can show, at the typical size (in noise floors, rms): {effects}",
        ).fill(axis=name, effects=FieldList(tuple(shown)))
    items_by_test: dict[str, list[EffectVisibility]] = {}
    for item in axis.effects:
        if not item.is_visible:
            motion = "" if item.test is None else str(describe_test(item.test, axis.axis))
            items_by_test.setdefault(motion, []).append(item)
    # Motions that show most effects come first, and effects without a motion last.
    for items in sorted(
        items_by_test.values(), key=lambda items: (items[0].test is None, -len(items))
    ):
        effects = FieldList(tuple(name_effect(item.effect, item.from_axis) for item in items))
        test = items[0].test
        if test is not None:
            yield message("cli", "{axis}: too small here: {effects}; play this: {motion}").fill(
                axis=name, effects=effects, motion=describe_test(test, axis.axis)
            )
        else:
            yield message("cli", "{axis}: too small here and in every safe motion: {effects}").fill(
                axis=name, effects=effects
            )
    if axis.random_effects:
        yield message("cli", "{axis}: shown by any motion, if they are there: {effects}").fill(
            axis=name,
            effects=FieldList(tuple(name_effect(effect, None) for effect in axis.random_effects)),
        )


def _describe_effect(item: EffectVisibility) -> Field:
    return message("cli", "{effect} ({floors})").fill(
        effect=name_effect(item.effect, item.from_axis), floors=format_rounded(item.floors, 2)
    )
