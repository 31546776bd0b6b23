"""Robot files written: a whole robot, or effects added to the text of a robot file.

What is written reads back to the same robot, to the last bit of every number, or is refused. A
robot file lists effects by axis, so that alone of their order is kept which matters to a signal:
the order on each axis.
"""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.messages import message
from rotemina.sim.robot.errors import RobotFileError
from rotemina.sim.robot.file import parse_robot
from rotemina.sim.robot.model import AxisEffect, Robot
from rotemina.sim.whole_files import FileWriteError, replaced

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_DELETE = "\x7f"  # the one control character that JSON leaves as it is and TOML does not allow


def by_axis(robot: Robot, effects: Sequence[AxisEffect]) -> tuple[AxisEffect, ...]:
    """Return effects in the order of a robot's axes, those of one axis in the order given."""
    axes = list(robot.axes)
    return tuple(sorted(effects, key=lambda effect: axes.index(effect.axis)))


def effects_text(effects: Sequence[AxisEffect]) -> str:
    """Return the ``[[axis.NAME.effect]]`` sections of effects, in the order given."""
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
        lines = [f"[[axis.{_key(effect.axis)}.effect]]"]
        lines += [f"{_key(name)} = {_value(value)}" for name, value in table.items()]
        sections.append("\n".join(lines) + "\n")
    return "\n".join(sections)


def with_effects(text: str, effects: Sequence[AxisEffect], source: str = "robot file") -> str:
    """Return the text of a robot file with effects added behind those that it has.

    Everything that stood there, comments too, stays as it is.

    Raises
    ------
    RobotFileError
        If the text is no robot file, or no section can be added to it.
    EffectError
        If an effect cannot sit where it is asked to.
    """
    robot = parse_robot(text, source)
    wanted = replace(robot, effects=by_axis(robot, _checked(robot, (*robot.effects, *effects))))
    if not effects:
        return text
    longer = f"{text.rstrip()}\n\n{effects_text(effects)}"
    try:
        read_back = parse_robot(longer, source)
    except RobotFileError as error:
        raise RobotFileError(
            message(
                "engine",
                "{source}: no [[axis.NAME.effect]] can be added ({error}); write axes and effects "
                "as sections of their own",
            ).fill(source=source, error=str(error))
        ) from error
    _require_same(wanted, replace(read_back, effects=by_axis(robot, read_back.effects)), source)
    return longer


def robot_text(robot: Robot) -> str:
    """Return a whole robot file, with the robot's effects.

    Raises
    ------
    RobotFileError
        If the robot would not read back.
    EffectError
        If an effect cannot sit where it is.
    """
    effects = by_axis(robot, _checked(robot, robot.effects))
    head: dict[str, Any] = {"name": robot.name, "axes": list(robot.axes)}
    for key in ("pin_length", "piezo_lever_arm"):
        if getattr(robot, key) is not None:
            head[key] = getattr(robot, key)
    if robot.stages:
        head["stages"] = {name: list(axes) for name, axes in robot.stages.items()}
    parts = list(_sections(("robot",), head))
    for name, axis in robot.axes.items():
        parts += _sections(("axis", name), _table(axis))
    for coupling in robot.couplings:
        lines = [f"{key} = {_value(value)}" for key, value in _table(coupling).items()]
        parts.append("\n".join(["[[coupling]]", *lines]) + "\n")
    for key in ("reference", "tool", "microscope", "keep_out", "plate"):
        table = _table(getattr(robot, key))
        parts += _sections((key,), table) if table else ()
    text = "\n".join([*parts, *([effects_text(effects)] if effects else [])])
    _require_same(replace(robot, effects=effects), parse_robot(text, robot.name), robot.name)
    return text


def write_robot(robot: Robot, path: str | PathLike[str], *, overwrite: bool = False) -> None:
    """Write a robot file, completely or not at all.

    Raises
    ------
    FileWriteError
        If there is a file already and ``overwrite`` is not given, or none can be written.
    RobotFileError, EffectError
        As :func:`robot_text`.
    """
    name = fspath(path)
    text = robot_text(robot)
    if not overwrite and Path(name).exists():
        raise FileWriteError(
            message("engine", "{name} already exists; name another file").fill(name=name)
        )
    with replaced(name) as file:
        file.write(text.encode("utf-8"))


def _checked(robot: Robot, effects: tuple[AxisEffect, ...]) -> tuple[AxisEffect, ...]:
    for effect in effects:
        Attached.of(robot, effect)
    return effects


def _require_same(wanted: Robot, read_back: Robot, source: str) -> None:
    if read_back != wanted:
        names = [
            f.name for f in fields(Robot) if getattr(wanted, f.name) != getattr(read_back, f.name)
        ]
        raise RobotFileError(
            message("engine", "{source}: would not read back to the same {names}").fill(
                source=source, names=", ".join(names)
            )
        )


def _table(thing: Any) -> dict[str, Any]:
    """Return what of a dataclass differs from its defaults, inner ones as tables."""
    table: dict[str, Any] = {}
    for field in fields(thing):
        value = getattr(thing, field.name)
        if value is None or value == field.default:
            continue
        if is_dataclass(value):
            inner: Any = _table(value)
        elif isinstance(value, tuple) and value and is_dataclass(value[0]):
            inner = [_table(one) for one in value]
        else:
            inner = value
        if inner != {}:
            table[field.name] = inner
    return table


def _sections(path: tuple[str, ...], table: Mapping[str, Any]) -> Iterator[str]:
    """Yield ``[path]`` with its plain values, then a section for each table inside."""
    inner = {key: value for key, value in table.items() if _is_table(value)}
    plain = {key: value for key, value in table.items() if key not in inner}
    if plain:
        yield _section(f"[{'.'.join(map(_key, path))}]", plain)
    for key, value in inner.items():
        if isinstance(value, Mapping):
            yield from _sections((*path, key), value)
        else:
            for one in value:
                yield _section(f"[[{'.'.join(map(_key, (*path, key)))}]]", one)


def _section(head: str, plain: Mapping[str, Any]) -> str:
    lines = [f"{_key(key)} = {_value(value)}" for key, value in plain.items()]
    return "\n".join([head, *lines]) + "\n"


def _is_table(value: Any) -> bool:
    """Whether a value is a table or a list of tables."""
    first = value[0] if isinstance(value, list) and value else value
    return isinstance(first, Mapping)


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else _value(name)


def _value(value: Any) -> str:
    """Return a value as TOML: numbers with all digits that float64 needs to come back."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace(_DELETE, "\\u007F")
    if isinstance(value, list | tuple):
        return f"[{', '.join(_value(one) for one in value)}]"
    return repr(int(value) if isinstance(value, int) else float(value))
