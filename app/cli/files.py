"""Options and steps that several subcommands share: which robot, which record, where to."""

import argparse
import json
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot, shipped_robots
from rotemina.sim.robot.model import Robot

COLUMNS_HELP = "name the columns of a file without a header, e.g. 't [s], x [mm], thx [urad]'"


def add_robot(parser: argparse.ArgumentParser) -> None:
    """Add ``--robot``."""
    parser.add_argument(
        "--robot",
        default="rotemina",
        metavar="NAME_OR_FILE",
        help=f"a robot file, or a shipped robot: {', '.join(shipped_robots())} (default: rotemina)",
    )


def add_columns(parser: argparse.ArgumentParser) -> None:
    """Add ``--columns``."""
    parser.add_argument("--columns", metavar="'t [s], …'", help=COLUMNS_HELP)


def robot_of(options: argparse.Namespace) -> Robot:
    """Load the robot that ``--robot`` names."""
    return load_robot(options.robot)


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
