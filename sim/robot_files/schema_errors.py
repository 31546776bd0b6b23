"""Description of a schema error of a robot file in one sentence: key, value, bound."""

import difflib
from collections.abc import Callable, Collection
from dataclasses import fields
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from rotemina.sim.messages import (
    Message,
    join_messages,
    message,
)
from rotemina.sim.robot import model, plate

_BOUNDS = {
    "greater_than": message("engine", "must be greater than {gt}"),
    "greater_than_equal": message("engine", "must be at least {ge}"),
    "less_than": message("engine", "must be less than {lt}"),
    "less_than_equal": message("engine", "must be at most {le}"),
    "finite_number": message("engine", "must be a finite number"),
    "float_type": message("engine", "must be a number"),
    "float_parsing": message("engine", "must be a number"),
    "int_type": message("engine", "must be a whole number"),
    "bool_type": message("engine", "must be true or false"),
    "string_type": message("engine", "must be text"),
    "string_too_short": message("engine", "must not be empty"),
    "string_too_long": message("engine", "must have at most {max_length} letters"),
    "literal_error": message("engine", "must be {expected}"),
    "enum": message("engine", "must be {expected}"),
    "too_short": message("engine", "must have at least {min_length} entry"),
    "too_long": message("engine", "must have {max_length} entries, has {actual_length}"),
    "tuple_type": message("engine", "must be a list"),
    "dataclass_type": message("engine", "must be a table"),
    "dict_type": message("engine", "must be a table"),
}
_KINDS = {"stepper": model.StepperAxis, "piezo": model.PiezoAxis, "force": model.ForceAxis}
_TABLES: dict[str, Any] = {
    "coupling": model.AxisCoupling,
    "reference": model.ReferenceSensor,
    "tool": model.RobotTool,
    "microscope": model.RobotMicroscope,
    "keep_out": model.KeepOut,
    "plate": plate.Plate,
    "hub": plate.PlateHub,
    "pin": plate.PlatePin,
    "joint": plate.PinJoint,
    "cutout": plate.PlateCutout,
    "sensor": model.AxisSensor,
    "controller": model.CascadeController,
    "noise_rms": model.ReferenceNoise,
}


def describe_error(error: ValidationError) -> Message:
    """Describe the first problem in one line, with the number of further problems."""
    return describe_first_error(error, _describe_detail)


def describe_first_error(
    error: ValidationError, describe_detail: Callable[[ErrorDetails], Message]
) -> Message:
    """Describe the first problem, with the number of further problems.

    ``describe_detail`` turns one error into text.
    """
    details = error.errors(include_url=False)
    # A misspelt key is also missing under its right name, so unknown keys come first.
    details.sort(key=lambda detail: detail["type"] != "unexpected_keyword_argument")
    first_problem = describe_detail(details[0])
    if len(details) == 1:
        return first_problem
    return message("engine", "{problem} (and {count} more)").fill(
        problem=first_problem, count=len(details) - 1
    )


def describe_bound(detail: ErrorDetails) -> str:
    """Describe the requirement that a value violates."""
    context = detail.get("ctx", {})
    if detail["type"] == "value_error":
        return str(context["error"])
    template = _BOUNDS.get(detail["type"])
    return detail["msg"] if template is None else template.fill(**context)


def suggest_keys(name: str, known: Collection[str]) -> list[Message]:
    """Suggest the key that may have been meant, or list the known keys."""
    close_matches = difflib.get_close_matches(name, known, n=1)
    if close_matches:
        return [message("engine", "did you mean {key}?").fill(key=repr(close_matches[0]))]
    if not known:
        return []
    return [message("engine", "known here: {keys}").fill(keys=", ".join(known))]


def _describe_detail(detail: ErrorDetails) -> Message:
    path, kind = _make_path(detail["loc"])
    key = ".".join(path)
    name = detail["type"]
    if name == "union_tag_not_found":
        return message("engine", "{key}.kind: missing; one of {kinds}").fill(
            key=key, kinds="'stepper', 'piezo', 'force'"
        )
    if name == "union_tag_invalid":
        return message("engine", "{key}.kind = {value}: must be one of {kinds}").fill(
            key=key, value=repr(detail["ctx"]["tag"]), kinds=detail["ctx"]["expected_tags"]
        )
    if name.startswith("missing"):
        return message("engine", "{key}: missing; {need}").fill(
            key=key, need=_describe_requirement(kind)
        )
    if name == "unexpected_keyword_argument":
        text = message("engine", "{key} = {value}: unknown key").fill(
            key=key, value=_shorten(detail["input"])
        )
        return join_messages(
            [text, *suggest_keys(path[-1], sorted(_find_known_keys(path, kind)))], "; "
        )
    return message("engine", "{key} = {value}: {bound}").fill(
        key=key, value=_shorten(detail["input"]), bound=describe_bound(detail)
    )


def _make_path(location: tuple[int | str, ...]) -> tuple[list[str], str | None]:
    """Drop the tag of the union from ``axis, NAME, TAG, key``; write list indices as ``key[i]``."""
    path: list[str] = []
    kind = None
    for position, part in enumerate(location):
        if position == 2 and location[0] == "axis" and part in _KINDS:
            kind = str(part)
        elif isinstance(part, int) and path:
            path[-1] += f"[{part}]"
        else:
            path.append(str(part))
    return path, kind


def _describe_requirement(kind: str | None) -> Message:
    if kind is None:
        return message("engine", "the file needs it")
    return message("engine", "an axis of kind {kind} needs it").fill(kind=repr(kind))


def _find_known_keys(path: list[str], kind: str | None) -> list[str]:
    parent = path[-2].split("[")[0] if len(path) > 1 else ""
    if parent in _TABLES:
        return [field.name for field in fields(_TABLES[parent])]
    if kind is not None:
        return [field.name for field in fields(_KINDS[kind])]
    if parent == "robot":
        return ["name", "axes", "stages", "pin_length", "piezo_lever_arm"]
    return ["robot", "axis", "coupling", "reference", "tool", "microscope", "keep_out", "plate"]


def _shorten(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
