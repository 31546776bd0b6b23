"""Reading of the corrected model from the JSON document of a diagnosis.

The document is treated as data. Nothing in it is ever executed.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import isfinite
from os import PathLike, fspath
from typing import Any

from rotemina.sim.effects import (
    RESERVED_KEYS,
    AttachedEffect,
    parse_effect,
)
from rotemina.sim.errors import GapError, InputError
from rotemina.sim.files import parse_json, read_text
from rotemina.sim.gap.output.document import FORMAT
from rotemina.sim.gap.result import GapVerdict, ModelOffset
from rotemina.sim.messages import message
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect, Robot
from rotemina.sim.robot_files import parse_robot

MAX_BYTES = 16_000_000
# A message shows at most this many characters of a wrong value.
_MAX_SHOWN_LENGTH = 40

Json = dict[str, Any]


@dataclass(frozen=True, slots=True)
class DiagnosisDocument:
    """A diagnosis read from a file: the verdicts, the diagnosed robot and its corrections.

    ``offsets`` maps axis and tap to the offset.
    """

    verdict: GapVerdict
    axes: Mapping[str, GapVerdict]
    robot: Robot
    effects: tuple[AxisEffect, ...]
    offsets: Mapping[str, Mapping[Tap, ModelOffset]] = field(default_factory=dict)

    @property
    def corrected(self) -> Robot:
        """The robot, with the fitted effects appended to its own."""
        return replace(self.robot, effects=(*self.robot.effects, *self.effects))


def read_document(path: str | PathLike[str]) -> DiagnosisDocument:
    """Read the verdicts and the corrected model from the JSON file of a diagnosis.

    Unknown keys are ignored.

    Raises
    ------
    GapError
        If the file cannot be read, is not such a document, or contains an invalid model. The
        message names the key.
    """
    name = fspath(path)
    text = read_text(
        path, GapError, MAX_BYTES, advice=message("gap", "name the JSON file of a diagnosis")
    )
    table = _require_table(name, parse_json(text, name, GapError), message("gap", "the document"))
    if table.get("format") != FORMAT:
        raise GapError(
            "{name}: format = {short}: must be {format}; name a file that 'rotemina gap "
            "diagnose --json' wrote",
            name=name,
            short=_shorten_value(table.get("format")),
            format=repr(FORMAT),
        )
    model = _require_table(name, table.get("model"), "model")
    robot = _parse_robot_text(name, model.get("robot"))
    effects = model.get("effects")
    if not isinstance(effects, list):
        raise GapError(
            "{name}: model.effects = {short}: must be a list",
            name=name,
            short=_shorten_value(effects),
        )
    axes = {
        axis: _parse_verdict(name, f"axes.{axis}", verdict)
        for axis, verdict in _require_table(name, table.get("axes"), "axes").items()
    }
    return DiagnosisDocument(
        verdict=_parse_verdict(name, "verdict", table.get("verdict")),
        axes=axes,
        robot=robot,
        effects=tuple(
            _parse_model_effect(f"{name}: model.effects[{index}]", robot, effect)
            for index, effect in enumerate(effects)
        ),
        offsets=_parse_offsets(
            name, robot, _require_table(name, table.get("offset", {}), "offset")
        ),
    )


def _require_table(name: str, value: object, key: str) -> Json:
    if not isinstance(value, dict):
        raise GapError(
            "{name}: {key} = {short}: must be an object; name a file that 'rotemina gap "
            "diagnose --json' wrote",
            name=name,
            key=key,
            short=_shorten_value(value),
        )
    return value


def _parse_verdict(name: str, key: str, value: object) -> GapVerdict:
    if not isinstance(value, str) or value not in list(GapVerdict):
        raise GapError(
            "{name}: {key} = {short}: must be one of {names}",
            name=name,
            key=key,
            short=_shorten_value(value),
            names=", ".join(GapVerdict),
        )
    return GapVerdict(value)


def _parse_offsets(name: str, robot: Robot, table: Json) -> dict[str, dict[Tap, ModelOffset]]:
    """Return the offsets of each axis, without taps whose offset is null."""
    offsets: dict[str, dict[Tap, ModelOffset]] = {}
    for axis, taps in table.items():
        if axis not in robot.axes:
            raise GapError(
                "{name}: offset.{short}: must be one of {names}",
                name=name,
                short=_shorten_value(axis),
                names=", ".join(robot.axes),
            )
        for tap, offset in _require_table(name, taps, f"offset.{axis}").items():
            where = f"offset.{axis}.{_shorten_value(tap)}"
            if tap not in list(Tap):
                raise GapError(
                    "{name}: {where}: must be one of {names}",
                    name=name,
                    where=where,
                    names=", ".join(Tap),
                )
            if offset is not None:
                numbers = _require_table(name, offset, where)
                value, deviation = (
                    _require_finite(name, f"{where}.{key}", numbers.get(key))
                    for key in ("value", "deviation")
                )
                offsets.setdefault(axis, {})[Tap(tap)] = ModelOffset(value, deviation)
    return offsets


def _require_finite(name: str, key: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise GapError(
            "{name}: {key} = {short}: must be a finite number",
            name=name,
            key=key,
            short=_shorten_value(value),
        )
    return float(value)


def _parse_robot_text(name: str, text: object) -> Robot:
    where = f"{name}: model.robot"
    if not isinstance(text, str) or not _is_encodable(text):
        raise GapError(
            "{where} = {short}: must be the text of a robot file",
            where=where,
            short=_shorten_value(text),
        )
    return parse_robot(text, source=where)


def _is_encodable(text: str) -> bool:
    """Return whether a text has no unpaired surrogates: JSON permits them, files do not."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def _parse_model_effect(where: str, robot: Robot, value: object) -> AxisEffect:
    if not isinstance(value, dict):
        raise GapError(
            "{where} = {short}: must be an object", where=where, short=_shorten_value(value)
        )
    axis, parameters = value.get("axis"), value.get("parameters", {})
    if not isinstance(axis, str) or axis not in robot.axes:
        raise GapError(
            "{where}.axis = {short}: must be one of {names}",
            where=where,
            short=_shorten_value(axis),
            names=", ".join(robot.axes),
        )
    if not isinstance(parameters, dict):
        raise GapError(
            "{where}.parameters = {short}: must be an object",
            where=where,
            short=_shorten_value(parameters),
        )
    reserved_keys = [key for key in parameters if key in RESERVED_KEYS]
    if reserved_keys:
        raise GapError(
            "{where}.parameters.{clashing}: no parameter has this name",
            where=where,
            clashing=reserved_keys[0],
        )
    optional_fields = {key: value.get(key) for key in ("formulation", "from_axis")}
    try:
        effect = parse_effect(axis, {"id": value.get("effect"), **optional_fields, **parameters})
        AttachedEffect.of(robot, effect)
    except InputError as error:
        raise GapError("{where}: {error}", where=where, error=str(error)) from error
    return effect


def _shorten_value(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _MAX_SHOWN_LENGTH else text[: _MAX_SHOWN_LENGTH - 3] + "..."
