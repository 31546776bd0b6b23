"""Turn a schema error of a robot file into one sentence: key, value, bound."""

import difflib
from collections.abc import Callable, Collection
from dataclasses import fields
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from rotemina.sim.messages import Message, joined, message
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
    "coupling": model.Coupling,
    "reference": model.Reference,
    "tool": model.Tool,
    "microscope": model.Microscope,
    "keep_out": model.KeepOut,
    "plate": plate.Plate,
    "hub": plate.Hub,
    "pin": plate.Pin,
    "joint": plate.Joint,
    "cutout": plate.Cutout,
    "sensor": model.Sensor,
    "controller": model.CascadeController,
    "noise_rms": model.ReferenceNoise,
}


def describe(error: ValidationError) -> Message:
    """Return one line for the first problem, with the number of further ones."""
    return first_of(error, _sentence)


def first_of(error: ValidationError, told: Callable[[ErrorDetails], Message]) -> Message:
    """Return the text of the first problem, with the number of further ones."""
    details = error.errors(include_url=False)
    # An unknown key is the likeliest cause of a missing one: say it first.
    details.sort(key=lambda detail: detail["type"] != "unexpected_keyword_argument")
    first = told(details[0])
    if len(details) == 1:
        return first
    return message("engine", "{problem} (and {count} more)").fill(
        problem=first, count=len(details) - 1
    )


def bound_of(detail: ErrorDetails) -> str:
    """Return what a value must be."""
    told = detail.get("ctx", {})
    if detail["type"] == "value_error":
        return str(told["error"])
    found = _BOUNDS.get(detail["type"])
    return detail["msg"] if found is None else found.fill(**told)


def suggestion(name: str, known: Collection[str]) -> list[Message]:
    """Return which key may have been meant, or which there are."""
    close = difflib.get_close_matches(name, known, n=1)
    if close:
        return [message("engine", "did you mean {key}?").fill(key=repr(close[0]))]
    if not known:
        return []
    return [message("engine", "known here: {keys}").fill(keys=", ".join(known))]


def _sentence(detail: ErrorDetails) -> Message:
    path, kind = _path(detail["loc"])
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
        return message("engine", "{key}: missing; {need}").fill(key=key, need=_required_by(kind))
    if name == "unexpected_keyword_argument":
        said = message("engine", "{key} = {value}: unknown key").fill(
            key=key, value=_short(detail["input"])
        )
        return joined([said, *suggestion(path[-1], sorted(_known_keys(path, kind)))], "; ")
    return message("engine", "{key} = {value}: {bound}").fill(
        key=key, value=_short(detail["input"]), bound=bound_of(detail)
    )


def _path(location: tuple[int | str, ...]) -> tuple[list[str], str | None]:
    """Drop the union's tag from ``axis, NAME, TAG, key`` and index lists as ``key[i]``."""
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


def _required_by(kind: str | None) -> Message:
    if kind is None:
        return message("engine", "the file needs it")
    return message("engine", "an axis of kind {kind} needs it").fill(kind=repr(kind))


def _known_keys(path: list[str], kind: str | None) -> list[str]:
    parent = path[-2].split("[")[0] if len(path) > 1 else ""
    if parent in _TABLES:
        return [field.name for field in fields(_TABLES[parent])]
    if kind is not None:
        return [field.name for field in fields(_KINDS[kind])]
    if parent == "robot":
        return ["name", "axes", "stages", "pin_length", "piezo_lever_arm"]
    return ["robot", "axis", "coupling", "reference", "tool", "microscope", "keep_out", "plate"]


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
