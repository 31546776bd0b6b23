"""TOML files of an operator: strict reading, complete writing.

Every error names the file, the key, the value and the bound.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Annotated, Any, Generic, TypeVar

import tomli_w
from pydantic import ConfigDict, Field, TypeAdapter, ValidationError
from pydantic_core import ErrorDetails

from rotemina.app.files import write_text
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.input_files import parse_toml, read_text
from rotemina.sim.messages import Message, joined, marked, message
from rotemina.sim.robot.schema_errors import bound_of, first_of, suggestion
from rotemina.sim.whole_files import FileWriteError

MAX_BYTES = 1_000_000

STRICT = ConfigDict(extra="forbid")
Switch = Annotated[bool, Field(strict=True)]
Text = Annotated[str, Field(strict=True, min_length=1, max_length=200)]

T = TypeVar("T")


class Format(Generic[T]):
    """A kind of file: its schema, and the error class for problems.

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
            raise self._error(
                message("engine", "{source}: {problem}").fill(
                    source=source, problem=first_of(error, self._sentence)
                )
            ) from error

    def load(self, path: Path) -> T:
        """Return what a file describes."""
        return self.parse(read_text(path, self._error, MAX_BYTES), str(path))

    def text(self, value: T) -> str:
        """Return the text of a value; keys without one are left out."""
        return tomli_w.dumps(_filled(self._adapter.dump_python(value, mode="json")))

    def save(self, path: Path, value: T) -> None:
        """Write a file, completely or not at all; its folder is made.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileWriteError(
                message(
                    "engine", "{parent}: the folder cannot be created ({strerror}); choose another"
                ).fill(parent=path.parent, strerror=reason_of(error))
            ) from error
        write_text(path, self.text(value))

    def _sentence(self, detail: ErrorDetails) -> Message:
        location = detail["loc"]
        key = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in location)
        key = key.lstrip(".")
        if detail["type"].startswith("missing"):
            return message("engine", "{key}: missing; {need}").fill(
                key=key, need=marked("engine", "the file needs it")
            )
        if not isinstance(detail["input"], dict):
            key = f"{key} = {_short(detail['input'])}"
        if detail["type"] == "unexpected_keyword_argument":
            said = message("engine", "{key}: unknown key").fill(key=key)
            return joined([said, *self._suggestion(location)], "; ")
        return message("engine", "{key}: {bound}").fill(key=key, bound=bound_of(detail))

    def _suggestion(self, location: tuple[int | str, ...]) -> list[Message]:
        parents = [part for part in ("", *location[:-1]) if part in self._tables]
        known = [field.name for field in fields(self._tables[parents[-1]])]
        return suggestion(str(location[-1]), known)


def _filled(value: Any) -> Any:
    """Return tables without the keys whose value is None, which TOML cannot write."""
    if isinstance(value, dict):
        return {key: _filled(each) for key, each in value.items() if each is not None}
    return [_filled(each) for each in value] if isinstance(value, list | tuple) else value


def _short(value: object) -> str:
    # A table that was read before its own bounds were looked at.
    text = "…" if is_dataclass(value) else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
