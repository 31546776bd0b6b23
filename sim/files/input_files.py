"""Reading of input files: regular files of bounded size, with tables of bounded depth."""

import json
import os
import re
import stat
import tomllib
from collections.abc import Callable
from os import PathLike, fspath
from pathlib import Path
from typing import Any, BinaryIO

from rotemina.sim.errors import describe_exception
from rotemina.sim.messages import join_messages, marked, message

# Levels of tables and lists. The files that this program writes have fewer than ten.
_MAX_NESTING = 50
# Without this flag, opening a pipe that nobody writes into would never return.
_NONBLOCK_FLAG = getattr(os, "O_NONBLOCK", 0)
# A float holds every whole number of this many digits exactly.
_MAX_EXACT_DIGITS = 15
# The parser stores every prefix of a dotted key, so a key of 50 000 parts would fill the memory.
_DEEP_KEY = re.compile(rf"(?<![\w\"'-])(?:[\w\"'-]++[ \t]*+\.[ \t]*+){{{_MAX_NESTING}}}")
# Without this flag, Windows changes line ends.
_BINARY_FLAG = getattr(os, "O_BINARY", 0)
# A whole number in TOML has 64 bits.
_INTEGER_LIMIT = 10**18

ErrorFactory = Callable[[str], Exception]


def open_file(
    path: str | PathLike[str],
    error: ErrorFactory,
    *,
    max_bytes: int | None = None,
    advice: str = "",
) -> BinaryIO:
    """Open a regular file for reading.

    Pipes and devices are refused, because reading them may never end.

    Parameters
    ----------
    path : of the file.
    error : makes an exception from a message.
    max_bytes : largest permitted size.
    advice : what to do if the file cannot be read, such as ``name a robot file``.

    Raises
    ------
    Exception
        Made by ``error``, if the file does not exist, is a folder, a pipe or a device, is too
        large, or may not be read.
    """
    name = fspath(path)
    suffix = join_messages(("", advice), "; ") if advice else ""
    try:
        # Opening some devices has side effects, so the kind is checked first.
        _require_regular(Path(name).stat())
        # The file may have been replaced since then, so its kind is checked again.
        file = os.fdopen(_open_regular(name), "rb")
        size = os.fstat(file.fileno()).st_size
    except FileNotFoundError as cause:
        raise error(
            message("engine", "{name} cannot be read (file not found){then}").fill(
                name=name, then=suffix
            )
        ) from cause
    except (OSError, ValueError) as cause:
        raise error(
            message("engine", "{name} cannot be read ({reason}){then}").fill(
                name=name, reason=describe_exception(cause), then=suffix
            )
        ) from cause
    if max_bytes is not None and size > max_bytes:
        file.close()
        raise error(_make_size_message(name, max_bytes, suffix))
    return file


def read_bytes(
    path: str | PathLike[str], error: ErrorFactory, max_bytes: int, *, advice: str = ""
) -> bytes:
    """Return the content of a file; parameters and errors as in :func:`open_file`."""
    name = fspath(path)
    suffix = join_messages(("", advice), "; ") if advice else ""
    with open_file(path, error, max_bytes=max_bytes, advice=advice) as file:
        try:
            data = file.read(max_bytes + 1)
        except OSError as cause:
            raise error(
                message("engine", "{name} cannot be read ({reason}){then}").fill(
                    name=name, reason=describe_exception(cause), then=suffix
                )
            ) from cause
    # The file may have grown, or the system may not know its size.
    if len(data) > max_bytes:
        raise error(_make_size_message(name, max_bytes, suffix))
    return data


def read_text(
    path: str | PathLike[str], error: ErrorFactory, max_bytes: int, *, advice: str = ""
) -> str:
    """Return the UTF-8 text of a file; parameters and errors as in :func:`open_file`."""
    data = read_bytes(path, error, max_bytes, advice=advice)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as cause:
        raise error(
            message("engine", "{name}: not UTF-8 text (byte {start})").fill(
                name=fspath(path), start=cause.start
            )
        ) from cause


def parse_toml(text: str, source: str, error: ErrorFactory) -> dict[str, Any]:
    """Return the tables of a TOML text.

    Parameters
    ----------
    text : the text.
    source : name of the text in error messages.
    error : makes an exception from a message.
    """
    if _DEEP_KEY.search(text):
        raise error(_make_nesting_message(source))
    try:
        table = tomllib.loads(text)
    except RecursionError as cause:
        raise error(_make_nesting_message(source)) from cause
    # A number with thousands of digits also raises ValueError.
    except ValueError as cause:
        raise error(
            message("engine", "{source}: not valid TOML: {cause}").fill(
                source=source, cause=describe_exception(cause)
            )
        ) from cause
    _check_nesting(table, source, error)
    return table


def parse_json(text: str | bytes, source: str, error: ErrorFactory) -> Any:
    """Return the value of a JSON text; parameters as in :func:`parse_toml`.

    NaN and infinity are refused. A whole number of more than 15 digits is read as a float, so it
    may be rounded or infinite.
    """

    def refuse_constant(constant: str) -> None:
        raise ValueError(f"{constant} is not a JSON number")

    def parse_whole_number(digits: str) -> int | float:
        return int(digits) if len(digits) <= _MAX_EXACT_DIGITS else float(digits)

    try:
        value = json.loads(text, parse_int=parse_whole_number, parse_constant=refuse_constant)
    except json.JSONDecodeError as cause:
        raise error(
            message("engine", "{source}:{lineno}: not valid JSON: {msg}").fill(
                source=source, lineno=cause.lineno, msg=cause.msg
            )
        ) from cause
    except RecursionError as cause:
        raise error(_make_nesting_message(source)) from cause
    except ValueError as cause:
        raise error(
            message("engine", "{source}: not valid JSON: {cause}").fill(
                source=source, cause=describe_exception(cause)
            )
        ) from cause
    _check_nesting(value, source, error)
    return value


def _open_regular(name: str) -> int:
    descriptor = os.open(name, os.O_RDONLY | _BINARY_FLAG | _NONBLOCK_FLAG)
    try:
        _require_regular(os.fstat(descriptor))
    except OSError:
        os.close(descriptor)
        raise
    return descriptor


def _require_regular(status: os.stat_result) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise OSError(marked("engine", "it is a folder"))
    if not stat.S_ISREG(status.st_mode):
        raise OSError(marked("engine", "it is a pipe or a device, not a file"))


def _make_size_message(name: str, max_bytes: int, advice: str) -> str:
    return message(
        "engine", "{name}: larger than {most_bytes} bytes, so it is another kind of file{then}"
    ).fill(name=name, most_bytes=max_bytes, then=advice)


def _make_nesting_message(source: str) -> str:
    return message(
        "engine",
        "{source}: tables or lists are nested more than {deepest} levels deep",
    ).fill(source=source, deepest=_MAX_NESTING)


def _check_nesting(value: object, source: str, error: ErrorFactory) -> None:
    """Refuse nesting too deep for recursive functions, and whole numbers too large for TOML."""
    items = [value]
    for _ in range(_MAX_NESTING):
        nested_items: list[object] = []
        for item in items:
            if isinstance(item, dict):
                nested_items += item.values()
            elif isinstance(item, list):
                nested_items += item
            elif isinstance(item, int) and abs(item) >= _INTEGER_LIMIT:
                raise error(
                    message(
                        "engine",
                        "{source}: an integer has {count} digits; at most 18 are permitted",
                    ).fill(source=source, count=len(str(item)))
                )
        if not nested_items:
            return
        items = nested_items
    raise error(_make_nesting_message(source))
