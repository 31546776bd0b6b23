"""The database of the record library: facts, names and notes of each record.

It uses SQLite, because two programs may change the library at the same time, and a crash must not
leave a change half done. It uses the default journal mode, which also works in shared folders. A
connection lasts for one request, so nothing stays open or locked between requests.
"""

import json
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import asdict, replace
from datetime import datetime
from itertools import count
from pathlib import Path

from rotemina.app.errors import DamagedLibraryError, LibraryError
from rotemina.app.records.entry import NEW_ID, LibraryEntry, RecordKind, WorstGap
from rotemina.sim.errors import (
    describe_exception,
)

DATABASE_NAME = "records.sqlite3"
SCHEMA_VERSION = 1
# Longest wait for another program that writes.
_LOCK_TIMEOUT_S = 5.0
_DAMAGE_CODES = {sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_CORRUPT}
# These fields have their own columns, except ``missing``, which is not stored.
_FIELDS_OUTSIDE_FACTS = ("id", "path", "name", "note", "missing")
_CREATE_TABLE = """
CREATE TABLE IF NOT EXISTS records (
    id INTEGER PRIMARY KEY AUTOINCREMENT, path TEXT NOT NULL UNIQUE,
    name TEXT NOT NULL, note TEXT NOT NULL, facts TEXT NOT NULL
)
"""
_SELECT_ALL = "SELECT id, path, name, note, facts FROM records"
# A record whose path is already in the table keeps its id, name and note.
_UPSERT_RECORD = """
INSERT INTO records (path, name, note, facts) VALUES (?, ?, ?, ?)
ON CONFLICT (path) DO UPDATE SET facts = excluded.facts RETURNING id
"""
_UPDATE_FACTS = "UPDATE records SET path = ?, facts = ? WHERE id = ?"
_UPDATE_NAME = "UPDATE records SET name = ? WHERE id = ?"
_UPDATE_NOTE = "UPDATE records SET note = ? WHERE id = ?"


class RecordStore:
    """Stores entries in a database file; usable by any thread and any number of programs.

    Paths inside the folder of the file are stored relative to it, so the folder can be moved with
    its contents.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.absolute()
        self.path = self.folder / DATABASE_NAME

    def read_all(self) -> list[LibraryEntry]:
        """Return every entry.

        Raises
        ------
        LibraryError
            If the file cannot be read or written, or was written by a newer program. All methods
            raise it.
        DamagedLibraryError
            If the file was damaged. It was renamed, and the next request creates a new one. All
            methods raise it.
        """
        if not self.path.exists():
            return []
        with self._connect() as connection:
            return [self._make_entry(*row) for row in connection.execute(_SELECT_ALL)]

    def put(self, entries: Iterable[LibraryEntry]) -> list[LibraryEntry]:
        """Store new entries, and update known ones; return all of them with their ids.

        An update does not change name and note, which another program may just have changed.
        """
        stored = []
        with self._connect() as connection:
            for entry in entries:
                path, facts = self._to_stored_path(entry.path), _format_facts(entry)
                if entry.id == NEW_ID:
                    row = connection.execute(
                        _UPSERT_RECORD, (path, entry.name, entry.note, facts)
                    ).fetchone()
                    stored.append(replace(entry, id=row[0]))
                else:
                    connection.execute(_UPDATE_FACTS, (path, facts, entry.id))
                    stored.append(entry)
        return stored

    def set_texts(self, number: int, *, name: str | None = None, note: str | None = None) -> None:
        """Change the name of an entry, its note, or both."""
        with self._connect() as connection:
            for statement, text in ((_UPDATE_NAME, name), (_UPDATE_NOTE, note)):
                if text is not None:
                    connection.execute(statement, (text, number))

    def remove(self, numbers: Iterable[int]) -> None:
        """Remove entries; the files of their records are kept."""
        with self._connect() as connection:
            connection.executemany(
                "DELETE FROM records WHERE id = ?", [(number,) for number in numbers]
            )

    @contextmanager
    def _connect(self) -> Iterator[sqlite3.Connection]:
        """Open the file for one request; its changes are stored completely or not at all."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with (
                closing(sqlite3.connect(self.path, timeout=_LOCK_TIMEOUT_S)) as connection,
                connection,
            ):
                self._prepare_schema(connection)
                yield connection
        except (sqlite3.Error, OSError) as error:
            if getattr(error, "sqlite_errorcode", 0) & 0xFF in _DAMAGE_CODES:
                raise self._set_aside() from error
            raise LibraryError(
                "{path}: the library of records cannot be used ({reason}); free disk "
                "space, or give this user permission to write there. The records "
                "themselves are untouched",
                path=self.path,
                reason=describe_exception(error),
            ) from error

    def _prepare_schema(self, connection: sqlite3.Connection) -> None:
        (version,) = connection.execute("PRAGMA user_version").fetchone()
        if version == 0:
            connection.execute(_CREATE_TABLE)
            connection.execute("PRAGMA user_version = 1")
        elif version != SCHEMA_VERSION:
            raise LibraryError(
                "{path}: the library of records has version {version}, but this program "
                "uses {own}: start the newer program, or move the file away; the records "
                "are then listed again, without their names and notes",
                path=self.path,
                version=version,
                own=SCHEMA_VERSION,
            )

    def _set_aside(self) -> DamagedLibraryError:
        """Rename a damaged file and its unfinished journal."""
        candidates = (
            self.path.with_name(f"records.damaged-{number}.sqlite3") for number in count(1)
        )
        target = next(path for path in candidates if not path.exists())
        for suffix in ("-journal", ""):
            with suppress(FileNotFoundError):
                self.path.with_name(DATABASE_NAME + suffix).rename(
                    target.with_name(target.name + suffix)
                )
        return DamagedLibraryError(
            "{path}: the library of records was damaged; it is kept as {aside}. The "
            "records are listed again from their files, without their names and notes",
            path=self.path,
            aside=target.name,
        )

    def _to_stored_path(self, path: Path) -> str:
        is_inside = path.is_relative_to(self.folder)
        return path.relative_to(self.folder).as_posix() if is_inside else str(path)

    def _make_entry(self, number: int, path: str, name: str, note: str, facts: str) -> LibraryEntry:
        values = json.loads(facts)
        began, gap = values.pop("began"), values.pop("gap")
        return LibraryEntry(
            id=number,
            path=self.folder / path,
            name=name,
            note=note,
            kind=RecordKind(values.pop("kind")),
            began=datetime.fromisoformat(began) if began else None,
            gap=WorstGap(**gap) if gap else None,
            **values,
        )


def _format_facts(entry: LibraryEntry) -> str:
    values = asdict(entry) | {"began": entry.began.isoformat() if entry.began else None}
    return json.dumps(
        {key: value for key, value in values.items() if key not in _FIELDS_OUTSIDE_FACTS}
    )
