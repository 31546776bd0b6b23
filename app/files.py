"""Files that the program writes: whole or not at all."""

import json
import sys
from pathlib import Path
from typing import Any

from rotemina.sim.whole_files import replaced


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
    FileWriteError
        If it cannot be written.
    """
    with replaced(path) as file:
        file.write(text.encode("utf-8"))
