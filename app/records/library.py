"""The catalogue of records: those in the program's own folders, and files opened elsewhere."""

import re
import threading
from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from os import stat_result
from pathlib import Path

import numpy as np

from rotemina.app.errors import DamagedLibraryError, LibraryError
from rotemina.app.motion.playback import ComparedRun, find_worst_axis
from rotemina.app.motion.recording import RECORDING_SUFFIX, Recording, make_record, make_trajectory
from rotemina.app.records.database import RecordStore
from rotemina.app.records.entry import LibraryEntry, RecordKind, WorstGap
from rotemina.app.records.file_facts import add_facts, compute_digest, extract_record_facts
from rotemina.sim.errors import describe_exception
from rotemina.sim.records import Record, read_record
from rotemina.sim.robot import Robot

PLAYBACK_FOLDER, RECORDING_FOLDER = "played", "recordings"
_TEXT_SUFFIXES = (".csv", ".csv.gz")
# The names of files that this program writes begin with the time.
_TIME_STAMP_PATTERN = re.compile(r"(\d{4}-\d\d-\d\d_\d\d-\d\d-\d\d-\d{6})_?")
_TIME_STAMP_FORMAT = "%Y-%m-%d_%H-%M-%S-%f"
#: A recording with more samples cannot be loaded as one record. Half an hour at 1 kHz.
MAX_RECORD_ROWS = 2_000_000
# Entries are stored after every this many files, so that an interruption loses little.
_FILES_PER_COMMIT = 50


