"""TOML files that operators edit: read strictly, written completely or not at all.

Every error names the file, the key, the value and the bound.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Annotated, Any, Generic, TypeVar

import tomli_w
from pydantic import ConfigDict, Field, TypeAdapter, ValidationError
from pydantic_core import ErrorDetails

from rotemina.app.settings.files import write_text
from rotemina.sim.errors import FileWriteError, InputError, describe_exception
from rotemina.sim.files import parse_toml, read_text
from rotemina.sim.messages import Message, join_messages, marked, message
from rotemina.sim.robot_files import (
    describe_bound,
    describe_first_error,
    suggest_keys,
)

MAX_TOML_BYTES = 1_000_000

FORBID_EXTRA_KEYS = ConfigDict(extra="forbid")
StrictBool = Annotated[bool, Field(strict=True)]
NonEmptyText = Annotated[str, Field(strict=True, min_length=1, max_length=200)]

T = TypeVar("T")


class TomlFormat(Generic[T]):
    """A TOML file format: its schema, and the error class that it raises.

    Parameters
    ----------
    schema : type
        The pydantic dataclass of the whole file.
    tables : mapping of str to type
        The dataclass of the tables under each key, from which similar keys are suggested in errors.
    error : type
        The exception class for files that cannot be read or are invalid.
    """

    def __init__(self, schema: type[T], tables: Mapping[str, type], error: type[InputError]):
        self._adapter = TypeAdapter(schema)
        self._tables = {"": schema, **tables}
        self._error = error

    def parse(self, text: str, source: str) -> T:
        """Parse a text; ``source`` names it in errors."""
        table = parse_toml(text, source, self._error)
        try:
            return self._adapter.validate_python(table)
        except ValidationError as error:
            raise self._error(
                message("engine", "{source}: {problem}").fill(
                    source=source, problem=describe_first_error(error, self._describe_error)
                )
            ) from error

    def load(self, path: Path) -> T:
        """Read and parse a file."""
        return self.parse(read_text(path, self._error, MAX_TOML_BYTES), str(path))

    def to_toml(self, value: T) -> str:
        """Format a value as TOML; keys whose value is None are left out."""
        return tomli_w.dumps(_drop_none_values(self._adapter.dump_python(value, mode="json")))

    def save(self, path: Path, value: T) -> None:
        """Write a file completely or not at all; a missing folder is created.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileWriteError(
                "{parent}: the folder cannot be created ({strerror}); choose another",
                parent=path.parent,
                strerror=describe_exception(error),
            ) from error
        write_text(path, self.to_toml(value))

    def _describe_error(self, detail: ErrorDetails) -> Message:
        location = detail["loc"]
        key = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in location)
        key = key.lstrip(".")
        if detail["type"].startswith("missing"):
            return message("engine", "{key}: missing; {need}").fill(
                key=key, need=marked("engine", "the file needs it")
            )
        if not isinstance(detail["input"], dict):
            key = f"{key} = {_shorten(detail['input'])}"
        if detail["type"] == "unexpected_keyword_argument":
            error = message("engine", "{key}: unknown key").fill(key=key)
            return join_messages([error, *self._suggest_keys(location)], "; ")
        return message("engine", "{key}: {bound}").fill(key=key, bound=describe_bound(detail))

    def _suggest_keys(self, location: tuple[int | str, ...]) -> list[Message]:
        parents = [part for part in ("", *location[:-1]) if part in self._tables]
        key_names = [field.name for field in fields(self._tables[parents[-1]])]
        return suggest_keys(str(location[-1]), key_names)


def _drop_none_values(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _drop_none_values(item) for key, item in value.items() if item is not None}
    return [_drop_none_values(item) for item in value] if isinstance(value, list | tuple) else value


def _shorten(value: object) -> str:
    # pydantic may convert a table to its dataclass before it checks the bounds.
    text = "…" if is_dataclass(value) else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
