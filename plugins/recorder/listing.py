"""What is in the folder of recordings: the finished ones, and what a crash has left."""

import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.merging import SUFFIX, being_recorded, recover, unfinished
from rotemina.app.motion.recording.reading import Recording
from rotemina.app.recorded_events import Severity, timeline_events
from rotemina.app.shell.language import translate


@dataclass(frozen=True, slots=True)
class Listed:
    """A finished recording.

    Attributes
    ----------
    began : datetime or None
        When, with the offset of the place where it was recorded.
    duration_s : float
    size : int
        Bytes.
    robot : str
    events : int
        Those that matter to somebody who looks for what happened.
    stamp : int
        Tells whether the file has changed since.
    problem : str
        Why it cannot be opened; then nothing else is known but its size.
    """

    path: Path
    size: int
    stamp: int
    began: datetime | None = None
    duration_s: float = 0.0
    robot: str = ""
    events: int = 0
    problem: str = ""


@dataclass(frozen=True, slots=True)
class Unfinished:
    """A recording that nobody has ended; ``busy`` if a program records it still."""

    path: Path
    size: int
    busy: bool


@dataclass(frozen=True, slots=True)
class Found:
    """What a look into the folder has found, newest recordings first."""

    recordings: tuple[Listed, ...] = ()
    unfinished: tuple[Unfinished, ...] = ()


def look(folder: Path, own: frozenset[Path], known: Mapping[Path, Listed]) -> Found:
    """Look into a folder; what has not changed since it was ``known`` is not opened again.

    What is in ``own`` this program records or ends itself.

    Raises
    ------
    RecordingError
        If the folder cannot be read.
    """
    if not folder.is_dir():
        return Found()
    try:
        found = [_listed(path, known) for path in folder.glob(f"*{SUFFIX}")]
        parts = [path for path in unfinished(folder) if path not in own]
    except OSError as error:
        raise RecordingError(
            translate("recorder", "{folder}: cannot be read ({reason})").format(
                folder=folder, reason=error.strerror or error
            )
        ) from error
    left = tuple(Unfinished(path, _size(path), being_recorded(path)) for path in parts)
    listed = sorted((one for one in found if one is not None), key=_age, reverse=True)
    return Found(tuple(listed), left)


def recovered(paths: tuple[Path, ...]) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Recover recordings; return those that came of it, and why others could not be."""
    done: list[Path] = []
    refused: list[str] = []
    for path in paths:
        try:
            done.append(recover(path))
        except RecordingError as error:  # one that is spoilt keeps nobody from the others
            refused.append(str(error))
    return tuple(done), tuple(refused)


def free_bytes(folder: Path) -> int | None:
    """Return how much room there is where the folder is, or will be; None if nobody knows."""
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return None


def _listed(path: Path, known: Mapping[Path, Listed]) -> Listed | None:
    try:
        about = path.stat()
    except OSError:  # it has just gone
        return None
    before = known.get(path)
    if before is not None and (before.size, before.stamp) == (about.st_size, about.st_mtime_ns):
        return before
    try:
        recording = Recording.open(path)
        told = timeline_events(recording.events(), recording.began_s)
        return Listed(
            path,
            about.st_size,
            about.st_mtime_ns,
            _moment(recording.metadata.get("began", "")),
            recording.ended_s - recording.began_s,
            recording.metadata.get("robot", ""),
            sum(one.weight is not Severity.DETAIL for one in told),
        )
    except (RecordingError, KeyError, ValueError) as error:
        problem = (
            str(error)
            if isinstance(error, RecordingError)
            else translate("recorder", "damaged ({error})").format(error=error)
        )
        return Listed(path, about.st_size, about.st_mtime_ns, problem=problem)


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0


def _age(one: Listed) -> tuple[float, str]:
    at_s = one.stamp / 1e9 if one.began is None else one.began.timestamp()
    return at_s, one.path.name


def _moment(text: str) -> datetime | None:
    try:
        return datetime.fromisoformat(text)
    except ValueError:
        return None