class RecordCatalogue:
    """The catalogue of all records; any thread may read :attr:`entries`.

    Methods that access the disk may block. The catalogue never deletes a record unless
    :meth:`delete` is called.

    Parameters
    ----------
    folder : Path
        Folder of the user's data, with the database and the folders of playbacks and recordings.
    playback_folder : Path, optional
        The folder of playbacks, if it has another name.

    Attributes
    ----------
    entries : tuple of LibraryEntry
        All records, newest first; replaced as a whole.
    """

    def __init__(self, folder: Path, playback_folder: Path | None = None) -> None:
        folder = folder.absolute()
        self.playback_folder = (
            folder / PLAYBACK_FOLDER if playback_folder is None else playback_folder.absolute()
        )
        self.recording_folder = folder / RECORDING_FOLDER
        self.entries: tuple[LibraryEntry, ...] = ()
        self._store = RecordStore(folder)
        self._lock = threading.Lock()
        self._stop_event = threading.Event()

    def close(self) -> None:
        """Stop a running refresh after its current file."""
        self._stop_event.set()

    @property
    def playback_bytes(self) -> int:
        """Size of all playbacks, bytes."""
        return sum(
            entry.size
            for entry in self.entries
            if entry.kind is RecordKind.PLAYBACK and not entry.missing
        )

    def refresh(self) -> None:
        """Update the entries: find new, missing, moved and changed files.

        Raises
        ------
        LibraryError
            If the database cannot be read or written; the entries then stay as they are.
        DamagedLibraryError
            If the database was damaged. Before this is raised, a new database lists all files that
            can be found.
        """
        try:
            self._refresh()
        except DamagedLibraryError:
            self._refresh()
            raise

    def _refresh(self) -> None:
        with self._lock:
            known_entries = {entry.path: entry for entry in self._store.read_all()}
            present_files = {**dict(self._list_own_files()), **_read_stats(known_entries)}
            missing_by_digest = {
                entry.digest: entry
                for entry in known_entries.values()
                if entry.path not in present_files
            }
            changes: list[LibraryEntry] = []
            stored_count = 0
            for path, status in present_files.items():
                if self._stop_event.is_set():
                    break
                # A file may disappear at any time.
                with suppress(OSError):
                    changed_entry = self._make_entry(
                        path, status, known_entries.get(path), missing_by_digest
                    )
                    changes += [] if changed_entry is None else [changed_entry]
                if len(changes) >= _FILES_PER_COMMIT:
                    stored_count += len(self._store.put(changes))
                    changes.clear()
            if changes:
                stored_count += len(self._store.put(changes))
            entries = self._store.read_all() if stored_count else known_entries.values()
            old_entries = {entry.id: entry for entry in self.entries}
            new_entries = [
                replace(entry, missing=entry.path not in present_files) for entry in entries
            ]
            # Unchanged entries remain the same objects, because these cache their search texts.
            self._set_entries(
                old_entries[entry.id] if old_entries.get(entry.id) == entry else entry
                for entry in new_entries
            )

    def _make_entry(
        self,
        path: Path,
        status: stat_result,
        entry: LibraryEntry | None,
        missing_by_digest: dict[str, LibraryEntry],
    ) -> LibraryEntry | None:
        """Return the new or changed entry of a file; None if nothing has changed."""
        if entry is None:
            moved_entry = missing_by_digest.pop(compute_digest(path), None)
            if moved_entry is not None:
                return replace(moved_entry, path=path, stamp=status.st_mtime_ns)
            entry = add_facts(LibraryEntry(path=path, kind=self._find_kind(path)))
            stamp = _TIME_STAMP_PATTERN.match(path.name)
            if stamp is not None and entry.began is None:
                entry = replace(
                    entry, began=datetime.strptime(stamp[1], _TIME_STAMP_FORMAT).astimezone()
                )
            return _with_default_name(entry, path.name[stamp.end() :] if stamp else path.name)
        if (entry.size, entry.stamp) == (status.st_size, status.st_mtime_ns):
            return None
        # The file was only touched, or replaced with a copy of itself.
        if compute_digest(path) == entry.digest:
            return replace(entry, stamp=status.st_mtime_ns)
        return add_facts(replace(entry, gap=None, changed=True))

    def _find_kind(self, path: Path) -> RecordKind:
        folders = {
            self.playback_folder: RecordKind.PLAYBACK,
            self.recording_folder: RecordKind.RECORDING,
        }
        return folders.get(path.parent, RecordKind.FILE)

    def _list_own_files(self) -> Iterator[tuple[Path, stat_result]]:
        for folder, suffixes in (
            (self.playback_folder, _TEXT_SUFFIXES),
            (self.recording_folder, (RECORDING_SUFFIX,)),
        ):
            for path in folder.iterdir() if folder.is_dir() else ():
                if path.name.endswith(suffixes) and not path.name.startswith("."):
                    with suppress(OSError):
                        yield path, path.stat()

    def add(self, path: Path, record: Record, title: str) -> None:
        """Add a record that was just written or opened, unless the library contains it already.

        The name of the entry is made from ``title``.

        Raises
        ------
        LibraryError
            If it cannot be stored.
        OSError
            If the file does not exist.
        """
        path = path.absolute()
        status = path.stat()
        with self._lock:
            entry = LibraryEntry(
                path=path,
                kind=self._find_kind(path),
                size=status.st_size,
                stamp=status.st_mtime_ns,
                digest=compute_digest(path),
                **extract_record_facts(record),
            )
            known_entry = next((known for known in self.entries if known.path == path), None)
            if known_entry is not None and known_entry.digest == entry.digest:
                return
            (entry,) = self._store.put([_with_default_name(entry, title)])
            self._set_entries([*(known for known in self.entries if known.path != path), entry])

    def set_gap(self, path: Path, run: ComparedRun, robot: Robot) -> None:
        """Store the gap between a record and the model in use, unless a gap is already stored.

        Raises
        ------
        LibraryError
            If it cannot be stored.
        """
        path, gap = path.absolute(), find_worst_gap(run, robot)
        with self._lock:
            entry = next((known for known in self.entries if known.path == path), None)
            if entry is None or entry.gap is not None or gap is None:
                return
            changed_entry = replace(entry, gap=gap, model=run.model_id)
            self._store.put([changed_entry])
            self._set_entries(
                [*(known for known in self.entries if known is not entry), changed_entry]
            )

    def set_texts(self, number: int, *, name: str | None = None, note: str | None = None) -> None:
        """Change the name of an entry, its note, or both.

        Raises
        ------
        LibraryError
            If the change cannot be stored.
        """
        with self._lock:
            entry = next(known for known in self.entries if known.id == number)
            changed_entry = replace(
                entry,
                name=entry.name if name is None else name,
                note=entry.note if note is None else note,
            )
            self._store.set_texts(number, name=name, note=note)
            self._set_entries(
                [*(known for known in self.entries if known is not entry), changed_entry]
            )

    def set_path(self, number: int, path: Path) -> None:
        """Set the new path of a moved file.

        Other missing files of its old folder are searched for in the new folder as well.

        Raises
        ------
        LibraryError
            If the file has other contents, or the change cannot be stored.
        """
        with self._lock:
            entry = next(known for known in self.entries if known.id == number)
            if compute_digest(path) != entry.digest:
                raise LibraryError(
                    "{path}: its contents are not those of the record {name}; choose the "
                    "file that was moved",
                    path=path,
                    name=repr(entry.name),
                )
            missing_neighbours = [
                known
                for known in self.entries
                if known.missing and known.path.parent == entry.path.parent
            ]
            known_paths = {known.path for known in self.entries}
            moved_entries = [replace(entry, path=path, missing=False)]
            for known in missing_neighbours:
                candidate = path.parent / known.path.name
                with suppress(OSError):
                    if (
                        known.id != number
                        and candidate not in known_paths
                        and compute_digest(candidate) == known.digest
                    ):
                        moved_entries.append(replace(known, path=candidate, missing=False))
            self._store.put(moved_entries)
            moved_ids = {moved_entry.id for moved_entry in moved_entries}
            other_entries = [known for known in self.entries if known.id not in moved_ids]
            self._set_entries([*other_entries, *moved_entries])

    def delete(self, numbers: Collection[int]) -> None:
        """Remove entries, and delete their files if these are in the program's own folders.

        Raises
        ------
        LibraryError
            If a file cannot be deleted; its entry and the entries after it are then kept.
        """
        with self._lock:
            deleted_ids = []
            try:
                for entry in [known for known in self.entries if known.id in numbers]:
                    if entry.kind is not RecordKind.FILE:
                        _delete_file(entry.path)
                    deleted_ids.append(entry.id)
            finally:
                self._store.remove(deleted_ids)
                self._set_entries(known for known in self.entries if known.id not in deleted_ids)

    def _set_entries(self, entries: Iterable[LibraryEntry]) -> None:
        ordered = tuple(sorted(entries, key=lambda entry: entry.sort_key, reverse=True))
        for entry in ordered:
            # Cache the text now, so that the first search is fast.
            _ = entry.search_text
        self.entries = ordered


