"""Turn a schema error of a robot file into one sentence: key, value, bound."""

import difflib
from dataclasses import fields
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from rotemina.sim.robot import model, plate

_BOUNDS = {
    "greater_than": "must be greater than {gt}",
    "greater_than_equal": "must be at least {ge}",
    "less_than_equal": "must be at most {le}",
    "finite_number": "must be a finite number",
    "float_type": "must be a number",
    "float_parsing": "must be a number",
    "int_type": "must be a whole number",
    "bool_type": "must be true or false",
    "string_type": "must be text",
    "literal_error": "must be {expected}",
    "too_long": "must have {max_length} entries, has {actual_length}",
    "tuple_type": "must be a list",
    "dataclass_type": "must be a table",
    "dict_type": "must be a table",
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


def describe(error: ValidationError) -> str:
    """Return one line for the first problem, with the number of further ones."""
    details = error.errors(include_url=False)
    # An unknown key is the likeliest cause of a missing one: say it first.
    details.sort(key=lambda detail: detail["type"] != "unexpected_keyword_argument")
    more = f" (and {len(details) - 1} more)" if len(details) > 1 else ""
    return _sentence(details[0]) + more


def _sentence(detail: ErrorDetails) -> str:
    path, kind = _path(detail["loc"])
    key = ".".join(path)
    name = detail["type"]
    if name == "union_tag_not_found":
        return f"{key}.kind: missing; one of 'stepper', 'piezo', 'force'"
    if name == "union_tag_invalid":
        tags = detail["ctx"]["expected_tags"]
        return f"{key}.kind = {detail['ctx']['tag']!r}: must be one of {tags}"
    if name.startswith("missing"):
        return f"{key}: missing{_required_by(kind)}"
    if name == "unexpected_keyword_argument":
        return f"{key} = {_short(detail['input'])}: unknown key{_suggestion(path, kind)}"
    template = _BOUNDS.get(name)
    bound = template.format(**detail.get("ctx", {})) if template else detail["msg"]
    return f"{key} = {_short(detail['input'])}: {bound}"


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


def _required_by(kind: str | None) -> str:
    return f"; an axis of kind {kind!r} needs it" if kind else "; the file needs it"


def _suggestion(path: list[str], kind: str | None) -> str:
    known = _known_keys(path, kind)
    close = difflib.get_close_matches(path[-1], known, n=1)
    if close:
        return f"; did you mean {close[0]!r}?"
    return f"; known here: {', '.join(sorted(known))}" if known else ""


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
