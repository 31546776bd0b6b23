"""Tables of an operator's files (TOML): strict reading, whole writing.

Every error names the file, the key, the value and the bound.
"""

import difflib
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Annotated, Any, Generic, TypeVar

import tomli_w
from pydantic import ConfigDict, Field, TypeAdapter, ValidationError
from pydantic_core import ErrorDetails

from rotemina.app.files import write_text
from rotemina.sim.errors import InputError
from rotemina.sim.input_files import parse_toml, read_text
from rotemina.sim.whole_files import FileWriteError

MAX_BYTES = 1_000_000

STRICT = ConfigDict(extra="forbid")
Switch = Annotated[bool, Field(strict=True)]
Text = Annotated[str, Field(strict=True, min_length=1, max_length=200)]

T = TypeVar("T")

_BOUNDS = {
    "greater_than": "must be greater than {gt}",
    "greater_than_equal": "must be at least {ge}",
    "less_than": "must be less than {lt}",
    "less_than_equal": "must be at most {le}",
    "finite_number": "must be a finite number",
    "float_type": "must be a number",
    "bool_type": "must be true or false",
    "string_type": "must be text",
    "string_too_short": "must not be empty",
    "string_too_long": "must have at most {max_length} letters",
    "literal_error": "must be {expected}",
    "enum": "must be {expected}",
    "value_error": "{error}",
    "too_short": "must have at least {min_length} entry",
    "tuple_type": "must be a list",
    "dataclass_type": "must be a table",
    "dict_type": "must be a table",
}


class Format(Generic[T]):
    """One kind of file: its schema, and the error that tells what is wrong with it.

    Parameters
    ----------
    schema : type
        The pydantic dataclass of the whole file.
    tables : mapping of str to type
        The dataclass of the tables that stand under a key, for suggestions.
    error : type
        What is raised.
    """

    def __init__(self, schema: type[T], tables: Mapping[str, type], error: type[InputError]):
        self._adapter = TypeAdapter(schema)
        self._tables = {"": schema, **tables}
        self._error = error

    def parse(self, text: str, source: str) -> T:
        """Return what a text describes; ``source`` names it in errors."""
        table = parse_toml(text, source, self._error)
        try:
            return self._adapter.validate_python(table)
        except ValidationError as error:
            raise self._error(f"{source}: {self._describe(error)}") from error

    def load(self, path: Path) -> T:
        """Return what a file describes."""
        return self.parse(read_text(path, self._error, MAX_BYTES), str(path))

    def text(self, value: T) -> str:
        """Return the text of a value; keys without one are left out."""
        return tomli_w.dumps(_filled(self._adapter.dump_python(value, mode="json")))

    def save(self, path: Path, value: T) -> None:
        """Write a file, whole or not at all; its folder is made.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileWriteError(
                f"{path.parent}: the folder cannot be made ({error.strerror}); choose another"
            ) from error
        write_text(path, self.text(value))

    def _describe(self, error: ValidationError) -> str:
        """Return one line for the first problem, with the number of further ones."""
        details = error.errors(include_url=False)
        # An unknown key is the likeliest cause of a missing one: say it first.
        details.sort(key=lambda detail: detail["type"] != "unexpected_keyword_argument")
        more = f" (and {len(details) - 1} more)" if len(details) > 1 else ""
        return self._sentence(details[0]) + more

    def _sentence(self, detail: ErrorDetails) -> str:
        location = detail["loc"]
        key = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in location)
        key = key.lstrip(".")
        value = f" = {_short(detail['input'])}" if not isinstance(detail["input"], dict) else ""
        kind = detail["type"]
        if kind.startswith("missing"):
            return f"{key}: missing; the file needs it"
        if kind == "unexpected_keyword_argument":
            return f"{key}{value}: unknown key{self._suggestion(location)}"
        template = _BOUNDS.get(kind)
        bound = template.format(**detail.get("ctx", {})) if template else detail["msg"]
        return f"{key}{value}: {bound}"

    def _suggestion(self, location: tuple[int | str, ...]) -> str:
        parents = [part for part in ("", *location[:-1]) if part in self._tables]
        known = [field.name for field in fields(self._tables[parents[-1]])]
        close = difflib.get_close_matches(str(location[-1]), known, n=1)
        return f"; did you mean {close[0]!r}?" if close else f"; known here: {', '.join(known)}"


def _filled(value: Any) -> Any:
    """Return tables without the keys whose value is None, which TOML cannot write."""
    if isinstance(value, dict):
        return {key: _filled(each) for key, each in value.items() if each is not None}
    return [_filled(each) for each in value] if isinstance(value, list | tuple) else value


def _short(value: object) -> str:
    # A table that was read before its own bounds were looked at.
    text = "…" if is_dataclass(value) else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
