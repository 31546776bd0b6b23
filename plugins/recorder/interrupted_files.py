"""Search for interrupted recordings, and their recovery."""

from dataclasses import dataclass
from pathlib import Path

from rotemina.app.errors import RecordingError
from rotemina.app.language import describe_error
from rotemina.app.motion.recording import find_unfinished, is_being_recorded, recover_recording
from rotemina.plugins.recorder import tr


@dataclass(frozen=True, slots=True)
class InterruptedRecording:
    """Interrupted recording with its size, bytes.

    ``busy`` means that another program is still recording it.
    """

    path: Path
    size: int
    busy: bool


def find_interrupted(folder: Path, own_paths: frozenset[Path]) -> tuple[InterruptedRecording, ...]:
    """Return the interrupted recordings in a folder, except those of this program.

    Raises
    ------
    RecordingError
        If the folder cannot be read.
    """
    if not folder.is_dir():
        return ()
    try:
        paths = [path for path in find_unfinished(folder) if path not in own_paths]
    except OSError as error:
        raise RecordingError(
            tr("{folder}: cannot be read ({reason})").format(
                folder=folder, reason=error.strerror or error
            )
        ) from error
    return tuple(
        InterruptedRecording(path, _read_size(path), is_being_recorded(path)) for path in paths
    )


def recover_all(paths: tuple[Path, ...]) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Recover recordings. Return the paths of the recovered files, and problems with the others."""
    results: list[Path] = []
    problems: list[str] = []
    for path in paths:
        try:
            results.append(recover_recording(path))
        except RecordingError as error:
            # A damaged recording must not prevent the recovery of the others.
            problems.append(describe_error(error))
    return tuple(results), tuple(problems)


def _read_size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0
