"""The corrected model, read back from the JSON document of a diagnosis.

What is read is data: nothing in it is ever executed.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from rotemina.sim.effects.attachment import RESERVED, Attached, parse_effect
from rotemina.sim.errors import InputError
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.document import FORMAT
from rotemina.sim.gap.errors import GapError
from rotemina.sim.robot.file import parse_robot
from rotemina.sim.robot.model import AxisEffect, Robot

MAX_BYTES = 16_000_000
_SHOWN = 40  # signs of a wrong value that a message shows

Json = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Document:
    """What is read back: the verdicts, the robot that was examined and what corrects it."""

    verdict: Verdict
    axes: Mapping[str, Verdict]
    robot: Robot
    effects: tuple[AxisEffect, ...]

    @property
    def corrected(self) -> Robot:
        """The robot with the fitted effects behind its own."""
        return replace(self.robot, effects=(*self.robot.effects, *self.effects))


def read_document(path: str | PathLike[str]) -> Document:
    """Read the verdicts and the corrected model of a diagnosis' JSON file.

    Keys that are not known are left aside.

    Raises
    ------
    GapError
        If the file cannot be read, is no such document, or its model is none, with the key.
    """
    name = fspath(path)
    table = _table(name, _parsed(name, _text(name)), "the document")
    if table.get("format") != FORMAT:
        raise GapError(
            f"{name}: format = {_short(table.get('format'))}: must be {FORMAT!r}; name a file that "
            "'rotemina gap diagnose --json' wrote"
        )
    model = _table(name, table.get("model"), "model")
    robot = _robot(name, model.get("robot"))
    effects = model.get("effects")
    if not isinstance(effects, list):
        raise GapError(f"{name}: model.effects = {_short(effects)}: must be a list")
    axes = {
        axis: _verdict(name, f"axes.{axis}", verdict)
        for axis, verdict in _table(name, table.get("axes"), "axes").items()
    }
    return Document(
        verdict=_verdict(name, "verdict", table.get("verdict")),
        axes=axes,
        robot=robot,
        effects=tuple(
            _effect(f"{name}: model.effects[{index}]", robot, one)
            for index, one in enumerate(effects)
        ),
    )


def _text(name: str) -> str:
    try:
        with Path(name).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise GapError(
            f"{name}: it cannot be read ({error.strerror or error}); name the JSON file of a "
            "diagnosis"
        ) from error
    if len(data) > MAX_BYTES:
        raise GapError(f"{name}: larger than {MAX_BYTES} bytes; this is no diagnosis")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise GapError(f"{name}: not UTF-8 text (byte {error.start})") from error


def _parsed(name: str, text: str) -> object:
    def refuse(constant: str) -> None:
        raise GapError(f"{name}: {constant} is no number of JSON; it may have been edited")

    try:
        # Whole numbers as float: one of a thousand digits is then infinite, and found out later.
        return json.loads(text, parse_int=float, parse_constant=refuse)
    except json.JSONDecodeError as error:
        raise GapError(f"{name}:{error.lineno}: not valid JSON: {error.msg}") from error
    except RecursionError as error:
        raise GapError(f"{name}: tables or lists are nested too deeply") from error


def _table(name: str, value: object, key: str) -> Json:
    if not isinstance(value, dict):
        raise GapError(
            f"{name}: {key} = {_short(value)}: must be an object; name a file that "
            "'rotemina gap diagnose --json' wrote"
        )
    return value


def _verdict(name: str, key: str, value: object) -> Verdict:
    if not isinstance(value, str) or value not in list(Verdict):
        raise GapError(f"{name}: {key} = {_short(value)}: must be one of {', '.join(Verdict)}")
    return Verdict(value)


def _robot(name: str, text: object) -> Robot:
    where = f"{name}: model.robot"
    if not isinstance(text, str) or not _encodable(text):
        raise GapError(f"{where} = {_short(text)}: must be the text of a robot file")
    return parse_robot(text, source=where)


def _encodable(text: str) -> bool:
    """Whether a text has no halves of surrogate pairs, which JSON can hold and no file can."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def _effect(where: str, robot: Robot, value: object) -> AxisEffect:
    if not isinstance(value, dict):
        raise GapError(f"{where} = {_short(value)}: must be an object")
    axis, parameters = value.get("axis"), value.get("parameters", {})
    if not isinstance(axis, str) or axis not in robot.axes:
        raise GapError(f"{where}.axis = {_short(axis)}: must be one of {list(robot.axes)}")
    if not isinstance(parameters, dict):
        raise GapError(f"{where}.parameters = {_short(parameters)}: must be an object")
    clashing = [key for key in parameters if key in RESERVED]
    if clashing:
        raise GapError(f"{where}.parameters.{clashing[0]}: no parameter has this name")
    own = {key: value.get(key) for key in ("formulation", "from_axis")}
    try:
        asked = parse_effect(axis, {"id": value.get("effect"), **own, **parameters})
        Attached.of(robot, asked)
    except InputError as error:
        raise GapError(f"{where}: {error}") from error
    return asked


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
