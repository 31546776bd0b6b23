"""Writing of robot files: a whole robot, or effects added to the text of a robot file.

A written file reads back to the same robot, to the last bit of every number; otherwise writing is
refused. A robot file lists effects by axis. It therefore keeps only the order of effects on each
axis, which is the order that matters to a signal.
"""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from rotemina.sim.effects import AttachedEffect
from rotemina.sim.errors import FileWriteError, RobotFileError
from rotemina.sim.files import replace_file
from rotemina.sim.robot import AxisEffect, Robot
from rotemina.sim.robot_files.reading import parse_robot

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
# The only control character that JSON leaves as it is and TOML does not allow.
_DELETE_CHARACTER = "\x7f"


def sort_by_axis(robot: Robot, effects: Sequence[AxisEffect]) -> tuple[AxisEffect, ...]:
    """Return effects in the order of the axes of a robot; the order on each axis stays."""
    axes = list(robot.axes)
    return tuple(sorted(effects, key=lambda effect: axes.index(effect.axis)))


def format_effects(effects: Sequence[AxisEffect]) -> str:
    """Return the ``[[axis.NAME.effect]]`` sections of effects, in the given order."""
    sections = []
    for effect in effects:
        table: dict[str, Any] = {"id": effect.id}
        if effect.formulation is not None:
            table["formulation"] = effect.formulation
        if effect.from_axis is not None:
            table["from_axis"] = effect.from_axis
        if not effect.enabled:
            table["enabled"] = False
        table |= {name: float(value) for name, value in effect.parameters.items()}
        lines = [f"[[axis.{_format_key(effect.axis)}.effect]]"]
        lines += [f"{_format_key(name)} = {_format_value(value)}" for name, value in table.items()]
        sections.append("\n".join(lines) + "\n")
    return "\n".join(sections)


def with_effects(text: str, effects: Sequence[AxisEffect], source: str = "robot file") -> str:
    """Return the text of a robot file with effects added after the existing ones.

    The existing text, including comments, stays unchanged.

    Raises
    ------
    RobotFileError
        If the text is not a robot file, or no section can be added to it.
    EffectError
        If an effect cannot act on its axis.
    """
    robot = parse_robot(text, source)
    expected = replace(
        robot, effects=sort_by_axis(robot, _check_effects(robot, (*robot.effects, *effects)))
    )
    if not effects:
        return text
    extended = f"{text.rstrip()}\n\n{format_effects(effects)}"
    try:
        read_back = parse_robot(extended, source)
    except RobotFileError as error:
        raise RobotFileError(
            "{source}: no [[axis.NAME.effect]] can be added ({error}); write axes and effects "
            "as sections of their own",
            source=source,
            error=str(error),
        ) from error
    _require_same(
        expected, replace(read_back, effects=sort_by_axis(robot, read_back.effects)), source
    )
    return extended


def format_robot(robot: Robot) -> str:
    """Return the text of a whole robot file, with the robot's effects.

    Raises
    ------
    RobotFileError
        If the robot would not read back.
    EffectError
        If an effect cannot act on its axis.
    """
    effects = sort_by_axis(robot, _check_effects(robot, robot.effects))
    head: dict[str, Any] = {"name": robot.name, "axes": list(robot.axes)}
    for key in ("pin_length", "piezo_lever_arm"):
        if getattr(robot, key) is not None:
            head[key] = getattr(robot, key)
    if robot.stages:
        head["stages"] = {name: list(axes) for name, axes in robot.stages.items()}
    sections = list(_format_sections(("robot",), head))
    for name, axis in robot.axes.items():
        sections += _format_sections(("axis", name), _to_table(axis))
    for coupling in robot.couplings:
        lines = [f"{key} = {_format_value(value)}" for key, value in _to_table(coupling).items()]
        sections.append("\n".join(["[[coupling]]", *lines]) + "\n")
    for key in ("reference", "tool", "microscope", "keep_out", "plate"):
        table = _to_table(getattr(robot, key))
        sections += _format_sections((key,), table) if table else ()
    text = "\n".join([*sections, *([format_effects(effects)] if effects else [])])
    _require_same(replace(robot, effects=effects), parse_robot(text, robot.name), robot.name)
    return text


def write_robot(robot: Robot, path: str | PathLike[str], *, overwrite: bool = False) -> None:
    """Write a robot file atomically.

    Raises
    ------
    FileWriteError
        If the file exists and ``overwrite`` is False, or it cannot be written.
    RobotFileError, EffectError
        As :func:`format_robot`.
    """
    name = fspath(path)
    text = format_robot(robot)
    if not overwrite and Path(name).exists():
        raise FileWriteError("{name} already exists; name another file", name=name)
    with replace_file(name) as file:
        file.write(text.encode("utf-8"))


def _check_effects(robot: Robot, effects: tuple[AxisEffect, ...]) -> tuple[AxisEffect, ...]:
    for effect in effects:
        AttachedEffect.of(robot, effect)
    return effects


def _require_same(expected: Robot, read_back: Robot, source: str) -> None:
    if read_back != expected:
        names = [
            f.name for f in fields(Robot) if getattr(expected, f.name) != getattr(read_back, f.name)
        ]
        raise RobotFileError(
            "{source}: would not read back to the same {names}",
            source=source,
            names=", ".join(names),
        )


def _to_table(instance: Any) -> dict[str, Any]:
    """Return the fields of a dataclass that differ from their defaults.

    Nested dataclasses become tables.
    """
    table: dict[str, Any] = {}
    for field in fields(instance):
        value = getattr(instance, field.name)
        if value is None or value == field.default:
            continue
        if is_dataclass(value):
            nested_value: Any = _to_table(value)
        elif isinstance(value, tuple) and value and is_dataclass(value[0]):
            nested_value = [_to_table(item) for item in value]
        else:
            nested_value = value
        if nested_value != {}:
            table[field.name] = nested_value
    return table


def _format_sections(path: tuple[str, ...], table: Mapping[str, Any]) -> Iterator[str]:
    """Yield ``[path]`` with its plain values, then a section for each inner table."""
    nested_tables = {key: value for key, value in table.items() if _is_table(value)}
    plain_values = {key: value for key, value in table.items() if key not in nested_tables}
    if plain_values:
        yield _format_section(f"[{'.'.join(map(_format_key, path))}]", plain_values)
    for key, value in nested_tables.items():
        if isinstance(value, Mapping):
            yield from _format_sections((*path, key), value)
        else:
            for item in value:
                yield _format_section(f"[[{'.'.join(map(_format_key, (*path, key)))}]]", item)


def _format_section(head: str, plain: Mapping[str, Any]) -> str:
    lines = [f"{_format_key(key)} = {_format_value(value)}" for key, value in plain.items()]
    return "\n".join([head, *lines]) + "\n"


def _is_table(value: Any) -> bool:
    first = value[0] if isinstance(value, list) and value else value
    return isinstance(first, Mapping)


def _format_key(name: str) -> str:
    return name if _BARE_KEY.fullmatch(name) else _format_value(name)


def _format_value(value: Any) -> str:
    """Return a value as TOML, with all digits that a float64 needs to read back exactly."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace(_DELETE_CHARACTER, "\\u007F")
    if isinstance(value, list | tuple):
        return f"[{', '.join(_format_value(item) for item in value)}]"
    return repr(int(value) if isinstance(value, int) else float(value))
