"""Writing files completely or not at all."""

import json
from pathlib import Path
from typing import Any

from rotemina.sim.whole_files import replaced


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
