"""The corrected model, read back from the JSON document of a diagnosis.

What is read is data: nothing in it is ever executed.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import isfinite
from os import PathLike, fspath
from typing import Any

from rotemina.sim.effects.attachment import RESERVED, Attached, parse_effect
from rotemina.sim.errors import InputError
from rotemina.sim.gap.diagnosis import Offset, Verdict
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.output.document import FORMAT
from rotemina.sim.input_files import parse_json, read_text
from rotemina.sim.messages import message
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import parse_robot
from rotemina.sim.robot.model import AxisEffect, Robot

MAX_BYTES = 16_000_000
_SHOWN = 40  # signs of a wrong value that a message shows

Json = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Document:
    """What is read back: the verdicts, the robot that was examined and what corrects it.

    ``offsets`` are by axis and tap.
    """

    verdict: Verdict
    axes: Mapping[str, Verdict]
    robot: Robot
    effects: tuple[AxisEffect, ...]
    offsets: Mapping[str, Mapping[Tap, Offset]] = field(default_factory=dict)

    @property
    def corrected(self) -> Robot:
        """The robot with the fitted effects behind its own."""
        return replace(self.robot, effects=(*self.robot.effects, *self.effects))


def read_document(path: str | PathLike[str]) -> Document:
    """Read the verdicts and the corrected model of a diagnosis' JSON file.

    Unknown keys are ignored.

    Raises
    ------
    GapError
        If the file cannot be read, is no such document, or its model is none, with the key.
    """
    name = fspath(path)
    text = read_text(
        path, GapError, MAX_BYTES, advice=message("gap", "name the JSON file of a diagnosis")
    )
    table = _table(name, parse_json(text, name, GapError), message("gap", "the document"))
    if table.get("format") != FORMAT:
        raise GapError(
            message(
                "gap",
                "{name}: format = {short}: must be {format}; name a file that 'rotemina gap "
                "diagnose --json' wrote",
            ).fill(name=name, short=_short(table.get("format")), format=repr(FORMAT))
        )
    model = _table(name, table.get("model"), "model")
    robot = _robot(name, model.get("robot"))
    effects = model.get("effects")
    if not isinstance(effects, list):
        raise GapError(
            message("gap", "{name}: model.effects = {short}: must be a list").fill(
                name=name, short=_short(effects)
            )
        )
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
        offsets=_offsets(name, robot, _table(name, table.get("offset", {}), "offset")),
    )


def _table(name: str, value: object, key: str) -> Json:
    if not isinstance(value, dict):
        raise GapError(
            message(
                "gap",
                "{name}: {key} = {short}: must be an object; name a file that 'rotemina gap "
                "diagnose --json' wrote",
            ).fill(name=name, key=key, short=_short(value))
        )
    return value


def _verdict(name: str, key: str, value: object) -> Verdict:
    if not isinstance(value, str) or value not in list(Verdict):
        raise GapError(
            message("gap", "{name}: {key} = {short}: must be one of {names}").fill(
                name=name, key=key, short=_short(value), names=", ".join(Verdict)
            )
        )
    return Verdict(value)


def _offsets(name: str, robot: Robot, table: Json) -> dict[str, dict[Tap, Offset]]:
    """Return the offsets of each axis; taps whose offset is null have none."""
    found: dict[str, dict[Tap, Offset]] = {}
    for axis, taps in table.items():
        if axis not in robot.axes:
            raise GapError(
                message("gap", "{name}: offset.{short}: must be one of {names}").fill(
                    name=name, short=_short(axis), names=", ".join(robot.axes)
                )
            )
        for tap, one in _table(name, taps, f"offset.{axis}").items():
            where = f"offset.{axis}.{_short(tap)}"
            if tap not in list(Tap):
                raise GapError(
                    message("gap", "{name}: {where}: must be one of {names}").fill(
                        name=name, where=where, names=", ".join(Tap)
                    )
                )
            if one is not None:
                numbers = _table(name, one, where)
                value, deviation = (
                    _finite(name, f"{where}.{key}", numbers.get(key))
                    for key in ("value", "deviation")
                )
                found.setdefault(axis, {})[Tap(tap)] = Offset(value, deviation)
    return found


def _finite(name: str, key: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise GapError(
            message("gap", "{name}: {key} = {short}: must be a finite number").fill(
                name=name, key=key, short=_short(value)
            )
        )
    return float(value)


def _robot(name: str, text: object) -> Robot:
    where = f"{name}: model.robot"
    if not isinstance(text, str) or not _encodable(text):
        raise GapError(
            message("gap", "{where} = {short}: must be the text of a robot file").fill(
                where=where, short=_short(text)
            )
        )
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
        raise GapError(
            message("gap", "{where} = {short}: must be an object").fill(
                where=where, short=_short(value)
            )
        )
    axis, parameters = value.get("axis"), value.get("parameters", {})
    if not isinstance(axis, str) or axis not in robot.axes:
        raise GapError(
            message("gap", "{where}.axis = {short}: must be one of {names}").fill(
                where=where, short=_short(axis), names=", ".join(robot.axes)
            )
        )
    if not isinstance(parameters, dict):
        raise GapError(
            message("gap", "{where}.parameters = {short}: must be an object").fill(
                where=where, short=_short(parameters)
            )
        )
    clashing = [key for key in parameters if key in RESERVED]
    if clashing:
        raise GapError(
            message("gap", "{where}.parameters.{clashing}: no parameter has this name").fill(
                where=where, clashing=clashing[0]
            )
        )
    own = {key: value.get(key) for key in ("formulation", "from_axis")}
    try:
        asked = parse_effect(axis, {"id": value.get("effect"), **own, **parameters})
        Attached.of(robot, asked)
    except InputError as error:
        raise GapError(
            message("gap", "{where}: {error}").fill(where=where, error=str(error))
        ) from error
    return asked


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
