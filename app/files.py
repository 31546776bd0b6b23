"""Files that the program writes: whole or not at all."""

import json
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

from rotemina.sim.errors import InputError


def write_json(value: dict[str, Any], target: str) -> None:
    """Write JSON to a file, whole or not at all, or print it where ``target`` is ``-``."""
    text = json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    if target == "-":
        sys.stdout.write(text)
    else:
        write_text(Path(target), text)


def write_text(path: Path, text: str) -> None:
    """Write a text file, whole or not at all.

    Raises
    ------
    InputError
        If it cannot be written.
    """
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        Path(name).replace(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from error
