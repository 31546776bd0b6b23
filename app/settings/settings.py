"""The user's preferences, stored between starts.

A preference with an invalid value gets its default, so a start never fails. A file that cannot be
read is renamed before a new one is written.
"""

import json
import logging
import os
import threading
from itertools import count
from pathlib import Path
from typing import TypeVar

from platformdirs import user_config_path

from rotemina.app.settings.files import write_text
from rotemina.sim.errors import FileWriteError, InputError
from rotemina.sim.files import parse_json, read_text

logger = logging.getLogger(__name__)

# The language of the window; the command line uses it as well.
LANGUAGE_KEY = "window.language"
_MAX_FILE_BYTES = 1_000_000
Value = TypeVar("Value", bound=str | bool | int | float)


class UserSettings:
    """Preferences in a small JSON file: ``section.key`` → text, number or boolean. Thread-safe.

    Parameters
    ----------
    path : Path, optional
        The file; by default ``settings.json`` in the user's configuration folder.

    Attributes
    ----------
    load_error : str
        Why the file could not be read; empty if it was read or did not exist.
    damaged_copy : Path or None
        Where the unreadable file was moved; None if there was none, or moving it failed.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = path or user_config_path("rotemina", appauthor=False) / "settings.json"
        self.load_error = ""
        self.damaged_copy: Path | None = None
        # Held by the thread that changes the values and writes the file.
        self._lock = threading.Lock()
        self._values = self._load()

    @property
    def folder(self) -> Path:
        """The folder of the user's own files, which contains the file of preferences."""
        return self._path.parent

    @property
    def values(self) -> dict[str, object]:
        """A copy of all stored preferences, by key."""
        return dict(self._values)

    def get(self, key: str, default: Value) -> Value:
        """Return a preference, or ``default`` if it is missing or has another type."""
        value = self._values.get(key, default)
        if type(value) is not type(default):
            logger.warning("%s: %s = %r is ignored, %r is used", self._path, key, value, default)
            return default
        return value

    def set(self, key: str, value: str | bool | int | float) -> None:
        """Store a preference and write the file; a failure is logged, not raised."""
        with self._lock:
            self._values[key] = value
            if self.load_error and self.damaged_copy is None:
                # The unreadable file could not be moved, and must not be overwritten.
                return
            try:
                self._path.parent.mkdir(parents=True, exist_ok=True)
                write_text(self._path, json.dumps(self._values, indent=1, sort_keys=True))
            except (OSError, FileWriteError) as error:
                logger.warning("%s: preferences cannot be stored: %s", self._path, error)

    def _load(self) -> dict[str, object]:
        if not os.path.lexists(self._path):
            return {}
        try:
            text = read_text(self._path, InputError, _MAX_FILE_BYTES)
            values = parse_json(text, str(self._path), InputError)
            if not isinstance(values, dict):
                raise InputError("{path} contains no table of preferences", path=self._path)
        except InputError as error:
            self.load_error = str(error)
            self._move_damaged_file()
            logger.warning(
                "%s; defaults are used, the file is kept as %s", error, self.damaged_copy
            )
            return {}
        return values

    def _move_damaged_file(self) -> None:
        candidates = (
            self._path.with_name(f"{self._path.stem}.damaged-{number}{self._path.suffix}")
            for number in count(1)
        )
        target = next(path for path in candidates if not os.path.lexists(path))
        try:
            self._path.rename(target)
        except OSError as error:
            logger.warning(
                "%s: the unreadable file cannot be moved, so no preferences are stored: %s",
                self._path,
                error,
            )
        else:
            self.damaged_copy = target
