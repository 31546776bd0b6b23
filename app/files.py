"""Writing files completely or not at all, and files that grow."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

from rotemina.sim.whole_files import replaced

Opener = Callable[[Path], BinaryIO]  # of a new file; tests let it fail


def new_file(path: Path) -> BinaryIO:
    """Open a file that is not there yet, without a buffer of our own."""
    return path.open("xb", buffering=0)


def write_all(file: BinaryIO, data: bytes) -> None:
    """Write all of some data: a disk that fills up takes a part, and refuses the next."""
    rest = memoryview(data)
    while rest:
        rest = rest[file.write(rest) :]


def plain_name(name: str) -> str:
    """Return a name in letters that a file's may have."""
    return re.sub(r"[^\w.+-]+", "-", name).strip("-") or "_"


def json_text(value: dict[str, Any]) -> str:
    """Return indented JSON with unescaped letters; NaN is not allowed."""
    return json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False)


def write_text(path: Path, text: str) -> None:
    """Write a text file, completely or not at all.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    with replaced(path) as file:
        file.write(text.encode("utf-8"))