def read_entry(entry: LibraryEntry, robot: Robot) -> Record:
    """Read the record of an entry; a recording is read completely.

    Raises
    ------
    InputError
        If it cannot be read, or its axes are not those of the robot.
    """
    if entry.path.suffix == RECORDING_SUFFIX:
        recording = Recording.open(entry.path)
        check_length(recording)
        return make_record(recording)
    return read_record(entry.path, robot=robot)


def check_length(recording: Recording) -> None:
    """Refuse a recording that is too long to load.

    Raises
    ------
    LibraryError
        If it has more than :data:`MAX_RECORD_ROWS` samples.
    """
    if recording.count > MAX_RECORD_ROWS:
        raise LibraryError(
            "{path}: {rows} samples are too many for one record (at most {most}); export "
            "a section in the panel Recorder",
            path=recording.path,
            rows=recording.count,
            most=MAX_RECORD_ROWS,
        )


def read_commands(entry: LibraryEntry, robot: Robot, period_s: float) -> Record:
    """Return the commands that play an entry again; for a recording, only of axes that moved.

    ``period_s`` is the period of the commands from a recording.

    Raises
    ------
    InputError
        If :func:`read_entry` raises it, or an axis moves at the start or end of a recording.
    """
    if entry.path.suffix != RECORDING_SUFFIX:
        return read_entry(entry, robot)
    recording = Recording.open(entry.path)
    return make_trajectory(recording, -np.inf, np.inf, period_s, robot).commands


def find_worst_gap(run: ComparedRun, robot: Robot) -> WorstGap | None:
    """Return the gap of the axis with the largest gap relative to its sensor's noise floor."""
    worst_axis = find_worst_axis(run.gaps, robot)
    if worst_axis is None:
        return None
    axis, figure = worst_axis
    return WorstGap(axis, figure.rms, run.record.units[axis])


def _with_default_name(entry: LibraryEntry, title: str) -> LibraryEntry:
    stem = title.removesuffix(".gz").removesuffix(".csv").removesuffix(RECORDING_SUFFIX)
    return replace(entry, name=": ".join(filter(None, (entry.run, stem))) or entry.path.stem)


def _read_stats(paths: Iterable[Path]) -> dict[Path, stat_result]:
    statuses = {}
    for path in paths:
        with suppress(OSError):
            statuses[path] = path.stat()
    return statuses


def _delete_file(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise LibraryError(
            "{path} cannot be deleted ({reason}); give this user permission to write there",
            path=path,
            reason=describe_exception(error),
        ) from error
