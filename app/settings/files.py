"""Write files completely or not at all, and append to files that grow."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

from rotemina.sim.files import replace_file

# Opens a new file. Tests pass one that fails.
FileOpener = Callable[[Path], BinaryIO]


def open_new_file(path: Path) -> BinaryIO:
    """Create a file and open it unbuffered; an existing file raises FileExistsError."""
    return path.open("xb", buffering=0)


def write_all(file: BinaryIO, data: bytes) -> None:
    """Write all of the data to an unbuffered file.

    When the disk fills up, a single write may store only a part of the data. The next write then
    raises the error.
    """
    unwritten = memoryview(data)
    while unwritten:
        unwritten = unwritten[file.write(unwritten) :]


def make_plain_name(name: str) -> str:
    """Replace the characters of a name that are not allowed in file names."""
    return re.sub(r"[^\w.+-]+", "-", name).strip("-") or "_"


def format_json(value: dict[str, Any]) -> str:
    """Return indented JSON without escaped letters; NaN raises ValueError."""
    return json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False)


def write_text(path: Path, text: str) -> None:
    """Write a text file, completely or not at all.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    with replace_file(path) as file:
        file.write(text.encode("utf-8"))
