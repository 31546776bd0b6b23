"""The library of records: the program's own folders, and files opened from elsewhere."""

import re
import threading
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from os import stat_result
from pathlib import Path

import numpy as np

from rotemina.app.motion.compared_run import Run, worst
from rotemina.app.motion.recording.exporting import record_of, trajectory
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import SUFFIX
from rotemina.app.records.database import DamagedLibraryError, LibraryError, RecordStore
from rotemina.app.records.entry import Entry, Kind, WorstGap
from rotemina.app.records.file_facts import digest, of_record, with_facts
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import message
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

PLAYED, RECORDINGS = "played", "recordings"
_TEXTS = (".csv", ".csv.gz")
_STAMP = re.compile(r"(\d{4}-\d\d-\d\d_\d\d-\d\d-\d\d-\d{6})_?")  # that our files begin with
_STAMPED = "%Y-%m-%d_%H-%M-%S-%f"
MOST_ROWS = 2_000_000  # of a recording that is taken as one record: half an hour at 1 kHz
_AT_A_TIME = 50  # files that are looked into before what is known of them is kept


class Library:
    """The library of all records; :attr:`entries` may be read by any thread.

    Methods that touch the disk are for a thread that may wait. The library never deletes a record
    by itself.

    Parameters
    ----------
    folder : Path
        Of the user's data: the library's own file, and the folders of playbacks and recordings.
    played : Path, optional
        The folder of playbacks, if it has another name.

    Attributes
    ----------
    entries : tuple of Entry
        All records, newest first; replaced as a whole.
    """

    def __init__(self, folder: Path, played: Path | None = None) -> None:
        folder = folder.absolute()
        self.played = folder / PLAYED if played is None else played.absolute()
        self.recordings = folder / RECORDINGS
        self.entries: tuple[Entry, ...] = ()
        self._store = RecordStore(folder)
        self._lock = threading.Lock()
        self._ended = threading.Event()

    def close(self) -> None:
        """Look into no further file; what runs ends soon."""
        self._ended.set()

    @property
    def played_bytes(self) -> int:
        """How much room all playbacks take."""
        return sum(
            one.size for one in self.entries if one.kind is Kind.PLAYBACK and not one.missing
        )

    # --- looking ----------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Find out what there is now: files that are new, have gone, moved, or changed.

        Raises
        ------
        LibraryError
            If the library's file cannot be read or written; what is known stays.
        DamagedLibraryError
            If it was damaged, after all that can be found again has been listed again.
        """
        try:
            self._refresh()
        except DamagedLibraryError:
            self._refresh()
            raise

    def _refresh(self) -> None:
        with self._lock:
            known = {one.path: one for one in self._store.all()}
            there = {**dict(self._own_files()), **_stats(known)}
            missing = {one.digest: one for one in known.values() if one.path not in there}
            changes: list[Entry] = []
            kept = 0
            for path, about in there.items():
                if self._ended.is_set():
                    break
                with suppress(OSError):  # it has just gone
                    found = self._entry_of(path, about, known.get(path), missing)
                    changes += [] if found is None else [found]
                if len(changes) >= _AT_A_TIME:
                    kept += len(self._store.put(changes))
                    changes.clear()
            if changes:
                kept += len(self._store.put(changes))
            entries = self._store.all() if kept else known.values()
            before = {one.id: one for one in self.entries}
            now = [replace(one, missing=one.path not in there) for one in entries]
            # What is the same stays the same object, which knows what it is searched by.
            self._sort(before[one.id] if before.get(one.id) == one else one for one in now)

    def _entry_of(
        self, path: Path, about: stat_result, one: Entry | None, missing: dict[str, Entry]
    ) -> Entry | None:
        """Return an entry as it is now to be kept; None where nothing is new of it."""
        if one is None:
            moved = missing.pop(digest(path), None)
            if moved is not None:
                return replace(moved, path=path, stamp=about.st_mtime_ns)
            one = with_facts(Entry(path=path, kind=self._kind_of(path)))
            stamp = _STAMP.match(path.name)
            if stamp is not None and one.began is None:
                one = replace(one, began=datetime.strptime(stamp[1], _STAMPED).astimezone())
            return _named(one, path.name[stamp.end() :] if stamp else path.name)
        if (one.size, one.stamp) == (about.st_size, about.st_mtime_ns):
            return None
        if digest(path) == one.digest:  # touched, or copied here
            return replace(one, stamp=about.st_mtime_ns)
        return with_facts(replace(one, gap=None, changed=True))

    def _kind_of(self, path: Path) -> Kind:
        folders = {self.played: Kind.PLAYBACK, self.recordings: Kind.RECORDING}
        return folders.get(path.parent, Kind.FILE)

    def _own_files(self) -> Iterator[tuple[Path, stat_result]]:
        for folder, ends in ((self.played, _TEXTS), (self.recordings, (SUFFIX,))):
            for path in folder.iterdir() if folder.is_dir() else ():
                if path.name.endswith(ends) and not path.name.startswith("."):
                    with suppress(OSError):
                        yield path, path.stat()

    # --- what comes into it -----------------------------------------------------------------------

    def add(self, path: Path, record: Record, title: str) -> None:
        """Take a record in that has just been written, or opened.

        ``title`` is what it is called unless it is known already.

        Raises
        ------
        LibraryError
            If it cannot be kept.
        OSError
            If the file has gone.
        """
        path = path.absolute()
        about = path.stat()
        with self._lock:
            entry = Entry(
                path=path,
                kind=self._kind_of(path),
                size=about.st_size,
                stamp=about.st_mtime_ns,
                digest=digest(path),
                **of_record(record),
            )
            before = next((one for one in self.entries if one.path == path), None)
            if before is not None and before.digest == entry.digest:
                return
            (entry,) = self._store.put([_named(entry, title)])
            self._sort([*(one for one in self.entries if one.path != path), entry])

    def set_gap(self, path: Path, run: Run, robot: Robot) -> None:
        """Keep the gap of a record from the model in use, unless one is known of it.

        Raises
        ------
        LibraryError
            If it cannot be kept.
        """
        path, gap = path.absolute(), worst_gap(run, robot)
        with self._lock:
            one = next((each for each in self.entries if each.path == path), None)
            if one is None or one.gap is not None or gap is None:
                return
            told = replace(one, gap=gap, model=run.model_id)
            self._store.put([told])
            self._sort([*(each for each in self.entries if each is not one), told])

    def call(self, number: int, *, name: str | None = None, note: str | None = None) -> None:
        """Give an entry another name, another note, or both.

        Raises
        ------
        LibraryError
            If that cannot be kept.
        """
        with self._lock:
            one = next(each for each in self.entries if each.id == number)
            called = replace(
                one,
                name=one.name if name is None else name,
                note=one.note if note is None else note,
            )
            self._store.call(number, name=name, note=note)
            self._sort([*(each for each in self.entries if each is not one), called])

    def found_at(self, number: int, path: Path) -> None:
        """Say where the file of an entry is now; others that were beside it are looked for there.

        Raises
        ------
        LibraryError
            If it is another file, or that cannot be kept.
        """
        with self._lock:
            entry = next(one for one in self.entries if one.id == number)
            if digest(path) != entry.digest:
                raise LibraryError(
                    message(
                        "engine",
                        "{path}: its contents are not those of the record {name}; choose the "
                        "file that was moved",
                    ).fill(path=path, name=repr(entry.name))
                )
            beside = [
                one for one in self.entries if one.missing and one.path.parent == entry.path.parent
            ]
            taken = {one.path for one in self.entries}
            moved = [replace(entry, path=path, missing=False)]
            for one in beside:
                place = path.parent / one.path.name
                with suppress(OSError):
                    if one.id != number and place not in taken and digest(place) == one.digest:
                        moved.append(replace(one, path=place, missing=False))
            self._store.put(moved)
            others = [one for one in self.entries if one.id not in {each.id for each in moved}]
            self._sort([*others, *moved])

    def delete(self, numbers: Collection[int]) -> None:
        """Delete records of the program's own folders, and forget others.

        Raises
        ------
        LibraryError
            If a file cannot be deleted: then its entry stays, and those after it.
        """
        with self._lock:
            gone = []
            try:
                for one in [each for each in self.entries if each.id in numbers]:
                    if one.kind is not Kind.FILE:
                        _unlink(one.path)
                    gone.append(one.id)
            finally:
                self._store.remove(gone)
                self._sort(one for one in self.entries if one.id not in gone)

    def _sort(self, entries: Iterable[Entry]) -> None:
        ordered = tuple(sorted(entries, key=lambda one: one.age, reverse=True))
        for one in ordered:
            _ = one.searched  # worked out here, where nobody waits for it
        self.entries = ordered


def read(entry: Entry, robot: Robot) -> Record:
    """Read the record of an entry, a recording from begin to end.

    Raises
    ------
    InputError
        If it cannot be read, or is none of this robot's axes.
    """
    if entry.path.suffix == SUFFIX:
        recording = Recording.open(entry.path)
        require_length(recording)
        return record_of(recording)
    return read_record(entry.path, robot=robot)


def require_length(recording: Recording) -> None:
    """Refuse a recording that is too long to be held in memory.

    Raises
    ------
    LibraryError
    """
    if recording.count > MOST_ROWS:
        raise LibraryError(
            message(
                "engine",
                "{path}: {rows} samples are too many for one record (at most {most}); export "
                "a section in the panel Recorder",
            ).fill(path=recording.path, rows=recording.count, most=MOST_ROWS)
        )


def commands(entry: Entry, robot: Robot, period_s: float) -> Record:
    """Return what an entry can be played again by: of a recording, the axes that moved.

    ``period_s`` is that of a recording's commands.

    Raises
    ------
    InputError
        As :func:`read`; of a recording, if an axis moves at its begin or its end as well.
    """
    if entry.path.suffix != SUFFIX:
        return read(entry, robot)
    recording = Recording.open(entry.path)
    return trajectory(recording, -np.inf, np.inf, period_s, robot).commands


def worst_gap(run: Run, robot: Robot) -> WorstGap | None:
    """Return the gap of a run's axis that departs most, in floors of its sensor."""
    found = worst(run.gaps, robot)
    if found is None:
        return None
    axis, figure = found
    return WorstGap(axis, figure.rms, run.record.units[axis])


def _named(entry: Entry, title: str) -> Entry:
    """Return an entry that is called after its run, and the file or motion that it is of."""
    stem = title.removesuffix(".gz").removesuffix(".csv").removesuffix(SUFFIX)
    return replace(entry, name=": ".join(filter(None, (entry.run, stem))) or entry.path.stem)


def _stats(known: Mapping[Path, Entry]) -> dict[Path, stat_result]:
    found = {}
    for path in known:
        with suppress(OSError):
            found[path] = path.stat()
    return found


def _unlink(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise LibraryError(
            message(
                "engine",
                "{path} cannot be deleted ({reason}); give this user permission to write there",
            ).fill(path=path, reason=reason_of(error))
        ) from error
