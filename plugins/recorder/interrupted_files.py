"""Interrupted recordings in the folder of recordings."""

from dataclasses import dataclass
from pathlib import Path

from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.recovery import being_recorded, recover, unfinished
from rotemina.app.shell.engine_words import error_text
from rotemina.plugins.recorder import tr


@dataclass(frozen=True, slots=True)
class Unfinished:
    """An interrupted recording; ``busy`` if a program is still recording it."""

    path: Path
    size: int
    busy: bool


def look(folder: Path, own: frozenset[Path]) -> tuple[Unfinished, ...]:
    """Return the interrupted recordings in a folder, except those of this program.

    Raises
    ------
    RecordingError
        If the folder cannot be read.
    """
    if not folder.is_dir():
        return ()
    try:
        parts = [path for path in unfinished(folder) if path not in own]
    except OSError as error:
        raise RecordingError(
            tr("{folder}: cannot be read ({reason})").format(
                folder=folder, reason=error.strerror or error
            )
        ) from error
    return tuple(Unfinished(path, _size(path), being_recorded(path)) for path in parts)


def recovered(paths: tuple[Path, ...]) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Recover recordings; return the results, and the problems of others."""
    done: list[Path] = []
    refused: list[str] = []
    for path in paths:
        try:
            done.append(recover(path))
        except RecordingError as error:  # one that is spoilt keeps nobody from the others
            refused.append(error_text(error))
    return tuple(done), tuple(refused)


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0
