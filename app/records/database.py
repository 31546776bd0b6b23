"""The library's database: facts, names and notes of each record.

SQLite, because two programs may change it at once and a crash must leave the whole state before a
change or the whole one after it. The journal is the plain one: it works on a shared folder, too.
A connection lasts for one request, so nothing is left open or locked in between.
"""

import json
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import asdict, replace
from datetime import datetime
from itertools import count
from pathlib import Path

from rotemina.app.records.entry import NEW, Entry, Kind, WorstGap
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import message

NAME = "records.sqlite3"
VERSION = 1
_WAIT_S = 5.0  # for another program that is just writing
_DAMAGED = {sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_CORRUPT}
_APART = ("id", "path", "name", "note", "missing")  # what has a column, or is not kept
_TABLE = """
CREATE TABLE IF NOT EXISTS records (
    id INTEGER PRIMARY KEY AUTOINCREMENT, path TEXT NOT NULL UNIQUE,
    name TEXT NOT NULL, note TEXT NOT NULL, facts TEXT NOT NULL
)
"""
_ALL = "SELECT id, path, name, note, facts FROM records"
# What is at a path already is that entry: its name and note stay.
_ADD = """
INSERT INTO records (path, name, note, facts) VALUES (?, ?, ?, ?)
ON CONFLICT (path) DO UPDATE SET facts = excluded.facts RETURNING id
"""
_CHANGE = "UPDATE records SET path = ?, facts = ? WHERE id = ?"
_NAME = "UPDATE records SET name = ? WHERE id = ?"
_NOTE = "UPDATE records SET note = ? WHERE id = ?"


class LibraryError(InputError):
    """The library cannot be read, or a change of it cannot be kept; the message says what to do."""


class DamagedLibraryError(LibraryError):
    """The library's file was damaged; it was set aside."""


class RecordStore:
    """Keeps entries in a file of a folder; for any thread, and any number of programs.

    Paths inside the folder are kept relative to it, so it can be moved with all that is in it.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.absolute()
        self.path = self.folder / NAME

    def all(self) -> list[Entry]:
        """Return every entry.

        Raises
        ------
        LibraryError
            As all methods do: if the file cannot be read or written, or is of a newer program.
        DamagedLibraryError
            Likewise: if it was damaged. It was set aside, and the next request begins again.
        """
        if not self.path.exists():
            return []
        with self._open() as base:
            return [self._entry(*row) for row in base.execute(_ALL)]

    def put(self, entries: Iterable[Entry]) -> list[Entry]:
        """Store new entries, or updates of others; return them with their ids.

        What others are called is left alone: another program may have just changed it.
        """
        kept = []
        with self._open() as base:
            for one in entries:
                path, facts = self._kept(one.path), _facts(one)
                if one.id == NEW:
                    row = base.execute(_ADD, (path, one.name, one.note, facts)).fetchone()
                    kept.append(replace(one, id=row[0]))
                else:
                    base.execute(_CHANGE, (path, facts, one.id))
                    kept.append(one)
        return kept

    def call(self, number: int, *, name: str | None = None, note: str | None = None) -> None:
        """Give an entry another name, another note, or both."""
        with self._open() as base:
            for change, text in ((_NAME, name), (_NOTE, note)):
                if text is not None:
                    base.execute(change, (text, number))

    def remove(self, numbers: Iterable[int]) -> None:
        """Forget entries."""
        with self._open() as base:
            base.executemany("DELETE FROM records WHERE id = ?", [(one,) for one in numbers])

    # --- inside -----------------------------------------------------------------------------------

    @contextmanager
    def _open(self) -> Iterator[sqlite3.Connection]:
        """Open the file for one request, which is kept as a completely or not at all."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with closing(sqlite3.connect(self.path, timeout=_WAIT_S)) as base, base:
                self._prepare(base)
                yield base
        except (sqlite3.Error, OSError) as error:
            if getattr(error, "sqlite_errorcode", 0) & 0xFF in _DAMAGED:
                raise self._set_aside() from error
            raise LibraryError(
                message(
                    "engine",
                    "{path}: the library of records cannot be used ({reason}); free disk "
                    "space, or give this user permission to write there. The records "
                    "themselves are untouched",
                ).fill(path=self.path, reason=reason_of(error))
            ) from error

    def _prepare(self, base: sqlite3.Connection) -> None:
        (version,) = base.execute("PRAGMA user_version").fetchone()
        if version == 0:
            base.execute(_TABLE)
            base.execute("PRAGMA user_version = 1")
        elif version != VERSION:
            raise LibraryError(
                message(
                    "engine",
                    "{path}: the library of records has version {version}, but this program "
                    "uses {own}: start the newer program, or move the file away; the records "
                    "are then listed again, without their names and notes",
                ).fill(path=self.path, version=version, own=VERSION)
            )

    def _set_aside(self) -> DamagedLibraryError:
        """Keep a damaged file, and what it had begun to write, under another name."""
        names = (self.path.with_name(f"records.damaged-{number}.sqlite3") for number in count(1))
        aside = next(name for name in names if not name.exists())
        for end in ("-journal", ""):
            with suppress(FileNotFoundError):
                self.path.with_name(NAME + end).rename(aside.with_name(aside.name + end))
        return DamagedLibraryError(
            message(
                "engine",
                "{path}: the library of records was damaged; it is kept as {aside}. The "
                "records are listed again from their files, without their names and notes",
            ).fill(path=self.path, aside=aside.name)
        )

    def _kept(self, path: Path) -> str:
        inside = path.is_relative_to(self.folder)
        return path.relative_to(self.folder).as_posix() if inside else str(path)

    def _entry(self, number: int, path: str, name: str, note: str, facts: str) -> Entry:
        told = json.loads(facts)
        began, gap = told.pop("began"), told.pop("gap")
        return Entry(
            id=number,
            path=self.folder / path,
            name=name,
            note=note,
            kind=Kind(told.pop("kind")),
            began=datetime.fromisoformat(began) if began else None,
            gap=WorstGap(**gap) if gap else None,
            **told,
        )


def _facts(one: Entry) -> str:
    told = asdict(one) | {"began": one.began.isoformat() if one.began else None}
    return json.dumps({key: each for key, each in told.items() if key not in _APART})
