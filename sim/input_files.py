"""Files that are read: regular ones of bounded size, and tables of bounded depth in them."""

import json
import os
import re
import stat
import tomllib
from collections.abc import Callable
from os import PathLike, fspath
from pathlib import Path
from typing import Any, BinaryIO

from rotemina.sim.errors import reason_of
from rotemina.sim.messages import joined, marked, message

_DEEPEST = 50  # tables and lists within each other; what we write has fewer than ten
_DO_NOT_WAIT = getattr(os, "O_NONBLOCK", 0)  # for a pipe that nobody writes into
_MOST_DIGITS = 15  # of a whole number: a float holds each of them exactly
# Of a dotted key the parser keeps all beginnings: one of 50 000 parts would fill the memory.
_DEEP_KEY = re.compile(rf"(?<![\w\"'-])(?:[\w\"'-]++[ \t]*+\.[ \t]*+){{{_DEEPEST}}}")
_BINARY = getattr(os, "O_BINARY", 0)  # of Windows, which would change line ends
_GREATEST = 10**18  # a whole number in TOML, which knows 64 bits

Refusal = Callable[[str], Exception]


def open_file(
    path: str | PathLike[str], error: Refusal, *, most_bytes: int | None = None, advice: str = ""
) -> BinaryIO:
    """Open a regular file to read it; no other is opened, since reading it may never end.

    Parameters
    ----------
    path : of the file.
    error : makes the exception of a message.
    most_bytes : that it may have.
    advice : what to do where it cannot be read, such as ``name a robot file``.

    Raises
    ------
    Exception
        Of the kind ``error`` if there is no such file, it is a folder, a pipe or a device, is too
        large, or may not be read.
    """
    name = fspath(path)
    then = joined(("", advice), "; ") if advice else ""
    try:
        _require_regular(Path(name).stat())  # before: opening some devices does something
        # It may have become another one in between, so that is looked at again.
        file = os.fdopen(_opened(name), "rb")
        size = os.fstat(file.fileno()).st_size
    except FileNotFoundError as cause:
        raise error(
            message("engine", "{name} cannot be read (file not found){then}").fill(
                name=name, then=then
            )
        ) from cause
    except (OSError, ValueError) as cause:
        raise error(
            message("engine", "{name} cannot be read ({reason}){then}").fill(
                name=name, reason=reason_of(cause), then=then
            )
        ) from cause
    if most_bytes is not None and size > most_bytes:
        file.close()
        raise error(_too_large(name, most_bytes, then))
    return file


def read_bytes(
    path: str | PathLike[str], error: Refusal, most_bytes: int, *, advice: str = ""
) -> bytes:
    """Return what a file holds; parameters and errors as of :func:`open_file`."""
    name = fspath(path)
    then = joined(("", advice), "; ") if advice else ""
    with open_file(path, error, most_bytes=most_bytes, advice=advice) as file:
        try:
            data = file.read(most_bytes + 1)
        except OSError as cause:
            raise error(
                message("engine", "{name} cannot be read ({reason}){then}").fill(
                    name=name, reason=reason_of(cause), then=then
                )
            ) from cause
    if len(data) > most_bytes:  # it grew, or is one whose size the system does not tell
        raise error(_too_large(name, most_bytes, then))
    return data


def read_text(
    path: str | PathLike[str], error: Refusal, most_bytes: int, *, advice: str = ""
) -> str:
    """Return the UTF-8 text of a file; parameters and errors as of :func:`open_file`."""
    data = read_bytes(path, error, most_bytes, advice=advice)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as cause:
        raise error(
            message("engine", "{name}: not UTF-8 text (byte {start})").fill(
                name=fspath(path), start=cause.start
            )
        ) from cause


def parse_toml(text: str, source: str, error: Refusal) -> dict[str, Any]:
    """Return the tables of a text; ``source`` names it in the error, which ``error`` makes."""
    if _DEEP_KEY.search(text):
        raise error(_too_deep(source))
    try:
        table = tomllib.loads(text)
    except RecursionError as cause:
        raise error(_too_deep(source)) from cause
    except ValueError as cause:  # of TOML, and of a number of thousands of digits
        raise error(
            message("engine", "{source}: not valid TOML: {cause}").fill(
                source=source, cause=reason_of(cause)
            )
        ) from cause
    _check(table, source, error)
    return table


def parse_json(text: str | bytes, source: str, error: Refusal) -> Any:
    """Return the value of a text; NaN and infinity are none. Parameters as of :func:`parse_toml`.

    A whole number that a float does not hold is one all the same, rounded or infinite.
    """

    def refuse(constant: str) -> None:
        raise ValueError(f"{constant} is no number of JSON")

    def whole(digits: str) -> int | float:
        return int(digits) if len(digits) <= _MOST_DIGITS else float(digits)

    try:
        value = json.loads(text, parse_int=whole, parse_constant=refuse)
    except json.JSONDecodeError as cause:
        raise error(
            message("engine", "{source}:{lineno}: not valid JSON: {msg}").fill(
                source=source, lineno=cause.lineno, msg=cause.msg
            )
        ) from cause
    except RecursionError as cause:
        raise error(_too_deep(source)) from cause
    except ValueError as cause:
        raise error(
            message("engine", "{source}: not valid JSON: {cause}").fill(
                source=source, cause=reason_of(cause)
            )
        ) from cause
    _check(value, source, error)
    return value


def _opened(name: str) -> int:
    descriptor = os.open(name, os.O_RDONLY | _BINARY | _DO_NOT_WAIT)
    try:
        _require_regular(os.fstat(descriptor))
    except OSError:
        os.close(descriptor)
        raise
    return descriptor


def _require_regular(found: os.stat_result) -> None:
    if stat.S_ISDIR(found.st_mode):
        raise OSError(marked("engine", "it is a folder"))
    if not stat.S_ISREG(found.st_mode):
        raise OSError(marked("engine", "it is a pipe or a device, not a file"))


def _too_large(name: str, most_bytes: int, then: str) -> str:
    return message(
        "engine", "{name}: larger than {most_bytes} bytes, so it is another kind of file{then}"
    ).fill(name=name, most_bytes=most_bytes, then=then)


def _too_deep(source: str) -> str:
    return message(
        "engine",
        "{source}: tables or lists are nested more than {deepest} levels deep",
    ).fill(source=source, deepest=_DEEPEST)


def _check(value: object, source: str, error: Refusal) -> None:
    """Refuse depths that no recursive function takes, and whole numbers that no float takes."""
    level = [value]
    for _ in range(_DEEPEST):
        inner: list[object] = []
        for one in level:
            if isinstance(one, dict):
                inner += one.values()
            elif isinstance(one, list):
                inner += one
            elif isinstance(one, int) and abs(one) >= _GREATEST:
                raise error(
                    message(
                        "engine",
                        "{source}: an integer has {count} digits; at most 18 are permitted",
                    ).fill(source=source, count=len(str(one)))
                )
        if not inner:
            return
        level = inner
    raise error(_too_deep(source))
